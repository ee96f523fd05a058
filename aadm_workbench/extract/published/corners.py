"""The corners method, after Jiang et al.: edges of the foot, their corners, and the sleeves where the design has them.

Source: Long et al., section 1, which tells of Jiang et al.'s virtual trial assembly of columns by their corner points
and sets sleeves in their place. The text of Jiang et al. was not at hand; what had to be interpreted:

* *Edges*: of the plane that most points lie on, about the smallest rectangle around them, found as the product finds
  the edges of a foot's section (:mod:`aadm_workbench.extract.section.edge_lines`): what the study compares is what is
  measured, not how well it was programmed.
* *Corners*: where neighbouring edges meet, whether or not concrete is left there. Two are needed at least.
* *Fit*: the corners by design are laid on those found by least squares; which is which follows from the sides, and
  what is left open of a turn from the declared direction of the picture.
* *Sleeves*: all by design. None is measured: how far one stands off its place, no corner tells.

Bars have no corners of a column: they are measured by the product's own method.
"""

from __future__ import annotations

from collections.abc import Mapping

import cv2
import numpy as np

from aadm_workbench.extract.foot_face import FACE_BAND_MM
from aadm_workbench.extract.plane import axes_on, facing, find_planes, from_plane, in_plane
from aadm_workbench.extract.sample import Thinned, thinned
from aadm_workbench.extract.section.edge_lines import EdgeLine, FoundEdge, edge_lines, find_edge
from aadm_workbench.extract.section.face_samples import FaceSamples, KnownMouths, face_samples
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Extraction, Kind, Plane, Reason, Scan

_SAMPLE = 90_000  # points: as many as the product looks for sleeves in
_BAND_NOISES = 4.0  # as of the section's edges
_CORNERS_MIN = 2  # a shift and a turn
_LIKE_MM = 5.0  # sections are cast to it: sides that fit within it cannot be told apart
_SAME_PLACE_MM = 1.0  # a pattern whose sleeves come to lie so near to others' places is the same after a turn
_NO_MOUTHS = KnownMouths(np.zeros((0, 2)), np.zeros(0))  # the method looks for edges alone


def extract_sleeves(
    scan: Scan, design: ColumnDesign | None, rng: np.random.Generator, up_deg: float | None = None
) -> Extraction:
    """Centres of all sleeves of a design, laid into a scan of its foot by the corners of the section.

    Parameters
    ----------
    scan
        Points in mm, scan frame, of a known viewpoint; otherwise the answer is empty, with a reason.
    design
        With the size of its section and where the sleeves sit in it; otherwise likewise.
    up_deg
        Column-frame direction at the top of the picture (-y), degrees from +x, counter-clockwise from above.
    """
    if design is None or design.size_mm is None or design.section_middle_mm is None:
        return _nothing(Reason("extract.corners_design"))
    if scan.viewpoint is None:
        return _nothing(Reason("extract.corners_view"))
    sample = thinned(scan, _SAMPLE, rng)
    plane = next(iter(find_planes(sample.points, rng, 1)), None)
    if plane is None:
        return _nothing(Reason("extract.no_face"))
    face = facing(plane, scan.viewpoint)
    found = _corners(scan, sample, face)
    if len(found) < _CORNERS_MIN:
        return _nothing(Reason("extract.corners_few", found=len(found)), face)
    by_design = np.array(design.section_middle_mm) + np.array(design.size_mm) / 2.0 * np.array(
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
    )
    places = np.array([point.centre[:2] for point in design.sleeves])
    T = _chosen(_fits(found, by_design), places, face, up_deg)
    if isinstance(T, Reason):
        return _nothing(T, face)
    return _placed(design, places @ T[:, :2].T + T[:, 2], face, len(found))


def _corners(scan: Scan, sample: Thinned, face: Plane) -> dict[int, Array]:
    """Corners (2,) mm in the face's axes, by their number around it, of those whose edges were both found."""
    band_mm = max(FACE_BAND_MM, _BAND_NOISES * face.residual_mm)
    local = in_plane(sample.points, face)
    around = cv2.boxPoints(cv2.minAreaRect(local[np.abs(local[:, 2]) < band_mm, :2].astype(np.float32)))
    outline = np.asarray(around, np.float64)
    x, y = outline.T
    if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) < 0.0:
        outline = outline[::-1]
    samples = face_samples(scan, sample, face, band_mm, outline)
    if samples is None:
        return {}
    lines = _edges(samples, outline, band_mm)
    return {
        number: _meeting(before, after)
        for number in range(4)
        for before, after in [(lines[str((number - 1) % 4)], lines[str(number)])]
        if isinstance(before, EdgeLine) and isinstance(after, EdgeLine)
    }


