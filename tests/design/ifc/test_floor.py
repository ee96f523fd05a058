"""Which beam end lies on which column: by what the model relates, else by where things lie, with the reason."""

from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.design.floor import REACH_MM, How
from aadm_workbench.design.ifc.floor import read_floor
from tests.stack.floors import HEIGHT_MM, FloorAuthor

TOP = HEIGHT_MM
FROM, TO = (250.0, 0.0, TOP), (5750.0, 0.0, TOP)


@pytest.fixture
def author(tmp_path: Path) -> FloorAuthor:
    return FloorAuthor(tmp_path)


def pair(
    author: FloorAuthor, start: tuple[float, ...] = FROM, end: tuple[float, ...] = TO, **how: object
) -> tuple[object, ...]:
    a, b = author.standing("A", (0.0, 0.0, 0.0)), author.standing("B", (6000.0, 0.0, 0.0))
    return a, b, author.beam("KL1", start, end, **how)  # type: ignore[arg-type]


def test_ends_and_heads(author: FloorAuthor) -> None:
    pair(author)
    floor = read_floor(author.write())
    (beam,) = floor.beams
    assert beam.ends == pytest.approx(np.array([FROM, TO]), abs=1e-6)
    assert [column.height_mm for column in floor.columns] == pytest.approx([HEIGHT_MM] * 2)
    assert [support.column for support in floor.supports[0]] == [0, 1]
    assert {support.how for support in floor.supports[0]} == {How.GEOMETRY}


@pytest.mark.parametrize("unit", ["mm", "m", "foot"])
@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4", "IFC4X3"])
def test_of_any_schema_and_unit(tmp_path: Path, schema: str, unit: str) -> None:
    author = FloorAuthor(tmp_path, schema, unit)
    pair(author)
    floor = read_floor(author.write())
    assert floor.beams[0].ends == pytest.approx(np.array([FROM, TO]), abs=1e-3)
    assert [support.column for support in floor.supports[0]] == [0, 1]


@pytest.mark.parametrize("ifc_class", ["IfcMember", "IfcBuildingElementProxy"])
@pytest.mark.parametrize("name", ["预制叠合梁 PCL-3", "Precast Beam 300x600", "主梁 KL12(3)"])
def test_beams_that_are_only_called_so(author: FloorAuthor, ifc_class: str, name: str) -> None:
    author.standing("A", (0.0, 0.0, 0.0))
    author.beam(name, FROM, TO, ifc_class, faceted=True)
    author.beam("梯梁 TL1", FROM, TO, ifc_class)
    floor = read_floor(author.write())
    assert len(floor.beams) == 1
    assert floor.beams[0].ends == pytest.approx(np.array([FROM, TO]), abs=1e-3)


def test_a_beam_of_parts_is_one_beam(author: FloorAuthor) -> None:
    _, _, beam = pair(author)
    whole = author.rooted("IfcElementAssembly", Name="预制梁 PCL-1")
    author.aggregate(whole, [beam, author.beam("梁 shell", (300.0, 0.0, TOP), (5700.0, 0.0, TOP), "IfcMember")])
    floor = read_floor(author.write())
    assert [one.id for one in floor.beams] == ["KL1"]


@pytest.mark.parametrize("ifc_class", ["IfcRelConnectsElements", "IfcRelConnectsPathElements"])
def test_the_models_own_relations_come_first(author: FloorAuthor, ifc_class: str) -> None:
    a, b, beam = pair(author, (250.0, 0.0, TOP), (5200.0, 0.0, TOP))  # 500 mm before the face of B
    more = {}
    if ifc_class == "IfcRelConnectsPathElements":
        more = {
            "RelatingPriorities": (),
            "RelatedPriorities": (),
            "RelatedConnectionType": "ATEND",
            "RelatingConnectionType": "ATEND",
        }
    author.connect(beam, a, ifc_class, **more)
    author.connect(b, beam, ifc_class, **more)
    floor = read_floor(author.write())
    assert [support.how for support in floor.supports[0]] == [How.CONNECTED, How.CONNECTED]
    assert [support.column for support in floor.supports[0]] == [0, 1]
    assert floor.supports[0][1].outside_mm == pytest.approx(500.0)


