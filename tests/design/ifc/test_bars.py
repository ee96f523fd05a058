"""Which bars are connecting rebars, what is measured on them, and what attributes are believed."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.recognise.pattern import nominal_of_over_ribs, over_ribs_mm

Ring = list[tuple[float, float]]


@pytest.fixture
def bar(author: Callable[..., Any]) -> Callable[..., Any]:
    """Read a model of one reinforcing bar."""

    def read(points: list[tuple[float, float, float]], diameter: float = 20.0, unit: str = "mm", **said: Any) -> Any:
        model = author(unit=unit)
        written = {name: model.length(v) if isinstance(v, float) else v for name, v in said.items()}
        model.element("IfcReinforcingBar", [model.disk(points, diameter)], model.placement(), **written)
        return read_ifc(model.write())

    return read


def test_an_upright_bar_ends_at_its_top(bar: Callable[..., Any]) -> None:
    """Whichever way it is drawn, and when it leans a little."""
    for points in ([(1.0, 2.0, 0.0), (4.0, 6.0, 600.0)], [(4.0, 6.0, 600.0), (1.0, 2.0, 0.0)]):
        (point,) = bar(points).loose_rebars
        assert point.centre.tolist() == [4.0, 6.0, 600.0]
        assert point.axis == pytest.approx(np.array([3.0, 4.0, 600.0]) / math.sqrt(360025.0))
        assert (point.diameter_mm, point.length_mm) == (20.0, pytest.approx(math.sqrt(360025.0)))
        assert point.global_id


def test_a_starter_with_a_bent_foot(bar: Callable[..., Any]) -> None:
    (point,) = bar([(300.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 700.0)]).loose_rebars
    assert point.centre.tolist() == [0.0, 0.0, 700.0]
    assert point.length_mm == pytest.approx(1000.0)


def test_a_hairpin_has_two_tops(bar: Callable[..., Any]) -> None:
    points = bar([(0.0, 0.0, 600.0), (0.0, 0.0, 0.0), (200.0, 0.0, 0.0), (200.0, 0.0, 600.0)]).loose_rebars
    assert sorted(point.centre[0] for point in points) == [0.0, 200.0]
    assert len({point.global_id for point in points}) == 1


@pytest.mark.parametrize(
    ("points", "said", "reason"),
    [
        ([(0.0, 0.0, 0.0), (0.0, 0.0, 0.03)], {}, "0.03 mm long: a fragment"),
        ([(0.0, 0.0, 0.0), (600.0, 0.0, 100.0)], {}, "leans 80.5° from the vertical"),
        ([(0.0, 0.0, 0.0), (0.0, 0.0, 600.0)], {"PredefinedType": "LIGATURE"}, "is a LIGATURE"),
        ([(0.0, 0.0, 0.0), (0.0, 0.0, 600.0)], {"Name": "箍筋 8"}, "is called '箍'"),
        ([(0.0, 0.0, 0.0), (0.0, 0.0, 600.0)], {"Name": "Single tie"}, "is called"),
        ([(0.0, 0, 0), (500.0, 0, 0), (500.0, 500.0, 0), (0.0, 500.0, 0), (0.0, 0, 0)], {}, "is closed"),
        (
            [(250 * math.cos(t / 4), 250 * math.sin(t / 4), 3.0 * t) for t in range(200)],
            {"Name": " "},
            "no straight upright end",
        ),
    ],
    ids=["fragment", "leaning", "ligature", "stirrup by name", "tie by name", "closed", "spiral"],
)
def test_what_is_no_connecting_rebar(bar: Callable[..., Any], points: Any, said: Any, reason: str) -> None:
    read = bar(points, **said)
    assert read.loose_rebars == ()
    (left,) = read.not_taken
    assert left.what == "rebar"
    assert reason in left.reason


def test_sixteen_bars_in_one_element_without_a_name(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    disks = [model.disk([(x, y, -400.0), (x, y, 160.0)], 20.0) for x, y in ring]
    model.element("IfcReinforcingBar", disks, model.placement(), Name=" ")
    column = read_ifc(model.write()).column("C-1")
    assert np.array([point.centre[:2] for point in column.rebars]) == pytest.approx(np.array(ring))
    assert len({point.global_id for point in column.rebars}) == 1


@pytest.mark.parametrize(
    ("ifc_class", "said"),
    [
        ("IfcBuildingElementProxy", {"Name": "插筋 20"}),
        ("IfcMechanicalFastener", {"Name": "Dowel bar"}),
        ("IfcMember", {"Name": "差し筋"}),
    ],
)
def test_bars_of_other_classes_by_name(author: Callable[..., Any], ifc_class: str, said: dict[str, str]) -> None:
    """As solid extrusions and as facets."""
    model = author()
    upright = model.cylinder(10.0, 560.0)
    model.element(ifc_class, [upright], model.placement(None, (5.0, 6.0, 7.0)), **said)
    model.element(ifc_class, [model.faceted_tube(0.02, 20.0, 560.0)], model.placement(None, (500.0, 6.0, 7.0)), **said)
    points = sorted(read_ifc(model.write()).loose_rebars, key=lambda point: point.centre[0])
    assert [point.centre.round(6).tolist() for point in points] == [[5.0, 6.0, 567.0], [500.0, 6.0, 567.0]]
    assert [point.diameter_mm for point in points] == pytest.approx([20.0, 20.0], abs=1e-6)


def test_a_sleeve_for_connecting_rebars_is_no_rebar(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring, Name="连接钢筋用灌浆套筒")
    read = read_ifc(model.write())
    assert len(read.columns[0].sleeves) == 12
    assert read.loose_rebars == ()


def test_length_in_feet_is_not_believed(bar: Callable[..., Any]) -> None:
    """Revit writes BarLength in feet whatever the file's unit is."""
    for unit in ("mm", "m"):
        read = bar([(0.0, 0.0, 0.0), (0.0, 0.0, 560.0)], unit=unit, BarLength=560.0 / 304.8)
        assert read.loose_rebars[0].length_mm == pytest.approx(560.0)
        (warning,) = read.warnings
        assert "BarLength" in warning
        assert "feet" in warning


