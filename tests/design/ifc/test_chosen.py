"""Columns that are asked for by name are read as from a look at all, and without one where that is enough."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.bars import BarEnd
from aadm_workbench.design.ifc.crowd import Crowd
from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.errors import DesignError
from benchmarks.design import worst_error_mm, write_floor

COLUMNS = 9


@pytest.fixture(scope="module")
def floor(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("floor") / "floor.ifc"
    write_floor(path, columns=COLUMNS, others=160)
    return path


def told(model: ModelDesign, key: str) -> list[object]:
    """All that a column says, arrays as lists."""
    column = model.column(key)
    points = [
        (point.label, point.centre.tolist(), point.axis.tolist(), point.diameter_mm, point.global_id, point.why)
        for point in (*column.sleeves, *column.rebars)
    ]
    assert column.T_model_column is not None
    said = [column.id, column.global_id, column.names, column.storey, column.grid, column.size_mm, column.warnings]
    return [*said, column.T_model_column.tolist(), points]


def test_a_named_column_is_that_of_all(floor: Path) -> None:
    whole = read_ifc(floor)
    assert worst_error_mm(whole, COLUMNS) < 1e-3  # against what the floor was written from
    for only in (["C-3"], ["C-9", "C-1"], [" C-5 ", whole.columns[1].global_id or ""]):
        part = read_ifc(floor, only=only)
        assert len(part.columns) == len(only)
        for key in only:
            assert told(part, key) == told(whole, key)


def test_bars_of_other_columns_stay_unread(floor: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    taken: list[str] = []
    of = BarEnd.of

    def counted(element: Any, *rest: Any) -> BarEnd:
        taken.append(element.GlobalId)
        return of(element, *rest)

    monkeypatch.setattr(BarEnd, "of", counted)
    part = read_ifc(floor, only=["C-4"])
    own = {bar.global_id for bar in part.column("C-4").rebars}
    assert len(own) == 12
    assert own <= set(taken)
    assert len(set(taken)) < 2 * 12  # nine columns have 108, and there are the cages


@pytest.mark.parametrize("only", [["c-3"], ["C-3", "C-99"], ["Precast column"], [f"C-{k}" for k in range(1, 10)]])
def test_what_names_alone_do_not_settle_is_looked_up_in_all(floor: Path, only: list[str]) -> None:
    """Another spelling, a name that nothing has, one that all have, and all of them."""
    assert len(read_ifc(floor, only=only).columns) == COLUMNS


def test_a_column_without_sleeves_says_why_as_ever(author: Callable[..., Any]) -> None:
    model = author()
    for number in range(6):
        at = model.placement(origin=(6000.0 * number, 0.0, 0.0))
        model.column(at, Name=f"C-{number}")
        if number != 3:
            model.sleeves(at)
            model.rebars(at)
    path = model.write()
    messages = []
    for only in (None, ["C-3"]):
        with pytest.raises(DesignError) as caught:
            read_ifc(path, only=only).column("C-3")
        messages.append(str(caught.value))
    assert messages[0] == messages[1]
    assert len(read_ifc(path, only=["C-4"]).columns) == 1


def test_of_a_column_that_is_drawn_twice_one_is_taken(author: Callable[..., Any]) -> None:
    """Once as a column, once as whatever a program calls it: the sleeves are the column's."""
    model = author()
    for number in range(6):
        at = model.placement(origin=(6000.0 * number, 0.0, 0.0))
        model.column(at, Name=f"C-{number}")
        model.sleeves(at)
        model.rebars(at)
    at = model.placement(origin=(6000.0, 0.0, 0.0))
    square = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    model.element("IfcBuildingElementProxy", [model.extrusion(square, 3000.0)], at, Name="column twin")
    path = model.write()
    for only in (None, ["column twin"]):
        with pytest.raises(DesignError, match="C-1"):
            read_ifc(path, only=only).column("column twin")
    assert told(read_ifc(path, only=["C-1"]), "C-1") == told(read_ifc(path), "C-1")


def test_a_crowd_leaves_none_out_that_is_near() -> None:
    """Against every distance, for upright, lying and leaning lines, wherever the longer side of the plan runs."""
    generator = np.random.default_rng(11)
    for sides_mm in ((60_000.0, 9_000.0, 12_000.0), (4_000.0, 80_000.0, 3_000.0)):
        points = generator.uniform(0.0, 1.0, (500, 3)) * sides_mm + (5e8, 3e8, 0.0)
        crowd = Crowd.of(list(points))
        for _ in range(40):
            origin = generator.uniform(0.0, 1.0, 3) * sides_mm + (5e8, 3e8, 0.0)
            axis = generator.normal(size=3) * generator.choice([0.0, 0.05, 1.0], 3) + (0.0, 0.0, 1e-3)
            axis /= np.linalg.norm(axis)
            reach_mm = float(generator.uniform(100.0, 3000.0))
            apart = points - origin
            across_mm = np.linalg.norm(apart - np.outer(apart @ axis, axis), axis=1)
            assert set(np.flatnonzero(across_mm < reach_mm)) <= set(crowd.about(origin, axis, reach_mm))
            near = crowd.near(origin, reach_mm)
            assert set(np.flatnonzero(np.linalg.norm(apart, axis=1) < reach_mm)) <= set(near)
            assert list(near) == sorted(near)
    assert not len(Crowd.of([]).about(np.zeros(3), np.array([0.0, 0.0, 1.0]), 1e6))
