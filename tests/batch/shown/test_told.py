"""What commands print in a Chinese environment: no English sentence is left but names."""

import re
from pathlib import Path

import pytest

from aadm_workbench.errors import PACKAGES
from aadm_workbench.report.words.labels import phrase
from batch.main import main

SAMPLES = Path(__file__).resolve().parents[3] / "samples"
ENGLISH = re.compile(r"(?<![\w/.-])[A-Za-z]{2,} [A-Za-z]{2,}(?![\w/.-])")
NAMES = re.compile(r'"[^"]*"|\S*/\S*')  # what a model calls its elements, and paths
COMMANDS = {
    "design": ["design", str(SAMPLES / "floor/floor3.ifc"), "--column", "C-301", "--why"],
    "plan": ["plan", "--size", "600"],
    "cameras": ["cameras", f"replay:{SAMPLES / 'floor/scans'}"],
}


@pytest.mark.parametrize("command", COMMANDS)
def test_no_english_sentence_in_a_chinese_environment(
    command: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LANG", "zh_CN.UTF-8")
    assert main(COMMANDS[command]) == 0
    said = capsys.readouterr()
    assert re.search(r"[\u4e00-\u9fff]", said.out)
    model = (SAMPLES / "floor/floor3.ifc").read_text(encoding="utf-8")
    left = ENGLISH.findall(NAMES.sub("", said.out + said.err))
    assert [words for words in left if words not in model] == []


def test_what_packages_are_needed_for_is_said_in_the_same_words() -> None:
    assert [phrase(f"needed_for.{one.module}").en for one in PACKAGES] == [one.needed_for for one in PACKAGES]
