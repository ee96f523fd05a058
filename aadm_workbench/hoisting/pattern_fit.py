"""Round features that belong to one rigid pattern, fitted together: the pattern's pose, then each by its own evidence.

A feature k has a centre c, a lean l (offset per mm of depth), a push e along its lines of sight and its own share r of
the radius. All share a few pooled unknowns, and the pose (x, y, turn) that lays the pattern on them. Each centre stands
about its place in the pattern with the scatter that features of this kind have, so a feature that is hardly seen is
where the others say, with an uncertainty that says so, and one that is seen well is where it is seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, BoolArray, IntArray

OWN = 6
"""Unknowns of a feature: centre x, y; lean x, y; push; radius."""

_POSE = 3  # x, y and turn
_LONGEST_STEP_MM = 3.0  # first poses are right within some mm: a longer step is one that hardly anything holds
# farther from its place a feature is bent or set wrong, and counts by less (a choice: ±30 % changes what is found)
_FAR_SIGMAS = 2.0
_BELIEF_COUNT = 2  # features: scatter is a belief, which two that are seen outweigh
_BY_DESIGN_MM = 0.3  # closer than that only a measurement knows a place


@dataclass(frozen=True, eq=False)
class Pattern:
    """Where features belong: ``places`` (k, 2) mm, and ``scatter_mm`` (k,) per axis about them."""

    places: Array
    scatter_mm: Array


@dataclass(frozen=True, eq=False)
class State:
    """What is fitted: pose (3,) as x, y, turn; pooled (p,); own (k, 6)."""

    pose: Array
    pooled: Array
    own: Array

    @property
    def centres(self) -> Array:
        """(k, 2) mm."""
        return self.own[:, :2]


@dataclass(frozen=True, eq=False)
class Terms:
    """Evidence of one kind at a state, sorted by ``owner`` (n,).

    Residuals' Jacobians to a feature's own unknowns, (n, 6), and to the pooled ones, (n, p), and the first and second
    derivative ``pull`` and ``bend`` (n,) of each residual's cost.
    """

    own: Array
    pooled: Array
    pull: Array
    bend: Array
    owner: IntArray


@dataclass(frozen=True, eq=False)
class Believed:
    """Priors as means and standard deviations.

    Of the pooled unknowns, (p,), and of a feature's own beyond its centre: lean, lean, push, radius, (k, 4).
    """

    pooled: Array
    pooled_sigma: Array
    own_sigma: Array
    own: Array | None = None


@dataclass(frozen=True, eq=False)
class Evidence:
    """What a frame shows by itself of the features ``index`` (m,) that it sees, whatever their pattern says.

    ``centres`` (m, 2) mm with their joint ``covariance`` (2m, 2m): they share pushes and radii, and stand free of each
    other otherwise.
    """

    index: IntArray
    centres: Array
    covariance: Array


def placed(pose: Array, places: Array) -> Array:
    """The pattern's places (k, 2) mm in a pose."""
    cosine, sine = np.cos(pose[2]), np.sin(pose[2])
    turned = np.column_stack([cosine * places[:, 0] - sine * places[:, 1], sine * places[:, 0] + cosine * places[:, 1]])
    return np.asarray(turned + pose[:2])


def loosened(pattern: Pattern, state: State) -> Pattern:
    """The pattern with a wider scatter for features far from their places: one bent bar must not pull all."""
    off_mm = np.hypot(*(state.centres - placed(state.pose, pattern.places)).T)
    return Pattern(pattern.places, np.maximum(pattern.scatter_mm, off_mm / _FAR_SIGMAS))


