"""A foot larger than the camera's view, in two depth maps: one verdict."""

from __future__ import annotations

from functools import cache

import numpy as np

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import Array, ColumnReport, Verdict
from aadm_workbench.twin.camera import facing
from aadm_workbench.twin.parts import Foot, SleeveAsBuilt
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import FIELD, random_foot
from aadm_workbench.twin.truth import sample_design
from tests.scenes import quiet_noise


def view(foot: object, x: float, seed: int) -> TrueScan:
    """A camera 900 mm in front of the foot: its picture is 700 mm wide and 440 mm high, turned upright."""
    pose = facing(
        np.array([x, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0]), 900.0, (0.02, 0.01), 0.0
    )
    return scan_of(foot, pose, quiet_noise(), np.random.default_rng(seed))  # type: ignore[arg-type]


def test_two_views_of_a_large_foot_are_merged() -> None:
    foot = random_foot(FIELD, np.random.default_rng(8), 0.3)
    views = [view(foot, -115.0, 1), view(foot, 115.0, 2)]
    settings = CheckSettings(load_profile("cn"))
    alone = check_column(sample_design(FIELD), ColumnScans((views[0].scan("a"),), sleeves_up_deg=0.0), settings)
    assert alone.verdict is Verdict.NOT_MEASURED
    both = ColumnScans((views[0].scan("a"), views[1].scan("b")), sleeves_up_deg=0.0)
    report = check_column(sample_design(FIELD), both, settings)
    assert report.verdict is Verdict.PASS
    assert report.sleeves is not None
    assert (report.sleeves.found, report.sleeves.source) == (12, "a, b")
    true = views[0].points_scan()
    errors = [np.linalg.norm(np.array(p.scan_mm) - t) for p, t in zip(report.sleeves.points, true, strict=True)]
    assert max(errors) < 0.6


WALL = [[120.0 * (k - 4), 0.0] for k in range(9)]


def wall(seed: int) -> Foot:
    """Nine sleeves in a row, longer than the camera's view."""
    rng = np.random.default_rng(seed)
    sleeves = [SleeveAsBuilt(x + rng.normal(0, 0.5), y + rng.normal(0, 0.5), 36.0) for x, y in WALL]
    return Foot((1180.0, 200.0), tuple(sleeves))


@cache
def wall_seen(middle_mm: float, seed: int) -> TrueScan:
    """The wall from 900 mm, about a place along it."""
    across, up = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])
    pose = facing(np.array([middle_mm, 0.0, 0.0]), across, up, 900.0, (0.02, 0.01), 0.0)
    return scan_of(wall(2), pose, quiet_noise(), np.random.default_rng(seed))


def checked_wall(*middles_mm: float) -> tuple[ColumnReport, Array]:
    """The wall by a picture about each of some places; and its true centres in the first picture."""
    scans = [wall_seen(x, seed) for seed, x in enumerate(middles_mm)]
    design = inline_design("W-1", {"centres": WALL, "sleeve_diameter": 36.0, "size": [1180.0, 200.0]})
    named = tuple(scan.scan(f"view {k}") for k, scan in enumerate(scans))
    report = check_column(design, ColumnScans(named, sleeves_up_deg=90.0), CheckSettings(load_profile("cn")))
    return report, scans[0].points_scan()


def test_a_part_of_a_row_is_ambiguous_and_says_how_its_labels_may_be() -> None:
    report, _ = checked_wall(-200.0)
    assert report.verdict is Verdict.NOT_MEASURED
    assert report.sleeves is not None
    assert report.sleeves.fit is not None
    assert report.sleeves.fit.orientation == "ambiguous"
    first, *others = report.sleeves.fit.candidates
    assert first.labels == {label: label for label in first.labels}
    for other in others:
        steps = {int(there[1:]) - int(here[1:]) for here, there in other.labels.items()}
        assert len(steps) == 1
        assert steps != {0}
    assert "places of it: scan it with both of its ends" in report.reasons[0]


def test_two_views_of_a_row_are_joined_where_they_overlap() -> None:
    report, true = checked_wall(-200.0, 200.0)
    assert report.sleeves is not None
    assert report.sleeves.fit is not None
    assert (report.sleeves.found, report.sleeves.fit.orientation) == (9, "declared")
    errors = [np.linalg.norm(np.array(p.scan_mm) - t) for p, t in zip(report.sleeves.points, true, strict=True)]
    assert max(errors) < 0.4
