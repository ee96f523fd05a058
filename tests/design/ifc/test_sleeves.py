"""What is a grouting sleeve, in all the ways in which it is drawn and named, and what is none."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.errors import DesignError

Ring = list[tuple[float, float]]


def draw(model: Any, items: Callable[[], Sequence[Any]], ring: Ring, ifc_class: str, **said: Any) -> list[Any]:
    """One element of a column's foot per place."""
    return [model.element(ifc_class, items(), model.placement(None, (x, y, 0.0)), **said) for x, y in ring]


def check(read: ModelDesign, ring: Ring, bore: float = 36.0, length: float | None = 310.0) -> None:
    (column,) = read.columns
    assert np.array([point.centre for point in column.sleeves]) == pytest.approx(
        np.column_stack([np.array(ring), np.zeros(len(ring))]), abs=1e-3
    )
    assert [point.diameter_mm for point in column.sleeves] == pytest.approx([bore] * len(ring), abs=1e-3)
    assert [point.length_mm for point in column.sleeves] == pytest.approx([length] * len(ring), abs=1e-3)


def bored(model: Any) -> Any:
    return model.new("IfcBooleanResult", "DIFFERENCE", model.cylinder(24.0, 310.0), model.cylinder(18.0, 400.0))


def turned(model: Any) -> Any:
    corners = [(18.0, 0.0), (24.0, 0.0), (24.0, 310.0), (18.0, 310.0)]
    profile = model.new("IfcArbitraryClosedProfileDef", "AREA", None, model.polygon(corners))
    axis = model.new("IfcAxis1Placement", model.point((0.0, 0.0, 0.0)), model.direction((0.0, 1.0, 0.0)))
    # The profile's y is the axis; the position stands it up.
    upright = model.axes((0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0))
    return model.new("IfcRevolvedAreaSolid", profile, upright, axis, 360.0)


def faceted_brep(model: Any) -> Any:
    """Faces with holes at both ends, polygons around."""
    n, corners = 24, {}
    for radius in (18.0, 24.0):
        for z in (0.0, 310.0):
            angle = np.arange(n) * 2.0 * np.pi / n
            corners[radius, z] = [model.point((radius * np.cos(a), radius * np.sin(a), z)) for a in angle]

    def loop(points: Sequence[Any], kind: str = "IfcFaceOuterBound") -> Any:
        return model.new(kind, model.new("IfcPolyLoop", points), True)

    faces = [
        model.new("IfcFace", [loop(corners[18.0, z][::-1], "IfcFaceBound"), loop(corners[24.0, z])])
        for z in (0.0, 310.0)
    ]
    for radius in (18.0, 24.0):
        low, high = corners[radius, 0.0], corners[radius, 310.0]
        faces += [
            model.new("IfcFace", [loop([low[k], low[(k + 1) % n], high[(k + 1) % n], high[k]])]) for k in range(n)
        ]
    return model.new("IfcFacetedBrep", model.new("IfcClosedShell", faces))


DRAWN = {
    "hollow extrusion": lambda model: model.tube(),
    "bored cylinder": bored,
    "turned": turned,
    "triangles": lambda model: model.faceted_tube(36.0, 48.0, 310.0),
    "faceted brep": faceted_brep,
    "arbitrary profile with voids": lambda model: model.extrusion(
        model.new(
            "IfcArbitraryProfileDefWithVoids",
            "AREA",
            None,
            model.new("IfcCircle", model._flat(), model.length(24.0)),
            [model.new("IfcCircle", model._flat(), model.length(18.0))],
        ),
        310.0,
    ),
    "pipe": lambda model: model.new(
        "IfcSweptDiskSolid",
        model.new("IfcPolyline", [model.point((0, 0, 0)), model.point((0, 0, 310.0))]),
        model.length(24.0),
        model.length(18.0),
    ),
}


@pytest.mark.parametrize("drawn", DRAWN)
@pytest.mark.parametrize("unit", ["mm", "m"])
def test_however_it_is_drawn(author: Callable[..., Any], ring: Ring, drawn: str, unit: str) -> None:
    model = author(unit=unit)
    model.column(model.placement(), Name="C-1")
    draw(model, lambda: [DRAWN[drawn](model)], ring, "IfcDiscreteAccessory", Name="灌浆套筒")
    read = read_ifc(model.write())
    check(read, ring)
    assert "灌浆套筒" in read.columns[0].sleeves[0].why


