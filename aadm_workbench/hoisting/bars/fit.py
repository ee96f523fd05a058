"""Bars under a hanging foot: all their visible sides fitted together, with one radius of their cores.

A camera beside the bars sees no top, but half of every side that nothing hides. Ribs only ever stand out of a core, so
the law of the side points is steep inwards and long outwards. Where the axis meets the highest points of the side is
the centre of the top.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.pooled.evidence import BracketLaw
from aadm_workbench.hoisting.frame import HoistingFrame, LocalAxes
from aadm_workbench.hoisting.pattern_fit import (
    OWN,
    Believed,
    Evidence,
    Pattern,
    State,
    System,
    Terms,
    as_built,
    loosened,
    started,
    wall_terms,
)
from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray
from aadm_workbench.model.measured import TO_SIGMA

# of a bar below its top: the shortest of the settings stick out by 120, and no floor is to be taken in
_LENGTH_MM = 110.0
_ABOVE_MM = 14.0  # how far above the level of all tops one may end: by right they differ by a centimetre or more
# about the radius, from a first guess of some mm down to what a rib of 0.9 mm stands out by and its noise
_BANDS_MM = (3.0, 2.0, 1.6, 1.6, 1.6)
_SETTLED_MM = 0.01  # a third of the uncertainty's floor below
# with the scatter that the bars show, until all stay: a cap, and a tenth of the uncertainty's floor; ended before, it
# tells where it began
_LAST_ROUNDS, _STILL_MM = 12, 0.003
_LAST_CHOICES = 2  # of the points that decide: where the first have led, the second are those that lie there
_LAST_SHARE = 0.6  # of a step: the law is so steep inwards that whole ones go back and forth across its peak, for ever
_INWARDS_MM = 1.0  # ribs only stand outwards: what lies farther inside of the core is a stray
_PIXELS = 4_000  # of a window, evenly taken: half of them are the side's
# of these pixels: neighbours share their errors, but single ones are not to decide; where a bar is known already and
# shows more points than count (below), fewer tell that it stands where it stood
_TAKEN, _TRACKED_TAKEN, _WELL_SEEN = 1_500, 800, 600
_POINTS_MAX = 300  # points of a side tell as much as there are errors of their own among them
_FEWEST = 40  # points of a side (a choice: ±30 % moves nothing on sound scans)
# neighbouring points of a side share their errors: standard errors are this much larger; a choice: ±30 % changes what
# is found
_CORRELATION = 1.8
_NOISE_MM = 0.15  # to begin with: half as much again as the reference camera has at 1 m
# of the noise that is read from the sides: half to three times that of the reference camera at 1 m (0.10)
_LAW_WIDTH_MM = (0.05, 0.3)
# of the points of a side, and how far they stand out on average: ribs of 0.9 mm with slanted flanks; a choice: ±30 %
# changes what is found
_RIB_SHARE, _RIB_MM = 0.35, 0.5
# cores are nominal within half a millimetre across, those of a group alike, and lean by up to twice the usual 0.3
# degrees
_RADIUS_SIGMA_MM, _OWN_RADIUS_MM, _LEAN_SIGMA = 0.25, 0.05, 0.010
_CORE_TO_NOMINAL = 0.965  # of ribbed bars (GB/T 1499.2: 19.3 of 20 mm)
# 73 degrees to either side of the view: beyond, a side is seen along, and its pixels mix with what is behind
_FACING_COSINE = 0.30
# what the warp of a camera leaves (0.025 mm rms of the reference camera), however many points there are
_FLOOR_MM = 0.03
_SEEN_MM = 0.25  # known better than this, it has evidence of its own (a choice: ±30 % changes what is found)
_TOP_BIN_MM = 1.0  # three rows of pixels or more, from 550 to 850 mm away
# a side falls by 1.1 mm from pixel to pixel where it is still used; three of four neighbours
_LIKE_DEPTH_MM, _BORNE_BY = 2.5, 3
_NARROWEST, _WIDE = 0.12, 0.45  # of the diameter: on a narrow strip one rib can stand for the whole bar


@dataclass(frozen=True, eq=False)
class BarFit:
    """Bars (k) in axes whose z is about their vertical, mm.

    ``tops`` (k, 3) are centres of tops, NaN in height where no bar is seen; ``leans`` (k, 2) mm per mm upwards, with
    the joint ``covariance`` (2k, 2k) of the plan positions of the tops. ``seen`` (k,) tells which have evidence of
    their own, ``counts`` (k,) how many points that is. ``pose`` (3,) lays ``places`` (k, 2) on them,
    its turn with the standard uncertainty ``turn_u``, rad. ``evidence`` is what the seen ones show by themselves,
    ``state`` all that was fitted.
    """

    tops: Array
    leans: Array
    covariance: Array
    seen: BoolArray
    counts: IntArray
    pose: Array
    turn_u: float
    places: Array
    radius_mm: float
    noise_mm: float
    evidence: Evidence
    state: State


@dataclass(frozen=True, eq=False)
class _Side:
    """Points (n, 3) about one bar, the plan directions (n, 2) in which they were looked at, and its top's height."""

    points: Array
    view: Array
    top_mm: float


