"""What a site does to a scan: one builder a scene, each with the features it spoils and what may be expected of them.

Feet and bars are those of the laboratory setting unless a name says otherwise. The camera keeps its pixels; of its
image only the window around the pattern is rendered.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from aadm_workbench.extract.method import extract
from aadm_workbench.extract.missing import explain_missing
from aadm_workbench.model import Array, Extraction, Kind
from aadm_workbench.twin.camera import PRO_M, facing
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Box, Foot, Grout, Hose
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import FIELD, LAB, UP, Setting, random_bars, random_foot, random_pose
from tests.scenes import SEEN_DEPTH_MM, WARP_PERIOD, window

FALSE_BEYOND_MM = 3.0

Part = Foot | BarGroup


@dataclass(frozen=True)
class Scene:
    """A spoilt scan: ``spoilt`` are the numbers of the features whose measurement is at stake.

    ``refused`` are those that cannot be measured, for one of some ``reasons``; ``bound_mm`` holds for the spoilt ones
    that can, ``others_mm`` for the rest. ``reach_mm`` is the half width of what is rendered, ``seed`` one that makes
    the scene a hard one of its sort.
    """

    kind: Kind
    build: Callable[[Part, np.random.Generator], Part]
    spoilt: tuple[int, ...] = ()
    refused: tuple[int, ...] = ()
    reasons: tuple[str, ...] = ()
    bound_mm: float = 0.35
    others_mm: float = 0.25
    seed: int = 1
    setting: Setting = LAB
    noise: Callable[[CameraNoise], CameraNoise] = lambda noise: noise
    tilt_deg: float = 5.0
    distance: float | None = None
    pose: Callable[[np.random.Generator], Array] | None = None
    reach_mm: float | None = None

    @property
    def diameter_mm(self) -> float:
        """Nominal diameter of what is looked for."""
        return self.setting.sleeve_diameter if self.kind is Kind.SLEEVE else self.setting.bar_diameter


@dataclass(frozen=True, eq=False)
class Outcome:
    """What was found of each true point: ``error_mm`` (n, 2) and ``u_mm`` (n,), NaN where not found.

    ``false`` are found points (k, 3) far from every true one; ``reasons`` by the number of a point that is missing.
    """

    error_mm: Array
    u_mm: Array
    false: Array
    reasons: dict[int, str]

    @property
    def distance_mm(self) -> Array:
        """Errors (n,) in the plane."""
        return np.hypot(*self.error_mm.T)


@cache
def scan(name: str, seed: int | None = None) -> TrueScan:
    """The scene of a name, rendered once per process."""
    scene = SCENES[name]
    rng = np.random.default_rng([scene.seed if seed is None else seed, *name.encode()])
    part: Part
    if scene.kind is Kind.SLEEVE:
        foot = random_foot(scene.setting, rng)
        part = replace(foot, sleeves=tuple(replace(sleeve, depth=SEEN_DEPTH_MM) for sleeve in foot.sleeves))
    else:
        part = random_bars(scene.setting, rng)
    part = scene.build(part, rng)
    looking_up = scene.kind is Kind.SLEEVE
    pose = random_pose(scene.setting, looking_up, rng, scene.tilt_deg, scene.distance)
    pose = pose if scene.pose is None else scene.pose(rng)
    reach_mm = scene.reach_mm or scene.setting.half_width + 34.0
    noise = replace(scene.noise(CameraNoise(scale=0.0)), warp_period=WARP_PERIOD)
    return scan_of(part, pose, noise, rng, window(PRO_M, pose, reach_mm))


@cache
def outcome(name: str, seed: int | None = None) -> Outcome:
    """What ``refined`` makes of a scene, as the product uses it: search, look again at empty places, explain."""
    scene, truth = SCENES[name], scan(name, seed)
    rng = np.random.default_rng(0)
    expected = truth.points_scan() + truth.T_column_scan[:3, :3].T @ np.array([0.7, -0.5, 0.0])
    found = extract(truth.scan(), scene.kind, scene.diameter_mm, "refined", rng)
    missing = np.flatnonzero(np.isnan(compared(found, truth).u_mm))
    if len(missing):
        again = extract(truth.scan(), scene.kind, scene.diameter_mm, "refined", rng, expected[missing])
        found = again if len(again.points) > len(found.points) else found
    result = compared(found, truth)
    missing = np.flatnonzero(np.isnan(result.u_mm))
    if len(missing):
        reasons = explain_missing(truth.scan(), found, expected[missing], scene.diameter_mm, rng)
        result.reasons.update(zip(missing.tolist(), reasons, strict=True))
    return result


def compared(found: Extraction, truth: TrueScan) -> Outcome:
    """Found centres against the true ones, in the plane across the column's axis."""
    across = truth.T_column_scan[:2, :3]
    true = truth.points_scan()
    centres = np.array([point.centre for point in found.points]).reshape(-1, 3)
    offset = (centres[None] - true[:, None]) @ across.T
    distance = np.hypot(offset[..., 0], offset[..., 1])
    error, u = np.full((len(true), 2), np.nan), np.full(len(true), np.nan)
    for k in range(len(true) if len(centres) else 0):
        nearest = int(distance[k].argmin())
        if distance[k, nearest] < FALSE_BEYOND_MM:
            covariance = found.points[nearest].covariance
            assert covariance is not None
            error[k], u[k] = offset[k, nearest], np.sqrt(np.trace(across @ covariance @ across.T) / 2)
    false = centres[(distance >= FALSE_BEYOND_MM).all(axis=0)]
    return Outcome(error, u, false, {})


