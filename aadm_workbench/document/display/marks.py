"""What of a result is drawn on the column: circles at true size, arrows magnified, labels. Column frame, mm."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from aadm_workbench.model import WORST_FIRST, Array, Kind, Verdict
from aadm_workbench.report.shown_pose import shown_pose

SHOWN = ("position", "minimax", "least_squares")
"""Against the design; in the trial assembly, laid on in the one way or the other."""

_SIDES = 48  # no corner is seen at the size of a screen
_LABELLED_FIRST = (*WORST_FIRST[:-1], Verdict.NOT_ASSESSED, Verdict.PASS)  # a pass says least
_ARROW_SHARE = 0.6  # of the distance of neighbours: arrows do not reach into the next mark
_FACTORS = (1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0, 500.0)  # magnifications that a person can divide by


@dataclass(frozen=True, eq=False)
class Circle:
    """A circle in the plane of the foot: ``centre`` (3,) mm, in the colour of its ``verdict``."""

    centre: Array
    radius_mm: float
    verdict: str


@dataclass(frozen=True, eq=False)
class Arrow:
    """An arrow from ``start`` (3,) to ``end`` (3,) mm, already magnified."""

    start: Array
    end: Array
    verdict: str


@dataclass(frozen=True, eq=False)
class Label:
    """A text at ``place`` (3,) mm: a name, and a length or why there is none. The smallest ``rank`` is shown first."""

    place: Array
    name: str
    value_mm: float | None
    verdict: str
    rank: int


@dataclass(frozen=True, eq=False)
class Marks:
    """All that is drawn of one result."""

    circles: tuple[Circle, ...]
    arrows: tuple[Arrow, ...]
    labels: tuple[Label, ...]


def marks_of(found: Mapping[str, Any], shown: str, magnification: float) -> Marks:
    """What is drawn of a column's entry in report.json.

    Parameters
    ----------
    shown
        One of :data:`SHOWN`.
    magnification
        Arrows are this many times as long as the deviations.
    """
    if shown == "position":
        return _positions(found, magnification)
    tried = found.get("trial_assembly")
    trial = (tried or {}).get(shown) if shown == "least_squares" else shown_pose(tried)
    return _trial(found, trial, magnification) if trial else Marks((), (), ())


def best_magnification(found: Mapping[str, Any], pitch_mm: float) -> float:
    """The round factor that makes an arrow at the limit a good half as long as neighbours are apart."""
    limits = [point["limit_mm"] for kind in Kind for point in _points(found, kind) if point.get("limit_mm")]
    longest_mm = max([*limits, 3.0]) if limits else 3.0
    wanted = _ARROW_SHARE * pitch_mm / longest_mm
    return max((factor for factor in _FACTORS if factor <= wanted), default=_FACTORS[0])


def pitch_of(found: Mapping[str, Any]) -> float:
    """Smallest distance between two design points of a kind, mm; 100 where there are fewer than two."""
    for kind in Kind:
        centres = np.array([point["design_mm"] for point in _points(found, kind)], dtype=np.float64).reshape(-1, 3)
        if len(centres) > 1:
            gaps_mm = np.linalg.norm(centres[:, None, :2] - centres[None, :, :2], axis=2)
            np.fill_diagonal(gaps_mm, np.inf)
            return float(gaps_mm.min())
    return 100.0


def ring(centre: Array, radius_mm: float) -> Array:
    """Corners (n, 3) of a closed circle in the plane of the foot."""
    turn = np.linspace(0.0, 2.0 * np.pi, _SIDES + 1)
    return np.stack(
        [
            centre[0] + radius_mm * np.cos(turn),
            centre[1] + radius_mm * np.sin(turn),
            np.full(len(turn), float(centre[2])),
        ],
        axis=1,
    )


def arrow_outline(arrow: Arrow, width_mm: float) -> Array:
    """Corners (7, 3) of a flat arrow in the plane of the foot, counter-clockwise from the tail; (0, 3) for none."""
    along = (arrow.end - arrow.start)[:2]
    length_mm = float(np.hypot(*along))
    if length_mm < 1e-6:
        return np.zeros((0, 3))
    forward = along / length_mm
    left = np.array([-forward[1], forward[0]])
    head_mm = min(2.5 * width_mm, 0.6 * length_mm)
    neck = arrow.start[:2] + forward * (length_mm - head_mm)
    half, barb = left * width_mm / 2.0, left * width_mm * 1.3
    flat = [
        arrow.start[:2] + half,
        arrow.start[:2] - half,
        neck - half,
        neck - barb,
        arrow.end[:2],
        neck + barb,
        neck + half,
    ]
    return np.column_stack([np.array(flat), np.full(7, float(arrow.start[2]))])


def _points(found: Mapping[str, Any], kind: Kind) -> Sequence[Mapping[str, Any]]:
    return (found.get(kind.plural) or {}).get("points") or ()


def _positions(found: Mapping[str, Any], magnification: float) -> Marks:
    circles: list[Circle] = []
    arrows: list[Arrow] = []
    labels: list[Label] = []
    for kind in Kind:
        for point in _points(found, kind):
            verdict = point["verdict"]
            design = _in_foot_plane(point["design_mm"])
            measured = point.get("aligned_mm")
            centre = design if measured is None else _in_foot_plane(measured)
            if measured is not None:
                circles.append(Circle(centre, _radius(point, kind), verdict))
                arrows.append(Arrow(design, design + (centre - design) * magnification, verdict))
            else:
                circles.append(Circle(centre, _radius(point, kind), verdict))
            labels.append(_label(point["label"], centre, point.get("deviation_mm"), verdict))
    return Marks(tuple(circles), tuple(arrows), tuple(labels))


def _trial(found: Mapping[str, Any], trial: Mapping[str, Any], magnification: float) -> Marks:
    T_sleeves_rebars = np.array(trial["T_sleeves_rebars"], dtype=np.float64)
    sleeves = {point["label"]: point for point in _points(found, Kind.SLEEVE)}
    rebars = {point["label"]: point for point in _points(found, Kind.REBAR)}
    circles: list[Circle] = []
    arrows: list[Arrow] = []
    labels: list[Label] = []
    for pair in trial["pairs"]:
        sleeve, rebar = sleeves.get(pair["sleeve"]), rebars.get(pair["rebar"])
        if sleeve is None or sleeve.get("aligned_mm") is None:
            continue
        mouth = _in_foot_plane(sleeve["aligned_mm"])
        circles.append(Circle(mouth, _radius(sleeve, Kind.SLEEVE), pair["verdict"]))
        if rebar is not None and rebar.get("aligned_mm") is not None:
            moved = T_sleeves_rebars @ np.append(np.array(rebar["aligned_mm"], dtype=np.float64), 1.0)
            circles.append(Circle(_in_foot_plane(moved[:3]), _radius(rebar, Kind.REBAR), pair["verdict"]))
        offset = np.array([*pair["offset_mm"], 0.0], dtype=np.float64)
        arrows.append(Arrow(mouth, mouth + offset * magnification, pair["verdict"]))
        labels.append(_label(f"{pair['sleeve']}–{pair['rebar']}", mouth, pair["distance_mm"], pair["verdict"]))
    missing = (found.get("trial_assembly") or {}).get("missing") or ()
    for name in missing:
        point = sleeves.get(name) or rebars.get(name)
        if point is not None:
            place = _in_foot_plane(point["design_mm"])
            kind = Kind.SLEEVE if name in sleeves else Kind.REBAR
            circles.append(Circle(place, _radius(point, kind), "not_measured"))
            labels.append(_label(name, place, None, "not_measured"))
    return Marks(tuple(circles), tuple(arrows), tuple(labels))


def _in_foot_plane(point_mm: Sequence[float]) -> Array:
    """Everything is drawn in the foot face: bars end inside the sleeves, where nobody would see them."""
    return np.array([float(point_mm[0]), float(point_mm[1]), 0.0])


def _radius(point: Mapping[str, Any], kind: Kind) -> float:
    fallback_mm = 40.0 if kind is Kind.SLEEVE else 20.0
    return float(point.get("diameter_mm") or fallback_mm) / 2.0


def _label(name: str, place: Array, value_mm: float | None, verdict: str) -> Label:
    order = _LABELLED_FIRST.index(verdict) if verdict in _LABELLED_FIRST else len(_LABELLED_FIRST)
    return Label(place, name, value_mm, verdict, order * 1000 - round((value_mm or 0.0) * 100))
