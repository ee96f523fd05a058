"""A swinging column: its rest from a few frames, and no "go" while it swings."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

from aadm_workbench.hoisting.swing.motion import Look, Motion, motion_of, with_look
from aadm_workbench.hoisting.swing.pendulum import swing_of
from aadm_workbench.model import Array, CameraMove, Correction
from batch.capturing.session import LiveFolder

RING = np.array([[x, y] for x in (-95.0, 0.0, 95.0) for y in (-95.0, 0.0, 95.0) if (x, y) != (0.0, 0.0)])
NOISE_MM = 0.05


def pendulum(times: Array, amplitude_mm: float, rope_m: float, seed: int) -> Array:
    """Places (n, 2) mm of a free pendulum about its rest, by stepping its equation of motion."""
    rng = np.random.default_rng([31, seed])
    start, towards = rng.uniform(0.0, 9.0), rng.uniform(0.0, 2.0 * np.pi)
    angle, speed, step_s, now_s = amplitude_mm / 1000.0 / rope_m, 0.0, 1e-3, 0.0
    places = []
    for time_s in times + start:
        while now_s < time_s:
            speed -= step_s * 9.81 / rope_m * math.sin(angle)
            angle += step_s * speed
            now_s += step_s
        places.append(1000.0 * rope_m * math.sin(angle))
    along = np.array([math.cos(towards), math.sin(towards)])
    return np.outer(places, along) + rng.normal(0.0, NOISE_MM, (len(times), 2))


@pytest.mark.parametrize("rope_m", [2.0, 6.0, 15.0])
@pytest.mark.parametrize("amplitude_mm", [2.0, 9.0])
def test_five_frames_tell_the_rest_of_a_pendulum(rope_m: float, amplitude_mm: float) -> None:
    for seed in range(4):
        times = np.cumsum(np.random.default_rng(seed).uniform(0.8, 1.4, 5))
        rest = np.array([4.0, -7.0])
        found = swing_of(times, rest + pendulum(times, amplitude_mm, rope_m, seed), NOISE_MM)
        assert found is not None
        assert np.hypot(*(found.rest - rest)) < max(0.15, 4.0 * found.rest_u_mm)
        assert found.amplitude_mm > 0.93 * amplitude_mm
        if found.rest_u_mm < 0.1:
            assert found.period_s == pytest.approx(2.0 * math.pi * math.sqrt(rope_m / 9.81), rel=0.06)


def test_a_column_at_rest_is_known_to_be_so_after_three_frames() -> None:
    times = np.array([0.0, 0.9, 2.0])
    found = swing_of(times, np.random.default_rng(3).normal(0.0, NOISE_MM, (3, 2)), NOISE_MM)
    assert found is not None
    assert found.amplitude_mm < 0.8
    assert found.rest_u_mm < 0.3


def test_frames_of_one_moment_do_not_tell_a_rest() -> None:
    """At the turn of a swing a column seems to stand: three frames in a tenth of a second see nothing else."""
    times = np.array([0.0, 0.05, 0.1])
    places = 9.0 * np.cos(2.0 * np.pi * times / 4.5)[:, None] * np.array([1.0, 0.0])
    assert swing_of(times, places, NOISE_MM) is None
    assert motion_of(looks(places, times), RING, correction(0.9, 0.0), 3.0).still is None


def test_frames_at_video_rate_tell_the_swing_too() -> None:
    times = np.arange(300) / 30.0
    places = 9.0 * np.cos(2.0 * np.pi * times / 4.5)[:, None] * np.array([0.6, 0.8])
    seen = looks(places, times)
    assert seen[-1].time_s == times[-1]
    assert seen[-1].time_s - seen[0].time_s > 3.0
    motion = motion_of(seen, RING, correction(0.9 - places[-1, 0], -places[-1, 1]), 3.0)
    assert motion.swing is not None
    assert motion.swing.amplitude_mm == pytest.approx(9.0, abs=0.5)
    assert motion.still is False


def test_a_push_begins_anew() -> None:
    rng = np.random.default_rng(5)
    times = np.arange(8.0)
    places = np.where(np.arange(8)[:, None] < 4, [12.0, 3.0], [0.0, 0.0]) + rng.normal(0.0, NOISE_MM, (8, 2))
    found = swing_of(times, places, NOISE_MM)
    assert found is not None
    assert found.frames == 4
    assert np.hypot(*found.rest) < 0.15
    assert swing_of(times[:6], places[:6], NOISE_MM) is None  # two frames since


def looks(places: Array, times: Array, yaws: Array | None = None) -> tuple[Look, ...]:
    """Frames of a column that is displaced by ``places`` (n, 2) mm; bars stand 1 mm off on one side."""
    found: tuple[Look, ...] = ()
    offsets_of_ring = np.where(np.arange(len(RING))[:, None] < 4, [1.0, 0.0], [0.8, 0.1])
    for k, time_s in enumerate(times):
        yaw = 0.0 if yaws is None else yaws[k]
        turned = RING @ np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]]) - RING
        offsets = offsets_of_ring - places[k] - turned
        found = with_look(found, Look(float(time_s), offsets, np.full(len(RING), 0.08**2), np.ones(len(RING), bool)))
    return found


def correction(dx_mm: float, dy_mm: float, yaw_deg: float = 0.0) -> Correction:
    """A correction as seen by a camera that looks along +x: right is -y, away is +x."""
    return Correction(dx_mm, dy_mm, yaw_deg, camera=CameraMove(-dy_mm, dx_mm, yaw_deg))


def of_swing(count: int, amplitude_mm: float, limit_mm: float = 3.0) -> Motion:
    times = 0.3 + 1.1 * np.arange(count)
    places = amplitude_mm * np.sin(2.0 * np.pi * times / 5.0)[:, None] * np.array([0.6, 0.8])
    now = places[-1]
    return motion_of(looks(places, times), RING, correction(0.9 - now[0], -now[1]), limit_mm)


def test_a_swinging_column_never_says_it_is_still() -> None:
    first, second = of_swing(1, 9.0), of_swing(2, 9.0)
    assert (first.still, first.moving) == (None, False)
    assert first.rest is not None  # one frame: nobody knows yet that it moves
    assert (second.still, second.moving, second.rest) == (None, True, None)
    for count in range(3, 10):
        assert of_swing(count, 9.0).still is False


def test_the_correction_is_that_of_the_rest() -> None:
    motion = of_swing(6, 9.0)
    assert motion.swing is not None
    assert motion.rest is not None
    assert motion.rest.camera is not None
    assert (motion.rest.dx_mm, motion.rest.dy_mm) == pytest.approx((0.9, 0.0), abs=0.15)
    assert (motion.rest.camera.right_mm, motion.rest.camera.away_mm) == pytest.approx((0.0, 0.9), abs=0.15)
    assert motion.swing.amplitude_mm == pytest.approx(9.0, abs=0.7)
    assert motion.swing.period_s == pytest.approx(5.0, abs=0.3)
    assert motion.largest_mm == pytest.approx(1.0, abs=0.2)


def test_a_small_swing_within_the_limit_is_still() -> None:
    assert of_swing(6, 0.6).still is True
    assert of_swing(6, 0.6, limit_mm=1.4).still is False  # 1.0 of rest and 0.6 of swing
    assert of_swing(6, 0.0).still is True


def test_a_column_that_turns_to_and_fro_is_not_still() -> None:
    times = 1.1 * np.arange(6)
    yaws = 0.03 * np.sin(2.0 * np.pi * times / 4.0)  # 4 mm at the corners
    motion = motion_of(looks(np.zeros((6, 2)), times, yaws), RING, correction(0.9, 0.0), 3.0)
    assert motion.still is False
    assert motion.swing is not None
    assert motion.swing.amplitude_mm > 3.5


def test_a_clock_that_is_set_back_begins_anew() -> None:
    found = looks(np.zeros((4, 2)), np.array([100.0, 101.0, 102.0, 5.0]))
    assert [look.time_s for look in found] == [5.0]


class Clocked:
    """A camera that keeps when it was asked."""

    def __init__(self) -> None:
        self.now_s, self.times = 0.0, list[float]()

    def take(self, folder: Path) -> None:
        self.times.append(self.now_s)


@pytest.mark.parametrize("period_s", [2.0, 4.0])
def test_a_column_that_swings_at_the_pace_of_the_watchs_camera_does_not_seem_to_stand(
    period_s: float, tmp_path: Path
) -> None:
    """Asked for a frame every 4 s; frames 4.0 s apart would show a swing of 6 mm at one place."""
    camera = Clocked()
    live = LiveFolder(cast(Any, camera), tmp_path, 4.0, lambda: camera.now_s)
    while len(camera.times) < 9:
        live.fault()
        camera.now_s += 0.05
    times = np.array(camera.times)
    assert np.diff(times).mean() == pytest.approx(4.0, rel=0.05)
    phases = 2.0 * np.pi * times / period_s + 0.3
    places = 6.0 * np.column_stack([np.cos(phases), 0.3 * np.sin(phases)])
    for count in range(3, 9):
        swing = swing_of(times[:count], places[:count], NOISE_MM)
        assert swing is None or swing.amplitude_mm + np.hypot(*swing.rest) > 3.0
