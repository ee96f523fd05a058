"""What is said of what is not installed."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "errors.missing": Sentence(
        "{needed_for:word} needs the package {package}, which is not installed. Install it with: {install}",
        "{needed_for:word}需要软件包 {package}，但未安装。安装命令：{install}",
    ),
}
