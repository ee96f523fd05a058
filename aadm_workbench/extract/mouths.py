"""What each sleeve's mouth shows: the edge of its rim, and points of its bore."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.circle import (
    AGREES_MM,
    Outlines,
    PlanPoints,
    agreeing_shares,
    bins_for,
    in_rows,
    outlines,
    settled_centres,
    thinned_rows,
)
from aadm_workbench.extract.foot_face import FACE_BAND_MM, RIM_DEPTH_MM, FootFace
from aadm_workbench.extract.patches import Patches
from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray

REACH_MM = 4.0
"""How far around a mouth points are taken, beyond the nominal radius."""

WALL_DEPTH_MM = (2.0, 120.0)
"""Where behind the face a bore is looked for."""

_RIM_ZONE = 0.5  # of the radius
# behind a chamfer, and near enough to the rim that a wall which shows here runs into it (a choice: ±30 % moves
# centres by up to 2.1 u)
_UPPER_WALL_MM = (1.0, 12.0)
_WALL_BAND_MM = 2.0  # about the nominal radius
_WALL_POINTS_MAX = 350  # of a bore, evenly taken: neighbours share their errors, more of them tell little
# a third of a mouth lets light in, so that a tape over half of it does not close it; of a whole face's points; of the
# radius
_SECTORS, _OPEN_SECTORS, _CLOSED_SHARE, _INSIDE = 12, 4, 0.15, (0.2, 0.75)
# farther before the face than its rings; of a mouth's lines of sight: bars hide 0.6 and more, slips of the fringe order
# before unlit walls came to 0.24 and to 0.6 on path-traced scans; then what is lit shows behind the face, which floors
# never have
_BEFORE_MM, _HIDDEN_SHARE, _OPEN_SHARE = 10.0, 0.5, 0.15
_FEWEST_BARS, _BARS_SHARE = 3, 0.4  # each bar hides one piece of a floor and throws a shadow on another
# plugs sit deeper than spalls, and their rims are round: within the pixels over which the points of a rim thin out
_FLOOR_MM, _SPALL_MM, _PLUG_ROUND, _AGREES_PITCHES = 15.0, 5.0, 0.6, 1.5
# a plug is flat within the noise at 2 m, and its edge mixes with the wall over as much; most of what is seen inside a
# bore lies on it; fewer points are strays
_FLOOR_BAND_MM, _FLOOR_SHARE, _FLOOR_POINTS = 2.0, 0.6, 20
_STRIP_PITCHES = 3.0  # of a wall: the pixels at its either side mix it with what is beside, one between is its own
_OPPOSITE_COSINE = 0.3  # 73 degrees to either side of where the camera looks
# of the radius, from where a hole was found to its centre: a mouth that is open by half has its open part's middle 0.42
# of it beside; what moves farther is the edge of something else, seen in part
_MOVED_SHARE = 0.45
# of a circle: half a mouth may be taped, and a part of the rest lost; a choice: ±30 % moves nothing on sound scans
_COVERAGE_MIN = 0.35


@dataclass(frozen=True, eq=False)
class Mouths:
    """Evidence of k mouths, mm, each about its own place ``place`` (k, 2) in the face's axes.

    ``centre`` (k, 2) first centres; ``rims`` the edges of their rims, where they are no crease to a visible wall;
    ``coverage`` (k,) the share of the circle that shows a rim; ``wall_xy`` (k, m, 2), ``wall_depth`` (k, m) and
    ``wall_slope`` (k, m, 2) points of the bores, those that are there ``wall_seen`` (k, m). ``plugged`` (k,): so near
    to the face that no wall shows. ``kept`` are the numbers (k,) of their patches.
    """

    kept: IntArray
    place: Array
    centre: Array
    rims: Outlines
    coverage: Array
    wall_xy: Array
    wall_depth: Array
    wall_slope: Array
    wall_seen: BoolArray
    plugged: BoolArray

    def wall_count(self) -> IntArray:
        """Points of each bore (k,)."""
        return np.asarray(self.wall_seen.sum(axis=1))


def mouths_in(
    patches: Patches,
    places: Array,
    radius_mm: float,
    pitch_mm: float,
    others_mm: tuple[float, ...] = (),
    face: FootFace | None = None,
) -> Mouths:
    """The open mouths of a radius among patches around places (k, 2) mm of the face, but for those of other radii."""
    low_mm, high_mm = (-RIM_DEPTH_MM, FACE_BAND_MM) if face is None else (face.low_mm, face.high_mm)
    bins = bins_for(radius_mm, pitch_mm)
    near = patches.x * patches.x + patches.y * patches.y < (radius_mm + 2 * REACH_MM) ** 2
    front = near & (patches.height > low_mm)
    rim = PlanPoints.of(patches.x, patches.y, np.flatnonzero(front & (patches.height < high_mm)))
    zone_mm = _RIM_ZONE * radius_mm, radius_mm + REACH_MM
    start = np.zeros((len(places), 2))
    centre, other = settled_centres(rim, start, radius_mm, bins, zone_mm, innermost=True, others_mm=others_mm)
    close = rim.where(np.abs(rim.distance(centre) - radius_mm) < _WALL_BAND_MM + 1.0)
    shape = outlines(close, centre, bins, innermost=True)
    solid = front & ~_ghosts(patches, front, high_mm)
    inside = PlanPoints.of(patches.x, patches.y, np.flatnonzero(solid))
    kept = ~other & (shape.coverage >= _COVERAGE_MIN) & ~_closed(inside, centre, radius_mm, pitch_mm)
    kept &= ~_is_shallow(patches, solid, near & ~front, shape, centre, radius_mm, pitch_mm)
    kept &= np.hypot(*centre.T) < _MOVED_SHARE * radius_mm
    hidden = _are_hidden(patches, high_mm, centre, radius_mm, pitch_mm)
    kept &= ~hidden & (not _is_floor(hidden, kept))
    bores = _bores(patches, centre, radius_mm, near)
    ends_mm = _ends(patches, near & ~front, centre, radius_mm)
    plugged = _is_thin(patches.eye, centre, ends_mm, pitch_mm)
    ends_mm[plugged] = 0.0
    bores = bores.where(bores.depth < ends_mm[bores.points.owner])
    # Between the lands of a roughened foot its floor shows beside the bore, and is no wall.
    layer_mm = -low_mm if face is not None and face.rough else 0.0
    upper = (bores.depth > layer_mm + _UPPER_WALL_MM[0]) & (bores.depth < layer_mm + _UPPER_WALL_MM[1])
    rims = shape.only(~_shown(bores.points.where(upper), centre, bins))
    deep = bores.where((bores.depth > max(WALL_DEPTH_MM[0], layer_mm)) & kept[bores.points.owner])
    xy, depth, slope, seen = _rows(deep.where(_opposite(deep, centre)), np.flatnonzero(kept))
    return Mouths(
        np.flatnonzero(kept),
        places[kept],
        centre[kept],
        rims.of(kept),
        shape.coverage[kept],
        xy,
        depth,
        slope,
        seen,
        plugged[kept],
    )


def _ghosts(patches: Patches, front: BoolArray, high_mm: float) -> BoolArray:
    """Which points (k, n) hang in the air before the face, as before unlit walls: they close no mouth."""
    above = np.flatnonzero(front & (patches.height > high_mm))
    ghosts = np.zeros(front.size, bool)
    ghosts[above] = ~patches.borne(above)
    return ghosts.reshape(front.shape)


@dataclass(frozen=True, eq=False)
class _Bores:
    """Points near the walls of all bores, their ``depth`` (n,) mm behind the face, and the view's ``slope`` (n, 2)."""

    points: PlanPoints
    depth: FloatArray
    slope: FloatArray

    def where(self, wanted: BoolArray) -> _Bores:
        return _Bores(self.points.where(wanted), self.depth[wanted], self.slope[wanted])


