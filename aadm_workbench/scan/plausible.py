"""Whether a scan can be what it is declared to be: enough points, and of the size of the component.

Distances along the rays that were saved as depths along the optical axis: they make a bowl of every face.

A pixel's depth is its distance divided by s = sqrt(1 + (x/z)² + (y/z)²), which is 1 in the middle of the picture and
1.02 to 1.07 at its edge: a flat foot is then hollow by centimetres, and its sleeves lie a millimetre off. The largest
face tells: it is flat in one of the two readings alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, AssemblyPoint, BoolArray, IntArray, Reason, Scan, codes_of
from aadm_workbench.model.special import median, percentiles

FEWEST_POINTS = 500
"""Fewer than this cannot show a pattern of holes or bars."""

SMALLEST_EXTENT_RATIO = 1 / 20
"""Extent of a scan over that of its component: a part of a foot may be seen, no corner of a single sleeve."""
LARGEST_EXTENT_RATIO = 100.0
"""Extent of a scan over extent of the pattern in it; a wrong unit is a factor of 1000."""

_PERCENTILES = (1.0, 99.0)  # of coordinates: strays beyond do not stretch what is measured
_SAMPLE_SIZE = 50_000  # points: percentiles to a tenth of one
_MM_PER_INCH = 25.4  # exactly, since 1959


def extent_mm(points: Sequence[AssemblyPoint]) -> float:
    """Longest side of a pattern in the plane, mm, over the outsides of its sleeves or bars."""
    centres = np.array([point.centre[:2] for point in points])
    return float(np.ptp(centres, axis=0).max()) + max(point.diameter_mm for point in points)


def check_plausible(scan: Scan, expected_extent_mm: float) -> Scan:
    """Check that a scan has points enough and spans about what the pattern spans that it should show.

    The unit is the job's, or the file's, to say. Where these two contradict each other and only the job's fits the
    size, the scan is returned in the job's unit, and its notes say so. Nothing else is ever rescaled. Strays, points
    further off than anything in the view can be, are left out, counted and noted.

    Parameters
    ----------
    scan
        Points in mm, by the unit that was declared.
    expected_extent_mm
        Longest side of the pattern of sleeves or bars by design.

    Returns
    -------
    Scan
        The same scan, unless the job's unit had to be taken or there are strays.

    Raises
    ------
    ScanError
        Saying how many points there are, what they span and what to write in the job, or that depths are distances
        along the rays.
    """
    name = scan.source or "the scan"
    measured = np.flatnonzero(np.isfinite(scan.points.reshape(-1, 3)[:, 2]))
    if len(measured) < FEWEST_POINTS:
        raise ScanError(Reason("scan.few_points", name=name, count=len(measured), needed=FEWEST_POINTS))
    sample = scan.points.reshape(-1, 3)[measured[:: max(1, len(measured) // _SAMPLE_SIZE)]].astype(np.float64)
    spans_mm = _robust_spans(sample)
    ratio = float(spans_mm.max()) / expected_extent_mm
    if _is_plausible(ratio):
        refuse_ray_distances(scan, sample)
        return _without_strays(scan, median(sample, axis=0), LARGEST_EXTENT_RATIO * expected_extent_mm)
    if scan.declared_scale != 1.0 and _is_plausible(ratio * scan.declared_scale):
        return check_plausible(_in_declared_unit(scan), expected_extent_mm)
    sizes = " x ".join(f"{span:.4g}" for span in spans_mm)
    raise ScanError(
        Reason("scan.span", name=name, sizes=sizes, expected_mm=expected_extent_mm, remedy=_suggestion(ratio))
    )


def _in_declared_unit(scan: Scan) -> Scan:
    """The scan in the unit that the job declares, against what its file says."""
    scale = scan.declared_scale
    note = Reason("scan.unit_of_job")
    return replace(
        scan,
        points=scan.points * scan.points.dtype.type(scale),
        viewpoint=None if scan.viewpoint is None else scan.viewpoint * scale,
        notes=(*(text for text in scan.notes if "scan.unit_of_file" not in codes_of(text)), note),
        declared_scale=1.0,
    )


def _without_strays(scan: Scan, middle: Array, reach_mm: float) -> Scan:
    """The scan without its points that are further than a length from its middle (3,), along any axis."""
    flat = scan.points.reshape(-1, 3)
    # What a camera sees is bounded sideways by its view.
    axes = (0, 1, 2) if scan.camera is None else (2,)
    reaches = [max(np.fmax.reduce(flat[:, k]) - middle[k], middle[k] - np.fmin.reduce(flat[:, k])) for k in axes]
    if max(reaches) <= reach_mm:
        return scan
    is_stray = (np.abs(flat - middle) > reach_mm).any(axis=1)
    count = int(np.count_nonzero(is_stray))
    points = scan.points.copy()
    if scan.organised:
        points.reshape(-1, 3)[is_stray] = np.nan
    else:
        points = flat[~is_stray]
    note = Reason("scan.stray", count=count, reach_m=reach_mm / 1000.0)
    return replace(scan, points=points, dropped=scan.dropped + count, notes=(*scan.notes, note))


def _robust_spans(points: Array) -> Array:
    """Return (3,) the sides in mm of the box that holds the middle 98 % of the points along each axis."""
    lower, upper = percentiles(points, _PERCENTILES)
    spans: Array = upper - lower
    return spans


def _is_plausible(ratio: float) -> bool:
    return SMALLEST_EXTENT_RATIO <= ratio <= LARGEST_EXTENT_RATIO


def _suggestion(ratio: float) -> str:
    if _is_plausible(ratio * 1000):
        if _is_plausible(ratio * _MM_PER_INCH):
            return Reason("scan.metres_or_inches")
        return Reason("scan.metres")
    if _is_plausible(ratio / 1000):
        return Reason("scan.millimetres")
    return Reason("scan.no_unit")


_RAY_SAMPLE_SIZE = 2_000  # points: a bowl shows on far fewer
_TRIALS, _FIRST_TRIALS = 300, 40
"""Triples of points; the first ones find a face that most points lie on, which ends the search."""

_WITHIN_MM = 1.5
"""Of a plane: three standard deviations of a noisy scan in the field."""

_LEAST_SHARE = 0.2
"""Of the points that the largest face has; a smaller one is found by chance, and proves nothing."""

_AHEAD = 0.99
"""Share of the points before the camera: of a cloud in another frame nothing is said."""

_MORE_POINTS = 1.5  # a choice, not tuned since
_LEAST_BOWL_MM = 1.0
"""Standard deviation of the bowl: less may be a bent mould or a camera's warp."""

