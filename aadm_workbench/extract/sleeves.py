"""Sleeve centres in the scan of a column foot.

The steps: find the foot face, find round holes of the expected size in it, take all points around each
hole, and fit bores and mouth edges of all sleeves together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.extract.around import points_around, with_places
from aadm_workbench.extract.bracket import Outlines, outlined
from aadm_workbench.extract.circle import AGREES_MM, bins_of, outline, settled_centre
from aadm_workbench.extract.edge_law import BracketLaw, RimLaw
from aadm_workbench.extract.found_point import found_point
from aadm_workbench.extract.holes import find_discs, rastered
from aadm_workbench.extract.plane import facing, find_planes, from_plane, in_plane, near, turned_over
from aadm_workbench.extract.pooled import PooledFit, Priors, Rims, Walls, fit_pooled, owners_of
from aadm_workbench.extract.sample import Thinned, point_pitch_mm, thinned
from aadm_workbench.model import Array, AssemblyPoint, BoolArray, Extraction, Kind, Plane, Scan

_SAMPLE = 90_000
_FACE_BAND_MM = 1.5
_REACH_MM = 4.0  # beyond the nominal radius: how far around a mouth points are taken
_RIM_DEPTH_MM = 2.5  # a chamfer ends less far behind the face
_WALL_DEPTH_MM = (2.0, 120.0)
_WALL_BAND_MM = 2.0  # about the nominal radius
_WALL_POINTS_MAX, _WALL_COUNT_MIN = 350, 20
_SECTORS, _OPEN_SECTORS, _CLOSED_SHARE = 12, 4, 0.15
_OPPOSITE_COSINE = 0.3
_WALL_LAW = BracketLaw(0.08, 0.4)  # many points lie on ribs, which only ever stand inwards
_TAIL_PITCHES, _TAIL_TO_KEPT, _USUALLY_KEPT = 6.0, 1.5, 0.7
_SIDES, _SIDE_COUNT_MIN = 6, 10
_RIM_TO_WALL_PITCHES = 0.05
_WEAR_PITCHES = 0.05  # how far rims may be worn away unnoticed; it shifts centres along the view
_FOREIGN = 0.01  # share of outline points that are flying pixels or dirt
_SOUND_SHARE = 0.3
_RADIUS_MISFIT = 0.08  # relative: a hole this much larger or smaller than nominal is no sleeve


@dataclass(frozen=True, eq=False)
class Mouth:
    """What one mouth shows, in the face's axes: rim edge points and wall points, all in mm."""

    centre: Array
    outlines: Outlines
    wall_xy: Array
    wall_depth: Array
    wall_slope: Array
    coverage: float
    bins: int


def extract_sleeves(
    scan: Scan, diameter_mm: float, rng: np.random.Generator, places: Array | None = None
) -> Extraction:
    """Centres of all sleeves of one diameter in the scan of a foot.

    Parameters
    ----------
    scan
        Organised or not; points in mm, scan frame.
    diameter_mm
        Nominal inner diameter at the mouth.
    rng
        Draws the thinned sample and the plane hypotheses.
    places
        (k, 3) mm, scan frame: where else to look for a sleeve that the search did not find.

    Returns
    -------
    Extraction
        With an empty ``points`` and a ``reason`` where no face or no hole was found.
    """
    sample = thinned(scan, _SAMPLE, rng)
    found = _face_with_holes(scan, sample, diameter_mm / 2, rng)
    if found is None:
        return Extraction(Kind.SLEEVE, "refined", (), None, None, reason="no flat foot face was found in the scan")
    face, centres, pitch_mm = found
    if places is not None and len(places):
        centres = with_places(centres, in_plane(places, face)[:, :2], diameter_mm / 2)
    if len(centres) == 0:
        reason = f"the face shows no round hole of {diameter_mm:g} mm"
        return Extraction(Kind.SLEEVE, "refined", (), face, -face.normal, reason=reason)
    around = points_around(scan, sample, face, centres, diameter_mm / 2 + _REACH_MM)
    parts = [neighbourhood.points for neighbourhood in around]
    if scan.viewpoint is None:
        face, parts, centres = _facing_away_from_walls(face, parts, centres)
    eye = None if scan.viewpoint is None else in_plane(scan.viewpoint[None], face)[0]
    mouths = [_mouth(part, centre, diameter_mm / 2, pitch_mm, eye) for part, centre in zip(parts, centres, strict=True)]
    kept = [mouth for mouth in mouths if mouth is not None]
    return _measured(kept, face, diameter_mm, pitch_mm)


