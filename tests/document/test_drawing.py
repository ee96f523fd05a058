"""What is drawn, and where: marks, labels, projection, distances; without FreeCAD."""

import itertools

import numpy as np
import pytest

from aadm_workbench.design.design_text import read_design, write_design
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.document.cloud import distance_from_design
from aadm_workbench.document.display.colours import FAR, of_distances
from aadm_workbench.document.display.label_layout import Wanted, overlap, place_labels
from aadm_workbench.document.display.marks import arrow_outline, best_magnification, marks_of, pitch_of, ring
from aadm_workbench.document.display.projection import ViewCamera, project
from aadm_workbench.document.display.reported_design import design_of_report
from aadm_workbench.document.display.result_rows import only_what_fails, result_rows
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Kind
from aadm_workbench.scan.thinned import thinned
from tests.document.test_objects import point, report

COLUMN = report()["columns"][0]


def paired() -> dict:
    """A column with two pairs, bars 3.5 and 1 mm beside their sleeves."""
    sleeves = [point("S1", -80.0, 0.0, 0.0, "pass"), point("S2", 80.0, 0.0, 0.0, "pass")]
    rebars = [point("R1", -80.0, 0.0, 3.5, "fail"), point("R2", 80.0, 0.0, 1.0, "pass")]
    pairs = [
        {
            "sleeve": "S1",
            "rebar": "R1",
            "offset_mm": [3.5, 0.0],
            "distance_mm": 3.5,
            "limit_mm": 3.0,
            "verdict": "fail",
        },
        {
            "sleeve": "S2",
            "rebar": "R2",
            "offset_mm": [1.0, 0.0],
            "distance_mm": 1.0,
            "limit_mm": 3.0,
            "verdict": "pass",
        },
    ]
    trial = {"T_sleeves_rebars": np.eye(4).tolist(), "pairs": pairs}
    return COLUMN | {
        "sleeves": {"points": sleeves},
        "rebars": {"points": rebars},
        "trial_assembly": {"minimax": trial, "least_squares": None, "missing": []},
    }


def test_arrow_points_from_design_to_as_built_and_is_magnified() -> None:
    marks = marks_of(COLUMN, "position", 30.0)
    arrow = next(arrow for arrow in marks.arrows if arrow.verdict == "fail")
    np.testing.assert_allclose(arrow.start, [240.0, -240.0, 0.0])
    np.testing.assert_allclose(arrow.end - arrow.start, [75.0, 0.0, 0.0])


def test_circles_stand_at_true_size_where_things_are() -> None:
    marks = marks_of(COLUMN, "position", 30.0)
    circle = next(circle for circle in marks.circles if circle.verdict == "fail")
    np.testing.assert_allclose(circle.centre, [242.5, -240.0, 0.0])
    assert circle.radius_mm == 18.0
    corners = ring(circle.centre, circle.radius_mm)
    np.testing.assert_allclose(np.linalg.norm(corners - circle.centre, axis=1), 18.0)
    np.testing.assert_allclose(corners[0], corners[-1])


def test_arrows_of_the_trial_lead_from_sleeve_to_bar() -> None:
    marks = marks_of(paired(), "minimax", 10.0)
    np.testing.assert_allclose(marks.arrows[0].end - marks.arrows[0].start, [35.0, 0.0, 0.0])
    assert [label.name for label in marks.labels] == ["S1–R1", "S2–R2"]
    assert len(marks.circles) == 4
    assert marks_of(paired(), "least_squares", 10.0).circles == ()


def test_what_was_not_measured_is_marked_at_its_design_place() -> None:
    missing = point("S1", 10.0, 20.0, 0.0, "not_measured") | {"aligned_mm": None, "deviation_mm": None}
    marks = marks_of(COLUMN | {"sleeves": {"points": [missing]}}, "position", 10.0)
    np.testing.assert_allclose(marks.circles[0].centre, [10.0, 20.0, 0.0])
    assert marks.arrows == ()
    assert marks.labels[0].value_mm is None


def test_magnification_fits_the_pattern() -> None:
    assert pitch_of(COLUMN) == 480.0
    assert best_magnification(COLUMN, 160.0) == 30.0
    assert best_magnification(COLUMN, 1.0) == 1.0


def test_arrow_outline_runs_from_tail_to_tip() -> None:
    marks = marks_of(COLUMN, "position", 30.0)
    outline = arrow_outline(marks.arrows[1], 5.0)
    assert outline[:, 0].min() == pytest.approx(240.0)
    assert outline[:, 0].max() == pytest.approx(315.0)
    nothing = arrow_outline(marks_of(paired(), "position", 1.0).arrows[0], 5.0)
    assert nothing.shape == (0, 3)


