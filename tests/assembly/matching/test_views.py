"""Several views of one group of points become one, through the points that they share."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.assembly.matching.match import Match, match_extraction
from aadm_workbench.assembly.matching.views import merge_views
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.model import Array, AssemblyPoint, Extraction, Kind

UP = np.array([0.0, 0.0, 1.0])
RING = [
    [x, y] for x in (-400.0, -133.0, 133.0, 400.0) for y in (-400.0, -133.0, 133.0, 400.0) if max(abs(x), abs(y)) > 390
]
DESIGN = inline_design("C-1", {"centres": RING, "sleeve_diameter": 40.0})


def pose(seed: int) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    turn = np.radians(rng.uniform(-4.0, 4.0))
    rotation = np.array([[np.cos(turn), -np.sin(turn), 0.0], [np.sin(turn), np.cos(turn), 0.0], [0.0, 0.0, 1.0]])
    return rotation, rng.uniform(-500.0, 500.0, 3)


def view(built: Array, chosen: list[int], seed: int, noise_mm: float = 0.0) -> tuple[Extraction, Match]:
    rotation, shift = pose(seed)
    rng = np.random.default_rng([seed, 1])
    points = tuple(
        AssemblyPoint(
            "", Kind.SLEEVE, rotation @ built[k] + shift + rng.normal(0, noise_mm, 3), UP, 40.0, np.eye(3) * 0.01
        )
        for k in chosen
    )
    found = Extraction(Kind.SLEEVE, "refined", points, None, UP, "truth")
    return found, match_extraction(DESIGN.sleeves, found, up=90.0, image_up_scan=np.array([0.0, 1.0, 0.0]))


def as_built() -> Array:
    rng = np.random.default_rng(0)
    return np.array([point.centre for point in DESIGN.sleeves]) + np.column_stack(
        [rng.normal(0.0, 1.0, (12, 2)), np.zeros(12)]
    )


def test_two_halves_give_the_whole_without_the_design() -> None:
    built = as_built()
    views = [view(built, list(range(8)), 1), view(built, [5, 6, 7, 8, 9, 10, 11, 0], 2)]
    merged, notes = merge_views([v[0] for v in views], [v[1] for v in views])
    assert notes == ()
    assert len(merged.points) == 12
    rotation, shift = pose(1)
    back = np.array([rotation.T @ (point.centre - shift) for point in merged.points])
    nearest = np.linalg.norm(built[:, None] - back[None], axis=2).min(axis=1)
    assert nearest.max() < 1e-6


def test_points_seen_twice_are_averaged() -> None:
    built = as_built()
    views = [view(built, list(range(12)), seed, 0.05) for seed in (1, 2)]
    merged, _ = merge_views([v[0] for v in views], [v[1] for v in views])
    assert len(merged.points) == 12
    rotation, shift = pose(1)
    errors = [
        np.array([rotation.T @ (p.centre - shift) for p in found.points]) - built for found in (views[0][0], merged)
    ]
    assert np.sqrt((errors[1] ** 2).mean()) < np.sqrt((errors[0] ** 2).mean())


def test_a_view_without_common_points_is_left_out_and_said() -> None:
    built = as_built()
    views = [view(built, list(range(7)), 1), view(built, [7, 8, 9, 10, 11, 0], 2)]
    merged, notes = merge_views([v[0] for v in views], [v[1] for v in views])
    assert len(merged.points) == 7
    assert "shares 1 points" in notes[0] or "left out" in notes[0]


def test_a_view_of_another_column_is_left_out() -> None:
    other = as_built()
    other[3, :2] += 6.0
    views = [view(as_built(), list(range(12)), 1), view(other, list(range(12)), 2)]
    merged, notes = merge_views([v[0] for v in views], [v[1] for v in views])
    assert len(merged.points) == 12
    assert "mm apart" in notes[0]


@pytest.mark.parametrize("count", [1, 2])
def test_what_no_view_shows_stays_missing(count: int) -> None:
    built = as_built()
    views = [view(built, list(range(8)), seed) for seed in range(1, count + 1)]
    merged, _ = merge_views([v[0] for v in views], [v[1] for v in views])
    assert len(merged.points) == 8
