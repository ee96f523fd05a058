"""What a check found, in a FreeCAD document: the column's part of report.json, and its main numbers as properties.

The module path and the class name are written into users' files: neither may change.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import FreeCAD

from aadm_workbench.document.column import attach_view, show_restored
from aadm_workbench.document.display.setting import setting_said
from aadm_workbench.document.places import move_to
from aadm_workbench.document.properties import HIDDEN, READ_ONLY, Property, apply_properties
from aadm_workbench.document.schema import SCHEMA, SCHEMA_PROPERTY, bring_up_to_date
from aadm_workbench.document.stateless import Stateless
from aadm_workbench.document.words import in_words
from aadm_workbench.report.shown_pose import shown_pose

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
_RESULT, _SETTING = "AADM result", "AADM setting"
_SETTING_TEXTS = (
    ("Top", QT_TRANSLATE_NOOP("App::Property", "Where the top comes to, against what, with its standard uncertainty")),
    ("TopVerdict", QT_TRANSLATE_NOOP("App::Property", "Verdict on the top of the set column")),
    (
        "SetPose",
        QT_TRANSLATE_NOOP("App::Property", "Pose in the play that leads the tower back to the grid, for the job"),
    ),
)
"""Of a job with [stack]; texts, so that what is not predicted is empty and never 0 mm."""
PROPERTIES = (
    SCHEMA_PROPERTY,
    Property(
        "App::PropertyString",
        "Verdict",
        _RESULT,
        QT_TRANSLATE_NOOP("App::Property", "pass, fail, inconclusive, not_measured or error"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyString",
        "GoesOn",
        _RESULT,
        QT_TRANSLATE_NOOP("App::Property", "Verdict of the trial assembly alone"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyStringList",
        "Reasons",
        _RESULT,
        QT_TRANSLATE_NOOP("App::Property", "What stands against it"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyDistance",
        "LargestSleeveDeviation",
        _RESULT,
        QT_TRANSLATE_NOOP("App::Property", "Largest deviation of a sleeve from its design place"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyDistance",
        "LargestRebarDeviation",
        _RESULT,
        QT_TRANSLATE_NOOP("App::Property", "Largest deviation of a rebar from its design place"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyDistance",
        "LargestPairDistance",
        _RESULT,
        QT_TRANSLATE_NOOP(
            "App::Property", "Largest distance of a rebar from its sleeve in the best position (minimax)"
        ),
        mode=READ_ONLY,
    ),
    *(Property("App::PropertyString", name, _SETTING, text, mode=READ_ONLY) for name, text in _SETTING_TEXTS),
    Property(
        "App::PropertyString",
        "CheckedAt",
        _RESULT,
        QT_TRANSLATE_NOOP("App::Property", "When it was checked (UTC), where that is known"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyString",
        "Tool",
        _RESULT,
        QT_TRANSLATE_NOOP("App::Property", "Program and version that it was checked with"),
        mode=READ_ONLY,
    ),
    Property("App::PropertyString", "Report", _RESULT, QT_TRANSLATE_NOOP("App::Property", "The report"), mode=HIDDEN),
    Property("App::PropertyString", "Job", _RESULT, QT_TRANSLATE_NOOP("App::Property", "The job's part"), mode=HIDDEN),
)
JOB_KEYS = ("schema", "tool", "job", "capture", "model", "profile")


class Result(Stateless):
    """Proxy of a result."""

    Type = "AADM::Result"

    def onDocumentRestored(self, obj: Any) -> None:
        """Bring a result of an earlier version up to date, and give it its view."""
        bring_up_to_date(obj, PROPERTIES)
        show_restored(obj, "result_view", "ResultView")

    def execute(self, obj: Any) -> None:
        """Everything is kept; nothing is computed."""

    def follow(self, obj: Any, placement: FreeCAD.Placement) -> None:
        """Stand where the column stands."""
        move_to(obj, placement)


def make_result(column: Any, report: Mapping[str, Any], found: Mapping[str, Any], checked_at: str = "") -> Any:
    """Give a column its result; an earlier one is replaced.

    Parameters
    ----------
    report
        A whole report.json, for what it says of job, tool and profile.
    found
        The column's entry in its ``columns``.
    checked_at
        When, in UTC; empty where nobody knows.
    """
    result = column.Result
    is_new = result is None
    if is_new:
        result = column.Document.addObject("App::GeometryPython", "AADM_Result")
        result.Proxy = Result()
        apply_properties(result, PROPERTIES)
        result.Schema = SCHEMA
        column.Result = result
    result.Report = json.dumps(found, ensure_ascii=False, separators=(",", ":"))
    result.Job = json.dumps({key: report.get(key) for key in JOB_KEYS}, ensure_ascii=False, separators=(",", ":"))
    result.Verdict = str(found["verdict"])
    result.GoesOn = str(found.get("goes_on") or "not_assessed")
    result.Reasons = [str(reason) for reason in found.get("reasons") or ()]
    result.LargestSleeveDeviation = _largest(found.get("sleeves"), "points", "deviation_mm")
    result.LargestRebarDeviation = _largest(found.get("rebars"), "points", "deviation_mm")
    best = shown_pose(found.get("trial_assembly"))
    result.LargestPairDistance = _largest(best, "pairs", "distance_mm")
    said = setting_said(found.get("setting"))
    result.Top, result.TopVerdict, result.SetPose = said.top, said.verdict, said.set_pose
    tool = report.get("tool") or {}
    result.Tool = f"{tool.get('name', 'aadm')} {tool.get('version', '')}".strip()
    result.CheckedAt = checked_at
    result.Label = f"{column.ColumnId}: {in_words(result.Verdict)}"
    result.Proxy.follow(result, column.Placement)
    if is_new:
        attach_view(result, "result_view", "ResultView")
    return result


def is_result(obj: Any) -> bool:
    """Whether an object is a result of this workbench."""
    return getattr(getattr(obj, "Proxy", None), "Type", "") == Result.Type


def found_of(result: Any) -> dict[str, Any]:
    """The column's entry of report.json that a result keeps; empty where it keeps none."""
    return json.loads(result.Report) if result.Report else {}


def job_of(result: Any) -> dict[str, Any]:
    """What report.json says of job, tool and profile."""
    return json.loads(result.Job) if result.Job else {}


def _largest(group: Mapping[str, Any] | None, entries: str, key: str) -> float:
    values = [float(entry[key]) for entry in (group or {}).get(entries, ()) if entry.get(key) is not None]
    return max(values, default=0.0)
