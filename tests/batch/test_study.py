"""``aadm study methods``: what it prints, what it writes, and what it refuses before it begins."""

import csv
import json
from pathlib import Path

import pytest

from aadm_workbench.report.json import encode
from batch.main import main

Output = pytest.CaptureFixture[str]
QUICK = ["study", "methods", "--setting", "lab", "--scenes", "1", "--quick", "--seed", "3"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What one small study wrote: one scene, two methods."""
    folder = tmp_path_factory.mktemp("study") / "out"
    assert main([*QUICK, "--methods", "refined", "fusion", "--out", str(folder), "--quiet"]) == 0
    return folder


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_files_of_a_study(folder: Path) -> None:
    names = {path.name for path in folder.iterdir()}
    assert names == {
        "summary.json",
        "features.csv",
        "spacings.csv",
        "scans.csv",
        "lab-scatter.png",
        "lab-box.png",
    }


def test_a_row_for_every_feature_of_every_method(folder: Path) -> None:
    features = rows(folder / "features.csv")
    assert len(features) == 2 * 2 * 12
    refined = [row for row in features if row["method"] == "refined"]
    assert [row["label"] for row in refined] == [f"{kind}{k}" for kind in "SR" for k in range(1, 13)]
    assert all(row["found"] == "yes" for row in refined)
    assert all(float(row["error_mm"]) < 0.6 and float(row["u_mm"]) > 0 for row in refined)
    assert all(row["u_mm"] == row["covered"] == "" for row in features if row["method"] == "fusion")
    assert len(rows(folder / "spacings.csv")) == 2 * 2 * 12


def test_numbers_are_those_of_the_rows(folder: Path) -> None:
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert (summary["seed"], summary["scenes"], summary["half_resolution"]) == (3, 1, True)
    features = rows(folder / "features.csv")
    for score in summary["settings"]["lab"]["measured"]:
        own = [row for row in features if (row["method"], row["kind"]) == (score["method"], score["kind"])]
        errors = [float(row["error_mm"]) for row in own if row["found"] == "yes"]
        assert (score["found"], score["expected"]) == (len(errors), 12)
        assert score["centre"]["mean_mm"] == pytest.approx(sum(errors) / len(errors), abs=1e-3)
        assert score["centre"]["largest_mm"] == pytest.approx(max(errors), abs=1e-3)
        assert score["times_fusion"] == (1.0 if score["method"] == "fusion" else pytest.approx(score["times_fusion"]))
        assert score["seconds"] > 0
    assert summary["settings"]["lab"]["bare_calls_s"]["sleeves"] > 0
    assert encode(summary).decode() == (folder / "summary.json").read_text(encoding="utf-8")


def test_table_stands_beside_that_of_the_paper(capsys: Output) -> None:
    assert main([*QUICK, "--methods", "image"]) == 0
    captured = capsys.readouterr()
    lines = captured.out.splitlines()
    assert lines[0].startswith("Table 2, laboratory model of the paper")
    published = next(line for line in lines if line.startswith("paper  fusion"))
    assert " ".join(published.split()[2:]) == "0.32 ± 0.17 0.53 ± 0.31 0.22 ± 0.14 0.43 ± 0.29 0.407 1.660"
    ours = next(line for line in lines if line.startswith("here"))
    assert ours.index("±") == published.index("±")
    assert "bare calls" not in "".join(line for line in lines if line.startswith("here"))
    assert captured.err == "1/1 lab scene 1\n"


def test_json_is_all_that_is_printed(capsys: Output) -> None:
    assert main([*QUICK, "--methods", "image", "--json", "--quiet"]) == 0
    captured = capsys.readouterr()
    assert list(json.loads(captured.out)["settings"]) == ["lab"]
    assert captured.err == ""


@pytest.mark.parametrize(
    ("words", "complaint"),
    [(["--seed", "-1"], "--seed must not be below zero"), (["--out", "{file}/out"], "the folder cannot be made")],
)
def test_refused_before_anything_is_rendered(
    words: list[str], complaint: str, tmp_path: Path, capsys: Output, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("aadm_workbench.twin.study.methods.study_methods", None)
    (tmp_path / "file").touch()
    assert main([*QUICK, *(word.format(file=tmp_path / "file") for word in words)]) == 2
    assert complaint in capsys.readouterr().err


@pytest.mark.parametrize("missing", ["open3d", "matplotlib"])
def test_says_what_to_install(missing: str, tmp_path: Path, capsys: Output, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batch.commands.study.find_spec", lambda name: None if name == missing else name)
    assert main([*QUICK, "--out", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert missing in error
    assert "pip install 'aadm-workbench[twin]'" in error
    assert not (tmp_path / "out").exists()
