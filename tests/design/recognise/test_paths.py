"""Legs of bars and profiles against circles that are known exactly."""

import math

import numpy as np
import pytest

from aadm_workbench.design.recognise.paths import Arc, Straight, arc_through, cut, joined, outline, polyline


def test_arc_through_three_points_keeps_its_way_round() -> None:
    """The long way and the short way round one circle, in a tilted plane."""
    tilt = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    centre = np.array([5.0, -7.0, 11.0])

    def on_circle(degrees: float) -> np.ndarray:
        angle = math.radians(degrees)
        return centre + tilt @ (50.0 * np.array([math.cos(angle), math.sin(angle), 0.0]))

    for ends, through, turn in (((10, 100), 55, 90), ((10, 100), 200, 270), ((100, 10), 55, 90)):
        arc = arc_through(on_circle(ends[0]), on_circle(through), on_circle(ends[1]))
        assert isinstance(arc, Arc)
        assert arc.centre == pytest.approx(centre, abs=1e-9)
        assert arc.start == pytest.approx(on_circle(ends[0]), abs=1e-9)
        assert arc.end == pytest.approx(on_circle(ends[1]), abs=1e-9)
        assert arc.length_mm == pytest.approx(50.0 * math.radians(turn), rel=1e-12)


def test_arc_through_a_line_is_straight() -> None:
    leg = arc_through(np.zeros(3), np.array([1.0, 1.0, 0.0]), np.array([3.0, 3.0, 0.0]))
    assert isinstance(leg, Straight)


def test_cut_takes_what_lies_between_two_parameters() -> None:
    """A polyline's parameter counts its legs: 0.5 to 2.25 of three legs."""
    legs = polyline([np.array([x, y, 0.0]) for x, y in ((0, 0), (10, 0), (10, 20), (50, 20))])
    kept = cut(legs, 0.5, 2.25)
    assert [leg.points.tolist() for leg in kept] == [
        [[5, 0, 0], [10, 0, 0]],
        [[10, 0, 0], [10, 20, 0]],
        [[10, 20, 0], [20, 20, 0]],
    ]
    assert cut(legs, 0.0, 3.0 - 1e-9) == legs


def test_cut_of_an_arc() -> None:
    quarter = Arc(np.zeros(3), np.array([8.0, 0, 0]), np.array([0, 8.0, 0]), 0.0, math.pi / 2.0, span=90.0)
    (half,) = cut([quarter], 45.0, None)
    assert half.start == pytest.approx([8.0 / math.sqrt(2.0)] * 2 + [0.0])
    assert half.length_mm == pytest.approx(8.0 * math.pi / 4.0)


def test_joined_legs() -> None:
    """Bars cut into pieces, and pieces without length, are one straight bar; a bend stays."""
    points = [np.array(point, dtype=float) for point in ((0, 0, 0), (0, 0, 5), (0, 0, 5), (0, 0, 900), (30, 0, 900))]
    legs = joined(polyline(points))
    assert [leg.length_mm for leg in legs] == [900.0, 30.0]


def test_outline_does_not_repeat_its_first_point() -> None:
    square = [np.array(point, dtype=float) for point in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 0))]
    assert outline(polyline(square)).tolist() == [point.tolist() for point in square[:4]]
