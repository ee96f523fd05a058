"""The move of a column over pairs that are made up: continuous in all it is told, and without what is bent."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from aadm_workbench.assembly.tolerances import load_profile, rules_for
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.hoisting.correction import correction_of
from aadm_workbench.hoisting.moved import repair_in_words
from aadm_workbench.model import Array, Correction
from aadm_workbench.twin.scenes import LAB

PLACES = np.array(LAB.centres())
RULE = rules_for(load_profile("cn"), "sleeve_rebar_distance")[0]
LIMIT_MM = 3.0
DESIGN = inline_design(
    "L-1", {"sleeve_diameter": 26.0, "rebar_diameter": 18.0, "size": [250.0, 250.0], "centres": PLACES.tolist()}
)
SCATTER = np.random.default_rng(5).normal(0.0, 0.4, PLACES.shape)


def moved(offsets: Array, u_mm: Array) -> Correction:
    """The correction of a column whose axes are those of its bars."""
    foot = SimpleNamespace(centres=PLACES, pose=np.zeros(3))
    hung: Any = SimpleNamespace(foot=foot, face=SimpleNamespace(axes=np.eye(3)))
    to_bars = np.array([[1.0, 0.0, 0.0], [0.0, 0.8, 0.6], [0.0, -0.6, 0.8]])
    hung.face.axes = to_bars
    covariance = np.diag(np.repeat(u_mm**2, 2))
    found: Any = SimpleNamespace(to_bars=to_bars, offsets=offsets, covariance=covariance)
    correction = correction_of(hung, found, RULE, DESIGN)
    assert correction is not None
    return correction


def way(correction: Correction) -> Array:
    """The move (3,), its turn in mm at the rim."""
    return np.array([correction.dx_mm, correction.dy_mm, np.radians(correction.yaw_deg) * np.abs(PLACES).max()])


def smallest_largest(offsets: Array) -> Array:
    """The same by another program's search."""
    rim = np.abs(PLACES).max()

    def largest(move: Array) -> float:
        angle = move[2] / rim
        cosine, sine = np.cos(angle), np.sin(angle)
        placed = PLACES @ np.array([[cosine, sine], [-sine, cosine]]) + move[:2]
        return float(np.hypot(*(placed - PLACES - offsets).T).max())

    start = np.append(offsets.mean(axis=0), 0.0)
    for _ in range(3):
        start = minimize(largest, start, method="Nelder-Mead", options={"xatol": 1e-6, "fatol": 1e-9}).x
    return np.asarray(start)


def test_known_pairs_have_the_move_with_the_smallest_largest_distance() -> None:
    found = moved(SCATTER, np.full(12, 0.1))
    np.testing.assert_allclose(way(found), smallest_largest(SCATTER), atol=2e-3)
    assert len(found.over) == 12
    assert found.repairs == ()


def test_a_pair_of_which_less_and_less_is_known_leaves_without_a_jump() -> None:
    offsets = SCATTER.copy()
    offsets[6] += [1.6, 1.2]  # it decides as long as it counts
    ways = [way(moved(offsets, np.where(np.arange(12) == 6, u, 0.1))) for u in np.arange(0.05, 0.6, 0.01)]
    steps = np.abs(np.diff(ways, axis=0)).max(axis=1)
    assert np.abs(ways[0] - ways[-1]).max() > 0.3
    assert steps.max() < 0.2
    without = np.delete(np.arange(12), 6)
    lone = moved(offsets, np.where(np.arange(12) == 6, 0.7, 0.1))
    assert lone.over == tuple(DESIGN.sleeves[k].label for k in without)


def test_the_move_follows_its_pairs_and_no_faster() -> None:
    rng = np.random.default_rng(9)
    u_mm = rng.uniform(0.05, 0.6, 12)
    plain = way(moved(SCATTER, u_mm))
    for _ in range(8):
        other = moved(SCATTER + rng.uniform(-0.01, 0.01, SCATTER.shape), u_mm * rng.uniform(0.98, 1.02, 12))
        assert np.abs(way(other) - plain).max() < 0.05


def test_a_bar_that_is_bent_too_far_is_left_out_and_has_a_repair() -> None:
    bend = np.array([8.0, -7.0])
    offsets = SCATTER.copy()
    offsets[3] += bend
    found = moved(offsets, np.full(12, 0.1))
    (repair,) = found.repairs
    assert repair.label == DESIGN.rebars[3].label
    others = np.arange(12) != 3
    move = smallest_largest(np.where(others[:, None], SCATTER, offsets))
    assert DESIGN.sleeves[3].label not in found.over
    assert np.hypot(found.dx_mm - move[0], found.dy_mm - move[1]) > 1.0, "not drawn towards it"
    plain = way(moved(SCATTER, np.full(12, 0.1)))
    assert np.abs(way(found) - plain).max() < 0.3
    assert (repair.dx_mm, repair.dy_mm) == pytest.approx(tuple(-bend), abs=1.0)
    # R1 stands at -x-y, and labels run counter-clockwise: -x is the side of R10 to R1, +y that of R7 to R10
    assert [(part.first, part.last) for part in repair.towards] == [("R10", "R1"), ("R7", "R10")]
    assert [part.mm for part in repair.towards] == pytest.approx([-repair.dx_mm, repair.dy_mm])
    said = repair_in_words(repair)
    assert f"{repair.towards[0].mm:.1f} mm towards the side of R10 to R1" in said
    assert "x, y" not in said


def test_a_bar_that_a_move_still_reaches_is_not_left_out() -> None:
    offsets = SCATTER.copy()
    offsets[3] += [3.0, -2.0]
    found = moved(offsets, np.full(12, 0.1))
    assert (found.left_mm or 9.0) < LIMIT_MM
    assert found.repairs == ()
    np.testing.assert_allclose(way(found), smallest_largest(offsets), atol=2e-3)


def test_a_bar_that_is_bent_more_and_more_leaves_without_a_jump() -> None:
    towards = np.array([0.8, -0.6])
    ways = []
    for bend in np.arange(0.0, 14.0, 0.25):
        offsets = SCATTER.copy()
        offsets[3] += bend * towards
        ways.append(way(moved(offsets, np.full(12, 0.1))))
    assert np.abs(np.diff(ways, axis=0)).max() < 0.9


def test_half_of_the_bars_astray_are_no_repairs() -> None:
    offsets = SCATTER.copy()
    offsets[::2] += np.random.default_rng(2).normal(0.0, 15.0, (6, 2))
    assert moved(offsets, np.full(12, 0.1)).repairs == ()


def test_the_three_that_are_known_best_always_decide() -> None:
    u_mm = np.full(12, 0.9)
    u_mm[[0, 4, 8]] = 0.4
    assert {DESIGN.sleeves[k].label for k in (0, 4, 8)} <= set(moved(SCATTER, u_mm).over)