def as_built(pattern: Pattern, state: State, seen: BoolArray) -> Pattern:
    """The pattern with the scatter that the features show which are seen, where places are by design alone.

    What is believed beforehand counts as much as ``_BELIEF_COUNT`` features; features that stand far off do not count.
    """
    off = state.centres - placed(state.pose, pattern.places)
    by_design = pattern.scatter_mm > _BY_DESIGN_MM
    counted = seen & by_design & (np.hypot(off[:, 0], off[:, 1]) < 3.0 * pattern.scatter_mm)
    if not counted.any():
        return pattern
    believed = float(np.median(pattern.scatter_mm[counted]))
    # three of the offsets' unknowns are those of the pose
    freedom = max(2 * int(counted.sum()) - 3, 0)
    variance = (2 * _BELIEF_COUNT * believed**2 + float((off[counted] ** 2).sum())) / (2 * _BELIEF_COUNT + freedom)
    ratio = np.sqrt(variance) / believed
    return Pattern(pattern.places, np.where(by_design, ratio * pattern.scatter_mm, pattern.scatter_mm))


class System:
    """Normal equations of a pattern's features."""

    def __init__(self, features: int, pooled: int) -> None:
        self.features, self.pooled = features, pooled
        size = _POSE + pooled + OWN * features
        self.normal = np.zeros((size, size))
        self.gradient = np.zeros(size)

    def add(self, terms: Terms) -> None:
        """Add evidence."""
        bounds = np.searchsorted(terms.owner, np.arange(self.features + 1))
        shared = np.arange(_POSE, _POSE + self.pooled)
        for k in range(self.features):
            rows = slice(bounds[k], bounds[k + 1])
            if rows.start == rows.stop:
                continue
            jacobian = np.hstack([terms.pooled[rows], terms.own[rows]])
            place = np.concatenate([shared, self.own_places(k)])
            self.normal[np.ix_(place, place)] += (jacobian * terms.bend[rows, None]).T @ jacobian
            self.gradient[place] += jacobian.T @ terms.pull[rows]

    def own_places(self, k: int) -> IntArray:
        """Rows of a feature's own unknowns."""
        begin = _POSE + self.pooled + OWN * k
        return np.arange(begin, begin + OWN)

    def add_pattern(self, pattern: Pattern, state: State) -> None:
        """Each centre stands about its place in the pattern."""
        at = placed(state.pose, pattern.places)
        turning = at - state.pose[:2]
        jacobian = np.zeros((self.features, 2, _POSE))
        jacobian[:, 0, 0] = jacobian[:, 1, 1] = -1.0
        jacobian[:, 0, 2], jacobian[:, 1, 2] = turning[:, 1], -turning[:, 0]
        weight = pattern.scatter_mm**-2.0
        weighted = weight[:, None, None] * jacobian
        off = state.own[:, :2] - at
        centres = (_POSE + self.pooled + OWN * np.arange(self.features)[:, None] + np.arange(2)).ravel()
        self.normal[:_POSE, :_POSE] += np.einsum("kij,kil->jl", weighted, jacobian)
        self.normal[centres, centres] += np.repeat(weight, 2)
        flat = weighted.reshape(-1, _POSE)
        self.normal[centres, :_POSE] += flat
        self.normal[:_POSE, centres] += flat.T
        self.gradient[:_POSE] += np.einsum("kij,ki->j", weighted, off)
        self.gradient[centres] += (weight[:, None] * off).ravel()

    def add_beliefs(self, believed: Believed, state: State) -> None:
        """Priors of what is pooled and of what is each feature's own."""
        shared = np.arange(_POSE, _POSE + self.pooled)
        weight = believed.pooled_sigma**-2.0
        self.normal[shared, shared] += weight
        self.gradient[shared] += weight * (state.pooled - believed.pooled)
        rest = np.concatenate([self.own_places(k)[2:] for k in range(self.features)])
        weight = believed.own_sigma.ravel() ** -2.0
        expected = 0.0 if believed.own is None else believed.own
        self.normal[rest, rest] += weight
        self.gradient[rest] += weight * (state.own[:, 2:] - expected).ravel()

    def tie(self, first: int, second: int, difference: float, sigma: float, state: State) -> None:
        """Two pooled unknowns differ by about ``difference``."""
        place = np.array([_POSE + first, _POSE + second])
        off = state.pooled[first] - state.pooled[second] - difference
        self.normal[np.ix_(place, place)] += np.array([[1.0, -1.0], [-1.0, 1.0]]) / sigma**2
        self.gradient[place] += np.array([off, -off]) / sigma**2

    def stepped(self, state: State, share: float = 1.0) -> tuple[State, float]:
        """The state after a share of a step, and the longest part of the step, mm (turns over 100 mm)."""
        step = -share * np.linalg.solve(self.normal, self.gradient)
        step[2] *= 100.0
        step = np.clip(step, -_LONGEST_STEP_MM, _LONGEST_STEP_MM)
        longest = float(np.abs(step).max())
        step[2] /= 100.0
        begin = _POSE + self.pooled
        moved = State(
            state.pose + step[:_POSE],
            state.pooled + step[_POSE:begin],
            state.own + step[begin:].reshape(-1, OWN),
        )
        return moved, longest

    def evidence(self, state: State, seen: BoolArray, floor_mm: float) -> Evidence:
        """What is told of the seen features (k,) by a system to which no pattern was added.

        ``floor_mm`` is what each centre is off by, however much is seen of it.
        """
        index = np.flatnonzero(seen)
        shared = np.arange(_POSE, _POSE + self.pooled)
        rows = np.concatenate([shared, *(self.own_places(int(k)) for k in index)])
        inverse = np.linalg.inv(self.normal[np.ix_(rows, rows)])
        step = -(inverse @ self.gradient[rows])
        centres = (self.pooled + OWN * np.arange(len(index))[:, None] + np.arange(2)).ravel()
        moved = state.centres[index] + np.clip(step[centres], -_LONGEST_STEP_MM, _LONGEST_STEP_MM).reshape(-1, 2)
        spread = inverse[np.ix_(centres, centres)] + floor_mm**2 * np.eye(len(centres))
        return Evidence(index, np.asarray(moved), np.asarray(spread))

    def covariance(self) -> tuple[Array, Array, Array]:
        """Covariances: of all centres together (2k, 2k) mm², of the pose (3, 3), and of the pooled unknowns (p, p)."""
        inverse = np.asarray(np.linalg.inv(self.normal), np.float64)
        rows = np.concatenate([self.own_places(k)[:2] for k in range(self.features)])
        shared = np.arange(_POSE, _POSE + self.pooled)
        return inverse[np.ix_(rows, rows)], inverse[:_POSE, :_POSE], inverse[np.ix_(shared, shared)]