def _bores(patches: Patches, centre: Array, radius_mm: float, near: BoolArray) -> _Bores:
    behind = near & (patches.height < -_UPPER_WALL_MM[0]) & (patches.height > -WALL_DEPTH_MM[1])
    at = np.flatnonzero(behind)
    points = PlanPoints.of(patches.x, patches.y, at)
    on_wall = np.abs(points.distance(centre) - radius_mm) < _WALL_BAND_MM
    points, depth = points.where(on_wall), -patches.height.ravel()[at[on_wall]]
    return _Bores(points, depth, _slope(patches.eye, points, depth))


def _ends(patches: Patches, behind: BoolArray, centre: Array, radius_mm: float) -> Array:
    """How deep (k,) mm the walls of the bores go: to a plug, whose edge lies as near to the circle as they do."""
    at = np.flatnonzero(behind & (patches.height > -WALL_DEPTH_MM[1]))
    points = PlanPoints.of(patches.x, patches.y, at)
    inner = points.distance(centre) < _INSIDE[1] * radius_mm
    owner, depth = points.owner[inner], -patches.height.ravel()[at[inner]]
    ends = np.full(len(centre), np.inf)
    for k in np.flatnonzero(np.bincount(owner, minlength=len(centre)) >= _FLOOR_POINTS).tolist():
        own = depth[owner == k]
        end_mm = float(np.median(own))
        if np.mean(np.abs(own - end_mm) < _FLOOR_BAND_MM) > _FLOOR_SHARE:
            ends[k] = end_mm - _FLOOR_BAND_MM
    return ends


