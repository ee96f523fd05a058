"""Patterns that repeat themselves, seen in parts: right or ambiguous, never wrong without a word.

The generator places points as complex numbers, so that nothing of the arithmetic judged here is in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pytest

from aadm_workbench.assembly.matching.match import Match, match_extraction
from aadm_workbench.assembly.matching.views import merge_views
from aadm_workbench.model import AssemblyPoint, Extraction, Kind

Plane = npt.NDArray[np.complex128]


def rows(count: int, pitch: float, gap: float = 0.0, stagger: float = 0.0, number: int = 1) -> Plane:
    """Rows of points one above the other, every second one moved by ``stagger``."""
    places = [pitch * k + stagger * (row % 2) + 1j * gap * row for row in range(number) for k in range(count)]
    return np.array(places) - np.mean(places)


def ring(side: float, per_side: int) -> Plane:
    walk = [
        step * side / (per_side - 1) * 1j**corner + place
        for corner, place in _corners(side)
        for step in range(per_side - 1)
    ]
    return np.array(walk) - np.mean(walk)


def _corners(side: float) -> list[tuple[int, complex]]:
    return [(0, 0j), (1, side + 0j), (2, side * (1 + 1j)), (3, side * 1j)]


PATTERNS = {
    "row of 9": rows(9, 250.0),
    "row of 5": rows(5, 310.0),
    "double row 2 x 6": rows(6, 150.0, 130.0, number=2),
    "double row 2 x 9": rows(9, 200.0, 90.0, number=2),
    "plum blossom 2 x 6": rows(6, 200.0, 110.0, 100.0, number=2),
    "plum blossom 3 x 5": rows(5, 220.0, 120.0, 110.0, number=3),
    "ring of 12": ring(480.0, 4),
    "ring of 24": ring(900.0, 7),
}
SCATTERS_MM = (0.0, 0.05, 0.3, 0.8)


@dataclass(frozen=True, eq=False)
class Seen:
    """One view: what was extracted, which way its image is up, and the true number of each of its points."""

    extraction: Extraction
    up: npt.NDArray[np.float64]
    numbers: list[int]


def look(built: Plane, numbers: Sequence[int], rng: np.random.Generator, noise_mm: float = 0.05) -> Seen:
    """Some points of a foot from below: the scan frame's z points away from the camera, up into the column."""
    turned = np.exp(1j * np.radians(rng.uniform(-12.0, 12.0)))
    order = rng.permutation(np.asarray(numbers))
    noise = noise_mm * (rng.standard_normal(len(order)) + 1j * rng.standard_normal(len(order)))
    flat = (built[order] + noise) * turned + complex(*rng.uniform(-300.0, 300.0, 2))
    # Seen from below: y of the image is down, so that (x, -y, -z) of what stands upright is right-handed again.
    centres = np.column_stack([flat.real, -flat.imag, np.full(len(order), 900.0)])
    up = np.array([0.0, 0.0, -1.0])
    points = tuple(AssemblyPoint("", Kind.SLEEVE, centre, up, 36.0, np.eye(3) * noise_mm**2) for centre in centres)
    return Seen(Extraction(Kind.SLEEVE, "refined", points, None, up), np.array([0.0, -1.0, 0.0]), order.tolist())


def design_of(pattern: Plane) -> list[AssemblyPoint]:
    return [
        AssemblyPoint(f"S{k}", Kind.SLEEVE, np.array([place.real, place.imag, 0.0]), np.array([0.0, 0.0, 1.0]), 36.0)
        for k, place in enumerate(pattern, 1)
    ]


def matched(pattern: Plane, seen: Seen, extraction: Extraction | None = None) -> Match:
    return match_extraction(design_of(pattern), extraction or seen.extraction, up=90.0, image_up_scan=seen.up)


def says_truth(match: Match, extraction: Extraction, first: Seen) -> bool:
    """Whether the chosen labels of the points that the first view holds are the true ones."""
    merged = np.array([point.centre for point in extraction.points])
    for point, number in zip(first.extraction.points, first.numbers, strict=True):
        index = int(np.argmin(np.linalg.norm(merged - point.centre, axis=1)))
        if match.placements[0].matched[number] != index:
            return False
    return True


def parts(pattern: Plane, number: int, overlap: float) -> list[list[int]]:
    """Numbers of the points in windows along x that overlap by some share of their width."""
    low, length = pattern.real.min() - 1.0, np.ptp(pattern.real) + 2.0
    width = length / (number - (number - 1) * overlap)
    starts = [low + k * width * (1.0 - overlap) for k in range(number)]
    return [[k for k, x in enumerate(pattern.real) if start <= x <= start + width] for start in starts]


