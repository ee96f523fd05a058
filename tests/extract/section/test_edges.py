"""Edges of a foot's face, against faces that a ray caster of the tests draws."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from aadm_workbench.extract.sample import thinned
from aadm_workbench.extract.section.outline import SIDES, SeenEdge, section_edges
from aadm_workbench.model import Array, Reason, Scan
from tests.extract.section.ideal_face import IdealFace, T_scan_column, scanned

DESIGN = np.array([[-200.0, -150.0], [200.0, -150.0], [200.0, 150.0], [-200.0, 150.0]])
MOUTHS = np.array([[x, y] for x in (-140.0, 0.0, 140.0) for y in (-90.0, 90.0)])


def turned(corners: Array, degrees: float, shift: tuple[float, float] = (0.0, 0.0)) -> Array:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return corners @ np.array([[c, s], [-s, c]]) + np.array(shift)


def distance_outwards(corners: Array, side: str) -> float:
    """Where the true edge crosses the column's own axis, outwards: by intersecting two lines, not by angles."""
    number = SIDES.index(side)
    (ax, ay), (bx, by) = corners[number], corners[(number + 1) % 4]
    axis = "xy".index(side[1])
    along = (ay, by) if axis == 0 else (ax, bx)
    out = (ax, bx) if axis == 0 else (ay, by)
    at = out[0] + (out[1] - out[0]) * (0.0 - along[0]) / (along[1] - along[0])
    return at if side[0] == "+" else -at


def edges_of(face: IdealFace, scan_and_points: tuple, T: Array | None = None) -> dict[str, SeenEdge | Reason]:
    scan, extraction = scan_and_points
    sample = thinned(scan, 90_000, np.random.default_rng(0))
    return section_edges(scan, sample, extraction, T_scan_column() if T is None else T, DESIGN, [36.0])


def errors(face: IdealFace, edges: dict[str, SeenEdge | Reason]) -> dict[str, float]:
    found = {}
    for side, edge in edges.items():
        assert isinstance(edge, SeenEdge), f"{side}: {edge}"
        here = edge.offset_mm + np.tan(edge.turn) * edge.at_mm
        found[side] = here - distance_outwards(face.corners, side)
        u = np.hypot(edge.shared_u_mm, np.sqrt(edge.covariance[0, 0]))
        assert abs(found[side]) < 3.0 * u, (side, found[side], u)
    return found


@pytest.mark.parametrize("mixing", [False, True], ids=["sharp", "mixing"])
@pytest.mark.parametrize("seed", range(3))
def test_edges_lie_where_they_are(mixing: bool, seed: int) -> None:
    rng = np.random.default_rng([seed, mixing])
    corners = turned(DESIGN + rng.uniform(-2.0, 2.0, (4, 2)), rng.uniform(-0.3, 0.3), tuple(rng.uniform(-3.0, 3.0, 2)))
    roll = float(rng.choice([-1.0, 1.0]) * rng.uniform(0.5, 3.0))
    seen = IdealFace(turned(corners, roll), turned(MOUTHS, roll))
    edges = edges_of(seen, scanned(seen, rng, mixing=mixing), T_scan_column(roll_deg=roll))
    found = errors(IdealFace(corners, MOUTHS), edges)
    assert max(map(abs, found.values())) < (0.2 if mixing else 0.1), found


@pytest.mark.parametrize("least", [0.05, 0.5, 0.8])
def test_whatever_a_mixing_camera_drops_its_edges_stay_where_they_are(least: float) -> None:
    face = IdealFace(turned(DESIGN, 0.9, (1.0, -2.0)), turned(MOUTHS, 0.9))
    edges = edges_of(face, scanned(face, np.random.default_rng(9), mixing=True, least=least))
    found = errors(face, edges)
    assert max(map(abs, found.values())) < 0.15, found


