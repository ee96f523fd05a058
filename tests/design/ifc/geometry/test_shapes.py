"""Shapes of IFC products: against truth, and against the geometry kernel of ifcopenshell as a second opinion."""

import math
from collections.abc import Callable
from typing import Any

import ifcopenshell.geom
import numpy as np
import pytest

from aadm_workbench.design.ifc.geometry.shapes import Shapes, evaluator
from aadm_workbench.design.recognise.paths import joined
from aadm_workbench.design.recognise.shapes import Mesh, Prism, SweptDisk, edges
from aadm_workbench.design.recognise.tubes import tubes
from aadm_workbench.model import Array

DEGREE = math.pi / 180.0


@pytest.fixture
def start(author: Callable[..., Any]) -> Callable[..., tuple[Any, Shapes]]:
    def begin(**settings: Any) -> tuple[Any, Shapes]:
        model = author(**settings)
        return model, evaluator(model.unit_mm, DEGREE)

    return begin


def corners_of(shapes: Any) -> Array:
    found = np.unique(np.round(edges(shapes).reshape(-1, 3), 6), axis=0)
    return found[np.lexsort(found.T)]


def kernel_corners(product: Any) -> Array:
    settings: Any = ifcopenshell.geom.settings()
    settings.set("use-world-coords", True)
    drawn: Any = ifcopenshell.geom.create_shape(settings, product)
    found = np.unique(np.round(1000.0 * np.array(drawn.geometry.verts).reshape(-1, 3), 6), axis=0)
    return found[np.lexsort(found.T)]


@pytest.mark.parametrize("unit", ["mm", "m", "foot"])
def test_placements_and_mapped_items_agree_with_the_kernel(start: Callable[..., Any], unit: str) -> None:
    """Nested and tilted placements, a mapping that turns, mirrors and moves, a tilted extrusion."""
    model, shapes = start(unit=unit)
    site = model.placement(None, (1000.0, 2000.0, 300.0), (0.1, 0.2, 1.0), (1.0, 0.3, 0.0))
    storey = model.placement(site, (-50.0, 75.0, 3000.0), None, (0.0, 1.0, 0.0))
    own = model.placement(storey, (10.0, 20.0, 30.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=400.0)
    solid = model.extrusion(profile, 900.0, model.axes((5.0, 6.0, 7.0), (0.0, 1.0, 0.2)), (0.1, 0.0, 1.0))
    drawn = model.new("IfcShapeRepresentation", model.body, "Body", "SweptSolid", [solid])
    source = model.new("IfcRepresentationMap", model.axes((3.0, 2.0, 1.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)), drawn)
    target = model.new(
        "IfcCartesianTransformationOperator3D",
        Axis1=model.direction((0.0, 1.0, 0.0)),
        Axis2=model.direction((1.0, 0.0, 0.0)),
        Axis3=model.direction((0.0, 0.0, 1.0)),
        LocalOrigin=model.point((11.0, 12.0, 13.0)),
        Scale=1.0,
    )
    product = model.element("IfcColumn", [model.new("IfcMappedItem", source, target)], own)
    assert corners_of(shapes.of_product(product)) == pytest.approx(kernel_corners(product), abs=2e-5)
    assert all(isinstance(shape, Prism) for shape in shapes.of_product(product)), "fell back on the kernel"


def test_an_axis_along_x_has_a_default_reference(start: Callable[..., Any]) -> None:
    model, shapes = start()
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=400.0)
    product = model.element("IfcBeam", [model.extrusion(profile, 900.0)], model.placement(None, (1, 2, 3), (1, 0, 0)))
    assert corners_of(shapes.of_product(product)) == pytest.approx(kernel_corners(product), abs=1e-5)


def test_bent_bar_through_trimmed_arcs(start: Callable[..., Any]) -> None:
    """Up 500, a quarter turn of radius 50 given in degrees, out 300: length and both ends are known."""
    model, shapes = start(unit="m")
    circle = model.new(
        "IfcCircle", model.axes((50.0, 0.0, 500.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0)), model.length(50.0)
    )
    bend = model.new(
        "IfcTrimmedCurve",
        circle,
        [model.new("IfcParameterValue", 0.0)],
        [model.new("IfcParameterValue", 90.0)],
        True,
        "PARAMETER",
    )
    legs = [
        model.new("IfcPolyline", [model.point(p) for p in ((0, 0, 0), (0, 0, 500))]),
        bend,
        model.new("IfcPolyline", [model.point(p) for p in ((350, 0, 550), (50, 0, 550))]),
    ]
    segments = [
        model.new("IfcCompositeCurveSegment", "CONTINUOUS", forwards, leg)
        for leg, forwards in zip(legs, (True, True, False), strict=True)
    ]
    path = model.new("IfcCompositeCurve", segments, False)
    disk = model.new("IfcSweptDiskSolid", path, model.length(10.0))
    (shape,) = shapes.solids.of_item(disk)
    assert isinstance(shape, SweptDisk)
    bar = joined(shape.legs)
    assert bar[1].start == pytest.approx([0.0, 0.0, 500.0], abs=1e-9)
    assert bar[1].end == pytest.approx([50.0, 0.0, 550.0], abs=1e-9)
    assert bar[-1].end == pytest.approx([350.0, 0.0, 550.0], abs=1e-9)
    assert sum(leg.length_mm for leg in bar) == pytest.approx(800.0 + 25.0 * math.pi)


