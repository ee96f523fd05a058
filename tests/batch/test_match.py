"""aadm match: every foot on every group of bars, from the job's text to match.json and the exit code."""

import json
from pathlib import Path
from typing import Any

import pytest

from batch.main import main

from .conftest import WriteJob, column_text

Output = pytest.CaptureFixture[str]


def matched(path: Path, capsys: Output, *words: str) -> tuple[int, Any]:
    """Exit code, and what was printed."""
    code = main(["match", str(path), "--json", "--quiet", *words])
    return code, json.loads(capsys.readouterr().out)


@pytest.fixture
def shipment(write_job: WriteJob) -> Path:
    """Two feet and two groups of bars; as the job lists them neither goes on."""
    return write_job(
        column_text("C-1", "wide-a.ply", "bars.ply"),
        column_text("C-2", "foot.ply", "wide-b.ply"),
        clouds=("wide-a.ply", "bars.ply", "foot.ply", "wide-b.ply"),
    )


@pytest.mark.usefixtures("exact_extraction")
def test_columns_are_exchanged(shipment: Path, capsys: Output) -> None:
    code, document = matched(shipment, capsys)
    assert code == 0
    assert json.loads((shipment.parent / "job-report" / "match.json").read_text("utf-8")) == document
    (group,) = document["groups"]
    assert (group["columns"], group["positions"]) == (["C-1", "C-2"], ["C-1", "C-2"])
    found = {one["column"]: one for one in group["assignments"]}
    assert {column: one["position"] for column, one in found.items()} == {"C-1": "C-2", "C-2": "C-1"}
    assert {one["verdict"] for one in found.values()} == {"pass"}
    assert group["smallest_margin"] == pytest.approx(1.0, abs=1e-3)
    assert group["as_listed_margin"] < 0.0
    assert group["cells"][0][0]["margin"] == group["as_listed_margin"]
    assert document["job"]["name"] == "层 3"
    assert document["turns"] is False


@pytest.mark.usefixtures("exact_extraction")
def test_the_table(shipment: Path, capsys: Output) -> None:
    assert main(["match", str(shipment), "--out", str(shipment.parent / "elsewhere")]) == 0
    captured = capsys.readouterr()
    rows = [line.split() for line in captured.out.splitlines()]
    assert ["Column", "C-1", "C-2"] in rows
    assert ["C-1", "-0.23", "+1.00*"] in rows
    assert ["✓", "pass", "C-2", "C-1", "0°", "+1.00", "0.00", "mm"] in rows
    assert "Smallest margin +1.00; as the job lists them -0.23" in captured.out
    assert [line.split(" (")[0] for line in captured.err.splitlines()] == ["1/2 C-1", "2/2 C-2"]
    assert (shipment.parent / "elsewhere" / "match.json").is_file()


@pytest.mark.usefixtures("exact_extraction")
def test_the_same_bytes_in_several_processes_or_one(shipment: Path, capsys: Output) -> None:
    matched(shipment, capsys)
    first = (shipment.parent / "job-report" / "match.json").read_bytes()
    matched(shipment, capsys)
    assert (shipment.parent / "job-report" / "match.json").read_bytes() == first


@pytest.mark.usefixtures("exact_extraction")
def test_what_does_not_go_on_anywhere_fails(write_job: WriteJob, capsys: Output) -> None:
    path = write_job(column_text("C-1", "foot.ply", "apart.ply"), clouds=("foot.ply", "apart.ply"))
    code, document = matched(path, capsys)
    assert code == 10
    assert document["groups"][0]["assignments"][0]["verdict"] == "fail"


@pytest.mark.usefixtures("exact_extraction")
def test_a_broken_scan_costs_itself_alone(write_job: WriteJob, capsys: Output) -> None:
    """The foot of the column whose bars are missing still is a candidate for other bars."""
    path = write_job(
        column_text("C-1", "foot.ply", "nowhere.ply"),
        column_text("C-2", None, "bars.ply"),
        clouds=("foot.ply", "bars.ply"),
    )
    code, document = matched(path, capsys)
    assert code == 12
    (group,) = document["groups"]
    assert (group["columns"], group["positions"]) == (["C-1"], ["C-2"])
    assert group["assignments"][0]["verdict"] == "pass"
    (problem,) = document["problems"]
    assert (problem["id"], problem["what"], problem["verdict"]) == ("C-1", "rebars", "error")
    assert problem["reasons"][0].startswith("nowhere.ply: there is no such file")


@pytest.mark.usefixtures("exact_extraction")
def test_spare_columns_and_open_positions(write_job: WriteJob, capsys: Output) -> None:
    feet = [column_text(f"C-{number}", "foot.ply") for number in (1, 2)]
    path = write_job(*feet, column_text("P-1", None, "bars.ply"), clouds=("foot.ply", "bars.ply"))
    code, document = matched(path, capsys)
    assert code == 0
    (group,) = document["groups"]
    assert (len(group["assignments"]), len(group["spare_columns"]), group["open_positions"]) == (1, 1, [])
    other = column_text("P-2", None, "bars.ply").replace("36.0", "40.0")
    path = write_job(feet[0], other, clouds=("foot.ply", "bars.ply"))
    code, document = matched(path, capsys)
    assert code == 11, "nothing was put together"
    assert [group["assignments"] for group in document["groups"]] == [[], []]


def test_nothing_to_match(write_job: WriteJob, capsys: Output) -> None:
    path = write_job(column_text("C-1", "foot.ply"), clouds=("foot.ply",))
    assert main(["match", str(path), "--quiet"]) == 2
    assert "has nothing to match: it needs scans of sleeves and scans of rebars" in capsys.readouterr().err
    assert main(["match", str(path), "--only", "C-9"]) == 2