@pytest.mark.parametrize(
    ("ifc_class", "said"),
    [
        ("IfcDiscreteAccessory", {"Name": "全灌浆套筒 GTQ4Z-20"}),
        ("IfcDiscreteAccessory", {"Name": "GTB4J-20-A"}),
        ("IfcMechanicalFastener", {"ObjectType": "Grouted splice sleeve", "PredefinedType": "USERDEFINED"}),
        ("IfcBuildingElementProxy", {"Name": "NMB splice-sleeve 8U-X"}),
        ("IfcBuildingElementProxy", {"Name": "スリーブ D22用"}),
        ("IfcBeam", {"Name": "灌漿套筒"}),
        ("IfcBuildingElementProxy", {"Name": "koppelhuls 20"}),
        ("IfcFlowSegment", {"Name": "波纹管 36"}),
    ],
)
def test_whatever_it_is_called(author: Callable[..., Any], ring: Ring, ifc_class: str, said: dict[str, str]) -> None:
    """Classes and names of five countries; told by name, so two sleeves are enough."""
    model = author()
    model.column(model.placement(), Name="C-1")
    draw(model, lambda: [model.tube()], [ring[0], ring[6]], ifc_class, **said)
    (column,) = read_ifc(model.write()).columns
    assert len(column.sleeves) == 2
    assert next(iter(said.values())) in column.sleeves[0].why


def test_told_by_predefined_type(author: Callable[..., Any], ring: Ring) -> None:
    """IFC4X3 has couplers; no name at all."""
    model = author(schema="IFC4X3")
    model.column(model.placement(), Name="C-1")
    draw(model, lambda: [model.tube()], ring[:2], "IfcMechanicalFastener", PredefinedType="COUPLER")
    assert len(read_ifc(model.write()).columns[0].sleeves) == 2


def test_told_by_a_property(author: Callable[..., Any], ring: Ring) -> None:
    """Some programs call every part the same, and say what it is in a property set of their own."""
    model = author()
    model.column(model.placement(), Name="C-1")
    sleeves = draw(model, lambda: [model.tube()], ring[:2], "IfcBuildingElementProxy", Name="基本体")
    value = model.new("IfcPropertySingleValue", "类型", None, model.file.create_entity("IfcText", "半灌浆套筒"))
    group = model.rooted("IfcPropertySet", Name="构件信息", HasProperties=[value])
    model.rooted("IfcRelDefinesByProperties", RelatedObjects=sleeves, RelatingPropertyDefinition=group)
    assert len(read_ifc(model.write()).columns[0].sleeves) == 2


