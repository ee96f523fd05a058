"""Bars that lean by degrees are read as leaning, along the line of sight, too; the truth is that of the meshes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.extract.method import extract
from aadm_workbench.model import Kind
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import FIELD, random_bars, random_pose

LEANING = (1, 4, 6, 9)
HIDES_ITS_SIDE_DEG = 8.0  # the virtual camera loses surfaces that it grazes
TOWARDS = (0.0, np.pi, np.pi / 2, 4.0)  # out of the pattern, into it, across, and anywhere


def leaning(degrees: float, seed: int) -> TrueScan:
    rng = np.random.default_rng(seed)
    group = random_bars(FIELD, rng)
    bars = list(group.bars)
    for k, turn in zip(LEANING, TOWARDS, strict=True):
        direction = np.arctan2(bars[k].y, bars[k].x) + turn
        lean = np.tan(np.radians(degrees)) * np.array([np.cos(direction), np.sin(direction)])
        bars[k] = replace(bars[k], lean=(float(lean[0]), float(lean[1])))
    return scan_of(replace(group, bars=tuple(bars)), random_pose(FIELD, False, rng), CameraNoise(scale=0.0), rng)


def along_the_view_deg(place: np.ndarray, axis: np.ndarray) -> float:
    """Between the line of sight and the axis of a bar: with little of it, the camera sees the top and no side."""
    return float(np.degrees(np.arccos(abs(place @ axis) / np.linalg.norm(place) / np.linalg.norm(axis))))


@pytest.mark.parametrize("degrees", [1.0, 2.0, 3.7])
@pytest.mark.parametrize("seed", [3, 4])
def test_a_lean_is_read_and_its_uncertainty_holds(degrees: float, seed: int) -> None:
    truth = leaning(degrees, seed)
    found = extract(truth.scan(), Kind.REBAR, FIELD.bar_diameter, "refined", np.random.default_rng(0))
    places, axes = truth.points_scan(), truth.axes_scan()
    apart_deg = []
    for k in range(len(places)):
        point = min(found.points, key=lambda one: float(np.linalg.norm(one.centre - places[k])))
        apart = point.axis - axes[k] * np.sign(axes[k] @ point.axis)
        assert point.axis_covariance is not None
        apart_deg.append(np.degrees(np.linalg.norm(apart)))
        if k in LEANING and along_the_view_deg(places[k], axes[k]) < HIDES_ITS_SIDE_DEG:
            # one bar in ten leans so, and nothing shows it here: the covariance holds these odds, not that bar
            assert np.degrees(np.sqrt(np.trace(point.axis_covariance))) > 0.4
            continue
        off_in_u = np.sqrt(apart @ np.linalg.pinv(point.axis_covariance, rcond=1e-6) @ apart)
        assert off_in_u < 4.0, (k, off_in_u)
    # 0.4 degrees is what 60 mm of a ribbed side are said to tell; one bar may hide its side, and says so
    if degrees >= 2.0:
        assert np.median([apart_deg[k] for k in LEANING]) < 0.5
