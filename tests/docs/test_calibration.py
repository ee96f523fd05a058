"""The commands of the page on calibration, run as they stand there, lead to a learned profile; both languages alike."""

import json
import re
import shlex
import tomllib
from pathlib import Path

import pytest

from batch.main import main
from tests.conftest import ROOT

PAGES = (ROOT / "docs" / "calibration.md", ROOT / "docs" / "zh" / "calibration.md")


def commands_of(page: Path) -> list[str]:
    """The lines of the blocks that are shells, of the camera and its plate."""
    blocks = re.findall(r"^```sh\n(.*?)^```", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    return [line for block in blocks for line in block.splitlines() if re.match(r"aadm (simulate|camera) ", line)]


def run(line: str) -> int:
    """One line of a shell in the folder of today, with its stars."""
    words = [
        found
        for word in shlex.split(line)[1:]
        for found in (sorted(map(str, Path().glob(word))) if "*" in word else [word])
    ]
    return main([*words, "--quiet"])


def test_both_pages_have_the_same_commands() -> None:
    english, chinese = (commands_of(page) for page in PAGES)
    assert english == chinese
    assert len(english) == 4


def test_the_tutorial_leads_to_a_learned_camera(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert [run(line) for line in commands_of(PAGES[0])] == [0, 0, 0, 0]
    truth = json.loads(Path("plate/truth.json").read_text())
    text = Path("camera-0042.toml").read_text()
    learned = tomllib.loads(text)["learned"]
    scale, u = learned["scale"]
    assert abs(scale - truth["scale"]) < 3.0 * u
    assert u < 2e-4
    for kind in ("sleeves", "rebars"):
        assert len(learned[kind]["lost"]) > 5
        assert 0.0 <= learned[kind]["share"] <= 1.0
    log = Path("camera-0042-log.csv").read_text().splitlines()
    assert len(log) == 7
    assert all(line.startswith("2026-11-21,plate-2.tiff,") for line in log[1:])
    assert Path("chart.html").read_text().count("<svg") == 6
    assert {path.name for path in Path("plate-for-the-workshop").iterdir()} == {
        "plate.dxf",
        "plate.pdf",
        "plate.step",
        "plate.toml",
    }
    drifted = re.sub(r"stretch = \[([^,]+),", lambda found: f"stretch = [{float(found[1]) + 3e-3:.6g},", text)
    Path("drifted.toml").write_text(drifted)
    verify = next(line for line in commands_of(PAGES[0]) if " verify " in line)
    assert run(verify.replace("--profile camera-0042.toml", "--profile drifted.toml")) == 10
