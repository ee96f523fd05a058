"""Frames that follow each other: as exact as if each were the first, and lost where something else is there."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.hoisting.measure import measure_hoisting
from aadm_workbench.hoisting.sequence.sighting import SightedMeasurement
from aadm_workbench.model import Array, HoistingMeasurement
from aadm_workbench.twin.hoisting import Hang, HoistingScan, Stand
from aadm_workbench.twin.scenes import LAB
from aadm_workbench.twin.study.hoisting import design_of
from tests import hoisting_rays as rays
from tests import hoisting_scenes as scenes


def measured(truth: HoistingScan, after: SightedMeasurement | None = None) -> SightedMeasurement:
    earlier = None if after is None else after.sighting
    found = measure_hoisting(truth.frame.scan(), design_of(LAB), near=scenes.NEAR, after=earlier)
    assert isinstance(found, SightedMeasurement)
    return found


@cache
def first() -> SightedMeasurement:
    return measured(scenes.usual())


@cache
def next_truth() -> HoistingScan:
    """The usual column, lowered by 1.5 mm and swung aside by 1 mm and 0.1 degrees."""
    return scenes.frame(LAB, Hang(88.5, 0.1, shift=(1.4, -0.1)), Stand(850.0), 1)


def test_a_frame_that_follows_is_as_exact_as_one_that_is_searched() -> None:
    tracked, searched = measured(next_truth(), first()), measured(next_truth())
    assert (tracked.sighting.tracked, searched.sighting.tracked) == (1, 0)
    assert [pair.seen for pair in tracked.report.pairs] == [pair.seen for pair in searched.report.pairs]
    errors, others = (scenes.distance_errors(found, next_truth()) for found in (tracked, searched))
    assert errors.mean() < max(0.15, 1.3 * others.mean())  # the push of all walls is known to 0.06 mm in either
    off = scenes.offset_errors(tracked, next_truth())
    squared = np.einsum("ki,kij,kj->k", off, np.linalg.inv(tracked.covariances), off)
    assert (squared < 18.4).all()  # one of ten thousand is farther
    move, other = tracked.report.correction, searched.report.correction
    assert move is not None
    assert other is not None
    assert (move.dx_mm, move.dy_mm) == pytest.approx((other.dx_mm, other.dy_mm), abs=0.25)
    assert tracked.report.column_tilt_deg == pytest.approx(searched.report.column_tilt_deg, abs=0.1)


def test_a_bar_that_is_bent_from_one_frame_to_the_next_is_seen_where_it_stands() -> None:
    truth = scenes.bent_since()  # R2, by 6 mm
    found = measured(truth, first())
    errors = scenes.offset_errors(found, truth)
    assert found.report.pairs[1].rebar_seen
    assert np.hypot(*errors[1]) < 0.45


def seen_of(found: HoistingMeasurement) -> Array:
    return np.array([pair.seen for pair in found.report.pairs])


@pytest.mark.parametrize("kind", ["jumped", "turned", "covered"])
def test_a_lost_track_is_searched_for_by_itself(kind: str) -> None:
    """A jump of 30 mm, a turn of 5 degrees, a board before most of the bars."""
    design = design_of(LAB)
    begin = rays.built(design, np.random.default_rng(233), (0.5, -0.5, 90.0, 0.2))
    hang = {"jumped": (21.7, 20.7, 90.0, 0.2), "turned": (0.5, -0.5, 90.0, 5.2)}.get(kind, begin.hang)
    boards = (rays.Box((-260.0, -260.0, -150.0), (-215.0, -120.0, 40.0)),) if kind == "covered" else ()
    after = replace(begin, hang=hang, boxes=boards)
    T, rng = rays.stand(begin, (-1, -1), 750.0), np.random.default_rng(7)
    last, scan = measure_hoisting(rays.shot(begin, T, rng), design, near=scenes.NEAR), rays.shot(after, T, rng)
    assert isinstance(last, SightedMeasurement)
    found = measure_hoisting(scan, design, near=scenes.NEAR, after=last.sighting)
    assert found.report == measure_hoisting(scan, design, near=scenes.NEAR).report
    seen, before = seen_of(found), seen_of(last)
    assert seen.sum() >= 8 if not boards else seen.sum() < before.sum()
    if seen.any():
        squared, errors = rays.squares(found, after)
        assert errors[seen].mean() < 0.3
        assert np.mean(squared[seen] < 9.21) >= 0.9


def test_another_column_is_searched_for() -> None:
    other = scenes.from_corner(scenes.NEAR)
    found = measured(other, first())
    assert found.sighting.tracked == 0
    assert found.report == measured(other).report


def test_what_follows_for_long_is_searched_anew() -> None:
    found = first()
    for number in range(1, 33):
        found = measured(scenes.usual(), found)
        if found.sighting.tracked == 0:
            assert number == 31
            return
    pytest.fail("never searched anew")
