"""Reading report.json back: what it refuses, and that it says where and what to do."""

import copy
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.errors import ReportError
from aadm_workbench.report.json import encoded_report
from aadm_workbench.report.read import read_report
from tests.report.typed import typed


def written(folder: Path, text: str | bytes) -> Path:
    path = folder / "report.json"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return path


def test_what_was_written_is_read(floor: dict[str, Any], tmp_path: Path) -> None:
    for mark in ("", "\ufeff"):
        read = read_report(written(tmp_path, mark + json.dumps(floor)))
        assert json.loads(encoded_report(read)) == floor


def test_other_schema(floor: dict[str, Any], tmp_path: Path) -> None:
    with pytest.raises(ReportError, match=r"has schema 2, this version reads schema 1.*repeat the check"):
        read_report(written(tmp_path, json.dumps(floor | {"schema": 2})))


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.999])
def test_cut_off(floor: dict[str, Any], tmp_path: Path, share: float) -> None:
    text = json.dumps(floor, indent=1)
    with pytest.raises(ReportError, match=r"report\.json: (breaks off|is no JSON).*line \d+"):
        read_report(written(tmp_path, text[: int(share * len(text))]))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[1]", "has no key schema"),
        ('"schema"', "has no key schema"),
        (b"\xff\xfe\x00binary", "is no text"),
        ("{} {}", "is no JSON"),
        ('{"schema": 1, "columns": []}', "is not what a report holds"),
        ("[" * 100_000, "nested too deeply|is no JSON|breaks off|has no key schema"),
    ],
)
def test_no_report(tmp_path: Path, text: str | bytes, said: str) -> None:
    with pytest.raises(ReportError, match=said):
        read_report(written(tmp_path, text))


def test_place_of_a_slip_is_named(floor: dict[str, Any], tmp_path: Path) -> None:
    floor["columns"][2]["sleeves"]["points"][4]["deviation_mm"] = "2.4"
    with pytest.raises(ReportError, match=r"columns\.2\.sleeves\.points\.4\.deviation_mm is not what a report holds"):
        read_report(written(tmp_path, json.dumps(floor)))


def test_half_a_character_is_no_reason_to_fail(floor: dict[str, Any], tmp_path: Path) -> None:
    floor["columns"][0]["id"] = "C-\ud800"
    floor["columns"][1]["id"] = "\U0001f3d7"
    read = read_report(written(tmp_path, json.dumps(floor)))
    assert [column.id for column in read.columns[:2]] == ["C-?", "\U0001f3d7"]


def test_keys_of_later_versions_are_no_reason_to_refuse(floor: dict[str, Any], tmp_path: Path) -> None:
    """What is added to a schema does not break those who read it; what they know is as it was."""
    before = typed(copy.deepcopy(floor))
    point = floor["columns"][0]["sleeves"]["points"][0]
    for entry in (floor, floor["job"], floor["columns"][0], floor["columns"][0]["sleeves"], point):
        entry["of_a_later_version"] = "new" if entry is floor["job"] else {"deep": [1, None]}
    (tmp_path / "report.json").write_text(json.dumps(floor), encoding="utf-8")
    read = read_report(tmp_path / "report.json")
    assert encoded_report(replace(read, job=before.job)) == encoded_report(before)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(ReportError, match=r"cannot be read \(No such file"):
        read_report(tmp_path / "none.json")
