"""What is known of the shift of centres by what a camera does at edges, and what is left of it.

Where surfaces bend (:mod:`~aadm_workbench.extract.edges.bend`), or a filter drops rings of pixels at steps, centres
come from lines of sight; elsewhere from outlines. Each is off along the view and along the base line, by as much as
stands here.

How far centres of mouths are off along the view, by the bore just behind the face.

There the wall that the camera looks at is where the edge is, but for what the line of sight moves in the plan on its
way down: light that pushes it along the ray moves it by less than a tenth of that.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.extract.circle import Outlines
from aadm_workbench.extract.edges.bend import Bend
from aadm_workbench.extract.edges.seen_disc import SeenDiscs, SightLines, seen_discs
from aadm_workbench.extract.pooled.evidence import Walls
from aadm_workbench.model import Array, BoolArray
from aadm_workbench.model.special import median

_FEWEST = 60  # gaps: a median of fewer is noise
# Discs of surfaces that bend: shifts that are taken off, and what is left of them. docs/method.md, 2.4, has the scans.
_BANDS_MM, _BAND_SIGMAS = (0.5, 1.5, 2.5), 3.5  # about the surface; never narrower than its noise
_COUNTING = 1.3  # neighbouring lines share their errors: standard errors are this much larger
_OVERHANG_PITCHES = 0.25  # a mixed pixel is returned while a quarter of it sees the surface
_OWN_PITCHES, _ERODED_OWN_PITCHES = 0.05, 0.10  # what each disc errs by itself, and more for each ring lost
# mm a ring, no less: what is dropped hangs on the side below the top, whose ribs are no smaller seen from nearer.
# 360 bars of the ray caster at 0.6 to 1.0 m: 0.04 to 0.09 each by itself and 0.03 to 0.09 all together, per axis
_ERODED_OWN_MM = 0.065
_BEND_SHIFT = 0.09  # of the bend: what narrow bands lose on the side that bends away
# what all discs err by together: tuned when they were made; on which scans is not recorded
_ALONG_BASE_PITCHES, _ACROSS_BASE_PITCHES = 0.07, 0.05
_ERODED_BASE = 0.10, 0.28  # pitches a ring, mean and spread: filters see a step where the wall behind it is lit
_FIRST_RING, _SECOND_RING_PITCHES = 1.2, 0.8  # eroded by more: what the second ring takes hangs on walls behind it
_BENT_VIEW_MM, _BENT_VIEW_SPREAD_MM = 0.10, 0.15  # per unit of slope, beyond the wall that bands take in
_ERODED_BENT_VIEW, _ERODED_BENT_FROM = 0.25, 0.6  # the wall near the face goes with the second ring
_NEARER_TAKES_LESS = 1.3  # seen from nearer, less of the wall is taken in: measured at 0.8 m and at 1.3 m
_CONTRADICTS = 3.0  # standard deviations: one in 400 does by chance

# Mouths of a camera that drops rings at steps. docs/method.md, 2.4, has the scans.
_LOST_VIEW, _LOST_VIEW_SPREAD = (4.0, 2.7), 0.9  # of what the face lost, per unit of slope: one ring, and more
_LOST_OWN_PITCHES = (0.08, 0.08)  # of each mouth, and more for each ring
_LOST_SHARED_SHARE, _LOST_BEND_SHARE = 0.12, 0.3  # of what the face lost, either way; of what is left of the bend

# Outlines of sharp surfaces: mm per unit of slope along the view, mean and spread; eroded: more for each ring lost.
_USUAL_PITCH_MM, _FAR_NO_MORE = 0.5, 1.1  # at which they were measured; at 2 m they are no larger than at 1.4 m
_USUAL_STEP_PITCHES = 0.4  # a camera that loses half of the pixels at steps sees rims that far behind
_USUAL_GAP_PITCHES = 2.0  # one to two pixels lie between a top and what passed it; half of them lost, more
# tuned when they were made; on which scans is not recorded
_SHARP_MOUTH_VIEW, _ERODED_MOUTH_VIEW = (-0.08, 0.14), (-0.60, 0.40)
_SHARP_TOP_VIEW, _BENT_TOP_VIEW = (-0.15, 0.18), (-0.40, 0.33)  # docs/method.md, 2.4
# of the first ring that is lost, with what bent in it, and of further ones: the side below the edge is lost with those;
# spread of each: docs/method.md, 2.4
_ERODED_TOP_VIEW_MM, _ERODED_BENT_TOP_VIEW_MM, _FURTHER_TOP_VIEW_MM, _ERODED_TOP_SPREAD_MM = -0.45, -0.15, -1.05, 0.30
PARTS_VIEW_MM = {1.0: _SHARP_MOUTH_VIEW[1], -1.0: _SHARP_TOP_VIEW[1]}
"""What chamfers, bores and ribs do along the view, mm per unit of slope: no plate tells, whatever is known of edges.

