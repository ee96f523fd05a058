"""A camera's profile and its figures, from captures of a plate."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from aadm_workbench.calibration.learn.capture import PlateCapture
from aadm_workbench.calibration.learn.edges import Side, edges_of
from aadm_workbench.calibration.learn.face import SeenFace, seen_face
from aadm_workbench.calibration.learn.losses import Losses, losses_of
from aadm_workbench.calibration.learn.stretch import Stretches, mean_of, stretches_of
from aadm_workbench.calibration.learn.witness import apart_mm, by_discs, mixed, shares_of
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, Kind, LearnedEdges, Measure, Reason

FEWEST_CAPTURES = 4
"""One for each quarter turn; six to twelve make the uncertainties small."""


@dataclass(frozen=True, eq=False)
class Lengths:
    """Distances between holes, as the acceptance tests have them: measured minus known, of all pairs and captures.

    ``worst_mm`` is that of the largest error, ``over_mm`` its length; ``rms_mm`` of all.
    """

    worst_mm: float
    over_mm: float
    rms_mm: float
    u_mm: float
    count: int


@dataclass(frozen=True, eq=False)
class Learned:
    """All that captures of a plate tell."""

    captures: tuple[PlateCapture, ...]
    stretches: Stretches
    scale: Measure
    edges: dict[Kind, LearnedEdges]
    sides: dict[Kind, dict[str, Side]]
    faces: tuple[SeenFace, ...]
    lengths: Lengths
    noise_grows: Measure | None
    """Power of the distance with which noise grows; None with one distance."""
    projector_mm: tuple[float, float] = (0.0, 0.0)

    @property
    def bend_mm(self) -> Array:
        """The map of what the camera bends, mean of all captures; NaN where too little was seen."""
        maps = np.array([face.bend_mm for face in self.faces])
        seen = np.isfinite(maps).sum(axis=0)
        total = np.where(np.isfinite(maps), maps, 0.0).sum(axis=0)
        return np.where(seen > 0, total / np.maximum(seen, 1), np.nan)


def learned(captures: Sequence[PlateCapture], plate: Plate) -> Learned:
    """What captures of a plate tell of their camera.

    Raises
    ------
    ScanError
        For fewer captures than one of each quarter turn.
    """
    if len(captures) < FEWEST_CAPTURES:
        raise ScanError(Reason("calibration.few_captures", count=len(captures), fewest=FEWEST_CAPTURES))
    captures, discs = _with_discs(captures, plate)
    stretches = stretches_of(captures, plate)
    true = [capture.flat - left for capture, left in zip(captures, stretches.left_mm, strict=True)]
    pitch_mm = float(np.mean([capture.pitch_mm for capture in captures]))
    edges = {
        kind: LearnedEdges(
            stretches.mean[kind],
            stretches.spread[kind],
            stretches.scatter_mm[kind] / pitch_mm,
            _size(captures, plate, kind),
            discs.losses.lost[kind],
            discs.shares[kind],
            discs.apart_mm / pitch_mm,
            _rings(captures, kind),
        )
        for kind in Kind
    }
    faces = tuple(seen_face(capture, plate, centres) for capture, centres in zip(captures, true, strict=True))
    return Learned(
        tuple(captures),
        stretches,
        _scale(captures, plate),
        edges,
        edges_of(list(captures), plate, true),
        faces,
        _lengths(captures, plate),
        _growth(captures, faces),
        discs.losses.projector_mm,
    )


@dataclass(frozen=True, eq=False)
class _Discs:
    """What discs add to the fit of all: what is lost at edges, their shares, what all centres may be off, mm."""

    losses: Losses
    shares: dict[Kind, float]
    apart_mm: float


def _with_discs(captures: Sequence[PlateCapture], plate: Plate) -> tuple[list[PlateCapture], _Discs]:
    """Captures with centres drawn to discs, as far as that makes them scatter less."""
    first = stretches_of(captures, plate)
    true = [capture.flat - left for capture, left in zip(captures, first.left_mm, strict=True)]
    losses = losses_of(captures, plate, true)
    discs = [by_discs(capture, plate, losses) for capture in captures]
    both = first, stretches_of(discs, plate)
    shares = shares_of(captures, discs, both, plate)
    found = _Discs(losses, shares, apart_mm(captures, discs, both, plate))
    return [mixed(*pair, shares, plate) for pair in zip(captures, discs, strict=True)], found


def _of_kind(capture: PlateCapture, plate: Plate, kind: Kind) -> Array:
    return np.array([k for k, place in enumerate(capture.place) if plate.places[place].kind is kind], dtype=np.int64)


def _rings(captures: Sequence[PlateCapture], kind: Kind) -> float | None:
    told = [rings for capture in captures if (rings := capture.rings.get(kind)) is not None]
    return float(np.median(told)) if told else None


def _scale(captures: Sequence[PlateCapture], plate: Plate) -> Measure:
    """By the steps from the face to the pins' ends: relative, measured over known, minus one."""
    each, pins = [], plate.of(Kind.REBAR)
    for capture in captures:
        mine = _of_kind(capture, plate, Kind.REBAR)
        known = np.array([plate.places[place].z_mm for place in capture.place[mine]])
        each.append(float(capture.height_mm[mine].sum() / known.sum()) - 1.0)
    of_steps = math.sqrt(sum(one.u_mm**2 for one in pins)) / sum(one.z_mm for one in pins)
    return mean_of(np.array(each), of_steps)


def _size(captures: Sequence[PlateCapture], plate: Plate, kind: Kind) -> Measure:
    each = []
    for capture in captures:
        mine = _of_kind(capture, plate, kind)
        known = np.array([plate.places[place].diameter_mm for place in capture.place[mine]])
        each.append(float(np.mean(capture.diameter_mm[mine] / known)) - 1.0)
    u_known = float(np.mean([one.u_mm / one.diameter_mm for one in plate.of(kind)]))
    return mean_of(np.array(each), u_known)


def _lengths(captures: Sequence[PlateCapture], plate: Plate) -> Lengths:
    errors, known = [], []
    for capture in captures:
        for one, other in combinations(_of_kind(capture, plate, Kind.SLEEVE).tolist(), 2):
            a, b = (plate.places[capture.place[k]] for k in (one, other))
            length = math.dist((a.x_mm, a.y_mm), (b.x_mm, b.y_mm))
            errors.append(math.dist(capture.flat[one], capture.flat[other]) - length)
            known.append(length)
    worst = int(np.abs(errors).argmax())
    u_mm = math.sqrt(2.0) * float(np.sqrt(np.mean([one.u_mm**2 for one in plate.of(Kind.SLEEVE)])))
    return Lengths(errors[worst], known[worst], float(np.sqrt(np.mean(np.square(errors)))), u_mm, len(errors))


_UNLIKE = 1.05  # distances: with less between them nothing can be said of how noise grows


def _growth(captures: Sequence[PlateCapture], faces: Sequence[SeenFace]) -> Measure | None:
    distance = np.log([capture.distance_mm for capture in captures])
    noise = np.log([face.noise_mm for face in faces])
    if distance.max() - distance.min() < math.log(_UNLIKE) or not np.isfinite(noise).all():
        return None
    (slope, _), covariance = np.polyfit(distance, noise, 1, cov=True)
    return Measure(float(slope), float(np.sqrt(covariance[0, 0])))
