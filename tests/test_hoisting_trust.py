"""What a frame of a hanging column must not be believed for: an unknown turn, a wrong corner, a bar bent since."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
from aadm_workbench.hoisting.sequence.contradiction import contradiction_of
from aadm_workbench.hoisting.sequence.joint import measure_jointly, shapes_agree
from aadm_workbench.hoisting.turn_findings import with_contradiction
from aadm_workbench.model import HoistingMeasurement, Verdict
from aadm_workbench.report.words.reasons import in_both_languages
from aadm_workbench.twin.hoisting import Hang, HoistingScan, Stand
from aadm_workbench.twin.scenes import LAB, Setting
from aadm_workbench.twin.study.hoisting import design_of
from tests import hoisting_scenes as scenes

DESIGN = design_of(LAB)
BIG = Setting("1,400 mm", 1400.0, 640.0, 6, 40.0, 25.0, 24.1, 160.0, 2500.0)
OTHER = (1, -1)


def measured(truth: HoistingScan, near: tuple[int, int] | None, **before: object) -> HoistingMeasurement:
    settings = HoistingSettings(load_profile("cn"), "simple")
    scan = replace(truth.frame.scan(), source="frame.tiff")
    return measure_hoisting(scan, DESIGN, near=near, settings=settings, **before)  # type: ignore[arg-type]


def push(found: HoistingMeasurement) -> tuple[float, float]:
    assert found.report.correction is not None
    return found.report.correction.dx_mm, found.report.correction.dy_mm


def test_without_near_a_ring_gets_no_correction_and_no_pass() -> None:
    found = measured(scenes.usual(), None)
    assert found.report.orientation == "ambiguous"
    assert found.report.correction is None
    assert found.report.verdict is Verdict.INCONCLUSIVE
    assert "say near" in found.report.reasons[0]
    assert "请给出 near" in in_both_languages(found.report.reasons[0]).zh


def test_frames_of_two_corners_agree_where_near_is_right_and_contradict_where_it_is_not() -> None:
    first, second = scenes.from_corner(scenes.NEAR), scenes.from_corner(OTHER)
    here, there = measured(first, scenes.NEAR), measured(second, OTHER)
    assert push(here) == pytest.approx(push(there), abs=0.6)
    assert (here.report.near, there.report.near) == ("-x-y", "+x-y")
    assert contradiction_of(here, there, DESIGN) is None
    wrong = measured(second, scenes.NEAR)  # near once for both: what one key per column makes of it
    assert np.hypot(*(np.array(push(here)) - push(wrong))) > 8.0
    finding = contradiction_of(here, wrong, DESIGN)
    assert finding is not None
    assert finding.code == "hoisting_frames_contradict"
    held = with_contradiction(wrong.report, finding)
    assert held.correction is None
    assert held.verdict is not Verdict.PASS
    assert "相互矛盾" in in_both_languages(held.reasons[0]).zh


def test_a_bar_bent_since_its_scan_is_named_and_the_unseen_lose_their_certainty() -> None:
    truth, straight = scenes.bent_since(), scenes.usual()
    before = {
        "sleeves_before": scenes.before(straight.foot, 0.05, 0),
        "rebars_before": scenes.before(straight.bars, 0.05, 1),
    }
    found = measured(truth, scenes.NEAR, **before)
    (moved,) = found.report.moved_since
    assert moved.label == "R2"
    assert moved.moved_mm == pytest.approx(np.hypot(4.0, 4.5), abs=0.3)
    hidden = [pair for pair in found.report.pairs if not pair.rebar_seen]
    assert hidden
    assert all((pair.u_mm or 0.0) > 0.3 for pair in hidden)
    assert all(pair.verdict is not Verdict.PASS for pair in hidden)
    said = next(reason for reason in found.report.reasons if "since the scan" in reason)
    assert said.startswith("R2 moved 6.")
    assert all(pair.rebar in said.partition("look at")[2] for pair in hidden)
    assert "R2 移动了 6." in in_both_languages(said).zh
    assert found.report.rests_on_scans == tuple(pair.sleeve for pair in found.report.pairs if not pair.sleeve_seen)


def test_what_did_not_move_is_not_accused_and_a_pass_names_what_rests_on_older_scans() -> None:
    truth = scenes.usual()
    sleeves, rebars = scenes.before(truth.foot, 0.05, 0), scenes.before(truth.bars, 0.05, 1)
    found = measured(truth, scenes.NEAR, sleeves_before=sleeves, rebars_before=rebars)
    assert found.report.moved_since == ()
    hidden = [pair.rebar for pair in found.report.pairs if not pair.rebar_seen]
    assert set(hidden) <= set(found.report.rests_on_scans)
    assert found.report.verdict is Verdict.PASS
    assert f"{found.report.rests_on_scans[0]}" in found.report.reasons[-1]
    assert "measured before hoisting" in found.report.reasons[-1]


def test_far_and_flat_pairs_are_as_sure_as_they_say() -> None:
    """Down to 5° between view and foot, 2.5 m away: two of fourteen stood outside of their 95 % regions."""
    truth = scenes.frame(BIG, Hang(150.0, shift=(0.8, -0.6)), Stand(900.0, 90.0), 0)
    design = design_of(BIG)
    found = measure_hoisting(truth.frame.scan(), design, near=scenes.NEAR)
    errors = scenes.offset_errors(found, truth)
    within = [
        error @ np.linalg.solve(covariance, error) < 5.991
        for error, covariance, pair in zip(errors, found.covariances, found.report.pairs, strict=True)
        if pair.seen
    ]
    assert len(within) >= 13
    assert len(within) - sum(within) <= 1
    before = {"sleeves_before": scenes.before(truth.foot, 0.1, 0), "rebars_before": scenes.before(truth.bars, 0.1, 50)}
    joined = measure_hoisting(truth.frame.scan(), design, near=scenes.NEAR, **before)
    assert scenes.distance_errors(joined, truth, seen=False).mean() < 0.11  # all twenty, from one frame
    assert joined.report.moved_since == ()


def test_two_corners_together_know_what_one_of_them_hides() -> None:
    first, second = scenes.from_corner(scenes.NEAR), scenes.from_corner(OTHER)
    here, there = measured(first, scenes.NEAR), measured(second, OTHER)
    joint = measure_jointly([here, there], DESIGN, load_profile("cn"), "simple")
    assert joint is not None
    assert joint.report.joined == ("frame.tiff", "frame.tiff")
    hidden = [k for k, pair in enumerate(there.report.pairs) if not pair.seen and joint.report.pairs[k].seen]
    assert len(hidden) >= 2
    alone, together = (np.hypot(*scenes.offset_errors(found, second)[hidden].T) for found in (there, joint))
    assert together.max() < 0.35
    assert together.mean() < 0.5 * alone.mean()
    errors, covariances = scenes.offset_errors(joint, second), joint.covariances
    squares = [error @ np.linalg.solve(spread, error) for error, spread in zip(errors, covariances, strict=True)]
    assert max(squares) < 18.4  # one in ten thousand
    assert push(joint) == pytest.approx(push(there), abs=0.6)  # over more pairs
    assert shapes_agree(here, there) is True
    wrong = measured(second, scenes.NEAR)
    assert shapes_agree(here, wrong) is False
    assert measure_jointly([here, wrong], DESIGN, load_profile("cn"), "simple") is None
    assert measure_jointly([here, measured(second, None)], DESIGN, load_profile("cn"), "simple") is None