def test_a_relation_to_a_column_far_away_is_not_believed(author: FloorAuthor) -> None:
    _, b, beam = pair(author, (250.0, 0.0, TOP), (3000.0, 0.0, TOP))
    author.connect(beam, b)
    first, second = read_floor(author.write()).supports[0]
    assert first.column == 0
    assert second.column is None
    assert second.outside_mm == pytest.approx(2700.0)


def test_parts_of_one_assembly(author: FloorAuthor) -> None:
    a, b, beam = pair(author, (250.0, 0.0, TOP), (5400.0, 0.0, TOP))
    author.aggregate(author.rooted("IfcElementAssembly", Name="frame"), [a, b, beam])
    floor = read_floor(author.write())
    assert [support.how for support in floor.supports[0]] == [How.ASSEMBLED, How.ASSEMBLED]


def test_columns_that_stand_on_the_floor_carry_nothing_of_it(author: FloorAuthor) -> None:
    """A beam touches the foot of the column above as it does the head below; both are connected to it."""
    a, _, beam = pair(author)
    above = author.standing("A-up", (0.0, 0.0, TOP + 200.0))
    author.connect(beam, above)
    author.connect(beam, a)
    first, second = read_floor(author.write()).supports[0]
    assert (first.column, first.how) == (0, How.CONNECTED)
    assert second.how is How.GEOMETRY


def test_a_corbel_below_the_head(author: FloorAuthor) -> None:
    pair(author, (320.0, 0.0, TOP - 900.0), (5680.0, 0.0, TOP - 900.0))
    assert [support.column for support in read_floor(author.write()).supports[0]] == [0, 1]


def test_a_beam_at_the_foot_lies_on_no_column(author: FloorAuthor) -> None:
    pair(author, (320.0, 0.0, 400.0), (5680.0, 0.0, 400.0))
    first, second = read_floor(author.write()).supports[0]
    assert first.column is second.column is None
    assert first.outside_mm is None


@pytest.mark.parametrize(("gap", "found"), [(REACH_MM - 1.0, True), (REACH_MM + 1.0, False)])
def test_how_far_before_the_face_it_may_end(author: FloorAuthor, gap: float, found: bool) -> None:
    pair(author, (300.0 + gap, 0.0, TOP), TO)
    first, _ = read_floor(author.write()).supports[0]
    assert (first.column == 0) is found
    assert first.outside_mm == pytest.approx(gap)


def test_a_beam_that_runs_past_one_column_has_one_end_on_it(author: FloorAuthor) -> None:
    author.standing("A", (0.0, 0.0, 0.0))
    author.beam("short", (-290.0, 0.0, TOP), (310.0, 0.0, TOP))
    first, second = read_floor(author.write()).supports[0]
    assert [first.column, second.column].count(None) == 1


def test_the_first_end_is_the_same_whichever_way_it_is_drawn(author: FloorAuthor) -> None:
    for name, start, end in (("x", FROM, TO), ("y", (0.0, 250.0, TOP), (0.0, 5750.0, TOP))):
        author.beam(f"{name}1", start, end)
        author.beam(f"{name}2", end, start)
    beams = read_floor(author.write()).beams
    for one, other in ((beams[0], beams[1]), (beams[2], beams[3])):
        assert one.ends == pytest.approx(other.ends, abs=1e-6)
        assert one.ends[0].sum() < one.ends[1].sum()


def test_what_is_no_beam_is_told(author: FloorAuthor) -> None:
    author.standing("A", (0.0, 0.0, 0.0))
    author.beam("stub", (0.0, 0.0, TOP), (300.0, 0.0, TOP))
    author.beam("brace", (0.0, 0.0, 0.0), (1.0, 0.0, TOP))
    author.rooted("IfcBeam", Name="nothing", ObjectPlacement=author.placement())
    floor = read_floor(author.write())
    assert floor.beams == ()
    told = dict(floor.left_out)
    assert "300 mm long" in told["stub"]
    assert "3600 mm high" in told["brace"]
    assert "no geometry" in told["nothing"]


def test_columns_of_a_report_are_found_by_id_else_by_name(author: FloorAuthor) -> None:
    a, b, _ = pair(author)
    floor = read_floor(author.write())
    assert floor.place_of(b.GlobalId, "anything") == 1
    assert floor.place_of(None, "A") == 0
    assert floor.place_of("unknown", "A") == 0
    assert floor.place_of(None, "C") is None
    b.GlobalId = a.GlobalId
    assert read_floor(author.write()).place_of(a.GlobalId, "B") == 1
