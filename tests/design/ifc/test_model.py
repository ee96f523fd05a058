"""Columns, sleeves and bars of IFC models whose truth is known, in the dialects that exporters speak."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Array, ColumnDesign

Ring = list[tuple[float, float]]
EXACT_MM = 1e-3


def xy(points: Any) -> Array:
    return np.array([point.centre[:2] for point in points])


def check_square(column: ColumnDesign, ring: Ring, top: float = 160.0) -> None:
    """A column whose twelve sleeves and bars are exact to a thousandth of a millimetre."""
    assert [point.label for point in column.sleeves] == [f"S{k}" for k in range(1, 13)]
    assert [point.label for point in column.rebars] == [f"R{k}" for k in range(1, 13)]
    truth = np.array(ring)
    centres = np.array([point.centre for point in column.sleeves])
    assert centres == pytest.approx(np.column_stack([truth, np.zeros(12)]), abs=EXACT_MM)
    tops = np.array([point.centre for point in column.rebars])
    assert tops == pytest.approx(np.column_stack([truth, np.full(12, top)]), abs=EXACT_MM)
    axes = np.array([point.axis for point in (*column.sleeves, *column.rebars)])
    assert axes == pytest.approx(np.tile([0.0, 0.0, 1.0], (24, 1)), abs=1e-9)
    assert [point.diameter_mm for point in column.sleeves] == pytest.approx([36.0] * 12, abs=EXACT_MM)
    assert [point.diameter_mm for point in column.rebars] == pytest.approx([20.0] * 12, abs=EXACT_MM)
    assert column.size_mm == pytest.approx((600.0, 600.0), abs=EXACT_MM)


def yard(model: Any, at: Any) -> None:
    """A column, its twelve sleeves and the bars under it."""
    model.column(at, Name="C-1")
    model.sleeves(at)
    model.rebars(at)


@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4", "IFC4X3"])
@pytest.mark.parametrize("unit", ["mm", "m", "foot"])
def test_units_and_schemas(author: Callable[..., Any], ring: Ring, unit: str, schema: str) -> None:
    model = author(schema=schema, unit=unit)
    yard(model, model.placement(None, (1000.0, 2000.0, 7200.0)))
    column = read_ifc(model.write()).column("C-1")
    check_square(column, ring)
    assert column.T_model_column is not None
    assert column.T_model_column[:3, 3] == pytest.approx([1000.0, 2000.0, 7200.0], abs=EXACT_MM)
    assert column.embedded_length_mm == pytest.approx(160.0, abs=EXACT_MM)


@pytest.mark.parametrize("turn_deg", [0.0, 30.0, 90.0, 180.0, 271.5])
@pytest.mark.parametrize("unit", ["mm", "m"])
def test_a_column_turned_and_6700_km_away(author: Callable[..., Any], ring: Ring, turn_deg: float, unit: str) -> None:
    """Georeferenced in the site's placement, which is turned as well; x of the column frame is the column's own."""
    model = author(unit=unit)
    turn, north = math.radians(turn_deg), math.radians(17.0)
    origin = np.array([6_700_000_123.456, -4_100_000_789.012, 45_678.9])
    site = model.placement(None, origin, None, (math.cos(north), math.sin(north), 0.0))
    yard(model, model.placement(site, (3000.0, 4000.0, 7200.0), None, (math.cos(turn), math.sin(turn), 0.0)))
    column = read_ifc(model.write()).column("C-1")
    check_square(column, ring)
    T = column.T_model_column
    assert T is not None
    assert T[:3, 0] == pytest.approx([math.cos(turn + north), math.sin(turn + north), 0.0], abs=1e-9)
    rotation = np.array([[math.cos(north), -math.sin(north)], [math.sin(north), math.cos(north)]])
    assert T[:3, 3] - origin == pytest.approx([*(rotation @ (3000.0, 4000.0)), 7200.0], abs=EXACT_MM)


def test_world_coordinate_system_moves_the_model(author: Callable[..., Any], ring: Ring) -> None:
    """The whole georeference in the context: ifcopenshell's own kernel ignores it."""
    offset = (6_700_000_000.0, 1_234_567.5, 10_000.0)
    model = author(wcs=offset)
    yard(model, model.placement(None, (100.0, 200.0, 300.0)))
    read = read_ifc(model.write())
    column = read.column("C-1")
    check_square(column, ring)
    assert column.T_model_column is not None
    assert column.T_model_column[:3, 3] - offset == pytest.approx([100.0, 200.0, 300.0], abs=EXACT_MM)
    assert read.T_model_file[:3, 3].tolist() == list(offset)


