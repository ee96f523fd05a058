"""Edges of a foot's face, against faces that a ray caster of the tests draws."""

from __future__ import annotations

from dataclasses import replace

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
