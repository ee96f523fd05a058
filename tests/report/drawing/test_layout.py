"""Names of points lie on nothing: sampled, for 4 to 48 points in one ring and two, in sketches of every kind."""

import math
from typing import Any
from unittest import mock

import numpy as np
import pytest

from aadm_workbench.assembly.following import blame_of
from aadm_workbench.model import Kind
from aadm_workbench.report.column_view import foot_sketches
from aadm_workbench.report.drawing.layout import width_of_label
from aadm_workbench.report.drawing.sketch import Circle, Label, Polyline, Sketch
from aadm_workbench.report.pages.crew import crew_advice
from aadm_workbench.report.pages.crew_sketch import crew_sketch, rings_of, sleeves_from_below
from aadm_workbench.report.pages.pdf_text import width_of
from aadm_workbench.report.pages.scan_card import scan_cards
from aadm_workbench.report.pages.scan_card_page import picture_sketch
from aadm_workbench.twin.parts import ring
from tests.report import checked_floor
from tests.report.checked_floor import Case, floor_report
from tests.report.typed import typed

PATTERNS = {
    4: ring(240.0, 240.0, 2),
    12: ring(240.0, 240.0, 4),
    20: np.vstack([ring(240.0, 240.0, 4), ring(120.0, 120.0, 3)]),
    40: np.vstack([ring(380.0, 380.0, 8), ring(260.0, 260.0, 4)]),
    48: np.vstack([ring(380.0, 380.0, 8), ring(270.0, 270.0, 6)]),
}
DOTS = ("design", "bar", "ink", "fill-fail", "fill-inconclusive", "fill-not_measured")
MOST_LEFT_OUT = 0.05  # of the names: where a point stands within a ring of others there is no place


@pytest.fixture(scope="module", params=PATTERNS)
def report(request: pytest.FixtureRequest) -> Any:
    centres = PATTERNS[request.param]
    design = dict(checked_floor.DESIGN, centres=centres.tolist(), size=[900.0, 900.0])
    with mock.patch.multiple(checked_floor, CENTRES=centres, DESIGN=design):
        return typed(floor_report(Case("C-1", "A/1", 0.0, {"R2": (7.5, 0.0)}), Case("C-2", "A/2", 30.0, {"S3": None})))


def sketches(report: Any) -> list[Sketch]:
    """Every kind of sketch."""
    found = []
    for column in report.columns:
        found += [titled.foot.sketch for titled in foot_sketches(column)]
        found += [crew_sketch(column, crew_advice(report, column), language) for language in ("en", "zh")]
    return found + [picture_sketch(card, part) for card in scan_cards(report) for part in card.parts]


def ink(label: Label) -> np.ndarray:
    """Points (n, 2) on a text, as wide as the font of the PDF has it."""
    wide = width_of(label.text, label.size)
    assert wide <= width_of_label(label.text, label.size, bold=True), "boxes are never narrower than texts"
    left = label.at[0] - {"start": 0.0, "middle": 0.5, "end": 1.0}[label.anchor] * wide
    across = np.linspace(left, left + wide, max(2, math.ceil(wide)))
    up = label.at[1] + label.size * np.array([-0.3, 0.0, 0.3])
    return np.array([(x, y) for x in across for y in up])


def test_no_name_lies_on_anything(report: Any) -> None:
    for sketch in sketches(report):
        labels = [shape for shape in sketch.shapes if isinstance(shape, Label)]
        names = [label for label in labels if label.text[0] in "SR" and label.text[1:2].isdigit()]
        dots = [shape for shape in sketch.shapes if isinstance(shape, Circle) and shape.style in DOTS]
        assert len({label.text.split()[0] for label in names}) >= (1.0 - MOST_LEFT_OUT) * len(dots)
        for label in names:
            points = ink(label)
            assert points.min() >= 0.0
            assert points[:, 0].max() <= sketch.width
            for dot in dots:
                away = np.hypot(*(points - dot.centre).T).min()
                assert away >= dot.radius, label.text
            for other in labels:
                if other is not label:
                    high = 0.3 * (label.size + other.size)
                    near = np.abs(ink(other)[:, None, :] - points[None, :, :])
                    assert not ((near[..., 0] < 0.2) & (near[..., 1] < 0.5 * high)).any(), (label.text, other.text)


