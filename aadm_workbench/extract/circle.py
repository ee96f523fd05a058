"""First circles through the outlines of several features at once: robust, and steady where half of one is spoilt.

Outlines of holes and discs: of each feature and each angular bin about it, the one point next to the edge. Where the
camera's position is known, a point *behind* a surface tells as much about the surface's edge as a point on it: the ray
to it crossed the surface's plane where there is no surface. Pixels lost at the depth step widen the bracket between the
two and do not shift it.

Points of several features in the plan, one feature after the other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray

AGREES_MM = 0.8
"""Outline points this near to a circle agree with it."""

# a quarter of what the best camera errs by (docs/method.md, 2.5): these circles are only where fits start
_SETTLED_MM = 5e-3
_ROUNDS, _STEPS = 3, 8  # caps: an outline is taken anew about each moved centre; circles settle sooner
# of an outline's points: whole from, worth following from (half a taped mouth has more); half of the fewest bins
_AGREEING_SHARE, _SOUND_SHARE, _FEWEST = 0.75, 0.3, 12
_MISFIT_MM = 0.5  # residual at which a point counts half in the first fit
# most of an outline, within what ribs and noise do to it, says that it has another size: a choice, not tuned since
_ROUND_WITHIN_MM, _ROUND_SHARE = 0.5, 0.5
# of each outline; chords over an eighth, a sixth and a quarter of them, so that most stay within its sound part
_CHORD_POINTS, _CHORD_PARTS = 48, (8, 6, 4)

# six to a quarter of the smallest circle; half a degree, which is finer than pixels on mouths of up to 50 mm
_FEWEST_BINS, _MOST_BINS = 24, 720


def circles_through(shape: Outlines, centre: Array, radius_mm: float) -> tuple[Array, Array]:
    """Robust circles of free radius through outlines: centres (k, 2) and radii (k,) mm.

    Gauss-Newton on the distances with Cauchy weights, so that a chip, a rib or a tape on a small part of
    an outline hardly pulls it. Outlines of less than five points stay where they are.
    """
    radius = np.full(len(centre), radius_mm)
    enough = shape.seen.sum(axis=1) >= 5  # three fix a circle, two more tell whether it is one
    for _ in range(_STEPS):
        about = shape.xy - centre[:, None]
        distance = np.maximum(np.sqrt(np.einsum("kmi,kmi->km", about, about)), 1e-9)
        residual = distance - radius[:, None]
        off = (residual - _middle(residual, shape.seen)[:, None]) / _MISFIT_MM
        weight = shape.seen / (1.0 + off * off)
        jacobian = np.concatenate([about / distance[..., None], np.ones((*distance.shape, 1))], axis=2)
        weighted = (jacobian * weight[..., None]).transpose(0, 2, 1)
        normal = weighted @ jacobian + (1e-9 * shape.bins + ~enough[:, None, None]) * np.eye(3)
        step = np.linalg.solve(normal, weighted @ residual[..., None])[..., 0] * enough[:, None]
        step[:, :2] = np.clip(step[:, :2], -radius_mm, radius_mm)
        centre, radius = centre + step[:, :2], radius + step[:, 2]
        if np.abs(step).max(initial=0.0) < _SETTLED_MM:
            break
    return centre, radius


def settled_centres(
    points: PlanPoints,
    centre: Array,
    radius_mm: float,
    bins: int,
    zone_mm: tuple[float, float],
    *,
    innermost: bool,
    others_mm: tuple[float, ...] = (),
) -> tuple[Array, BoolArray]:
    """First centres (k, 2) of outlines among points, near a guess (k, 2), and which are round with another radius (k,).

    ``zone_mm``: an outline is sought between these distances from its centre. Where less than three quarters of
    it agree with the radius, something spoils a part of it, and the centre is that of the part that agrees. What is
    round with a radius that is nearer to one of ``others_mm`` is a feature of another size.
    """
    moving, other = np.ones(len(centre), bool), np.zeros(len(centre), bool)
    shape = Outlines(np.zeros((len(centre), bins, 2)), np.zeros((len(centre), bins), bool))
    for _ in range(_ROUNDS):
        shape = _outlined(points, centre, bins, zone_mm, innermost=innermost)
        moved, radius = circles_through(shape, centre, radius_mm)
        other = _of_another_size(shape, moved, radius, radius_mm, others_mm)
        step = np.hypot(*(moved - centre).T)
        moving &= (step < radius_mm) & (shape.seen.sum(axis=1) >= _FEWEST)
        centre = np.where(moving[:, None], moved, centre)
        if step[moving].max(initial=0.0) < 10 * _SETTLED_MM:
            break
    shown = shape.seen.sum(axis=1) >= _FEWEST
    spoilt = shown & (agreeing_shares(shape, centre, radius_mm) <= _AGREEING_SHARE)
    if spoilt.any():
        centre = _on_sound_parts(points, shape, centre, radius_mm, zone_mm, spoilt, innermost=innermost)
    return centre, other


def _of_another_size(
    shape: Outlines, centre: Array, radius: Array, radius_mm: float, others_mm: tuple[float, ...]
) -> BoolArray:
    """Which (k,) outlines are those of round things whose radius is nearer to another size than to this one."""
    if not others_mm:
        return np.zeros(len(centre), bool)
    off = np.abs(np.log(np.maximum(radius[:, None], 1e-3) / np.array([radius_mm, *others_mm])))
    round_ = agreeing_shares(shape, centre, radius, _ROUND_WITHIN_MM) > _ROUND_SHARE
    return np.asarray((off.argmin(axis=1) > 0) & round_)


def agreeing_shares(shape: Outlines, centre: Array, radius_mm: float | Array, within_mm: float = AGREES_MM) -> Array:
    """Share (k,) of outline points that lie on a circle, or that near to it."""
    off_mm = np.abs(shape.distance(centre) - np.reshape(radius_mm, (-1, 1)))
    return np.asarray((shape.seen & (off_mm < within_mm)).sum(axis=1) / np.maximum(shape.seen.sum(axis=1), 1))


def circles_of_radius(shape: Outlines, radius_mm: float, within_mm: float) -> tuple[Array, Array]:
    """Circles of a known radius that most of each outline lies on: centres (k, 2) and that share (k,).

    Each pair of points gives two circles; where a tape or a break spoils half of an outline, the other half agrees.
    Every outline has to show a point.
    """
    count = shape.seen.sum(axis=1)
    order = np.argsort(~shape.seen, axis=1, kind="stable")
    rank = (np.arange(_CHORD_POINTS) * count[:, None]) // _CHORD_POINTS
    chosen = np.take_along_axis(order, rank, axis=1)
    thin = np.take_along_axis(shape.xy, chosen[..., None], axis=1)
    other = np.concatenate([np.roll(thin, -_CHORD_POINTS // part, axis=1) for part in _CHORD_PARTS], axis=1)
    first = np.tile(thin, (1, len(_CHORD_PARTS), 1))
    chord = other - first
    length = np.sqrt(np.einsum("kci,kci->kc", chord, chord))
    usable = (length > 1e-6) & (length < 2 * radius_mm)
    height = np.sqrt(np.where(usable, radius_mm**2 - (0.5 * length) ** 2, 0.0))
    across = np.stack([-chord[..., 1], chord[..., 0]], -1) * (height / np.maximum(length, 1e-6))[..., None]
    middle = first + 0.5 * chord
    centres = np.concatenate([middle + across, middle - across], axis=1)
    x, y = (np.float32(centres[..., axis, None]) - np.float32(thin[:, None, :, axis]) for axis in (0, 1))
    agree = (np.abs(np.sqrt(x * x + y * y) - np.float32(radius_mm)) < within_mm).sum(axis=2)
    agree = np.where(np.tile(usable, (1, 2)), agree, 0)
    features = np.arange(len(centres))
    best = agree.argmax(axis=1)
    return centres[features, best], agree[features, best] / _CHORD_POINTS


def _on_sound_parts(
    points: PlanPoints,
    shape: Outlines,
    centre: Array,
    radius_mm: float,
    zone_mm: tuple[float, float],
    spoilt: BoolArray,
    *,
    innermost: bool,
) -> Array:
    for _ in range(2):
        moved, share = circles_of_radius(shape.of(spoilt), radius_mm, AGREES_MM)
        better = (share >= _SOUND_SHARE) & (np.hypot(*(moved - centre[spoilt]).T) <= radius_mm)
        spoilt = spoilt.copy()
        spoilt[spoilt] = better
        centre = centre.copy()
        centre[spoilt] = moved[better]
        if not spoilt.any():
            break
        shape = _outlined(points, centre, shape.bins, zone_mm, innermost=innermost)
        spoilt &= shape.seen.any(axis=1)
    return centre


def _outlined(
    points: PlanPoints, centre: Array, bins: int, zone_mm: tuple[float, float], *, innermost: bool
) -> Outlines:
    within = points.distance(centre)
    return outlines(points.where((within > zone_mm[0]) & (within < zone_mm[1])), centre, bins, innermost=innermost)


def _middle(values: Array, seen: BoolArray) -> Array:
    """Median (k,) of what is there in each row; zero in empty ones."""
    count = seen.sum(axis=1)
    ordered = np.sort(np.where(seen, values, np.inf), axis=1)
    places = np.stack([(count - 1) // 2, count // 2], axis=1).clip(0)
    middle = np.take_along_axis(ordered, places, axis=1).mean(axis=1)
    return np.where(count > 0, middle, 0.0)


@dataclass(frozen=True, eq=False)
class PlanPoints:
    """Points ``x``, ``y`` (n,) mm, each about the place of its feature: ``owner`` (n,), sorted, of so many features."""

    x: FloatArray
    y: FloatArray
    owner: IntArray
    features: int

    @classmethod
    def of(cls, x: FloatArray, y: FloatArray, chosen: IntArray) -> PlanPoints:
        """Some entries (n,) - indices into the flattened arrays - of x and y (k, m)."""
        return cls(x.ravel()[chosen], y.ravel()[chosen], chosen // x.shape[1], len(x))

    def where(self, wanted: BoolArray) -> PlanPoints:
        """Some of the points (n,)."""
        return PlanPoints(self.x[wanted], self.y[wanted], self.owner[wanted], self.features)

    def distance(self, centre: Array) -> FloatArray:
        """Distance (n,) mm of each point from the centre (k, 2) of its feature."""
        x, y = self._about(centre)
        return np.asarray(np.sqrt(x * x + y * y))

    def bins(self, centre: Array, bins: int) -> IntArray:
        """Angular bin (n,) of each point about the centre (k, 2) of its feature."""
        x, y = self._about(centre)
        turn = np.arctan2(y, x) * (0.5 / np.pi) + 0.5
        return np.minimum((turn * bins).astype(np.int64), bins - 1)

    def _about(self, centre: Array) -> tuple[FloatArray, FloatArray]:
        x, y = np.ascontiguousarray(centre.T, self.x.dtype)
        return self.x - x[self.owner], self.y - y[self.owner]

    def counted(self, wanted: BoolArray) -> IntArray:
        """How many of some points each feature has (k,)."""
        return np.bincount(self.owner[wanted], minlength=self.features)


def thinned_rows(owner: IntArray, features: int, count_max: int) -> IntArray:
    """Which of the points of each feature (sorted owners (n,)) to take, evenly, so that none has more than so many."""
    counts = np.bincount(owner, minlength=features)
    return np.flatnonzero(ranks(owner, features) % (counts // count_max + 1)[owner] == 0)


def ranks(owner: IntArray, features: int) -> IntArray:
    """Place (n,) of each point among those of its feature (sorted owners (n,))."""
    counts = np.bincount(owner, minlength=features)
    return np.asarray(np.arange(len(owner)) - (np.cumsum(counts) - counts)[owner])


def in_rows(values: FloatArray, owner: IntArray, features: int) -> tuple[Array, BoolArray]:
    """Values (n, ...) with sorted owners (n,) as rows (k, m, ...) float64, zero-padded, and which are there (k, m)."""
    place = ranks(owner, features)
    longest = int(place.max(initial=-1)) + 1
    rows = np.zeros((features, longest, *values.shape[1:]))
    seen = np.zeros((features, longest), bool)
    rows[owner, place] = values
    seen[owner, place] = True
    return rows, seen


@dataclass(frozen=True, eq=False)
class Outlines:
    """Of k features, per angular bin: the point ``xy`` (k, bins, 2) mm, float64, and whether there is one, ``seen``."""

    xy: Array
    seen: BoolArray

    @property
    def coverage(self) -> Array:
        """Share (k,) of each circle's bins that hold a point."""
        return np.asarray(self.seen.mean(axis=1))

    @property
    def bins(self) -> int:
        """Number of bins of a circle."""
        return int(self.seen.shape[1])

    def distance(self, centre: Array) -> Array:
        """Distance (k, bins) mm of each point from the centre (k, 2) of its feature."""
        about = self.xy - centre[:, None]
        return np.asarray(np.sqrt(about[..., 0] ** 2 + about[..., 1] ** 2))

    def only(self, wanted: BoolArray) -> Outlines:
        """The same with fewer bins (k, bins)."""
        return Outlines(self.xy, self.seen & wanted)

    def of(self, features: BoolArray) -> Outlines:
        """The outlines of some of the features (k,)."""
        return Outlines(self.xy[features], self.seen[features])


def bins_for(radius_mm: float, pitch_mm: float) -> int:
    """About one bin for each point on a circle."""
    return int(np.clip(2 * np.pi * radius_mm / pitch_mm, _FEWEST_BINS, _MOST_BINS))


def outlines(points: PlanPoints, centre: Array, bins: int, *, innermost: bool) -> Outlines:
    """Take, of the points in each bin about a feature's centre (k, 2), the one nearest to it, or the farthest one."""
    radius = points.distance(centre)
    cell = points.owner * bins + points.bins(centre, bins)
    extreme = np.full(points.features * bins, np.inf if innermost else -np.inf, radius.dtype)
    (np.minimum if innermost else np.maximum).at(extreme, cell, radius)
    chosen = np.flatnonzero(radius == extreme[cell])
    xy = np.zeros((len(extreme), 2))
    xy[cell[chosen], 0], xy[cell[chosen], 1] = points.x[chosen], points.y[chosen]
    return Outlines(xy.reshape(-1, bins, 2), np.isfinite(extreme).reshape(-1, bins))
