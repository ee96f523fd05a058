"""Columns with more than one size of sleeve or bar: each is found, and none spoils the radius of the others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.extract.method import distinct_sizes, extract_sizes
from aadm_workbench.model import Kind
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot
from tests.scenes import in_plane_errors, lab_scan

CORNERS = (0, 3, 6, 9)


def test_sizes_are_told_apart_and_the_usual_one_comes_first() -> None:
    assert distinct_sizes([20.0, 25.0, 20.0, 20.4, 25.0]) == (20.0, 25.0)
    assert distinct_sizes([36.0]) == (36.0,)
    assert distinct_sizes([18.0, 20.0, 22.0, 22.0]) == (22.0, 18.0, 20.0)


@pytest.mark.parametrize("corner_mm", [30.0, 34.0])
def test_wider_sleeves_at_the_corners(corner_mm: float) -> None:
    foot = random_foot(LAB, np.random.default_rng(31))
    sleeves = tuple(
        replace(sleeve, diameter=corner_mm + sleeve.diameter - 26.0) if k in CORNERS else sleeve
        for k, sleeve in enumerate(foot.sleeves)
    )
    truth = lab_scan(replace(foot, sleeves=sleeves))
    nominal = [corner_mm if k in CORNERS else 26.0 for k in range(12)]
    found = extract_sizes(truth.scan(), Kind.SLEEVE, nominal, "refined", np.random.default_rng(0))
    assert len(found.points) == 12
    error = np.hypot(*in_plane_errors(found, truth).T)
    assert error.max() < 0.2, np.round(error, 2)
    assert sorted(point.diameter_mm for point in found.points) == pytest.approx(
        sorted(s.diameter for s in sleeves), abs=0.3
    )


@pytest.mark.parametrize("corner_mm", [20.0, 25.0])
def test_thicker_bars_at_the_corners(corner_mm: float) -> None:
    group = random_bars(LAB, np.random.default_rng(32))
    bars = tuple(
        replace(bar, core_diameter=corner_mm + bar.core_diameter - 18.0) if k in CORNERS else bar
        for k, bar in enumerate(group.bars)
    )
    truth = lab_scan(replace(group, bars=bars))
    nominal = [corner_mm if k in CORNERS else 18.0 for k in range(12)]
    found = extract_sizes(truth.scan(), Kind.REBAR, nominal, "refined", np.random.default_rng(0))
    assert len(found.points) == 12
    assert len(found.exposed_length_mm) == 12
    error = np.hypot(*in_plane_errors(found, truth).T)
    assert error.max() < 0.3, np.round(error, 2)
    assert sorted(point.diameter_mm for point in found.points) == pytest.approx(
        sorted(bar.core_diameter for bar in bars), abs=0.5
    )


def test_nothing_of_any_size_is_said_of_each() -> None:
    foot = random_foot(LAB, np.random.default_rng(33))
    truth = lab_scan(replace(foot, sleeves=()))
    found = extract_sizes(truth.scan(), Kind.SLEEVE, [26.0, 40.0], "refined", np.random.default_rng(0))
    assert found.points == ()
    assert "26 mm" in found.reason
    assert "40 mm" in found.reason
