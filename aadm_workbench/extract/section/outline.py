"""The four edges of a foot's face, in the column frame, and how flat the face is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.foot_face import FACE_BAND_MM
from aadm_workbench.extract.plane import in_plane
from aadm_workbench.extract.sample import Thinned
from aadm_workbench.extract.section.edge_lines import EdgeLine, FoundEdge, edge_lines, find_edge
from aadm_workbench.extract.section.face_samples import KnownMouths, face_samples, from_face, outline_on_face
from aadm_workbench.extract.section.strips import Chip
from aadm_workbench.model import Array, Extraction, IntArray, Plane, Reason, Scan
from aadm_workbench.model.measured import OF_MEDIAN, TO_SIGMA
from aadm_workbench.model.special import median, median_of_known, quantiles

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


_CELLS = 12  # along the longer side: cells of 50 mm on a foot of 600 mm, as under a straightedge
_FEWEST = 12  # points of a cell: its median is then known to a third of the camera's noise
_OUTER_SHARE = 0.02  # of cells left out at both ends: a splash of grout is no unevenness of the face
_STRAY = 3.0  # of the scatter about a surface: what is farther off is a splash or a pit
_EDGE_MM = 4.0  # from the section's edges and mouths: there cameras bend surfaces
_BAND_MM = 8.0  # twice what a face may be uneven by; what is farther off is no face
_WARP_U_MM = 0.06  # of the camera, between far parts of its picture: half of what makers state at a metre


@dataclass(frozen=True, eq=False)
class FaceHeights:
    """``heights_mm`` (rows from −y, columns from −x) over the plane, outwards, NaN where nothing was seen.

    ``range_mm`` is between the highest and the lowest of them, without the outermost, or, where that is more, of the
    bow and the twist that all of them together have, out to the corners; ``u_mm`` its uncertainty.
    """

    cell_mm: float
    origin_mm: Array
    heights_mm: Array
    range_mm: float
    u_mm: float


def face_heights(
    sample: Thinned, face: Plane, T_column_scan: Array, low: Array, high: Array, mouths: Array, radius_mm: float
) -> FaceHeights | None:
    """Heights of the face between two corners (2,) mm of the column frame, but for mouths (k, 2); None: too few."""
    over = face.height(sample.points)
    near = np.abs(over) < _BAND_MM
    points = sample.points[near].astype(np.float64)
    height = np.asarray(over[near], np.float64)
    xy = (points @ T_column_scan[:3, :3].T + T_column_scan[:3, 3])[:, :2]
    kept = ((xy > low + _EDGE_MM) & (xy < high - _EDGE_MM)).all(axis=1)
    for mouth in mouths:
        apart = xy - mouth
        kept &= np.einsum("nk,nk->n", apart, apart) > (radius_mm + _EDGE_MM) ** 2
    xy, height = xy[kept], height[kept]
    cell_mm = float((high - low).max()) / _CELLS
    columns, rows = np.ceil((high - low) / cell_mm).astype(int)
    at = np.floor((xy - low) / cell_mm).astype(int)
    grid, count = _medians(at[:, 1] * columns + at[:, 0], height, rows * columns)
    seen = np.isfinite(grid)
    if seen.sum() < rows * columns / 2:
        return None
    noise_mm = TO_SIGMA * median_of_known(np.abs(height - grid[at[:, 1] * columns + at[:, 0]]))
    cell_u_mm = OF_MEDIAN * noise_mm / float(np.sqrt(median(count[seen])))
    grid -= _leaning(grid.reshape(rows, columns)).ravel()
    ends = quantiles(grid[seen], [_OUTER_SHARE, 1.0 - _OUTER_SHARE])
    range_mm = max(float(ends[1] - ends[0]), _bent_mm(grid.reshape(rows, columns), (high - low) / cell_mm))
    u_mm = float(np.sqrt(2.0 * (cell_u_mm**2 + _WARP_U_MM**2)))
    return FaceHeights(cell_mm, low, grid.reshape(rows, columns), range_mm, u_mm)


def _medians(cell: IntArray, height: Array, cells: int) -> tuple[Array, IntArray]:
    """Median height (cells,) of the points of each cell, NaN where they are too few, and how many they are."""
    # One key for both, cell after cell: heights lie within the band.
    order = np.argsort(cell * (3.0 * _BAND_MM) + height)
    count = np.bincount(cell, minlength=cells)
    begin = np.cumsum(count) - count
    enough = count >= _FEWEST
    lower, upper = (begin + (count - 1) // 2)[enough], (begin + count // 2)[enough]
    grid = np.full(cells, np.nan)
    grid[enough] = (height[order[lower]] + height[order[upper]]) / 2.0
    return grid, count


def _leaning(grid: Array) -> Array:
    """The plane through a grid by least squares: flatness is against the face's own plane."""
    rows, columns = np.mgrid[: grid.shape[0], : grid.shape[1]]
    terms = np.column_stack([np.ones(grid.size), rows.ravel(), columns.ravel()])
    seen = np.isfinite(grid.ravel())
    found = np.linalg.lstsq(terms[seen], grid.ravel()[seen], rcond=None)[0]
    return np.asarray((terms @ found).reshape(grid.shape))


def _bent_mm(grid: Array, sides: Array) -> float:
    """Range, mm, over a whole face of ``sides`` (2,) cells of the surface of second order that its cells lie on.

    Cells end before the corners, where a face that is bowed or twisted is farthest off.
    """
    rows, columns = np.mgrid[: grid.shape[0], : grid.shape[1]] + 0.5
    seen = np.isfinite(grid)
    terms, heights = _second_order(columns[seen], rows[seen]), grid[seen]
    kept = np.ones(len(heights), bool)
    for _ in range(2):
        found = np.linalg.lstsq(terms[kept], heights[kept], rcond=None)[0]
        off = np.abs(heights - terms @ found)
        kept = off < _STRAY * TO_SIGMA * median(off) + _WARP_U_MM
    x, y = np.meshgrid(np.linspace(0.0, sides[0], _CELLS + 1), np.linspace(0.0, sides[1], _CELLS + 1))
    return float(np.ptp(_second_order(x.ravel(), y.ravel()) @ found))


def _second_order(x: Array, y: Array) -> Array:
    return np.column_stack([np.ones_like(x), x, y, x * x, x * y, y * y])
