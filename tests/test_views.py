"""A foot larger than the camera's view, in two depth maps: one verdict."""

from __future__ import annotations

import numpy as np

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.check import CheckSettings, ColumnScans, check_column
from aadm_workbench.model import Verdict
from aadm_workbench.twin.camera import facing
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
