"""Straight edges of a face: by how much of each strip across them the face is found.

A strip across an edge is face up to it and nothing beyond: the share of places in it that are face says where it ends,
to a fraction of their distance, whatever the order in which a camera loses or adds some.

A camera that mixes what a pixel sees finds the face beyond its edge, too, as long as a sliver of it is lit: the less of
a pixel is lit, the more its heights scatter and bend. So the edge lies between where heights are no longer those of the
face and where they end: in the middle, give or take a part of that zone. A camera that drops rings of pixels at steps
shows that at the mouths, whose bores are known; whether it drops them before an empty background, too, nobody can see.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from aadm_workbench.extract.section.face_samples import FaceSamples
from aadm_workbench.model import Array, BoolArray, IntArray

_FIRST_REACH_MM = 30.0  # sections are cast to within 5 mm, and patterns stand within 10 mm of their place in them
_REACH_MM, _REACH_PITCHES = 6.0, 8.0  # to both sides of an edge that is known by and by
_STRIP_PITCHES = 6.0  # along the edge: some fifty places tell where a strip ends, and a chip of 5 mm fills one
_FEWEST_STRIPS = 8  # of fewer a line has no scatter
_CORNER_MM = 3.0  # of the neighbouring edge: nothing is asked so near to it
_WITHIN_SHARE = 0.5  # of the strip on the side of the face: how densely it is found there
_ASKED_MIN, _BEYOND_STEPS = 0.7, 3.0  # of the inner quarter of a strip; places beyond the edge where no face was found
_LEAST_CHANCE = 0.02  # flying pixels, lost ones: nothing is quite sure
_FOUND_MIN, _FLUSH_MAX = 0.25, 0.15  # thinner is no face; denser is something that goes on beyond the edge
_SEEN_MIN = 0.5  # of the strips of an edge: half of one may be out of the picture or behind something
_TUKEY, _ROUNDS = 4.0, 8  # of the scatter; rounds settle in four
_STARTS, _LIKE_PITCHES, _BEYOND_COST = 14, 1.5, 2.0  # some hundred lines are tried; of strips on a line; of one beyond
_MOST_ASKEW_MM = 8.0  # from end to end: sections are cast to 5 mm, and what hides a part of one runs as it likes
_MOST_OFF_MM = 8.0  # from its place by design: sections and patterns keep to 5 mm each
_SETTLED_PITCHES = 1.0  # of a step of the line: places about it are then the same
_RIMS = 4  # mouths nearest to an edge are asked: their median tells as much as that of twelve
_BLIND_PITCHES = 1.0  # about an edge: places fill it where rows of pixels run across it at some angle
_ROUGHEST_MM = 1.5  # of strips: an edge that is broken all along is none
_LEAST_SCATTER_PITCHES = 0.05  # strips are never better than that
_LEAST_U_PITCHES = 0.1  # of one edge: what returns at its very end hangs on what it is made of
_FEWEST_PLACES = 50  # a share, or a scatter, of fewer is no measure
_NEIGHBOURS = 1.5  # neighbouring strips share their errors: standard errors are so much larger
_RIM_SECTOR = np.radians(50.0)  # of a rim about the direction of an edge
_RIM_REACH_MM = 6.0  # as of edges; less than half a mouth
_ABOUT_MOUTH_MM = 2.0  # rims that are worn, or chamfered
_WIDE_MM = 5.0  # about the face: as far as edges bend that are 0.5 mm from the middle of a pixel, seen from 1.5 m
_ZONE_PITCHES, _ZONE_STEP_PITCHES = 3.0, 0.25  # before an edge, where heights may be disturbed; of the look at them
_DISTURBED = 1.4  # of the scatter within: half a pixel that is lit scatters by 1.4 (photons) to 2 times (electronics)
_INNER_PITCHES = (4.0, 12.0)  # before an edge: farther than any sharp camera's blur
_CHIP_MM, _CHIP_SIGMAS = 1.5, 5.0  # from which depth on a gap in an edge is a chip and no scatter
_OUT_OF_PICTURE = "too little of this edge is in the picture"


@dataclass(frozen=True, eq=False)
class Chip:
    """Where concrete is missing at an edge: from ``begin_mm`` to ``end_mm`` along it, ``depth_mm`` deep at least."""

    begin_mm: float
    end_mm: float
    depth_mm: float


@dataclass(frozen=True, eq=False)
class EdgeLine:
    """One edge in the face's axes, mm: the line x @ normal = ``offset_mm`` + ``turn`` · (x @ along − ``middle_mm``).

    ``normal`` (2,) points out of the face, ``along`` (2,) is to its left. ``covariance`` (2, 2) is of offset and turn;
    ``shared_u_mm`` is the part of the offset's that all edges of the face share with one sign, as a radius does.
    ``seen`` is the share of the edge that was seen, ``scatter_mm`` that of its strips.
    """

    normal: Array
    along: Array
    offset_mm: float
    turn: float
    middle_mm: float
    covariance: Array
    shared_u_mm: float
    seen: float
    scatter_mm: float
    chips: tuple[Chip, ...]


@dataclass(frozen=True, eq=False)
class KnownMouths:
    """Mouths in the same face: ``centres`` (k, 2) mm in its axes, ``radii`` (k,) mm of their bores."""

    centres: Array
    radii: Array


@dataclass(frozen=True, eq=False)
class _Strips:
    """Strips (k,) across an edge: their places along it, and where in each the face ends, mm.

    ``bare`` (m,) are the places of strips that show no face at all within ``reach_mm`` of the edge.
    """

    along: Array
    end: Array
    seen: float
    bare: Array
    reach_mm: float
    width_mm: float


def edge_line(samples: FaceSamples, start: Array, end: Array, mouths: KnownMouths, band_mm: float) -> EdgeLine | str:
    """The edge near the line from ``start`` to ``end`` (2,) mm, the face to its left; or why it is not measured.

    Parameters
    ----------
    band_mm
        About the face: what returned from within counts as face.
    """
    along = (end - start) / float(np.hypot(*(end - start)))
    normal = np.array([along[1], -along[0]])
    band_mm = _WIDE_MM if _looks_past(samples, (start + end) / 2.0, normal) else band_mm
    guess = _Guess(along, normal, float((start + end) @ along) / 2.0, float((start + end) @ normal) / 2.0, 0.0)
    found = _found_edge(samples, guess, mouths, float(np.hypot(*(end - start))) / 2.0 - _CORNER_MM, band_mm)
    if isinstance(found, str):
        return found
    line, why = found.line, _doubt(found.line, guess, samples, float(np.hypot(*(end - start))))
    if why:
        return why
    place = along * line.middle_mm + normal * line.offset_mm
    beyond_mm = found.zone_mm / 2.0 + _taken_in(samples, place, normal, band_mm) + samples.wider_mm
    covariance = found.fit.covariance.copy()
    covariance[0, 0] += (samples.pitch_mm * _LEAST_U_PITCHES) ** 2 + found.blind_mm**2 / 12.0
    # Anything from nothing to all of these is as likely.
    spans_mm = found.zone_mm, _lost_at_rims(samples, mouths, normal, band_mm), 2.0 * samples.wider_mm
    return EdgeLine(
        normal,
        along,
        line.offset_mm - beyond_mm,
        line.turn,
        line.middle_mm,
        covariance,
        float(np.linalg.norm(spans_mm) / np.sqrt(12.0)),
        found.strips.seen,
        found.fit.scatter,
        _chips(found.strips, found.fit, line.middle_mm),
    )


@dataclass(frozen=True, eq=False)
class _FoundEdge:
    line: _Guess
    strips: _Strips
    fit: _Line
    zone_mm: float
    blind_mm: float


def _found_edge(
    samples: FaceSamples, line: _Guess, mouths: KnownMouths, half_mm: float, band_mm: float
) -> _FoundEdge | str:
    """The line on which the face ends: looked for in wide strips, then in narrow ones about what these give."""
    fine_mm = max(_REACH_MM, _REACH_PITCHES * samples.pitch_mm)
    found: _FoundEdge | str = _OUT_OF_PICTURE
    for reach_mm, pitches in ((_FIRST_REACH_MM, 3.0), (fine_mm, 1.0), (fine_mm, 1.0)):
        step = pitches * samples.pitch_mm
        s, d, height = _across(samples, line, mouths, half_mm, reach_mm, step)
        strips = _ends(s, d, np.abs(height) < band_mm, half_mm, reach_mm, step)
        if isinstance(strips, str):
            return strips
        fit = _line(strips, step)
        if isinstance(fit, str):
            return fit
        line = replace(line, offset_mm=line.offset_mm + fit.offset, turn=line.turn + fit.turn)
        off = d - fit.offset - fit.turn * s
        zone_mm = _mixed_zone(off, height, band_mm, samples.pitch_mm)
        found = _FoundEdge(line, strips, fit, zone_mm, _blind_mm(off, samples.pitch_mm))
        if pitches == 1.0 and abs(fit.offset) < _SETTLED_PITCHES * samples.pitch_mm:
            break
    return found


def _doubt(line: _Guess, guess: _Guess, samples: FaceSamples, length_mm: float) -> str:
    """What speaks against a line being the edge of the foot; empty where nothing does."""
    if abs(line.turn) * length_mm > _MOST_ASKEW_MM:
        return "what ends the face here runs askew to the section: something hides a part of it"
    if samples.eye is None and abs(line.offset_mm - guess.offset_mm) > _MOST_OFF_MM:
        return "a cloud without its camera does not tell an edge of the foot from the border of the picture"
    return ""


@dataclass(frozen=True, eq=False)
class _Guess:
    """Where an edge is thought to be: x @ normal = offset_mm + turn · (x @ along − middle_mm)."""

    along: Array
    normal: Array
    middle_mm: float
    offset_mm: float
    turn: float


def _looks_past(samples: FaceSamples, place: Array, normal: Array) -> bool:
    """Whether what lies beyond an edge is not the side of the block itself."""
    return samples.eye is not None and bool(samples.slope_at(place) @ normal >= 0.0)


def _across(
    samples: FaceSamples, line: _Guess, mouths: KnownMouths, half_mm: float, reach_mm: float, step: float
) -> tuple[Array, Array, Array]:
    """Places (n,) along a line and beyond it, mm, but for those in mouths, and the heights of what returned there."""
    s, d = np.meshgrid(np.arange(-half_mm, half_mm, step), np.arange(-reach_mm - step, reach_mm + 1.5 * step, step))
    s, d = s.ravel(), d.ravel()
    asked = samples.ask(
        np.outer(line.middle_mm + s, line.along) + np.outer(line.offset_mm + line.turn * s + d, line.normal)
    )
    s = asked.xy @ line.along - line.middle_mm
    d = asked.xy @ line.normal - line.offset_mm - line.turn * s
    wanted = (np.abs(s) < half_mm) & (np.abs(d) < reach_mm)
    for centre, radius in zip(mouths.centres, mouths.radii.tolist(), strict=True):
        if abs(float(centre @ line.normal) - line.offset_mm) < reach_mm + radius + _ABOUT_MOUTH_MM:
            wanted &= np.hypot(*(asked.xy - centre).T) > radius + _ABOUT_MOUTH_MM
    return s[wanted], d[wanted], asked.height[wanted]


def _blind_mm(off: Array, pitch_mm: float) -> float:
    """The widest gap, mm, between distances from an edge at which anything was asked, next to it.

    Rows of pixels that run along an edge all lie on one side of it or the other: how far, nobody knows.
    """
    near = np.sort(off[np.abs(off) < _BLIND_PITCHES * pitch_mm])
    return float(np.diff(near).max(initial=0.0)) if len(near) else 0.0


def _mixed_zone(d: Array, height: Array, band_mm: float, pitch_mm: float) -> float:
    """How far before its last returns (d = 0) a face begins to scatter or bend, mm; 0 for one that ends as it is."""
    on = np.abs(height) < band_mm
    inner = on & (d < -_INNER_PITCHES[0] * pitch_mm) & (d > -_INNER_PITCHES[1] * pitch_mm)
    if inner.sum() < _FEWEST_PLACES or not height[inner].any():
        return 0.0  # cells of a cloud have no heights
    middle = float(np.median(height[inner]))
    usual = float(np.median(np.abs(height[inner] - middle)))
    step = _ZONE_STEP_PITCHES * pitch_mm
    begin = 0.0
    for k in range(int(_ZONE_PITCHES / _ZONE_STEP_PITCHES)):
        there = on & (d <= -k * step) & (d > -(k + 1) * step)
        if there.sum() < _FEWEST_PLACES or np.median(np.abs(height[there] - middle)) < _DISTURBED * usual:
            break
        begin = (k + 1) * step
    return begin


def _ends(s: Array, d: Array, on: BoolArray, half_mm: float, reach_mm: float, step: float) -> _Strips | str:
    """Where the face ends in strips of places (n,) along (s) and across (d) an edge; or why nobody can tell."""
    count = max(int(2.0 * half_mm / (_STRIP_PITCHES * step)), _FEWEST_STRIPS)
    strip = np.clip(((s + half_mm) / (2.0 * half_mm) * count).astype(np.int64), 0, count - 1)
    within, without = d < -_WITHIN_SHARE * reach_mm, d > _WITHIN_SHARE * reach_mm
    asked_within, asked_without, on_within, on_without = (
        np.bincount(strip[chosen], minlength=count) for chosen in (within, without, on & within, on & without)
    )
    quarter = 0.5 * (1.0 - _WITHIN_SHARE) * 2.0 * reach_mm * (2.0 * half_mm / count) / step**2
    share = on_within / np.maximum(asked_within, 1)
    usable = (asked_within > _ASKED_MIN * quarter) & (share > _FOUND_MIN)
    if usable.sum() < max(_FEWEST_STRIPS, _SEEN_MIN * count):
        return _OUT_OF_PICTURE
    found = float(np.median(share[usable]))
    flush = float(np.median((on_without / np.maximum(asked_without, 1))[usable]))
    if flush > _FLUSH_MAX * found:
        return "something lies flush with the face beyond this edge"
    farthest = np.full(count, -reach_mm)
    np.maximum.at(farthest, strip, d)
    end = _likeliest_ends(strip, d, on, count, found, flush)
    # A strip that the picture's border cuts before the edge tells nothing of it.
    usable &= np.nan_to_num(end, nan=np.inf) < farthest - _BEYOND_STEPS * step
    if usable.sum() < max(_FEWEST_STRIPS, _SEEN_MIN * count):
        return _OUT_OF_PICTURE
    along = -half_mm + (np.arange(count) + 0.5) * 2.0 * half_mm / count
    bare = (asked_within > _ASKED_MIN * quarter) & (share <= _FOUND_MIN)
    return _Strips(along[usable], end[usable], float(usable.mean()), along[bare], reach_mm, 2.0 * half_mm / count)


def _likeliest_ends(strip: IntArray, d: Array, on: BoolArray, count: int, found: float, flush: float) -> Array:
    """Where each strip (k,) most likely ends, mm: face before it is found with one chance, beyond it with another.

    The middle between the two places that the end lies between; NaN for a strip without places.
    """
    inside, outside = min(found, 1.0 - _LEAST_CHANCE), max(flush, _LEAST_CHANCE)
    order = np.lexsort((d, strip))
    gain = np.where(on[order], np.log(inside / outside), np.log((1.0 - inside) / (1.0 - outside)))
    begin = np.searchsorted(strip[order], np.arange(count + 1))
    before = np.concatenate([[0.0], np.cumsum(gain)])
    sorted_d = d[order]
    end = np.full(count, np.nan)
    for k, (first, last) in enumerate(pairwise(begin.tolist())):
        if last - first > 1:
            best = first + int(np.argmax(before[first + 1 : last]))
            end[k] = (sorted_d[best] + sorted_d[best + 1]) / 2.0
    return end


@dataclass(frozen=True, eq=False)
class _Line:
    offset: float
    turn: float
    covariance: Array
    scatter: float
    residual: Array


def _line(strips: _Strips, pitch_mm: float) -> _Line | str:
    """A line through the ends of strips, by Tukey's weights: chips and what sticks to an edge do not move it."""
    design = np.column_stack([np.ones_like(strips.along), strips.along])
    residual = strips.end - design @ _outermost(strips, pitch_mm)
    normal, scatter = design.T @ design, 0.0
    for _ in range(_ROUNDS):
        scatter = max(1.4826 * float(np.median(np.abs(residual))), _LEAST_SCATTER_PITCHES * pitch_mm)
        weight = np.maximum(1.0 - (residual / (_TUKEY * scatter)) ** 2, 0.0) ** 2
        normal = design.T @ (weight[:, None] * design)
        found = np.linalg.solve(normal, design.T @ (weight * strips.end))
        residual = strips.end - design @ found
    if np.mean(residual > -_TUKEY * scatter) < _SEEN_MIN or scatter > _ROUGHEST_MM:
        return "this edge is not straight, or something hides a part of it"
    covariance = (_NEIGHBOURS * scatter) ** 2 * np.linalg.inv(normal)
    return _Line(float(found[0]), float(found[1]), covariance, scatter, residual)


