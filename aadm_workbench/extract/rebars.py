"""Centres of connecting rebars in a scan of their tops.

The steps: find the floor and with it the bars' vertical, find upright discs of the expected size, fit a
plane to each top (tops differ by centimetres: no common plane), and fit the outlines of all tops and the
visible sides of all bars together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.extract.around import Neighbourhood, points_around, with_places
from aadm_workbench.extract.bracket import Outlines, crossings, outlined
from aadm_workbench.extract.circle import AGREES_MM, agreeing_share, outline, settled_centre
from aadm_workbench.extract.edge_law import BracketLaw, RimLaw, best_circles
from aadm_workbench.extract.found_point import found_point
from aadm_workbench.extract.plane import in_plane
from aadm_workbench.extract.pooled import PooledFit, Priors, Rims, Walls, fit_pooled, owners_of
from aadm_workbench.extract.sample import Thinned, thinned
from aadm_workbench.extract.tops import Standing, find_standing, standing_along, top_plane
from aadm_workbench.model import Array, AssemblyPoint, Extraction, Kind, Plane, Scan

_SAMPLE = 130_000
_REACH_MM = 14.0
_SIDE_DEPTH_MM = (0.8, 60.0)
_START_DEPTH_MM = 15.0
_SIDE_BAND_MM = (-1.2, 1.8)  # about the nominal radius: ribs stand out
_SIDE_POINTS_MAX = 600
_RADIUS_MISFIT = 0.15
_GOES_ON_SHARE = 0.3
_SOUND_SHARE = 0.55
_SHAPE_U_PITCHES = 0.1, 0.3  # what ribs leave of the departure from a circle: edge held from both sides, or from one
_USUAL_SPOILT, _SPOILT_U_MM = 0.13, 1.5
_BEYOND_TAIL_MM, _FLYING = 1.2, 0.05
_FOREIGN = 0.3  # share of outline points that are ribs
_BAR_PRIORS = Priors(
    lean=0.005, own_radius=0.02, own_push=1e-3, push=1e-3, radius=0.06, wall_to_edge=0.02, rim_to_beyond=0.03
)
_TURNING_PRIORS = replace(_BAR_PRIORS, lean=0.1)
_TURNS = 3


@dataclass(frozen=True, eq=False)
class Top:
    """What one bar shows, in plan axes whose z is the bars' vertical, mm: outline of its top, and its side."""

    centre: Array
    plane: Plane
    outlines: Outlines
    side_xy: Array
    side_depth: Array
    coverage: float
    pitch_mm: float


def extract_rebars(scan: Scan, diameter_mm: float, rng: np.random.Generator, places: Array | None = None) -> Extraction:
    """Centres of the tops of all bars of one diameter.

    Parameters
    ----------
    scan
        Organised or not; points in mm, scan frame.
    diameter_mm
        Nominal diameter of the bars.
    rng
        Draws the thinned sample and the plane hypotheses.
    places
        (k, 3) mm, scan frame: where else to look for a bar that the search did not find.
    """
    sample = thinned(scan, _SAMPLE, rng)
    standing = find_standing(sample, diameter_mm / 2, scan.viewpoint, rng)
    if standing is not None and standing.floor is None:
        standing = _turned_to_the_bars(scan, sample, standing, diameter_mm, rng)
    if standing is None:
        return _nothing(f"the scan shows no upright bar of {diameter_mm:g} mm")
    level = Plane(standing.vertical, standing.level_mm)
    tops, fit = _fitted(scan, sample, standing, places, diameter_mm, _BAR_PRIORS, rng)
    if fit is None:
        return _nothing(f"no bar of {diameter_mm:g} mm has a top that could be measured")
    return _extraction(tops, fit, standing, level, diameter_mm)


def _turned_to_the_bars(
    scan: Scan, sample: Thinned, standing: Standing, diameter_mm: float, rng: np.random.Generator
) -> Standing | None:
    """Without a floor the vertical is the bars' own: seen along a first guess, it comes from their sides."""
    for _ in range(_TURNS):
        tops, fit = _fitted(scan, sample, standing, None, diameter_mm, _TURNING_PRIORS, rng)
        if fit is None:
            return standing
        level = Plane(standing.vertical, standing.level_mm)
        vertical = _mean_axis(tuple(_point(top, fit, k, level) for k, top in enumerate(tops)))
        turned = standing_along(sample, vertical, diameter_mm / 2)
        if turned is None:
            return standing
        standing = turned
    return standing


