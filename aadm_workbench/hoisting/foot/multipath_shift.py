"""How far light that bounces inside sleeves pushes their walls: found from where rays pass into the mouths.

Walls show each sleeve to a hundredth of a millimetre, but all of them beside their places by one amount along the
rays, and nothing in the walls tells it. A ray that is stopped by the face, or passes, tells; at grazing incidence one
ray is millimetres from the next, so all rays about all mouths are asked together. For every ray three things are
known: how far behind the face it ended, how far behind it would end on the wall as it appears, and where it crosses the
face. Given the push and the radius of the mouths' edge, it either passes (and ends on the wall, or on a chamfer) or
not; what it returned has a likelihood either way.

How the push sets in behind the rim is the camera's and the concrete's, and nobody knows it: at once, or with depth, as
less or more of the lit wall is near. A push that grows with depth looks like a chamfer that is not there. So several
such laws are asked, and what they leave open between them is part of what is not known.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from aadm_workbench.hoisting.foot.edges import EdgeRays
from aadm_workbench.model import Array, IntArray

_PUSH_REACH_MM, _PUSH_STEP_MM = 1.8, 0.3  # twice the push of the reference camera (0.8 mm) to either side
# none to one and a half times the largest of the reference camera's scenes (1 mm)
_CHAMFER_MM, _CHAMFER_STEP_MM = (0.0, 0.4, 0.8, 1.2, 1.6), 0.3
# times the noise, so that a step of the grid cannot miss the peak; then down to the noise itself
_BLUR, _FINE_BLURS = 3.0, (2.0, 1.5, 1.0)
_NARROWED = 0.55  # from step to step of the fine search: half a step of the last one, and a tenth to spare
# where the average lies: reach of its grid in push plus chamfer and in push less chamfer, three standard deviations of
# what the rays leave possible and more
_MEAN_REACH_MM, _MEAN_GRID = (0.12, 0.05), np.linspace(-1.0, 1.0, 5)
# of the log likelihood: as wide as the floor under what is known of a push (foot/fit.py), 0.02 to 0.04 mm, and not
# as narrow as the steps of single rays; from 3 to 30 pushes move by less than 0.015 mm
_FLATTER = 10.0
# of a sleeve's own push: sleeves of the reference camera's scenes differ by up to 0.4 mm; fine enough for the flatter
# likelihood of so few rays
_OWN_GRID_MM = np.arange(-6, 7) * 0.075
_OWN_FLATTER = 3.0  # u becomes 1.7 times as large: as much as steps of single rays leave unsure
_OWN_LEAST_MM = 0.015  # a fifth of the grid's step: below, it tells nothing
_MEAN_ROUNDS, _STILL_MM = 6, 0.003  # a cap; a tenth of that floor
# what pushes walls is the concrete's and the camera's and not the frame's: frames that follow each other are averaged,
# over no more than this, since the view changes as the column is let down
_AVERAGED_MOST = 8
# in push plus chamfer, which a mouth of which little is open, or one seen flat, leaves open: up to ten times as wide
_SUMS_MM = np.linspace(-0.8, 0.8, 17)
# bounds of the time; farther from the edge than two steps of the grid a ray tells nothing
_COARSE_RAYS, _FINE_RAYS, _NEAR_MM, _NEAR_PITCHES = 1_200, 2_000, 0.7, 0.6
# but for those that pass within the far rim: seen flat, a chamfer stops some of them millimetres before it; of those
# every third tells as much as all (58 frames of wide and small columns)
_WITHIN_EVERY = 3
_TRACKED_EVERY = 2  # of all of them, where the frame before has told: its average is where the next one begins
# depths behind the face, mm, over which a push sets in: at once behind the chamfer, over less than that, and over all
# that a flat view sees of a wall (2 to 5 mm); denser in between, pushes stay within 0.03 mm
_GROWTHS_MM = (0.0, 0.1, 0.3, 1.0, 3.0)
_SOFTNESS = 0.03  # of a pixel: an edge is a step, and softer laws lean to where more rays return
_SOFTNESS_MIN_MM = 0.01  # finer, single rays make the likelihood jump
# of a pixel, on the side where the edge is a step in depth and pixels mix: twice as soft; a choice: ±30 % moves
# centres by up to 1.1 u and u by 3 %
_STEP_SOFTNESS = 0.06
# of rays that end neither on the face nor on the wall, anywhere within so much (a choice: ±30 % moves centres by up
# to 1.0 u)
_STRAY_SHARE, _STRAY_SPAN_MM = 0.12, 8.0
# neighbouring rays share their errors: two tell as much as one; a choice: ±30 % moves centres by up to 0.3 u
_CORRELATION = 2.0


@dataclass(frozen=True, eq=False)
class Push:
    """``push_mm`` of the walls with its ``sigma_mm``; ``chamfer_mm`` by which mouths are wider than bores.

    ``open_mm`` is the standard deviation by which both together may be larger or smaller.
    ``own`` (k,) is how far each sleeve's own rays would move its centre along the view beyond that, with
    ``own_sigma`` (k,). ``law`` is how it sets in, by the likeliest of the laws; ``frames`` were averaged.
    """

    push_mm: float
    sigma_mm: float
    chamfer_mm: float
    open_mm: float
    own: Array
    own_sigma: Array
    law: PushLaw
    frames: int = 1

    def found(self) -> tuple[float, float]:
        """Push and chamfer by the likeliest law alone."""
        return self.push_mm - self.law.more_mm[0], self.chamfer_mm - self.law.more_mm[1]


@dataclass(frozen=True)
class PushLaw:
    """A push that sets in over ``growth_mm`` behind the face (0: at once, behind the chamfer).

    By all laws together push and chamfer are larger by ``more_mm`` (2,), and the push is open by ``open_mm``.
    """

    growth_mm: float
    more_mm: tuple[float, float]
    open_mm: float


def find_push(rays: EdgeRays, radius_mm: float, sleeves: int, prior_mm: float, before: Push | None = None) -> Push:
    """The push and the chamfer that the rays about all mouths tell.

    A coarse search asks some of the rays, a finer one more of those that are near to the edge which that finds, and all
    of these tell where between the points of its grid push and chamfer are. What was found in the frame ``before``
    takes the place of the search.
    """
    best = _coarse(rays, radius_mm, prior_mm) if before is None else before.found()
    near = _telling(rays, best, radius_mm)
    if before is not None:
        return _followed(_in_single(_chosen(rays, near[::_TRACKED_EVERY])), before, radius_mm, sleeves, prior_mm)
    some, rays = _chosen(rays, near[:: len(near) // _FINE_RAYS + 1]), _in_single(_chosen(rays, near))
    told = []
    for growth_mm in _GROWTHS_MM:
        fixed = _fixed(rays, growth_mm)
        start = _fine(some, growth_mm, best, radius_mm, prior_mm)
        push, chamfer, score = _mean(rays, fixed, start, radius_mm, prior_mm, _MEAN_ROUNDS)
        told.append((push, chamfer, score, _left_open(rays, fixed, (push, chamfer), radius_mm, prior_mm)))
    pushes, chamfers, scores, opens = np.array(told).T
    weight = np.exp((scores - scores.max()) / _FLATTER)
    weight /= weight.sum()
    likeliest = int(weight.argmax())
    more = float(weight @ pushes - pushes[likeliest]), float(weight @ chamfers - chamfers[likeliest])
    law_mm = float(np.sqrt(weight @ (pushes - weight @ pushes) ** 2))
    law = PushLaw(_GROWTHS_MM[likeliest], more, law_mm)
    found = float(pushes[likeliest]), float(chamfers[likeliest])
    open_mm = float(np.sqrt(weight @ opens**2))
    return _own(rays, _fixed(rays, law.growth_mm), found, open_mm, law, radius_mm, sleeves, prior_mm)


def _followed(rays: EdgeRays, before: Push, radius_mm: float, sleeves: int, prior_mm: float) -> Push:
    """The push of a frame that follows others: their average with what its own rays tell about it."""
    fixed, best, frames = _fixed(rays, before.law.growth_mm), before.found(), min(before.frames + 1, _AVERAGED_MOST)
    push, chamfer, _ = _mean(rays, fixed, best, radius_mm, prior_mm, 1)
    found = best[0] + (push - best[0]) / frames, best[1] + (chamfer - best[1]) / frames
    own = _own(rays, fixed, found, before.open_mm, before.law, radius_mm, sleeves, prior_mm)
    return replace(own, frames=frames)


def _telling(rays: EdgeRays, best: tuple[float, float], radius_mm: float) -> IntArray:
    """Indices of the rays that tell push and chamfer: near to the edge, and some of those that pass within it."""
    about = rays.about + best[0] * rays.direction
    off_mm = np.hypot(about[:, 0], about[:, 1]) - radius_mm - best[1]
    near = np.abs(off_mm) < _NEAR_MM + _NEAR_PITCHES * rays.pitch
    within = ~near & (off_mm < 0.0) & (np.einsum("ij,ij->i", rays.about, rays.direction) > 0.0)
    near[np.flatnonzero(within)[::_WITHIN_EVERY]] = True
    return np.flatnonzero(near)


def _left_open(rays: EdgeRays, fixed: _Fixed, found: tuple[float, float], radius_mm: float, prior_mm: float) -> float:
    """By how much (standard deviation, mm) push and chamfer may both be larger or smaller.

    Far rims show push less chamfer, sharply; the sum of both is told by few rays about near rims.
    """
    halves = _SUMS_MM / 2.0
    score = np.array(
        [_score(rays, fixed, found[0] + by, max(found[1] + by, 0.0), radius_mm, prior_mm) for by in halves.tolist()]
    )
    weight = np.exp((score - score.max()) / _FLATTER)
    weight /= weight.sum()
    return float(np.sqrt(weight @ (halves - weight @ halves) ** 2))


def _fine(
    rays: EdgeRays, growth_mm: float, best: tuple[float, float], radius_mm: float, prior_mm: float
) -> tuple[float, float]:
    steps = np.array([_PUSH_STEP_MM, _CHAMFER_STEP_MM])
    for blur in _FINE_BLURS:
        seen = replace(rays, wall_sigma=blur * rays.wall_sigma)
        pushes = best[0] + steps[0] * np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
        chamfers = np.maximum(best[1] + steps[1] * np.array([-1.0, -0.5, 0.0, 0.5, 1.0]), 0.0)
        best = _best(seen, _fixed(seen, growth_mm), pushes, chamfers, radius_mm, prior_mm)
        steps = _NARROWED * steps
    return best


def _mean(
    rays: EdgeRays, fixed: _Fixed, best: tuple[float, float], radius_mm: float, prior_mm: float, rounds: int
) -> tuple[float, float, float]:
    """Push and chamfer averaged over what the rays leave possible about the most likely ones, and their score.

    An edge is a step: its likelihood is rough, and which of its peaks is the highest hangs on single rays. The average
    does not, and it is nearer to the truth. Far rims show push less chamfer, near ones the sum; the grid lies along
    both, and is laid about its own average until that stays.
    """
    push, chamfer = best
    for _ in range(rounds):
        sums, differences = np.meshgrid(*(reach_mm * _MEAN_GRID for reach_mm in _MEAN_REACH_MM), indexing="ij")
        pushes = (push + (sums + differences) / 2).ravel()
        chamfers = np.maximum(chamfer + (sums - differences) / 2, 0.0).ravel()
        score = np.array(
            [_score(rays, fixed, a, b, radius_mm, prior_mm) for a, b in zip(pushes, chamfers, strict=True)]
        )
        weight = np.exp((score - score.max()) / _FLATTER)
        weight /= weight.sum()
        moved_mm = abs(float(weight @ pushes) - push)
        push, chamfer = float(weight @ pushes), float(weight @ chamfers)
        if moved_mm < _STILL_MM:
            break
    return push, chamfer, float(score.max())


def _coarse(rays: EdgeRays, radius_mm: float, prior_mm: float) -> tuple[float, float]:
    pushes = np.arange(-_PUSH_REACH_MM, _PUSH_REACH_MM + 1e-9, _PUSH_STEP_MM)
    chamfers = np.array(_CHAMFER_MM)
    some = _chosen(rays, np.arange(0, len(rays.owner), len(rays.owner) // _COARSE_RAYS + 1))
    # seen less sharply, the likelihood has one peak where the grid cannot miss it
    some = replace(some, wall_sigma=_BLUR * some.wall_sigma)
    return _best(some, _fixed(some, 0.0), pushes, chamfers, radius_mm, prior_mm)


def _chosen(rays: EdgeRays, index: IntArray) -> EdgeRays:
    return EdgeRays(**{field.name: getattr(rays, field.name)[index] for field in fields(rays)})


def _in_single(rays: EdgeRays) -> EdgeRays:
    """The rays in half as many digits: a tenth of a micrometre, and twice as fast."""
    parts = {field.name: getattr(rays, field.name) for field in fields(rays) if field.name != "owner"}
    return replace(rays, **{name: part.astype(np.float32) for name, part in parts.items()})


@dataclass(frozen=True, eq=False)
class _Fixed:
    """What does not depend on push and chamfer: likelihoods of ending on the face, and on a wall pushed at once."""

    on_face: Array
    on_wall: Array
    softness: Array
    growth_mm: float


def _fixed(rays: EdgeRays, growth_mm: float) -> _Fixed:
    away = np.einsum("ij,ij->i", rays.about, rays.direction) > 0
    share = np.where(away, _SOFTNESS, _STEP_SOFTNESS)
    return _Fixed(
        _density(rays.beyond, rays.face_sigma),
        _density(rays.beyond - rays.to_wall, rays.wall_sigma),
        np.maximum(share * rays.pitch, _SOFTNESS_MIN_MM),
        growth_mm,
    )


def _density(off_mm: Array, sigma_mm: Array) -> Array:
    # √(2π)
    normal = np.exp(-0.5 * (off_mm / sigma_mm) ** 2) / (2.5066 * sigma_mm)
    return np.asarray((1.0 - _STRAY_SHARE) * normal + _STRAY_SHARE / _STRAY_SPAN_MM)


def _likelihood(rays: EdgeRays, fixed: _Fixed, push: float, chamfer: float, radius_mm: float) -> Array:
    """Log likelihood (n,) of what every ray returned."""
    edge_mm = radius_mm + chamfer
    about = rays.about + push * rays.direction
    distance = np.hypot(about[:, 0], about[:, 1])
    # beyond, it is 0 or 1 to 1e-17
    logit = np.clip((edge_mm - distance) / fixed.softness + rays.sampling, -40.0, 40.0)
    chance = 1.0 / (1.0 + np.exp(-logit))
    grows = fixed.growth_mm > 0.0
    inside = fixed.on_wall
    if grows:
        beside = push * (1.0 - _set_in(rays, (rays.to_wall - push) * rays.climb, fixed.growth_mm, radius_mm))
        inside = _density(rays.beyond - rays.to_wall + beside, rays.wall_sigma)
    if chamfer > 0.0:
        along = np.einsum("ij,ij->i", about, rays.direction)
        # where a ray leaves the cone |p| = edge - height: a chamfer of 45 degrees
        lean, steep = along + edge_mm * rays.climb, 1.0 - rays.climb**2
        room = np.maximum(lean**2 + steep * (edge_mm**2 - distance**2), 0.0)
        to_cone = (np.sqrt(room) - lean) / steep
        on_cone = to_cone * rays.climb < chamfer
        pushed = push * _set_in(rays, to_cone * rays.climb, fixed.growth_mm, radius_mm)[on_cone] if grows else 0.0
        cone = _density(rays.beyond[on_cone] - to_cone[on_cone] - pushed, rays.wall_sigma[on_cone])
        inside = inside.copy()
        inside[on_cone] = cone
    return np.asarray(np.log(chance * inside + (1.0 - chance) * fixed.on_face))


def _set_in(rays: EdgeRays, depth_mm: Array, growth_mm: float, radius_mm: float) -> Array:
    """Share (n,) of the push at a depth behind the face; it is whole at the depth at which the wall is mostly seen."""
    whole = 1.0 - np.exp(-radius_mm * rays.climb / growth_mm)
    return np.asarray((1.0 - np.exp(-np.maximum(depth_mm, 0.0) / growth_mm)) / whole)


def _best(
    rays: EdgeRays, fixed: _Fixed, pushes: Array, chamfers: Array, radius_mm: float, prior_mm: float
) -> tuple[float, float]:
    """The most likely push and chamfer of a grid."""
    score = [[_score(rays, fixed, push, chamfer, radius_mm, prior_mm) for chamfer in chamfers] for push in pushes]
    row, column = np.unravel_index(int(np.argmax(score)), (len(pushes), len(chamfers)))
    return float(pushes[row]), float(chamfers[column])


def _score(rays: EdgeRays, fixed: _Fixed, push: float, chamfer: float, radius_mm: float, prior_mm: float) -> float:
    """Log likelihood of all rays, with what is known of the push beforehand."""
    told = float(_likelihood(rays, fixed, push, chamfer, radius_mm).sum(dtype=np.float64)) / _CORRELATION
    return told - 0.5 * (push / prior_mm) ** 2


def _own(
    rays: EdgeRays,
    fixed: _Fixed,
    found: tuple[float, float],
    open_mm: float,
    law: PushLaw,
    radius_mm: float,
    sleeves: int,
    prior_mm: float,
) -> Push:
    """How far beyond the push each sleeve's own rays are, averaged as the push is, and how far that may be off."""
    push, chamfer = found
    each = np.array(
        [
            np.bincount(rays.owner, _likelihood(rays, fixed, push + off_mm, chamfer, radius_mm), minlength=sleeves)
            for off_mm in _OWN_GRID_MM
        ]
    )
    weight = np.exp((each - each.max(axis=0)) / (_CORRELATION * _OWN_FLATTER))
    weight /= weight.sum(axis=0)
    own = _OWN_GRID_MM @ weight
    own_sigma = np.sqrt(np.maximum(_OWN_GRID_MM**2 @ weight - own**2, _OWN_LEAST_MM**2))
    told = ((own_sigma**-2.0).sum() + prior_mm**-2.0) ** -0.5
    sigma_mm = float(np.sqrt(told**2 + open_mm**2 + law.open_mm**2))
    return Push(push + law.more_mm[0], sigma_mm, chamfer + law.more_mm[1], open_mm, own, own_sigma, law)