@pytest.mark.parametrize(("sense", "turn"), [(True, 270.0), (False, 90.0)])
def test_trims_by_points_and_the_sense_of_an_arc(start: Callable[..., Any], sense: bool, turn: float) -> None:
    model, shapes = start()
    circle = model.new("IfcCircle", model.axes(), 100.0)
    ends = [[model.point(p)] for p in ((0.0, 100.0, 0.0), (100.0, 0.0, 0.0))]
    curve = model.new("IfcTrimmedCurve", circle, *ends, sense, "CARTESIAN")
    (leg,) = shapes.curves.legs(curve)
    assert leg.start == pytest.approx([0.0, 100.0, 0.0], abs=1e-9)
    assert leg.end == pytest.approx([100.0, 0.0, 0.0], abs=1e-9)
    assert leg.length_mm == pytest.approx(100.0 * math.radians(turn))


def test_a_line_is_cut_to_the_swept_range(start: Callable[..., Any]) -> None:
    """Directrix IfcLine: an unbounded line, of which the solid takes a piece."""
    model, shapes = start()
    vector = model.new("IfcVector", model.direction((0.0, 0.0, 1.0)), 1.0)
    line = model.new("IfcLine", model.point((1.0, 2.0, 3.0)), vector)
    (shape,) = shapes.solids.of_item(model.new("IfcSweptDiskSolid", line, 8.0, None, 100.0, 660.0))
    (tube,) = tubes(shape)
    assert (tube.start.tolist(), tube.end.tolist()) == ([1.0, 2.0, 103.0], [1.0, 2.0, 663.0])


def test_indexed_curves_with_lines_and_arcs(start: Callable[..., Any]) -> None:
    model, shapes = start()
    points = model.new(
        "IfcCartesianPointList3D", [(0.0, 0.0, 0.0), (0, 0, 100), (20 - 200**0.5, 0, 100 + 200**0.5), (20, 0, 120)]
    )
    segments = [model.file.create_entity("IfcLineIndex", (1, 2)), model.file.create_entity("IfcArcIndex", (2, 3, 4))]
    curve = model.new("IfcIndexedPolyCurve", points, segments)
    legs = shapes.curves.legs(curve)
    assert sum(leg.length_mm for leg in legs) == pytest.approx(100.0 + 10.0 * math.pi)


def cone(model: Any, walls: tuple[float, float]) -> Any:
    ends = [
        model.profile("IfcCircleHollowProfileDef", Radius=radius, WallThickness=wall)
        for radius, wall in zip((24.0, 20.0), walls, strict=True)
    ]
    upright = model.direction((0, 0, 1))
    return model.new("IfcExtrudedAreaSolidTapered", ends[0], model.axes(), upright, model.length(310.0), ends[1])


def test_a_sleeve_that_tapers(start: Callable[..., Any]) -> None:
    """The bores at both ends are exact."""
    model, shapes = start(unit="m")
    (tube,) = tubes(shapes.solids.of_item(cone(model, (6.0, 5.0)))[0])
    assert (tube.start.tolist(), tube.end.tolist()) == ([0.0, 0.0, 0.0], [0.0, 0.0, 310.0])
    assert tube.bore_mm == pytest.approx((36.0, 30.0))
    assert tube.outer_mm == pytest.approx(48.0)


def test_a_shape_that_is_not_evaluated_comes_from_the_kernel(start: Callable[..., Any]) -> None:
    """A block: its facets give its corners."""
    model, shapes = start(unit="m")
    sides = [model.length(side) for side in (600.0, 400.0, 900.0)]
    block = model.new("IfcBlock", model.axes((1.0, 2.0, 3.0)), *sides)
    (shape,) = shapes.solids.of_item(block)
    assert isinstance(shape, Mesh)
    assert np.ptp(corners_of([shape]), axis=0) == pytest.approx([600.0, 400.0, 900.0], abs=1e-3)
    assert corners_of([shape]).min(axis=0) == pytest.approx([1.0, 2.0, 3.0], abs=1e-3)


def test_broken_geometry_is_named_and_left_out(start: Callable[..., Any]) -> None:
    model, shapes = start()
    nowhere = model.direction((0.0, 0.0, 0.0))
    placement = model.new("IfcLocalPlacement", None, model.new("IfcAxis2Placement3D", model.point((0, 0, 0)), nowhere))
    product = model.column(placement)
    assert shapes.of_product(product) == ()
    assert product.GlobalId in shapes.problems[0]
    assert "no length" in shapes.problems[0]


def test_placements_in_a_circle_end(start: Callable[..., Any]) -> None:
    model, shapes = start()
    first = model.placement()
    second = model.placement(first)
    first.PlacementRelTo = second
    assert shapes.of_product(model.column(second)) == ()
    assert "relative to itself" in shapes.problems[0]
