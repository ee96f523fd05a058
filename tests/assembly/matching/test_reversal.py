"""Captures of one part from turned cameras: the bend of a lens is found as the camera's, the part stays the part's.

The truth is a pinhole whose lens is off its axis, by Brown's formula, which the code that judges it does not know.
"""

import numpy as np
import pytest

from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.matching.reversal import CameraView, Reversal, reversal_of, view_of
from aadm_workbench.model import Array, AssemblyPoint, Extraction, Kind, codes_of

DISTANCE_MM = 1300.0
NOISE_MM = 0.02
OFF_AXIS = (2e-3, -1.5e-3)
"""Brown's p1 and p2: 0.3 mm at the edge of a foot of 600 mm."""

DESIGN = tuple(
    AssemblyPoint(f"S{k}", Kind.SLEEVE, np.array([x, y, 0.0]), np.array([0.0, 0.0, 1.0]), 36.0)
    for k, (x, y) in enumerate(
        [(-240, -240), (-80, -240), (80, -240), (240, -240), (240, -80), (240, 80), (240, 240), (80, 240), (-80, 240),
         (-240, 240), (-240, 80), (-240, -100)],
        1,
    )
)  # fmt: skip


def lens(at: Array, p1: float, p2: float, k1: float = 0.0) -> Array:
    """Brown's distortion of tangents (n, 2): what a lens that is off its axis does."""
    x, y = at.T
    r2 = x * x + y * y
    bent = np.stack([2 * p1 * x * y + p2 * (r2 + 2 * x * x), p1 * (r2 + 2 * y * y) + 2 * p2 * x * y], -1)
    return np.asarray(at * (1.0 + k1 * r2)[:, None] + bent)


def view(
    part: Array, turned_deg: float, off: tuple[float, float], rng: np.random.Generator, **bend: float
) -> CameraView:
    """A capture of a foot by a camera that looks up at it, turned about its axis, not quite in its middle."""
    c, s = np.cos(np.radians(turned_deg)), np.sin(np.radians(turned_deg))
    places = np.array([one.centre[:2] for one in DESIGN]) + part
    seen = (places - off) @ np.array([[c, -s], [s, c]])
    seen = lens(seen / DISTANCE_MM, **bend) * DISTANCE_MM + rng.normal(0.0, NOISE_MM, seen.shape)
    up = np.array([0.0, 0.0, -1.0])
    points = tuple(
        AssemblyPoint("", Kind.SLEEVE, np.array([*at, DISTANCE_MM]), up, 36.0, 0.05**2 * np.eye(3)) for at in seen
    )
    extraction = Extraction(Kind.SLEEVE, "refined", points, None, -up)
    # the picture's top is against its y
    up_deg = float(np.degrees(np.arctan2(-c, s)))
    match = match_extraction(DESIGN, extraction, up=up_deg, image_up_scan=np.array([0.0, -1.0, 0.0]))
    found = view_of(DESIGN, extraction, match)
    assert found is not None
    return found


def solved(turns: list[float], seed: int, **bend: float) -> tuple[Reversal, Array]:
    rng = np.random.default_rng(seed)
    part = rng.normal(0.0, 0.5, (len(DESIGN), 2))
    views = [view(part, turn, tuple(rng.uniform(-15.0, 15.0, 2)), rng, **bend) for turn in turns]
    found = reversal_of(views)
    assert isinstance(found, Reversal)
    return found, part


def without_pose(values: Array) -> Array:
    """Values (n, 2) without what a shift, a turn and a scale of the places make of them, by complex numbers."""
    at = np.array([one.centre[0] + 1j * one.centre[1] for one in DESIGN])
    seen = values[:, 0] + 1j * values[:, 1]
    design = np.column_stack([np.ones(len(at)), at])
    left = seen - design @ np.linalg.lstsq(design, seen, rcond=None)[0]
    return np.stack([left.real, left.imag], -1)


@pytest.mark.parametrize("seed", range(4))
def test_half_a_turn_tells_the_part_from_a_lens_that_is_off_its_axis(seed: int) -> None:
    found, part = solved([0.0, 180.0], seed, p1=OFF_AXIS[0], p2=OFF_AXIS[1])
    assert found.shown
    assert found.contradicts
    single = view(part, 0.0, (0.0, 0.0), np.random.default_rng(seed), p1=OFF_AXIS[0], p2=OFF_AXIS[1])
    bent = np.abs(without_pose(single.offset - part)).max()
    assert bent > 0.15
    assert np.abs(without_pose(found.part - part)).max() < 0.4 * bent
    assert found.largest_mm == pytest.approx(
        np.hypot(*without_pose(single.offset - part).T).max(), abs=4.0 * found.u_mm
    )
    assert "stretch" in found.untold


def test_sound_cameras_show_no_bend() -> None:
    found = [solved([0.0, 180.0], 100 + seed, p1=0.0, p2=0.0)[0] for seed in range(12)]
    assert not any(one.contradicts for one in found)
    assert np.mean([one.chance < 0.1 for one in found]) < 0.4


def test_a_quarter_turn_tells_what_half_a_turn_does_not() -> None:
    half, quarter = (solved(turns, 7, p1=0.0, p2=0.0)[0] for turns in ([0.0, 180.0], [0.0, 90.0, 180.0]))
    assert "stretch" in half.untold
    assert "stretch" not in quarter.untold


def test_two_captures_with_few_points_in_common_tell_nothing() -> None:
    rng = np.random.default_rng(3)
    part = np.zeros((len(DESIGN), 2))
    one, other = (view(part, turn, (0.0, 0.0), rng, p1=0.0, p2=0.0) for turn in (0.0, 180.0))
    one.offset[:9] = np.nan
    assert codes_of(reversal_of([one, other])) == {"calibration.few_views"}
    assert codes_of(reversal_of([other])) == {"calibration.few_views"}


def test_a_camera_that_stood_still_tells_nothing_whether_its_captures_scatter_or_not() -> None:
    """The same capture twice, one taken again from the same place, and one moved by next to nothing."""
    part = np.zeros((len(DESIGN), 2))
    one, again = (view(part, 0.0, (0.0, 0.0), np.random.default_rng(seed), p1=0.0, p2=0.0) for seed in (5, 6))
    assert codes_of(reversal_of([one, one])) == {"calibration.unmoved"}
    assert codes_of(reversal_of([one, again])) <= {"calibration.unmoved", "calibration.scattered"}
    moved = view(part, 0.0, (25.0, 0.0), np.random.default_rng(7), p1=0.0, p2=0.0)
    moved.offset[:] += np.random.default_rng(8).normal(0.0, 0.3, moved.offset.shape)
    reason = reversal_of([one, moved])
    assert codes_of(reason) == {"calibration.scattered"}