def _edges(samples: FaceSamples, outline: Array, band_mm: float) -> Mapping[str, EdgeLine | Reason]:
    found: dict[str, FoundEdge | Reason] = {
        str(number): find_edge(samples, outline[number], outline[(number + 1) % 4], _NO_MOUTHS, band_mm)
        for number in range(4)
    }
    return edge_lines(samples, found, _NO_MOUTHS)


def _meeting(first: EdgeLine, second: EdgeLine) -> Array:
    """Where two edges meet (2,)."""
    pair = first, second
    matrix = np.array([line.normal - line.turn * line.along for line in pair])
    return np.linalg.solve(matrix, [line.offset_mm - line.turn * line.middle_mm for line in pair])


def _fits(found: Mapping[int, Array], by_design: Array) -> list[Array]:
    """Maps (2, 3) from the column frame to the face's axes for each way round in which the sides fit.

    The foot is seen from below: its corners run clockwise in the face's axes, and +y of the column is mirrored.
    """
    numbers = list(found)
    seen = np.array([found[number] for number in numbers])
    ways = [_fit(by_design[[(start - number) % 4 for number in numbers]], seen) for start in range(4)]
    least = min(rms for _, rms in ways)
    return [T for T, rms in ways if rms < least + _LIKE_MM]


def _fit(planned: Array, seen: Array) -> tuple[Array, float]:
    """The turn and shift of mirrored points (n, 2) onto others by least squares, (2, 3), and what is left, mm."""
    mirrored = (planned - planned.mean(axis=0)) * [1.0, -1.0]
    about = seen - seen.mean(axis=0)
    angle = np.arctan2(
        float(np.sum(mirrored[:, 0] * about[:, 1] - mirrored[:, 1] * about[:, 0])), float(np.sum(mirrored * about))
    )
    c, s = np.cos(angle), np.sin(angle)
    linear = np.array([[c, s], [s, -c]])
    off = about - (planned - planned.mean(axis=0)) @ linear.T
    rms = float(np.sqrt(np.mean(np.sum(off**2, axis=1))))
    return np.column_stack([linear, seen.mean(axis=0) - linear @ planned.mean(axis=0)]), rms


def _chosen(ways: list[Array], places: Array, face: Plane, up_deg: float | None) -> Array | Reason:
    """The way round that the declared direction asks for; without one, any where the pattern is the same in all."""
    if up_deg is not None:
        top = axes_on(face)[:2] @ np.array([0.0, -1.0, 0.0])  # of the picture, in the face's axes
        wanted = np.array([np.cos(np.radians(up_deg)), np.sin(np.radians(up_deg))])
        return max(ways, key=lambda T: float(top @ T[:, :2] @ wanted))
    first = places @ ways[0][:, :2].T + ways[0][:, 2]
    for T in ways[1:]:
        apart = (places @ T[:, :2].T + T[:, 2])[:, None] - first
        if np.hypot(apart[..., 0], apart[..., 1]).min(axis=1).max() > _SAME_PLACE_MM:
            return Reason("extract.corners_turn", ways=len(ways))
    return ways[0]


def _placed(design: ColumnDesign, places: Array, face: Plane, corners: int) -> Extraction:
    centres = from_plane(np.column_stack([places, np.zeros(len(places))]), face)
    vertical = -face.normal
    points = tuple(
        AssemblyPoint("", Kind.SLEEVE, centre, vertical, point.diameter_mm, why=Reason("extract.by_design"))
        for centre, point in zip(centres, design.sleeves, strict=True)
    )
    quality = {"corners": corners}
    return Extraction(Kind.SLEEVE, "corners", points, face, vertical, "plane of the foot face", quality=quality)


def _nothing(reason: Reason, face: Plane | None = None) -> Extraction:
    return Extraction(Kind.SLEEVE, "corners", (), face, None if face is None else -face.normal, reason=reason)