def test_table_begins_with_the_worst_and_filters() -> None:
    rows = result_rows(paired())
    assert [row.name for row in rows[:2]] == ["R1", "S1–R1"]
    assert rows[0].share == pytest.approx(1.75)
    assert {row.name for row in only_what_fails(rows)} == {"R1", "S1–R1"}


def test_signed_limits_are_those_of_their_side() -> None:
    gap = {"between": ["S1", "S2"], "deviation_mm": -1.5, "limit_mm": [-1.0, 2.0], "u_mm": 0.1, "verdict": "fail"}
    (row,) = result_rows({"sleeves": {"points": [], "spacing": [gap]}})
    assert row.limit_mm == 1.0
    assert row.share == pytest.approx(1.5)
    assert row.place_mm is None


def test_labels_never_overlap_and_the_worst_are_shown() -> None:
    rng = np.random.default_rng(7)
    labels = [Wanted(*rng.uniform(0, 400, 2), 90.0, 20.0, rank) for rank in range(60)]
    boxes = place_labels(labels, (400.0, 400.0))
    shown = [box for box in boxes if box is not None]
    assert boxes[0] is not None
    assert 10 < len(shown) < 60
    assert not [pair for pair in itertools.combinations(shown, 2) if overlap(*pair)]
    assert all(box[0] >= 0 and box[2] <= 400 and box[1] >= 0 and box[3] <= 400 for box in shown)


def test_label_of_a_point_outside_the_screen_is_left_out() -> None:
    assert place_labels([Wanted(-5.0, 10.0, 50.0, 20.0, 0)], (400.0, 400.0)) == [None]


def test_projection_far_from_the_origin_and_in_perspective() -> None:
    far = np.array([5.0e8, 2.0e8, 0.0])
    above = ViewCamera(far + np.array([0, 0, 1000.0]), np.eye(3), 760.0, np.inf, (800.0, 600.0))
    pixels, mm_per_pixel = project(np.array([far, far + np.array([76.0, 0, 0])]), above)
    np.testing.assert_allclose(pixels, [[400.0, 300.0], [460.0, 300.0]])
    np.testing.assert_allclose(mm_per_pixel, 760.0 / 600.0)
    tall = ViewCamera(np.zeros(3), np.eye(3), 100.0, np.inf, (300.0, 600.0))
    np.testing.assert_allclose(project(np.array([[50.0, 0, -1]]), tall)[0], [[300.0, 300.0]])
    near = ViewCamera(np.zeros(3), np.eye(3), 100.0, 50.0, (600.0, 600.0))
    pixels, _ = project(np.array([[50.0, 0, -50.0], [50.0, 0, -100.0], [0, 0, 10.0]]), near)
    np.testing.assert_allclose(pixels[:2, 0], [600.0, 450.0])
    assert np.isnan(pixels[2]).all()


def design():
    table = {
        "centres": [[-100, 0], [100, 0]],
        "sleeve_diameter": 36.0,
        "rebar_diameter": 20.0,
        "embedded_length": 160.0,
    }
    return inline_design("C", table)


def test_distances_are_from_the_design_surface() -> None:
    points = np.array([[-90.0 + 0.5, 0, 100.0], [-100.0, 0, 161.0], [-100.0, 3.0, 159.5], [-90.0 + 3, 0, 164.0]])
    np.testing.assert_allclose(distance_from_design(points, design(), Kind.REBAR), [0.5, 1.0, -0.5, 5.0])
    np.testing.assert_allclose(distance_from_design(points, design(), Kind.SLEEVE), points[:, 2])


def test_colours_of_distances() -> None:
    below, above, beyond = of_distances(np.array([-0.9, 0.9, 1.1]), 1.0)
    assert below[2] > below[0]
    assert above[0] > above[2]
    np.testing.assert_allclose(beyond, FAR)


def test_thinned_clouds_hold_no_gaps() -> None:
    points = np.full((40, 50, 3), np.nan, dtype=np.float32)
    points[:20] = 1.0
    shown, count = thinned(points, 300)
    assert count == 1000
    assert len(shown) == 250
    assert np.isfinite(shown).all()
    assert thinned(np.zeros((0, 3)), 10)[0].shape == (0, 3)


def test_design_text_gives_back_the_same() -> None:
    before = design()
    after = read_design(write_design(before), "C")
    assert write_design(after) == write_design(before)
    np.testing.assert_array_equal(after.rebars[1].centre, before.rebars[1].centre)
    assert after.embedded_length_mm == 160.0
    with pytest.raises(DesignError, match="sample"):
        read_design("{}", "C")


def test_design_of_a_report_uses_what_was_measured() -> None:
    found = design_of_report(COLUMN)
    assert [sleeve.label for sleeve in found.sleeves] == ["S1", "S2", "S3", "S4"]
    assert found.sleeves[0].diameter_mm == 36.0
    assert found.rebars == ()