def _some(change: Callable[[Any, int], Any], *numbers: int) -> Callable[[Part, object], Part]:
    """Change some sleeves or bars; ``change`` is given each of them and its place among those that are changed."""

    def build(part: Part, rng: object) -> Part:
        name = "sleeves" if isinstance(part, Foot) else "bars"
        things = list(getattr(part, name))
        for place, number in enumerate(numbers):
            things[number] = change(things[number], place)
        return replace(part, **{name: tuple(things)})

    return build


def _as_is(part: Part, rng: object) -> Part:
    return part


def _with_grout(part: Part, rng: object) -> Part:
    """Splashes beside mouths and over their rims; the last one lies between two sleeves."""
    assert isinstance(part, Foot)
    splashes = [Grout(0.0, 55.0, 25.0, 2.0), Grout(-40.0, -20.0, 30.0, 3.0)]
    for number, turn, over_mm, thickness in ((1, 0.4, 5.0, 1.0), (5, 2.5, 4.0, 3.0), (9, 4.6, 6.0, 2.0)):
        sleeve = part.sleeves[number]
        away = sleeve.diameter / 2 + 14.0 - over_mm
        splashes.append(Grout(sleeve.x + away * np.cos(turn), sleeve.y + away * np.sin(turn), 14.0, thickness))
    return replace(part, grout=tuple(splashes))


def _with_shifted_walls(part: Part, rng: np.random.Generator) -> Part:
    """Every bore's wall appears beside its place, by up to 0.8 mm in a direction of its own."""
    assert isinstance(part, Foot)
    reach, turn = 0.8 * np.sqrt(rng.uniform(size=len(part.sleeves))), rng.uniform(0, 2 * np.pi, len(part.sleeves))
    return replace(
        part,
        sleeves=tuple(
            replace(sleeve, wall_shift=(float(r * np.cos(t)), float(r * np.sin(t))))
            for sleeve, r, t in zip(part.sleeves, reach, turn, strict=True)
        ),
    )


