"""What stands under the table of a check: how to repair a column, and what a mould does to its sleeves."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from aadm_workbench.report.json import report_schema
from batch.main import main

from .conftest import WriteJob, column_text

Output = pytest.CaptureFixture[str]


def report(path: Path) -> Any:
    """report.json beside a job, held against its schema."""
    document = json.loads((path.parent / "job-report" / "report.json").read_text("utf-8"))
    jsonschema.Draft202012Validator(report_schema()).validate(document)
    return document


@pytest.mark.usefixtures("exact_extraction")
def test_repair_in_one_line_and_in_the_report(write_job: WriteJob, capsys: Output) -> None:
    path = write_job(
        column_text("C-1", "foot.ply", "apart.ply"),
        column_text("C-2", "foot.ply", "bars.ply"),
        clouds=("foot.ply", "apart.ply", "bars.ply"),
    )
    assert main(["check", str(path)]) == 10
    lines = capsys.readouterr().out.splitlines()
    (advice,) = [line for line in lines if line.startswith("C-1: repair, ")]
    assert advice.startswith("C-1: repair, subject to the engineer's release: bend R")
    first, second = report(path)["columns"]
    assert second["repair"] is None
    assert advice == f"C-1: repair, {first['repair']['advice']}"
    assert (first["repair"]["action"], first["repair"]["exact"]) == ("bend", True)
    (step,) = first["repair"]["steps"]
    # Labels begin at (-x, -y): the first and the seventh stand apart along the diagonal, and come together.
    sign = {"R1": 1.0, "R7": -1.0}[step["rebar"]]
    assert all(sign * value > 0.0 for value in step["bend_mm"])
    assert step["position_after_mm"] < step["position_limit_mm"] < step["position_before_mm"]
    assert first["repair"]["after"]["max_mm"] < 3.0


@pytest.mark.usefixtures("exact_extraction")
def test_a_mould_in_one_line_and_in_the_report(write_job: WriteJob, capsys: Output) -> None:
    names = [f"mould-{number}.ply" for number in range(5)]
    path = write_job(*(column_text(f"C-{name[6]}", name) for name in names), clouds=tuple(names))
    assert main(["check", str(path)]) == 0
    printed = capsys.readouterr().out
    assert "Mould of C-0: displaced alike in 5 columns: S" in printed
    (mould,) = report(path)["mould_drift"]
    (sleeve,) = [entry for entry in mould["sleeves"] if entry["drifts"]]
    assert sleeve["mean_mm"] == pytest.approx([1.0, 0.0], abs=0.2)
    assert mould["piece_mark"] is None
    few = write_job(*(column_text(f"C-{name[6]}", name) for name in names[:2]), clouds=tuple(names))
    assert main(["check", str(few)]) == 0
    assert "Mould" not in capsys.readouterr().out
    assert report(few)["mould_drift"] == []