def fit_bars(
    frame: HoistingFrame,
    axes: LocalAxes,
    pattern: Pattern,
    pose: Array,
    top_mm: float,
    diameter_mm: float,
    starts: Array | None = None,
    before: BarFit | None = None,
) -> BarFit:
    """Fit the bars of a pattern to a frame.

    Parameters
    ----------
    axes
        Origin and directions, z along the bars' vertical, as far as it is known.
    pattern
        Places of the bars, by design or as measured before hoisting, and their scatter.
    pose
        (3,): x, y mm and turn, from the places to ``axes``, within some mm.
    top_mm
        Level of the tops in ``axes``, within some cm.
    starts
        (k, 2) mm: first centres of bars that were found, NaN for the others; a bent bar is far from its place.
    before
        What was fitted in the frame before, of the same camera, to begin with: then the search for it is left out.
    """
    nominal_mm = _CORE_TO_NOMINAL * diameter_mm / 2
    state = started(pattern, pose, (nominal_mm,))
    if before is not None:
        state.pooled[:], state.own[:, 2:] = before.state.pooled, before.state.own[:, 2:]
    if starts is not None:
        state.own[:, :2] = np.where(np.isfinite(starts), starts, state.own[:, :2])
    known = np.zeros(len(state.own)) if before is None else before.counts
    taken = np.where(known > _WELL_SEEN, _TRACKED_TAKEN, _TAKEN)
    looked = zip(state.centres, taken.tolist(), strict=True)
    sides = [_side(frame, axes, centre, top_mm, diameter_mm / 2, most) for centre, most in looked]
    # nothing pushes the side of a bar along the view: held at none
    sigma = np.tile([_LEAN_SIGMA, _LEAN_SIGMA, 1e-4, _OWN_RADIUS_MM], (len(sides), 1))
    believed = Believed(np.array([nominal_mm]), np.array([_RADIUS_SIGMA_MM]), sigma, np.zeros((len(sides), OWN - 2)))
    # how points scatter about cores is the bars', and not the frame's
    law = _law(_NOISE_MM if before is None else before.noise_mm)
    if before is None:
        state, law = _settled(sides, state, pattern, believed, law)
    else:
        state = _approached(sides, state, pattern, believed, law)
    chosen = _chosen(sides, state, _BANDS_MM[-1])
    counts, pattern = chosen.counts, as_built(loosened(pattern, state), state, chosen.counts >= _FEWEST)
    for number in range(_LAST_CHOICES if before is None else 1):
        chosen = _chosen(sides, state, _BANDS_MM[-1]) if number else chosen
        state, system = _stayed(chosen, state, pattern, believed, law)
    covariance, pose_covariance, _ = system.covariance()
    own_mm = np.sqrt(np.diag(covariance).reshape(-1, 2).max(axis=1))
    seen = (counts >= _FEWEST) & (own_mm < np.minimum(_SEEN_MM, np.maximum(0.5 * pattern.scatter_mm, 0.1)))
    heights = np.array([np.nan if side is None else side.top_mm for side in sides])
    return BarFit(
        tops=np.column_stack([state.centres, heights]),
        leans=-state.own[:, 2:4],
        covariance=covariance + _FLOOR_MM**2 * np.eye(len(covariance)),
        seen=seen,
        counts=counts * _TAKEN // taken,
        pose=state.pose,
        turn_u=float(np.sqrt(pose_covariance[2, 2])),
        places=pattern.places,
        radius_mm=float(state.pooled[0]),
        noise_mm=law.width_mm,
        evidence=_own_system(chosen.terms(state, law)[0], believed, state).evidence(state, seen, _FLOOR_MM),
        state=state if before is None else before.state,
    )


