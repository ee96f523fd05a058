"""What is taken for what, and what is said where a model leaves something out, contradicts itself, or names nothing."""

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.errors import DesignError
from tests.design.frames import mapped, shift

Ring = list[tuple[float, float]]


def draw_axis(model: Any, element: Any, points: Any, wrap: bool = False) -> None:
    """Draw an element as its axis alone; ``wrap`` maps it and moves it by 7 mm along x."""
    line = model.new("IfcPolyline", [model.point(p) for p in points])
    items = [mapped(model, [line], shift(7.0))] if wrap else [line]
    shape = model.new("IfcShapeRepresentation", model.body, "Axis", "Curve3D", items)
    element.Representation = model.new("IfcProductDefinitionShape", Representations=[shape])


@pytest.mark.parametrize("holder", ["element", "type", "property", "area"])
@pytest.mark.parametrize("unit", ["mm", "m", "foot"])
def test_a_bar_drawn_as_its_axis_alone(author: Callable[..., Any], holder: str, unit: str) -> None:
    """Its diameter comes from its attributes, or its type's."""
    model = author(unit=unit)
    bar = model.rooted("IfcReinforcingBar", ObjectPlacement=model.placement(None, (100.0, 0.0, 0.0)), Name="T1")
    draw_axis(model, bar, [(300.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 700.0)], wrap=True)
    if holder == "element":
        bar.NominalDiameter = model.length(25.0)
    elif holder == "area":
        bar.CrossSectionArea = math.pi * 0.0125**2
    elif holder == "type":
        kind = model.rooted("IfcReinforcingBarType", PredefinedType="MAIN", NominalDiameter=model.length(25.0))
        model.typed([bar], kind)
    else:
        value = model.file.create_entity("IfcPositiveLengthMeasure", model.length(25.0))
        single = model.new("IfcPropertySingleValue", "钢筋直径", None, value)
        group = model.rooted("IfcPropertySet", Name="钢筋", HasProperties=[single])
        model.rooted("IfcRelDefinesByProperties", RelatedObjects=[bar], RelatingPropertyDefinition=group)
    (point,) = read_ifc(model.write()).loose_rebars
    assert point.centre == pytest.approx([107.0, 0.0, 700.0], abs=1e-3)
    assert (point.diameter_mm, point.length_mm) == (pytest.approx(25.0, abs=1e-3), pytest.approx(1000.0, abs=1e-3))
    assert "drawn as its axis alone" in point.why


def test_an_axis_without_a_diameter_is_said(author: Callable[..., Any]) -> None:
    model = author()
    bar = model.rooted("IfcReinforcingBar", ObjectPlacement=model.placement())
    draw_axis(model, bar, [(0.0, 0.0, 0.0), (0.0, 0.0, 700.0)])
    model.rooted("IfcReinforcingBar", ObjectPlacement=model.placement())
    reasons = [left.reason for left in read_ifc(model.write()).not_taken]
    assert "drawn as its axis alone" in reasons[0]
    assert "says its diameter" in reasons[0]
    assert "no geometry" in reasons[1]


@pytest.mark.parametrize(
    ("ifc_class", "said"),
    [
        ("IfcTendonConduit", {"PredefinedType": "GROUTING_DUCT"}),
        ("IfcTendonAnchor", {"PredefinedType": "COUPLER"}),
        ("IfcReinforcingBar", {"Name": "半灌浆套筒"}),
        ("IfcVibrationDamper", {"Name": "Grout tube"}),
    ],
)
def test_kin_of_reinforcement_that_is_hollow(author: Callable[..., Any], ring: Ring, ifc_class: str, said: Any) -> None:
    """A reinforcing bar that is a pipe and called a sleeve is one, and no bar."""
    model = author(schema="IFC4X3")
    model.column(model.placement(), Name="C-1")
    for x, y in ring:
        model.element(ifc_class, [model.tube()], model.placement(None, (x, y, 0.0)), **said)
    read = read_ifc(model.write())
    assert len(read.columns[0].sleeves) == 12
    assert read.columns[0].rebars == ()
    assert read.loose_rebars == ()