def test_a_ring_that_is_lost_at_mouths_may_be_lost_at_edges_too_and_the_uncertainty_says_so() -> None:
    face = IdealFace(turned(DESIGN, 0.9), turned(MOUTHS, 0.9))
    scan, extraction = scanned(face, np.random.default_rng(10))
    nothing = np.isnan(scan.points[..., 2]).astype(np.uint8)
    eroded = np.where(cv2.dilate(nothing, np.ones((3, 3), np.uint8))[..., None] > 0, np.nan, scan.points)
    for points in (scan.points, eroded.astype(np.float32)):
        found = edges_of(face, (replace(scan, points=points), extraction))
        stated = [edge.shared_u_mm for edge in found.values() if isinstance(edge, SeenEdge)]
        assert len(stated) == 4
        off = errors(face, found)  # within three of the stated uncertainty
        assert max(stated) < 0.1 if points is scan.points else min(stated) > 0.2, (stated, off)


def test_a_face_that_bends_has_its_edges_where_they_are_in_space() -> None:
    corners = turned(DESIGN, 0.8)
    flat, bent = IdealFace(corners, MOUTHS), IdealFace(corners, MOUTHS, bump_mm=4.0)
    found = edges_of(bent, scanned(bent, np.random.default_rng(11)))
    level = edges_of(flat, scanned(flat, np.random.default_rng(11)))
    for side, (x, y) in {"-y": (0.0, 150.0), "+x": (200.0, 0.0), "+y": (0.0, 150.0), "-x": (200.0, 0.0)}.items():
        nearer = 4.0 * (x**2 + y**2) / (2.0 * np.abs(corners).max() ** 2) / 900.0  # of the way to the camera, there
        edge, other = found[side], level[side]
        assert isinstance(edge, SeenEdge), f"{side}: {edge}"
        assert isinstance(other, SeenEdge)
        # Along an edge the face rises by as much again as at its middle: its line lies between.
        assert -2.5 * nearer * (x + y) < edge.offset_mm - other.offset_mm < -0.8 * nearer * (x + y)


def test_an_edge_along_rows_of_pixels_says_how_little_is_known() -> None:
    face = IdealFace(DESIGN + 0.2, MOUTHS)
    edges = edges_of(face, scanned(face, np.random.default_rng(8)))
    errors(face, edges)
    assert all(isinstance(edge, SeenEdge) and np.sqrt(edge.covariance[0, 0]) > 0.12 for edge in edges.values())


def test_turned_edges_are_turned_that_way() -> None:
    face = IdealFace(turned(DESIGN, 0.6), MOUTHS)
    edges = edges_of(face, scanned(face, np.random.default_rng(1)))
    for edge in edges.values():
        assert isinstance(edge, SeenEdge)
        assert np.degrees(edge.turn) == pytest.approx(0.6, abs=0.03)


@pytest.mark.parametrize("size_mm", [5.0, 12.0, 25.0, 40.0])
def test_a_chip_at_a_corner_moves_no_edge_and_is_told(size_mm: float) -> None:
    face = IdealFace(turned(DESIGN, 0.7), MOUTHS)
    chipped = replace(face, cuts=((*turned(DESIGN, 0.7)[2].tolist(), size_mm),))
    whole, broken = (edges_of(one, scanned(one, np.random.default_rng(2))) for one in (face, chipped))
    for side in SIDES:
        a, b = whole[side], broken[side]
        assert isinstance(a, SeenEdge)
        assert isinstance(b, SeenEdge)
        assert b.offset_mm == pytest.approx(a.offset_mm, abs=0.05)
        assert b.turn == pytest.approx(a.turn, abs=1e-3)
        if size_mm > 10.0:
            deep = [chip for chip in b.chips if chip.depth_mm > 2.0]
            assert bool(deep) == (side in ("+x", "+y")), (side, b.chips)


