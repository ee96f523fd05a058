"""A floor with bars has round dark places, and the ends of bores are round and bright: neither is what it seems.

Patches by the rays of a pinhole through planes and discs, without the virtual camera.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.extract.mouths import mouths_in
from aadm_workbench.extract.patches import Patches
from aadm_workbench.extract.rebars import extract_rebars
from aadm_workbench.extract.tops import tops_in
from aadm_workbench.model import Array
from aadm_workbench.twin.scenes import LAB, random_bars
from tests.scenes import lab_scan

EYE_MM, PITCH_MM = 1400.0, 0.5
GRID = np.arange(-30.0, 30.0, PITCH_MM) + 0.25
X, Y = (part.ravel() for part in np.meshgrid(GRID, GRID))
BESIDE = np.hypot(X, Y)
NOTHING = np.full(len(X), np.nan)


def patches_of(heights: list[Array], offset_mm: float = 60.0) -> Patches:
    """What is seen about places that stand so far off the camera's axis, heights (n,) where each line ends."""
    rng = np.random.default_rng(3)
    height = np.stack(heights) + rng.normal(0.0, 0.05, (len(heights), len(X)))
    turn = np.arange(len(heights)) * 2.0 * np.pi / len(heights)
    eye = np.column_stack([offset_mm * np.cos(turn), offset_mm * np.sin(turn), np.full(len(turn), EYE_MM)])
    share = height / EYE_MM
    x, y = (part + share * (eye[:, axis : axis + 1] - part) for axis, part in enumerate((X, Y)))
    seen = (np.tile(part, (len(heights), 1)).astype(np.float32) for part in (X, Y))
    return Patches(*(part.astype(np.float32) for part in (x, y, height)), eye, len(GRID), *seen)


def face_with(inside: Array, radius_mm: float = 13.0) -> Array:
    return np.where(radius_mm > BESIDE, inside, 0.0)


def kept_mouths(heights: list[Array]) -> list[int]:
    found = mouths_in(patches_of(heights), np.zeros((len(heights), 2)), 13.0, PITCH_MM)
    return [int(k) for k in found.kept]


def test_shadows_of_bars_on_a_floor_are_no_mouths() -> None:
    bar, shadow = face_with(np.full(len(X), 145.0)), face_with(NOTHING)
    assert kept_mouths([bar, shadow] * 4) == []
    assert kept_mouths([shadow] * 8) == list(range(8))


def test_a_single_mouth_behind_something_is_missed_and_no_other() -> None:
    hidden, open_ = face_with(np.full(len(X), 60.0)), face_with(NOTHING)
    assert kept_mouths([hidden, *[open_] * 7]) == list(range(1, 8))


def test_half_a_mouth_behind_a_hose_is_still_one() -> None:
    behind_hose = face_with(np.where(X > 2.0, 40.0, np.nan))
    assert kept_mouths([behind_hose, *[face_with(NOTHING)] * 3]) == [0, 1, 2, 3]


@pytest.mark.parametrize(("around_mm", "count"), [(130.0, 0), (40.0, 0), (-200.0, 4), (np.nan, 4)])
def test_a_disc_that_surfaces_stand_before_all_round_is_no_top(around_mm: float, count: int) -> None:
    about = np.where(BESIDE > 14.0, around_mm, np.nan)
    heights = [np.where(BESIDE < 11.0, 0.0, about)] * 4
    tops = tops_in(patches_of(heights), np.zeros((4, 2)), 11.0, np.random.default_rng(0))
    assert len(tops.place) == count


def test_a_higher_thing_on_one_side_leaves_a_top() -> None:
    beside = np.where((BESIDE > 14.0) & (X > 4.0), 90.0, -200.0)
    heights = [np.where(BESIDE < 11.0, 0.0, beside)] * 4
    assert len(tops_in(patches_of(heights), np.zeros((4, 2)), 11.0, np.random.default_rng(0)).place) == 4


@pytest.mark.parametrize("times", [0.88, 1.12])
def test_bars_of_another_size_are_measured_as_well_as_those_that_were_expected(times: float) -> None:
    setting = replace(LAB, bar_core=times * LAB.bar_core)
    scan = lab_scan(random_bars(setting, np.random.default_rng(5)), setting=setting)
    found = extract_rebars(scan.scan("bars"), LAB.bar_diameter, np.random.default_rng(0))
    true, across = scan.points_scan(), scan.T_column_scan[:2, :3]
    off = [min((across @ (one - point.centre) for one in true), key=np.linalg.norm) for point in found.points]
    assert len(off) == len(true)
    assert max(np.linalg.norm(one) for one in off) < 0.15
    assert np.median([point.diameter_mm for point in found.points]) == pytest.approx(setting.bar_core, abs=0.3)
