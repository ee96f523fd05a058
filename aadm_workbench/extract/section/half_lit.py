"""How far beyond an edge a camera that mixes what a pixel sees still finds the face, told by how its heights scatter.

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
from scipy.special import ndtr

from aadm_workbench.model import Array, Reason
from aadm_workbench.model.scatter import TO_SIGMA

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
    level = float(np.median(inner))
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
    middle = float(np.median(beyond))
    u_mm = float(np.median([one.u_mm for one in own]))
    if len(own) < 3:
        apart = _ONE_ALONE_PITCHES * pitch_mm
    else:
        apart = TO_SIGMA * float(np.median(np.abs(beyond - middle))) / float(np.sqrt(len(own)))
    return Overshoot(middle, float(np.hypot(u_mm, apart)))


def _is_sound(over: Array, usual: float) -> bool:
    """Whether heights over the face's level neither scatter more than usual nor are bent."""
    return TO_SIGMA * float(np.median(np.abs(over))) < _DISTURBED * usual


def _scatter(height: Array) -> float:
    return TO_SIGMA * float(np.median(np.abs(height - np.median(height))))


def _level(place: Array, height: Array) -> Array:
    """Heights without their slope across the edge: heights of pixels that are lit in part bend, too."""
    near = place < np.median(place)
    if near.all() or not near.any():
        return height
    run = float(place[~near].mean() - place[near].mean())
    slope = float(np.median(height[~near]) - np.median(height[near])) / run
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
