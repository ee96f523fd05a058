"""What is common to models that are no IFC files: elements, rules that select them, round faces, which is which."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.design.element_json import from_json, to_json
from aadm_workbench.design.elements import Element, Solid, counted_once, even_scale
from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.columns import Origin, Rules, recognise
from aadm_workbench.design.recognise.paths import Arc, Straight
from aadm_workbench.design.recognise.round_faces import Bend, RoundFace, bar_of, tubes_of
from aadm_workbench.design.recognise.selectors import select
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Array

RING = [(x, y) for x in (-200.0, 200.0) for y in (-200.0, 200.0)]
UP = np.array([0.0, 0.0, 1.0])


def box(
    width: float = 600.0, depth: float = 600.0, height: float = 3000.0, at: Array | None = None
) -> tuple[Array, ...]:
    corners = np.array(
        [[x, y, z] for z in (0.0, height) for x in (-width / 2, width / 2) for y in (-depth / 2, depth / 2)]
    )
    corners = corners + (np.zeros(3) if at is None else at)
    pairs = [(a, b) for a in range(8) for b in range(a) if (a ^ b).bit_count() == 1]
    return tuple(corners[[a, b]] for a, b in pairs)


def element(name: str, tubes: list[Tube], edges: tuple[Array, ...] = (), ifc_class: str = "", **more: str) -> Element:
    lines = edges or tuple(np.array([tube.start, tube.end]) for tube in tubes)
    return Element(name, name, name, (Solid(tuple(tubes), (), lines),), np.eye(4), ifc_class=ifc_class, **more)


def hole(x: float, y: float, bore: float = 36.0, deep: float = 310.0, low: float = 0.0) -> Tube:
    return Tube(np.array([x, y, low]), np.array([x, y, low + deep]), None, (bore, bore))


def rod(x: float, y: float, top: float = 160.0, diameter: float = 20.0) -> Tube:
    return Tube(np.array([x, y, top - 500.0]), np.array([x, y, top]), diameter, (None, None))


def found(*elements: Element, rules: Rules | None = None):
    return recognise(elements, Origin("model", "", ""), rules)


def column(name: str = "Body", ifc_class: str = "", holes: list[Tube] | None = None) -> Element:
    return element(name, [hole(x, y) for x, y in RING] if holes is None else holes, box(), ifc_class)


BARS = [element(f"Rod{k}", [rod(x, y)]) for k, (x, y) in enumerate(RING)]


def test_by_shape_alone() -> None:
    model = found(column(), *BARS)
    assert len(model.columns) == 1
    assert len(model.columns[0].sleeves) == len(model.columns[0].rebars) == 4


@pytest.mark.parametrize("ifc_class", ["IfcBeam", "IfcSlab", "IfcWall", "IfcFooting"])
def test_other_classes_are_no_columns(ifc_class: str) -> None:
    assert not found(column("a", ifc_class), *BARS).columns


def test_walls_are_no_columns_by_their_shape() -> None:
    wall = element("Body", [hole(x, 0.0) for x in (-900.0, -300.0, 300.0, 900.0)], box(2400.0, 300.0))
    assert not found(wall).columns
    assert found(wall, rules=Rules(columns="Body")).columns, "unless somebody says so"


def test_two_holes_or_unlike_ones_make_no_sleeves() -> None:
    assert not found(column(holes=[hole(-200.0, 0.0), hole(200.0, 0.0)])).columns
    assert not found(column(holes=[hole(x, y, 20.0 + 10.0 * k) for k, (x, y) in enumerate(RING)])).columns
    short = [hole(x, y, deep=60.0) for x, y in RING]
    assert not found(column(holes=short)).columns


def test_named_bars_come_before_bars_by_their_shape() -> None:
    dowels = [element("插筋", [rod(x, y)]) for x, y in RING]
    anchor = element("Rod9", [rod(0.0, 900.0)])
    model = found(column(), *dowels, anchor)
    assert all("插筋" in bar.why for bar in model.columns[0].rebars)
    assert not model.loose_rebars, "an anchor is no bar where bars have names"


def test_bars_and_tubes_are_what_their_group_is_called_and_columns_are_not() -> None:
    wholes = ("Column with grouting sleeves and dowels",)
    bars = [replace(bar, wholes=wholes, said="Cylinder", Name="Cylinder") for bar in BARS]
    model = found(replace(column(), wholes=wholes), *bars)
    assert len(model.columns[0].sleeves) == 4
    assert all("by its shape" not in bar.why for bar in model.columns[0].rebars)
    assert not model.loose_sleeves
    assert not model.not_taken


def test_stirrups_are_left_out_with_the_word() -> None:
    tie = element("箍筋", [rod(200.0, 200.0)], ifc_class="IfcReinforcingBar")
    model = found(column(), tie)
    assert not model.columns[0].rebars
    assert ("rebar", "箍筋") in {(left.what, left.name) for left in model.not_taken}


def test_a_sleeve_in_its_hole_counts_once() -> None:
    tubes = [
        element("灌浆套筒", [Tube(np.array([x, y, 0.0]), np.array([x, y, 310.0]), 48.0, (36.0, 36.0))]) for x, y in RING
    ]
    wide = column("Concrete", holes=[hole(x, y, 48.0) for x, y in RING])
    (design,) = found(wide, *tubes).columns
    assert [point.diameter_mm for point in design.sleeves] == [36.0] * 4


def test_the_same_body_twice_counts_once() -> None:
    first, second = column("A"), column("B")
    T = np.eye(4)
    T[:3, 3] = (1e-7, -1e-7, 1e-7)
    assert [e.Name for e in counted_once([first, second.moved(T), *BARS, *BARS])] == ["A", *(bar.Name for bar in BARS)]
    T[:3, 3] = (0.0, 0.0, 3000.0)
    assert len(counted_once([first, second.moved(T)])) == 2


def test_what_has_no_column_shows_its_holes() -> None:
    model = found(element("Plate", [hole(10.0 * k, 0.0, float(k), 10.0) for k in range(1, 10)], box(100.0, 10.0, 10.0)))
    assert [point.diameter_mm for point in model.loose_sleeves] == [float(k) for k in range(1, 10)]
    assert "no column with grouting sleeves was recognised" in model.warnings[0]


ELEMENTS = [
    element("C-1", [], box(), "IfcColumn"),
    element("套筒 A", [hole(0.0, 0.0)], ifc_class="IfcDiscreteAccessory", piece_mark="GTQ4Z-20"),
    element("Rod", [rod(0.0, 0.0)], kind="Part::Cylinder"),
]


@pytest.mark.parametrize(
    ("rule", "names"),
    [
        ("IfcColumn", ["C-1"]),
        ("IfcColumn + Part::Cylinder", ["C-1", "Rod"]),
        ("IfcDiscreteAccessory, Name=/套筒|sleeve/", ["套筒 A"]),
        ("IfcDiscreteAccessory, Name=/sleeve/", None),
        ("!IfcColumn", ["套筒 A", "Rod"]),
        ("Label=Rod", ["Rod"]),
        ('Name="套筒 A"', ["套筒 A"]),
        ("Name!=Rod", ["C-1", "套筒 A"]),
        ("Name*=o", ["Rod"]),
        ("PieceMark=/^GT/", ["套筒 A"]),
        ("TypeId=Part::Cylinder", ["Rod"]),
        ("rod", ["Rod"]),
    ],
)
def test_rules(rule: str, names: list[str] | None) -> None:
    if names is None:
        with pytest.raises(DesignError, match=r"finds no element in model, which holds 1 IfcColumn"):
            select(ELEMENTS, "model", "sleeves", rule)
    else:
        assert [one.Name for one in select(ELEMENTS, "model", "sleeves", rule)] == names


@pytest.mark.parametrize(
    ("rule", "reason"),
    [
        ("Weight=5", "asks for Weight"),
        ("Name=/(/", "is not understood"),
        ("Name==", "is not understood"),
        ("", "not under"),
    ],
)
def test_rules_that_make_no_sense(rule: str, reason: str) -> None:
    with pytest.raises(DesignError, match=reason):
        select(ELEMENTS, "model", "sleeves", rule)


def test_elements_survive_json() -> None:
    bent = Course((Straight(np.zeros(3), UP), Arc(UP, UP, -UP, 0.1, 1.3)), 20.0, drawn_length_mm=7.0)
    whole = Element(
        "a", "b", "c", (Solid((hole(0.1, 1 / 3),), (bent,), box()),), np.eye(4), wholes=("d",), ifc_guid="e"
    )
    (back,) = from_json(json.loads(json.dumps(to_json([whole]))))
    assert (back.GlobalId, back.wholes, back.ifc_guid, back.storey) == ("a", ("d",), "e", None)
    assert np.array_equal(back.solids[0].tubes[0].start, whole.solids[0].tubes[0].start)
    assert np.array_equal(back.solids[0].bars[0].points, bent.points)
    assert back.solids[0].bars[0].length_mm == 7.0
    assert all(np.array_equal(a, b) for a, b in zip(back.solids[0].edges, whole.solids[0].edges, strict=True))


def face(low: float, high: float, low_mm: float, high_mm: float, inner: bool, turn: float = 2.0 * math.pi) -> RoundFace:
    return RoundFace(low * UP, high * UP, low_mm, high_mm, turn, inner)


def test_halves_make_one_hole_and_fillets_none() -> None:
    halves = [face(0.0, 310.0, 36.0, 36.0, True, math.pi)] * 2
    (whole,) = tubes_of(halves)
    assert (whole.is_hole, whole.bore_mm, whole.length_mm) == (True, (36.0, 36.0), 310.0)
    assert tubes_of(halves[:1]) == []
    assert tubes_of([face(0.0, 3000.0, 40.0, 40.0, False, math.pi / 2.0)]) == [], "a rounded edge of the column"


def test_a_chamfer_is_not_the_bore() -> None:
    (found_hole,) = tubes_of([face(0.0, 3.0, 42.0, 36.0, True), face(3.0, 310.0, 36.0, 36.0, True)])
    assert found_hole.bore_mm == (36.0, 36.0)
    assert found_hole.start == pytest.approx([0.0, 0.0, 0.0])
    (tapered,) = tubes_of([face(0.0, 200.0, 48.0, 40.0, True)])
    assert tapered.bore_mm == (48.0, 40.0), "a long cone is the sleeve itself"


def test_a_bore_makes_a_tube() -> None:
    (tube,) = tubes_of([face(0.0, 310.0, 48.0, 48.0, False), face(0.0, 250.0, 36.0, 36.0, True)])
    assert (tube.outer_mm, tube.bore_mm) == (48.0, (36.0, None))


def test_a_bent_bar_is_one_course() -> None:
    straight = RoundFace(np.array([0.0, 0.0, 40.0]), np.array([0.0, 0.0, 500.0]), 20.0, 20.0, 2.0 * math.pi, False)
    foot = RoundFace(np.array([40.0, 0.0, 0.0]), np.array([200.0, 0.0, 0.0]), 20.0, 20.0, 2.0 * math.pi, False)
    bend = Bend(np.array([40.0, 0, 0]), np.array([0, 0, 40.0]), np.array([40.0, 0, 40.0]), np.array([0, 1.0, 0]), 20.0)
    course = bar_of([foot, straight], [bend])
    assert course is not None
    assert course.length_mm == pytest.approx(460.0 + 160.0 + 20.0 * math.pi)
    assert sorted(end[2] for end in (course.legs[0].start, course.legs[-1].end)) == pytest.approx([0.0, 500.0])


def test_scales_that_keep_round_things_round() -> None:
    assert even_scale(np.diag([-2.0, 2.0, 2.0, 1.0]))
    assert not even_scale(np.diag([1.0, 1.1, 1.0, 1.0]))