def started(pattern: Pattern, pose: Array, pooled: Sequence[float]) -> State:
    """The state in which every feature stands at its place."""
    own = np.zeros((len(pattern.places), OWN))
    own[:, :2] = placed(pose, pattern.places)
    return State(np.array(pose, np.float64), np.array(pooled, np.float64), own)


def wall_terms(
    xy: Array, depth: Array, slope: Array, owner: IntArray, state: State, radius: int, push: int | None
) -> tuple[Array, Array, Array]:
    """Residuals (n,) mm of points on bores or sides, outwards, with Jacobians to own (n, 6) and pooled unknowns.

    ``|p - c - l*depth - (b + e)*slope| - R - r`` for points ``xy`` (n, 2); ``radius`` and ``push`` say which of the
    pooled unknowns R and b are.
    """
    own = state.own[owner]
    pushed = own[:, 4] + (0.0 if push is None else state.pooled[push])
    about = xy - own[:, :2] - own[:, 2:4] * depth[:, None] - pushed[:, None] * slope
    distance = np.maximum(np.hypot(about[:, 0], about[:, 1]), 1e-9)
    outward = about / distance[:, None]
    along = -np.einsum("ij,ij->i", outward, slope)
    minus = -np.ones(len(xy))
    pooled = np.zeros((len(xy), len(state.pooled)))
    pooled[:, radius] = minus
    if push is not None:
        pooled[:, push] = along
    own_jacobian = np.column_stack([-outward, -outward * depth[:, None], along, minus])
    return distance - state.pooled[radius] - own[:, 5], own_jacobian, pooled
