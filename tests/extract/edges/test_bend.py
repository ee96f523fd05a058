"""How a camera bends surfaces at edges: what is stated of it, against how far it scatters from picture to picture."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.extract.edges.bend import Bend, bend_at_edges
from aadm_workbench.extract.edges.seen_disc import SightLines
from aadm_workbench.model import Array

RADIUS_MM, PITCH_MM, NOISE_MM = 10.0, 0.75, 0.4
AROUND = np.array([(0.06, 0.0), (-0.06, 0.0), (0.0, 0.06), (0.0, -0.06)])
ONE_WAY = np.array([(0.060, 0.002), (0.064, 0.006), (0.058, -0.005), (0.066, 0.001)])


def tops(slopes: Array, seed: int, bent_mm: float = 0.0) -> Bend:
    """Four tops with noise alone, or bent up towards +x over the last three pixels, as a picture out of focus is."""
    rng = np.random.default_rng(seed)
    x, y = np.meshgrid(np.arange(-12.0, 12.1, PITCH_MM), np.arange(-12.0, 12.1, PITCH_MM))
    x, y = (np.tile(one.ravel(), (len(slopes), 1)).astype(np.float32) for one in (x, y))
    far = np.hypot(x, y)
    near_edge = np.clip(1.0 - (RADIUS_MM - far) / (4.0 * PITCH_MM), 0.0, 1.0)
    height = rng.normal(0.0, NOISE_MM, x.shape) + bent_mm * near_edge * x / np.maximum(far, 0.1)
    height = np.where(far < RADIUS_MM, height, np.nan).astype(np.float32)
    return bend_at_edges(SightLines(x, y, height, slopes), np.zeros((len(slopes), 2)), RADIUS_MM, PITCH_MM, -1.0)


@pytest.mark.parametrize("slopes", [AROUND, ONE_WAY])
def test_a_bend_scatters_as_is_stated_however_the_discs_are_seen(slopes: Array) -> None:
    seen = [tops(slopes, seed) for seed in range(60)]
    scatter = np.sqrt(np.linalg.eigvalsh(np.cov(np.array([one.towards for one in seen]).T))[-1])
    stated = np.median([one.apart_u_mm for one in seen])
    assert 0.7 < scatter / stated < 1.4


def test_a_bend_that_may_be_a_chamfer_refuses_no_picture_and_one_that_may_not_does() -> None:
    assert not any(tops(ONE_WAY, seed, 1.5).blurred for seed in range(20))
    assert all(tops(AROUND, seed, 2.5).blurred for seed in range(20))


def mixing_tops(seed: int) -> Bend:
    """Four thin tops in focus: bent over the last pixel; mixed pixels, towards nowhere, scatter farther in.

    Closed form; each top is seen along a direction of its own.
    """
    rng = np.random.default_rng([7, seed])
    radius_mm, pitch_mm = 6.7, 0.275
    x, y = np.meshgrid(np.arange(-8.0, 8.1, pitch_mm), np.arange(-8.0, 8.1, pitch_mm))
    x, y = (np.tile(one.ravel(), (len(AROUND), 1)).astype(np.float32) for one in (x, y))
    far = np.hypot(x, y)
    behind = (radius_mm - far) / pitch_mm
    scatter = np.where(behind < 1.5, 0.4, np.where(behind < 2.6, 0.3, 0.06))
    bend = 0.65 * np.clip(1.5 - behind, 0.0, 1.0) * x / np.maximum(far, 0.1)
    height = np.where(behind > 0.0, bend + scatter * rng.normal(size=x.shape), np.nan).astype(np.float32)
    return bend_at_edges(SightLines(x, y, height, AROUND), np.zeros((4, 2)), radius_mm, pitch_mm, -1.0)


def test_mixed_pixels_that_scatter_are_no_blur() -> None:
    seen = [mixing_tops(seed) for seed in range(40)]
    assert np.mean([one.bent for one in seen]) > 0.9
    assert not any(one.blurred for one in seen)
