"""What a report tells of a column, as far as the tower needs it: the one place of this room that reads it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar
from aadm_workbench.assembly.pose.play import Gap, pair_gaps
from aadm_workbench.model import (
    Array,
    ColumnReport,
    GroupReport,
    HoistingReport,
    JobReport,
    Kind,
    PointResult,
    TrialReport,
    Verdict,
)
from aadm_workbench.model.results import AimedPose, TrialPose
from aadm_workbench.report.directions import Compass, Heading, compass_of, grid_of
from aadm_workbench.report.words.labels import Phrase

_AS_ASKED = 0.01
"""mm and degrees: what was asked for has two decimals, and may be rounded over a limit by as much."""

PLAIN = Compass(
    (
        Heading((1.0, 0.0), Phrase("towards +x", "向 +x "), Phrase("towards −x", "向 −x ")),
        Heading((0.0, 1.0), Phrase("towards +y", "向 +y "), Phrase("towards −y", "向 −y ")),
    ),
    0.0,
    placed=False,
)
"""Directions of the column itself, where nothing better is known."""


@dataclass(frozen=True, eq=False)
class MeasuredPair:
    """A sleeve and its bar at the pose of the trial: bar minus sleeve, mm, in the column frame.

    ``place`` (2,) mm is the sleeve's in the column frame, ``gaps`` what must stay within limits: the centres, and the
    axes at both ends of the embedded length.
    """

    sleeve: str
    rebar: str
    place: Array
    offset: Array
    u_mm: float | None
    gaps: tuple[Gap, ...]


@dataclass(frozen=True, eq=False)
class Ground:
    """Where the bars stand in the building by control points: ``planar`` (3,) dx, dy mm, yaw radians; (3, 3)."""

    planar: Array
    covariance: Array


@dataclass(frozen=True, eq=False)
class Hung:
    """The column as its last good hoisting frame saw it: sleeves (n, 2) and where they hang over the bars (n, 2), mm.

    ``u_mm`` (n,) per axis; ``source`` is the frame.
    """

    source: str
    sleeves: Array
    over: Array
    u_mm: Array


@dataclass(frozen=True, eq=False)
class MeasuredColumn:
    """One column of a report.

    Parameters
    ----------
    T_bars_sleeves
        (4, 4), the pose of the trial that people are shown: sleeves onto bars, both in the column frame; None without.
    turn_deg
        Of the column by the symmetry of its sleeves, where the job lets it be turned.
    window
        How far it can move from that pose: ``dx_mm``, ``dy_mm``, ``yaw_deg``, each from, to; None without play.
    told
        dx, dy mm and yaw degrees that the job told the crane to aim at, as far as no limit forbids it; None without.
    told_is_cut
        Whether a limit did forbid a part of what the job asked for.
    radius_mm
        Of the bars about the axis, root mean square; None where nothing was measured.
    compass
        How directions at this column are called.
    """

    id: str
    global_id: str | None
    storey: str | None
    grid: str | None
    size_mm: tuple[float, float] | None
    T_model_column: Array | None
    verdict: Verdict
    goes_on: Verdict
    reason: str
    pairs: tuple[MeasuredPair, ...] = ()
    T_bars_sleeves: Array | None = None
    turn_deg: float = 0.0
    window: Mapping[str, tuple[float, float]] | None = None
    told: tuple[float, float, float] | None = None
    told_is_cut: bool = False
    ground: Ground | None = None
    hung: Hung | None = None
    radius_mm: float | None = None
    compass: Compass = PLAIN

    @property
    def gaps(self) -> list[tuple[Gap, Array]]:
        """All distances that have to stay within limits, each with the place (2,) mm of its sleeve."""
        return [(gap, pair.place) for pair in self.pairs for gap in pair.gaps]


@dataclass(frozen=True, eq=False)
class MeasuredFloor:
    """One report: its name, its columns, and how its job decides."""

    name: str
    columns: tuple[MeasuredColumn, ...]
    decision: str


def measured_floor(report: JobReport) -> MeasuredFloor:
    """A report as this room needs it."""
    columns = (_column(column, compass_of(grid_of(report), column)) for column in report.columns)
    return MeasuredFloor(str(report.job["name"]), tuple(columns), str(report.job.get("decision", "guarded")))


def _column(column: ColumnReport, compass: Compass) -> MeasuredColumn:
    trial = column.trial_assembly or TrialReport(Verdict.NOT_ASSESSED)
    pose, target, window = trial.shown, trial.target, trial.window
    points = _Points.of(column)
    return MeasuredColumn(
        id=column.id,
        global_id=column.global_id,
        storey=column.storey,
        grid=column.grid,
        size_mm=column.size_mm,
        T_model_column=column.T_model_column,
        verdict=column.verdict,
        goes_on=column.goes_on,
        reason=next(iter(column.reasons), ""),
        pairs=() if pose is None else tuple(_pairs(pose, points, trial.embedded_length_mm)),
        T_bars_sleeves=None if pose is None else np.asarray(np.linalg.inv(pose.T_sleeves_rebars), np.float64),
        turn_deg=trial.turn_deg,
        window=None if window is None else {name: getattr(window, name) for name in ("dx_mm", "dy_mm", "yaw_deg")},
        told=None if target is None else (target.dx_mm, target.dy_mm, target.yaw_deg),
        told_is_cut=target is not None and _is_cut(target),
        ground=None if column.rebars is None else _ground(column.rebars),
        hung=_hung(column.hoisting, points),
        radius_mm=_radius_mm(column),
        compass=compass,
    )


class _Points(NamedTuple):
    """Sleeves and rebars of a column by their labels."""

    sleeves: Mapping[str, PointResult]
    rebars: Mapping[str, PointResult]

    @classmethod
    def of(cls, column: ColumnReport) -> _Points:
        return cls(*({point.label: point for point in column.points(kind)} for kind in Kind))

    def pair(self, sleeve: str, rebar: str) -> tuple[PointResult | None, PointResult | None]:
        return self.sleeves.get(sleeve), self.rebars.get(rebar)


def _place(point: PointResult) -> Array:
    """Where a point stands in the plan of the column frame, (2,) mm: as measured, else as designed."""
    return np.array((point.aligned_mm or point.design_mm)[:2])


def _radius_mm(column: ColumnReport) -> float | None:
    for kind in (Kind.REBAR, Kind.SLEEVE):
        places = [point.design_mm[:2] for point in column.points(kind)]
        if places and (square := float((np.array(places) ** 2).sum(axis=1).mean())) > 0.0:
            return math.sqrt(square)
    return None


def _is_cut(target: AimedPose) -> bool:
    told = target.dx_mm, target.dy_mm, target.yaw_deg
    return not np.allclose(told, target.asked, rtol=0.0, atol=_AS_ASKED)


def _pairs(pose: TrialPose, points: _Points, length_mm: float | None) -> Iterator[MeasuredPair]:
    for pair in pose.pairs:
        sleeve, rebar = points.pair(pair.sleeve, pair.rebar)
        if sleeve is not None:
            gaps = tuple(pair_gaps(pair, [_lean(rebar), _lean(sleeve)], length_mm))
            yield MeasuredPair(pair.sleeve, pair.rebar, _place(sleeve), np.array(pair.offset_mm), pair.u_mm, gaps)


def _lean(point: PointResult | None) -> Array | None:
    """How far an axis moves in the plan, (2,), for each mm along the column."""
    axis = None if point is None else point.axis
    return None if axis is None else np.array(axis[:2]) / axis[2]


def _ground(rebars: GroupReport) -> Ground | None:
    """The motion that takes the bars from where their own fit has them to where control points have them."""
    absolute = rebars.absolute
    if absolute is None or absolute.offset_mm is None or absolute.turn_u_deg is None:
        return None
    own = {point.label: point for point in rebars.points}
    fitted, placed = [], []
    for point in absolute.points:
        bar = own.get(point.label)
        if bar is not None and bar.aligned_mm is not None and point.offset_mm is not None:
            fitted.append(bar.aligned_mm[:2])
            placed.append(np.array(bar.design_mm[:2]) + point.offset_mm)
    if len(fitted) < 2:
        return None
    u_mm, u_turn = absolute.u_mm or 0.0, math.radians(absolute.turn_u_deg)
    return Ground(rigid_motion(np.array(fitted), np.array(placed)), np.diag(np.square([u_mm, u_mm, u_turn])))


def _hung(frames: Sequence[HoistingReport], points: _Points) -> Hung | None:
    """The last frame, where in it the column hangs so that it may be let down."""
    if not frames or frames[-1].verdict is not Verdict.PASS:
        return None
    rows = []
    for pair in frames[-1].pairs:
        sleeve, rebar = points.pair(pair.sleeve, pair.rebar)
        if sleeve is not None and rebar is not None and pair.offset_mm is not None and pair.u_mm:
            rows.append((_place(sleeve), _place(rebar) - np.array(pair.offset_mm), pair.u_mm))
    if len(rows) < 2:
        return None
    places, over, u_mm = zip(*rows, strict=True)
    return Hung(frames[-1].source, np.array(places), np.array(over), np.array(u_mm))


def rigid_motion(source: Array, target: Array, weights: Array | None = None) -> Array:
    """Least squares motion in the plan, (3,) dx, dy mm and yaw radians, of points (n, 2) onto others (n, 2)."""
    fit = fit_eopa_planar(source, target, weights)
    if isinstance(fit, NoFit):  # points that all lie on one spot do not turn
        return np.array([*np.average(target - source, axis=0, weights=weights), 0.0])
    return np.array([*fit.t, fit.yaw])