def test_placement_whose_x_runs_along_the_column(author: Callable[..., Any], ring: Ring) -> None:
    """Some exporters place columns like beams: local x up; then y is the column frame's x."""
    model = author()
    at = model.placement(None, (0.0, 0.0, 0.0))
    beam_like = model.placement(None, (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    along_x = model.axes((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    model.element("IfcColumn", [model.extrusion(profile, 3000.0, along_x)], beam_like, Name="C-1")
    model.sleeves(at)
    model.rebars(at)
    column = read_ifc(model.write()).column("C-1")
    assert column.T_model_column is not None
    # Local y is z × x of the placement: y × z of the model, its x.
    assert column.T_model_column[:3, :3] == pytest.approx(np.eye(3), abs=1e-12)
    check_square(column, ring)


def test_the_column_hangs_over_its_bars(author: Callable[..., Any], ring: Ring) -> None:
    """Bars of the storey below match after the column has come down on them; the heights tell that it has not."""
    model = author()
    model.column(model.placement(None, (0.0, 0.0, 500.0)), Name="C-1")
    model.sleeves(model.placement(None, (0.0, 0.0, 500.0)))
    model.rebars(model.placement())
    column = read_ifc(model.write()).column("C-1")
    check_square(column, ring, top=-340.0)
    assert column.embedded_length_mm is None
    assert any("above the tops of its bars" in warning for warning in column.warnings)


def test_the_nearest_storey_s_bars_count(author: Callable[..., Any], ring: Ring) -> None:
    """Bars at the same places two storeys below, in the column itself and out of its head are not under it."""
    model = author()
    at = model.placement(None, (0.0, 0.0, 7200.0))
    yard(model, at)
    model.rebars(model.placement(None, (0.0, 0.0, 3600.0)))
    own = [model.element("IfcReinforcingBar", [model.disk([(x, y, 290.0), (x, y, 3160.0)], 25.0)], at) for x, y in ring]
    read = read_ifc(model.write())
    check_square(read.column("C-1"), ring)
    taken = {point.global_id for point in read.column("C-1").rebars}
    assert not taken & {bar.GlobalId for bar in own}
    assert sorted(point.centre[2] for point in read.loose_rebars) == pytest.approx([3760.0] * 12 + [10360.0] * 12)


def test_bars_of_the_column_s_own_assembly_are_not_under_it(author: Callable[..., Any]) -> None:
    model = author()
    at = model.placement()
    unit = model.rooted("IfcElementAssembly", Name="unit", Tag="U-1")
    parts = [model.column(at, Name="C-1"), *model.sleeves(at), *model.rebars(at)]
    model.aggregate(unit, parts)
    column = read_ifc(model.write()).column("U-1")
    assert (len(column.sleeves), column.rebars) == (12, ())
    assert any("no bars of the model stand under it" in warning for warning in column.warnings)


def test_a_missing_bar_is_assumed_and_said(author: Callable[..., Any], ring: Ring) -> None:
    """rebars[k] belongs into sleeves[k], always."""
    model = author()
    at = model.placement()
    model.column(at, Name="C-1")
    model.sleeves(at)
    model.rebars(at, [place for place in ring if place != (80.0, -240.0)])
    column = read_ifc(model.write()).column("C-1")
    check_square(column, ring)
    assert "not in the model" in column.rebars[2].why
    assert column.rebars[2].global_id is None
    assert any("1 of 12 sleeves have no bar" in warning for warning in column.warnings)


def test_a_design_that_misses_itself_is_said(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    at = model.placement()
    model.column(at, Name="C-1")
    model.sleeves(at)
    model.rebars(at, [(x + 12.0 * (k == 4), y) for k, (x, y) in enumerate(ring)])
    column = read_ifc(model.write()).column("C-1")
    assert column.rebars[4].centre[:2] == pytest.approx([252.0, -80.0], abs=EXACT_MM)
    assert any("12.0 mm" in warning for warning in column.warnings)


def test_a_pattern_that_is_not_centred(author: Callable[..., Any]) -> None:
    """The origin is the centroid of the sleeves, not of the concrete; rectangular foot, four sleeves."""
    model = author()
    centres = [(-100.0, -50.0), (200.0, -50.0), (200.0, 150.0), (-100.0, 150.0)]
    model.column(model.placement(), size=(800.0, 500.0), Name="C-1")
    model.sleeves(model.placement(), centres)
    column = read_ifc(model.write()).column("C-1")
    assert xy(column.sleeves) == pytest.approx(np.array([(-150, -100), (150, -100), (150, 100), (-150, 100.0)]))
    assert column.T_model_column is not None
    assert column.T_model_column[:3, 3] == pytest.approx([50.0, 50.0, 0.0])
    assert column.size_mm == pytest.approx((800.0, 500.0))


def test_a_leaning_sleeve(author: Callable[..., Any]) -> None:
    """Its centre is where its axis meets the foot face, though its body begins 20 mm behind; the axis leans."""
    model = author()
    lean = math.radians(1.0)
    model.column(model.placement(), Name="C-1")
    straight = [(-240.0, -240.0), (240.0, -240.0), (-240.0, 240.0)]
    model.sleeves(model.placement(), straight)
    axis = np.array([math.sin(lean), 0.0, math.cos(lean)])
    start = np.array([240.0, 240.0, 0.0]) + 20.0 / math.cos(lean) * axis
    model.element("IfcDiscreteAccessory", [model.tube()], model.placement(None, start, axis, (1, 0, 0)), Name="套筒")
    column = read_ifc(model.write()).column("C-1")
    assert column.sleeves[2].centre == pytest.approx([240.0, 240.0, 0.0], abs=EXACT_MM)
    assert column.sleeves[2].axis == pytest.approx(axis, abs=1e-9)
    assert any("20 mm behind" in warning for warning in column.warnings)


@pytest.mark.parametrize("lying", [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)], ids=["standing", "lying"])
def test_a_column_in_the_mould(author: Callable[..., Any], ring: Ring, lying: tuple[float, float, float]) -> None:
    """A yard may draw it lying: its sleeves tell which end is the foot."""
    model = author()
    across = (0.0, 1.0, 0.0)
    at = model.placement(None, (500.0, 600.0, 700.0), lying, across)
    model.column(at, Name="C-1")
    model.sleeves(at)
    column = read_ifc(model.write()).column("C-1")
    assert xy(column.sleeves) == pytest.approx(np.array(ring), abs=EXACT_MM)
    assert column.T_model_column is not None
    assert column.T_model_column[:3, 2] == pytest.approx(lying)
    assert column.T_model_column[:3, 0] == pytest.approx(across)


def test_storey_grid_and_names(author: Callable[..., Any]) -> None:
    """The nearest crossing of the grid in the storey's placement; names of the assembly serve too."""
    model = author(unit="m")
    at = model.placement(None, (0.0, 0.0, 7200.0))
    storey = model.rooted("IfcBuildingStorey", Name="3F", ObjectPlacement=at)

    def axis(tag: str, start: tuple[float, float], end: tuple[float, float]) -> Any:
        return model.new("IfcGridAxis", tag, model.new("IfcPolyline", [model.point(start), model.point(end)]), True)

    rows = [axis(str(k), (0.0, 6000.0 * k), (1000.0, 6000.0 * k)) for k in range(3)]
    lines = [axis(tag, (8000.0 * k, 0.0), (8000.0 * k, 1000.0)) for k, tag in enumerate("ABC")]
    model.rooted("IfcGrid", ObjectPlacement=model.placement(at, (100.0, 0.0, 0.0)), UAxes=rows, VAxes=lines)
    unit = model.rooted("IfcElementAssembly", Name="Cast unit 7", Tag="U-7")
    place = model.placement(at, (8200.0, 11900.0, 0.0))
    model.aggregate(unit, [model.column(place, Name="Column", Tag="3141592"), *model.sleeves(place)])
    model.contain(storey, [unit])
    column = read_ifc(model.write()).column("Cast unit 7")
    assert (column.storey, column.grid, column.id) == ("3F", "B/2", "Column")
    assert {"3141592", "U-7", "Column"} < set(column.names)


def test_a_column_far_from_any_crossing_has_no_grid_position(author: Callable[..., Any]) -> None:
    model = author()
    lines = [
        model.new("IfcGridAxis", tag, model.new("IfcPolyline", [model.point(p) for p in ends]), True)
        for tag, ends in {"A": ((0, 0), (1, 0)), "1": ((0, 0), (0, 1))}.items()
    ]
    model.rooted("IfcGrid", UAxes=lines[:1], VAxes=lines[1:])
    yard(model, model.placement(None, (4000.0, 0.0, 0.0)))
    assert read_ifc(model.write()).column("C-1").grid is None


def test_columns_of_one_name_are_told_apart(author: Callable[..., Any]) -> None:
    """Ids are names that no other column has; a shared name lists whom it may mean."""
    model = author()
    for number in (1, 2):
        at = model.placement(None, (5000.0 * number, 0.0, 0.0))
        model.column(at, Name="COLUMN", Tag=f"C-{number}")
        model.sleeves(at)
    read = read_ifc(model.write())
    assert [column.id for column in read.columns] == ["C-1", "C-2"]
    with pytest.raises(DesignError, match=r"names 2 columns .*C-1, C-2"):
        read.column("COLUMN")
    assert read.column(" c-2 ").id == "C-2"
    assert read.column(read.columns[0].global_id or "").id == "C-1"
    with pytest.raises(DesignError, match=r"no column called 'C-3'\. Near to it: .*C-1"):
        read.column("C-3")


def test_no_sleeves(author: Callable[..., Any]) -> None:
    """The error names what was found instead, and what helps."""
    model = author()
    model.column(model.placement(), Name="C-1")
    model.rebars(model.placement())
    read = read_ifc(model.write())
    assert read.columns == ()
    for key in ("C-1", "C-2"):
        with pytest.raises(DesignError) as caught:
            read.column(key)
        assert "12 IfcReinforcingBar, 1 IfcColumn" in str(caught.value)
        assert 'sleeves = "' in str(caught.value)
        assert "no" in str(caught.value)


def test_reading_twice_gives_the_same(author: Callable[..., Any]) -> None:
    model = author()
    yard(model, model.placement())
    path = model.write()
    first, second = (read_ifc(path).column("C-1") for _ in range(2))
    for a, b in zip((*first.sleeves, *first.rebars), (*second.sleeves, *second.rebars), strict=True):
        assert (a.label, a.global_id, a.why, a.centre.tobytes(), a.axis.tobytes()) == (
            b.label,
            b.global_id,
            b.why,
            b.centre.tobytes(),
            b.axis.tobytes(),
        )