def _foot_with_things(part: Part, rng: object) -> Part:
    """A plank beside the foot, a box in front of its edge, and a hose that hangs across one sleeve."""
    assert isinstance(part, Foot)
    plank, box = Box((150.0, -180.0, -30.0), (230.0, 180.0, -8.0)), Box((-210.0, -170.0, -60.0), (-135.0, -90.0, 0.0))
    sleeve = part.sleeves[7]
    hose = Hose(((-40.0, 180.0), (sleeve.x + 16.0, sleeve.y), (30.0, 0.0), (-10.0, -40.0)), -50.0, 16.0)
    return replace(part, beside=(plank, box, hose))


def _bars_with_things(part: Part, rng: object) -> Part:
    """A board beside the bars, a box among them as high as they are, a hose over the floor."""
    assert isinstance(part, BarGroup)
    board = Box((125.0, -160.0, part.floor), (165.0, 160.0, part.floor + 45.0))
    box = Box((-25.0, -25.0, part.floor), (15.0, 15.0, 0.0))
    hose = Hose(((-150.0, -60.0), (-60.0, -55.0), (0.0, 60.0), (60.0, 50.0), (150.0, 60.0)), part.floor + 12.5)
    return replace(part, beside=(board, box, hose))


def _one_before_another(part: Part, rng: object) -> Part:
    """A bar 90 mm longer between the camera and the corner bar: it hides a part of the corner bar's top."""
    assert isinstance(part, BarGroup)
    corner = part.bars[6]
    inwards = np.sign([corner.x, corner.y]) * 18.0
    tall = replace(corner, x=corner.x - inwards[0], y=corner.y - inwards[1], top=90.0, lean=(0.0, 0.0))
    return replace(part, bars=(*part.bars, tall))


def _square_above(rng: np.random.Generator) -> Array:
    """A camera straight above the middle, so that what hides what is known."""
    return facing(np.zeros(3), np.array([0.0, 0.0, -1.0]), UP, LAB.distance, (0.0, 0.0), 0.0)


def _too_near(rng: np.random.Generator) -> Array:
    """A camera so close to the corner (+x, +y) that five of the twelve sleeves are in its view."""
    return facing(np.array([110.0, 110.0, 0.0]), np.array([0.0, 0.0, 1.0]), UP, 850.0, (0.02, -0.03), 0.01)


def _noisy(noise: CameraNoise) -> CameraNoise:
    return replace(noise, depth_at_1m=0.2, warp=0.1)


def _sparse(noise: CameraNoise) -> CameraNoise:
    return replace(noise, random_loss=0.5)


TURNS = (0.3, 2.3, 4.4)
S, R = Kind.SLEEVE, Kind.REBAR
ALL = tuple(range(12))
SOME = (1, 5, 9)
PLUGGED = ("plugged or covered",)
OUTSIDE = ("outside of what the scan shows", "too little of the mouth's rim")


def _towards(turn: float, length: float) -> tuple[float, float]:
    return float(length * np.cos(turn)), float(length * np.sin(turn))


def _leaning(bar: BarAsBuilt, k: int) -> BarAsBuilt:
    """Straight, kicked at the floor: its top is 6.3 mm off its place."""
    dx, dy = _towards(TURNS[k], 6.3)
    return replace(bar, x=bar.x + dx, y=bar.y + dy, lean=_towards(TURNS[k], np.tan(np.radians(3.0))))


def _bent(bar: BarAsBuilt, k: int) -> BarAsBuilt:
    dx, dy = _towards(TURNS[k], 10.0)
    return replace(bar, x=bar.x + dx, y=bar.y + dy, bend=(dx, dy))


def _oblique(direction: float) -> Callable[[np.random.Generator], Array]:
    """A pose 8 degrees off the normal of a field column, seen along +z or -z."""
    forward, tilt = np.array([0.0, 0.0, direction]), (np.radians(6.5), np.radians(-4.7))
    return lambda rng: facing(np.zeros(3), forward, UP, FIELD.distance, tilt, 0.02)


def _taped(share: float) -> Callable[[Part, object], Part]:
    return _some(lambda sleeve, k: replace(sleeve, taped=share, chip_direction=TURNS[k]), *SOME)


