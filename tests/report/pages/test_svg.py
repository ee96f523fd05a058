"""Drawings: coordinates that are right, few bytes, and names that cannot become markup."""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.report.column_view import foot_sketches
from aadm_workbench.report.drawing.foot import FootSketch, Mark, foot_sketch
from aadm_workbench.report.drawing.plan import floor_plans
from aadm_workbench.report.drawing.sketch import Circle, Label, Link, Polyline, Sketch, arrow
from aadm_workbench.report.pages.html import html_text
from aadm_workbench.report.pages.svg import svg_of
from aadm_workbench.report.words.labels import SIGN
from tests.report.checked_floor import HOSTILE, place_of
from tests.report.typed import of_column, typed


def links(sketch: Sketch) -> dict[str, tuple[float, float]]:
    """Where the columns of a plan stand."""
    found = {}
    for shape in sketch.shapes:
        if isinstance(shape, Link):
            (low, _, high, _) = next(part for part in shape.shapes if isinstance(part, Polyline)).points
            found[shape.title] = ((low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0)
    return found


def test_columns_stand_in_the_plan_as_in_the_model(floor: dict[str, Any]) -> None:
    anchors = {column["id"]: f"c{k}" for k, column in enumerate(floor["columns"])}
    placed, tiles = floor_plans(typed(floor).columns, anchors)
    assert (placed.storey, placed.placed, tiles.placed) == ("3F", True, False)
    drawn = links(placed.sketch)
    names = [column["id"] for column in floor["columns"] if column["grid"]]
    assert set(drawn) == set(names)
    model = np.array([place_of(column["grid"]) for column in floor["columns"] if column["grid"]])
    paper = np.array([drawn[name] for name in names])
    model, paper = model - model.mean(axis=0), paper - paper.mean(axis=0)
    scale = (paper * model).sum() / (model**2).sum()
    assert scale > 0.0
    assert np.abs(paper - scale * model).max() < 0.5
    assert set(links(tiles.sketch)) == {HOSTILE}


def arrows(foot: FootSketch) -> list[np.ndarray]:
    """The (dx, dy) that the arrows of marks show, in the sketch's units."""
    found = [s.points for s in foot.sketch.shapes if isinstance(s, Polyline) and s.head > 0.0 and s.style != "guide"]
    return [np.array(end) - np.array(start) for start, end in found]


def test_arrows_are_the_offsets_times_the_factor() -> None:
    marks = [
        Mark("R1", (-200.0, -200.0), (1.0, -2.0), 2.0, "fail"),
        Mark("R2", (200.0, 200.0), (0.5, 0.0), 2.0, "pass"),
    ]
    foot = foot_sketch(marks, (600.0, 600.0), 20.0)
    scale = 152.0 / 600.0 * foot.factor
    shown = sorted(arrows(foot), key=lambda vector: float(np.hypot(*vector)))
    assert np.allclose(shown, [[0.5 * scale, 0.0], [1.0 * scale, -2.0 * scale]])
    rings = [s.radius for s in foot.sketch.shapes if isinstance(s, Circle) and s.style == "limit"]
    assert np.allclose(rings, 2.0 * scale)


def test_a_point_that_was_not_measured_has_no_arrow(floor: dict[str, Any]) -> None:
    column = next(column for column in floor["columns"] if column["id"] == "C-4")
    for point in column["sleeves"]["points"]:
        point["offset_mm"] = point["offset_mm"] and [0.5, 0.5]
    sleeves = next(foot_sketches(of_column(column))).foot
    assert len(arrows(sleeves)) == 11
    assert any(isinstance(s, Label) and s.text == "S8 –" for s in sleeves.sketch.shapes)


def test_no_name_becomes_markup() -> None:
    shapes = (
        Label((1.0, 2.0), HOSTILE, 7.0),
        Link('x"onclick="alert(1)', "</title><script>", (Circle((1.0, 1.0), 1.0, "ink"),)),
        arrow((0.0, 0.0), (5.0, 5.0), "move", 2.0),
    )
    text = svg_of(Sketch(10.0, 10.0, shapes), label='"><script>')
    assert "<script" not in text
    assert not re.search(r'\sonclick="', text)
    quoted = re.sub(r"=([\w.-]+)(?=[ >])", r'="\1"', text)
    ElementTree.fromstring(quoted)


@pytest.mark.parametrize(("along_x", "along_y"), [(25, 40), (5, 60), (60, 5), (2, 2), (1, 1)])
def test_squares_of_a_crowded_plan_do_not_touch(along_x: int, along_y: int, floor: dict[str, Any]) -> None:
    """A thousand columns fill a page, a few do not; no square lies on its neighbour, and each has its sign."""
    column = typed(floor).columns[1]
    columns = []
    for k in range(along_x * along_y):
        T = np.eye(4)
        T[:2, 3] = 6000.0 * (k % along_x), 6000.0 * (k // along_x)
        columns.append(replace(column, id=f"K-{k}", T_model_column=T))
    (plan,) = floor_plans(columns, {column.id: column.id for column in columns})
    squares = [shape for shape in plan.sketch.shapes if isinstance(shape, Link)]
    middles = np.array(list(links(plan.sketch).values()))
    (low, _, high, _) = next(part for part in squares[0].shapes if isinstance(part, Polyline)).points
    apart = [np.abs(middles - middle).max(axis=1) for middle in middles]
    assert all(np.count_nonzero(one < high[0] - low[0] + 2.0) == 1 for one in apart)
    assert plan.sketch.height <= 1.36 * plan.sketch.width
    assert plan.sketch.height <= 0.63 * plan.sketch.width or len(columns) > 200
    assert all(any(isinstance(part, Label) and part.text == "✗" for part in square.shapes) for square in squares)


def test_every_verdict_of_a_page_has_its_sign(floor: dict[str, Any]) -> None:
    """Printed in grey it says the same: a word and a sign wherever there is a colour."""
    text = html_text(typed(floor))
    shown = re.findall(r'class="[^"]*\bv-(\w+)[^"]*">\s*(?:<[^>]*>)*([^<]*)', text)
    assert {verdict for verdict, _ in shown} >= {"pass", "fail", "inconclusive", "not_measured", "error"}
    assert [(verdict, said) for verdict, said in shown if not said.startswith(f"{SIGN[verdict]} ")] == []