def _fitted(
    scan: Scan,
    sample: Thinned,
    standing: Standing,
    places: Array | None,
    diameter_mm: float,
    priors: Priors,
    rng: np.random.Generator,
) -> tuple[list[Top], PooledFit | None]:
    """What the bars show along one vertical, and the fit to it; no fit where no top was found."""
    level = Plane(standing.vertical, standing.level_mm)
    centres = standing.centres
    if places is not None and len(places):
        centres = with_places(centres, in_plane(places, level)[:, :2], diameter_mm / 2)
    tops = _tops(scan, sample, level, centres, diameter_mm, rng)
    if not tops:
        return [], None
    pitch_mm = float(np.median([top.pitch_mm for top in tops]))
    laws = (
        RimLaw(pitch_mm, _BEYOND_TAIL_MM, _FLYING, softness=0.08),
        RimLaw(pitch_mm, 1.2 * pitch_mm, _FOREIGN, softness=0.08),
        BracketLaw(0.08, 0.8),
    )
    start, radius_mm = best_circles(
        [top.outlines for top in tops],
        [top.side_xy[top.side_depth < _START_DEPTH_MM] for top in tops],
        np.array([top.centre for top in tops]),
        diameter_mm / 2,
        laws,
    )
    return tops, fit_pooled(*_evidence(tops, *laws), start, radius_mm, priors)


def _nothing(reason: str) -> Extraction:
    return Extraction(Kind.REBAR, "refined", (), None, None, reason=reason)


def _tops(
    scan: Scan, sample: Thinned, level: Plane, centres: Array, diameter_mm: float, rng: np.random.Generator
) -> list[Top]:
    parts = points_around(scan, sample, level, centres, diameter_mm / 2 + _REACH_MM, find_borne=True)
    eye = None if scan.viewpoint is None else in_plane(scan.viewpoint[None], level)[0]
    tops = [_top(part, centre, diameter_mm / 2, eye, rng) for part, centre in zip(parts, centres, strict=True)]
    return [top for top in tops if top is not None]


