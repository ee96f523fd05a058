"""What bores just behind the face tell of the view: points by trigonometry, turned and moved by hand."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.extract.edges.edge_shift import view_by_walls
from aadm_workbench.extract.pooled.evidence import BracketLaw, Walls

RADIUS, BORES, POINTS = 18.0, 8, 200


def bores(rng: np.random.Generator, slope: np.ndarray, push_mm: float) -> Walls:
    """Walls about the origin on the side away from the camera, that light pushes along its ray."""
    away = np.arctan2(slope[:, 1], slope[:, 0])[:, None]
    turn = away + rng.uniform(-1.2, 1.2, (BORES, POINTS))
    depth = rng.uniform(1.0, 60.0, (BORES, POINTS))
    distance = RADIUS + rng.normal(0.0, 0.05, turn.shape)
    xy = np.stack([distance * np.cos(turn), distance * np.sin(turn)], axis=-1)
    rays = np.repeat(slope[:, None], POINTS, axis=1)
    return Walls(xy + push_mm * rays, depth, rays, np.ones(depth.shape, bool), BracketLaw(0.08, 0.4), 1.0)


@pytest.mark.parametrize("lacking_mm", [-1.2, 0.0, 1.5])
@pytest.mark.parametrize("push_mm", [0.0, 0.3])
def test_it_tells_how_far_centres_are_off_along_the_view(lacking_mm: float, push_mm: float) -> None:
    rng = np.random.default_rng(9)
    turn = rng.uniform(0.0, 2 * np.pi, BORES)
    slope = 0.2 * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    told = view_by_walls(bores(rng, slope, push_mm), -lacking_mm * slope, slope, RADIUS)
    assert told is not None
    assert told[0] == pytest.approx(lacking_mm + push_mm, abs=0.08)
    assert abs(told[0] - lacking_mm) < 2.0 * np.sqrt(told[1])


def test_without_a_wall_it_tells_nothing() -> None:
    rng = np.random.default_rng(9)
    slope = np.tile([0.2, 0.0], (BORES, 1))
    walls = bores(rng, slope, 0.0)
    deep = Walls(walls.xy, walls.depth + 20.0, walls.slope, walls.seen, walls.law, 1.0)
    assert view_by_walls(deep, np.zeros((BORES, 2)), slope, RADIUS) is None
