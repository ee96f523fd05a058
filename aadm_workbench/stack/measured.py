"""What report.json tells of a column, as far as the tower needs it: the one place of this room that reads it."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from aadm_workbench.assembly.pose.play import Gap, pair_gaps
from aadm_workbench.model import Array, BestPair, JobReport, Verdict
from aadm_workbench.report.directions import Compass, Heading, compass_of
from aadm_workbench.report.json import encoded_report
from aadm_workbench.report.words.labels import Phrase

_Json = Mapping[str, Any]

_AS_ASKED = 1e-3
"""mm and degrees: rounding of what was asked for."""

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
    ground_reason: str = ""
    hung: Hung | None = None
    radius_mm: float | None = None
    compass: Compass = PLAIN

    @property
    def gaps(self) -> list[tuple[Gap, Array]]:
        """All distances that have to stay within limits, each with the place (2,) mm of its sleeve."""
        return [(gap, pair.place) for pair in self.pairs for gap in pair.gaps]


@dataclass(frozen=True, eq=False)
class MeasuredFloor:
    """One report: its columns, the model it was checked against, the settings and rules that it carries."""

    name: str
    columns: tuple[MeasuredColumn, ...]
    model_sha256: str | None
    decision: str


def measured_floor(typed: JobReport) -> MeasuredFloor:
    """A report that was read, as this room needs it."""
    report: _Json = json.loads(encoded_report(typed))
    compasses = [compass_of(typed.columns, column) for column in typed.columns]
    return MeasuredFloor(
        name=str(report["job"]["name"]),
        columns=tuple(map(_column, report["columns"], compasses)),
        model_sha256=(report["model"] or {}).get("sha256"),
        decision=str(report["job"].get("decision", "guarded")),
    )


def _column(column: _Json, compass: Compass) -> MeasuredColumn:
    trial = column["trial_assembly"] or {}
    pose = trial.get("best") or trial.get("minimax")
    sleeves, rebars = (_points(column[kind]) for kind in ("sleeves", "rebars"))
    ground, why = _ground(column["rebars"])
    return MeasuredColumn(
        id=column["id"],
        global_id=column["global_id"],
        storey=column["storey"],
        grid=column["grid"],
        size_mm=None if column["size_mm"] is None else (column["size_mm"][0], column["size_mm"][1]),
        T_model_column=None if column["T_model_column"] is None else np.array(column["T_model_column"]),
        verdict=Verdict(column["verdict"]),
        goes_on=Verdict(column["goes_on"]),
        reason=next(iter(column["reasons"]), ""),
        pairs=tuple(_pairs(pose, sleeves, rebars, trial.get("embedded_length_mm"))),
        T_bars_sleeves=None if pose is None else np.linalg.inv(np.array(pose["T_sleeves_rebars"])),
        turn_deg=float(trial.get("turn_deg") or 0.0),
        window=trial.get("window"),
        told=_told(trial.get("target")),
        told_is_cut=_is_cut(trial.get("target")),
        ground=ground,
        ground_reason=why,
        hung=_hung(column["hoisting"], sleeves, rebars),
        radius_mm=_radius_mm(column),
        compass=compass,
    )


def _points(group: _Json | None) -> dict[str, _Json]:
    return {point["label"]: point for point in (group or {}).get("points", ())}


def _radius_mm(column: _Json) -> float | None:
    for kind in ("rebars", "sleeves"):
        places = [point["design_mm"][:2] for point in _points(column[kind]).values()]
        if places and (square := float((np.array(places) ** 2).sum(axis=1).mean())) > 0.0:
            return math.sqrt(square)
    return None


def _told(target: _Json | None) -> tuple[float, float, float] | None:
    return None if target is None else (target["dx_mm"], target["dy_mm"], target["yaw_deg"])


def _is_cut(target: _Json | None) -> bool:
    told = _told(target)
    return target is not None and told is not None and not np.allclose(told, target["asked"], rtol=0.0, atol=_AS_ASKED)


def _pairs(
    pose: _Json | None, sleeves: dict[str, _Json], rebars: dict[str, _Json], length_mm: float | None
) -> Iterator[MeasuredPair]:
    for pair in (pose or {"pairs": ()})["pairs"]:
        sleeve, rebar = sleeves.get(pair["sleeve"]), rebars.get(pair["rebar"])
        place = None if sleeve is None else sleeve["aligned_mm"] or sleeve["design_mm"]
        if place is not None:
            gaps = tuple(pair_gaps(_best_pair(pair), [_lean(rebar), _lean(sleeve)], length_mm))
            offset = np.array(pair["offset_mm"])
            yield MeasuredPair(pair["sleeve"], pair["rebar"], np.array(place[:2]), offset, pair["u_mm"], gaps)


def _best_pair(pair: _Json) -> BestPair:
    """A pair as the room of the trial knows it; older reports have no room in theirs."""
    known = {item.name for item in fields(BestPair)}
    return BestPair(**{key: value for key, value in pair.items() if key in known})


def _lean(point: _Json | None) -> Array | None:
    """How far an axis moves in the plan, (2,), for each mm along the column."""
    axis = None if point is None else point.get("axis")
    return None if axis is None else np.array(axis[:2]) / axis[2]


def _ground(rebars: _Json | None) -> tuple[Ground | None, str]:
    """The motion that takes the bars from where their own fit has them to where control points have them."""
    absolute = (rebars or {}).get("absolute")
    if not absolute or absolute.get("offset_mm") is None or absolute.get("turn_u_deg") is None:
        return None, (absolute or {}).get("reason", "")
    own = _points(rebars)
    known = [point for point in absolute["points"] if own.get(point["label"], {}).get("aligned_mm") is not None]
    if len(known) < 2:
        return None, absolute.get("reason", "")
    fitted = np.array([own[point["label"]]["aligned_mm"][:2] for point in known])
    design = np.array([own[point["label"]]["design_mm"][:2] for point in known])
    planar = rigid_motion(fitted, design + np.array([point["offset_mm"] for point in known]))
    u_mm, u_turn = float(absolute["u_mm"] or 0.0), np.radians(absolute["turn_u_deg"])
    return Ground(planar, np.diag(np.square([u_mm, u_mm, u_turn]))), ""


def _hung(frames: list[_Json], sleeves: dict[str, _Json], rebars: dict[str, _Json]) -> Hung | None:
    """The last frame, where in it the column hangs so that it may be let down."""
    if not frames or frames[-1]["verdict"] != Verdict.PASS.value:
        return None
    rows = []
    for pair in frames[-1]["pairs"]:
        sleeve, rebar = sleeves.get(pair["sleeve"]), rebars.get(pair["rebar"])
        if sleeve and rebar and pair["offset_mm"] is not None and pair["u_mm"]:
            place, bar = (np.array((p["aligned_mm"] or p["design_mm"])[:2]) for p in (sleeve, rebar))
            rows.append((place, bar - np.array(pair["offset_mm"]), pair["u_mm"]))
    if len(rows) < 2:
        return None
    places, over, u_mm = zip(*rows, strict=True)
    return Hung(frames[-1]["source"], np.array(places), np.array(over), np.array(u_mm))


def rigid_motion(source: Array, target: Array, weights: Array | None = None) -> Array:
    """Least squares motion in the plan, (3,) dx, dy mm and yaw radians, of points (n, 2) onto others (n, 2).

    Complex numbers: yaw is the argument of Σ w·conj(a)·b of the centred points.
    """
    w = np.ones(len(source)) if weights is None else weights
    a, b = (points[:, 0] + 1j * points[:, 1] for points in (source, target))
    mean_a, mean_b = np.average(a, weights=w), np.average(b, weights=w)
    turn = np.sum(w * np.conj(a - mean_a) * (b - mean_b))
    unit = turn / abs(turn) if abs(turn) > 0.0 else 1.0
    shift = mean_b - unit * mean_a
    return np.array([shift.real, shift.imag, np.angle(unit)])
