"""Sections of sleeves, and directrices along which bars are swept, in the forms that exporters write."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from aadm_workbench.design.ifc.model import read_ifc
from tests.design import dialects
from tests.design.frames import shift

Ring = list[tuple[float, float]]


@pytest.mark.parametrize("sections", [1, 2, 3, 5])
def test_a_sleeve_drawn_in_sections(author: Callable[..., Any], ring: Ring, sections: int) -> None:
    """One element of several tubes on one axis is one sleeve of their whole length; the bore at the mouth counts."""
    model = author()
    model.column(model.placement(), Name="C-1")
    step = 310.0 / sections
    for x, y in ring:
        parts = [
            model.tube(36.0 - 2.0 * k, 50.0, step, model.axes((0.0, 0.0, step * k))) for k in reversed(range(sections))
        ]
        inlet = model.tube(20.0, 24.0, 60.0, model.axes((24.0, 0.0, 40.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
        model.element("IfcDiscreteAccessory", [*parts, inlet], model.placement(None, (x, y, 0.0)), Name="Grout sleeve")
    read = read_ifc(model.write())
    assert {(p.diameter_mm, p.length_mm) for p in read.columns[0].sleeves} == {(36.0, 310.0)}
    assert len(read.columns[0].sleeves) == 12
    assert read.columns[0].warnings == ("no bars of the model stand under it: it has no connecting rebars to check",)


@pytest.mark.parametrize(
    "given", [(0.0, 1.0), (0.0, 660.0), (0.0, 3.0), (None, None)], ids=["0 to 1", "length", "segments", "nothing"]
)
@pytest.mark.parametrize("unit", ["mm", "m"])
def test_the_whole_directrix_in_any_parameter(author: Callable[..., Any], given: Any, unit: str) -> None:
    model = author(unit=unit)
    (bar,) = dialects.swept_downwards(model, shift(5.0, 6.0, 0.0), 20.0, 660.0)
    if given[1] == 660.0:
        given = (0.0, model.length(660.0))
    bar.StartParam, bar.EndParam = given
    model.element("IfcReinforcingBar", [bar], model.placement())
    (point,) = read_ifc(model.write()).loose_rebars
    assert point.centre == pytest.approx([5.0, 6.0, 660.0])
    assert point.length_mm == pytest.approx(660.0)


def test_a_trimmed_line_swept_over_its_own_trims(author: Callable[..., Any]) -> None:
    model = author()
    along = model.new("IfcVector", model.direction((0.0, 0.0, 1.0)), 1.0)
    line = model.new("IfcLine", model.point((1.0, 2.0, -100.0)), along)
    ends = [[model.new("IfcParameterValue", value)] for value in (100.0, 700.0)]
    trimmed = model.new("IfcTrimmedCurve", line, *ends, True, "PARAMETER")
    bar = model.new("IfcSweptDiskSolid", trimmed, 10.0, None, 100.0, 700.0)
    model.element("IfcReinforcingBar", [bar], model.placement())
    (point,) = read_ifc(model.write()).loose_rebars
    assert (point.centre.tolist(), point.length_mm) == ([1.0, 2.0, 600.0], 600.0)


def test_corners_that_are_filleted(author: Callable[..., Any]) -> None:
    model = author()
    line = model.new("IfcPolyline", [model.point(p) for p in ((0, 0, 700.0), (0, 0, 0), (300.0, 0, 0))])
    bar = model.new("IfcSweptDiskSolidPolygonal", line, 10.0, None, None, None, 60.0)
    model.element("IfcReinforcingBar", [bar], model.placement())
    (point,) = read_ifc(model.write()).loose_rebars
    assert point.centre.tolist() == [0.0, 0.0, 700.0]
    assert point.length_mm == pytest.approx(1000.0 - 120.0 + 30.0 * math.pi)


def test_a_circle_swept_like_any_profile(author: Callable[..., Any]) -> None:
    model = author()
    line = model.new("IfcPolyline", [model.point(p) for p in ((0, 0, 0), (0, 0, 700.0))])
    disk = model.profile("IfcCircleProfileDef", Radius=10.0)
    bar = model.new(
        "IfcFixedReferenceSweptAreaSolid", disk, model.axes(), line, None, None, model.direction((1.0, 0.0, 0.0))
    )
    model.element("IfcReinforcingBar", [bar], model.placement(None, (3.0, 4.0, 5.0)))
    (point,) = read_ifc(model.write()).loose_rebars
    assert (point.centre.tolist(), point.diameter_mm) == ([3.0, 4.0, 705.0], 20.0)
