"""The four edges of a foot's face, in the column frame, and how flat the face is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.foot_face import FACE_BAND_MM
from aadm_workbench.extract.plane import in_plane
from aadm_workbench.extract.sample import Thinned
from aadm_workbench.extract.section.edge_lines import EdgeLine, FoundEdge, edge_lines, find_edge
from aadm_workbench.extract.section.face_samples import face_samples, from_face, outline_on_face
from aadm_workbench.extract.section.rims import KnownMouths
from aadm_workbench.extract.section.strips import Chip
from aadm_workbench.model import Array, Extraction, Plane, Reason, Scan

SIDES = ("-y", "+x", "+y", "-x")
"""Edges in order, counter-clockwise seen from above; the column's own directions."""

_BAND_NOISES = 4.0  # of the face's own scatter; a camera that scatters more finds the face in a thicker layer


@dataclass(frozen=True, eq=False)
class SeenEdge:
    """One edge of the section in the column frame, mm: where it crosses its own axis, and how it is turned.

    ``offset_mm`` is the distance from the column's axis to the edge at ``at_mm`` along it, outwards; ``turn`` radians,
    counter-clockwise. ``covariance`` (2, 2) of both; ``shared_u_mm`` is what all edges are off by together, outwards.
    """

    side: str
    offset_mm: float
    at_mm: float
    turn: float
    covariance: Array
    shared_u_mm: float
    seen: float
    chips: tuple[Chip, ...]


def section_edges(
    scan: Scan,
    sample: Thinned,
    extraction: Extraction,
    T_scan_column: Array,
    outline: Array,
    diameters_mm: Sequence[float],
) -> dict[str, SeenEdge | Reason]:
    """Edges of the face by their sides, or why one is not measured.

    Parameters
    ----------
    sample
        Of the scan, thinned.
    extraction
        The sleeves of this scan: its plane, and mouths whose edges show what the camera does to edges.
    outline
        (4, 2) mm, corners of the section by design, column frame, from (−x, −y) counter-clockwise seen from above.
    diameters_mm
        Of the bores, by design: what a camera loses at rims widens the bores that it sees.
    """
    face = extraction.plane
    if face is None:
        return dict.fromkeys(SIDES, Reason("extract.section_no_face"))
    band_mm = max(FACE_BAND_MM, _BAND_NOISES * face.residual_mm)
    corners = outline_on_face(outline, T_scan_column, face)
    samples = face_samples(scan, sample, face, band_mm, corners)
    if samples is None:
        return dict.fromkeys(SIDES, Reason("extract.section_thin"))
    mouths = _mouths(extraction, np.asarray(diameters_mm, np.float64))
    # Seen from outside, as the face's axes are, the corners run clockwise: the face lies to the left of the way back.
    found: dict[str, FoundEdge | Reason] = {}
    for number, side in enumerate(SIDES):
        ends = corners[number], corners[(number + 1) % 4]
        start, end = ends if _area(corners) > 0.0 else ends[::-1]
        found[side] = find_edge(samples, start, end, mouths, band_mm)
    return {
        side: line if isinstance(line, Reason) else _in_column(line, side, face, T_scan_column)
        for side, line in edge_lines(samples, found, mouths).items()
    }


def _area(corners: Array) -> float:
    x, y = corners.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0


def _mouths(extraction: Extraction, diameters_mm: Array) -> KnownMouths:
    assert extraction.plane is not None
    centres = np.array([point.centre for point in extraction.points]).reshape(-1, 3)
    measured = np.array([point.diameter_mm for point in extraction.points])
    nearest = np.abs(measured[:, None] - diameters_mm).argmin(axis=1) if len(measured) else np.zeros(0, np.int64)
    return KnownMouths(in_plane(centres, extraction.plane)[:, :2], diameters_mm[nearest] / 2.0)


def _in_column(line: EdgeLine, side: str, face: Plane, T_scan_column: Array) -> SeenEdge:
    """The line as seen along its side: two points of it, brought over."""
    half_mm = 100.0  # any two points will do
    ends = np.array([-half_mm, half_mm])
    places = np.outer(line.middle_mm + ends, line.along) + np.outer(line.offset_mm + line.turn * ends, line.normal)
    T = np.asarray(np.linalg.inv(T_scan_column), np.float64)
    xy = (from_face(places, face) @ T[:3, :3].T + T[:3, 3])[:, :2]
    sign, axis = (1.0 if side[0] == "+" else -1.0), "xy".index(side[1])
    outwards, along = np.zeros(2), np.zeros(2)
    outwards[axis] = sign
    along[:] = -outwards[1], outwards[0]
    middle, way = xy.mean(axis=0), xy[1] - xy[0]
    way *= np.sign(way @ along)
    # Seen from above an edge that runs outwards on its way is turned clockwise.
    turn = float(np.arctan2(-(way @ outwards), way @ along))
    mirrored = np.sign((xy[1] - xy[0]) @ along)
    covariance = line.covariance * np.array([[1.0, -mirrored], [-mirrored, 1.0]])
    chips = tuple(_chip(chip, line, face, T, along) for chip in line.chips)
    return SeenEdge(
        side, float(middle @ outwards), float(middle @ along), turn, covariance, line.shared_u_mm, line.seen, chips
    )


def _chip(chip: Chip, line: EdgeLine, face: Plane, T_column_scan: Array, along: Array) -> Chip:
    ends = np.array([chip.begin_mm, chip.end_mm])
    places = np.outer(ends, line.along) + line.offset_mm * line.normal
    at = (from_face(places, face) @ T_column_scan[:3, :3].T + T_column_scan[:3, 3])[:, :2] @ along
    return Chip(float(at.min()), float(at.max()), chip.depth_mm)
