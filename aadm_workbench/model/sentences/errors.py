"""What is said of what is not installed."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "errors.missing": Sentence(
        "{needed_for:word} needs the package {package}, which is not installed. Install it with: {install}",
        "{needed_for:word}需要软件包 {package}，但未安装。安装命令：{install}",
    ),
    "errors.missing.private": Sentence(
        "{needed_for:word} needs the package {package}, which is not installed. FreeCAD's private environment "
        "lacks it: repair that in About AADM and doctor, or name in the settings an aadm of your own that has it "
        "({install})",
        "{needed_for:word}需要软件包 {package}，但未安装。FreeCAD 的私有环境中缺少它：请在“关于 AADM "
        "与环境诊断”中修复，或在设置中指定已装有它的 aadm（{install}）",
    ),
}
