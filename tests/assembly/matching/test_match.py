"""Correspondence under any pose, with points missing, too many and far off; symmetry, mirrors and contradictions."""

from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.matching.match import match_extraction, match_points
from aadm_workbench.assembly.matching.symmetry import symmetric_turns
from aadm_workbench.model import Array, Extraction, Kind

Y_UP = np.array([0.0, 1.0])

PATTERNS = {
    "square of 4": ("rectangle", (2, 2, 200.0, 200.0), 4),
    "square of 12": ("rectangle", (4, 4, 240.0, 240.0), 4),
    "rectangle of 10": ("rectangle", (4, 3, 240.0, 160.0), 2),
    "rectangle of 24": ("rectangle", (8, 6, 350.0, 250.0), 2),
    "square of 40": ("rectangle", (11, 11, 600.0, 600.0), 4),
    "circle of 12": ("circle", (12, 240.0), 12),
    "circle of 40": ("circle", (40, 600.0), 40),
    "irregular 8": ("irregular", (8, 500.0, 5), 1),
    "irregular 40": ("irregular", (40, 900.0, 6), 1),
}


@pytest.fixture(params=PATTERNS)
def pattern(request: pytest.FixtureRequest, build: Any) -> tuple[Array, int]:
    """Centres, and in how many turns they fit onto themselves."""
    name, arguments, turns = PATTERNS[request.param]
    return getattr(build, name)(*arguments), turns


