"""The probability that a pose exists, against a closed form, against single fits, and what it says of ignorance."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.best_pose import BestFit, fit_best_pose
from aadm_workbench.assembly.pose.minimax import MinimaxPose, fit_minimax
from aadm_workbench.assembly.pose.pose_probability import existence_of_a_pose, probability_of_a_pose
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.virtual import try_assembly
from aadm_workbench.model import Array, Verdict

CN = load_profile("cn")


def pairs_at(sleeves: Array, bars: Array, u_mm: float, **more: Any) -> list[Pair]:
    """Upright pairs with an uncertainty of rebar minus sleeve per axis."""
    zero = np.zeros(2)
    known = {"room_mm": None, "covariance": u_mm**2 * np.eye(2)} | more
    return [
        Pair(f"S{k}", f"R{k}", sleeve, bar, bar_shift=zero, sleeve_shift=zero, **known)
        for k, (sleeve, bar) in enumerate(zip(sleeves, bars, strict=True), 1)
    ]


@pytest.mark.parametrize("apart_mm", [5.2, 5.6, 6.2])
def test_probability_of_a_pose_of_two_opposite_pairs_is_that_of_their_stretch(apart_mm: float) -> None:
    """Two pairs fit where the distances of bars and of sleeves differ by at most twice the limit.

    Only that difference is free of the pose. Its law before the scan is drawn here, with tails in half of the draws,
    and each draw weighed by how well it explains what was measured: no chain, no pose, no covariance of a point.
    """
    centres = np.array([[-300.0, 0.0], [300.0, 0.0]])
    bars = centres + np.array([[-apart_mm / 2.0, 0.0], [apart_mm / 2.0, 0.0]])
    pairs = pairs_at(centres, bars, 0.15 * np.sqrt(2.0))
    found = probability_of_a_pose(pairs, np.full(2, 3.0), np.random.default_rng(1), 20_000)
    rng, many = np.random.default_rng(2), 2_000_000
    width = np.sqrt(2.0 * 0.7**2 / rng.gamma(0.5, 1.0, many))
    heavy = width * (rng.standard_t(4.0, many) - rng.standard_t(4.0, many))
    stretch = np.where(rng.uniform(size=many) < 0.5, heavy, width * rng.normal(0.0, np.sqrt(2.0), many))
    weight = np.exp(-0.5 * ((stretch - apart_mm) / 0.3) ** 2)
    assert found == pytest.approx(weight[np.abs(stretch) <= 6.0].sum() / weight.sum(), abs=0.012)
    # Far off, no prior helps: it is nearly what the normal law about the measured value says.
    plain = apart_mm + rng.normal(0.0, 0.3, many)
    assert found == pytest.approx((np.abs(plain) <= 6.0).mean(), abs=0.06)


def test_a_room_that_is_not_known_well_has_a_closed_form_too() -> None:
    """Centres exact, two opposite bars 2 mm off, and the room of both drawn about 2.05 mm: both must be above 2 mm."""
    centres = np.array([[-300.0, 0.0], [300.0, 0.0]])
    bars = centres + np.array([[-2.0, 0.0], [2.0, 0.0]])
    pairs = pairs_at(centres, bars, 0.0, room_mm=2.05, room_u_mm=0.1)
    found = probability_of_a_pose(pairs, np.full(2, 3.0), np.random.default_rng(1), 20_000)
    # The pose shares what both have: only their sum counts.
    draws = np.random.default_rng(2).normal(4.1, 0.1 * np.sqrt(2.0), 1_000_000)
    assert found == pytest.approx((draws >= 4.0).mean(), abs=0.015)


def test_a_lean_that_is_not_known_is_not_taken_as_exact() -> None:
    """Opposite bars in line with their sleeves, whose feet are each drawn by 0.8 mm about a room of 1 mm."""
    centres = np.array([[-300.0, 0.0], [300.0, 0.0], [0.0, 300.0], [0.0, -300.0]])
    sure = pairs_at(centres, centres, 0.01, room_mm=1.0)
    vague = pairs_at(centres, centres, 0.01, room_mm=1.0, bar_shift_covariance=0.8**2 * np.eye(2))
    limits = np.full(4, 3.0)
    assert probability_of_a_pose(sure, limits, np.random.default_rng(1)) == 1.0
    found = probability_of_a_pose(vague, limits, np.random.default_rng(1))
    assert found is not None
    # At best one bar is within its room with 1 - exp(-1/(2·0.64)).
    assert found <= 1.0 - np.exp(-1.0 / (2.0 * 0.64)) + 1e-9


def test_the_best_pose_decides_as_a_search_over_turns_and_shifts(build: Any, square: Array) -> None:
    """Distances, leans and rooms together, against a dense search that shares no code."""
    rng = np.random.default_rng(7)
    corners = square[::3, :2]
    for _ in range(6):
        bars = corners + rng.normal(0.0, 1.0, (4, 2))
        pairs = [
            replace(pair, bar_shift=rng.normal(0.0, 0.8, 2), sleeve_shift=rng.normal(0.0, 0.5, 2))
            for pair in pairs_at(corners, bars, 0.1, room_mm=2.6)
        ]
        fit = fit_best_pose(pairs, np.full(4, 3.0))
        assert isinstance(fit, BestFit)
        assert fit.ratio == pytest.approx(_searched(pairs, 3.0), abs=2e-3)
        assert fit.ratio <= _searched(pairs, 3.0) + 1e-9


def _searched(pairs: list[Pair], limit_mm: float) -> float:
    """Smallest largest ratio on a grid that is made finer about its best place."""
    best, at, width = np.inf, np.zeros(3), np.array([0.02, 4.0, 4.0])
    for _ in range(14):
        grid = np.stack(np.meshgrid(*(a + w * np.linspace(-1, 1, 9) for a, w in zip(at, width, strict=True))), axis=-1)
        trial = grid.reshape(-1, 3)
        worst = np.zeros(len(trial))
        cosine, sine = np.cos(trial[:, 0]), np.sin(trial[:, 0])

        def turned(v: Array, cosine: Array = cosine, sine: Array = sine) -> Array:
            return np.column_stack([cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]])

        for pair in pairs:
            top = turned(pair.rebar_xy) + trial[:, 1:] - pair.sleeve_xy
            foot = top - turned(pair.bar_shift)
            worst = np.maximum(worst, np.hypot(*top.T) / limit_mm)
            room = pair.room_mm or 0.0
            worst = np.maximum(worst, np.hypot(*foot.T) / room)
            worst = np.maximum(worst, np.hypot(*(top - pair.sleeve_shift).T) / room)
        if worst.min() < best:
            best, at = float(worst.min()), trial[int(worst.argmin())]
        width *= 0.5
    return best


def test_what_scatter_adds_to_the_largest_gap_is_taken_off_again(square: Array) -> None:
    """Trials whose truth is at its limit: half of them are feasible, and the mean probability must say so."""
    rng, limits = np.random.default_rng(3), np.full(12, 3.0)
    stated, true = [], []
    for _ in range(120):
        bars = square[:, :2] + rng.normal(0.0, 1.0, (12, 2))
        pose = fit_minimax(bars, square[:, :2], limits)
        assert isinstance(pose, MinimaxPose)
        scale = rng.uniform(0.85, 1.15)
        placed = square[:, :2] + (bars - square[:, :2]) * scale / pose.ratio
        exact = fit_minimax(placed, square[:, :2], limits)
        assert isinstance(exact, MinimaxPose)
        measured = placed + rng.normal(0.0, 0.3, (12, 2))
        stated.append(probability_of_a_pose(pairs_at(square[:, :2], measured, 0.3), limits, rng, 300) or 0.0)
        true.append(exact.ratio <= 1.0)
    # The share of feasible ones against the sum of what was stated, within three standard deviations of that sum.
    p = np.array(stated)
    assert abs(np.sum(true) - p.sum()) < 3.0 * np.sqrt((p * (1.0 - p)).sum())
    assert np.sum((p > 0.05) & (p < 0.95)) > 20


def test_a_pair_that_was_hardly_seen_never_makes_a_pass_or_a_fail(build: Any, square: Array) -> None:
    """All is within half of the limit, and two sleeves are known to 3 mm: inconclusive, and these are named."""
    design = build.column(square)
    bars = np.random.default_rng(4).normal(0.0, 0.5, (12, 2))
    sleeves, rebars = build.moved(design.sleeves, 0 * bars, 0.05), build.moved(design.rebars, bars, 0.05)
    for index in (2, 8):
        sleeves[index] = replace(sleeves[index], covariance=3.0**2 * np.eye(3))
    report = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    assert report.minimax is not None
    assert report.minimax.max_mm < 1.5
    assert report.verdict is Verdict.INCONCLUSIVE
    assert set(report.rescan) == {"S3", "S9"}
    assert any("rescan closer, above all S" in reason for reason in report.reasons)
    assert report.collisions == ()


@pytest.mark.parametrize(
    ("off_mm", "u_mm", "verdict"),
    [(3.1, 0.1, Verdict.PASS), (3.1, 0.15, Verdict.PASS), (0.0, 0.7, Verdict.PASS), (3.1, 0.7, Verdict.INCONCLUSIVE)],
)
def test_no_pass_rests_on_a_bar_seen_worse_standing_like_the_others(
    off_mm: float, u_mm: float, verdict: Verdict, build: Any, square: Array
) -> None:
    """R5 was found 3.1 mm further out; known as the others are, a pose is sure to suit it, known to 0.7 mm it is not.

    That the others stand off by 1.9 mm makes it likely all the same: the probability says so, and the verdict waits.
    """
    design = build.column(square)
    out = square[:, :2] / np.hypot(square[:, 0], square[:, 1])[:, None]
    bars = 1.9 * out * np.where(np.arange(12) % 3 == 0, -1.0, 1.0)[:, None]
    bars[4] = off_mm * out[4]
    sleeves, rebars = build.moved(design.sleeves, 0 * bars, 0.1), build.moved(design.rebars, bars, 0.1)
    sleeves[4], rebars[4] = build.moved(design.sleeves, 0 * bars, u_mm)[4], build.moved(design.rebars, bars, u_mm)[4]
    report = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    assert report.verdict is verdict
    assert (report.probability or 0.0) >= 0.95
    if verdict is Verdict.INCONCLUSIVE:
        assert len(report.rescan) == 1
        assert report.rescan[0] in {"R5", "S5"}
        assert any("what was hardly seen does not pass" in reason for reason in report.reasons)


def test_clearances_are_limits_of_the_pose_as_well(build: Any, square: Array) -> None:
    """One tight sleeve: the minimax pose touches, a pose a little aside does not, and that one is shown."""
    design = build.column(square, sleeve_mm=36.0)
    tight = list(design.sleeves)
    tight[6] = replace(tight[6], diameter_mm=25.5)
    design = replace(design, sleeves=tuple(tight))
    bars = np.zeros((12, 2))
    bars[6] = [2.4, 0.0]
    sleeves, rebars = build.moved(design.sleeves, 0 * bars), build.moved(design.rebars, bars)
    report = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    assert report.minimax is not None
    assert (report.minimax.pairs[6].clearance_mm or 0.0) < 0.0
    assert report.verdict is Verdict.PASS
    assert report.collisions == ()
    assert report.best is not None
    assert all((pair.room_mm or 0.0) > 0.0 for pair in report.best.pairs)
    assert report.margin == report.best.margin == pytest.approx(min(pair.margin or 0.0 for pair in report.best.pairs))


def test_no_covariance_no_probability(square: Array) -> None:
    pairs = pairs_at(square[:, :2], square[:, :2], 0.1)
    fit = fit_best_pose(pairs, np.full(12, 3.0))
    assert isinstance(fit, BestFit)
    pairs[4] = replace(pairs[4], covariance=None)
    assert existence_of_a_pose(pairs, np.full(12, 3.0), fit, np.random.default_rng(0)) is None
