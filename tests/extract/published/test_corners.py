"""The corners method on faces that a ray caster of the tests draws: sleeves come to lie where the corners put them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.extract.method import Known, extract
from aadm_workbench.model import Array, ColumnDesign, Extraction, Kind, Scan
from tests.extract.section.ideal_face import IdealFace, scanned

CORNERS = np.array([[-200.0, -150.0], [200.0, -150.0], [200.0, 150.0], [-200.0, 150.0]])
PATTERN = np.array([[x, y] for x in (-140.0, 0.0, 140.0) for y in (-90.0, 90.0)])
ODD = np.array([[-140.0, -90.0], [140.0, -90.0], [140.0, 90.0], [0.0, 90.0]])
DISTANCE_MM = 900.0


def design_of(centres: Array, size: list[float] | None) -> ColumnDesign:
    table = {"centres": centres.tolist(), "sleeve_diameter": 36.0, "rebar_diameter": 20.0}
    return inline_design("C-1", table if size is None else table | {"size": size})


def seen(places: Array, degrees: float, aside: tuple[float, float] = (0.0, 0.0)) -> Array:
    """Places of the column frame in the picture's axes: seen from below, +y up, so that +x is left; turned."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return -places @ np.array([[c, s], [-s, c]]) + aside


def scan_of(mouths: Array, degrees: float = 0.7, cuts: tuple[tuple[float, float, float], ...] = ()) -> Scan:
    face = IdealFace(seen(CORNERS, degrees), seen(mouths, degrees), cuts=cuts)
    return scanned(face, np.random.default_rng(0), distance_mm=DISTANCE_MM)[0]


def by_corners(scan: Scan, design: ColumnDesign | None, up_deg: float | None = 90.0) -> Extraction:
    known = None if design is None else Known(design, up_deg)
    return extract(scan, Kind.SLEEVE, 36.0, "corners", np.random.default_rng(0), known=known)


def off_mm(found: Extraction, wanted: Array) -> float:
    """How far the farthest of the points lies from its own place (n, 2), in the picture's axes."""
    assert found.points, found.reason
    centres = np.array([point.centre for point in found.points])
    assert centres[:, 2] == pytest.approx(DISTANCE_MM, abs=0.1)
    return float(np.hypot(*(centres[:, :2] - wanted).T).max())


def test_sleeves_lie_where_the_design_has_them_wherever_they_are() -> None:
    design = design_of(PATTERN, [400.0, 300.0])
    moved = PATTERN + np.random.default_rng(1).normal(0.0, 1.5, PATTERN.shape)
    found = by_corners(scan_of(moved), design)
    assert off_mm(found, seen(np.array([point.centre[:2] for point in design.sleeves]), 0.7)) < 0.1
    assert found.quality == {"corners": 4}
    assert all(point.covariance is None and point.kind is Kind.SLEEVE for point in found.points)
    assert found.vertical == pytest.approx([0.0, 0.0, 1.0], abs=1e-3)


@pytest.mark.parametrize("up_deg", [90.0, -90.0])
def test_which_way_round_a_pattern_lies_is_declared_or_open(up_deg: float) -> None:
    design = design_of(ODD, [400.0, 300.0])
    placed = np.array([point.centre[:2] for point in design.sleeves])
    found = by_corners(scan_of(ODD, 180.7 if up_deg < 0.0 else 0.7), replace(design), up_deg)
    middle = np.array(design.section_middle_mm)
    assert off_mm(found, seen(placed - middle, 180.7 if up_deg < 0.0 else 0.7)) < 0.1
    assert by_corners(scan_of(ODD), design, None).reason.startswith("the corners fit in 2 ways")


def test_a_broken_corner_is_where_its_edges_meet() -> None:
    design = design_of(PATTERN, [400.0, 300.0])
    place = seen(CORNERS[2:3], 0.7)[0]
    found = by_corners(scan_of(PATTERN, cuts=((float(place[0]), float(place[1]), 40.0),)), design)
    assert off_mm(found, seen(np.array([point.centre[:2] for point in design.sleeves]), 0.7)) < 0.1


def test_what_the_method_lacks_is_said() -> None:
    scan = scan_of(PATTERN)
    assert "needs a design" in by_corners(scan, None).reason
    assert "needs a design" in by_corners(scan, design_of(PATTERN, None)).reason
    cloud = Scan(scan.points.reshape(-1, 3)[np.isfinite(scan.points[..., 2]).ravel()])
    assert "from where it was taken" in by_corners(cloud, design_of(PATTERN, [400.0, 300.0])).reason
    # A window of the picture that none of the foot's corners lies in.
    camera = replace(scan.camera, cx=scan.camera.cx - 200.0, width=300, height=400) if scan.camera else None
    window = replace(scan, points=scan.points[:400, 200:500], camera=camera)
    assert by_corners(window, design_of(PATTERN, [400.0, 300.0])).reason.startswith("0 corners")
