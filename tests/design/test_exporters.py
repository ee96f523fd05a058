"""Models in the manner of the programs that engineers use, with what is peculiar to each."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.model import ColumnDesign
from tests.design import dialects
from tests.design.authoring import Author
from tests.design.frames import axes, mapped, on, placement, shift

Ring = list[tuple[float, float]]
EXACT_MM = 1e-3


def check(column: ColumnDesign, ring: Ring, top: float, bore: float = 36.0) -> None:
    """Sleeves and bars where they were drawn, in the column frame, in the order of their labels."""
    truth = np.array(ring)
    sleeves = np.array([point.centre for point in column.sleeves])
    assert sleeves == pytest.approx(np.column_stack([truth, np.zeros(len(ring))]), abs=EXACT_MM)
    tops = np.array([point.centre for point in column.rebars])
    assert tops == pytest.approx(np.column_stack([truth, np.full(len(ring), top)]), abs=EXACT_MM)
    assert [point.diameter_mm for point in column.sleeves] == pytest.approx([bore] * len(ring), abs=EXACT_MM)
    assert [point.diameter_mm for point in column.rebars] == pytest.approx([20.0] * len(ring), abs=EXACT_MM)


def stands_at(column: ColumnDesign, T: Any) -> None:
    assert column.T_model_column is not None
    assert column.T_model_column[:3, :3] == pytest.approx(T[:3, :3], abs=1e-9)
    assert column.T_model_column[:3, 3] - T[:3, 3] == pytest.approx(np.zeros(3), abs=EXACT_MM)


def upright(x: float, y: float, z: float, turn_deg: float) -> Any:
    T = shift(x, y, z)
    c, s = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
    T[:2, :2] = [[c, -s], [s, c]]
    return T


def test_tekla(author: Callable[..., Any], ring: Ring) -> None:
    """IFC2X3. A cast unit; sleeves are custom parts of facets; 62 bars in one entity, Ø over the ribs; GUID tags."""
    model: Author = author(schema="IFC2X3")
    T = upright(6000.0, 4000.0, 3600.0, 90.0)
    at = placement(model, None, T)
    column = model.column(at, Name="COLUMN", Tag="ID50d0a3c4-0000-0016-3136-333330343133")
    sleeves = [
        model.element(
            "IfcBeam" if k % 2 else "IfcDiscreteAccessory",
            [dialects.faceted_brep(model, np.eye(4), 36.0, 48.0, 310.0)],
            placement(model, at, shift(x, y)),
            Name="GROUT_SLEEVE",
            ObjectType="GS20",
            Tag=f"ID50d0a3c4-0000-0016-3136-3333303431{k:02d}",
        )
        for k, (x, y) in enumerate(ring)
    ]
    unit = model.rooted("IfcElementAssembly", Name="CAST UNIT", Tag="PC/3", ObjectPlacement=at)
    tie = [(-270.0, -270.0, 100.0), (270.0, -270.0, 100.0), (270.0, 270.0, 100.0), (-270.0, -270.0, 100.0)]
    said = {"NominalDiameter": 23.5, "CrossSectionArea": 3.14, "BarRole": "MAIN"}
    ties = model.element(
        "IfcReinforcingBar", [model.disk(tie, 10.0)], at, Name="STIRRUP", **(said | {"NominalDiameter": 10.0})
    )
    model.aggregate(unit, [column, *sleeves, ties])
    others = [(3000.0 + 150.0 * k, -900.0) for k in range(50)]
    disks = [dialects.bent_composite(model, shift(x, y, -500.0), 20.0, 660.0)[0] for x, y in [*ring, *others]]
    bars = model.element("IfcReinforcingBar", disks, at, Name="REBAR", **said)
    read = read_ifc(model.write())
    found = read.column("PC/3")
    check(found, ring, top=160.0)
    stands_at(found, T)
    assert found.rebar_outer_diameter_mm == 23.5
    assert {point.global_id for point in found.rebars} == {bars.GlobalId}
    assert len(read.loose_rebars) == 50
    assert any("NominalDiameter is 23.5 mm (over the ribs)" in w and bars.GlobalId in w for w in read.warnings)
    assert any("CrossSectionArea" in w and "(it is in cm²)" in w and bars.GlobalId in w for w in read.warnings)
    assert "over the ribs" in found.rebars[0].why


@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4"])
def test_revit(author: Callable[..., Any], ring: Ring, schema: str) -> None:
    """Couplers mapped, their sizes in feet (IFC2X3); bars of arcs and lines cut by parameter, BarLength in feet."""
    model: Author = author(schema=schema)
    T_site = upright(12_345.6, -6_543.2, 450.0, 17.0)
    T_site[:3, 3] += (500_000_000.0, 3_400_000_000.0, 0.0)
    storey = placement(model, placement(model, None, T_site), shift(z=3600.0))
    T = upright(7200.0, 8400.0, 0.0, 30.0)
    at = placement(model, storey, T)
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    body = mapped(model, [model.extrusion(profile, 3000.0)], np.eye(4))
    model.element("IfcColumn", [body], at, Name="M_Concrete-Square-Column:600 x 600mm:338255", Tag="338255")
    feet = {"NominalDiameter": 48.0 / 304.8, "NominalLength": 310.0 / 304.8} if schema == "IFC2X3" else {}
    said = {"PredefinedType": "USERDEFINED", "ObjectType": "Coupler"} if schema == "IFC4" else {}
    couplers = [
        model.element(
            "IfcMechanicalFastener",
            [mapped(model, [dialects.hollow_extrusion(model, np.eye(4), 36.0, 48.0, 310.0)], T @ shift(x, y))],
            storey,
            Name=f"M_Grout Sleeve:20M:4711: {k}",
            **feet,
            **said,
        )
        for k, (x, y) in enumerate(ring)
    ]
    model.rooted(
        "IfcRelAssignsToGroup", RelatedObjects=couplers, RelatingGroup=model.rooted("IfcGroup", Name="Coupler")
    )
    for k, (x, y) in enumerate(ring):
        (bar,) = dialects.bent_composite(model, T @ shift(x, y, -500.0), 20.0, 660.0)
        bar.StartParam, bar.EndParam = 0.0, 1.0 + 90.0 + 300.0  # a polyline's leg, 90 degrees, a line of 300 mm
        length = {"BarLength": dialects.bent_length(660.0) / 304.8}
        required = {"NominalDiameter": 20.0, "CrossSectionArea": 3.1416e-4} if schema == "IFC2X3" else {}
        role = {"BarRole": "MAIN"} if schema == "IFC2X3" else {}
        model.element(
            "IfcReinforcingBar",
            [bar],
            storey,
            Name=f"Rebar Bar:20M : Shape M_17A:47: {k}",
            **length,
            **required,
            **role,
        )
    read = read_ifc(model.write())
    found = read.column("338255")
    check(found, ring, top=160.0)
    stands_at(found, T_site @ shift(z=3600.0) @ T)
    (slip,) = [w for w in read.warnings if "BarLength" in w]
    assert "(it is in feet)" in slip
    assert all((point.global_id or "?") in slip for point in found.rebars)
    sizes = [w for w in read.warnings if "NominalLength" in w or "NominalDiameter" in w]
    assert len(sizes) == (2 if schema == "IFC2X3" else 0)
    assert all("(it is in feet)" in w and couplers[0].GlobalId in w for w in sizes)


@pytest.mark.parametrize("voids", [True, False], ids=["related", "unrelated"])
def test_allplan(author: Callable[..., Any], ring: Ring, voids: bool) -> None:
    """Bars called " ", sixteen in one entity; two openings per hole, not always related; a fragment."""
    model: Author = author(schema="IFC4", unit="m")
    T = upright(6_700_000_000.125, 5_300_000_000.5, 120_000.25, 211.0)
    at = placement(model, None, T)
    column = model.column(at, Name="Stütze", Tag="S-7")
    for x, y in ring:
        for begin, depth in ((-20.0, 200.0), (0.0, 310.0)):
            hole = model.cylinder(18.0, depth, axes(model, shift(x, y, begin)))
            opening = model.element("IfcOpeningElement", [hole], at, Name="Aussparung")
            if voids:
                model.void(column, opening)
    others = [(800.0 + 100.0 * k, 0.0) for k in range(4)]
    disks = [dialects.swept_downwards(model, shift(x, y, -400.0), 20.0, 560.0)[0] for x, y in [*ring, *others]]
    spiral = [(250.0 * math.cos(t / 4), 250.0 * math.sin(t / 4), 40.0 + 3.0 * t) for t in range(120)]
    disks += [model.disk([(0.0, 0.0, 0.0), (0.0, 0.0, 0.03)], 20.0), model.disk(spiral, 8.0)]
    bars = model.element("IfcReinforcingBar", disks, at, Name=" ")
    read = read_ifc(model.write())
    found = read.column("S-7")
    check(found, ring, top=160.0)
    stands_at(found, T)
    assert {point.global_id for point in found.rebars} == {bars.GlobalId}
    assert len(read.loose_rebars) == 4
    assert {"0.03 mm long: a fragment"} <= {left.reason.removeprefix("is ") for left in read.not_taken}
    assert any("spiral" in left.reason for left in read.not_taken)


def _made_by_freecad(model: Author) -> None:
    organisation = model.new("IfcOrganization", Name="The FreeCAD project")
    model.new("IfcApplication", organisation, "0.20.2", "FreeCAD", "FreeCAD")


def _square_tube(model: Author, T: Any, inner: float, outer: float, length: float) -> Any:
    """A round tube as FreeCAD writes it in metres: its facets are so coarse that four sides are left."""
    rings = {
        (d, z): [model.point(p) for p in on(T, dialects.circle(d / 2.0, z, 4))]
        for d in (inner, outer)
        for z in (0.0, length)
    }
    faces = []
    for d in (inner, outer):
        low, high = rings[d, 0.0], rings[d, length]
        for k in range(4):
            faces += [(low[k - 1], low[k], high[k]), (low[k - 1], high[k], high[k - 1])]
    for z in (0.0, length):
        near, far = rings[inner, z], rings[outer, z]
        for k in range(4):
            faces += [(near[k - 1], near[k], far[k]), (near[k - 1], far[k], far[k - 1])]
    bounds = [model.new("IfcFaceOuterBound", model.new("IfcPolyLoop", face), True) for face in faces]
    return model.new("IfcFacetedBrep", model.new("IfcClosedShell", [model.new("IfcFace", [bound]) for bound in bounds]))


@pytest.mark.parametrize("how", ["sleeves", "openings", "holes"])
def test_freecad_0_20(author: Callable[..., Any], ring: Ring, how: str) -> None:
    """Metres; no placements: all in coordinates; circles with four sides; bars by the row, without diameter."""
    model: Author = author(schema="IFC4", unit="m")
    _made_by_freecad(model)
    T = upright(1000.0, 2000.0, 3600.0, 30.0)
    at = model.placement()
    square = [(-300.0, -300.0), (300.0, -300.0), (300.0, 300.0), (-300.0, 300.0)]
    if how == "holes":
        body = dialects.pierced_box(model, T, square, ring, 36.0, 310.0, sides=4)
        column = model.element("IfcColumn", [body], at, Name="Column")
    else:
        profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
        column = model.element("IfcColumn", [model.extrusion(profile, 3000.0, axes(model, T))], at, Name="Column")
    for k, (x, y) in enumerate(ring if how == "sleeves" else []):
        tube = _square_tube(model, T @ shift(x, y), 36.0, 48.0, 310.0)
        model.element("IfcDiscreteAccessory", [tube], at, Name=f"灌浆套筒 {k:03d}", PredefinedType="ANCHORPLATE")
    for k, (x, y) in enumerate(ring if how == "openings" else []):
        opening = model.element(
            "IfcOpeningElement", [dialects.rod(model, T @ shift(x, y), 36.0, 310.0, 4)], at, Name=f"H{k:03d}"
        )
        model.void(column, opening)
    for row in (ring[:6], ring[6:]):
        disks = [dialects.swept_polyline(model, T @ shift(x, y, -400.0), 20.0, 560.0)[0] for x, y in row]
        model.element("IfcReinforcingBar", disks, at, Name="StraightRebar")
    read = read_ifc(model.write())
    _check_turned(read, ring, T)


def _check_turned(read: ModelDesign, ring: Ring, T: Any) -> None:
    """The column frame keeps the axes of the (missing) placement; the column stands turned in it."""
    (column,) = read.columns
    assert column.T_model_column is not None
    assert column.T_model_column[:3, :3] == pytest.approx(np.eye(3), abs=1e-9)
    for points, z in ((column.sleeves, 0.0), (column.rebars, 160.0)):
        truth = on(T, [(x, y, z) for x, y in ring])
        found = np.array([point.centre for point in points]) + column.T_model_column[:3, 3]
        assert np.linalg.norm(found[:, np.newaxis] - truth, axis=2).min(axis=0) == pytest.approx(
            np.zeros(12), abs=EXACT_MM
        )
    assert {round(point.diameter_mm, 6) for point in column.sleeves} == {36.0}
    assert {round(point.diameter_mm, 6) for point in column.rebars} == {20.0}
    assert column.size_mm == pytest.approx((600.0, 600.0), abs=EXACT_MM)
    assert all(s.label[1:] == r.label[1:] for s, r in zip(column.sleeves, column.rebars, strict=True))


def test_a_square_pocket_of_another_program_is_no_sleeve(author: Callable[..., Any], ring: Ring) -> None:
    model: Author = author(schema="IFC4", unit="m")
    column = model.column(model.placement(), Name="C-1")
    for x, y in ring:
        opening = model.element(
            "IfcOpeningElement", [dialects.rod(model, shift(x, y), 36.0, 310.0, 4)], model.placement()
        )
        model.void(column, opening)
    assert read_ifc(model.write()).columns == ()


def test_freecad_1(author: Callable[..., Any], ring: Ring) -> None:
    """A native model: metres and degrees, a Plan context, a drawing in it before the body, polygonal face sets."""
    model: Author = author(schema="IFC4", unit="m")
    _made_by_freecad(model)
    plan = model.new("IfcGeometricRepresentationContext", None, "Plan", 2, 1e-5, model.axes((5000.0, 0.0, 0.0)))
    model.project.RepresentationContexts = [*model.project.RepresentationContexts, plan]
    storey = placement(model, placement(model, placement(model, None, shift()), shift()), shift(z=3600.0))
    T = upright(1500.0, 2500.0, 0.0, 75.0)
    at = placement(model, storey, T)
    column = model.column(at, Name="Structure")
    outline = model.polygon([(-300.0, -300.0), (300.0, -300.0), (300.0, 300.0), (-300.0, 300.0)])
    drawing = model.new("IfcShapeRepresentation", plan, "Annotation", "Curve2D", [outline])
    column.Representation.Representations = [drawing, *column.Representation.Representations]
    for k, (x, y) in enumerate(ring):
        tube = dialects.polygonal(model, np.eye(4), 36.0, 48.0, 310.0)
        model.element(
            "IfcBuildingElementProxy", [tube], placement(model, at, shift(x, y)), Name=f"Grouting sleeve{k:03d}"
        )
    disks = [dialects.bent_indexed(model, shift(x, y, -500.0), 20.0, 660.0)[0] for x, y in ring]
    model.element("IfcReinforcingBar", disks, at, Name="Rebar")
    read = read_ifc(model.write())
    found = read.column("Structure")
    check(found, ring, top=160.0)
    stands_at(found, shift(z=3600.0) @ T)
    assert read.warnings == ()
