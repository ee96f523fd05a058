"""Strips across an edge: where the face ends in each, the line through all of them, and where pieces are missing.

A strip is face up to the edge and nothing beyond. Where it most likely ends follows from all its places, however many a
camera loses; chips and whatever hides a part of a face end strips too early, and never too late.

How far beyond an edge a camera that mixes what a pixel sees still finds the face, told by how its heights scatter.

A pixel of which a share is lit has that share of the light to tell a depth by, and all of the camera's noise: its
heights scatter by one over that share as much. The share falls across an edge as the normal law does, some part of a
pixel wide, and is a half on the edge itself. So the edge lies where heights scatter twice as much as on the face
before it, whatever the camera drops beyond. A camera that does not mix scatters no more to the end.

What keeps a pixel bright (a longer exposure for the dark ones, light from beyond) lets heights scatter less on single
sides of the face, and nothing lets them scatter less on all: the sides' median is the camera's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, BoolArray, IntArray, Reason
from aadm_workbench.model.measured import TO_SIGMA
from aadm_workbench.model.special import distinct, median, ndtr

_STRIP_PITCHES = 6.0  # along the edge: some fifty places tell where a strip ends, and a chip of 5 mm fills one
_FEWEST_STRIPS = 8  # of fewer a line has no scatter
_WITHIN_SHARE = 0.5  # of the strip on the side of the face: how densely it is found there
_ASKED_MIN, _BEYOND_STEPS = 0.7, 3.0  # of the inner quarter of a strip; places beyond the edge where no face was found
_LEAST_CHANCE = 0.02  # flying pixels, lost ones: nothing is quite sure
_FOUND_MIN, _FLUSH_MAX = 0.25, 0.15  # thinner is no face; denser is something that goes on beyond the edge
_SEEN_MIN = 0.5  # of the strips of an edge: half of one may be out of the picture or behind something
_TUKEY, _ROUNDS = 4.0, 8  # of the scatter; rounds settle in four
_SETTLED_PITCHES = 0.002  # a micrometre: what a line still moves by from round to round
_STARTS, _LIKE_PITCHES, _BEYOND_COST = 14, 1.5, 2.0  # some hundred lines are tried; of strips on a line; of one beyond
_ROUGHEST_MM = 1.5  # of strips: an edge that is broken all along is none
_LEAST_SCATTER_PITCHES = 0.29  # 1/√12: a strip along rows of pixels ends anywhere between two of them
_CHIP_MM, _CHIP_SIGMAS = 1.5, 5.0  # from which depth on a gap in an edge is a chip and no scatter
OUT_OF_PICTURE = Reason("extract.section_out")


@dataclass(frozen=True, eq=False)
class Chip:
    """Where concrete is missing at an edge: from ``begin_mm`` to ``end_mm`` along it, ``depth_mm`` deep at least."""

    begin_mm: float
    end_mm: float
    depth_mm: float


@dataclass(frozen=True, eq=False)
class Strips:
    """Strips (k,) across an edge: their places along it, and where in each the face ends, mm.

    ``bare`` (m,) are the places of strips that show no face at all within ``reach_mm`` of the edge.
    """

    along: Array
    end: Array
    seen: float
    bare: Array
    reach_mm: float
    width_mm: float


def ends_of_strips(
    s: Array, d: Array, on: BoolArray, half_mm: float, reach_mm: float, steps_mm: tuple[float, float]
) -> Strips | Reason:
    """Where the face ends in strips of places (n,) along (s) and across (d) an edge; or why nobody can tell.

    Parameters
    ----------
    steps_mm
        Between places, along and across.
    """
    step = steps_mm[1]
    count = max(int(2.0 * half_mm / (_STRIP_PITCHES * step)), _FEWEST_STRIPS)
    strip = np.clip(((s + half_mm) / (2.0 * half_mm) * count).astype(np.int64), 0, count - 1)
    within, without = d < -_WITHIN_SHARE * reach_mm, d > _WITHIN_SHARE * reach_mm
    asked_within, asked_without, on_within, on_without = (
        np.bincount(strip[chosen], minlength=count) for chosen in (within, without, on & within, on & without)
    )
    quarter = 0.5 * (1.0 - _WITHIN_SHARE) * 2.0 * reach_mm * (2.0 * half_mm / count) / (steps_mm[0] * step)
    share = on_within / np.maximum(asked_within, 1)
    usable = (asked_within > _ASKED_MIN * quarter) & (share > _FOUND_MIN)
    if usable.sum() < max(_FEWEST_STRIPS, _SEEN_MIN * count):
        return OUT_OF_PICTURE
    found = float(median(share[usable]))
    flush = float(median((on_without / np.maximum(asked_without, 1))[usable]))
    if flush > _FLUSH_MAX * found:
        return Reason("extract.section_flush")
    farthest = np.full(count, -reach_mm)
    np.maximum.at(farthest, strip, d)
    end = _likeliest_ends(strip, d, on, count, found, flush)
    # A strip that the picture's border cuts before the edge tells nothing of it.
    usable &= np.nan_to_num(end, nan=np.inf) < farthest - _BEYOND_STEPS * step
    if usable.sum() < max(_FEWEST_STRIPS, _SEEN_MIN * count):
        return OUT_OF_PICTURE
    along = -half_mm + (np.arange(count) + 0.5) * 2.0 * half_mm / count
    bare = (asked_within > _ASKED_MIN * quarter) & (share <= _FOUND_MIN)
    return Strips(along[usable], end[usable], float(usable.mean()), along[bare], reach_mm, 2.0 * half_mm / count)


def _likeliest_ends(strip: IntArray, d: Array, on: BoolArray, count: int, found: float, flush: float) -> Array:
    """Where each strip (k,) most likely ends, mm: face before it is found with one chance, beyond it with another.

    The middle between the two places that the end lies between; NaN for a strip without places.
    """
    inside, outside = min(found, 1.0 - _LEAST_CHANCE), max(flush, _LEAST_CHANCE)
    # One key for both: places of a strip in their order across, strip after strip.
    span = float(np.ptp(d)) + 1.0 if len(d) else 1.0
    order = np.argsort(strip * (2.0 * span) + d, kind="stable")
    gain = np.where(on[order], np.log(inside / outside), np.log((1.0 - inside) / (1.0 - outside)))
    begin = np.searchsorted(strip[order], np.arange(count + 1))
    usable = np.flatnonzero(np.diff(begin) > 1)
    end = np.full(count, np.nan)
    if len(usable) == 0:
        return end
    after, sorted_d = np.cumsum(gain), d[order]
    after[begin[1:][np.diff(begin) > 0] - 1] = -np.inf  # something must lie beyond an end
    best = np.full(count, np.nan)
    best[usable] = np.maximum.reduceat(after, begin[usable])
    at_best = np.flatnonzero(after == best[strip[order]])
    at = at_best[np.searchsorted(strip[order][at_best], usable)]
    end[usable] = (sorted_d[at] + sorted_d[at + 1]) / 2.0
    return end


@dataclass(frozen=True, eq=False)
class StripLine:
    """The line on which most strips end: offset, mm, and turn, radians, in their axes, with ``covariance`` (2, 2).

    ``residual`` (k,) mm is by how much each strip ends beyond it, ``scatter`` mm that of those on it.
    """

    offset: float
    turn: float
    covariance: Array
    scatter: float
    residual: Array


def line_through(strips: Strips, pitch_mm: float) -> StripLine | Reason:
    """A line through the ends of strips, by Tukey's weights: chips and what sticks to an edge do not move it."""
    design = np.column_stack([np.ones_like(strips.along), strips.along])
    residual = strips.end - design @ _outermost(strips, pitch_mm)
    normal, scatter = design.T @ design, 0.0
    for _ in range(_ROUNDS):
        scatter = max(TO_SIGMA * float(median(np.abs(residual))), _LEAST_SCATTER_PITCHES * pitch_mm)
        weight = np.maximum(1.0 - (residual / (_TUKEY * scatter)) ** 2, 0.0) ** 2
        normal = design.T @ (weight[:, None] * design)
        found = np.linalg.solve(normal, design.T @ (weight * strips.end))
        before, residual = residual, strips.end - design @ found
        if np.abs(residual - before).max() < _SETTLED_PITCHES * pitch_mm:
            break
    if np.mean(residual > -_TUKEY * scatter) < _SEEN_MIN or scatter > _ROUGHEST_MM:
        return Reason("extract.section_hidden")
    covariance = scatter**2 * np.linalg.inv(normal)
    return StripLine(float(found[0]), float(found[1]), covariance, scatter, residual)


