"""The numbers that benchmarks/shipment.py prints, on a floor of two columns: that they are measured at all."""

import json
from pathlib import Path

import pytest

from benchmarks.floors import write_floor
from benchmarks.shipment import machine, run_check


def test_time_and_memory_of_a_check(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    run = run_check(write_floor(tmp_path / "floor", 2, shrink=8), "--jobs", "2")
    report = json.loads((tmp_path / "floor" / "job-report" / "report.json").read_text("utf-8"))
    assert len(report["columns"]) == 2
    assert run.exit_code in (10, 11)
    assert 0.5 < run.seconds < 60.0
    # Workers hold numpy and OpenCV at the least.
    assert 40.0 < run.worker_mb < 600.0
    assert 30.0 < run.main_mb < 600.0
    assert len(run.main_mb_by_share) == 4


def test_machine() -> None:
    found = machine()
    assert found["cores"] >= 1
    assert {"processor", "memory_gb", "numpy", "python"} <= found.keys()
