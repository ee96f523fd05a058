"""Two frames of one ring, made with complex numbers: which of them can both be right."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.hoisting.sequence.contradiction import contradiction_of
from aadm_workbench.model import Correction, Finding, HoistingMeasurement, HoistingPair, HoistingReport, Verdict

SIDE = [complex(-240.0 + 160.0 * k, -240.0) for k in range(3)]
RING = np.array([place * 1j**corner for corner in range(4) for place in SIDE])
DESIGN = inline_design(
    "C-1",
    {
        "sleeve_diameter": 36.0,
        "rebar_diameter": 20.0,
        "size": [600.0, 600.0],
        "centres": [[place.real, place.imag] for place in RING],
    },
)
PLACES = np.array([complex(*bar.centre[:2]) for bar in DESIGN.rebars])
U_MM = 0.1


def frame(
    own: np.ndarray, hangs: complex, camera: complex, *, believed_quarters: int = 0, seed: int = 0, turn: float = 0.0
) -> HoistingMeasurement:
    """What a frame says of pairs that stand off their places by ``own`` in a column that hangs off by ``hangs``.

    It sees the nine of twelve that are nearest to the ``camera``; its labels are turned by quarters too many.
    """
    rng = np.random.default_rng([41, seed])
    noise = rng.normal(0.0, U_MM, len(own)) + 1j * rng.normal(0.0, U_MM, len(own))
    offsets = own - hangs - 1j * turn * PLACES + noise
    seen = np.zeros(len(own), bool)
    seen[np.argsort(np.abs(PLACES - 900.0 * camera))[:9]] = True
    quarter = 1j**believed_quarters
    onto = np.array([int(np.abs(PLACES - place * quarter).argmin()) for place in PLACES])
    labelled, seen_as = np.empty_like(offsets), np.empty_like(seen)
    labelled[onto], seen_as[onto] = offsets * quarter, seen
    push = np.mean((labelled)[seen_as])
    pairs = tuple(
        HoistingPair(s.label, r.label, None, None, None, 1.0, U_MM, bool(is_seen))
        for s, r, is_seen in zip(DESIGN.sleeves, DESIGN.rebars, seen_as, strict=True)
    )
    move = Correction(float(push.real), float(push.imag), 0.0, u_mm=0.1)
    report = HoistingReport(f"{seed}.tiff", (), 1.0, 1.0, 0.0, Verdict.FAIL, pairs, move, near="-x-y")
    xy = np.column_stack([labelled.real, labelled.imag])
    return HoistingMeasurement(report, xy, np.tile(U_MM**2 * np.eye(2), (len(own), 1, 1)))


def own_amounts(spread_mm: float, seed: int) -> np.ndarray:
    rng = np.random.default_rng([43, seed])
    return rng.normal(0.0, spread_mm, len(RING)) + 1j * rng.normal(0.0, spread_mm, len(RING))


def found(spread_mm: float, seed: int, quarters: int, moves: complex = 0.0) -> Finding | None:
    """What two frames of the corners (-x, -y) and (+x, -y) say against each other."""
    own = own_amounts(spread_mm, seed)
    hangs = 6.1 - 5.1j
    first = frame(own, hangs, -1 - 1j, seed=2 * seed)
    second = frame(own, hangs + moves, 1 - 1j, believed_quarters=quarters, seed=2 * seed + 1, turn=0.002 * bool(moves))
    return contradiction_of(first, second, DESIGN)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("moves", [0.0, 11.0 + 3.0j])
def test_frames_that_are_labelled_rightly_do_not_contradict_each_other(seed: int, moves: complex) -> None:
    assert found(0.5, seed, 0, moves) is None


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("quarters", "turn_deg"), [(1, 90), (-1, 90), (2, 180)])
def test_a_frame_labelled_quarters_too_far_is_noticed(seed: int, quarters: int, turn_deg: int) -> None:
    finding = found(0.5, seed, quarters)
    assert finding is not None
    assert finding.values.get("turn_deg", turn_deg) == turn_deg
    assert finding.holds_back


@pytest.mark.parametrize("quarters", [1, -1, 2])
def test_pairs_tell_it_even_where_the_column_moved_in_between(quarters: int) -> None:
    assert found(0.7, 3, quarters, 4.0 - 9.0j) is not None


@pytest.mark.parametrize("quarters", [1, -1, 2])
def test_a_perfect_ring_that_hangs_still_tells_it_by_the_push(quarters: int) -> None:
    """Every pair alike, so that no pair can be told from its neighbour."""
    assert found(0.0, 5, quarters) is not None
    assert found(0.0, 5, 0) is None


def test_a_perfect_ring_that_swings_through_its_rest_contradicts_nothing() -> None:
    own = own_amounts(0.0, 5)
    one, other = (frame(own, hangs, -1 - 1j, seed=seed) for seed, hangs in enumerate((9.0 + 0j, -9.0 + 0j)))
    assert contradiction_of(one, other, DESIGN, swings=True) is None
    assert contradiction_of(one, other, DESIGN) is not None  # as frames of a column that hangs still