def _top(
    around: Neighbourhood, centre: Array, radius_mm: float, eye: Array | None, rng: np.random.Generator
) -> Top | None:
    local, shift = around.points, np.array([*centre, 0.0])
    plane = top_plane(local - shift, radius_mm, rng)
    if plane is None:
        return None
    plane = Plane(plane.normal, plane.offset + float(plane.normal @ shift), plane.residual_mm)
    height = np.asarray(plane.height(local), np.float64)
    band_mm = max(4.0 * plane.residual_mm, 0.3)
    on_top = np.abs(height) < band_mm
    xy = local[:, :2]
    pitch_mm = float(np.sqrt(np.pi * radius_mm**2 / max(int(on_top.sum()), 1)))
    bins = int(np.clip(2 * np.pi * radius_mm / pitch_mm, 24, 720))
    zone_mm = 0.3 * radius_mm, radius_mm + 3.0
    centre = settled_centre(xy[on_top], centre, radius_mm, bins, zone_mm, innermost=False)
    radius = np.hypot(*(xy - centre).T)
    if _goes_on(radius[on_top], radius_mm):
        return None
    rim_xy = xy[on_top & (radius < radius_mm + 2.5)]
    rim = outline(rim_xy, centre, bins, innermost=False)
    if rim.coverage < 0.5:
        return None
    passed = np.empty((0, 2))
    if eye is not None:
        passed = crossings(local[around.borne & (height < -band_mm)], eye, plane)[:, :2]
        passed = passed[np.hypot(*(passed - centre).T) > 0.75 * radius_mm]
    outlines = outlined(rim_xy, passed, centre, np.ones(bins, bool), hole=False)
    in_band = (radius - radius_mm > _SIDE_BAND_MM[0]) & (radius - radius_mm < _SIDE_BAND_MM[1])
    side = np.flatnonzero(in_band & (-height > _SIDE_DEPTH_MM[0]) & (-height < _SIDE_DEPTH_MM[1]))
    side = side[:: max(1, len(side) // _SIDE_POINTS_MAX + 1)]
    return Top(centre, plane, outlines, xy[side], -height[side], rim.coverage, pitch_mm)


def _goes_on(radius: Array, radius_mm: float) -> bool:
    """Whether the surface goes on around where a top should end: a floor or a plate, no bar."""
    disc = (radius < 0.9 * radius_mm).sum() / 0.9**2
    around = ((radius > 1.25 * radius_mm) & (radius < 1.5 * radius_mm)).sum() / (1.5**2 - 1.25**2)
    return bool(around > _GOES_ON_SHARE * disc)


def _evidence(tops: list[Top], beyond_law: RimLaw, rim_law: RimLaw, side_law: BracketLaw) -> tuple[Rims, Rims, Walls]:
    rims = Rims(
        np.concatenate([t.outlines.rim for t in tops]), owners_of([len(t.outlines.rim) for t in tops]), -1.0, rim_law
    )
    beyond = Rims(
        np.concatenate([t.outlines.beyond for t in tops]),
        owners_of([len(t.outlines.beyond) for t in tops]),
        1.0,
        beyond_law,
    )
    side_owner = owners_of([len(t.side_xy) for t in tops])
    side_xy = np.concatenate([t.side_xy for t in tops])
    depth = np.concatenate([t.side_depth for t in tops])
    walls = Walls(side_xy, depth, np.zeros_like(side_xy), side_owner, side_law)
    return beyond, rims, walls


def _extraction(tops: list[Top], fit: PooledFit, standing: Standing, level: Plane, diameter_mm: float) -> Extraction:
    agree = [
        agreeing_share(t.outlines.rim, fit.centre[k], fit.outline_radius[k], max(AGREES_MM, 2.0 * t.pitch_mm))
        for k, t in enumerate(tops)
    ]
    right = np.abs(2 * fit.outline_radius / diameter_mm - 1.0) < _RADIUS_MISFIT
    sound = np.flatnonzero(right & (np.array(agree) > _SOUND_SHARE))
    points = tuple(_point(tops[k], fit, k, level) for k in sound.tolist())
    if not points:
        return _nothing(f"what stands in the scan has no round top of {diameter_mm:g} mm")
    vertical, source = standing.vertical, "floor"
    if standing.floor is None:
        vertical, source = _mean_axis(points), "bar axes"
    exposed = tuple(_exposed(point, standing.floor) for point in points)
    tops_level = Plane(vertical, float(np.median([vertical @ point.centre for point in points])))
    quality = {
        "point_pitch_mm": float(np.median([t.pitch_mm for t in tops])),
        "plane_residual_mm": float(np.median([t.plane.residual_mm for t in tops])),
        "edge_coverage": float(np.mean([t.coverage for t in tops])),
        "edge_residual_mm": fit.edge_mm,
        "wall_residual_mm": fit.wall_mm,
        "wall_points": int(fit.wall_count.sum()),
    }
    return Extraction(Kind.REBAR, "refined", points, tops_level, vertical, source, exposed, quality)


def _point(top: Top, fit: PooledFit, k: int, level: Plane) -> AssemblyPoint:
    x, y = fit.centre[k]
    z = (top.plane.offset - top.plane.normal[0] * x - top.plane.normal[1] * y) / top.plane.normal[2]
    shape_u_mm = _shape_u_mm(top, fit.centre[k], fit.outline_radius[k])
    return found_point(
        Kind.REBAR,
        level,
        np.array([x, y, z]),
        np.array([-fit.lean[k, 0], -fit.lean[k, 1], 1.0]),
        fit.covariance[k] + np.eye(2) * shape_u_mm**2,
        top.plane.residual_mm,
        2 * float(fit.outline_radius[k]),
        f"{fit.edge_count[k]} edge and {fit.wall_count[k]} side points",
    )


def _shape_u_mm(top: Top, centre: Array, radius_mm: float) -> float:
    """What a top's departure from a disc may hide: ribs, and more where a burr stands out or a piece is missing."""
    held = len(top.outlines.beyond) > 0.5 * len(top.outlines.rim)
    behind = radius_mm - np.hypot(*(top.outlines.rim - centre).T)
    spoilt = max(float((behind < -0.3).mean()) - _USUAL_SPOILT, 0.0) + 0.5 * float((behind > 1.0).mean())
    spoilt += 0.5 * (1.0 - top.coverage)
    return float(np.hypot(_SHAPE_U_PITCHES[0 if held else 1] * top.pitch_mm, _SPOILT_U_MM * spoilt))


def _mean_axis(points: tuple[AssemblyPoint, ...]) -> Array:
    """Robust mean of the bar axes: their median, made a unit vector."""
    middle = np.median([point.axis for point in points], axis=0)
    return np.asarray(middle / np.linalg.norm(middle))


def _exposed(point: AssemblyPoint, floor: Plane | None) -> float | None:
    """Length of the bar from the floor to its top along its own axis."""
    if floor is None:
        return None
    return float(floor.height(point.centre) / max(float(point.axis @ floor.normal), 0.5))