def _outermost(strips: _Strips, pitch_mm: float) -> Array:
    """Offset and turn (2,) of the line on which many strips end and beyond which few do.

    Whatever hides a part of a face, a border of the projector's field for one, ends it too early and never too late.
    """
    some = np.unique(np.linspace(0, len(strips.along) - 1, _STARTS).astype(int))
    first, second = (some[side] for side in np.triu_indices(len(some), k=1))
    turn = (strips.end[second] - strips.end[first]) / (strips.along[second] - strips.along[first])
    offset = strips.end[first] - turn * strips.along[first]
    off = (strips.end - offset[:, None] - turn[:, None] * strips.along) / (_LIKE_PITCHES * pitch_mm)
    score = (np.abs(off) < 1.0).sum(axis=1) - _BEYOND_COST * (off > 1.0).sum(axis=1)
    best = int(np.argmax(score))
    return np.array([offset[best], turn[best]])


def _chips(strips: _Strips, fit: _Line, middle_mm: float) -> tuple[Chip, ...]:
    """Runs of strips that end before the edge; one that shows no face at all is as deep as was looked, at least."""
    depth = np.concatenate([-fit.residual, np.full(len(strips.bare), strips.reach_mm)])
    along = np.concatenate([strips.along, strips.bare])
    order = np.argsort(along)
    along, depth = along[order], depth[order]
    missing = depth > max(_CHIP_MM, _CHIP_SIGMAS * fit.scatter)
    bounds = np.flatnonzero(np.diff(np.concatenate([[False], missing, [False]]).astype(np.int8)))
    return tuple(
        Chip(
            middle_mm + float(along[first]) - strips.width_mm / 2.0,
            middle_mm + float(along[last - 1]) + strips.width_mm / 2.0,
            float(depth[first:last].max()),
        )
        for first, last in zip(bounds[::2], bounds[1::2], strict=True)
    )