def test_diameter_over_the_ribs_is_not_believed(author: Callable[..., Any], ring: Ring) -> None:
    """Tekla writes it as NominalDiameter: the drawn diameter is nominal, the other one is kept as what it is."""
    model = author()
    model.column(model.placement(), Name="C-1")
    model.sleeves(model.placement(), ring)
    model.rebars(model.placement(), ring, NominalDiameter=23.5)
    read = read_ifc(model.write())
    column = read.column("C-1")
    assert {point.diameter_mm for point in column.rebars} == {20.0}
    assert column.rebar_outer_diameter_mm == 23.5
    (warning,) = read.warnings
    assert "NominalDiameter is 23.5 mm (over the ribs), drawn is 20 mm" in warning
    assert all((point.global_id or "?") in warning for point in column.rebars)


def test_drawn_over_the_ribs(bar: Callable[..., Any]) -> None:
    """Only where what is drawn is the diameter over the ribs of the very size named is the attribute believed."""
    read = bar([(0.0, 0.0, 0.0), (0.0, 0.0, 560.0)], diameter=23.5, NominalDiameter=20.0)
    assert read.loose_rebars[0].diameter_mm == 20.0
    read = bar([(0.0, 0.0, 0.0), (0.0, 0.0, 560.0)], diameter=25.0, NominalDiameter=20.0)
    assert read.loose_rebars[0].diameter_mm == 25.0
    assert "drawn is 25 mm, which was believed" in read.warnings[0]


def test_the_diameter_of_the_type_is_compared_too(author: Callable[..., Any]) -> None:
    model = author()
    element = model.element("IfcReinforcingBar", [model.disk([(0, 0, 0), (0, 0, 560.0)], 20.0)], model.placement())
    kind = model.rooted("IfcReinforcingBarType", Name="T", PredefinedType="MAIN", NominalDiameter=16.0)
    model.typed([element], kind)
    assert "NominalDiameter is 16 mm" in read_ifc(model.write()).warnings[0]


def test_spacer_types_count_for_their_bars(author: Callable[..., Any]) -> None:
    model = author()
    element = model.element("IfcReinforcingBar", [model.disk([(0, 0, 0), (0, 0, 560.0)], 12.0)], model.placement())
    kind = model.rooted("IfcReinforcingBarType", Name="T", PredefinedType="LIGATURE", NominalDiameter=12.0)
    model.typed([element], kind)
    assert read_ifc(model.write()).loose_rebars == ()


def test_sizes_over_the_ribs() -> None:
    """d1 + 2 h1 of the crescent-ribbed bar: 19.3 + 2 · 2.1 for 20 mm."""
    assert over_ribs_mm(20.0) == pytest.approx(19.3 + 2.0 * 2.1)
    assert over_ribs_mm(20.7) is None
    assert nominal_of_over_ribs(22.7) == 20.0
    assert nominal_of_over_ribs(20.0) is None
    assert nominal_of_over_ribs(60.0) is None
