"""Feet and bars with more in the picture than these: a noisy wall behind, low stubs about the bars' own feet.

A camera with a wide view looks straight along; everything is a disc, a rectangle or a round wall, in closed form.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, Camera, Scan

CAMERA = Camera(640.0, 640.0, 399.5, 299.5, 800, 600)
_V, _U = np.mgrid[0:600, 0:800]
X, Y = (_U - CAMERA.cx) / CAMERA.fx, (_V - CAMERA.cy) / CAMERA.fy


def ring(half_mm: float, count: int) -> Array:
    """Places (n, 2) mm on the sides of a square, so many a side."""
    steps = np.linspace(-half_mm, half_mm, count)
    places = np.array([(x, y) for x in steps for y in steps])
    return places[np.abs(places).max(axis=1) > half_mm - 1.0]


def _far_wall(centre: Array, radius_mm: float, side: float) -> Array:
    """Depth at which each line of sight crosses a round wall along the view, on its near or far (±1) side."""
    a, b = X**2 + Y**2, X * centre[0] + Y * centre[1]
    inside = b**2 - a * (centre @ centre - radius_mm**2)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray((b + side * np.sqrt(inside)) / a)


def _scan(depth: Array, noise_mm: Array | float, lost: Array | float, rng: np.random.Generator) -> Scan:
    z = depth + noise_mm * rng.standard_normal(depth.shape)
    z[rng.random(depth.shape) < lost] = np.nan
    return Scan(np.stack([X * z, Y * z, z], -1).astype(np.float32), camera=CAMERA, viewpoint=np.zeros(3))


def foot_before_wall(centres: Array, radius_mm: float, rng: np.random.Generator) -> Scan:
    """A foot of 400 mm, 700 mm away, with open bores at some centres (k, 2) mm; a wall 500 mm behind it."""
    depth = np.full(X.shape, 1200.0)
    noise = 0.6 + 2.0 * np.hypot(X, Y)  # light falls off towards the corners
    lost = np.full(X.shape, 0.02)
    face = (np.abs(X * 700.0) < 200.0) & (np.abs(Y * 700.0) < 200.0)
    depth[face], noise[face] = 700.0, 0.06
    for centre in centres:
        mouth = np.hypot(X * 700.0 - centre[0], Y * 700.0 - centre[1]) < radius_mm
        depth[mouth], lost[mouth] = np.minimum(_far_wall(centre, radius_mm, 1.0), 950.0)[mouth], 0.3
    return _scan(depth, noise, lost, rng)


def bars_among_stubs(
    tops: Array, radius_mm: Array | float, stubs: Array, rng: np.random.Generator, length_mm: Array | float = np.inf
) -> Scan:
    """Bars with tops (k, 3) mm, and lower stubs (m, 3), on a floor 1,100 mm away, each of a radius and a length."""
    depth = np.full(X.shape, 1100.0)
    radii = np.broadcast_to(radius_mm, len(tops) + len(stubs))
    ends = np.broadcast_to(length_mm, len(radii)) + np.vstack([tops, stubs])[:, 2]
    for top, own_mm, end in zip(np.vstack([tops, stubs]), radii, ends, strict=True):
        disc = np.hypot(X * top[2] - top[0], Y * top[2] - top[1]) < own_mm
        side = _far_wall(top[:2], own_mm, -1.0)
        here = np.where(disc, top[2], np.where((side > top[2]) & (side < end), side, np.inf))
        depth = np.fmin(depth, here)
    return _scan(depth, 0.08, 0.003, rng)