@pytest.mark.parametrize(("length_mm", "depth_mm"), [(24.0, 5.0), (40.0, 15.0), (80.0, 40.0)])
def test_a_piece_out_of_an_edge_moves_no_edge_and_is_told_with_its_depth(length_mm: float, depth_mm: float) -> None:
    corners = turned(DESIGN, 0.7)
    radius = (length_mm**2 / 4.0 + depth_mm**2) / (2.0 * depth_mm)
    middle = turned(np.array([[40.0, 150.0 + radius - depth_mm]]), 0.7)[0]
    face = IdealFace(corners, np.zeros((0, 2)))
    broken = replace(face, cuts=((float(middle[0]), float(middle[1]), radius),))
    whole, chipped = (edges_of(one, scanned(one, np.random.default_rng(12))) for one in (face, broken))
    for side in SIDES:
        a, b = whole[side], chipped[side]
        assert isinstance(a, SeenEdge)
        assert isinstance(b, SeenEdge)
        assert b.offset_mm == pytest.approx(a.offset_mm, abs=0.05)
        assert [chip for chip in b.chips if side != "+y"] == []
    edge = chipped["+y"]
    assert isinstance(edge, SeenEdge)
    (chip,) = edge.chips
    assert chip.depth_mm == pytest.approx(depth_mm, abs=2.0)
    assert chip.end_mm - chip.begin_mm == pytest.approx(length_mm, abs=8.0)


def test_an_edge_out_of_the_picture_is_not_measured() -> None:
    face = IdealFace(DESIGN, MOUTHS)
    aside = (-170.0, 0.0)
    edges = edges_of(face, scanned(face, np.random.default_rng(3), aside_mm=aside), T_scan_column(aside_mm=aside))
    assert edges["+x"] == "too little of this edge is in the picture"
    assert isinstance(edges["-x"], SeenEdge)


def test_what_hides_half_an_edge_is_no_edge() -> None:
    face = IdealFace(DESIGN, MOUTHS)
    scan, extraction = scanned(face, np.random.default_rng(4))
    points = scan.points.copy()
    x, y = points[..., 0], points[..., 1]
    points[y > 140.0 - 0.05 * x] = np.nan  # the projector's field ends there, askew
    edge = edges_of(face, (replace(scan, points=points), extraction))["+y"]
    assert isinstance(edge, str)
    assert "hides" in edge


def test_a_wall_flush_with_the_face_is_no_edge() -> None:
    face = IdealFace(DESIGN, MOUTHS)
    scan, extraction = scanned(face, np.random.default_rng(5))
    rows, columns = np.mgrid[: scan.points.shape[0], : scan.points.shape[1]]
    camera = scan.camera
    assert camera is not None
    flush = np.stack(
        [(columns - camera.cx) / camera.fx * 900.0, (rows - camera.cy) / camera.fy * 900.0, np.full(rows.shape, 900.0)],
        axis=-1,
    ).astype(np.float32)
    points = np.where((flush[..., :1] > 150.0) & np.isnan(scan.points), flush, scan.points)
    edge = edges_of(face, (replace(scan, points=points), extraction))["+x"]
    assert edge == "something lies flush with the face beyond this edge"


def test_a_cloud_without_its_camera_keeps_the_edges() -> None:
    face = IdealFace(turned(DESIGN, 0.6, (1.0, -2.0)), MOUTHS)
    scan, extraction = scanned(face, np.random.default_rng(6))
    flat = scan.points.reshape(-1, 3)
    cloud = Scan(flat[np.isfinite(flat[:, 2])])
    found = errors(face, edges_of(face, (cloud, extraction)))
    assert max(map(abs, found.values())) < 0.35, found


def test_a_cloud_that_the_picture_cuts_is_not_taken_for_an_edge() -> None:
    face = IdealFace(DESIGN, MOUTHS)
    scan, extraction = scanned(face, np.random.default_rng(7))
    flat = scan.points.reshape(-1, 3)
    cloud = Scan(flat[np.isfinite(flat[:, 2]) & (flat[:, 0] < 185.0)])
    edge = edges_of(face, (cloud, extraction))["+x"]
    assert isinstance(edge, str)
    assert "border of the picture" in edge
