"""Paths in space: what a bar is bent along, and what bounds a profile."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from aadm_workbench.model import Array

_ARC_STEP = math.radians(5.0)  # facets of 5 degrees lie 0.1 % of the radius within the arc
_NO_LENGTH_MM = 1e-6  # a nanometre: rounding
_ONE_DIRECTION_COS = math.cos(math.radians(0.1))
"""Legs whose directions differ by less than 0.1 degrees are one straight leg: exporters cut bars where they please."""


def length_of(vector: Array) -> float:
    """The length of one vector (n,): to the last bit that of ``numpy.linalg.norm``, which takes thrice as long."""
    return math.sqrt(float(vector @ vector))


@dataclass(frozen=True, eq=False)
class Straight:
    """A straight leg from ``start`` (3,) to ``end`` (3,), mm. ``span`` is its length in the curve's own parameter."""

    start: Array
    end: Array
    span: float = 1.0

    @property
    def points(self) -> Array:
        """(2, 3) mm."""
        return np.array([self.start, self.end])

    @cached_property
    def length_mm(self) -> float:
        """From start to end."""
        return length_of(self.end - self.start)

    @property
    def direction(self) -> Array:
        """(3,) unit, from start to end."""
        along: Array = (self.end - self.start) / self.length_mm
        return along

    def part(self, begin: float, stop: float) -> Straight:
        """The part between two fractions of the leg."""
        along = self.end - self.start
        return Straight(self.start + begin * along, self.start + stop * along, self.span * (stop - begin))

    def reversed(self) -> Straight:
        """From end to start."""
        return Straight(self.end, self.start, self.span)

    def moved(self, T: Array) -> Straight:
        """The leg after a motion (4, 4)."""
        return Straight(T[:3, :3] @ self.start + T[:3, 3], T[:3, :3] @ self.end + T[:3, 3], self.span)


@dataclass(frozen=True, eq=False)
class Arc:
    """The points ``centre + u cos(a) + v sin(a)``, all (3,) mm, for ``a`` from ``begin`` to ``stop``, radians."""

    centre: Array
    u: Array
    v: Array
    begin: float
    stop: float
    span: float = 1.0

    @cached_property
    def points(self) -> Array:
        """(n, 3) mm, sampled every 5 degrees or closer."""
        steps = max(2, math.ceil(abs(self.stop - self.begin) / _ARC_STEP) + 1)
        angle = np.linspace(self.begin, self.stop, steps)[:, np.newaxis]
        sampled: Array = self.centre + np.cos(angle) * self.u + np.sin(angle) * self.v
        return sampled

    @property
    def start(self) -> Array:
        """(3,) mm."""
        return np.asarray(self.points[0])

    @property
    def end(self) -> Array:
        """(3,) mm."""
        return np.asarray(self.points[-1])

    @cached_property
    def length_mm(self) -> float:
        """Exact for a circle; of an ellipse the length of the sampled line."""
        radii = np.linalg.norm(self.u), np.linalg.norm(self.v)
        if math.isclose(radii[0], radii[1], rel_tol=1e-9):
            return float(radii[0] * abs(self.stop - self.begin))
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())

    def part(self, begin: float, stop: float) -> Arc:
        """The part between two fractions of the leg."""
        turn = self.stop - self.begin
        return Arc(
            self.centre,
            self.u,
            self.v,
            self.begin + begin * turn,
            self.begin + stop * turn,
            self.span * (stop - begin),
        )

    def reversed(self) -> Arc:
        """From end to start."""
        return Arc(self.centre, self.u, self.v, self.stop, self.begin, self.span)

    def moved(self, T: Array) -> Arc:
        """The leg after a motion (4, 4)."""
        A = T[:3, :3]
        return Arc(A @ self.centre + T[:3, 3], A @ self.u, A @ self.v, self.begin, self.stop, self.span)


Leg = Straight | Arc


def polyline(points: Sequence[Array]) -> list[Leg]:
    """Straight legs from point to point."""
    return [Straight(start, end) for start, end in pairwise(points)]


def arc_through(start: Array, middle: Array, end: Array) -> Leg:
    """The circular arc through three points (3,) mm; the straight leg where they lie on a line."""
    a, b = middle - start, end - start
    normal = np.cross(a, b)
    steepness = float(normal @ normal)
    if steepness <= (1e-9 * float(b @ b)) ** 2:
        return Straight(start, end)
    to_centre = np.cross((a @ a) * b - (b @ b) * a, normal) / (2.0 * steepness)
    u = -to_centre
    v = np.cross(normal / math.sqrt(steepness), u)
    from_centre = end - (start + to_centre)
    turn = math.atan2(float(from_centre @ v), float(from_centre @ u)) % (2.0 * math.pi)
    return Arc(start + to_centre, u, v, 0.0, turn)


def cut(legs: Sequence[Leg], begin: float | None, stop: float | None) -> list[Leg]:
    """The part of a path between two values of its parameter; None is the path's own end."""
    total = sum(leg.span for leg in legs)
    begin = 0.0 if begin is None else max(begin, 0.0)
    stop = total if stop is None else min(stop, total)
    kept: list[Leg] = []
    passed = 0.0
    for leg in legs:
        if leg.span <= 0.0:
            continue
        first, last = (begin - passed) / leg.span, (stop - passed) / leg.span
        passed += leg.span
        # Exporters print a full range with fewer digits than its parts: a sliver of a leg is a rounded number.
        if last < 1e-6 or first > 1.0 - 1e-6:
            continue
        kept.append(leg if first < 1e-6 and last > 1.0 - 1e-6 else leg.part(max(first, 0.0), min(last, 1.0)))
    return kept


def rounded(legs: Sequence[Leg], radius_mm: float) -> list[Leg]:
    """A path of straight legs with an arc of one radius in each of its corners."""
    found: list[Leg] = []
    for leg in joined(legs):
        last = found[-1] if found else None
        if not isinstance(leg, Straight) or not isinstance(last, Straight):
            found.append(leg)
            continue
        turn = math.acos(max(-1.0, min(1.0, float(last.direction @ leg.direction))))
        setback_mm = radius_mm * math.tan(turn / 2.0)
        if not 0.0 < setback_mm < min(last.length_mm, leg.length_mm):
            found.append(leg)
            continue
        begin, stop = last.end - setback_mm * last.direction, leg.start + setback_mm * leg.direction
        inwards = leg.direction - last.direction
        to_centre = radius_mm / math.cos(turn / 2.0) * inwards / float(np.linalg.norm(inwards))
        middle = last.end + to_centre * (1.0 - math.cos(turn / 2.0))
        found[-1:] = [Straight(last.start, begin), arc_through(begin, middle, stop), Straight(stop, leg.end)]
    return found


def joined(legs: Iterable[Leg]) -> list[Leg]:
    """The same path with straight legs of one direction made one, and legs without length left out."""
    merged: list[Leg] = []
    for leg in legs:
        if leg.length_mm < _NO_LENGTH_MM:
            continue
        last = merged[-1] if merged else None
        if (
            isinstance(leg, Straight)
            and isinstance(last, Straight)
            and float(leg.direction @ last.direction) > _ONE_DIRECTION_COS
        ):
            merged[-1] = Straight(last.start, leg.end)
        else:
            merged.append(leg)
    return merged


def outline(legs: Sequence[Leg]) -> Array:
    """(n, 3) mm, points of a closed path in order, the first not repeated."""
    points = np.vstack([leg.points for leg in legs])
    apart = np.linalg.norm(points - np.roll(points, -1, axis=0), axis=1) > _NO_LENGTH_MM
    kept: Array = points[apart]
    return kept