def _is_thin(eye: Array | None, centre: Array, ends_mm: Array, pitch_mm: float) -> BoolArray:
    """Where (k,) a wall ends at a plug before it fills a few pixels: what lies there mixes the face with the plug."""
    if eye is None:
        return np.zeros(len(centre), bool)
    slope = np.hypot(*(centre - eye[:, :2]).T) / eye[:, 2]
    return np.asarray(ends_mm * slope < _STRIP_PITCHES * pitch_mm)


def _slope(eye: Array | None, points: PlanPoints, depth: FloatArray) -> FloatArray:
    """How far the line of sight moves in the plan per mm of depth (n, 2); zero where the viewpoint is unknown."""
    if eye is None:
        return np.zeros((len(depth), 2))
    own = eye[points.owner]
    return np.asarray(
        np.column_stack([points.x - own[:, 0], points.y - own[:, 1]]) / np.abs(depth + own[:, 2])[:, None]
    )


def _opposite(bores: _Bores, centre: Array) -> BoolArray:
    """Wall points (n,) that the camera looks at: towards the ends of what it sees, surfaces mix in its pixels."""
    if not bores.slope.any():
        return np.ones(len(bores.depth), bool)
    own = centre[bores.points.owner]
    about = np.column_stack([bores.points.x - own[:, 0], bores.points.y - own[:, 1]])
    along = np.einsum("ij,ij->i", about, bores.slope)
    return np.asarray(along > _OPPOSITE_COSINE * np.hypot(*about.T) * np.hypot(*bores.slope.T))


def _rows(bores: _Bores, kept: IntArray) -> tuple[Array, Array, Array, BoolArray]:
    """Plan, depth and slope of at most so many points of each kept bore, a row for each, and which are there."""
    points = bores.points
    some = thinned_rows(points.owner, points.features, _WALL_POINTS_MAX)
    values = np.column_stack([points.x[some], points.y[some], bores.depth[some], bores.slope[some]])
    rows, seen = in_rows(values, np.searchsorted(kept, points.owner[some]), len(kept))
    return rows[..., :2], rows[..., 2], rows[..., 3:], seen


def _closed(inside: PlanPoints, centre: Array, radius_mm: float, pitch_mm: float) -> BoolArray:
    """Where (k,) the face goes on where the mouth should be: plugged, covered, or no sleeve at all.

    A tape over half of a mouth leaves whole sectors of it open; a plug leaves none.
    """
    return _filled_sectors(inside, centre, radius_mm, pitch_mm) > _SECTORS - _OPEN_SECTORS