def test_every_bend_says_how_far_and_ends_before_the_next_bar(report: Any) -> None:
    """The arrow leads over no neighbour that it need not reach; no ring covers one."""
    for column in report.columns:
        advice = crew_advice(report, column)
        sketch = crew_sketch(column, advice, "en")
        arrows = [shape for shape in sketch.shapes if isinstance(shape, Polyline) and shape.style == "move"]
        said = [shape.text for shape in sketch.shapes if isinstance(shape, Label) and shape.style == "text-move"]
        assert said == [f"{math.hypot(*shift.vector_mm):.1f} mm" for shift in advice.shifts]
        assert len(arrows) == len(said)
        dots = [shape for shape in sketch.shapes if isinstance(shape, Circle) and shape.style in DOTS]
        for ring_drawn in (
            shape for shape in sketch.shapes if isinstance(shape, Circle) and shape.style == "ring-fail"
        ):
            away = [math.dist(ring_drawn.centre, dot.centre) - dot.radius for dot in dots]
            assert all(value >= ring_drawn.radius for value in away if value > 0.0)
        for drawn in arrows:
            start, tip = (np.array(end) for end in drawn.points)
            others = [dot for dot in dots if math.dist(dot.centre, start) > 1.0]
            nearest = min(math.dist(dot.centre, start) for dot in others)
            if nearest >= 30.0:
                steps = start + np.linspace(0.0, 1.0, 40)[:, None] * (tip - start)
                assert all(np.hypot(*(steps - dot.centre).T).min() > dot.radius for dot in others)


def test_no_colour_says_alone_what_a_point_is(report: Any) -> None:
    """Each dot that is filled otherwise than a bar has a sign behind its name; what follows from another is any bar."""
    for column in report.columns:
        follows = blame_of(column).follows
        sketch = crew_sketch(column, crew_advice(report, column), "en")
        names = {shape.text.split()[0]: shape.text for shape in sketch.shapes if isinstance(shape, Label)}
        filled = [shape for shape in sketch.shapes if isinstance(shape, Circle) and shape.style.startswith("fill-")]
        points = column.points(Kind.REBAR)
        open_ones = {p.label for p in points if p.verdict in ("fail", "inconclusive", "not_measured")}
        own = {label for label in open_ones if label not in follows}
        assert len(filled) == len(own)
        assert all(names[label][len(label) :] in (" ✗", " ?", " –") for label in own if label in names)
        assert all(names[label] == label for label in open_ones - own if label in names)


def test_what_a_step_names_is_ringed_where_it_stands() -> None:
    """Two sleeves too far from each other, each where it may be: the page shows the foot, with both."""
    apart = Case("C-1", "A/1", 0.0, {"S2": (1.3, 0.0), "S3": (-1.3, 0.0)})
    column = typed(floor_report(apart)).columns[0]
    assert {point.verdict for point in column.points(Kind.SLEEVE)} == {"pass"}
    (failing,) = [spacing.between for spacing in column.sleeves.spacing if spacing.verdict == "fail"]
    sketch = sleeves_from_below(column)
    assert sketch is not None
    assert {label.text for label in sketch.shapes if isinstance(label, Label) and label.bold} == {*failing}
    opened = typed(floor_report(Case("C-7", "C/2", 0.0, {"R4": (1.7, 0.9)}, u_mm=0.2)))
    (step,) = crew_advice(opened, opened.columns[0]).steps
    rings = rings_of(opened.columns[0], Kind.REBAR)
    assert {*rings.values()} == {"ring-open"}
    assert all(label in step.text.en for label in rings)