_TIMES_FLATTER = 6.0
"""How much flatter the face must be along the rays. No face is hollow just so, about just this point: of curved ones
the right fraction would have to be taken by chance."""


def refuse_ray_distances(scan: Scan, sample: Array) -> None:
    """Refuse a scan whose largest face is a bowl as it stands, and flat if its depths are distances along the rays.

    Parameters
    ----------
    sample
        (n, 3) float64, mm, scan frame: finite points spread over the scan; at least three.

    Raises
    ------
    ScanError
        Only where both readings of the scan differ clearly.
    """
    ahead = sample[:, 2] > 0
    if scan.viewpoint is None or scan.viewpoint.any() or ahead.mean() < _AHEAD:
        return
    points = sample[ahead][:: max(1, len(sample) // _RAY_SAMPLE_SIZE)]
    triples = np.random.default_rng(0).integers(0, len(points), (_TRIALS, 3))
    if _MORE_POINTS * _largest_face(points, triples[:_FIRST_TRIALS]).mean() > 1.0:
        return
    along_rays = points * (points[:, 2] / np.linalg.norm(points, axis=1))[:, None]
    flat = _largest_face(along_rays, triples)
    if flat.mean() < max(_LEAST_SHARE, _MORE_POINTS * _largest_face(points, triples).mean()):
        return
    bowl_mm, flat_mm = _scatter_mm(points[flat]), _scatter_mm(along_rays[flat])
    if bowl_mm > max(_LEAST_BOWL_MM, _TIMES_FLATTER * flat_mm):
        raise ScanError(Reason("scan.ray_distances", name=scan.source or "the scan", bowl_mm=bowl_mm, flat_mm=flat_mm))


def _largest_face(points: Array, triples: IntArray) -> BoolArray:
    """Whether each of some points (n,) lies on the plane through three of them (k, 3) that most of them lie on."""
    first, second, third = (points[triples[:, k]] for k in range(3))
    normals = np.cross(second - first, third - first)
    length = np.linalg.norm(normals, axis=1)
    is_plane = length > 0
    normals = normals[is_plane] / length[is_plane, None]
    offsets = np.einsum("ij,ij->i", normals, first[is_plane])
    near = np.abs(points.astype(np.float32) @ normals.T.astype(np.float32) - offsets.astype(np.float32)) < _WITHIN_MM
    if not near.size:
        return np.zeros(len(points), bool)
    best = near[:, int(near.sum(axis=0).argmax())]
    return _near_plane(points, points[best])


def _near_plane(points: Array, of: Array) -> BoolArray:
    normal, middle = _plane(of)
    return np.asarray(np.abs((points - middle) @ normal) < _WITHIN_MM)


def _plane(points: Array) -> tuple[Array, Array]:
    """Return normal and middle of the plane of least squares."""
    middle = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - middle, full_matrices=False)
    return axes[2], middle


def _scatter_mm(points: Array) -> float:
    """Standard deviation of points about their plane of least squares."""
    normal, middle = _plane(points)
    return float(np.std((points - middle) @ normal))
