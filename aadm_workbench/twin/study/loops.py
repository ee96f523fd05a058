"""Hundreds of columns set by their corrections, without rendering: frames are drawn by the errors that frames have.

A frame here is the truth of the hanging column with errors of the sizes that rendered frames show (docs/hoisting.md):
some are a frame's own, some a column's, and all pairs of a frame share some. What is done with a frame is not drawn:
correction, verdict, swing and fitness are the product's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.decision import decide_radial
from aadm_workbench.assembly.pose.eopa import NoFit, turn
from aadm_workbench.assembly.pose.minimax import fit_minimax
from aadm_workbench.model import (
    Array,
    ColumnDesign,
    Correction,
    HoistingMeasurement,
    HoistingPair,
    HoistingReport,
    worst,
)
from aadm_workbench.twin.pendulum import HangingColumn
from aadm_workbench.twin.scenes import LAB
from aadm_workbench.twin.study.hoisting import design_of

LIMIT_MM = 3.0
"""GB/T 51231-2016, 10.4."""

# per axis, mm, over 24 rendered frames of four columns (250, 600 and 1,000 mm, 720 to 850 mm away): of a pair in one
# frame (0.04 to 0.07), of a pair in all frames of its column (0.05 to 0.07), of all pairs of one frame (0.03 to 0.05),
# of all pairs in all frames (0.05); and u as those frames state it (0.10 to 0.14)
_OWN_MM, _LASTING_MM, _SHARED_MM, _SHARED_LASTING_MM, _STATED_MM = 0.055, 0.055, 0.04, 0.05, 0.12
_SCATTER_MM = 0.35  # of bar minus sleeve, per axis: 0.25 mm each, of a column that its trial let go on (crane.py)
_SEEN = 9  # of twelve pairs, from one corner; the others rest on the scans from before hoisting
_FIRST_MM, _FIRST_DEG = 25.0, 2.0  # a driver brings it that near by eye (crane.py)
_SWING_MM = (1.0, 25.0)  # with which it arrives; the first frame is taken once it hangs quietly
_PERIODS_S, _TURN_PERIOD_S = (3.0, 6.0), (2.0, 5.0)  # ropes of 2.2 to 9 m; turns are held by the lines
_DAMPING = (0.15, 0.35)  # of people at tag lines, and the lines' friction
_MOVE_S = (2.0, 4.0)  # a slow crane at the end of its way
_GAIN_SIGMA, _BESIDE_MM, _BESIDE_DEG = 0.03, 0.3, 0.03  # of a crane's move (crane.py)
_ARM_GAIN_SIGMA, _ARM_BESIDE_MM, _ARM_BESIDE_DEG = 0.002, 0.1, 0.01  # an arm of the literature repeats to a tenth
_FRAME_EVERY_S = (1.1, 1.7)  # as unevenly as crews trigger: even paces leave swings of that pace open
_SETTLES_PERIODS = 2.0  # after a move nobody looks before the column has swung twice, as docs/hoisting.md asks
_TILT_DEG, _HEIGHT_MM = 0.15, 90.0  # of a column on a plumb rope; of the reference scene
_LOOKS_PER_PERIOD = 60  # its largest distance between two of them is missed by less than 0.2 %


@dataclass
class DrawnColumn:
    """A column on a crane (or an arm), and the frames that a camera would have of it: a machine for a controller."""

    design: ColumnDesign
    own_mm: Array
    hanging: HangingColumn
    rng: np.random.Generator
    arm: bool = False
    time_s: float = 0.0
    landed: bool = False
    moves: int = 0

    def __post_init__(self) -> None:
        lasting = self.rng.normal(0.0, _LASTING_MM, self.own_mm.shape)
        self._lasting = lasting + self.rng.normal(0.0, _SHARED_LASTING_MM, 2)
        self._move = np.zeros(3)

    def offsets_mm(self, place: Array) -> Array:
        """True offsets (k, 2), rebar minus sleeve, of a column at a place (3,)."""
        centres = np.array([sleeve.centre[:2] for sleeve in self.design.sleeves])
        bars = np.array([bar.centre[:2] for bar in self.design.rebars]) + self.own_mm
        return np.asarray(bars - centres @ turn(float(place[2])).T - place[:2])

    def largest_within_mm(self, seconds: float) -> float:
        """The true largest distance of a pair within so many seconds, if nobody pushes."""
        places = self.hanging.places(np.linspace(0.0, seconds, _LOOKS_PER_PERIOD))
        return max(float(np.hypot(*self.offsets_mm(place).T).max()) for place in places)

    @property
    def period_s(self) -> float:
        """The longest of its swings' periods."""
        return float(self.hanging.periods_s.max())

    def move(self, dx_mm: float, dy_mm: float, yaw_deg: float) -> None:
        """Move as well as the machine can, until the next frame."""
        gain, beside = (_ARM_GAIN_SIGMA, _ARM_BESIDE_MM) if self.arm else (_GAIN_SIGMA, _BESIDE_MM)
        aside_deg = _ARM_BESIDE_DEG if self.arm else _BESIDE_DEG
        factor = 1.0 + self.rng.normal(0.0, gain, 2)[[0, 0, 1]]
        asked = np.array([dx_mm, dy_mm, np.radians(yaw_deg)])
        off = np.append(self.rng.normal(0.0, beside, 2), np.radians(self.rng.normal(0.0, aside_deg)))
        self._move = factor * asked + off
        self.moves += 1

    def lower(self) -> None:
        """Let the column down."""
        self.landed = True

    def decided(self) -> None:
        """Let time pass up to the next frame: the crane moves if it was told to, and the column follows."""
        wait_s = float(self.rng.uniform(*_FRAME_EVERY_S))
        moving_s = float(self.rng.uniform(*_MOVE_S)) if self._move.any() else 0.0
        if moving_s:
            self.hanging.advance(moving_s, self._move / moving_s)
            wait_s += _SETTLES_PERIODS * self.period_s
        self.hanging.advance(wait_s)
        self.time_s += moving_s + wait_s
        self._move = np.zeros(3)

    def frame(self) -> HoistingMeasurement:
        """A frame of the column as it hangs now."""
        true = self.offsets_mm(self.hanging.place)
        noise = self.rng.normal(0.0, _OWN_MM, true.shape) + self.rng.normal(0.0, _SHARED_MM, 2)
        offsets = true + self._lasting + noise
        covariances = np.tile(_STATED_MM**2 * np.eye(2), (len(true), 1, 1))
        centres = np.array([sleeve.centre[:2] for sleeve in self.design.sleeves])
        seen = np.zeros(len(true), bool)
        seen[np.argsort(centres.sum(axis=1))[:_SEEN]] = True
        pairs = tuple(self._pair(k, offsets[k], covariances[k], bool(seen[k])) for k in range(len(true)))
        distances = np.hypot(*offsets.T)
        hidden = tuple(label for pair in pairs if not pair.seen for label in (pair.sleeve, pair.rebar))
        report = HoistingReport(
            source=f"{self.time_s:.1f} s",
            keys=(),
            mean_mm=float(distances.mean()),
            max_mm=float(distances.max()),
            column_tilt_deg=float(abs(self.rng.normal(0.0, _TILT_DEG))),
            verdict=worst(pair.verdict for pair in pairs),
            pairs=pairs,
            correction=self._correction(centres, offsets),
            method="drawn",
            height_mm=_HEIGHT_MM,
            orientation="declared",
            near="-x-y",
            rests_on_scans=hidden,
        )
        return HoistingMeasurement(report, offsets, covariances)

    def _pair(self, k: int, offset: Array, covariance: Array, seen: bool) -> HoistingPair:
        decided = decide_radial(offset, covariance, LIMIT_MM, "guarded")
        return HoistingPair(
            sleeve=self.design.sleeves[k].label,
            rebar=self.design.rebars[k].label,
            sleeve_scan_mm=None,
            rebar_scan_mm=None,
            offset_mm=(float(offset[0]), float(offset[1])),
            distance_mm=float(np.hypot(*offset)),
            u_mm=_STATED_MM,
            seen=seen,
            sleeve_seen=seen,
            rebar_seen=seen,
            limit_mm=LIMIT_MM,
            verdict=decided.verdict,
            probability=decided.probability,
        )

    def _correction(self, centres: Array, offsets: Array) -> Correction | None:
        pose = fit_minimax(centres, centres + offsets, np.full(len(centres), LIMIT_MM))
        if isinstance(pose, NoFit):
            return None
        labels = tuple(sleeve.label for sleeve in self.design.sleeves)
        return Correction(
            float(pose.shift[0]), float(pose.shift[1]), float(np.degrees(pose.yaw)), u_mm=_OWN_MM, over=labels
        )


