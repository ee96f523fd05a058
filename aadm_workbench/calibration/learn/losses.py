"""How far behind an edge a camera sees its surface end, by how steeply it sees the wall there, and how its light falls.

A pixel at an edge is kept where the surface runs on into a wall that is seen and lit, and lost, by itself or by a
filter, where a step or a shadow follows. So the loss goes by the lesser slope of the two, of sight and of light, into
the wall. Where the light comes from is found by which place explains best what is lost.

Where a plate lies before the camera is known from its own edges: what moves all of them alike, in one capture, is open.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.calibration.learn.capture import PlateCapture, face_axes
from aadm_workbench.calibration.learn.edges import REACH_PITCHES, about_edge, lines_over
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.extract.edges.learned_edges import LEARNED_BAND_MM
from aadm_workbench.model import Array, Kind

SLOPES = (-0.4, -0.2, -0.1, -0.04, 0.0, 0.04, 0.08, 0.12, 0.16, 0.22, 0.3, 0.4)
"""Into the wall: between them losses are even. Cameras see the edges of a plate at up to 0.3; near 0 losses end."""

_SECTORS = 24  # of an edge, 15 degrees each: ten pixels of a hole at half a millimetre
_FEWEST = 8  # lines of sight in a sector: fewer tell no share
_STIFF = 1.0  # of the bend of the law, in sectors: what no edge shows is drawn between its neighbours
_TURNS, _BASES_MM = 24, (60.0, 120.0, 180.0, 240.0, 300.0, 400.0)
"""Where the light is looked for: base lines of cameras for a metre or two; 15 degrees and 60 mm move no loss by 0.1."""

_WORTH = 0.98  # of what is left without a projector: what explains less than 2 % of it is chance


@dataclass(frozen=True, eq=False)
class Losses:
    """Of each kind, how far behind the edge in pitches, at each of :data:`SLOPES`; and where the light comes from."""

    lost: dict[Kind, tuple[tuple[float, float], ...]]
    projector_mm: tuple[float, float]


@dataclass(frozen=True, eq=False)
class _Edges:
    """Sectors (n,) of all edges of a kind: pitches behind, direction (n, 2), slope of sight, 1/distance, capture."""

    behind: Array
    direction: Array
    slope: Array
    per_mm: Array
    capture: Array


def losses_of(captures: Sequence[PlateCapture], plate: Plate, true: Sequence[Array]) -> Losses:
    """The law of what is lost; ``true`` are the places (n, 2) mm of each capture's holes and pins in its face."""
    edges = {kind: _edges(captures, plate, true, kind) for kind in Kind}
    bases = [(0.0, 0.0)]
    for turn in np.arange(_TURNS) * 2.0 * np.pi / _TURNS:
        bases += [(base * float(np.cos(turn)), base * float(np.sin(turn))) for base in _BASES_MM]
    left = [sum(_law(edges[kind], base)[1] for kind in Kind) for base in bases]
    best = int(np.argmin(left))
    projector_mm = bases[best] if left[best] < _WORTH * left[0] else bases[0]
    laws = {kind: _law(edges[kind], projector_mm)[0] for kind in Kind}
    lost = {kind: tuple(zip(SLOPES, law.tolist(), strict=True)) for kind, law in laws.items()}
    return Losses(lost, projector_mm)


def _law(edges: _Edges, base_mm: tuple[float, float]) -> tuple[Array, float]:
    """Losses at :data:`SLOPES` by least squares, and the sum of squares that is left, in pitches squared."""
    lit = edges.slope - edges.direction @ np.array(base_mm) * edges.per_mm
    knots = np.array([np.interp(np.minimum(edges.slope, lit), SLOPES, row) for row in np.eye(len(SLOPES))]).T
    shifts = (edges.capture[:, None] == np.arange(edges.capture.max() + 1)).astype(np.float64)
    design = np.hstack([knots, shifts * edges.direction[:, :1], shifts * edges.direction[:, 1:]])
    bend = np.zeros((len(SLOPES) - 2, design.shape[1]))
    for row in range(len(bend)):
        bend[row, row : row + 3] = np.array([1.0, -2.0, 1.0]) * _STIFF
    wanted = np.concatenate([edges.behind, np.zeros(len(bend))])
    found = np.linalg.lstsq(np.vstack([design, bend]), wanted, rcond=None)[0]
    return found[: len(SLOPES)], float(((edges.behind - design @ found) ** 2).sum())


def _edges(captures: Sequence[PlateCapture], plate: Plate, true: Sequence[Array], kind: Kind) -> _Edges:
    side = 1.0 if kind is Kind.SLEEVE else -1.0
    rows = []
    for number, (capture, centres) in enumerate(zip(captures, true, strict=True)):
        mine = [k for k, place in enumerate(capture.place) if plate.places[place].kind is kind]
        height_mm = float(np.median(capture.height_mm[mine]))
        # the camera is the origin: its foot point on the face is the origin of the places
        eye_mm = capture.distance_mm - height_mm
        pitch_mm, lines = eye_mm / capture.camera.fx, lines_over(capture, height_mm)
        image = face_axes(capture.face)[:2, :2]
        for k in mine:
            radius = plate.places[capture.place[k]].diameter_mm / 2.0
            window = capture.window(height_mm, centres[k], radius + REACH_PITCHES * pitch_mm)
            seen = lines[0][window], lines[1][window]
            behind, direction = _sectors(*about_edge(seen, centres[k], radius, side, pitch_mm), radius / pitch_mm, side)
            out = np.column_stack([np.cos(direction), np.sin(direction)])
            slope = side * out @ centres[k] / eye_mm
            rows.append((behind, side * out @ image, slope, np.full(len(out), 1.0 / eye_mm), np.full(len(out), number)))
    return _Edges(*(np.concatenate(part) for part in zip(*rows, strict=True)))


def _sectors(behind: Array, direction: Array, height: Array, radius: float, side: float) -> tuple[Array, Array]:
    """Of sectors of one edge: how many pitches behind it the surface is seen to end, and their directions, rad.

    By the area in which the surface is found, of a ring about the edge with a ``radius`` in pitches.
    """
    sector = np.floor((direction + np.pi) / (2.0 * np.pi) * _SECTORS).astype(np.int64) % _SECTORS
    count = np.bincount(sector, minlength=_SECTORS)
    found = np.bincount(sector, np.abs(height) < LEARNED_BAND_MM, minlength=_SECTORS)
    enough = count >= _FEWEST
    share = found[enough] / count[enough]
    front, back = radius - side * REACH_PITCHES, radius + side * REACH_PITCHES
    ends = np.sqrt(np.maximum(back**2 - share * (back**2 - front**2), 0.0))
    middle = (np.flatnonzero(enough) + 0.5) / _SECTORS * 2.0 * np.pi - np.pi
    return side * (ends - radius), middle
