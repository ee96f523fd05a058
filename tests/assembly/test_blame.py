"""Who is in the way: the one that is off, whatever least squares makes of its neighbours."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.blame import with_blame
from aadm_workbench.assembly.inspect import inspect_group
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.pose.eopa import EopaFit, fit_eopa_planar, robust_offsets, turn
from aadm_workbench.assembly.repair.bends import advise_repair
from aadm_workbench.assembly.tolerances import load_profile, sum_up
from aadm_workbench.assembly.trial.virtual import try_assembly
from aadm_workbench.model import Kind, Verdict
from aadm_workbench.report.words.reasons import in_both_languages

CN = load_profile("cn")


@pytest.mark.parametrize("seed", range(10))
def test_the_robust_fit_leaves_an_error_with_the_point_that_has_it(seed: int, square: Any) -> None:
    rng = np.random.default_rng(seed)
    design = square[:, :2]
    true = rng.normal(0.0, 0.3, (12, 2))
    wrong = rng.choice(12, 2, replace=False)
    true[wrong] += 7.5 * np.array([[1.0, 0.0], [0.6, 0.8]])
    measured = (design + true) @ turn(0.7).T + np.array([300.0, -80.0])
    off_mm = np.hypot(*robust_offsets(measured, design).T)
    assert off_mm[wrong] == pytest.approx(np.hypot(*true[wrong].T), abs=0.6)
    assert np.delete(off_mm, wrong).max() < 1.5
    squares = fit_eopa_planar(measured, design)
    assert isinstance(squares, EopaFit)
    assert np.hypot(*squares.residuals.T)[wrong].max() < off_mm[wrong].max()


@pytest.mark.parametrize("index", [4, 0, 8])
def test_the_bar_that_is_off_is_the_first_reason(index: int, build: Any, square: Any) -> None:
    design = build.column(square)
    rng = np.random.default_rng(index)
    bars = rng.normal(0.0, 0.3, (12, 2))
    bars[index] += [6.0, 4.5]
    sleeves, rebars = build.moved(design.sleeves, 0 * bars, 0.05), build.moved(design.rebars, bars, 0.05)
    trial = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    trial = with_blame(trial, advise_repair(design, sleeves, rebars, trial, CN, np.random.default_rng(0)))
    assert trial.verdict is Verdict.FAIL
    assert trial.in_the_way == (f"R{index + 1}",)
    _, _, reasons = sum_up(None, None, trial)
    assert reasons[0].startswith(f"R{index + 1} is in the way: it stands 7.")
    assert in_both_languages(reasons[0]).zh.startswith(f"R{index + 1} 挡住就位：偏离其余钢筋给出的位置 7.")
    assert len(set(reasons)) == len(reasons)


def test_a_sleeve_that_is_off_is_blamed_and_not_its_bar(build: Any, square: Any) -> None:
    design = build.column(square)
    mouths = np.zeros((12, 2))
    mouths[6] = [8.0, 8.0]
    sleeves, rebars = build.moved(design.sleeves, mouths, 0.05), build.moved(design.rebars, 0 * mouths, 0.05)
    trial = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    trial = with_blame(trial, advise_repair(design, sleeves, rebars, trial, CN, np.random.default_rng(0)))
    assert trial.in_the_way == ("S7",)
    assert "that the other sleeves give it" in trial.reasons[0]


def test_nothing_is_in_the_way_of_a_trial_that_does_not_fail(build: Any, square: Any) -> None:
    design = build.column(square)
    still = np.zeros((12, 2))
    sleeves, rebars = build.moved(design.sleeves, still, 0.05), build.moved(design.rebars, still, 0.05)
    trial = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    assert with_blame(trial, None).in_the_way == ()
    assert with_blame(replace(trial, verdict=Verdict.INCONCLUSIVE), None).in_the_way == ()


def test_a_group_names_the_one_that_is_off_before_its_innocent_neighbours(build: Any, square: Any) -> None:
    """On a ring of four, 9 mm of one bar leave more than 2 mm with each of the others by least squares."""
    corners = square[[0, 3, 6, 9]] * np.array([1.0, 1.0, 0.0])
    built = corners.copy()
    built[2, :2] += [9.0, 3.0]
    points = build.points_of(Kind.REBAR, corners, 20.0)
    seen = build.see(built, np.random.default_rng(1))
    found = build.extraction(Kind.REBAR, seen, 20.0, 0.02)
    match = match_extraction(points, found, up=np.array([0.0, 1.0]), image_up_scan=seen.image_up)
    report = inspect_group(points, found, match, CN)
    failing = [point.label for point in report.points if point.verdict is Verdict.FAIL]
    assert len(failing) > 1
    assert report.reasons[0].startswith("R3 stands 9.")
    assert "off the place that the other bars give it" in report.reasons[0]
