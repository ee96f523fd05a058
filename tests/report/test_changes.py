"""What changed between two inspections: noise is no change, a moved bar and a new verdict are."""

import copy
import json
import math
from typing import Any

import numpy as np
import pytest

from aadm_workbench.report.changes import COVERAGE, compare_reports
from aadm_workbench.report.json import encode
from tests.report.checked_floor import Case, floor_report
from tests.report.typed import typed


def test_nothing_changed(floor: dict[str, Any]) -> None:
    changes = compare_reports(typed(floor), typed(copy.deepcopy(floor)))
    assert not changes.any_change
    assert len(changes.unchanged) == 8
    assert changes.inputs == ()


def test_new_missing_worse_better(floor: dict[str, Any]) -> None:
    later = copy.deepcopy(floor)
    repaired, spoilt = later["columns"][2], later["columns"][0]
    repaired |= {"verdict": "pass", "goes_on": "pass", "reasons": []}
    spoilt |= {"goes_on": "fail"}
    del later["columns"][6]
    later["columns"].append(copy.deepcopy(floor["columns"][1]) | {"id": "C-9"})
    changes = compare_reports(typed(floor), typed(later))
    assert changes.new == ("C-9",)
    assert changes.missing == ("C-7",)
    assert [(change.id, change.trend) for change in changes.changed] == [("C-1", "worse"), ("C-3", "better")]
    assert changes.any_worse
    assert changes.changed[1].gone_reasons[0].startswith("R1 is")


def test_a_bar_that_was_bent_is_seen(floor: dict[str, Any]) -> None:
    later = copy.deepcopy(floor)
    point = later["columns"][0]["rebars"]["points"][3]
    point["offset_mm"][0] += 1.0
    (change,) = compare_reports(typed(floor), typed(later)).changed
    assert change.trend == "same"
    (moved,) = change.points
    assert moved.label == point["label"]
    assert moved.moved_mm == pytest.approx(1.0)
    assert moved.u_mm == pytest.approx(math.hypot(point["u_mm"], point["u_mm"]))


def test_noise_is_no_change() -> None:
    """Of points that did not move, 5 % may differ by more; a bound of the binomial law at 1e-6 for 24 × 20 points."""
    rng = np.random.default_rng(8)
    base = floor_report(Case("C-1", "A/1"))
    moved = 0
    for _ in range(20):
        first, second = copy.deepcopy(base), copy.deepcopy(base)
        for report in (first, second):
            for kind in ("sleeves", "rebars"):
                for point in report["columns"][0][kind]["points"]:
                    noise = rng.normal(0.0, point["u_mm"], 2)
                    point["offset_mm"] = [a + b for a, b in zip(point["offset_mm"], noise, strict=True)]
        moved += sum(len(change.points) for change in compare_reports(typed(first), typed(second)).changed)
    assert 5 <= moved <= 50
    assert pytest.approx(math.sqrt(-2.0 * math.log(0.05)), abs=1e-3) == COVERAGE


def test_a_point_that_is_lost_or_found(floor: dict[str, Any]) -> None:
    later = copy.deepcopy(floor)
    later["columns"][0]["sleeves"]["points"][5] |= {"offset_mm": None, "verdict": "not_measured"}
    (change,) = compare_reports(typed(floor), typed(later)).changed
    assert change.points[0].to_mm is None
    assert change.points[0].to_verdict == "not_measured"
    assert json.loads(encode(change))["points"][0]["moved_mm"] is None


def test_other_inputs_are_named(floor: dict[str, Any]) -> None:
    later = copy.deepcopy(floor) | {"model": None}
    later["profile"]["name"] = "gb"
    assert len(compare_reports(typed(floor), typed(later)).inputs) == 2
