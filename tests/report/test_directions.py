"""Directions in words: decomposed exactly, named after what lies that way, whichever way the column is turned."""

import copy
import math
import re
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.recognise.pattern import side_labels
from aadm_workbench.model import Array
from aadm_workbench.report.directions import compass_of, grid_of
from tests.report.checked_floor import GRID_DEG, place_of
from tests.report.typed import of_column, typed

MOVE = re.compile(r"([\d.]+) mm (towards|away from) grid (\w+)")


def told_vector(text: str, grid: str) -> Array:
    """The displacement (2,) mm, model frame, that a text tells a worker who stands at a grid crossing."""
    moves = MOVE.findall(text)
    assert moves, text
    return sum((_told(float(length), way, tag, grid) for length, way, tag in moves), np.zeros(2))


def _told(length: float, way: str, tag: str, grid: str) -> Array:
    letter, number = grid.split("/")
    there = place_of(f"{tag}/{number}" if tag.isalpha() else f"{letter}/{tag}")
    towards = there - place_of(grid)
    return length * towards / np.linalg.norm(towards) * (1.0 if way == "towards" else -1.0)


def in_model(column: dict[str, Any], vector: Array) -> Array:
    """A vector of the column frame in the model frame."""
    return np.array(column["T_model_column"])[:2, :2] @ vector


@pytest.mark.parametrize("name", ["C-1", "C-2", "C-3", "C-4", "C-6", "C-7"])
@pytest.mark.parametrize("vector", [(3.0, 4.0), (-2.0, 0.5), (0.0, -1.3), (5.0, 0.0)])
def test_grid_words_lead_where_the_vector_does(floor: dict[str, Any], name: str, vector: tuple[float, float]) -> None:
    column = next(column for column in floor["columns"] if column["id"] == name)
    told = compass_of(grid_of(typed(floor)), of_column(column)).in_words(vector)
    assert np.linalg.norm(told_vector(told.en, column["grid"]) - in_model(column, np.array(vector))) < 0.08
    assert re.findall(r"\d+\.\d", told.zh) == re.findall(r"\d+\.\d", told.en)


def test_next_axis_is_named_and_beyond_the_last_the_way_back(floor: dict[str, Any]) -> None:
    corner = floor["columns"][2]  # A/3
    angle = math.radians(GRID_DEG)
    up = np.array(corner["T_model_column"])[:2, :2].T @ np.array([-math.sin(angle), math.cos(angle)])
    right = np.array(corner["T_model_column"])[:2, :2].T @ np.array([math.cos(angle), math.sin(angle)])
    compass = compass_of(grid_of(typed(floor)), of_column(corner))
    assert compass.in_words(up).en == "1.0 mm towards grid B"
    assert compass.in_words(-up).en == "1.0 mm away from grid B"
    assert compass.in_words(right).en == "1.0 mm away from grid 2"
    assert compass.in_words(-right).zh == "向 2 轴 1.0 mm"


def test_columns_beside_their_axes(floor: dict[str, Any]) -> None:
    """Columns stand off the crossings by part of their width: the column's own sides are meant."""
    moved = copy.deepcopy(floor)
    rng = np.random.default_rng(1)
    for column in moved["columns"]:
        if column["T_model_column"] is not None:
            for row in (0, 1):
                column["T_model_column"][row][3] += float(rng.uniform(-200.0, 200.0))
    for column, other in zip(moved["columns"], floor["columns"], strict=True):
        if column["grid"] is not None:
            vector = (2.0, -3.0)
            assert compass_of(grid_of(typed(moved)), of_column(column)).in_words(vector) == compass_of(
                grid_of(typed(floor)), of_column(other)
            ).in_words(vector)


def test_without_a_grid_the_plan(floor: dict[str, Any]) -> None:
    column = floor["columns"][0]
    for other in floor["columns"]:
        other["grid"] = None
    right = np.array(column["T_model_column"])[:2, :2].T @ np.array([1.0, 0.0])
    told = compass_of(grid_of(typed(floor)), of_column(column)).in_words(2.0 * right + 0.01)
    assert told.en == "2.0 mm towards the right of the plan"
    assert told.zh == "向平面图右方 2.0 mm"


def test_with_one_row_of_columns_grid_and_plan(floor: dict[str, Any]) -> None:
    row = [column for column in floor["columns"] if (column["grid"] or "").startswith("A")]
    compass = compass_of(grid_of(typed(floor | {"columns": row})), of_column(row[0]))
    assert [heading.along.en for heading in compass.headings] == ["towards grid 2", "towards the top of the plan"]
    vector = np.array([1.7, 2.2])
    parts = compass.parts(vector)
    assert len(parts) == 2


def test_without_a_model_the_sides_of_the_column(floor: dict[str, Any]) -> None:
    column = floor["columns"][7]
    told = compass_of(grid_of(typed(floor)), of_column(column)).in_words((2.0, -1.0)).en
    assert told == (
        "2.0 mm towards the side of R4 to R7 (right in the sketch) and "
        "1.0 mm towards the side of R1 to R4 (bottom of the sketch)"
    )
    points = column["rebars"]["points"]
    named = {point["label"]: point["design_mm"] for point in points}
    for label in side_labels({label: (x, y) for label, (x, y, _) in named.items()}, (1.0, 0.0)) or ():
        assert named[label][0] == max(place[0] for place in named.values())


def test_nothing_to_move(floor: dict[str, Any]) -> None:
    assert compass_of(grid_of(typed(floor)), of_column(floor["columns"][0])).in_words((0.01, -0.02)) == ("", "")


def test_the_axes_of_the_model_lead_where_no_other_column_does(floor: dict[str, Any]) -> None:
    """One column alone knows the next axes from the model's grid, also where it is turned and stands between them."""
    column = floor["columns"][0]
    T = np.array(column["T_model_column"])
    turn = math.radians(GRID_DEG)
    u, v = np.array([math.cos(turn), math.sin(turn)]), np.array([-math.sin(turn), math.cos(turn)])
    place = T[:2, 3]

    def axis(tag: str, family: str, through: Any, along: Any) -> dict[str, Any]:
        ends = [(through + sign * 9000.0 * along).tolist() for sign in (-1.0, 1.0)]
        return {"tag": tag, "family": family, "start_mm": ends[0], "end_mm": ends[1]}

    grid = [axis(name, "u", place + k * 7000.0 * v, u) for k, name in enumerate("XYZ", start=-1)]
    grid += [axis(str(k + 7), "v", place + k * 6000.0 * u, v if k else -v) for k in (-1, 0, 1)]
    alone = typed(floor | {"columns": [column | {"grid": None}], "grid": grid})
    compass = compass_of(grid_of(alone), alone.columns[0])
    for way, tag in ((u, "8"), (-u, "6"), (v, "Z"), (-v, "X")):
        told = compass.in_words(3.0 * (T[:2, :2].T @ way))
        assert (told.en, told.zh) == (f"3.0 mm towards grid {tag}", f"向 {tag} 轴 3.0 mm")