By the side on which the surface lies, as for :func:`~aadm_workbench.extract.edges.seen_disc.seen_discs`."""

ERODED_PARTS_VIEW_MM = 0.45
"""The same of mouths where rings are dropped: how many pixels go hangs on what light comes back from the bore, too, and
a plate has other bores than a foot. Fifteen feet of four cameras had 0.46 (rms)."""

_ERODED_MOUTH_BASE_PITCHES = 0.45  # a ring: taken where the projector lights the wall, and not in its shadow
_ERODED_MOUTH_OWN_PITCHES = 0.22  # half rims stand on fewer points, and on fewer points of the bore
_RADIUS_U_PITCHES = 0.15  # of a radius where no ring is lost
_SHARED_UNKNOWNS = 3  # a shift, and a part along the view
_APART_PITCHES, _APART_SHARE = 0.15, 0.8  # rims and lines of sight differ by so much where both are sound
# noise that puts a part of the face beyond the band in which it is looked for: a fit then takes other radii for true
_BEYOND_BAND_MM, _BEYOND_BAND_SHARE = 0.6, 2.5
_NOISE_FROM_MM, _NOISE_SHARE = 0.10, 0.22  # of the scatter of heights, that edges and bores carry on to centres


@dataclass(frozen=True, eq=False)
class BentDiscs:
    """Centres (k, 2) mm of discs by lines of sight, set right, and their own covariances ``own`` (k, 2, 2) mm².

    ``shared`` (k, 2, 2) is what all err by together, but along the view: ``slope`` (k, 2) times a number of mm whose
    variance is ``view_mm2``. ``radius`` mm is that from which on half of the lines of sight
    find the surface, without what slivers add to it, and ``radius_u_mm`` what it may be off; ``eroded`` how many
    distances of pixels farther behind the edge that is than without a filter.
    """

    centre: Array
    own: Array
    shared: Array
    slope: Array
    view_mm2: float
    radius: float
    radius_u_mm: float
    eroded: float

    @property
    def in_common(self) -> Array:
        """Covariances (k, 2, 2) mm² of all that the discs err by together."""
        along = self.slope[:, :, None] * self.slope[:, None, :]
        return np.asarray(self.shared + self.view_mm2 * along)

    def moved_by(self, told: tuple[float, float] | None) -> BentDiscs:
        """The discs with what another witness told of the view: mm per unit of slope that they lack, and its variance.

        A witness that contradicts what is known moves nothing; it is then less well known.
        """
        if told is None or self.view_mm2 == 0.0:
            return self
        lacking, variance = told
        if lacking**2 > _CONTRADICTS**2 * (self.view_mm2 + variance):
            return replace(self, view_mm2=self.view_mm2 + (lacking / 2.0) ** 2)
        weight = self.view_mm2 / (self.view_mm2 + variance)
        moved = self.centre + weight * lacking * self.slope
        return replace(self, centre=moved, view_mm2=(1.0 - weight) * self.view_mm2)


def bent_discs(lines: SightLines, centre: Array, radius_mm: float, bend: Bend) -> BentDiscs:
    """Discs by the share of lines of sight that find the surface, in bands about it that take in its bend.

    Narrow bands lose the side that bends away, wide ones take in the wall on the visible side, as deep as they are:
    the mean of three is taken. What is left of both is taken off, and counts with its spread.
    """
    pitch_mm, side = bend.pitch_mm, bend.side
    bands = [max(band, _BAND_SIGMAS * bend.inner_mm) for band in _BANDS_MM]
    fits = [seen_discs(lines, np.abs(lines.height) < band, centre, radius_mm, pitch_mm, side) for band in bands]
    middle = fits[1]
    eroded = max(0.0, side * (middle.radius - radius_mm) / pitch_mm + _OVERHANG_PITCHES)
    near = min(1.0, pitch_mm / _USUAL_PITCH_MM) ** _NEARER_TAKES_LESS
    taken_in_mm = (0.5 * float(np.mean(bands)) + _BENT_VIEW_MM) * near
    taken_in_mm -= _ERODED_BENT_VIEW * max(0.0, eroded - _ERODED_BENT_FROM)
    along_view, along_base = lines.slope, _direction(bend.towards)
    mean = np.mean([fit.centre for fit in fits], axis=0)
    moved = mean + taken_in_mm * along_view + _BEND_SHIFT * bend.towards
    moved -= _ERODED_BASE[0] * eroded * pitch_mm * along_base
    own_mm = (_OWN_PITCHES + _ERODED_OWN_PITCHES * eroded) * pitch_mm
    rings_mm = _SECOND_RING_PITCHES * max(0.0, eroded - _FIRST_RING) * pitch_mm
    own = _COUNTING**2 * np.mean([fit.covariance for fit in fits], axis=0) + own_mm**2 * np.eye(2)
    base_mm = (_ALONG_BASE_PITCHES + _ERODED_BASE[1] * eroded) * pitch_mm
    view_mm = _BENT_VIEW_SPREAD_MM + _ERODED_BENT_VIEW * eroded
    shared = (
        base_mm**2 * np.outer(along_base, along_base)
        + ((_ACROSS_BASE_PITCHES * pitch_mm) ** 2 + rings_mm**2) * np.eye(2)
    ) * np.ones((len(centre), 1, 1))
    radius = middle.radius + side * _OVERHANG_PITCHES * pitch_mm
    u_mm = _radius_u_mm(pitch_mm, eroded)
    return BentDiscs(moved, own, shared, along_view, view_mm**2, radius, u_mm, eroded)


def narrow_band_mm(bend: Bend) -> float:
    """The narrowest band about a surface that its noise allows: least of walls and chamfers reaches into it."""
    return max(_BANDS_MM[0], _BAND_SIGMAS * bend.inner_mm)


def eroded_discs(lines: SightLines, centre: Array, radius_mm: float, bend: Bend, rings: int) -> BentDiscs:
    """Mouths of a camera that drops ``rings`` of pixels at steps, and with them what bent: by lines of sight.

    The face is taken away where it ends in a step, and less where it runs on into the wall that shows. Seen
    steeply, the wall falls by more than a filter's step from pixel to pixel, and both sides lose alike.
    """
    pitch_mm, slope = bend.pitch_mm, lines.slope
    fit = seen_discs(lines, np.abs(lines.height) < narrow_band_mm(bend), centre, radius_mm, pitch_mm, bend.side)
    lost_mm = max(0.0, fit.radius - radius_mm)
    lost = lost_mm / pitch_mm
    per_slope = _LOST_VIEW[min(rings, len(_LOST_VIEW)) - 1]
    share = np.minimum(per_slope, 1.0 / np.maximum(np.hypot(*slope.T), 1e-9))
    moved = fit.centre + share[:, None] * lost_mm * slope
    own_mm = (_LOST_OWN_PITCHES[0] + _LOST_OWN_PITCHES[1] * lost) * pitch_mm
    own = _COUNTING**2 * fit.covariance + own_mm**2 * np.eye(2)
    along_base = _direction(bend.towards)
    shared = (_LOST_SHARED_SHARE * lost_mm) ** 2 * np.eye(2) * np.ones((len(centre), 1, 1))
    shared += (_LOST_BEND_SHARE * bend.height_mm) ** 2 * np.outer(along_base, along_base)
    view_mm2 = (_LOST_VIEW_SPREAD * lost_mm) ** 2 + _BENT_VIEW_SPREAD_MM**2
    return BentDiscs(moved, own, shared, slope, view_mm2, fit.radius, _radius_u_mm(pitch_mm, lost), lost)


@dataclass(frozen=True, eq=False)
class Shift:
    """What is known of the common errors of centres: their mean (k, 2) mm, to be taken off, and ``covariance``.

    ``radius_u_mm`` is what radii may be off together.
    """

    mean: Array
    covariance: Array
    radius_u_mm: float


def eroded_rings(beyond: Outlines, rims: Outlines, centre: Array, pitch_mm: float) -> float:
    """How many rings of pixels a filter took from both sides of the edges of tops, from the gaps that it left.

    Between the last point of a top and the first line of sight that passed it lie one to two pixels, more where a
    camera drops them. Zero where too few edges show both.
    """
    both = beyond.seen & rims.seen
    if both.sum() < _FEWEST:
        return 0.0
    gap = (beyond.distance(centre) - rims.distance(centre))[both] / pitch_mm
    return max(0.0, 0.5 * (float(median(gap)) - _USUAL_GAP_PITCHES))


def shift_of_tops(slope: Array, bend: Bend, eroded: float) -> Shift:
    """The shift of bars' centres that were fitted to outlines, by the lines of sight's ``slope`` (k, 2).

    On the visible side the top runs on into the bar's side and loses nothing, opposite it ends in a step.
    """
    usual, spread = _BENT_TOP_VIEW if bend.bent else _SHARP_TOP_VIEW
    nearer = min(_FAR_NO_MORE, bend.pitch_mm / _USUAL_PITCH_MM)
    first, further = min(eroded, 1.0), max(eroded - 1.0, 0.0)
    first_mm = _ERODED_BENT_TOP_VIEW_MM if bend.bent else _ERODED_TOP_VIEW_MM
    view_mm = usual * (nearer if bend.bent else 1.0) + first_mm * first + _FURTHER_TOP_VIEW_MM * further
    spread_mm = spread + _ERODED_TOP_SPREAD_MM * eroded * max(1.0, bend.pitch_mm / _USUAL_PITCH_MM)
    own_mm = max(_ERODED_OWN_PITCHES * bend.pitch_mm, _ERODED_OWN_MM) * eroded
    shared = own_mm**2 * np.eye(2) + spread_mm**2 * slope[:, :, None] * slope[:, None, :]
    if not bend.bent:
        return Shift(view_mm * slope, shared, _radius_u_mm(bend.pitch_mm, eroded))
    along = _direction(bend.towards)
    base_mm = (_ALONG_BASE_PITCHES + 0.5 * _ERODED_BASE[1] * eroded) * bend.pitch_mm
    mean = view_mm * slope - _BEND_SHIFT * bend.towards
    covariance = shared + base_mm**2 * np.outer(along, along)
    return Shift(mean, covariance, _radius_u_mm(bend.pitch_mm, eroded))


def _radius_u_mm(pitch_mm: float, eroded: float) -> float:
    """What edges leave open of a radius: nobody can tell a ring that was taken away from a larger mouth."""
    return (_RADIUS_U_PITCHES + eroded) * pitch_mm


def shift_of_mouths(
    slope: Array, centre: Array, seen: SeenDiscs, whole: BoolArray, radius_mm: float, bend: Bend
) -> Shift:
    """The shift of sleeves' centres that were fitted to sharp rims and bores.

    Filters take rims away on the side of the step, not where the face runs on into the wall: the radius from which on
    lines of sight find the face tells how much. Where the ``centre`` (k, 2) of sleeves and those of what is ``seen``
    differ by more than what all share, nobody knows which is right. ``seen`` is of those that are ``whole`` (k,).
    """
    noise_mm = _NOISE_SHARE * max(0.0, bend.inner_mm - _NOISE_FROM_MM)
    noise_mm += _BEYOND_BAND_SHARE * max(0.0, bend.inner_mm - _BEYOND_BAND_MM)
    apart_mm = _APART_SHARE * max(
        0.0, _apart_mm(slope[whole], centre[whole] - seen.centre) - _APART_PITCHES * bend.pitch_mm
    )
    own_mm = float(np.hypot(noise_mm, apart_mm))
    return _shift_of_eroded(slope, (seen.radius - radius_mm) / bend.pitch_mm, bend.pitch_mm, own_mm)


def shift_of_rims(slope: Array, rims: Outlines, centre: Array, radius_mm: float, pitch_mm: float) -> Shift:
    """The same where no mouth is whole, which lines of sight could tell of: by the rims (k, bins) themselves."""
    behind_mm = (rims.distance(centre) - radius_mm)[rims.seen]
    pitches = float(median(behind_mm)) / pitch_mm if len(behind_mm) else 0.0
    return _shift_of_eroded(slope, pitches, pitch_mm, 0.0)


def _shift_of_eroded(slope: Array, behind_pitches: float, pitch_mm: float, own_mm: float) -> Shift:
    """The shift where rims stand so far behind the edge; ``own_mm`` is what each centre may be off besides."""
    eroded = max(0.0, behind_pitches - _USUAL_STEP_PITCHES)
    view_mm = _SHARP_MOUTH_VIEW[0] + _ERODED_MOUTH_VIEW[0] * eroded
    spread_mm = (_SHARP_MOUTH_VIEW[1] + _ERODED_MOUTH_VIEW[1] * eroded) * max(1.0, pitch_mm / _USUAL_PITCH_MM)
    ring_mm = float(np.hypot(_ERODED_MOUTH_OWN_PITCHES, _ERODED_MOUTH_BASE_PITCHES)) * eroded * pitch_mm
    shared = (ring_mm**2 + own_mm**2) * np.eye(2) + spread_mm**2 * slope[:, :, None] * slope[:, None, :]
    return Shift(view_mm * slope, shared, _radius_u_mm(pitch_mm, eroded))


def _apart_mm(slope: Array, apart: Array) -> float:
    """Scatter, mm per axis, of differences (k, 2) but for a shift and a part along the ``slope`` that all share."""
    count = len(slope)
    if 2 * count <= 2 * _SHARED_UNKNOWNS:
        return 0.0
    along = np.zeros((2 * count, _SHARED_UNKNOWNS))
    along[0::2, 0] = along[1::2, 1] = 1.0
    along[:, 2] = slope.ravel()
    left = apart.ravel() - along @ np.linalg.lstsq(along, apart.ravel(), rcond=None)[0]
    return float(np.sqrt(left @ left / (2 * count - _SHARED_UNKNOWNS)))


def _direction(vector: Array) -> Array:
    length = float(np.hypot(*vector))
    return vector / length if length > 0.0 else vector


_DEPTH_MM = (2.0, 14.0)  # behind a chamfer, and before light has bounced twice
_FACING = 0.6  # cosine: walls seen along are mixed ones
_FEWEST_OF_BORE = 9  # points of a bore: of fewer a median is any of them
# of one bore, and of all: bores of 30 scans of three cameras, with rings lost or not
_OWN_U_MM, _SHARED_U_MM = 0.12, 0.06


def view_by_walls(walls: Walls, centre: Array, slope: Array, radius_mm: float) -> tuple[float, float] | None:
    """What centres (k, 2) mm lack per unit of their lines of sight's ``slope`` (k, 2), mm, and its variance, mm².

    None where no bore shows its wall just behind the face.
    """
    about = walls.xy - centre[:, None]
    distance = np.maximum(np.hypot(about[..., 0], about[..., 1]), 1e-9)
    steepness = np.maximum(np.hypot(*slope.T), 1e-9)
    facing = np.einsum("kmi,ki->km", about, slope / steepness[:, None]) / distance
    low, high = _DEPTH_MM
    shown = walls.seen & (walls.depth > low) & (walls.depth < high) & (facing > _FACING)
    told = np.flatnonzero(shown.sum(axis=1) >= _FEWEST_OF_BORE)
    squares = float((steepness[told] ** 2).sum())
    if squares <= 0.0:
        return None
    beyond = (distance - radius_mm) / np.maximum(facing, _FACING)
    off = np.array([median(beyond[k, shown[k]]) for k in told.tolist()])
    variance = _OWN_U_MM**2 / squares + (_SHARED_U_MM * float(steepness[told].sum()) / squares) ** 2
    return float(off @ steepness[told]) / squares, variance
