"""Names of points lie on nothing: sampled, for 4 to 48 points in one ring and two, in sketches of every kind."""

import math
from typing import Any
from unittest import mock

import numpy as np
import pytest

from aadm_workbench.report.column_view import foot_sketches
from aadm_workbench.report.drawing.layout import width_of_label
from aadm_workbench.report.drawing.sketch import Circle, Label, Sketch
from aadm_workbench.report.pages.crew import crew_advice
from aadm_workbench.report.pages.crew_sketch import crew_sketch
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
