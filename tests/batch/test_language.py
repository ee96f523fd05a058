"""Errors in the language that was asked for, from the command line to the crew's page."""

import re
from pathlib import Path

import pytest

from batch.main import main

CHINESE = re.compile(r"[\u4e00-\u9fff]")
MODEL = 'schema = 1\n[model]\npath = "{model}"\n[[columns]]\nid = "C-1"\nsleeves = "foot.tiff"\n'
INLINE = (
    "schema = 1\n[camera]\nfx = 900.0\nfy = 900.0\ncx = 320.0\ncy = 240.0\nwidth = 640\nheight = 480\n"
    '[[columns]]\nid = "C-1"\nsleeves = "foot.tiff"\nup = "+y"\n[columns.design]\n{design}\n'
)
CASES = {
    "missing": (MODEL.format(model="floor.ifc"), None, "不存在。任务中的路径相对于任务文件"),
    "cut": (MODEL.format(model="floor.ifc"), b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=IFCWALL(", "请重新拷贝"),
    "empty": (MODEL.format(model="floor.ifc"), b"", "是空文件：请重新导出模型"),
    "zip": (MODEL.format(model="floor.ifc"), b"PK\x03\x04", "是 zip 文件，不是 IFC 模型"),
    "other": (MODEL.format(model="floor.skp"), b"x", "不支持.skp 格式的模型"),
    "inline": (
        INLINE.format(design="centres = [[0, 0], [100, 0], [0, 100]]\nrebar_diameter = 22"),
        None,
        "没有 sleeve_diameter（套筒口内径，mm）：请补上",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_model_that_cannot_be_read_is_told_in_chinese(
    case: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    job, content, wanted = CASES[case]
    (tmp_path / "job.toml").write_text(job, encoding="utf-8")
    if content is not None:
        name = re.search(r'path = "(.*)"', job)
        assert name
        (tmp_path / name[1]).write_bytes(content)
    arguments = ["check", str(tmp_path / "job.toml"), "--out", str(tmp_path / "out"), "--quiet"]
    codes, told = [], []
    for language in ("zh", "en"):
        codes.append(main([*arguments, "--language", language]))
        told.append(capsys.readouterr().err)
    assert codes == [2, 2]
    assert wanted in told[0]
    assert not CHINESE.search(told[1])
    assert "floor" in told[0] or "C-1" in told[0]


def test_a_scan_that_cannot_be_read_is_told_in_chinese_on_the_page_of_the_crew(tmp_path: Path) -> None:
    design = "centres = [[0, 0], [100, 0], [0, 100]]\nrebar_diameter = 22\nsleeve_diameter = 40"
    (tmp_path / "job.toml").write_text(INLINE.format(design=design), encoding="utf-8")
    (tmp_path / "foot.tiff").write_bytes(b"II*\0\x08\0")
    assert main(["check", str(tmp_path / "job.toml"), "--out", str(tmp_path / "out"), "--quiet", "--html"]) == 12
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "foot.tiff：文件在文件头中断（6 字节）；请重新拷贝" in page
    assert "foot.tiff: ends or breaks off within its header (6 bytes); copy it again" in page
    assert str(tmp_path) not in page