def _face_with_holes(
    scan: Scan, sample: Thinned, radius_mm: float, rng: np.random.Generator
) -> tuple[Plane, Array, float] | None:
    """The plane with most holes of the right size among the largest ones."""
    best: tuple[Plane, Array, float] | None = None
    for plane in find_planes(sample.points, rng, 3):
        face = plane if scan.viewpoint is None else facing(plane, scan.viewpoint)
        local = in_plane(sample.points[near(sample.points, face, _FACE_BAND_MM)], face)[:, :2]
        pitch_mm = point_pitch_mm(sample, local)
        spacing_mm = pitch_mm / np.sqrt(sample.share)
        raster = rastered(local, max(radius_mm / 12, 1.3 * spacing_mm), 3 * radius_mm)
        centres, _ = find_discs(raster, radius_mm, holes=True)
        if best is None or len(centres) > len(best[1]):
            best = (face, centres, pitch_mm)
        if len(centres) >= 3:
            break
    return best


def _facing_away_from_walls(face: Plane, parts: list[Array], centres: Array) -> tuple[Plane, list[Array], Array]:
    """Without a viewpoint the side of the normal comes from the walls: they lie behind the face."""
    heights = np.concatenate([part[:, 2] for part in parts])
    before = int((heights > _WALL_DEPTH_MM[0]).sum())
    behind = int((heights < -_WALL_DEPTH_MM[0]).sum())
    if behind >= before:
        return face, parts, centres
    over = turned_over(face)
    lifted = from_plane(np.column_stack([centres, np.zeros(len(centres))]), face)
    turned = [in_plane(from_plane(part, face), over) for part in parts]
    return over, turned, in_plane(lifted, over)[:, :2]


