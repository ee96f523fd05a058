"""A mouth that is closed and a bar that is not there: seen to be so, and passed by nothing that was measured before."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
from aadm_workbench.hoisting.sequence.joint import measure_jointly
from aadm_workbench.model import AssemblyPoint, HoistingMeasurement, HoistingPair, Verdict
from aadm_workbench.report.words.reasons import in_both_languages
from tests import hoisting_rays as rays

_SIDE = [(-90.0 + 60.0 * k, -90.0) for k in range(3)]
DESIGN = rays.column(
    np.array([(x, y) for a, b in _SIDE for x, y in ((a, b), (-b, a), (-a, -b), (b, -a))]),
    sleeve_mm=26.0,
    bar_mm=18.0,
    size_mm=(250.0, 250.0),
)
NEAR, OTHER = (-1, -1), (1, -1)
# S2 stands on the side that both corners look at
CLOSED, ABSENT = {"taped": (1,)}, {"absent": (1,)}


@cache
def sound() -> rays.Scene:
    return rays.built(DESIGN, np.random.default_rng(231), (0.5, -0.4, 90.0, 0.3), scatter_mm=0.4)


@cache
def frame(kind: str, near: tuple[int, int], before: bool) -> HoistingMeasurement:
    """A frame whose hidden pairs would pass by their pattern: it is trusted to a tenth of a millimetre."""
    scene = replace(sound(), **{"closed": CLOSED, "absent": ABSENT, "sound": {}}[kind])
    scan = rays.shot(scene, rays.stand(scene, near, 700.0), np.random.default_rng(5))
    known = {"sleeves_before": scanned(0), "rebars_before": scanned(1)} if before else {}
    settings = HoistingSettings(load_profile("cn"), scatter_mm=0.1)
    return measure_hoisting(scan, DESIGN, near=near, settings=settings, **known)  # type: ignore[arg-type]


def scanned(kind: int) -> tuple[AssemblyPoint, ...]:
    """What scans of the sound column have told."""
    at, points = ((sound().sleeves, DESIGN.sleeves), (sound().bars, DESIGN.rebars))[kind]
    return tuple(
        replace(point, centre=np.array([*place, 0.0]), covariance=0.05**2 * np.eye(3))
        for place, point in zip(at, points, strict=True)
    )


def pair(found: HoistingMeasurement) -> HoistingPair:
    return found.report.pairs[1]


@pytest.mark.parametrize("before", [False, True])
@pytest.mark.parametrize(("kind", "label", "words"), [("closed", "S2", "封住"), ("absent", "R2", "不在原处")])
def test_what_is_seen_to_be_missing_does_not_pass(kind: str, label: str, words: str, before: bool) -> None:
    found = frame(kind, NEAR, before)
    assert pair(found).verdict is not Verdict.PASS
    assert found.report.verdict is not Verdict.PASS
    assert found.report.reasons[0].startswith(label)
    assert words in in_both_languages(found.report.reasons[0]).zh
    assert label in pair(found).reason
    assert label not in found.report.rests_on_scans
    assert not any("look from another corner" in reason and label in reason for reason in found.report.reasons)


def test_what_is_only_hidden_is_not_said_to_be_missing() -> None:
    found = frame("sound", NEAR, True)
    assert [one for one in found.report.pairs if not one.seen], "something is hidden"
    assert found.report.verdict is Verdict.PASS
    assert not any("not there" in reason or "closed" in reason for reason in found.report.reasons)


@pytest.mark.parametrize("kind", ["closed", "absent"])
def test_two_corners_together_pass_no_missing_point_either(kind: str) -> None:
    frames = [frame(kind, NEAR, False), frame(kind, OTHER, False)]
    joint = measure_jointly(frames, DESIGN, load_profile("cn"), "simple")
    assert joint is not None
    assert not pair(joint).seen
    assert joint.report.verdict is not Verdict.PASS


@pytest.mark.parametrize("kind", ["closed", "absent"])
def test_what_went_missing_after_an_earlier_frame_does_not_pass_by_that(kind: str) -> None:
    joint = measure_jointly([frame("sound", OTHER, False), frame(kind, NEAR, False)], DESIGN, None, "simple")
    again = measure_jointly([frame(kind, NEAR, False), frame("sound", OTHER, False)], DESIGN, None, "simple")
    assert joint is not None
    assert again is not None
    assert not pair(joint).seen
    assert pair(again).seen, "the tape was taken off"


def test_a_row_that_is_not_seen_whole_is_not_named_by_chance() -> None:
    """Six sleeves of a wall, of which five are seen: laid a pitch aside, every pair was 200 mm off, and sure."""
    places = np.array([(-500.0 + 200.0 * k, 0.0) for k in range(6)])
    wall = rays.column(places, sleeve_mm=36.0, bar_mm=22.0, size_mm=(1200.0, 200.0))
    scene = rays.built(wall, np.random.default_rng(1), (2.0, 1.0, 100.0, 0.0))
    scan = rays.shot(scene, rays.stand(scene, NEAR, 700.0), np.random.default_rng(3))
    found = measure_hoisting(scan, wall, near=NEAR)
    assert found.report.verdict is Verdict.NOT_MEASURED
    assert "not seen whole" in found.report.reasons[0]
    assert "未全部见到" in in_both_languages(found.report.reasons[0]).zh
