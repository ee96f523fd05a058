"""Fixtures of the assembly stage: patterns, as-built points in a scan frame, designs."""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Extraction, IntArray, Kind, Profile, Rule

UP = np.array([0.0, 1.0, 0.0])


def rectangle(nx: int, ny: int, half_x: float, half_y: float) -> Array:
    """(n, 3) centres of a rectangular ring, counter-clockwise from (-x, -y)."""
    x, y = np.linspace(-half_x, half_x, nx), np.linspace(-half_y, half_y, ny)
    walk = [*((u, -half_y) for u in x), *((half_x, v) for v in y[1:]), *((u, half_y) for u in x[::-1][1:])]
    walk += [(-half_x, v) for v in y[::-1][1:-1]]
    return np.array([(*point, 0.0) for point in walk])


def circle(n: int, radius: float) -> Array:
    """(n, 3) centres on a circle."""
    angle = np.arange(n) * 2.0 * np.pi / n
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 0.0 * angle])


def irregular(n: int, width: float, seed: int) -> Array:
    """(n, 3) centres without order, at least 60 mm apart."""
    rng = np.random.default_rng(seed)
    points: list[Array] = []
    while len(points) < n:
        point = rng.uniform(-width / 2.0, width / 2.0, 2)
        if all(np.hypot(*(point - other)) > 60.0 for other in points):
            points.append(point)
    flat = np.array(points)
    return np.column_stack([flat - flat.mean(axis=0), np.zeros(n)])


def rotation(rng: np.random.Generator) -> Array:
    """A random rotation (3, 3), determinant +1."""
    q, _ = np.linalg.qr(rng.standard_normal((3, 3)))
    return q * np.array([np.sign(np.linalg.det(q)), 1.0, 1.0])


@dataclass(frozen=True)
class Seen:
    """As-built points in a scan frame, with the truth: ``design_of`` (n,) is −1 for what is no design point."""

    points: Array
    design_of: IntArray
    vertical: Array
    image_up: Array
    turned: Array
    moved: Array

    def matched(self, count: int) -> list[int]:
        """What a right match says: for each design point the index of its measured one."""
        found = [-1] * count
        for index, design in enumerate(self.design_of.tolist()):
            if design >= 0:
                found[design] = index
        return found


def see(built: Array, rng: np.random.Generator, *, missing: tuple[int, ...] = (), extra: Array | None = None) -> Seen:
    """Points (n, 3) of the column frame as a camera finds them: anywhere, in any order, +y at the top of the image."""
    turned, moved = rotation(rng), rng.uniform(-2000.0, 2000.0, 3)
    kept = np.setdiff1d(np.arange(len(built)), missing)
    more = np.zeros((0, 3)) if extra is None else extra
    points = np.concatenate([built[kept], more])
    design_of = np.concatenate([kept, -np.ones(len(more), dtype=np.int64)])
    order = rng.permutation(len(points))
    return Seen(points[order] @ turned.T + moved, design_of[order], turned[:, 2], turned @ UP, turned, moved)


def points_of(
    kind: Kind, centres: Array, diameter_mm: float, covariance: Array | None = None, axis: Array | None = None
) -> tuple[AssemblyPoint, ...]:
    """Labelled points at (n, 3) centres."""
    upright = np.array([0.0, 0.0, 1.0]) if axis is None else axis
    return tuple(
        AssemblyPoint(f"{kind.letter}{number}", kind, centre, upright, diameter_mm, covariance)
        for number, centre in enumerate(centres, 1)
    )


def column(
    centres: Array, *, sleeve_mm: float = 36.0, rebar_mm: float = 20.0, outer_mm: float | None = None, **more: Any
) -> ColumnDesign:
    """A column whose sleeves stand at (n, 3) centres, bars 160 mm up inside them."""
    tops = centres + np.array([0.0, 0.0, 160.0])
    return ColumnDesign(
        "C-1",
        points_of(Kind.SLEEVE, centres, sleeve_mm),
        points_of(Kind.REBAR, tops, rebar_mm),
        rebar_outer_diameter_mm=outer_mm,
        **more,
    )


def moved(
    points: tuple[AssemblyPoint, ...], offsets: Array, u_mm: float | None = None, lean: Array | None = None
) -> list[AssemblyPoint | None]:
    """Design points as built: displaced by (n, 2), all leaning by (2,), with an uncertainty."""
    axis = np.array([*((0.0, 0.0) if lean is None else lean), 1.0])
    covariance = None if u_mm is None else np.eye(3) * u_mm**2
    return [
        replace(
            point,
            centre=point.centre + np.array([*offset, 0.0]),
            axis=axis / np.linalg.norm(axis),
            covariance=covariance,
        )
        for point, offset in zip(points, offsets, strict=True)
    ]


def extraction(kind: Kind, seen: Seen, diameter_mm: float, u_mm: float | None = 0.05, **more: Any) -> Extraction:
    """What an extraction of these points would be."""
    covariance = None if u_mm is None else np.eye(3) * u_mm**2
    found = tuple(AssemblyPoint("", kind, point, seen.vertical, diameter_mm, covariance) for point in seen.points)
    return Extraction(kind, "refined", found, None, seen.vertical, **more)


def profile(*rules: Rule) -> Profile:
    """A profile of these rules."""
    return Profile("test", "test", rules)


@dataclass(frozen=True)
class Builders:
    """The functions of this file, for tests that cannot import it."""

    rectangle: Callable[..., Array] = rectangle
    circle: Callable[..., Array] = circle
    irregular: Callable[..., Array] = irregular
    rotation: Callable[..., Array] = rotation
    see: Callable[..., Seen] = see
    points_of: Callable[..., tuple[AssemblyPoint, ...]] = points_of
    column: Callable[..., ColumnDesign] = column
    extraction: Callable[..., Extraction] = extraction
    profile: Callable[..., Profile] = profile
    moved: Callable[..., list[AssemblyPoint | None]] = moved


@pytest.fixture(scope="session")
def build() -> Builders:
    return Builders()


@pytest.fixture
def square(build: Builders) -> Array:
    """(12, 3) the square ring of a column of 600 × 600 mm."""
    return build.rectangle(4, 4, 240.0, 240.0)


@pytest.fixture(scope="session")
def reference_data(repository: Path) -> Path:
    """Measurements of other people; AADM_REFERENCE_DATA names the folder, ../shared/data by default."""
    folder = Path(os.environ.get("AADM_REFERENCE_DATA", repository.parent / "shared" / "data")) / "ref"
    if not folder.is_dir():
        pytest.skip("no reference data in ../shared/data, and AADM_REFERENCE_DATA names no folder with them")
    return folder
