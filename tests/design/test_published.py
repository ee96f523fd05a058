"""The paper's route to as-designed points, beside the exact one."""

import json
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.design.published import POINTS_PER_MM2, SLICE_MM, published_points, sampled_surfaces
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.inspection.as_designed import published_route
from aadm_workbench.model import ColumnDesign
from batch.main import main

RING = [[x, y] for x in (-240, -80, 80, 240) for y in (-240, -80, 80, 240) if max(abs(x), abs(y)) == 240]
SAMPLE = Path(__file__).parents[2] / "samples" / "floor" / "floor3.ifc"


@pytest.fixture
def design() -> ColumnDesign:
    table = {
        "centres": RING,
        "sleeve_diameter": 36.0,
        "rebar_diameter": 20.0,
        "embedded_length": 160.0,
        "size": [600, 600],
    }
    return inline_design("C-1", table)


def test_means_scatter_as_means_of_points_on_a_circle_do(design: ColumnDesign) -> None:
    away = [point.difference_mm for point in published_route(design)]
    assert all(value is not None for value in away)
    points = np.pi * 36.0 * SLICE_MM * POINTS_PER_MM2
    expected_mm = 18.0 / np.sqrt(points)  # root mean square of both axes
    measured_mm = float(np.sqrt(np.mean(np.square(np.array(away[:12], dtype=float)))))
    assert 0.5 * expected_mm < measured_mm < 2.0 * expected_mm


def test_it_is_the_same_every_time(design: ColumnDesign) -> None:
    first, second = (published_route(design) for _ in range(2))
    assert [point.difference_mm for point in first] == [point.difference_mm for point in second]


def test_the_cloud_lies_on_the_model(design: ColumnDesign) -> None:
    cloud = sampled_surfaces(design, np.random.default_rng(1))
    assert (np.abs(cloud[:, :2]) <= 300.0 + 1e-9).all()
    inside = np.linalg.norm(cloud[:, :2] - design.sleeves[0].centre[:2], axis=1) < 17.9
    level = cloud[inside, 2]
    assert not (level == 0.0).any(), "the foot face is open where the sleeve is"


def test_without_points_in_the_window_it_says_so(design: ColumnDesign) -> None:
    points = published_points(design, np.zeros((5, 3)))
    assert {point.edge_points for point in points} == {0}
    assert {point.difference_mm for point in points} == {None}


def test_the_command_shows_the_difference(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["design", str(SAMPLE), "--column", "C-301", "--method", "published"]) == 0
    printed = capsys.readouterr().out
    assert "C-301 by the published route" in printed
    assert "Difference to the exact centres" in printed
    assert main(["design", str(SAMPLE), "--column", "C-301", "--method", "published", "--json"]) == 0
    (column,) = json.loads(capsys.readouterr().out)["published"]
    assert [point["label"] for point in column["points"]] == [f"{kind}{k}" for kind in "SR" for k in range(1, 13)]
    assert max(point["difference_mm"] for point in column["points"]) < 6.0
