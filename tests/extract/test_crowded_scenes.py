"""Mouths and tops are found where other things in the picture are larger, or more."""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.rebars import extract_rebars
from aadm_workbench.extract.sleeves import extract_sleeves
from aadm_workbench.model import Array, Extraction
from tests.extract.crowded_scenes import bars_among_stubs, foot_before_wall, ring

SLEEVE_MM, BAR_MM = 40.0, 28.0


def far_off(found: Extraction, truth: Array) -> Array:
    """Distance in the plan (k,) mm of each true centre (k, 2) to the nearest found one."""
    seen = np.array([point.centre[:2] for point in found.points])
    return np.asarray(np.hypot(*(truth[:, None] - seen[None]).transpose(2, 0, 1)).min(axis=1))


def test_a_foot_before_a_larger_noisy_wall() -> None:
    for seed in (1, 2, 3):
        rng = np.random.default_rng(seed)
        centres = ring(140.0, 3) + rng.normal(0.0, 0.5, (8, 2))
        found = extract_sleeves(foot_before_wall(centres, SLEEVE_MM / 2, rng), SLEEVE_MM, rng)
        assert found.plane is not None
        assert abs(abs(found.plane.offset) - 700.0) < 0.5, found.reason
        assert len(found.points) == 8
        assert far_off(found, centres).max() < 0.3


def test_bars_that_tower_over_many_stubs() -> None:
    """What lies low and is as round as a bar is more than the bars are: no height is taken from it."""
    for seed in (4, 5, 6):
        rng = np.random.default_rng(seed)
        plan = ring(270.0, 4) + rng.normal(0.0, 0.8, (12, 2))
        tops = np.column_stack([plan, 1100.0 - rng.uniform(240.0, 275.0, 12)])
        stubs = np.column_stack([ring(360.0, 7), np.full(24, 1060.0)])
        found = extract_rebars(bars_among_stubs(tops, BAR_MM / 2, stubs, rng), BAR_MM, rng)
        assert far_off(found, plan).max() < 0.6


def test_bars_of_two_lengths() -> None:
    """Every other bar is 180 mm longer, as where joints are staggered, and seen from as far aside."""
    rng = np.random.default_rng(7)
    plan = ring(270.0, 4) + rng.normal(0.0, 0.8, (12, 2))
    tops = np.column_stack([plan, 1100.0 - np.where(np.arange(12) % 2, 120.0, 300.0)])
    found = extract_rebars(bars_among_stubs(tops, BAR_MM / 2, np.empty((0, 3)), rng), BAR_MM, rng)
    assert far_off(found, plan).max() < 0.6


def test_a_place_on_the_bare_floor_holds_no_bar() -> None:
    """A stub that hardly rises is round, but no connecting rebar: it is not measured, and cannot fail."""
    rng = np.random.default_rng(8)
    plan = ring(270.0, 4)
    tops = np.column_stack([plan[1:], np.full(11, 850.0)])
    stub = np.array([[*plan[0], 1090.0]])
    scan = bars_among_stubs(tops, BAR_MM / 2, stub, rng)
    found = extract_rebars(scan, BAR_MM, rng, places=stub)
    assert far_off(found, plan[1:]).max() < 0.6
    assert far_off(found, plan[:1]).min() > 100.0
