"""Truth beside each scan, and verdicts that follow from it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from aadm_workbench.model import Verdict
from aadm_workbench.twin.scenes import FIELD
from aadm_workbench.twin.truth import sample_design, true_verdicts
from tests.scenes import bar_scan, sleeve_scan


def perfect() -> tuple[object, object]:
    from aadm_workbench.twin.scenes import random_bars, random_foot

    rng = np.random.default_rng(0)
    return random_foot(FIELD, rng, 0.0), random_bars(FIELD, rng, 0.0)


def test_true_centres_of_sleeves_lie_on_the_foot_face_of_the_scan() -> None:
    truth = sleeve_scan("lab")
    T = truth.T_column_scan
    back = truth.points_scan() @ T[:3, :3].T + T[:3, 3]
    assert np.allclose(back, [point.centre for point in truth.points], atol=1e-9)
    assert np.allclose(back[:, 2], 0.0)


def test_the_scan_shows_a_bar_top_at_its_true_centre() -> None:
    truth = bar_scan("field")
    points = truth.scan().points
    camera = truth.camera
    for centre in truth.points_scan():
        u, v = camera.fx * centre[0] / centre[2] + camera.cx, camera.fy * centre[1] / centre[2] + camera.cy
        patch = points[round(v) - 3 : round(v) + 4, round(u) - 3 : round(u) + 4, 2]
        assert abs(np.nanmedian(patch) - centre[2]) < 0.5


def test_perfect_parts_pass_and_fit_without_deviation() -> None:
    foot, bars = perfect()
    verdicts = true_verdicts(sample_design(FIELD), foot, bars)  # type: ignore[arg-type]
    assert (verdicts.verdict, verdicts.goes_on) == (Verdict.PASS, Verdict.PASS)
    assert verdicts.least_squares is not None
    assert verdicts.least_squares["max_mm"] == 0.0


def test_a_plugged_sleeve_makes_the_trial_not_measured() -> None:
    foot, bars = perfect()
    plugged = replace(foot, sleeves=(replace(foot.sleeves[0], plugged_at=0.0), *foot.sleeves[1:]))  # type: ignore[attr-defined,type-var]
    verdicts = true_verdicts(sample_design(FIELD), plugged, bars)  # type: ignore[arg-type]
    assert (verdicts.verdict, verdicts.goes_on) == (Verdict.NOT_MEASURED, Verdict.NOT_MEASURED)
