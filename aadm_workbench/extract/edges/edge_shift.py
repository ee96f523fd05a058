"""What a camera does to a surface at its edges, read from the scan: does the surface bend there, and which way.

A camera that projects fringes mixes, in a pixel that an edge crosses, the phase of what is lit in it. The last pixels
of a surface carry the phase of their inner part: the surface bends by (distance/base line) times the part of a pixel
that is missing, up on one side of the base line and down on the other, and pixels that see only a sliver of it still
return it. A camera whose pixels sample one ray each, or that drops what is mixed, has surfaces that are flat to the
end. The two need other witnesses: where surfaces bend, the outermost points stand beyond the edge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.circle import Outlines
from aadm_workbench.extract.edges.seen_disc import SeenDiscs, SightLines, seen_discs
from aadm_workbench.model import Array, BoolArray, FloatArray, Reason

_MOUTHS, _TOPS = 1.0, -1.0  # the side on which the surface lies: outside of the disc, or within

# Where a bend is looked for. In distances of pixels behind the edge, unless a name says mm.
_BENT_PITCHES = (0.3, 1.5)  # pixels that an edge with a blur of half a pixel reaches
_INNER_PITCHES = (4.0, 9.0)  # farther than any sharp camera's blur
_BLUR_PITCHES = {_MOUTHS: (2.5, 3.5), _TOPS: (1.5, 2.5)}  # three pixels of blur reach there, one does not
_BEND_MAX_MM, _INNER_MAX_MM = 3.0, 1.5  # what is farther off is another surface
_VISIBLE_SIDE = 0.3  # cosine: beyond it the surface runs on into a wall, whose points are no bend
_FEWEST = 60  # points: a mean of fewer is noise

# From where on it counts.
_BENT_FROM = {_MOUTHS: 0.18, _TOPS: 0.07}  # of the pitch: chamfered mouths off centre bend by 0.13, cut bars do not
_BENT_SIGMAS = {_MOUTHS: 8.0, _TOPS: 4.0}  # chamfers of a few mouths do not cancel as noise does
_ROUGH_EDGES, _ROUGH_SIGMAS = 2.5, 2.0  # heights at edges that scatter so much more than within are mixed ones
_BLUR_SHARE, _BLUR_ROUGH = 0.12, 1.5  # of the bend at the edge; of the scatter within
_BLUR_FROM = {_MOUTHS: 0.0, _TOPS: 0.95}  # of the pitch: small tops are flat nowhere near their edges

# Discs of surfaces that bend: shifts that are taken off, and what is left of them. docs/method.md, 2.4, has the scans.
_BANDS_MM, _BAND_SIGMAS = (0.5, 1.5, 2.5), 3.5  # about the surface; never narrower than its noise
_COUNTING = 1.3  # neighbouring lines share their errors: standard errors are this much larger
_OVERHANG_PITCHES = 0.25  # a mixed pixel is returned while a quarter of it sees the surface
_OWN_PITCHES, _ERODED_OWN_PITCHES = 0.05, 0.10  # what each disc errs by itself, and more for each ring lost
_BEND_SHIFT = 0.09  # of the bend: what narrow bands lose on the side that bends away
# what all discs err by together: tuned when they were made; on which scans is not recorded
_ALONG_BASE_PITCHES, _ACROSS_BASE_PITCHES = 0.07, 0.05
_ERODED_BASE = 0.10, 0.28  # pitches a ring, mean and spread: filters see a step where the wall behind it is lit
_FIRST_RING, _SECOND_RING_PITCHES = 1.2, 0.8  # eroded by more: what the second ring takes hangs on walls behind it
_BENT_VIEW_MM, _BENT_VIEW_SPREAD_MM = 0.10, 0.15  # per unit of slope, beyond the wall that bands take in
_ERODED_BENT_VIEW, _ERODED_BENT_FROM = 0.25, 0.6  # the wall near the face goes with the second ring
_NEARER_TAKES_LESS = 1.3  # seen from nearer, less of the wall is taken in: measured at 0.8 m and at 1.3 m

# Outlines of sharp surfaces: mm per unit of slope along the view, mean and spread; eroded: more for each ring lost.
_USUAL_PITCH_MM, _FAR_NO_MORE = 0.5, 1.1  # at which they were measured; at 2 m they are no larger than at 1.4 m
_USUAL_STEP_PITCHES = 0.4  # a camera that loses half of the pixels at steps sees rims that far behind
_USUAL_GAP_PITCHES = 2.0  # one to two pixels lie between a top and what passed it; half of them lost, more
# tuned when they were made; on which scans is not recorded
_SHARP_MOUTH_VIEW, _ERODED_MOUTH_VIEW = (-0.08, 0.14), (-0.60, 0.40)
_SHARP_TOP_VIEW, _BENT_TOP_VIEW, _ERODED_TOP_VIEW = (-0.15, 0.18), (-0.40, 0.33), (-0.80, 0.15)  # docs/method.md, 2.4
PARTS_VIEW_MM = {_MOUTHS: _SHARP_MOUTH_VIEW[1], _TOPS: _SHARP_TOP_VIEW[1]}
"""What chamfers, bores and ribs do along the view, mm per unit of slope: no plate tells, whatever is known of edges."""

_ERODED_MOUTH_BASE_PITCHES = 0.45  # a ring: taken where the projector lights the wall, and not in its shadow
_ERODED_MOUTH_OWN_PITCHES = 0.22  # half rims stand on fewer points, and on fewer points of the bore
_RADIUS_U_PITCHES = 0.15  # of a radius where no ring is lost
_SHARED_UNKNOWNS = 3  # a shift, and a part along the view
_APART_PITCHES, _APART_SHARE = 0.15, 0.8  # rims and lines of sight differ by so much where both are sound
_NOISE_FROM_MM, _NOISE_SHARE = 0.10, 0.22  # of the scatter of heights, that edges and bores carry on to centres

BLURRED = Reason("extract.blurred")
"""Reason of what is not measured: what a blurred edge does to a centre nobody knows."""


@dataclass(frozen=True, eq=False)
class Bend:
    """How far a surface bends up at its edges, and towards where: ``towards`` (2,) mm.

    ``u_mm`` is its standard uncertainty, ``inner_mm`` the scatter of heights within, ``ratio`` that at edges over it;
    ``pitch_mm`` the distance of neighbouring lines of sight. ``reach_mm`` is how far it still bends where the edges of
    a camera in focus are flat again.
    """

    towards: Array
    u_mm: float
    inner_mm: float
    ratio: float
    pitch_mm: float
    side: float
    reach_mm: float

    @property
    def height_mm(self) -> float:
        """How far the surface bends up on the side towards which it does."""
        return float(np.hypot(*self.towards))

    @property
    def bent(self) -> bool:
        """Whether the camera mixes what an edge separates."""
        sigmas = _ROUGH_SIGMAS if self.side < 0 and self.ratio > _ROUGH_EDGES else _BENT_SIGMAS[self.side]
        return self.height_mm > max(_BENT_FROM[self.side] * self.pitch_mm, sigmas * self.u_mm)

    @property
    def blurred(self) -> bool:
        """Whether the bend goes on for more pixels than that of a camera in focus."""
        high = self.height_mm > _BLUR_FROM[self.side] * self.pitch_mm
        return self.bent and high and self.reach_mm > _BLUR_SHARE * self.height_mm


def no_bend(pitch_mm: float, side: float) -> Bend:
    """What is taken where too little is seen to tell."""
    return Bend(np.zeros(2), 0.0, 0.0, 1.0, pitch_mm, side, 0.0)


def bend_at_edges(lines: SightLines, centre: Array, radius_mm: float, pitch_mm: float, side: float) -> Bend:
    """How the surface bends towards the edges of its discs, seen lines of sight given as for :func:`seen_discs`."""
    about_x, about_y = lines.x - centre[:, :1], lines.y - centre[:, 1:]
    distance = np.maximum(np.sqrt(about_x * about_x + about_y * about_y), 1e-6)
    behind = side * (distance - radius_mm) / pitch_mm
    flat = np.abs(lines.height) < _BEND_MAX_MM
    slope_length = np.maximum(np.hypot(*lines.slope.T), 1e-9)[:, None]
    away = side * (about_x * lines.slope[:, :1] + about_y * lines.slope[:, 1:]) / (distance * slope_length)
    off_wall = flat & (away < _VISIBLE_SIDE)
    at_edge, reached = (
        off_wall & (behind > low) & (behind < high) for low, high in (_BENT_PITCHES, _BLUR_PITCHES[side])
    )
    inner = flat & (behind > _INNER_PITCHES[0]) & (behind < _INNER_PITCHES[1]) & (np.abs(lines.height) < _INNER_MAX_MM)
    if at_edge.sum() < _FEWEST or inner.sum() < _FEWEST:
        return no_bend(pitch_mm, side)
    inner_mm = max(_rms(lines.height[inner]), 1e-3)
    # A chamfer bends the surface, too, and the discs are off along each one's own line of sight: that turns from disc
    # to disc, what the camera does has one direction.
    terms = [np.ones(distance.shape), away * slope_length, away, about_x / distance, about_y / distance]
    towards, edge_mm = _common_bend(lines.height, terms, at_edge), _rms(lines.height[at_edge])
    reach_mm = 0.0
    if reached.sum() >= _FEWEST and _rms(lines.height[reached]) > _BLUR_ROUGH * inner_mm:
        reach_mm = float(np.hypot(*_common_bend(lines.height, terms, reached)))
    u_mm = edge_mm / float(np.sqrt(0.5 * at_edge.sum()))
    return Bend(side * towards, u_mm, inner_mm, edge_mm / inner_mm, pitch_mm, side, reach_mm)


def _rms(heights: FloatArray) -> float:
    return float(np.sqrt(np.mean(heights.astype(np.float64) ** 2)))


def _common_bend(height: FloatArray, terms: Sequence[Array], chosen: BoolArray) -> Array:
    """The part of the heights that rises towards one direction (2,), the same about all discs; mm."""
    design = np.column_stack([term[chosen] for term in terms])
    return np.asarray(np.linalg.lstsq(design, height[chosen].astype(np.float64), rcond=None)[0][-2:])


@dataclass(frozen=True, eq=False)
class BentDiscs:
    """Centres (k, 2) mm of discs whose edges bend, and their own covariances ``own`` (k, 2, 2) mm².

    ``shared`` (k, 2, 2) is what all err by together. ``radius`` mm is that from which on half of the lines of sight
    find the surface, without what slivers add to it, and ``radius_u_mm`` what it may be off; ``eroded`` how many
    distances of pixels farther behind the edge that is than without a filter.
    """

    centre: Array
    own: Array
    shared: Array
    radius: float
    radius_u_mm: float
    eroded: float


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
        + view_mm**2 * along_view[:, :, None] * along_view[:, None, :]
    )
    radius = middle.radius + side * _OVERHANG_PITCHES * pitch_mm
    return BentDiscs(moved, own, shared, radius, _radius_u_mm(pitch_mm, eroded), eroded)


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
    return max(0.0, 0.5 * (float(np.median(gap)) - _USUAL_GAP_PITCHES))


def shift_of_tops(slope: Array, bend: Bend, eroded: float) -> Shift:
    """The shift of bars' centres that were fitted to outlines, by the lines of sight's ``slope`` (k, 2).

    On the visible side the top runs on into the bar's side and loses nothing, opposite it ends in a step.
    """
    usual, spread = _BENT_TOP_VIEW if bend.bent else _SHARP_TOP_VIEW
    nearer = min(_FAR_NO_MORE, bend.pitch_mm / _USUAL_PITCH_MM)
    view_mm = usual * (nearer if bend.bent else 1.0) + _ERODED_TOP_VIEW[0] * eroded * nearer
    spread_mm = spread + _ERODED_TOP_VIEW[1] * eroded * max(1.0, bend.pitch_mm / _USUAL_PITCH_MM)
    own_mm = _ERODED_OWN_PITCHES * eroded * bend.pitch_mm
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
    apart_mm = _APART_SHARE * max(
        0.0, _apart_mm(slope[whole], centre[whole] - seen.centre) - _APART_PITCHES * bend.pitch_mm
    )
    own_mm = float(np.hypot(noise_mm, apart_mm))
    return _shift_of_eroded(slope, (seen.radius - radius_mm) / bend.pitch_mm, bend.pitch_mm, own_mm)


def shift_of_rims(slope: Array, rims: Outlines, centre: Array, radius_mm: float, pitch_mm: float) -> Shift:
    """The same where no mouth is whole, which lines of sight could tell of: by the rims (k, bins) themselves."""
    behind_mm = (rims.distance(centre) - radius_mm)[rims.seen]
    pitches = float(np.median(behind_mm)) / pitch_mm if len(behind_mm) else 0.0
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
