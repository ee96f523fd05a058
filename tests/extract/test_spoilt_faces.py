"""Mouths on faces that sites have spoilt: what is there is measured, and what looks like a mouth is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.extract.sleeves import extract_sleeves
from aadm_workbench.model import Array, Scan
from tests.extract.spoilt_face import SpoiltFoot, dish, grooves, mixing, scanned, true_points, with_slips

PLACES = np.array([(-75.0, -45.0), (0.0, -45.0), (75.0, -45.0), (-75.0, 45.0), (0.0, 45.0), (75.0, 45.0)])
FOOT = SpoiltFoot(PLACES, 18.0)


def misses_mm(scan: Scan, foot: SpoiltFoot, distance_mm: float, seed: int = 3) -> tuple[Array, int]:
    """How far (n,) the nearest centre that was found is off each mouth, and how many are farther off than 3 mm."""
    found = extract_sleeves(scan, 2.0 * foot.radius, np.random.default_rng(seed))
    centres = np.array([point.centre for point in found.points]).reshape(-1, 3)
    apart = np.hypot(*(centres[:, None, :2] - true_points(foot, distance_mm)[None, :, :2]).transpose(2, 0, 1))
    nearest = apart.min(axis=0) if len(centres) else np.full(len(foot.centres), np.inf)
    return nearest, int((apart.min(axis=1) > 3.0).sum()) if len(centres) else 0


def beside(place: Array, turn: float, off_mm: float) -> tuple[float, float]:
    return float(place[0] + off_mm * np.cos(turn)), float(place[1] + off_mm * np.sin(turn))


@pytest.mark.parametrize("seed", [1, 2])
def test_spalls_at_most_mouths_are_no_picture_out_of_focus(seed: int) -> None:
    rng = np.random.default_rng(seed)
    # All broken towards one side, as where a foot was set down askew: a camera that bends edges bends them alike.
    spalls = tuple(dish(*beside(place, 0.4, 20.0), float(rng.uniform(9.0, 13.0)), 4.0) for place in PLACES[:4])
    foot = replace(FOOT, spoilt=spalls)
    off, ghosts = misses_mm(scanned(foot, 1000.0, rng), foot, 1000.0)
    assert off.max() < 0.4
    assert ghosts == 0


@pytest.mark.parametrize("mixes", [False, True])
def test_a_plug_is_no_wall_of_its_bore(mixes: bool) -> None:
    foot, rng = replace(FOOT, plugged=frozenset({1, 4})), np.random.default_rng(4)
    scan = scanned(foot, 1100.0, rng)
    off, ghosts = misses_mm(mixing(scan, foot, 1100.0, rng) if mixes else scan, foot, 1100.0)
    assert off.max() < (0.3 if mixes else 0.2)
    assert ghosts == 0


@pytest.mark.parametrize("mixes", [False, True])
@pytest.mark.parametrize("before_mm", [45.0, 105.0])
def test_slips_of_the_fringes_before_unlit_bores_are_no_bars(before_mm: float, mixes: bool) -> None:
    rng = np.random.default_rng(8)
    foot = replace(FOOT, radius=16.0)
    plain = scanned(foot, 1800.0, rng)
    scan = with_slips(plain, foot, 1800.0, rng, end_mm=130.0, before_mm=before_mm)
    before = (scan.points[..., 2] < 1800.0 - 20.0).sum() / np.isnan(plain.points[..., 2]).sum()
    assert before > 0.5
    off, ghosts = misses_mm(mixing(scan, foot, 1800.0, rng) if mixes else scan, foot, 1800.0)
    assert off[PLACES[:, 0] < 70.0].max() < 0.5  # of the others nothing is lit behind the face
    assert ghosts == 0


@pytest.mark.parametrize("turn", [0.3, 2.0, 4.4])
def test_a_round_spall_beside_a_covered_mouth_is_no_mouth(turn: float) -> None:
    spalls = (dish(*beside(PLACES[1], turn, 20.0), 19.0, 4.2), dish(*beside(PLACES[5], turn + 2.0, 15.0), 22.0, 4.0))
    foot = replace(FOOT, spoilt=spalls, covered=frozenset({1, 5}))
    off, ghosts = misses_mm(scanned(foot, 1300.0, np.random.default_rng(5)), foot, 1300.0)
    assert off[[0, 2, 3, 4]].max() < 0.4
    assert ghosts == 0


def test_mouths_far_away_whose_walls_hardly_come_back_are_mouths() -> None:
    rng = np.random.default_rng(6)
    scan = scanned(FOOT, 1950.0, rng, noise_mm=0.3, lost=0.12, lost_in_bores=0.85)
    off, ghosts = misses_mm(scan, FOOT, 1950.0)
    assert off.max() < 0.6
    assert ghosts == 0


@pytest.mark.parametrize(("period_mm", "depth_mm"), [(37.0, 6.0), (52.0, 9.0)])
def test_keys_up_to_the_mouths_are_neither_mouths_nor_walls(period_mm: float, depth_mm: float) -> None:
    foot = replace(FOOT, spoilt=(grooves(period_mm, depth_mm),), land_mm=2.0)
    off, ghosts = misses_mm(scanned(foot, 1000.0, np.random.default_rng(7)), foot, 1000.0)
    assert off.max() < 0.6
    assert ghosts == 0


@pytest.mark.parametrize("mixes", [False, True])
@pytest.mark.parametrize("share", [0.1, 0.4])
def test_tape_over_a_part_of_a_mouth_moves_it_no_farther_than_is_said(share: float, mixes: bool) -> None:
    rng = np.random.default_rng([8, mixes])
    foot = replace(FOOT, taped={0: (0.3, share), 2: (2.1, share), 5: (4.4, share)})
    scan = scanned(foot, 1100.0, rng)
    scan = mixing(scan, foot, 1100.0, rng) if mixes else scan
    found = extract_sleeves(scan, 2.0 * foot.radius, np.random.default_rng(3))
    true = true_points(foot, 1100.0)
    assert len(found.points) >= 5
    for point in found.points:
        off = (true - point.centre)[np.hypot(*(true - point.centre)[:, :2].T).argmin(), :2]
        assert np.hypot(*off) < 0.4
        assert point.covariance is not None
        assert off @ np.linalg.solve(point.covariance[:2, :2], off) < 13.8  # one in a thousand
        assert abs(point.diameter_mm - 2.0 * foot.radius) < 0.4