def test_told_by_its_type(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    sleeves = draw(model, lambda: [model.tube()], ring, "IfcDiscreteAccessory", Name="part")
    model.typed(sleeves, model.rooted("IfcDiscreteAccessoryType", Name="Grouting sleeve", PredefinedType="USERDEFINED"))
    check(read_ifc(model.write()), ring)


@pytest.mark.parametrize("voiding", [True, False], ids=["voids the column", "no relation"])
def test_round_openings_without_a_name(author: Callable[..., Any], ring: Ring, voiding: bool) -> None:
    """Solid cylinders that are openings are holes; they may reach below the foot, and lack the relation."""
    model = author()
    column = model.column(model.placement(), Name="C-1")
    below = model.axes((0.0, 0.0, -25.0))
    openings = draw(model, lambda: [model.cylinder(18.0, 335.0, below)], ring, "IfcOpeningElement", Name="")
    for opening in openings if voiding else []:
        model.void(column, opening)
    read = read_ifc(model.write())
    check(read, ring)
    assert any("by their shape alone" in warning for warning in read.columns[0].warnings)


def test_two_overlapping_openings_are_one_sleeve(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    column = model.column(model.placement(), Name="C-1")
    for depth in (310.0, 150.0):
        for opening in draw(model, lambda depth=depth: [model.cylinder(18.0, depth)], ring, "IfcOpeningElement"):
            model.void(column, opening)
    check(read_ifc(model.write()), ring)


def test_a_sleeve_in_its_opening_is_one_sleeve(author: Callable[..., Any], ring: Ring) -> None:
    """The opening fits the sleeve's outside: the bore counts."""
    model = author()
    column = model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    for opening in draw(model, lambda: [model.cylinder(24.0, 310.0)], ring, "IfcOpeningElement"):
        model.void(column, opening)
    read = read_ifc(model.write())
    check(read, ring)
    assert read.columns[0].warnings == ("no bars of the model stand under it: it has no connecting rebars to check",)


def test_holes_in_the_column_s_own_profile(author: Callable[..., Any], ring: Ring) -> None:
    """A foot piece extruded with twelve holes, the shaft above it without."""
    model = author()
    square = [(-300.0, -300.0), (300.0, -300.0), (300.0, 300.0), (-300.0, 300.0)]
    holes = [model.new("IfcCircle", model.new("IfcAxis2Placement2D", model.point(place)), 18.0) for place in ring]
    outline = model.polygon(square)
    foot = model.extrusion(model.new("IfcArbitraryProfileDefWithVoids", "AREA", None, outline, holes), 310.0)
    shaft = model.extrusion(
        model.new("IfcArbitraryClosedProfileDef", "AREA", None, outline), 2690.0, model.axes((0.0, 0.0, 310.0))
    )
    model.element("IfcColumn", [foot, shaft], model.placement(), Name="C-1")
    read = read_ifc(model.write())
    check(read, ring)
    assert {point.global_id for point in read.columns[0].sleeves} == {read.columns[0].global_id}


def test_many_sleeves_in_one_element(author: Callable[..., Any], ring: Ring) -> None:
    """Twelve mapped items in one accessory: twelve sleeves that share its GlobalId."""
    model = author()
    model.column(model.placement(), Name="C-1")
    drawn = model.new("IfcShapeRepresentation", model.body, "Body", "SweptSolid", [model.tube()])
    source = model.new("IfcRepresentationMap", model.axes(), drawn)
    origins = [model.point((x, y, 0.0)) for x, y in ring]
    targets = [model.new("IfcCartesianTransformationOperator3D", LocalOrigin=origin) for origin in origins]
    items = [model.new("IfcMappedItem", source, target) for target in targets]
    model.element("IfcDiscreteAccessory", items, model.placement(), Name="套筒组")
    read = read_ifc(model.write())
    check(read, ring)
    assert len({point.global_id for point in read.columns[0].sleeves}) == 1


def test_sockets_are_no_sleeves(author: Callable[..., Any], ring: Ring) -> None:
    """套筒 also names sockets for lifting and bracing, 套管 pipe sleeves, and a stub in the foot is too short."""
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    socket = lambda: [model.tube(24.0, 34.0, 150.0)]  # noqa: E731
    model.element("IfcDiscreteAccessory", socket(), model.placement(None, (0.0, 0.0, 2850.0)), Name="套筒 M24")
    model.element("IfcDiscreteAccessory", socket(), model.placement(None, (0.0, 0.0, 0.0)), Name="吊装套筒 M24")
    model.element("IfcDiscreteAccessory", [model.tube(20.0, 30.0, 60.0)], model.placement(), Name="直螺纹套筒")
    sideways = model.placement(None, (300.0, 0.0, 150.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    model.element("IfcDiscreteAccessory", socket(), sideways, Name="套筒 M20")
    read = read_ifc(model.write())
    check(read, ring)
    assert read.loose_sleeves == ()
    reasons = {left.name: left.reason for left in read.not_taken}
    assert reasons["套筒 M24"].endswith("does not open in its foot face")
    assert reasons["套筒 M20"].endswith("does not open in its foot face")
    assert "吊装" in reasons["吊装套筒 M24"]
    assert "60 mm long" in reasons["直螺纹套筒"]


def test_more_holes_than_named_sleeves_are_said(author: Callable[..., Any], ring: Ring) -> None:
    """Ten have a name, two do not: a column that is checked for ten only would pass wrongly, without a word."""
    model = author()
    column = model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring[:10])
    for opening in draw(model, lambda: [model.cylinder(18.0, 310.0)], ring[10:], "IfcOpeningElement"):
        model.void(column, opening)
    (read,) = read_ifc(model.write()).columns
    assert len(read.sleeves) == 10
    assert any(warning.startswith("2 more round holes in its foot (Ø 36 mm)") for warning in read.warnings)


def test_a_solid_sleeve_is_taken_by_name_and_said(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    draw(model, lambda: [model.cylinder(24.0, 310.0)], ring, "IfcDiscreteAccessory", Name="灌浆套筒")
    read = read_ifc(model.write())
    check(read, ring, bore=48.0)
    assert any("without a bore" in warning for warning in read.columns[0].warnings)


def test_solid_cylinders_without_a_name_are_nothing(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    draw(model, lambda: [model.cylinder(24.0, 310.0)], ring, "IfcDiscreteAccessory", Name="part")
    assert read_ifc(model.write()).columns == ()


def test_selectors(author: Callable[..., Any], ring: Ring) -> None:
    """A selector is the last word about class and name: a pattern matches anywhere in it."""
    model = author()
    model.column(model.placement(), Name="Stütze", Tag="C-1")
    draw(model, lambda: [model.cylinder(18.0, 310.0)], ring, "IfcDiscreteAccessory", Name="Einbauteil 4711 Rohr")
    path = model.write()
    assert read_ifc(path).columns == ()
    read = read_ifc(path, sleeves="IfcDiscreteAccessory, Name=/Rohr|Huelse/", columns="IfcColumn, Tag=C-1")
    check(read, ring)
    assert "selector" in read.columns[0].sleeves[0].why


@pytest.mark.parametrize(
    ("selectors", "said"),
    [
        (
            {"sleeves": "IfcDiscreteAccessory, Name=/Muffe/"},
            'sleeves = ".*" finds no element .* 12 IfcDiscreteAccessory',
        ),
        ({"columns": "IfcWall"}, 'columns = "IfcWall" finds no element'),
        ({"rebars": "IfcReinforcingBar &&&"}, 'rebars = "IfcReinforcingBar &&&" is not understood'),
        ({"sleeves": "IfcDiscreteAccessory, Name=/(/"}, "is not understood"),
    ],
)
def test_selectors_that_find_nothing(
    author: Callable[..., Any], ring: Ring, selectors: dict[str, str], said: str
) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    with pytest.raises(DesignError, match=said):
        read_ifc(model.write(), **selectors)


def test_sleeves_without_a_column_are_loose(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.sleeves(model.placement(None, (0.0, 0.0, 500.0)), ring)
    read = read_ifc(model.write())
    assert read.columns == ()
    assert [point.centre.tolist() for point in read.loose_sleeves] == [[x, y, 500.0] for x, y in ring]
    assert {(point.label, point.diameter_mm) for point in read.loose_sleeves} == {("", 36.0)}


def test_a_column_of_proxies(author: Callable[..., Any], ring: Ring) -> None:
    """Chinese programs export columns as proxies: told by name."""
    model = author()
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    model.element("IfcBuildingElementProxy", [model.extrusion(profile, 3000.0)], model.placement(), Name="预制柱 PCZ-1")
    model.sleeves(model.placement(), ring)
    check(read_ifc(model.write()), ring)


def test_a_clipped_column_stands_on_its_cut(author: Callable[..., Any], ring: Ring) -> None:
    """Extruded from 200 mm below and cut at its foot: the face is where the cut is."""
    model = author()
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    long = model.extrusion(profile, 3200.0, model.axes((0.0, 0.0, -200.0)))
    plane = model.new("IfcPlane", model.axes())
    cut = model.new("IfcBooleanClippingResult", "DIFFERENCE", long, model.new("IfcHalfSpaceSolid", plane, True))
    model.element("IfcColumn", [cut], model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    check(read_ifc(model.write()), ring)


@pytest.mark.parametrize("selector", [None, "IfcElementAssembly"])
@pytest.mark.parametrize("part", ["IfcColumn", "IfcBuildingElementPart"])
def test_an_assembly_stands_for_its_concrete(
    author: Callable[..., Any], ring: Ring, part: str, selector: str | None
) -> None:
    """A cast unit without a shape of its own: its column, or whatever part of it is no accessory."""
    model = author()
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    concrete = model.element(part, [model.extrusion(profile, 3000.0)], model.placement(), Name="预制柱 7")
    unit = model.rooted("IfcElementAssembly", Name="预制柱 7", Tag="U-7", ObjectPlacement=model.placement())
    model.aggregate(unit, [concrete, *model.sleeves(model.placement(), ring)])
    read = read_ifc(model.write(), columns=selector)
    check(read, ring)
    assert read.column("U-7").global_id == (concrete if part == "IfcColumn" else unit).GlobalId
