"""Parts of patterns that repeat themselves, in one to three views: are they taken for what they are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.matching.views import merge_views
from aadm_workbench.model import AssemblyPoint, Extraction, Kind

Plane = npt.NDArray[np.complex128]

_UP_DEG = 90.0
_IMAGE_UP = np.array([0.0, -1.0, 0.0])


def periodic_views(cases: int, rng: np.random.Generator, scatter_mm: float = 0.4) -> dict[str, int]:
    """Single, double and staggered rows of any pitch, seen from below in parts that overlap by chance."""
    counts = Counter({"right": 0, "ambiguous": 0, "not matched": 0, "wrong": 0})
    for _ in range(cases):
        pattern = _rows(rng)
        built = pattern + scatter_mm * (rng.standard_normal(len(pattern)) + 1j * rng.standard_normal(len(pattern)))
        counts[_seen(pattern, built, rng)] += 1
    return dict(counts)


def _rows(rng: np.random.Generator) -> Plane:
    """One to three rows, the second one staggered in half of the cases."""
    count, pitch = int(rng.integers(4, 11)), float(rng.uniform(90.0, 320.0))
    gap, stagger = float(rng.uniform(80.0, 200.0)), float(rng.choice([0.0, pitch / 2.0]))
    number = int(rng.integers(1, 4))
    places = [pitch * k + stagger * (row % 2) + 1j * gap * row for row in range(number) for k in range(count)]
    return np.array(places) - np.mean(places)


def _seen(pattern: Plane, built: Plane, rng: np.random.Generator) -> str:
    windows = _windows(pattern.real, int(rng.integers(1, 4)), float(rng.uniform(0.0, 0.8)))
    views = [_view(built, numbers, rng) for numbers in windows if len(numbers) >= 3]
    if not views:
        return "not matched"
    design = [_point(place, 0.0) for place in pattern]
    matches = [match_extraction(design, view, up=_UP_DEG, image_up_scan=_IMAGE_UP) for view, _ in views]
    merged, _ = merge_views([view for view, _ in views], matches)
    match = match_extraction(design, merged, up=_UP_DEG, image_up_scan=_IMAGE_UP)
    if not match:
        return "not matched"
    if match.orientation == "ambiguous":
        return "ambiguous"
    centres = np.array([point.centre for point in merged.points])
    for point, number in zip(views[0][0].points, views[0][1], strict=True):
        nearest = int(np.argmin(np.linalg.norm(centres - point.centre, axis=1)))
        if match.placements[0].matched[number] != nearest:
            return "wrong"
    return "right"


def _windows(x: npt.NDArray[np.float64], number: int, overlap: float) -> list[list[int]]:
    """Numbers of the points in windows along the rows; a single one shows half of them or all."""
    low, length = float(x.min()) - 1.0, float(np.ptp(x)) + 2.0
    width = length * (0.5 + overlap / 1.6) if number == 1 else length / (number - (number - 1) * overlap)
    starts = [low + k * width * (1.0 - overlap) for k in range(number)]
    return [[k for k, one in enumerate(x.tolist()) if start <= one <= start + width] for start in starts]


def _view(built: Plane, numbers: Sequence[int], rng: np.random.Generator) -> tuple[Extraction, list[int]]:
    """What a camera from below finds of some points, in any order, and their true numbers."""
    order = rng.permutation(np.asarray(numbers))
    noise = 0.05 * (rng.standard_normal(len(order)) + 1j * rng.standard_normal(len(order)))
    flat = (built[order] + noise) * np.exp(1j * rng.uniform(-0.2, 0.2)) + complex(*rng.uniform(-300.0, 300.0, 2))
    points = tuple(_point(place.conjugate(), 900.0, np.array([0.0, 0.0, -1.0])) for place in flat)
    return Extraction(Kind.SLEEVE, "refined", points, None, np.array([0.0, 0.0, -1.0])), order.tolist()


def _point(place: complex, height: float, axis: npt.NDArray[np.float64] | None = None) -> AssemblyPoint:
    up = np.array([0.0, 0.0, 1.0]) if axis is None else axis
    centre = np.array([place.real, place.imag, height])
    return AssemblyPoint("", Kind.SLEEVE, centre, up, 36.0, 0.05**2 * np.eye(3))