def _law(width_mm: float) -> BracketLaw:
    return BracketLaw(float(np.clip(width_mm, *_LAW_WIDTH_MM)), _RIB_SHARE, _RIB_MM)


def _settled(
    sides: list[_Side | None], state: State, pattern: Pattern, believed: Believed, law: BracketLaw
) -> tuple[State, BracketLaw]:
    """The state to which the sides of all bars settle, and the law of how their points scatter."""
    for band_mm in _BANDS_MM:
        terms, width_mm = _chosen(sides, state, band_mm).terms(state, law)
        law = _law(width_mm)
        state, step = _system(terms, pattern, believed, state).stepped(state)
        pattern = loosened(pattern, state)
        if step < _SETTLED_MM and band_mm == _BANDS_MM[-1]:
            break
    return state, law


def _approached(
    sides: list[_Side | None], state: State, pattern: Pattern, believed: Believed, law: BracketLaw
) -> State:
    """The state, nearly, to which the sides of bars settle that are followed: one may have been bent meanwhile."""
    for _ in range(_LAST_ROUNDS):
        terms, _ = _chosen(sides, state, _BANDS_MM[-1]).terms(state, law)
        state, step_mm = _system(terms, loosened(pattern, state), believed, state).stepped(state, _LAST_SHARE)
        if step_mm < _SETTLED_MM:
            break
    return state


def _stayed(
    chosen: _Chosen, state: State, pattern: Pattern, believed: Believed, law: BracketLaw
) -> tuple[State, System]:
    """The state that chosen points hold all bars in, and the system that does."""
    for _ in range(_LAST_ROUNDS):
        system = _system(chosen.terms(state, law)[0], pattern, believed, state)
        state, step_mm = system.stepped(state, _LAST_SHARE)
        if step_mm < _STILL_MM:
            break
    return state, system


def _system(terms: Terms, pattern: Pattern, believed: Believed, state: State) -> System:
    system = _own_system(terms, believed, state)
    system.add_pattern(pattern, state)
    return system


def _own_system(terms: Terms, believed: Believed, state: State) -> System:
    """What each bar shows by itself, without the pattern."""
    system = System(len(state.own), 1)
    system.add(terms)
    system.add_beliefs(believed, state)
    return system


