"""``aadm report`` and ``aadm diff``: files where they belong, slips that are named, exit codes as documented."""

import json
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest
import trimesh

from batch.main import main
from tests.design.drawn_mesh import bars, concrete
from tests.report.checked_floor import CASES, floor_report

from .conftest import WriteJob, column_text

Output = pytest.CaptureFixture[str]
SAMPLE = Path(__file__).resolve().parents[2] / "samples" / "floor" / "job.toml"
FILES = {
    "--html": "report.html",
    "--pdf": "report.pdf",
    "--xlsx": "report.xlsx",
    "--csv": "report.csv",
    "--bcf": "report.bcf",
    "--crew": "crew.pdf",
    "--scan-card": "scan-card.pdf",
}


@pytest.fixture(scope="module")
def small() -> dict[str, Any]:
    """A pass and a fail."""
    return floor_report(CASES[0], CASES[2])


@pytest.fixture
def report(small: dict[str, Any], tmp_path: Path) -> Path:
    """Its file."""
    path = tmp_path / "report.json"
    path.write_text(json.dumps(small), encoding="utf-8")
    return path


def test_every_format_in_its_file(report: Path, tmp_path: Path, capsys: Output) -> None:
    out = tmp_path / "deep" / "out"
    assert main(["report", str(report), *FILES, "--out", str(out)]) == 0
    assert {path.name for path in out.iterdir()} == set(FILES.values())
    for name in FILES.values():
        start = (out / name).read_bytes()[:20]
        kinds = {"html": b"<!doctype html>", "pdf": b"%PDF", "csv": b"\xef\xbb\xbfcolumn"}
        assert start.startswith(kinds.get(name.rpartition(".")[2], b"PK"))
    assert zipfile.is_zipfile(out / "report.bcf")
    assert capsys.readouterr().out.count("Written: ") == len(FILES)


def test_html_beside_the_report_is_the_default(report: Path, capsys: Output) -> None:
    assert main(["report", str(report), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {"files": {"html": str(report.with_name("report.html"))}}
    assert report.with_name("report.html").exists()


def test_some_columns_in_chinese(report: Path) -> None:
    assert main(["report", str(report), "--only", "C-3", "--language", "zh", "--quiet"]) == 0
    text = report.with_name("report.html").read_text(encoding="utf-8")
    assert "该柱不得吊装" in text
    assert ">C-1<" not in text


def test_run_again_updates_the_topics(report: Path, small: dict[str, Any]) -> None:
    assert main(["report", str(report), "--bcf", "--quiet"]) == 0
    names = zipfile.ZipFile(report.with_name("report.bcf")).namelist()
    assert main(["report", str(report), "--bcf", "--quiet"]) == 0
    assert zipfile.ZipFile(report.with_name("report.bcf")).namelist() == names


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["report", "none.json"], "none.json: cannot be read"),
        (["report", "REPORT", "--only", "C-4"], 'has no column "C-4" (--only); did you mean'),
        (["report", str(SAMPLE), "--html"], "of a job only --scan-card can be made; check it first (aadm check"),
        (["report", str(SAMPLE), "--scan-card", "--only", "C-31"], "did you mean"),
        (["diff", "REPORT", "none.json"], "none.json: cannot be read"),
    ],
)
def test_slips_are_named(report: Path, capsys: Output, words: list[str], said: str) -> None:
    assert main([str(report) if word == "REPORT" else word for word in words]) == 2
    assert said in capsys.readouterr().err


def test_missing_package_is_named_before_anything_is_written(
    report: Path, capsys: Output, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "reportlab", None)
    assert main(["report", str(report), "--html", "--pdf"]) == 2
    assert "report.pdf needs the package reportlab" in capsys.readouterr().err
    assert not report.with_name("report.html").exists()


def test_scan_cards_before_any_scan(tmp_path: Path) -> None:
    assert main(["report", str(SAMPLE), "--scan-card", "--only", "C-301", "C-308", "--out", str(tmp_path)]) == 0
    assert (tmp_path / "scan-card.pdf").read_bytes().startswith(b"%PDF")
    assert [path.name for path in tmp_path.iterdir()] == ["scan-card.pdf"]