def _outermost(strips: Strips, pitch_mm: float) -> Array:
    """Offset and turn (2,) of the line on which many strips end and beyond which few do.

    Whatever hides a part of a face, a border of the projector's field for one, ends it too early and never too late.
    """
    some = distinct(np.linspace(0, len(strips.along) - 1, _STARTS).astype(int))
    first, second = (some[side] for side in np.triu_indices(len(some), k=1))
    turn = (strips.end[second] - strips.end[first]) / (strips.along[second] - strips.along[first])
    offset = strips.end[first] - turn * strips.along[first]
    off = (strips.end - offset[:, None] - turn[:, None] * strips.along) / (_LIKE_PITCHES * pitch_mm)
    score = (np.abs(off) < 1.0).sum(axis=1) - _BEYOND_COST * (off > 1.0).sum(axis=1)
    best = int(np.argmax(score))
    return np.array([offset[best], turn[best]])


def chips_of(strips: Strips, fit: StripLine, middle_mm: float) -> tuple[Chip, ...]:
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


_BEFORE_PITCHES, _BIN_PITCHES = 3.0, 0.25  # looked at before the end of an edge; sharp optics mix over one pixel
_INNER_PITCHES = (4.0, 12.0)  # before an edge: farther than any sharp camera's blur
_FEWEST_PLACES = 30  # of fewer a scatter is known to worse than a sixth
_DISTURBED = 1.4  # of the scatter within: two pixels in three are then lit; bins scatter by a sixth of themselves
_HALF_PITCHES = np.arange(-2.5, 0.41, 0.05)  # from the end; as little lit as disturbed is, a pixel is no farther before
_BLUR_PITCHES = np.geomspace(0.15, 1.8, 12)  # standard deviation of what a pixel sees: from a point to out of focus
_LEAST_SHARE = 0.01  # less light is below what any camera keeps
_LAW = 0.12  # of the logarithm of a scatter: relief and stains bend the law by so much on the scans it was tried on
_ONE_ALONE_PITCHES = 0.25  # a single side may be one that stays bright: by half of a pixel at most, as likely less


