"""Beams on displaced columns: known answers by hand, and bodies moved by real rotations."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.floor import Floor
from aadm_workbench.design.ifc.floor import read_floor
from aadm_workbench.model import Verdict
from aadm_workbench.stack.limits import Limits
from aadm_workbench.stack.measured import MeasuredColumn
from aadm_workbench.stack.members import MembersOn
from aadm_workbench.stack.result import Basis, Judged, StackedColumn, StackedMember
from aadm_workbench.stack.torsor import Torsor
from tests.stack.floors import HEIGHT_MM, FloorAuthor, two_columns

LIMITS = Limits(load_profile("cn-gbt51231-2016"), "guarded")
SMALL = np.diag(np.square([0.5, 0.5, 0.5, 1e-4, 1e-4, 1e-4]))
A = (2.0, 1.0, 0.0, 0.0, 0.0, 0.1)
B = (-3.0, 2.0, 1.0, 0.0, 0.02, 0.0)
"""dx, dy, dz mm; rx, ry, yaw degrees."""


def standing(
    name: str,
    place: Sequence[float],
    displaced: Sequence[float] | None,
    turned_deg: float = 0.0,
    basis: Basis = "control_points",
) -> StackedColumn:
    T = np.eye(4)
    T[:3, :3] = Rotation.from_euler("z", turned_deg, degrees=True).as_matrix()
    T[:3, 3] = place
    measured = MeasuredColumn(name, None, "3F", None, None, T, Verdict.PASS, Verdict.PASS, "")
    placed = None
    if displaced is not None:
        placed = Torsor(np.array([*displaced[:3], *np.radians(displaced[3:])]), SMALL)
    return StackedColumn(measured, placed, basis)


def only(floor: Floor, *columns: StackedColumn) -> StackedMember:
    (member,) = MembersOn(floor, dict(enumerate(columns)), LIMITS).members()
    return member


@pytest.fixture(scope="module")
def floor(tmp_path_factory: pytest.TempPathFactory) -> Floor:
    return read_floor(two_columns(tmp_path_factory.mktemp("floor")))


def value(judged: Judged) -> float:
    assert judged.value is not None
    return judged.value


def test_the_beam_by_hand(floor: Floor) -> None:
    """B's top moves by −3 + 3600 · 0.02 · π/180 = −1.743, A's by 2: the span shrinks by 3.74."""
    member = only(floor, standing("A", (0, 0, 0), A), standing("B", (6000, 0, 0), B))
    assert member.ends == ("A", "B")
    assert value(member.span_mm) == pytest.approx((-3.0 + 1.257) - 2.0, abs=0.005)
    assert [value(seat) for seat in member.seat_mm] == pytest.approx([2.0, 1.743], abs=0.005)
    assert value(member.span_mm) == pytest.approx(-sum(map(value, member.seat_mm)))
    # B rises by 1, and its end lies 250 mm towards A of its axis: its lean takes 250 · 0.02 · π/180 = 0.087 up again.
    assert value(member.level_mm) == pytest.approx(1.0 + 0.087, abs=0.002)
    # A is turned by 0.1°; the line between the ends by (2 − (1 + 250 · 0.1 · π/180)) / 5500.
    assert value(member.skew_deg) == pytest.approx(0.1 - np.degrees((2.0 - 1.436) / 5500.0), abs=0.001)


def test_uncertainty_of_the_span_by_hand(floor: Floor) -> None:
    """Two columns, each 0.5 mm and 1e-4 of lean on 3600 mm, along the beam: √(2 · (0.25 + 0.1296))."""
    member = only(floor, standing("A", (0, 0, 0), A), standing("B", (6000, 0, 0), B))
    assert member.span_mm.u == pytest.approx(np.sqrt(2.0 * (0.25 + 0.36**2)), rel=1e-3)


@pytest.mark.parametrize("turned_deg", [0.0, 90.0, 37.0])
@pytest.mark.parametrize("seed", range(4))
def test_bodies_that_are_really_turned(tmp_path: Path, seed: int, turned_deg: float) -> None:
    """Heads as rigid bodies of scipy, a beam along the diagonal, columns turned in the plan."""
    floor = read_floor(two_columns(tmp_path, turned=True))
    rng = np.random.default_rng(seed)
    moves = [np.array([*rng.normal(0.0, 3.0, 3), *rng.normal(0.0, 0.03, 2), rng.normal(0.0, 0.1)]) for _ in range(2)]
    places = [np.zeros(3), np.array([3600.0, 4800.0, 0.0])]
    columns = [standing(name, place, move, turned_deg) for name, place, move in zip("AB", places, moves, strict=True)]
    member = only(floor, *columns)
    own = Rotation.from_euler("z", turned_deg, degrees=True)
    ends = []
    for place, move, end in zip(places, moves, member.points_mm, strict=True):
        body = own * Rotation.from_rotvec(np.radians(move[3:])) * own.inv()
        ends.append(body.apply(end - place) + own.apply(move[:3]) + place)
    design, moved = member.points_mm[1] - member.points_mm[0], ends[1] - ends[0]
    assert value(member.span_mm) == pytest.approx(np.hypot(*moved[:2]) - np.hypot(*design[:2]), abs=0.02)
    assert value(member.level_mm) == pytest.approx(moved[2], abs=0.02)
    along = design / np.linalg.norm(design)
    assert value(member.seat_mm[0]) == pytest.approx(along @ (ends[0] - member.points_mm[0]), abs=0.02)
    line = np.degrees(np.arctan2(moved[1], moved[0]) - np.arctan2(design[1], design[0]))
    skews = [move[5] - line for move in moves]
    assert value(member.skew_deg) == pytest.approx(max(skews, key=abs), abs=0.002)


def test_limits_with_their_clause(floor: Floor) -> None:
    far = only(
        floor, standing("A", (0, 0, 0), (9.0, 0, 0, 0, 0, 0)), standing("B", (6000, 0, 0), (-9.0, 0, 0, 0, 0, 0))
    )
    assert far.span_mm.verdict is Verdict.FAIL
    assert far.span_mm.limit == (-10.0, 10.0)
    assert "unverified" in far.span_mm.clause
    assert far.seat_mm[0].verdict is Verdict.INCONCLUSIVE
    assert far.span_mm.reason is not None
    assert "10 mm" in far.span_mm.reason.en
    assert "18.00" in far.span_mm.reason.zh
    assert far.skew_deg.verdict is Verdict.NOT_ASSESSED
    assert far.skew_deg.limit is None
    near = only(floor, standing("A", (0, 0, 0), A), standing("B", (6000, 0, 0), B))
    assert near.verdict is Verdict.PASS


def test_without_control_points_the_value_is_relative_and_no_verdict(floor: Floor) -> None:
    member = only(
        floor,
        standing("A", (0, 0, 0), A, basis="bars"),
        standing("B", (6000, 0, 0), (-30.0, 0, 0, 0, 0, 0), basis="bars"),
    )
    assert member.span_mm.verdict is Verdict.NOT_MEASURED
    assert value(member.span_mm) == pytest.approx(-32.0, abs=0.01)
    assert member.span_mm.limit is None
    assert member.span_mm.reason is not None
    assert "setting alone" in member.span_mm.reason.en


@pytest.mark.parametrize("tied", ["control_points", "storey_below"])
def test_the_grid_and_the_bars_are_never_added_up(floor: Floor, tied: Basis) -> None:
    """One end off the grid by 2 mm, the other off its bars: of what lies between them nothing is known."""
    a, b = (standing("A", (0, 0, 0), A, basis=tied), standing("B", (6000, 0, 0), B, basis="bars"))
    for member in (only(floor, a, b), only(floor, replace(a, basis="bars"), replace(b, basis=tied))):
        for judged in (member.span_mm, member.skew_deg, member.level_mm):
            assert judged.value is judged.u is None
            assert judged.verdict is Verdict.NOT_MEASURED
            assert judged.reason is not None
            assert "not compared" in judged.reason.en
    assert value(only(floor, a, b).seat_mm[0]) == pytest.approx(2.0)
    assert only(floor, a, b).seat_mm[0].verdict is Verdict.PASS


def test_heights_that_nobody_measured_are_not_too_close_to_a_limit(floor: Floor) -> None:
    """2.5 mm of height at each column are 3.5 mm of fall, which keep 5 mm in 84 % of cases: what helps is said."""
    level = np.diag(np.square([0.5, 0.5, 2.5, 1e-6, 1e-6, 1e-6]))
    ends = [standing(name, (x, 0, 0), (0.0,) * 6) for name, x in (("A", 0), ("B", 6000))]
    member = only(floor, *(replace(one, placed=Torsor(np.zeros(6), level)) for one in ends))
    assert member.level_mm.verdict is Verdict.INCONCLUSIVE
    assert member.level_mm.u == pytest.approx(3.5355, abs=1e-3)
    assert member.level_mm.reason is not None
    for said in member.level_mm.reason:
        assert "level_u_mm" in said
    assert member.span_mm.verdict is Verdict.PASS


def test_a_column_that_was_not_measured(floor: Floor) -> None:
    member = only(floor, standing("A", (0, 0, 0), A), standing("B", (6000, 0, 0), None))
    assert member.span_mm.value is None
    assert member.span_mm.verdict is Verdict.NOT_MEASURED
    assert member.span_mm.reason is not None
    assert "column B" in member.span_mm.reason.en
    assert value(member.seat_mm[0]) == pytest.approx(2.0)
    assert member.seat_mm[0].verdict is Verdict.PASS


def test_a_column_of_which_no_report_tells(floor: Floor) -> None:
    on = MembersOn(floor, {0: standing("A", (0, 0, 0), A)}, LIMITS)
    (member,) = on.members()
    assert member.ends == ("A", "B")
    assert member.span_mm.value is None
    assert [one.about for one in on.not_found()] == ["KL1"]
    assert "no report tells" in next(iter(on.not_found())).reason.en


def test_a_beam_with_one_end_in_the_air(tmp_path: Path) -> None:
    author = FloorAuthor(tmp_path)
    author.standing("A", (0.0, 0.0, 0.0))
    author.beam("cantilever", (250.0, 0.0, HEIGHT_MM), (3000.0, 0.0, HEIGHT_MM))
    on = MembersOn(read_floor(author.write()), {0: standing("A", (0, 0, 0), A)}, LIMITS)
    (member,) = on.members()
    assert member.ends == ("A", None)
    assert value(member.seat_mm[0]) == pytest.approx(2.0)
    assert member.seat_mm[1].verdict is member.span_mm.verdict is Verdict.NOT_MEASURED
    assert "2700 mm away" in next(iter(on.not_found())).reason.en


def test_neighbours_over_one_head(tmp_path: Path) -> None:
    """By hand: a head leans by 0.1° about y; beams end 250 mm left and right of its axis: 500 · 0.1 · π/180 = 0.873."""
    author = FloorAuthor(tmp_path)
    author.standing("A", (0.0, 0.0, 0.0))
    author.beam("right", (250.0, 0.0, HEIGHT_MM), (3000.0, 0.0, HEIGHT_MM))
    author.beam("left", (-3000.0, 0.0, HEIGHT_MM), (-250.0, 0.0, HEIGHT_MM))
    floor = read_floor(author.write())
    leaning = standing("A", (0, 0, 0), (0, 0, 0, 0, 0.1, 0))
    (pair,) = MembersOn(floor, {0: leaning}, LIMITS).neighbours()
    assert pair.members == ("right", "left")
    assert value(pair.flush_mm) == pytest.approx(0.873, abs=0.001)
    assert pair.flush_mm.verdict is Verdict.PASS
    # Both go with the head: no grid is needed for that.
    (pair,) = MembersOn(floor, {0: replace(leaning, basis="bars")}, LIMITS).neighbours()
    assert pair.flush_mm.verdict is Verdict.PASS
    (pair,) = MembersOn(floor, {0: replace(leaning, placed=None)}, LIMITS).neighbours()
    assert pair.flush_mm.verdict is Verdict.NOT_MEASURED