def test_bars_called_after_their_sleeves_are_bars(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    model.rebars(model.placement(), ring, Name="灌浆套筒 连接钢筋")
    (column,) = read_ifc(model.write()).columns
    assert all(point.centre[2] == pytest.approx(160.0) for point in column.rebars)
    assert not any("not in the model" in point.why for point in column.rebars)


def test_bars_drawn_only_where_they_stick_out(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    for x, y in ring:
        model.element("IfcReinforcingBar", [model.disk([(x, y, 0.0), (x, y, 160.0)], 20.0)], model.placement())
    assert [p.length_mm for p in read_ifc(model.write()).columns[0].rebars] == pytest.approx([160.0] * 12)


@pytest.mark.parametrize("related", [True, False], ids=["part of the wall", "inside the wall"])
def test_dowels_of_walls_are_not_taken(author: Callable[..., Any], ring: Ring, related: bool) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    model.rebars(model.placement(), ring)
    at = model.placement(None, (2000.0, 500.0, 0.0), None, (0.8, 0.6, 0.0))
    profile = model.profile("IfcRectangleProfileDef", XDim=3000.0, YDim=200.0)
    wall = model.element("IfcWall", [model.extrusion(profile, 2800.0)], at, Name="W-1")
    level = 0.0 if not related else -3500.0
    dowels = [
        model.element("IfcReinforcingBar", [model.disk([(x, 40.0, level - 400.0), (x, 40.0, level + 500.0)], 16.0)], at)
        for x in (-1400.0, 0.0, 1400.0)
    ]
    if related:
        model.aggregate(wall, dowels)
    read = read_ifc(model.write())
    assert len(read.columns[0].rebars) == 12
    assert read.loose_rebars == ()
    assert [left.reason for left in read.not_taken] == ["stands in wall W-1: a dowel of a wall"] * 3


def test_a_column_drawn_twice_is_one(author: Callable[..., Any], ring: Ring) -> None:
    """Once as a column, once as a proxy that is called one."""
    model = author()
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    model.element("IfcBuildingElementProxy", [model.extrusion(profile, 3000.0)], model.placement(), Name="预制柱")
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    read = read_ifc(model.write())
    assert [column.id for column in read.columns] == ["C-1"]
    assert any("belong to column C-1" in left.reason for left in read.not_taken)


def test_the_context_of_the_body_counts(author: Callable[..., Any], ring: Ring) -> None:
    """A footprint comes first, in a context whose origin is elsewhere; the body's context has the georeference."""
    model = author(wcs=(5e8, 3e9, 0.0))
    column = model.column(model.placement(), Name="C-1")
    plan = model.new("IfcGeometricRepresentationContext", None, "Plan", 2, 1e-5, model.axes((9e6, 0.0, 0.0)))
    outline = model.polygon([(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)])
    for identifier in ("FootPrint", "Body"):
        flat = model.new("IfcShapeRepresentation", plan, identifier, "Curve2D", [outline])
        column.Representation.Representations = [flat, *column.Representation.Representations]
    model.sleeves(model.placement(), ring)
    (found,) = read_ifc(model.write()).columns
    assert found.T_model_column is not None
    assert found.T_model_column[:3, 3] == pytest.approx([5e8, 3e9, 0.0])
    assert len(found.sleeves) == 12


def test_a_type_scaled_along_its_axis(author: Callable[..., Any], ring: Ring) -> None:
    """A unit tube stretched by the mapping: the bore widens by another factor than the length."""
    model = author()
    model.column(model.placement(), Name="C-1")
    drawn = model.new("IfcShapeRepresentation", model.body, "Body", "SweptSolid", [model.tube(1.0, 1.5, 1.0)])
    source = model.new("IfcRepresentationMap", model.axes(), drawn)
    for x, y in ring:
        target = model.new(
            "IfcCartesianTransformationOperator3DnonUniform",
            LocalOrigin=model.point((x, y, 0.0)),
            Scale=36.0,
            Scale2=36.0,
            Scale3=310.0,
        )
        model.element(
            "IfcDiscreteAccessory", [model.new("IfcMappedItem", source, target)], model.placement(), Name="套筒"
        )
    (column,) = read_ifc(model.write()).columns
    assert {round(point.diameter_mm, 6) for point in column.sleeves} == {36.0}
    assert {round(point.length_mm or 0.0, 6) for point in column.sleeves} == {310.0}


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_areas_in_other_units(author: Callable[..., Any], unit: str) -> None:
    """3.14 is a bar of 20 mm in cm², in a file whose areas are in m²; the right one is not mentioned."""
    model = author(unit=unit)
    wrong, right = (
        model.element(
            "IfcReinforcingBar",
            [model.disk([(x, 0, 0), (x, 0, 560.0)], 20.0)],
            model.placement(),
            Name=name,
            CrossSectionArea=area,
        )
        for x, name, area in ((0.0, "wrong", 3.14), (500.0, "right", 3.142e-4))
    )
    (warning,) = read_ifc(model.write()).warnings
    assert f'{wrong.GlobalId} "wrong"' in warning
    assert right.GlobalId not in warning
    assert "(it is in cm²)" in warning


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_a_length_in_feet_by_its_figure(author: Callable[..., Any], unit: str) -> None:
    """The figure itself is feet, whatever the unit of the file."""
    model = author(unit=unit)
    bar = model.element("IfcReinforcingBar", [model.disk([(0, 0, 0), (0, 0, 560.0)], 20.0)], model.placement())
    bar.BarLength = 560.0 / 304.8
    (warning,) = read_ifc(model.write()).warnings
    assert bar.GlobalId in warning
    assert "(it is in feet)" in warning


def test_a_design_that_misses_the_limit_names_the_pairs(author: Callable[..., Any], ring: Ring) -> None:
    """3.2 mm beside is more than a site may do; 2.9 is only worth a word."""
    for off_mm, said in ((3.2, "R5 3.2 mm beside the axis of S5"), (2.9, "up to 2.9 mm beside")):
        model = author()
        model.column(model.placement(), Name="C-1")
        model.sleeves(model.placement(), ring)
        model.rebars(model.placement(), [(x + off_mm * (k == 4), y) for k, (x, y) in enumerate(ring)])
        (warning,) = read_ifc(model.write()).columns[0].warnings
        assert said in warning
        assert ("the design itself misses the 3 mm" in warning) == (off_mm > 3.0)


# What is said where nothing is found


def test_a_model_without_columns(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    for k in range(3):
        at = model.placement(None, (3000.0 * k, 0.0, 0.0))
        model.element("IfcBuildingElementProxy", [model.extrusion(profile, 3000.0)], at, Name=f"Pfeiler {k}")
    model.sleeves(model.placement(), ring)
    path = model.write()
    read = read_ifc(path)
    assert "no IfcColumn" in read.hint
    assert "3 IfcBuildingElementProxy called 'Pfeiler'" in read.hint
    assert "12 sleeves of the model belong to no column" in read.hint
    assert "--column 'IfcBuildingElementProxy, Name=/Pfeiler/'" in read.hint
    # Said so, it is found.
    assert len(read_ifc(path, columns="IfcBuildingElementProxy, Name=/Pfeiler/").columns) == 1


def test_a_model_whose_sleeves_say_nothing(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    for k, (x, y) in enumerate(ring):
        at = model.placement(None, (x, y, 0.0))
        model.element("IfcDiscreteAccessory", [model.cylinder(18.0, 310.0)], at, Name=f"Einbauteil ({k})")
    path = model.write()
    with pytest.raises(DesignError) as caught:
        read_ifc(path).column("C-1")
    hint = str(caught.value)
    assert "12 IfcDiscreteAccessory called" in hint
    assert "is a solid cylinder without a bore" in hint
    selector = re.findall(r"--sleeves '([^']*)'", hint)[0]
    assert len(read_ifc(path, sleeves=selector).columns[0].sleeves) == 12


def test_a_model_with_nothing_in_its_feet(author: Callable[..., Any]) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    hint = read_ifc(model.write()).hint
    assert "1 column was looked at (C-1)" in hint
    assert "may leave out what is cast in" in hint


def test_broken_items_cost_only_themselves(author: Callable[..., Any], ring: Ring) -> None:
    """One bar of twelve has a directrix of no length: the others are read, and the problem is named."""
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    disks = [model.disk([(x, y, -400.0), (x, y, 160.0)], 20.0) for x, y in ring]
    disks.append(model.new("IfcSweptDiskSolid", model.new("IfcBSplineCurve", 3, [model.point((0, 0, 0))] * 2), 10.0))
    bars = model.element("IfcReinforcingBar", disks, model.placement())
    read = read_ifc(model.write())
    assert len(read.columns[0].rebars) == 12
    assert any(bars.GlobalId in warning for warning in read.warnings)
    assert np.allclose([p.centre[2] for p in read.columns[0].rebars], 160.0)


# Drawn in peculiar ways


def test_a_foot_cut_by_a_bounded_plane(author: Callable[..., Any], ring: Ring) -> None:
    """The cut reaches over the whole section: the foot is where it is, not where the extrusion began."""
    model = author(unit="m")
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    long = model.extrusion(profile, 3200.0, model.axes((0.0, 0.0, -200.0)))
    square = model.polygon([(-400.0, -400.0), (400.0, -400.0), (400.0, 400.0), (-400.0, 400.0)])
    half = model.new(
        "IfcPolygonalBoundedHalfSpace",
        model.new("IfcPlane", model.axes()),
        True,
        model.axes((0.0, 0.0, -500.0)),
        square,
    )
    cut = model.new("IfcBooleanClippingResult", "DIFFERENCE", long, half)
    model.element("IfcColumn", [cut], model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    (column,) = read_ifc(model.write()).columns
    assert column.T_model_column is not None
    assert column.T_model_column[:3, 3] == pytest.approx([0.0, 0.0, 0.0], abs=1e-3)
    assert column.size_mm == pytest.approx((600.0, 600.0), abs=1e-3)
    assert len(column.sleeves) == 12


def test_two_bores_of_which_one_is_rare(author: Callable[..., Any], ring: Ring) -> None:
    """Ten like openings are sleeves; two of another bore are not, and the warning says so."""
    model = author()
    column = model.column(model.placement(), Name="C-1")
    for k, (x, y) in enumerate(ring):
        hole = model.cylinder(18.0 if k < 10 else 24.0, 310.0)
        model.void(column, model.element("IfcOpeningElement", [hole], model.placement(None, (x, y, 0.0))))
    (read,) = read_ifc(model.write()).columns
    assert len(read.sleeves) == 10
    assert any(warning.startswith("2 more round holes in its foot (Ø 48 mm)") for warning in read.warnings)


def test_sleeves_and_bars_exported_as_columns(author: Callable[..., Any], ring: Ring) -> None:
    """Custom parts that stand upright become IfcColumn, whatever they are; the column's name may speak of both."""
    model = author(schema="IFC2X3")
    model.column(model.placement(), Name="COLUMN with grout sleeves and starter bars", Tag="C-1")
    for x, y in ring:
        at = model.placement(None, (x, y, 0.0))
        model.element("IfcColumn", [model.tube()], at, Name="GROUT_SLEEVE")
        model.element("IfcColumn", [model.cylinder(10.0, 560.0, model.axes((0.0, 0.0, -400.0)))], at, Name="DOWEL_D20")
    read = read_ifc(model.write())
    assert [column.id for column in read.columns] == ["C-1"]
    (column,) = read.columns
    assert [point.diameter_mm for point in column.sleeves] == pytest.approx([36.0] * 12)
    assert [point.diameter_mm for point in column.rebars] == pytest.approx([20.0] * 12)
    assert [point.centre[2] for point in column.rebars] == pytest.approx([160.0] * 12)
    assert (read.loose_sleeves, read.loose_rebars) == ((), ())