def _filled_sectors(inside: PlanPoints, centre: Array, radius_mm: float, pitch_mm: float) -> IntArray:
    """How many (k,) sectors of the inner part of each mouth hold points."""
    radius = inside.distance(centre)
    low, high = _INSIDE
    inside = inside.where((radius > low * radius_mm) & (radius < high * radius_mm))
    cells = inside.owner * _SECTORS + inside.bins(centre, _SECTORS)
    counts = np.bincount(cells, minlength=inside.features * _SECTORS).reshape(-1, _SECTORS)
    expected = np.pi * (high**2 - low**2) * (radius_mm / pitch_mm) ** 2 / _SECTORS
    return np.asarray((counts > _CLOSED_SHARE * expected).sum(axis=1))


def _is_shallow(
    patches: Patches,
    solid: BoolArray,
    behind: BoolArray,
    shape: Outlines,
    centre: Array,
    radius_mm: float,
    pitch_mm: float,
) -> BoolArray:
    """Where (k,) a floor shows a few mm behind the face, and no plug has it: spalls and keys, which are no mouths.

    What of the face (``solid``) lies beside a spall closes it as well.
    """
    floor_at = behind & (patches.height > -_FLOOR_MM)
    at = np.flatnonzero(floor_at)
    if not len(at):
        return np.zeros(len(centre), bool)
    floor = PlanPoints.of(patches.x, patches.y, at)
    both = PlanPoints.of(patches.x, patches.y, np.flatnonzero(floor_at | solid))
    floored = _filled_sectors(both, centre, radius_mm, pitch_mm) > _SECTORS - _OPEN_SECTORS
    floored &= _filled_sectors(floor, centre, radius_mm, pitch_mm) > 0
    if not floored.any():
        return floored
    depth, inner = -patches.height.ravel()[at], floor.distance(centre) < _INSIDE[1] * radius_mm
    middle_mm = np.array(
        [np.median(depth[inner & (floor.owner == k)]) if floored[k] else 0.0 for k in range(len(centre))]
    )
    within_mm = max(AGREES_MM, _AGREES_PITCHES * pitch_mm)
    unlike_plug = agreeing_shares(shape, centre, radius_mm, within_mm) < _PLUG_ROUND
    return np.asarray(floored & ((middle_mm < _SPALL_MM) | unlike_plug))


def _are_hidden(patches: Patches, high_mm: float, centre: Array, radius_mm: float, pitch_mm: float) -> BoolArray:
    """Where (k,) most lines of sight into a mouth end before the face, and hardly one behind it.

    Bars hide round pieces of a floor like this.
    """
    within_mm = _INSIDE[1] * radius_mm
    expected = np.pi * (within_mm / pitch_mm) ** 2

    def share(wanted: BoolArray) -> Array:
        crossed = patches.crossings(np.flatnonzero(wanted))
        return np.asarray(crossed.counted(crossed.distance(centre) < within_mm) / expected)

    before = share(patches.height > high_mm + _BEFORE_MM) > _HIDDEN_SHARE
    return np.asarray(before & (share(patches.height < -_FLOOR_MM) < _OPEN_SHARE)) if before.any() else before


def _is_floor(hidden: BoolArray, kept: BoolArray) -> bool:
    """Whether so many mouths are hidden that the rest are shadows of what stands there: bars on a floor, no foot."""
    return bool(hidden.sum() >= max(_FEWEST_BARS, _BARS_SHARE * (hidden | kept).sum()))


def _shown(points: PlanPoints, centre: Array, bins: int, reach: int = 2) -> BoolArray:
    """Angular bins (k, bins) that hold any of some points, or lie next to one that does."""
    marked = np.zeros((points.features, bins), bool)
    marked[points.owner, points.bins(centre, bins)] = True
    wide = marked.copy()
    for shift in range(1, reach + 1):
        wide |= np.roll(marked, shift, axis=1) | np.roll(marked, -shift, axis=1)
    return wide
