"""The schema of report.json and its reader: made from the same types, they take and refuse the same."""

import copy
import json
import re
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.errors import ReportError
from aadm_workbench.model import Verdict
from aadm_workbench.report.json import encoded_report
from aadm_workbench.report.read import read_report
from batch.report_files import FORMATS, write_reports
from tests.report.test_json import CONTRACT, at, full_report, valid
from tests.report.typed import typed

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def document() -> Any:
    """report.json as it is read back."""
    return json.loads(encoded_report(full_report()))


def changed(path: str, value: Any) -> Callable[[Any], None]:
    """Puts something else in a place."""
    folder, _, key = path.rpartition(".")

    def change(document: Any) -> None:
        place = at(document, folder)
        place[int(key) if isinstance(place, list) else key] = value

    return change


SLIPS = [
    ("columns.0.verdict", "passed"),
    ("columns.0.goes_on", True),
    ("columns.0.reasons", [3]),
    ("columns.0.repair.action", "cut"),
    ("columns.0.rebars.absolute.control_points.0.scan_mm", None),
    ("mould_drift.0.columns", "C-1"),
    ("columns.0.sleeves.points.0.label", 1),
    ("columns.0.sleeves.points.0.deviation_mm", "2.4"),
    ("columns.0.sleeves.points.0.scan_mm", [1.0, 2.0]),
    ("columns.0.sleeves.fit.orientation", "guessed"),
    ("columns.0.sleeves.fit.T_design_scan", [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]),
    ("columns.0.sleeves.quality", {"a": {"mm": 1.0}}),
    ("columns.0.trial_assembly.minimax.pairs.0.rebar", None),
    ("columns.0.hoisting.0.correction.yaw_deg", "0.1"),
    ("profile.rules.0.source", "hearsay"),
    ("job", {"name": 7, "sha256": "c"}),
    ("schema", 2),
    ("columns", []),
]


@pytest.mark.parametrize(("path", "value"), SLIPS, ids=[f"{path}={value}" for path, value in SLIPS])
def test_schema_and_reader_notice(document: Any, path: str, value: Any) -> None:
    """One is made from the types, the other reads by them: neither takes what the other refuses."""
    slipped = copy.deepcopy(document)
    changed(path, value)(slipped)
    assert valid(document)
    assert not valid(slipped)
    typed(document)
    with pytest.raises(ReportError, match=re.escape(path)) as refused:
        typed(slipped)
    assert str(refused.value).startswith("made: ")


@pytest.mark.parametrize("path", [path for path in CONTRACT if path])
def test_keys_that_are_missed_are_named(document: Any, path: str) -> None:
    """Some have a default, for older reports lack them; of these, too, schema and reader say the same."""
    named = []
    for key in CONTRACT[path].split():
        slipped = copy.deepcopy(document)
        del at(slipped, path)[key]
        if valid(slipped):
            typed(slipped)
        else:
            with pytest.raises(ReportError, match=re.escape(f"made: {path} is not what a report holds (")) as refused:
                typed(slipped)
            assert f"`{key}`" in str(refused.value)
            named.append(key)
    assert len(named) >= len(CONTRACT[path].split()) // 4


def test_schema_is_made_from_the_types() -> None:
    made = runpy.run_path(str(ROOT / "docs" / "schema.py"))
    assert made["FILE"].read_text(encoding="utf-8") == made["text"](), "python docs/schema.py"


OLDER = sorted((Path(__file__).parent / "older_reports").glob("*.json"))


@pytest.mark.parametrize("path", OLDER, ids=[path.stem for path in OLDER])
def test_older_reports_are_read_and_shown(path: Path, tmp_path: Path) -> None:
    """Written by earlier versions of this program: what they did not know yet is what it is by default."""
    assert valid(json.loads(path.read_text(encoding="utf-8")))
    report = read_report(path)
    (full, bare) = report.columns
    assert (full.findings, bare.sleeves, bare.verdict) == ((), None, Verdict.ERROR)
    assert [pair.distance_mm for pair in full.pairs] == [0.1]
    formats = [name for name in FORMATS if name != "fcstd"]
    written = write_reports(report, formats, tmp_path)
    assert written.failed == {}
    assert all(path.stat().st_size > 500 for path in written.files.values())


def test_keys_of_newer_reports_are_passed_over(document: Any) -> None:
    def grown(value: Any) -> Any:
        if isinstance(value, list):
            return [grown(item) for item in value]
        return {key: grown(item) for key, item in value.items()} | EXTRA if isinstance(value, dict) else value

    newer = grown(document)
    for texts in (newer["tool"], newer["job"], newer["capture"], newer["model"], newer["summary"]):
        del texts["a_later_key"]
    for column in newer["columns"]:
        for group in (column["sleeves"], column["rebars"]):
            if group is not None:
                del group["quality"]["a_later_key"]
                for candidate in group["fit"]["candidates"]:
                    del candidate["labels"]["a_later_key"]
        for frame in column["hoisting"]:
            del frame["quality"]["a_later_key"]
    assert valid(newer)
    assert encoded_report(typed(newer)) == encoded_report(typed(document))


EXTRA = {"a_later_key": {"of": [1, "another", None]}}