def _mouth(local: Array, centre: Array, radius_mm: float, pitch_mm: float, eye: Array | None) -> Mouth | None:
    """Split the points (n, 3) around a mouth (x, y, height) into its rim edge and its wall."""
    xy, height = local[:, :2], local[:, 2]
    bins = int(np.clip(2 * np.pi * radius_mm / pitch_mm, 24, 720))
    rim = (height > -_RIM_DEPTH_MM) & (height < _FACE_BAND_MM)
    if rim.sum() < 12:
        return None
    zone_mm = 0.5 * radius_mm, radius_mm + _REACH_MM
    centre = settled_centre(xy[rim], centre, radius_mm, bins, zone_mm, innermost=True)
    if _closed(xy[height > -_RIM_DEPTH_MM] - centre, radius_mm, pitch_mm):
        return None
    radius = np.hypot(*(xy - centre).T)
    close = np.abs(radius - radius_mm) < _WALL_BAND_MM + 1.0
    ring = outline(xy[rim & close], centre, bins, innermost=True)
    if ring.coverage < 0.35:
        return None
    on_wall = np.abs(radius - radius_mm) < _WALL_BAND_MM
    upper = on_wall & (height < -1.0) & (height > -12.0)
    open_bins = ~_widened(np.isin(np.arange(bins), bins_of((xy - centre)[upper], bins)))
    outlines = outlined(xy[rim & close], np.empty((0, 2)), centre, open_bins, hole=True)
    wall = np.flatnonzero(on_wall & (height < -_WALL_DEPTH_MM[0]) & (height > -_WALL_DEPTH_MM[1]))
    wall = wall[_opposite(xy[wall] - centre, _slope(local[wall], eye))]
    wall = wall[:: max(1, len(wall) // _WALL_POINTS_MAX + 1)]
    slope = _slope(local[wall], eye)
    return Mouth(centre, outlines, xy[wall], -height[wall], slope, ring.coverage, bins)


def _closed(rim_xy: Array, radius_mm: float, pitch_mm: float) -> bool:
    """Whether the face goes on where the mouth should be: plugged, covered, or no sleeve at all.

    A tape over half of a mouth leaves whole sectors of it open; a plug leaves none.
    """
    radius = np.hypot(*rim_xy.T)
    inside = rim_xy[(radius > 0.2 * radius_mm) & (radius < 0.75 * radius_mm)]
    expected = np.pi * (0.75**2 - 0.2**2) * (radius_mm / pitch_mm) ** 2 / _SECTORS
    filled = np.bincount(bins_of(inside, _SECTORS), minlength=_SECTORS) > _CLOSED_SHARE * expected
    return int(filled.sum()) > _SECTORS - _OPEN_SECTORS


def _widened(marked: BoolArray, reach: int = 2) -> BoolArray:
    wide = marked.copy()
    for shift in range(1, reach + 1):
        wide |= np.roll(marked, shift) | np.roll(marked, -shift)
    return wide


def _slope(local: Array, eye: Array | None) -> Array:
    """How far the line of sight moves in the plan per mm of depth (n, 2); zero where the viewpoint is unknown."""
    if eye is None:
        return np.zeros((len(local), 2))
    ray = local - eye
    return np.asarray(ray[:, :2] / np.abs(ray[:, 2:]))


def _opposite(about: Array, slope: Array) -> BoolArray:
    """Wall points (n, 2) that the camera looks at: towards the ends of what it sees, surfaces mix in its pixels."""
    if not slope.any():
        return np.ones(len(about), bool)
    along = np.einsum("ij,ij->i", about, slope)
    return np.asarray(along > _OPPOSITE_COSINE * np.hypot(*about.T) * np.hypot(*slope.T))


def _measured(mouths: list[Mouth], face: Plane, diameter_mm: float, pitch_mm: float) -> Extraction:
    if not mouths:
        reason = f"no hole of {diameter_mm:g} mm in the face could be measured"
        return Extraction(Kind.SLEEVE, "refined", (), face, -face.normal, reason=reason)
    fit = _fit(mouths, diameter_mm, pitch_mm)
    sound = (np.abs(fit.radius / (diameter_mm / 2) - 1.0) < _RADIUS_MISFIT) & _are_round(mouths, fit, pitch_mm)
    points = tuple(_point(fit, k, face, pitch_mm) for k in np.flatnonzero(sound).tolist())
    if not points:
        reason = f"the openings in the face are no round mouths of {diameter_mm:g} mm"
        return Extraction(Kind.SLEEVE, "refined", (), face, -face.normal, reason=reason)
    quality = {
        "point_pitch_mm": pitch_mm,
        "plane_residual_mm": face.residual_mm,
        "edge_coverage": float(np.mean([m.coverage for m in mouths])),
        "edge_residual_mm": fit.edge_mm,
        "wall_residual_mm": fit.wall_mm,
        "wall_points": int(fit.wall_count.sum()),
    }
    return Extraction(Kind.SLEEVE, "refined", points, face, -face.normal, "foot face", quality=quality)


def _fit(mouths: list[Mouth], diameter_mm: float, pitch_mm: float) -> PooledFit:
    """Fit all mouths together, then again with what the first fit tells of the camera.

    At depth steps a camera keeps only a share of the pixels, and not the same share on every side of a mouth: the
    law of the rims follows the share that it keeps. Rims stand on the bore's own radius: a camera that takes a
    whole ring of pixels from every depth step shifts centres along the view by about half of that ring.
    """
    law = RimLaw(pitch_mm, _TAIL_PITCHES * pitch_mm, _FOREIGN)
    beyond, rims, walls = _evidence(mouths, law)
    start = np.array([mouth.centre for mouth in mouths])
    turned = _turned_from_camera(rims, start, mouths)
    priors = Priors(rim_to_wall=_RIM_TO_WALL_PITCHES * pitch_mm)
    fit = fit_pooled(beyond, rims, walls, start, diameter_mm / 2, priors)
    kept = replace(rims, law=replace(law, tail_mm=_tails(rims, fit, turned, pitch_mm)))
    return fit_pooled(beyond, kept, walls, fit.centre, diameter_mm / 2, priors)


def _are_round(mouths: list[Mouth], fit: PooledFit, pitch_mm: float) -> BoolArray:
    """Whether enough (k,) of what each outline shows lies on its circle: a gap between things is no mouth."""
    shares = []
    for mouth, centre, radius in zip(mouths, fit.centre, fit.radius, strict=True):
        behind = np.hypot(*(mouth.outlines.rim - centre).T) - radius
        agrees = int(((behind > -AGREES_MM / 2) & (behind < max(AGREES_MM, 2.5 * pitch_mm))).sum())
        on_wall = mouth.bins - len(mouth.outlines.rim) if len(mouth.wall_xy) >= _WALL_COUNT_MIN else 0
        shares.append((agrees + on_wall) / mouth.bins)
    return np.array(shares) > _SOUND_SHARE


def _turned_from_camera(rims: Rims, centres: Array, mouths: list[Mouth]) -> Array:
    """Angle (n,) rad, 0..pi, between each rim point and the side on which its mouth's wall shows.

    That side is away from the camera's foot point: there the face runs on into the wall, opposite it ends in a
    depth step. A mouth that shows no wall is all step: pi.
    """
    sides = [mouth.wall_xy.mean(axis=0) - mouth.centre if len(mouth.wall_xy) else np.zeros(2) for mouth in mouths]
    away = np.array([np.arctan2(side[1], side[0]) for side in sides])
    shown = np.array([len(mouth.wall_xy) >= _WALL_COUNT_MIN for mouth in mouths])
    about = rims.xy - centres[rims.owner]
    turn = np.abs(np.mod(np.arctan2(about[:, 1], about[:, 0]) - away[rims.owner] + np.pi, 2 * np.pi) - np.pi)
    return np.where(shown[rims.owner], turn, np.pi)


def _tails(rims: Rims, fit: PooledFit, turned: Array, pitch_mm: float) -> Array:
    """Length (n,) mm over which the rim points of each side thin out: the longer, the fewer pixels are kept there."""
    about = rims.xy - fit.centre[rims.owner]
    inset = np.hypot(about[:, 0], about[:, 1]) - fit.radius[rims.owner]
    side = np.minimum((turned / np.pi * _SIDES).astype(np.int64), _SIDES - 1)
    count = np.bincount(side, minlength=_SIDES)
    first = np.bincount(side, inset < pitch_mm, minlength=_SIDES)
    kept = np.where(count >= _SIDE_COUNT_MIN, first / np.maximum(count, 1), _USUALLY_KEPT)
    return np.asarray(_TAIL_TO_KEPT * pitch_mm / np.clip(kept, 0.15, 1.2))[side]


def _evidence(mouths: list[Mouth], law: RimLaw) -> tuple[Rims, Rims, Walls]:
    rims = Rims(
        np.concatenate([m.outlines.rim for m in mouths]), owners_of([len(m.outlines.rim) for m in mouths]), 1.0, law
    )
    nothing = Rims(np.empty((0, 2)), np.empty(0, np.int64), -1.0, law)  # inside a sleeve it is dark
    walls = Walls(
        np.concatenate([m.wall_xy for m in mouths]),
        np.concatenate([m.wall_depth for m in mouths]),
        np.concatenate([m.wall_slope for m in mouths]),
        owners_of([len(m.wall_xy) for m in mouths]),
        _WALL_LAW,
        side=1.0,
    )
    return nothing, rims, walls


def _point(fit: PooledFit, k: int, face: Plane, pitch_mm: float) -> AssemblyPoint:
    return found_point(
        Kind.SLEEVE,
        face,
        np.array([*fit.centre[k], 0.0]),
        # depth runs against the normal: an axis that gains `lean` per mm of depth points into the column
        np.array([*fit.lean[k], -1.0]),
        fit.covariance[k] + np.eye(2) * (_WEAR_PITCHES * pitch_mm) ** 2,
        face.residual_mm,
        2 * float(fit.radius[k]),
        f"{fit.wall_count[k]} wall and {fit.edge_count[k]} edge points at {pitch_mm:.2f} mm",
    )
