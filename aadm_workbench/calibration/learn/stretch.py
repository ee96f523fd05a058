"""How far a camera stretches what it sees of holes and of pins, from captures of a plate.

A wrong scale moves every centre away from the camera's foot point on the face, in proportion to its distance from it.
So does what edges do: a mouth is shifted along the view, in pixels, by an amount that grows with the slope of the view.
Slope times the size of a pixel is, again, the distance from the foot point. On the face nothing tells the two apart,
and nothing needs to: for holes, and for pins, one number says how far ``measured = (1 + stretch) * true``. The step
from the face to the pins' ends has no such edges, and tells the scale alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats
from scipy.optimize import least_squares

from aadm_workbench.calibration.learn.capture import PlateCapture
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.model import Array, Kind, Measure

_COVERED = 0.95  # two-sided: u is such that 1.96 of it cover what a small number of captures would with Student's t
_USUAL = 1.959964  # standard deviations of a normal law that hold 95 %
_START_MM = 0.05  # scatter of a centre, to begin with: what a good camera has
_ROUNDS = 4  # of weights: they change by less than a hundredth afterwards


@dataclass(frozen=True, eq=False)
class Stretches:
    """Of each kind: ``mean`` over captures, ``spread`` (what one capture differs by, as few tell it), ``scatter_mm``.

    ``apart`` is where pins are seen from holes beyond their places, x and y as the camera's, mm. ``left_mm`` (n, 2) are
    residuals of all centres, by capture.
    """

    mean: dict[Kind, Measure]
    spread: dict[Kind, float]
    scatter_mm: dict[Kind, float]
    apart: tuple[Measure, Measure]
    left_mm: tuple[Array, ...]


def mean_of(values: Array, floor: float = 0.0) -> Measure:
    """Mean and its standard uncertainty by the scatter of captures; widened as Student's t asks for; ``floor``: least.

    Raises
    ------
    ValueError
        For fewer than two values.
    """
    count = len(values)
    if count < 2:
        raise ValueError("one capture tells no uncertainty")
    u = wider_for(count - 1) * float(np.std(values, ddof=1)) / math.sqrt(count)
    return Measure(float(np.mean(values)), math.hypot(u, floor))


def wider_for(freedom: int) -> float:
    """By how much a standard deviation with so few degrees of freedom is too small for 95 % of a normal law."""
    return float(stats.t.ppf((1.0 + _COVERED) / 2.0, freedom)) / _USUAL


def stretches_of(captures: Sequence[PlateCapture], plate: Plate) -> Stretches:
    """Fit all captures, then each alone: how these differ is what one capture may be off."""
    one_by_one = [_Fit((capture,), plate).solved() for capture in captures]
    together = _Fit(tuple(captures), plate).solved()
    found, spread = {}, {}
    for place, kind in enumerate(Kind):
        alone = np.array([fit.shared[place] for fit in one_by_one])
        of_places = together.u_places[place]
        found[kind] = Measure(float(together.shared[place]), mean_of(alone, of_places).u)
        spread[kind] = math.hypot(wider_for(len(alone) - 1) * float(np.std(alone, ddof=1)), of_places)
    sides = np.array([fit.shared[2:4] for fit in one_by_one])
    apart = tuple(Measure(float(together.shared[2 + axis]), mean_of(sides[:, axis]).u) for axis in (0, 1))
    return Stretches(found, spread, together.scatter_mm, (apart[0], apart[1]), together.left_mm)


@dataclass(frozen=True, slots=True)
class OneCapture:
    """Stretch and scatter, mm per axis, of each kind, by one capture alone."""

    mean: dict[Kind, float]
    scatter_mm: dict[Kind, float]


def one_capture(capture: PlateCapture, plate: Plate) -> OneCapture:
    """What one capture says by itself."""
    fit = _Fit((capture,), plate).solved()
    return OneCapture(dict(zip(Kind, fit.shared[:2].tolist(), strict=True)), fit.scatter_mm)


@dataclass(frozen=True, eq=False)
class _Solved:
    """``shared``: stretch of holes, of pins, and pins from holes along x and y; ``u_places`` of the stretches."""

    shared: Array
    u_places: tuple[float, float]
    scatter_mm: dict[Kind, float]
    left_mm: tuple[Array, ...]


class _Fit:
    """Least squares: what captures share, a turn and a shift of each, and places that are off by their u."""

    def __init__(self, captures: tuple[PlateCapture, ...], plate: Plate) -> None:
        self.captures, self.plate = captures, plate
        self.kinds = np.array([one.kind is Kind.REBAR for one in plate.places])
        self.places = np.array([[one.x_mm, one.y_mm] for one in plate.places])
        self.u_mm = np.array([one.u_mm for one in plate.places])
        self.sigma = np.array([_START_MM, _START_MM])

    def solved(self) -> _Solved:
        state = np.zeros(4 + 3 * len(self.captures) + 2 * len(self.places))
        for number, capture in enumerate(self.captures):
            state[4 + 3 * number : 7 + 3 * number] = self._first_pose(capture)
        for _ in range(_ROUNDS):
            done = least_squares(self._residuals, state, method="lm", x_scale=self._sizes(len(state)))
            state = done.x
            left = self._left(state)
            self.sigma = np.array([self._scatter(left, of_pins) for of_pins in (False, True)])
        scatter = dict(zip(Kind, self.sigma.tolist(), strict=True))
        return _Solved(state[:4].copy(), self._u_of_places(), scatter, tuple(self._left(state)))

    def _sizes(self, count: int) -> Array:
        """What each unknown is of the order of."""
        sizes = np.full(count, 0.1)
        sizes[:2] = 1e-3
        sizes[4 : 4 + 3 * len(self.captures) : 3] = 1e-3
        return sizes

    def _first_pose(self, capture: PlateCapture) -> Array:
        """Turn and shift from places to the face, by complex least squares."""
        seen = capture.flat[:, 0] + 1j * capture.flat[:, 1]
        true = self.places[capture.place] @ [1.0, 1j]
        turn = np.angle(np.sum((seen - seen.mean()) * np.conj(true - true.mean())))
        shift = seen.mean() - np.exp(1j * turn) * true.mean()
        return np.array([turn, shift.real, shift.imag])

    def _left(self, state: Array) -> list[Array]:
        """What is left of each capture's centres (n, 2) mm."""
        moved = self.places + state[4 + 3 * len(self.captures) :].reshape(-1, 2)
        found = []
        for number, capture in enumerate(self.captures):
            turn, x, y = state[4 + 3 * number : 7 + 3 * number]
            pins = self.kinds[capture.place]
            c, s = np.cos(turn), np.sin(turn)
            true = moved[capture.place] @ np.array([[c, s], [-s, c]]) + [x, y]
            stretched = true * (1.0 + state[pins.astype(np.int64)])[:, None] + pins[:, None] * state[2:4]
            found.append(capture.flat - stretched)
        return found

    def _residuals(self, state: Array) -> Array:
        parts = []
        for capture, left in zip(self.captures, self._left(state), strict=True):
            parts.append((left / self.sigma[self.kinds[capture.place].astype(np.int64)][:, None]).ravel())
        parts.append((state[4 + 3 * len(self.captures) :].reshape(-1, 2) / self.u_mm[:, None]).ravel())
        return np.concatenate(parts)

    def _scatter(self, left: list[Array], of_pins: bool) -> float:
        """Per axis, mm; pose and stretch take away what they were fitted to, shared among the kinds by their number."""
        own = [part[self.kinds[capture.place] == of_pins] for part, capture in zip(left, self.captures, strict=True)]
        total, squares = sum(2 * len(part) for part in left), sum(float((part**2).sum()) for part in own)
        count = sum(2 * len(part) for part in own)
        fitted = (4 + 3 * len(left)) * count / total
        return max(math.sqrt(squares / max(count - fitted, 1.0)), 1e-4)

    def _u_of_places(self) -> tuple[float, float]:
        """What the places' own u lets the stretch of holes and of pins be off by."""
        found = []
        for of_pins in (False, True):
            mine = self.kinds == of_pins
            about = self.places[mine] - self.places[mine].mean(axis=0)
            found.append(float(np.sqrt(np.mean(self.u_mm[mine] ** 2) / (about**2).sum())))
        return found[0], found[1]