def _side(
    frame: HoistingFrame, axes: LocalAxes, centre: Array, top_mm: float, radius_mm: float, taken: int
) -> _Side | None:
    """What is seen of a bar about a place; None where nothing is, or it is out of the picture."""
    reach = radius_mm + _BANDS_MM[0]
    corners = np.array(
        [
            [centre[0] + x * reach, centre[1] + y * reach, top_mm + z]
            for x in (-1, 1)
            for y in (-1, 1)
            for z in (-_LENGTH_MM, _ABOVE_MM)
        ]
    )
    around = axes.to_frame(corners)
    if (around[:, 2] <= 1.0).any():
        return None
    pixels = frame.pixels_of(around)
    low = np.maximum(np.floor(pixels.min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(pixels.max(axis=0)).astype(int) + 1, frame.shape[::-1])
    if (high - low < 3).any():
        return None
    # by what is not rounded, and from fixed rows and columns: which pixels are taken hangs on no hair's breadth
    step = max(1, int(np.sqrt(np.prod(np.ptp(pixels, axis=0)) / _PIXELS)))
    low -= low % step
    points = frame.points[low[1] : high[1] : step, low[0] : high[0] : step]
    nth = max(1, int(step**-2 * np.prod(np.ptp(pixels, axis=0)) / taken))
    kept = _borne(points[..., 2]) & _every(nth, points)
    local = axes.local(points[kept].astype(np.float64))
    near = np.hypot(*(local[:, :2] - centre).T) < reach
    near &= (local[:, 2] > top_mm - _LENGTH_MM) & (local[:, 2] < top_mm + _ABOVE_MM)
    local = local[near]
    if len(local) < _FEWEST // 2:
        return None
    view = local[:, :2] - axes.eye[:2]
    return _Side(local, view / np.linalg.norm(view, axis=1)[:, None], _top(local[:, 2]))


def _every(nth: int, points: FloatArray) -> BoolArray:
    """Every ``nth`` pixel (h, w) of a window, along diagonals: chosen by where it is, and not by what it shows."""
    rows, columns = np.ogrid[: points.shape[0], : points.shape[1]]
    return np.asarray((rows + columns) % nth == 0)


def _width(about: Array, view: Array) -> float:
    """How wide (mm) a strip of a bar is seen: points (n, 2) about its axis, looked at along ``view`` (n, 2)."""
    across = np.sort(about[::5, 1] * view[::5, 0] - about[::5, 0] * view[::5, 1])
    # a twentieth at either end may fly
    beyond = len(across) // 20
    return float(across[-1 - beyond] - across[beyond])


def _borne(depth: FloatArray) -> BoolArray:
    """Pixels (h, w) with neighbours at a like depth: the rest fly, or look past an edge."""
    framed = np.pad(depth, 1, constant_values=np.nan)
    count = np.zeros(depth.shape, np.int8)
    for down, right in ((0, 1), (2, 1), (1, 0), (1, 2)):
        count += np.abs(framed[down : down + depth.shape[0], right : right + depth.shape[1]] - depth) < _LIKE_DEPTH_MM
    return np.asarray(count >= _BORNE_BY)


def _top(heights: Array) -> float:
    """Height at which the side of a bar ends: the highest point that has its share of points just below it."""
    rising = np.sort(heights)
    counts = np.arange(len(rising)) - np.searchsorted(rising, rising - _TOP_BIN_MM)
    # two fifths of what the side has at most heights: what flies above a top is less
    return float(rising[np.flatnonzero(counts >= 0.4 * np.median(counts))[-1]])


@dataclass(frozen=True, eq=False)
class _Chosen:
    """Points (n) of the sides of all bars, sorted by ``owner``: ``xy`` (n, 2) and ``depth`` below their tops, mm.

    ``trust`` (n,) is what they count by; ``counts`` (k,) how many each bar has.
    """

    xy: Array
    depth: Array
    owner: IntArray
    trust: Array
    counts: IntArray

    def terms(self, state: State, law: BracketLaw) -> tuple[Terms, float]:
        """What they say of a state, and how far they scatter inwards, mm."""
        residual, own, pooled = wall_terms(self.xy, self.depth, np.zeros_like(self.xy), self.owner, state, 0, None)
        pull = -law.slope(-residual) * self.trust / _CORRELATION**2
        bend = np.abs(pull) / np.maximum(np.abs(residual), law.softness_mm)
        inwards = residual[(residual < 0) & (residual > -_INWARDS_MM)]
        width_mm = TO_SIGMA * float(np.median(np.abs(inwards))) if len(inwards) > _FEWEST // 2 else _NOISE_MM
        return Terms(own, pooled, pull, bend, self.owner), width_mm


def _chosen(sides: list[_Side | None], state: State, band_mm: float) -> _Chosen:
    """The points that lie on the sides of bars in a state, within a band about them."""
    points, depths, trusts, counts = [np.empty((0, 2))], [np.empty(0)], [np.empty(0)], np.zeros(len(sides), np.int64)
    for k, side in enumerate(sides):
        if side is None:
            continue
        depth = side.top_mm - side.points[:, 2]
        about = side.points[:, :2] - state.own[k, :2] - state.own[k, 2:4] * depth[:, None]
        distance = np.hypot(about[:, 0], about[:, 1])
        off = distance - state.pooled[0] - state.own[k, 5]
        facing = -np.einsum("ij,ij->i", about, side.view) > _FACING_COSINE * distance
        # below the top's own edge, where pixels mix; inwards the band is narrower, for ribs only stand outwards
        used = np.flatnonzero((depth > 1.0) & (off > -max(_INWARDS_MM, 0.6 * band_mm)) & (off < band_mm) & facing)
        if len(used) < _FEWEST:
            continue
        width = _width(about[used], side.view[used]) / (2.0 * state.pooled[0])
        # cubed: a strip of half the width holds its bar an eighth as firmly; a little keeps the equations whole
        trust = np.clip((width - _NARROWEST) / (_WIDE - _NARROWEST), 1e-4, 1.0) ** 3
        trusts.append(np.full(len(used), trust * min(1.0, _POINTS_MAX / len(used))))
        points.append(side.points[used, :2])
        depths.append(depth[used])
        counts[k] = len(used)
    owner = np.repeat(np.arange(len(sides)), counts)
    return _Chosen(np.concatenate(points), np.concatenate(depths), owner, np.concatenate(trusts), counts)