@dataclass(frozen=True)
class Overshoot:
    """By how much, mm, the last returns of a face lie beyond its edge, and the standard uncertainty of that."""

    beyond_mm: float
    u_mm: float


def overshoot_of(off: Array, height: Array, band_mm: float, pitch_mm: float) -> Overshoot | Reason | None:
    """How far returns go beyond the edge that they end at; None for a camera that does not mix.

    Parameters
    ----------
    off
        (n,) mm, places across the edge, 0 where most strips end, negative on the face.
    height
        (n,) mm over the face, NaN for nothing.

    Returns
    -------
    Overshoot | Reason | None
        A reason where heights are disturbed all the way that is looked at: the camera is out of focus.
    """
    on = np.abs(height) < band_mm
    place, height = off[on] / pitch_mm, height[on]
    inner = height[(place < -_INNER_PITCHES[0]) & (place > -_INNER_PITCHES[1])]
    if len(inner) < _FEWEST_PLACES or not inner.any():
        return None  # cells of a cloud have no heights
    usual = _scatter(inner)
    begins = np.arange(-_BEFORE_PITCHES, -_BIN_PITCHES / 2.0, _BIN_PITCHES)
    bins = [(place >= begin) & (place < begin + _BIN_PITCHES) for begin in begins]
    kept = [chosen for chosen in bins if chosen.sum() >= _FEWEST_PLACES]
    if not kept or usual <= 0.0:
        return None
    level = float(median(inner))
    if _is_sound(height[kept[-1]] - level, usual):
        return None
    if not any(_is_sound(height[chosen] - level, usual) for chosen in kept):
        return Reason("extract.section_blurred")
    at = np.array([place[chosen].mean() for chosen in kept])
    ratio = np.array([_scatter(_level(place[chosen], height[chosen])) for chosen in kept]) / usual
    half, u = _half_lit(at, np.maximum(ratio, 1.0), np.array([chosen.sum() for chosen in kept]))
    return Overshoot(-half * pitch_mm, u * pitch_mm)


def pooled(found: Sequence[Overshoot | None], pitch_mm: float) -> Overshoot | None:
    """The camera's overshoot from those of the sides of one face; None where most sides show none."""
    own = [one for one in found if one is not None]
    if 2 * len(own) < len(found) or not own:
        return None
    beyond = np.array([one.beyond_mm for one in own])
    middle = float(median(beyond))
    u_mm = float(median([one.u_mm for one in own]))
    if len(own) < 3:
        apart = _ONE_ALONE_PITCHES * pitch_mm
    else:
        apart = TO_SIGMA * float(median(np.abs(beyond - middle))) / float(np.sqrt(len(own)))
    return Overshoot(middle, float(np.hypot(u_mm, apart)))


def _is_sound(over: Array, usual: float) -> bool:
    """Whether heights over the face's level neither scatter more than usual nor are bent."""
    return TO_SIGMA * float(median(np.abs(over))) < _DISTURBED * usual


def _scatter(height: Array) -> float:
    return TO_SIGMA * float(median(np.abs(height - median(height))))


def _level(place: Array, height: Array) -> Array:
    """Heights without their slope across the edge: heights of pixels that are lit in part bend, too."""
    near = place < median(place)
    if near.all() or not near.any():
        return height
    run = float(place[~near].mean() - place[near].mean())
    slope = float(median(height[~near]) - median(height[near])) / run
    return np.asarray(height - slope * (place - place.mean()))


def _half_lit(at: Array, ratio: Array, count: Array) -> tuple[float, float]:
    """Where half of a pixel is lit, pitches from the end, by the law of one over the lit share; and its uncertainty."""
    lit = ndtr((_HALF_PITCHES[:, None, None] - at) / _BLUR_PITCHES[None, :, None])
    off = np.log(ratio) + np.log(np.maximum(lit, _LEAST_SHARE))
    # Of n normal heights the logarithm of a median of absolute deviations varies by 1.36/n.
    doubt = (off**2 / (1.36 / count + _LAW**2)).sum(axis=2)
    chance = np.exp(-(doubt - doubt.min()) / 2.0).sum(axis=1)
    chance /= chance.sum()
    mean = float(chance @ _HALF_PITCHES)
    return mean, float(np.sqrt(chance @ (_HALF_PITCHES - mean) ** 2))
