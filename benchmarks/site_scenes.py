"""Random columns as a site and its cameras leave them, cheap enough for hundreds: small patterns, cropped images."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from aadm_workbench.design.recognise.pattern import inline_design, label_order
from aadm_workbench.model import Array, Camera, ColumnDesign
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.filters import NO_FILTERS, Filters, filtered
from aadm_workbench.twin.finite_pixel import FinitePixel
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Foot, ring
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import Setting, random_bars, random_foot, random_pose
from aadm_workbench.twin.site import left_by_site
from aadm_workbench.twin.slips import NO_SLIP, Slip, seen_with, told_scan

SIZES_MM = (
    (14.0, 30.0),
    (16.0, 32.0),
    (18.0, 26.0),
    (20.0, 36.0),
    (22.0, 38.0),
    (25.0, 42.0),
    (28.0, 46.0),
    (32.0, 50.0),
)
"""Bars and the bores of sleeves that are made for them."""

RARE_SIZES_MM = ((12.0, 28.0), (12.0, 32.0), (36.0, 58.0), (40.0, 66.0))
"""The thinnest and the thickest that are spliced so."""

_SPREAD_MM, _SEEN_DEPTH_MM, _MARGIN_MM = 0.5, 130.0, 34.0
_LARGEST_HALF_MM = 150.0


@dataclass(frozen=True)
class Pattern(Setting):
    """A setting whose points are named one by one."""

    places: tuple[tuple[float, float], ...] = ()

    def centres(self) -> Array:
        """Design centres (n, 2), in the order of their labels."""
        centres = np.array(self.places)
        return np.asarray(centres[label_order(centres)])


@dataclass(frozen=True)
class Scenario:
    """What is unlike a sound column: what the site did, filters of the camera, slips of the job; ``keyed`` patterns.

    ``other``: the foot is that of another column, which the job has too. ``rare``: the thinnest and the thickest bars,
    in the rows of walls, in double rows and in plum-blossom order.
    """

    site: tuple[str, ...] = ()
    filters: Callable[[np.random.Generator], Filters] = lambda rng: NO_FILTERS
    slip: Callable[[np.random.Generator], Slip] = lambda rng: NO_SLIP
    keyed: bool = False
    other: bool = False
    rare: bool = False


@dataclass(frozen=True, eq=False)
class Column:
    """One column as designed, as built and as scanned; ``others`` are further columns of its job."""

    setting: Pattern
    design: ColumnDesign
    foot: Foot
    bars: BarGroup
    sleeves: TrueScan
    rebars: TrueScan
    slip: Slip
    others: tuple[ColumnDesign, ...] = ()


def random_pattern(rng: np.random.Generator, *, keyed: bool) -> Pattern:
    """3 to 16 places on a ring, or in one row or two; a quarter of the rings lack one, and all that are keyed."""
    bar_mm, sleeve_mm = SIZES_MM[rng.integers(len(SIZES_MM))]
    per_side = int(rng.integers(3 if keyed else 2, 6))
    step_mm = min(float(rng.uniform(2.0, 2.8)) * sleeve_mm, 2 * _LARGEST_HALF_MM / (per_side - 1))
    wide = step_mm * (per_side - 1) / 2
    rows = 0 if keyed or per_side < 3 else int(rng.choice([0, 0, 0, 0, 1, 2]))
    if rows:
        places = np.array([(x, y * step_mm) for x in np.linspace(-wide, wide, per_side) for y in range(rows)])
    else:
        places = ring(wide, wide * float(rng.choice([1.0, rng.uniform(0.8, 1.0)])), per_side)
    if not rows and per_side > 2 and (keyed or rng.random() < 0.25):
        places = np.delete(places, _left_out(places, rng, keyed=keyed), axis=0)
    return _pattern(places, sleeve_mm, bar_mm, per_side, rng)


def rare_pattern(rng: np.random.Generator) -> Pattern:
    """A row of a wall, a double row, or two rows in plum-blossom order, of the thinnest or the thickest bars."""
    bar_mm, sleeve_mm = RARE_SIZES_MM[rng.integers(len(RARE_SIZES_MM))]
    count = int(rng.integers(3, 6))
    step_mm = min(float(rng.uniform(2.0, 3.0)) * sleeve_mm, 2 * _LARGEST_HALF_MM / count)
    apart_mm = float(rng.uniform(1.6, 2.5)) * sleeve_mm
    row = np.array([(k * step_mm, 0.0) for k in range(count)])
    beside = row + np.array([0.0, apart_mm])
    staggered = beside[:-1] + np.array([step_mm / 2.0, 0.0])
    order = rng.integers(3)
    places = row if order == 0 else np.vstack([row, beside if order == 1 else staggered])
    return _pattern(places, sleeve_mm, bar_mm, count, rng)


def _pattern(places: Array, sleeve_mm: float, bar_mm: float, per_side: int, rng: np.random.Generator) -> Pattern:
    places = places - places.mean(axis=0)
    half = float(np.abs(places).max())
    exposed = 8.0 * bar_mm
    return Pattern(
        "site",
        2 * half + 4 * sleeve_mm,
        half,
        per_side,
        sleeve_mm,
        bar_mm,
        bar_mm * float(rng.uniform(0.955, 1.0)),
        exposed,
        float(rng.uniform(600.0, 2000.0)),
        tuple((float(x), float(y)) for x, y in places),
    )


def _left_out(places: Array, rng: np.random.Generator, *, keyed: bool) -> int:
    """A place that is not there; of a keyed ring none in the middle, where a mirror would not show it."""
    beside = np.flatnonzero(np.abs(places[:, 0]) > 1.0)
    return int(rng.choice(beside)) if keyed else int(rng.integers(1, len(places)))


def random_camera(rng: np.random.Generator) -> CameraNoise:
    """A camera of one to four times the usual noise, on concrete and steel that return more or less."""
    noise = CameraNoise.drawn(rng)
    noise = replace(
        noise,
        depth_at_1m=noise.depth_at_1m * float(4.0 ** rng.uniform()),
        random_loss=float(rng.choice([0.004, 0.02, 0.1])),
        step_loss=float(rng.uniform(0.3, 0.8)),
        warp_period=PRO_M.width / 3,
    )
    if rng.random() < 0.3:
        noise = replace(noise, pixel=FinitePixel(slips=float(rng.uniform(0.0, 0.15))), step_loss=0.0, step_fly=0.0)
    return noise


def built_column(scenario: Scenario, number: int, camera: str = "ray") -> Column:
    """The column of a number; the same scenario and number give the same one, filters and slips the same scene.

    ``camera``: ``ray``, or ``fringe`` for fringe projection by path tracing, which takes a minute for each column.
    """
    scene = Scenario(scenario.site, keyed=scenario.keyed, other=scenario.other, rare=scenario.rare)
    rendered = _rendered(scene, number, camera)
    rng = np.random.default_rng([1, number])
    filters, slip = scenario.filters(rng), scenario.slip(rng)
    seen = [
        told_scan(seen_with(replace(scan, depth=filtered(scan.depth, filters)), slip, rng, is_foot=is_foot), slip)
        for scan, is_foot in ((rendered.sleeves, True), (rendered.rebars, False))
    ]
    sleeves, rebars = seen[::-1] if slip.swapped else seen[1:] * 2 if slip.twice else seen
    return replace(rendered, sleeves=sleeves, rebars=rebars, slip=slip)


@lru_cache(maxsize=20)  # filters and slips change what was rendered: a kind's scenes serve the next kind
def _rendered(scenario: Scenario, number: int, camera: str) -> Column:
    words = (*scenario.site, *(name for name in ("keyed", "other", "rare") if getattr(scenario, name)))
    return _render(scenario, np.random.default_rng([zlib.crc32("-".join(words).encode()), number]), camera)


def _render(scenario: Scenario, rng: np.random.Generator, camera: str) -> Column:
    setting = rare_pattern(rng) if scenario.rare else random_pattern(rng, keyed=scenario.keyed)
    foot, bars = random_foot(setting, rng, _SPREAD_MM), random_bars(setting, rng, _SPREAD_MM)
    if scenario.other:
        foot = random_foot(_unlike(setting, rng), rng, _SPREAD_MM)
    foot = replace(foot, sleeves=tuple(replace(s, depth=_SEEN_DEPTH_MM) for s in foot.sleeves))
    foot, bars = left_by_site(scenario.site, foot, bars, rng)
    take = _taken_by(camera, setting, random_camera(rng))
    poses = [random_pose(setting, looking_up, rng) for looking_up in (True, False)]
    sleeves, rebars = (
        take(part, pose, rng, _window(PRO_M, pose, _reach_mm(part)))
        for part, pose in zip((foot, bars), poses, strict=True)
    )
    others = (design_of(_of_foot(setting, foot), "C-2"),) if scenario.other else ()
    return Column(setting, design_of(setting, "C-1"), foot, bars, sleeves, rebars, NO_SLIP, others)


def _taken_by(
    camera: str, setting: Setting, noise: CameraNoise
) -> Callable[[Foot | BarGroup, Array, np.random.Generator, Camera], TrueScan]:
    """What takes a part from a pose, by the window of its image."""
    if camera == "ray":
        return lambda part, pose, rng, window: scan_of(part, pose, noise, rng, window)
    from aadm_workbench.twin.fringe.renderer import mitsuba_ready
    from aadm_workbench.twin.fringe.rig import rig_for
    from aadm_workbench.twin.fringe.shot import FringeCamera, fringe_scan_of

    mitsuba_ready()
    fringe = FringeCamera(rig_for(setting.distance))
    return lambda part, pose, rng, window: fringe_scan_of(part, pose, fringe, rng, window)


def design_of(setting: Setting, name: str) -> ColumnDesign:
    """The design as a job would have it."""
    table = {
        "sleeve_diameter": setting.sleeve_diameter,
        "rebar_diameter": setting.bar_diameter,
        "rebar_outer_diameter": round(setting.bar_core + 2.0 * BarAsBuilt.rib_height, 3),
        "embedded_length": setting.exposed,
        "size": [setting.size, setting.size],
        "centres": setting.centres().tolist(),
    }
    return inline_design(name, table)


def _unlike(setting: Pattern, rng: np.random.Generator) -> Pattern:
    """The same sizes in a pattern that is wider by a fifth to a half."""
    wider = float(rng.uniform(1.2, 1.5))
    return replace(setting, places=tuple((x * wider, y * wider) for x, y in setting.places), size=setting.size * wider)


def _of_foot(setting: Pattern, foot: Foot) -> Pattern:
    return replace(setting, places=tuple((round(s.x), round(s.y)) for s in foot.sleeves))


def _reach_mm(part: Foot | BarGroup) -> float:
    places = part.sleeves if isinstance(part, Foot) else part.bars
    return max(max(abs(place.x), abs(place.y)) for place in places) + _MARGIN_MM


def _window(camera: Camera, T_column_scan: Array, reach_mm: float) -> Camera:
    """The part of a camera's image that shows what lies within a reach of the column's axis at z = 0."""
    T = np.linalg.inv(T_column_scan)
    corners = np.array([[x, y, 0.0] for x in (-reach_mm, reach_mm) for y in (-reach_mm, reach_mm)])
    seen = corners @ T[:3, :3].T + T[:3, 3]
    u, v = camera.fx * seen[:, 0] / seen[:, 2] + camera.cx, camera.fy * seen[:, 1] / seen[:, 2] + camera.cy
    left, right = np.clip([u.min(), u.max()], 0, camera.width).astype(int).tolist()
    top, bottom = np.clip([v.min(), v.max()], 0, camera.height).astype(int).tolist()
    return replace(camera, cx=camera.cx - left, cy=camera.cy - top, width=right - left, height=bottom - top)
