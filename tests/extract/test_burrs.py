"""Burrs on one side of tops: outlines by a closed formula, their shift by an algebraic circle fit (Kåsa)."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.extract.circle import Outlines
from aadm_workbench.extract.tops import burr_u_mm
from aadm_workbench.model import Array

ANGLE = np.linspace(0.0, 2.0 * np.pi, 120, endpoint=False)
REACH_95 = 2.448


def outline(radius_mm: float, burr_mm: float, towards: float) -> Array:
    radius = radius_mm + burr_mm * np.clip(np.cos(ANGLE - towards), 0.0, None)
    return np.stack([radius * np.cos(ANGLE), radius * np.sin(ANGLE)], axis=1)


def shift_mm(xy: Array) -> float:
    system = np.column_stack([2.0 * xy, np.ones(len(xy))])
    answer = np.linalg.lstsq(system, (xy**2).sum(axis=1), rcond=None)[0]
    return float(np.hypot(*answer[:2]))


def group(burrs_mm: list[float], seed: int) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    xy = np.stack([outline(9.65 + rng.normal(0.0, 0.05), burr, rng.uniform(0.0, 2.0 * np.pi)) for burr in burrs_mm])
    xy += rng.normal(0.0, 0.05, xy.shape)
    u_mm = burr_u_mm(Outlines(xy, np.ones(xy.shape[:2], bool)), np.zeros((len(xy), 2)), 9.65)
    return u_mm, np.array([shift_mm(one) for one in xy])


@pytest.mark.parametrize(("burred", "share"), [(1, 0.95), (3, 0.95), (6, 0.95), (8, 0.9)])
def test_what_a_burr_moves_lies_in_the_region_be_it_on_most_of_the_group(burred: int, share: float) -> None:
    inside = []
    for seed in range(20):
        burrs = np.random.default_rng(seed).uniform(0.6, 1.4, burred).tolist() + [0.0] * (12 - burred)
        u_mm, moved_mm = group(burrs, seed)
        inside += (REACH_95 * np.hypot(u_mm, 0.05) > moved_mm)[:burred].tolist()
    assert np.mean(inside) > share


def test_sound_bars_hardly_ever_count_as_burred() -> None:
    counted = np.concatenate([group([0.0] * 12, seed)[0] > 0.0 for seed in range(60)])
    assert counted.mean() < 0.06


def test_a_broken_top_makes_no_burrs_of_the_others() -> None:
    u_mm, _ = group([0.0] * 11 + [-3.0], 4)
    assert (u_mm[:11] > 0.0).sum() <= 1


def test_of_three_bars_nobody_knows_which_are_alike() -> None:
    assert group([1.2, 0.0, 0.0], 1)[0].tolist() == [0.0, 0.0, 0.0]