def drawn_column(seed: int, *, arm: bool = False) -> DrawnColumn:
    """A random laboratory column that hangs where a driver brings it by eye, and swings."""
    rng = np.random.default_rng([97, seed])
    design = design_of(LAB)
    own = rng.normal(0.0, _SCATTER_MM, (len(design.sleeves), 2))
    rest = np.append(rng.uniform(-_FIRST_MM, _FIRST_MM, 2), np.radians(rng.uniform(-_FIRST_DEG, _FIRST_DEG)))
    periods_s = np.append(np.repeat(rng.uniform(*_PERIODS_S), 2), rng.uniform(*_TURN_PERIOD_S))
    damping = np.full(3, rng.uniform(*_DAMPING))
    swing, phase = rng.uniform(*_SWING_MM), rng.uniform(0.0, 2.0 * np.pi, 2)
    aside = np.array([swing * np.cos(phase[0]), swing * np.sin(phase[0]), swing * np.sin(phase[1]) / LAB.size])
    if arm:  # it stands where it is put
        return DrawnColumn(
            design, own, HangingColumn(rest, np.zeros(3), rest, np.full(3, 0.2), np.full(3, 0.9)), rng, True
        )
    speed = aside * np.sin(phase[1]) * 2.0 * np.pi / periods_s
    hanging = HangingColumn(rest + aside * np.cos(phase[1]), speed, rest, periods_s, damping)
    hanging.advance(_SETTLES_PERIODS * float(periods_s.max()))
    return DrawnColumn(design, own, hanging, rng)