def test_without_noise_every_pose_is_found_exactly(pattern: tuple[Array, int], build: Any) -> None:
    centres, _ = pattern
    rng = np.random.default_rng(len(centres))
    for _ in range(20 if len(centres) < 15 else 3):
        missing = tuple(rng.choice(len(centres), rng.integers(0, len(centres) // 4 + 1), replace=False).tolist())
        seen = build.see(centres, rng, missing=missing)
        match = match_points(seen.points, seen.vertical, centres, up=Y_UP, image_up_scan=seen.image_up)
        best = match.placements[0]
        assert best.matched.tolist() == seen.matched(len(centres))
        assert match.orientation == "declared"
        found = seen.points @ best.T_design_scan[:3, :3].T + best.T_design_scan[:3, 3]
        np.testing.assert_allclose(found, centres[seen.design_of], atol=1e-7)
        np.testing.assert_allclose(best.T_design_scan[:3, :3], seen.turned.T, atol=1e-9)
        assert best.max_mm < 1e-7


def test_as_built_scatter_with_one_point_15_mm_off_missing_and_extra(pattern: tuple[Array, int], build: Any) -> None:
    centres, _ = pattern
    if len(centres) == 4:
        pytest.skip("four points with one missing and one far off are no pattern any more")
    rng = np.random.default_rng(100 + len(centres))
    for _ in range(10 if len(centres) < 15 else 3):
        built = centres + np.column_stack([rng.normal(0.0, 1.0, (len(centres), 2)), np.zeros(len(centres))])
        order = rng.permutation(len(centres))
        angle = rng.uniform(0.0, 2.0 * np.pi)
        built[order[0], :2] = centres[order[0], :2] + 15.0 * np.array([np.cos(angle), np.sin(angle)])
        missing = tuple(order[1 : 1 + len(centres) // 5].tolist())
        extra = np.array([[0.3 * 240.0, 0.1 * 240.0, 0.0]])
        if np.hypot(*(centres - extra)[:, :2].T).min() < 40.0:
            extra = extra[:0]
        seen = build.see(built, rng, missing=missing, extra=extra)
        match = match_points(seen.points, seen.vertical, centres, up=Y_UP, image_up_scan=seen.image_up)
        assert match.placements[0].matched.tolist() == seen.matched(len(centres))
        assert match.extra == tuple(np.flatnonzero(seen.design_of < 0).tolist())


def test_without_up_the_number_of_candidates_is_that_of_the_turns(pattern: tuple[Array, int], build: Any) -> None:
    centres, turns = pattern
    rng = np.random.default_rng(7)
    built = centres + np.column_stack([rng.normal(0.0, 0.7, (len(centres), 2)), np.zeros(len(centres))])
    seen = build.see(built, rng)
    match = match_points(seen.points, seen.vertical, centres, image_up_scan=seen.image_up)
    assert match.orientation == ("resolved" if turns == 1 else "ambiguous")
    assert len(match.placements) == len(match.evaluated) == turns == len(symmetric_turns(centres))
    assert len({placement.matched.tobytes() for placement in match.placements}) == turns
    assert seen.matched(len(centres)) in [placement.matched.tolist() for placement in match.placements]
    rms = [placement.rms_mm for placement in match.placements]
    assert max(rms) - min(rms) < 1e-6


def test_a_keyed_ring_resolves_itself(build: Any, square: Array) -> None:
    """One sleeve of twelve drawn 25 mm further in: no up is needed, not even where another one is 15 mm off."""
    square[2, 1] += 25.0
    square -= square.mean(axis=0)
    rng = np.random.default_rng(11)
    for far_off in (None, *range(12)):
        built = square + np.column_stack([rng.normal(0.0, 0.7, (12, 2)), np.zeros(12)])
        if far_off is not None:
            built[far_off, 0] += 15.0
        seen = build.see(built, rng)
        match = match_points(seen.points, seen.vertical, square)
        assert match.placements[0].matched.tolist() == seen.matched(12)
        assert match.orientation == "resolved" or far_off == 2


@pytest.mark.parametrize("off_deg", [-43.0, -20.0, 0.0, 43.0])
@pytest.mark.parametrize("up_deg", [0.0, 90.0, -90.0, 180.0])
def test_declared_up_takes_the_nearest_turn(off_deg: float, up_deg: float, build: Any, square: Array) -> None:
    """The camera may be turned by 44° against what was declared, as degrees or as a direction."""
    seen = build.see(square, np.random.default_rng(1))
    skew = np.radians(off_deg)
    held = seen.turned @ np.array([np.cos(skew + np.radians(up_deg)), np.sin(skew + np.radians(up_deg)), 0.0])
    direction = np.array([np.cos(np.radians(up_deg)), np.sin(np.radians(up_deg))])
    for up in (up_deg, direction):
        match = match_points(seen.points, seen.vertical, square, up=up, image_up_scan=held)
        assert match.placements[0].matched.tolist() == seen.matched(12)
        assert match.evaluated == match.placements[:1]


def test_up_that_the_pattern_contradicts_is_no_match(build: Any) -> None:
    centres = build.rectangle(4, 3, 240.0, 160.0)
    seen = build.see(centres, np.random.default_rng(2))
    match = match_points(seen.points, seen.vertical, centres, up=np.array([1.0, 0.0]), image_up_scan=seen.image_up)
    assert not match
    assert "contradicts the declared up of 0°" in match.reason
    irregular = build.irregular(8, 500.0, 5)
    seen = build.see(irregular, np.random.default_rng(2))
    match = match_points(seen.points, seen.vertical, irregular, up=-Y_UP, image_up_scan=seen.image_up)
    assert not match
    assert "only with 90° at the top of the image, 180° away" in match.reason


def test_a_mirrored_scan_is_never_matched_as_if_it_were_right(build: Any) -> None:
    """The vertical the wrong way round: bars seen as if from below."""
    centres = build.irregular(10, 500.0, 9)
    seen = build.see(centres, np.random.default_rng(3))
    match = match_points(seen.points, -seen.vertical, centres)
    assert not match
    assert "mirror image" in match.reason


def test_every_pose_is_a_rotation_that_keeps_up_up(build: Any, square: Array) -> None:
    seen = build.see(square, np.random.default_rng(4))
    for placement in match_points(seen.points, seen.vertical, square).placements:
        rotation = placement.T_design_scan[:3, :3]
        assert np.linalg.det(rotation) == pytest.approx(1.0)
        np.testing.assert_allclose(rotation @ seen.vertical, [0.0, 0.0, 1.0], atol=1e-12)


def test_bars_of_unlike_heights_are_matched_in_the_plane(build: Any, square: Array) -> None:
    """Their mean height is brought to that of the design; no plane is laid through the tops."""
    rng = np.random.default_rng(5)
    tops = square + np.array([0.0, 0.0, 160.0])
    heights = rng.uniform(-40.0, 40.0, 12)
    seen = build.see(tops + heights[:, None] * np.array([0.0, 0.0, 1.0]), rng, missing=(3,))
    match = match_points(seen.points, seen.vertical, tops, up=Y_UP, image_up_scan=seen.image_up)
    best = match.placements[0]
    assert best.matched.tolist() == seen.matched(12)
    assert best.max_mm < 1e-7
    placed = seen.points @ best.T_design_scan[:3, :3].T + best.T_design_scan[:3, 3]
    assert placed[:, 2].mean() == pytest.approx(160.0, abs=1e-6)


@pytest.mark.parametrize(
    ("count", "reason"), [(0, "only 0 points"), (2, "only 2 points"), (5, "do not fit the pattern")]
)
def test_too_few_points_or_another_pattern_say_why(count: int, reason: str, square: Array) -> None:
    points = np.random.default_rng(6).uniform(-60.0, 60.0, (count, 3)) * np.array([1.0, 0.05, 0.0])
    match = match_points(points, np.array([0.0, 0.0, 1.0]), square)
    assert not match
    assert reason in match.reason
    assert match.evaluated == ()


def test_up_without_an_image_is_a_reason(square: Array, build: Any) -> None:
    seen = build.see(square, np.random.default_rng(8))
    match = match_points(seen.points, seen.vertical, square, up=0.0, image_up_scan=seen.vertical)
    assert not match
    assert "up was declared" in match.reason


def test_extraction_without_points_or_vertical_passes_its_reason_on(build: Any, square: Array) -> None:
    design = build.column(square).sleeves
    nothing = Extraction(Kind.SLEEVE, "refined", (), None, None, reason="the face is covered")
    assert match_extraction(design, nothing).reason == "the face is covered"
    seen = build.see(square, np.random.default_rng(9))
    unknown = Extraction(Kind.SLEEVE, "refined", build.extraction(Kind.SLEEVE, seen, 36.0).points, None, None)
    assert "which way is up" in match_extraction(design, unknown).reason


def test_a_row_of_three_and_a_pair_of_two(build: Any) -> None:
    """Walls have sleeves in a row: it fits in two turns."""
    row = np.array([[-200.0, 0.0, 0.0], [0.0, 0.0, 0.0], [200.0, 0.0, 0.0]])
    for centres in (row, row[[0, 2]]):
        seen = build.see(centres, np.random.default_rng(10))
        match = match_points(seen.points, seen.vertical, centres)
        assert match.orientation == "ambiguous"
        assert len(match.placements) == 2