SCENES: dict[str, Scene] = {
    "sleeves plugged flush": Scene(S, _some(lambda s, k: replace(s, plugged_at=0.0), 1, 6), (), (1, 6), PLUGGED),
    "sleeves plugged 6 mm inside": Scene(S, _some(lambda s, k: replace(s, plugged_at=6.0), 1, 6), (1, 6), seed=5),
    "sleeves half covered by tape": Scene(S, _taped(0.5), SOME, seed=3),
    "sleeves covered by tape but for a slit": Scene(S, _taped(0.9), (), SOME, PLUGGED),
    "sleeves with a chipped rim": Scene(
        S, _some(lambda s, k: replace(s, chip=10.0, chip_direction=TURNS[k]), *SOME), SOME, seed=2
    ),
    "grout on the face and over rims": Scene(S, _with_grout, SOME, seed=2),
    "bores that return nothing": Scene(S, _as_is, ALL, noise=lambda noise: replace(noise, wall_loss=1.0), seed=4),
    "bores biased along the ray, each its own": Scene(
        S, _as_is, ALL, noise=lambda noise: replace(noise, wall_bias_own=0.8), seed=2
    ),
    "bores that appear beside their place": Scene(S, _with_shifted_walls, ALL, bound_mm=0.5, seed=3),
    "foot with a plank, a box and a hose": Scene(S, _foot_with_things, (7,), reach_mm=180.0, seed=3),
    "foot with twice the noise": Scene(S, _as_is, ALL, noise=_noisy, seed=5),
    "foot with half of its points": Scene(S, _as_is, ALL, noise=_sparse, seed=5),
    "field foot at 1.8 m": Scene(S, _as_is, ALL, setting=FIELD, distance=1800.0, seed=3),
    "field foot 8 degrees off the normal": Scene(S, _as_is, ALL, setting=FIELD, pose=_oblique(1.0), seed=3),
    "field foot larger than the view": Scene(
        S, _as_is, (), (0, 1, 2, 3, 9, 10, 11), OUTSIDE, setting=FIELD, pose=_too_near, reach_mm=400.0
    ),
    "bars whose tops are rusty in part": Scene(
        R, _some(lambda b, k: replace(b, rust=0.3, rust_direction=TURNS[k]), *SOME), SOME, seed=4
    ),
    "bars with a piece of the top broken off": Scene(
        R, _some(lambda b, k: replace(b, missing_top=6.0), 1, 5), (1, 5), bound_mm=0.55, seed=5
    ),
    "bars with a burr on one side": Scene(
        R, _some(lambda b, k: replace(b, burr=1.0, burr_direction=TURNS[k]), *SOME), SOME, bound_mm=0.5, seed=3
    ),
    "bars cut at 15 degrees": Scene(
        R, _some(lambda b, k: replace(b, slant=_towards(TURNS[k], np.tan(np.radians(15.0)))), *SOME), SOME, seed=4
    ),
    "bars that lean by 3 degrees": Scene(R, _some(_leaning, *SOME), SOME, seed=2),
    "bars bent by 10 mm": Scene(R, _some(_bent, *SOME), SOME),
    "a bar that hides a part of another": Scene(R, _one_before_another, (6,), pose=_square_above, seed=3),
    "bars with a board, a box and a hose": Scene(R, _bars_with_things, reach_mm=170.0, seed=5),
    "bars with twice the noise": Scene(R, _as_is, ALL, noise=_noisy, seed=5),
    "bars with half of their points": Scene(R, _as_is, ALL, noise=_sparse, seed=5),
    "field bars at 1.8 m": Scene(R, _as_is, ALL, setting=FIELD, distance=1800.0, bound_mm=0.5),
    "field bars 8 degrees off the normal": Scene(R, _as_is, ALL, setting=FIELD, pose=_oblique(-1.0), seed=3),
}