def test_scan_cards_of_a_model_in_metres(tmp_path: Path, capsys: Output) -> None:
    """The unit that the job declares of its mesh holds for its scan cards as for its check."""
    mesh = trimesh.util.concatenate([concrete(), *bars()])
    mesh.apply_scale(0.001)
    mesh.export(tmp_path / "C-1.stl")
    job = tmp_path / "job.toml"
    job.write_text(
        'schema = 1\n[model]\npath = "C-1.stl"\nunits = "m"\n[[columns]]\nid = "C-1"\nsleeves = "foot.ply"\n',
        encoding="utf-8",
    )
    assert main(["report", str(job), "--scan-card"]) == 0, capsys.readouterr().err
    assert len(list(tmp_path.rglob("scan-card.pdf"))) == 1


def test_diff(report: Path, small: dict[str, Any], tmp_path: Path, capsys: Output) -> None:
    """0 nothing changed, 11 changed, 10 worse."""
    better = json.loads(json.dumps(small))
    better["columns"][1] |= {"verdict": "pass", "goes_on": "pass", "reasons": []}
    later = tmp_path / "later.json"
    later.write_text(json.dumps(better), encoding="utf-8")
    assert main(["diff", str(report), str(report)]) == 0
    assert capsys.readouterr().out == "Nothing changed in 2 columns.\n"
    assert main(["diff", str(report), str(later)]) == 11
    assert "fail → pass" in capsys.readouterr().out
    assert main(["diff", str(later), str(report), "--json"]) == 10
    printed = json.loads(capsys.readouterr().out)
    assert printed["changed"][0]["id"] == "C-3"
    assert printed["changed"][0]["trend"] == "worse"
    assert printed["any_worse"] is True


@pytest.mark.usefixtures("exact_extraction")
def test_reports_after_a_check(write_job: WriteJob, tmp_path: Path) -> None:
    path = write_job(column_text("C-1", "foot.ply", "4mm.ply"), clouds=("foot.ply", "4mm.ply"))
    out = tmp_path / "out"
    assert main(["check", str(path), "--out", str(out), "--quiet", *FILES, "--language", "zh"]) == 10
    assert {"report.json", *FILES.values()} <= {entry.name for entry in out.iterdir()}
    assert "该柱不得吊装" in (out / "report.html").read_text(encoding="utf-8")


def test_a_check_without_the_packages_does_not_start(
    write_job: WriteJob, capsys: Output, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    path = write_job(column_text("C-1", "foot.ply"), clouds=("foot.ply",))
    assert main(["check", str(path), "--xlsx"]) == 2
    assert "pip install 'aadm-workbench[reports]'" in capsys.readouterr().err
    assert not path.with_name("job-report").exists()


def test_a_format_that_fails_does_not_cost_the_others(
    report: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: Any, **__: Any) -> None:
        raise ZeroDivisionError("no such page")

    monkeypatch.setattr("aadm_workbench.report.pages.pdf.write_pdf", broken)
    assert main(["report", str(report), "--html", "--pdf", "--csv", "--crew"]) == 70
    said = capsys.readouterr()
    assert "report.pdf: ZeroDivisionError: no such page" in said.err
    assert [line.rpartition("/")[2] for line in said.out.splitlines()] == ["report.html", "report.csv", "crew.pdf"]
    assert {"report.html", "report.csv", "crew.pdf"} <= {path.name for path in report.parent.iterdir()}


def test_bcf_of_either_version_in_either_language(report: Path) -> None:
    for version in ("2.1", "3.0"):
        out = report.parent / version
        words = ["report", str(report), "--bcf", "--bcf-version", version, "--language", "zh", "--quiet"]
        assert main([*words, "--out", str(out)]) == 0
        with zipfile.ZipFile(out / "report.bcf") as archive:
            assert f'VersionId="{version}"' in archive.read("bcf.version").decode()
            markups = [archive.read(name).decode() for name in archive.namelist() if name.endswith("markup.bcf")]
        assert all("不合格" in text or "未测得" in text or "不确定" in text or "无法检查" in text for text in markups)
    assert main(["report", str(report), "--bcf", "--bcf-version", "2.1", "--out", str(out)]) == 70
