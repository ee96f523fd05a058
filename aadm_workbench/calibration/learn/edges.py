"""What a camera does at the edges of holes and pins whose places are known, side by side, from one capture.

Sides are those of the picture. At each edge, lines of sight are counted by how far behind it they meet the surface, in
distances of neighbouring pixels: how many of those that must find the surface do not (lost), how many of those that
cannot find it do (overhang), and how far the surface bends up before its edge (curl).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.calibration.learn.capture import PlateCapture, face_axes, sight_on_plane
from aadm_workbench.calibration.learn.stretch import mean_of
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.model import Array, BoolArray, FloatArray, Kind, Measure, Plane

SIDES = ("right", "top", "left", "bottom")
"""Of the picture, counter-clockwise from its right."""

REACH_PITCHES = 6.0
"""Behind an edge: three rings of pixels, twice."""

_CURL_PITCHES = (0.3, 1.5)  # behind an edge: as far as an edge with a blur of half a pixel reaches
_ON_SURFACE_MM = 1.5  # a curl of half a millimetre is still surface, the wall behind it is not for long
_FEWEST = 30  # lines of sight on a side: a mean of fewer is noise


@dataclass(frozen=True, slots=True)
class Side:
    """One side of all edges of a kind: pixels ``lost`` and ``overhang`` in pitches, ``curl_mm``; None: too few seen."""

    lost: Measure | None
    overhang: Measure | None
    curl_mm: Measure | None


def edges_of(captures: list[PlateCapture], plate: Plate, flat: list[Array]) -> dict[Kind, dict[str, Side]]:
    """Each side of holes and pins; ``flat`` are the true places in the face of each capture (n, 2) mm, as seen."""
    each = [_capture(capture, plate, centres) for capture, centres in zip(captures, flat, strict=True)]
    return {kind: {side: _side([one[kind][side] for one in each]) for side in SIDES} for kind in Kind}


def _side(each: list[Array]) -> Side:
    values = np.array(each)
    measured = [values[np.isfinite(values[:, k]), k] for k in range(3)]
    return Side(*(mean_of(column) if len(column) > 1 else None for column in measured))


def _capture(capture: PlateCapture, plate: Plate, centres: Array) -> dict[Kind, dict[str, Array]]:
    """Lost, overhang and curl (3,) of each side; NaN where too little is seen."""
    found: dict[Kind, dict[str, Array]] = {}
    for kind in Kind:
        mine = [k for k, place in enumerate(capture.place) if plate.places[place].kind is kind]
        height_mm = float(np.median(capture.height_mm[mine]))
        lines = lines_over(capture, height_mm)
        outside = 1.0 if kind is Kind.SLEEVE else -1.0
        rows = []
        for k in mine:
            radius = plate.places[capture.place[k]].diameter_mm / 2.0
            window = capture.window(height_mm, centres[k], radius + REACH_PITCHES * capture.pitch_mm)
            seen = lines[0][window], lines[1][window]
            rows.append(about_edge(seen, centres[k], radius, outside, capture.pitch_mm))
        behind, direction, height = (np.concatenate(parts) for parts in zip(*rows, strict=True))
        found[kind] = {side: _figures(behind, direction, height, number) for number, side in enumerate(SIDES)}
    return found


def lines_over(capture: PlateCapture, height_mm: float) -> tuple[Array, FloatArray]:
    """Where lines of sight meet a plane over the face (h, w, 2), and how far over it what they found lies (h, w)."""
    plane = Plane(capture.face.normal, capture.face.offset + height_mm)
    meets = sight_on_plane(capture.scan, plane) @ face_axes(plane)[:2].T
    return meets, plane.height(capture.scan.points.astype(np.float64))


def about_edge(
    lines: tuple[Array, FloatArray], centre: Array, radius: float, outside: float, pitch_mm: float
) -> tuple[Array, Array, Array]:
    """Of the lines of sight about one edge: pitches behind it, direction of its normal (rad), height over it."""
    meets, height = lines
    x, y = meets[..., 0] - centre[0], meets[..., 1] - centre[1]
    distance = np.hypot(x, y)
    behind = outside * (distance - radius) / pitch_mm
    near = np.abs(behind) < REACH_PITCHES
    return behind[near], np.arctan2(y[near], x[near]), height[near]


def _figures(behind: Array, direction: Array, height: Array, side: int) -> Array:
    turned = np.abs(np.mod(direction - side * np.pi / 2.0 + np.pi, 2.0 * np.pi) - np.pi)
    mine: BoolArray = turned < np.pi / 4.0
    if mine.sum() < _FEWEST:
        return np.full(3, np.nan)
    behind, height = behind[mine], height[mine]
    surface = np.abs(height) < _ON_SURFACE_MM
    within, beyond = behind > 0.0, behind < 0.0
    curled = surface & (behind > _CURL_PITCHES[0]) & (behind < _CURL_PITCHES[1])
    lost = REACH_PITCHES * float(np.mean(~surface[within]))
    overhang = REACH_PITCHES * float(np.mean(surface[beyond]))
    curl = float(np.mean(height[curled])) if curled.sum() >= _FEWEST else np.nan
    return np.array([lost, overhang, curl])
