"""A column tried on bars of another one: its margin, the best turn, and what may be exchanged for what."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.matching.symmetry import symmetric_turns
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.shipment import interchangeable, try_margin
from aadm_workbench.assembly.trial.virtual import try_scans
from aadm_workbench.model import Array, ColumnDesign, Kind, Profile
from aadm_workbench.model.across import FitCell

CN = load_profile("cn")
Y_UP = np.array([0.0, 1.0])


def scanned(build: Any, design: ColumnDesign, kind: Kind, offsets: Array, up: Array | None = Y_UP, **more: Any) -> Any:
    """An extraction of points displaced by (n, 2), and its match."""
    points = design.points(kind)
    centres = np.array([point.centre for point in points]) + np.column_stack([offsets, np.zeros(len(offsets))])
    seen = build.see(centres, np.random.default_rng(5), **more)
    found = build.extraction(kind, seen, points[0].diameter_mm)
    return found, match_extraction(points, found, up=up, image_up_scan=seen.image_up)


def cell(build: Any, design: ColumnDesign, feet: Array, bars: Array, profile: Profile = CN, **more: Any) -> FitCell:
    sleeves, rebars = scanned(build, design, Kind.SLEEVE, feet), scanned(build, design, Kind.REBAR, bars)
    return try_margin(design, sleeves, rebars, profile, **more)


def test_the_margin_is_that_of_the_trial(build: Any, square: Array) -> None:
    design = build.column(square)
    rng = np.random.default_rng(1)
    feet, bars = rng.normal(0.0, 0.5, (12, 2)), rng.normal(0.0, 0.8, (12, 2))
    sleeves, rebars = scanned(build, design, Kind.SLEEVE, feet), scanned(build, design, Kind.REBAR, bars)
    trial = try_scans(design, sleeves, rebars, CN, np.random.default_rng(0), decision="simple")
    found = try_margin(design, sleeves, rebars, CN)
    assert found.margin == pytest.approx(trial.margin)
    assert trial.minimax is not None
    assert found.max_mm == pytest.approx(trial.minimax.max_mm)


def test_the_best_of_the_permitted_turns(build: Any, square: Array) -> None:
    design = build.column(square)
    quarter = next(found for found in symmetric_turns(square) if found.angle == pytest.approx(np.pi / 2.0))
    feet = np.zeros((12, 2))
    feet[0], feet[4] = [-6.0, 0.0], [0.0, 8.0]
    bars = np.zeros((12, 2))
    bars[quarter.onto] = feet @ turn(quarter.angle).T
    fixed, free = cell(build, design, feet, bars), cell(build, design, feet, bars, turns=True)
    assert fixed.margin is not None
    assert fixed.margin < 0.0
    assert free.margin == pytest.approx(1.0, abs=1e-6)
    assert free.turn_deg == pytest.approx(90.0)
    assert cell(build, design, 0 * feet, 0 * bars, turns=True).turn_deg == 0.0


def test_where_a_bar_touches_the_margin_is_the_room_that_is_missing(build: Any, square: Array) -> None:
    """Opposite bars 2.5 mm off: within 3 mm, but there is room of 1.75 mm."""
    bars = np.zeros((12, 2))
    bars[0], bars[6] = [-2.5 / np.sqrt(2.0)] * 2, [2.5 / np.sqrt(2.0)] * 2
    found = cell(build, build.column(square, sleeve_mm=27.0), np.zeros((12, 2)), bars)
    assert found.margin == pytest.approx(-0.75 / 1.75, abs=1e-6)


def test_what_was_not_measured_has_no_margin_but_what_fails_fails(build: Any, square: Array) -> None:
    design = build.column(square)
    sleeves = scanned(build, design, Kind.SLEEVE, np.zeros((12, 2)), missing=(3,))
    still = scanned(build, design, Kind.REBAR, np.zeros((12, 2)))
    found = try_margin(design, sleeves, still, CN)
    assert found.margin is None
    assert found.reason == "not measured: S4"
    bars = np.zeros((12, 2))
    bars[0], bars[6] = [-5.0, -5.0], [5.0, 5.0]
    beyond = try_margin(design, sleeves, scanned(build, design, Kind.REBAR, bars), CN)
    assert beyond.margin is not None
    assert beyond.margin < 0.0


def test_where_the_turn_is_open_the_worst_counts(build: Any, square: Array) -> None:
    design = build.column(square)
    feet = np.random.default_rng(2).normal(0.0, 0.7, (12, 2))
    sleeves = scanned(build, design, Kind.SLEEVE, feet)
    open_ = scanned(build, design, Kind.REBAR, feet, up=None)
    assert open_[1].orientation == "ambiguous"
    known = try_margin(design, sleeves, scanned(build, design, Kind.REBAR, feet), CN)
    worst = try_margin(design, sleeves, open_, CN)
    assert known.margin == pytest.approx(1.0, abs=1e-6)
    assert worst.margin is not None
    assert worst.margin < 0.8


def test_without_any_limit_nothing_is_known(build: Any, square: Array) -> None:
    design = build.column(square, rebar_mm=19.05)
    found = cell(build, design, np.zeros((12, 2)), np.zeros((12, 2)), build.profile())
    assert found.margin is None
    assert "neither a limit" in found.reason


def test_interchangeable(build: Any, square: Array) -> None:
    inline = build.column(square)
    marked = replace(inline, piece_mark="PCZ-1", global_id="0" * 22)
    other = replace(marked, piece_mark="PCZ-2")
    assert interchangeable(inline, replace(inline, id="C-2"))
    assert interchangeable(marked, replace(marked, id="C-2", global_id="1" * 22))
    assert not interchangeable(marked, other)
    assert not interchangeable(inline, replace(inline, global_id="0" * 22)), "of a model that does not say so"
    assert not interchangeable(inline, build.column(square * 1.01))
    assert not interchangeable(inline, build.column(square, sleeve_mm=40.0))
    assert interchangeable(inline, replace(inline, rebars=()))