def _taken_in(samples: FaceSamples, place: Array, normal: Array, band_mm: float) -> float:
    """How far, mm, beyond an edge at a place (2,) lines of sight still find the wall behind it within the band."""
    return band_mm * max(-float(samples.slope_at(place) @ normal), 0.0)


def _lost_at_rims(samples: FaceSamples, mouths: KnownMouths, normal: Array, band_mm: float) -> float:
    """By how much, mm, the face ends before the rims of mouths that end it towards a direction; 0 if it does not."""
    lost = []
    nearest = np.argsort(-mouths.centres @ normal, kind="stable")[:_RIMS]
    for centre, radius in zip(mouths.centres[nearest], mouths.radii[nearest].tolist(), strict=True):
        end = _rim_end(samples, centre, radius, normal, band_mm)
        if end is not None:
            lost.append(end - radius + _taken_in(samples, centre - radius * normal, normal, band_mm))
    return max(float(np.median(lost)), 0.0) if lost else samples.pitch_mm


def _rim_end(samples: FaceSamples, centre: Array, radius_mm: float, normal: Array, band_mm: float) -> float | None:
    """Distance from the centre at which the face ends at a rim, in the sector that ends it towards ``normal``."""
    step = samples.pitch_mm
    reach_mm = min(_RIM_REACH_MM, 0.45 * radius_mm)
    span = np.arange(-radius_mm - reach_mm - step, radius_mm + reach_mm + 1.5 * step, step)
    x, y = np.meshgrid(span, span)
    about = np.column_stack([x.ravel(), y.ravel()])
    about = about[_in_sector(about, radius_mm, reach_mm + step, normal)]
    asked = samples.ask(centre + about)
    about = asked.xy - centre
    wanted = _in_sector(about, radius_mm, reach_mm, normal)
    distance, on = np.hypot(*about[wanted].T), np.abs(asked.height[wanted]) < band_mm
    if len(on) < _FEWEST_PLACES:
        return None
    # Each ring counts alike, whatever its length.
    weight = 1.0 / distance
    outer = distance > radius_mm + _WITHIN_SHARE * reach_mm
    inner = distance < radius_mm - _WITHIN_SHARE * reach_mm
    found, stray = on[outer].mean(), on[inner].mean()
    if found < _FOUND_MIN or stray > _FLUSH_MAX:
        return None
    share = ((weight @ on) / weight.sum() - stray) / (found - stray)
    return float(radius_mm + reach_mm - 2.0 * reach_mm * share)


def _in_sector(about: Array, radius_mm: float, reach_mm: float, normal: Array) -> BoolArray:
    distance = np.hypot(*about.T)
    near = np.abs(distance - radius_mm) < reach_mm
    return np.asarray(near & (-about @ normal > np.cos(_RIM_SECTOR) * distance))
