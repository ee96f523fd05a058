"""The demo passes only where every verdict is the expected one."""

import json
from pathlib import Path

import pytest

from batch.demo_verdicts import Comparison, compare, main


def written(folder: Path, expected: dict[str, str], got: dict[str, str]) -> list[str]:
    """Command line for a truth.json and a report.json with some verdicts."""
    truth, report = folder / "truth.json", folder / "report.json"
    made = {name: {"verdict": verdict, "story": f"why [{name}]"} for name, verdict in expected.items()}
    truth.write_text(json.dumps({"columns": made}))
    report.write_text(json.dumps({"columns": [{"id": name, "verdict": verdict} for name, verdict in got.items()]}))
    return [str(truth), str(report)]


def test_all_agree(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    verdicts = {"C-1": "pass", "C-2": "fail"}
    assert main([*written(tmp_path, verdicts, verdicts), "--exit-code", "10"]) == 0
    printed = capsys.readouterr().out
    assert "All 2 verdicts" in printed
    assert "why [C-2]" in printed


@pytest.mark.parametrize(
    ("expected", "got", "exit_code"),
    [
        ({"C-1": "pass", "C-2": "fail"}, {"C-1": "pass", "C-2": "pass"}, 0),
        ({"C-1": "pass", "C-2": "fail"}, {"C-1": "pass"}, 10),
        ({"C-1": "fail"}, {"C-1": "fail", "C-2": "pass"}, 10),
        ({"C-1": "fail"}, {"C-1": "fail"}, 12),
        ({}, {}, 0),
    ],
    ids=["other verdict", "column missing", "column too many", "wrong exit code", "nothing checked"],
)
def test_any_difference_fails(tmp_path: Path, expected: dict[str, str], got: dict[str, str], exit_code: int) -> None:
    assert main([*written(tmp_path, expected, got), "--exit-code", str(exit_code)]) == 1


def test_no_report_fails(tmp_path: Path) -> None:
    arguments = written(tmp_path, {"C-1": "pass"}, {"C-1": "pass"})
    (tmp_path / "report.json").unlink()
    assert main([*arguments, "--exit-code", "0"]) == 1


def test_missing_columns_are_named(tmp_path: Path) -> None:
    truth, report = written(tmp_path, {"C-1": "pass"}, {"C-2": "fail"})
    assert compare(Path(truth), Path(report)) == [
        Comparison("C-2", "missing", "fail"),
        Comparison("C-1", "pass", "missing", "why [C-1]"),
    ]