@pytest.mark.parametrize("name", PATTERNS)
@pytest.mark.parametrize("scatter_mm", SCATTERS_MM)
def test_any_part_in_any_number_of_views_is_right_or_ambiguous(name: str, scatter_mm: float) -> None:
    pattern = PATTERNS[name]
    for seed in range(6):
        rng = np.random.default_rng([seed, len(pattern)])
        built = pattern + scatter_mm * (rng.standard_normal(len(pattern)) + 1j * rng.standard_normal(len(pattern)))
        number = int(rng.integers(1, 4))
        shown = parts(pattern, max(number, 2), rng.uniform(0.1, 0.8))[:number]
        seen = [look(built, numbers, rng) for numbers in shown if len(numbers) >= 3]
        if not seen:
            continue
        merged, _ = merge_views([one.extraction for one in seen], [matched(pattern, one) for one in seen])
        match = matched(pattern, seen[0], merged)
        assert match
        assert match.orientation == "ambiguous" or says_truth(match, merged, seen[0]), seed
        if match.orientation == "ambiguous":
            alternatives = [Match((placement,), "declared") for placement in match.placements]
            assert any(says_truth(one, merged, seen[0]) for one in alternatives), seed


@pytest.mark.parametrize("name", [name for name in PATTERNS if "ring" not in name])
def test_a_part_of_a_row_fits_beside_its_place_and_says_so(name: str) -> None:
    pattern = PATTERNS[name]
    rng = np.random.default_rng(3)
    seen = look(pattern, parts(pattern, 2, 0.5)[0], rng)
    match = matched(pattern, seen)
    assert match.orientation == "ambiguous"
    assert match.is_shifted
    assert len({placement.matched.tobytes() for placement in match.placements}) == len(match.placements) > 1


@pytest.mark.parametrize("name", PATTERNS)
def test_the_whole_is_settled_by_its_ends(name: str) -> None:
    pattern = PATTERNS[name]
    seen = look(pattern, range(len(pattern)), np.random.default_rng(4))
    match = matched(pattern, seen)
    assert match.orientation == "declared"
    assert says_truth(match, seen.extraction, seen)


@pytest.mark.parametrize("name", ["row of 9", "double row 2 x 6", "plum blossom 2 x 6", "ring of 24"])
def test_views_that_overlap_are_settled_by_the_points_they_share(name: str) -> None:
    """At a usual scatter two halves that share a third of the pattern give the whole, in most cases."""
    pattern, whole = PATTERNS[name], 0
    for seed in range(15):
        rng = np.random.default_rng([5, seed])
        built = pattern + 0.7 * (rng.standard_normal(len(pattern)) + 1j * rng.standard_normal(len(pattern)))
        seen = [look(built, numbers, rng) for numbers in parts(pattern, 2, 0.5)]
        merged, _ = merge_views([one.extraction for one in seen], [matched(pattern, one) for one in seen])
        match = matched(pattern, seen[0], merged)
        whole += match.orientation == "declared" and match.placements[0].found == len(pattern)
    assert whole >= 11


def test_views_of_points_that_stand_exactly_are_not_joined_by_agreement_that_says_nothing() -> None:
    pattern = PATTERNS["row of 9"]
    rng = np.random.default_rng(6)
    seen = [look(pattern, numbers, rng) for numbers in ([0, 1, 2, 3, 4, 5], [3, 4, 5, 6, 7, 8])]
    merged, notes = merge_views([one.extraction for one in seen], [matched(pattern, one) for one in seen])
    assert len(merged.points) == 6
    assert "it is open which points it shares with the others" in notes[0]


def test_a_view_that_bridges_two_others_settles_both() -> None:
    pattern, joined = PATTERNS["row of 9"], 0
    for seed in range(10):
        rng = np.random.default_rng([7, seed])
        built = pattern + 0.7 * (rng.standard_normal(9) + 1j * rng.standard_normal(9))
        seen = [look(built, numbers, rng, 0.03) for numbers in ([0, 1, 2, 3], [5, 6, 7, 8], [1, 2, 3, 4, 5, 6, 7])]
        merged, _ = merge_views([one.extraction for one in seen], [matched(pattern, one) for one in seen])
        match = matched(pattern, seen[0], merged)
        assert match.orientation == "ambiguous" or says_truth(match, merged, seen[0])
        joined += match.placements[0].found == 9
    assert joined >= 5


def test_neighbours_that_continue_a_row_leave_it_open_which_nine_are_meant() -> None:
    """Twelve bars at one pitch where nine are designed: another wall begins where this one ends."""
    longer, pattern = rows(12, 250.0), PATTERNS["row of 9"]
    match = matched(pattern, look(longer, range(12), np.random.default_rng(8)))
    assert match.orientation == "ambiguous"
    assert len(match.placements) == 4
