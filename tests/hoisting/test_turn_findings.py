"""A frame that hangs, or is seen, nearly at the next turn: paired still, and held back."""

from __future__ import annotations

import math

import numpy as np
import pytest

from aadm_workbench.hoisting.match import Matched, match_hoisting
from aadm_workbench.hoisting.turn_findings import with_turn_finding
from aadm_workbench.model import Array, HoistingReport, Verdict
from aadm_workbench.report.words.reasons import in_both_languages

NEAR = (-1, -1)


def ring() -> list[complex]:
    side = [complex(-240.0 + 160.0 * k, -240.0) for k in range(3)]
    return [place * 1j**corner for corner in range(4) for place in side]


def flat(places: list[complex]) -> Array:
    return np.array([[place.real, place.imag] for place in places])


def hung(turn_deg: float, camera_deg: float = 0.0, key: complex = 0.0) -> Matched:
    """A column turned against its bars; the camera stands on the diagonal of (-x, -y), or beside it."""
    pattern = ring()
    pattern[1] += key
    column = [place * np.exp(1j * math.radians(turn_deg)) for place in pattern]
    eye = 900.0 * np.exp(1j * math.radians(225.0 + camera_deg))
    found = match_hoisting(flat(column), flat(pattern), flat([eye])[0], flat(pattern), flat(pattern), NEAR)
    assert isinstance(found, Matched)
    return found


def frame() -> HoistingReport:
    return HoistingReport("frame.tiff", ("S1",), 1.0, 1.2, 0.1, Verdict.PASS)


@pytest.mark.parametrize("turn_deg", [41.5, -42.0, 43.5])
def test_a_column_turned_more_than_forty_degrees_is_paired_and_held_back(turn_deg: float) -> None:
    found = hung(turn_deg)
    assert found.sleeves.matched.tolist() == found.rebars.matched.tolist()
    held = with_turn_finding(frame(), NEAR, found.off_declared)
    assert held.verdict is Verdict.INCONCLUSIVE
    (finding,) = held.findings
    assert (finding.code, finding.holds_back) == ("hoisting_turn_doubtful", True)
    assert finding.values["turn_deg"] == pytest.approx(abs(turn_deg), abs=0.5)
    assert held.reasons[0] == finding.text
    assert "frame.tiff" in in_both_languages(finding.text).zh


@pytest.mark.parametrize("turn_deg", [0.0, 20.0, -40.0])
def test_forty_degrees_and_less_are_no_finding(turn_deg: float) -> None:
    assert with_turn_finding(frame(), NEAR, hung(turn_deg).off_declared) == frame()


@pytest.mark.parametrize(("camera_deg", "doubtful"), [(0.0, False), (-38.0, False), (42.0, True), (-43.0, True)])
def test_a_camera_that_stands_between_two_corners_is_held_back(camera_deg: float, doubtful: bool) -> None:
    held = with_turn_finding(frame(), NEAR, hung(0.0, camera_deg).off_declared)
    assert (held.verdict is Verdict.INCONCLUSIVE) == doubtful


def test_what_the_pattern_settles_itself_no_declaration_decides() -> None:
    """A ring with one sleeve 30 mm inside hangs by 43° and is not doubtful: no other turn fits."""
    assert hung(43.0, 42.0, key=30.0j).off_declared == 0.0


@pytest.mark.parametrize(("shown", "named"), [(slice(0, 5), False), (slice(1, 6), False), (slice(0, 6), True)])
def test_a_row_whose_end_is_not_seen_is_not_named_by_chance(shown: slice, named: bool) -> None:
    """A wall with six sleeves in a row, of which five are found: named from either end it fits, a pitch apart."""
    row = [complex(-500.0 + 200.0 * k, 0.3 * (-1) ** k) for k in range(6)]
    eye = np.array([0.0, -900.0])
    mouths, bars = flat([place + 2.0 for place in row[shown]]), flat(row)
    found = match_hoisting(mouths, bars, eye, bars, bars, None)
    assert isinstance(found, Matched)
    assert found.slid != named


def test_without_near_nothing_is_claimed() -> None:
    assert with_turn_finding(frame(), None, math.radians(43.0)) == frame()
