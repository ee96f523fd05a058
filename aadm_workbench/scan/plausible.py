"""Whether a scan can be what it is declared to be: enough points, and of the size of the component."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, AssemblyPoint, Reason, Scan, codes_of
from aadm_workbench.scan.ray_distance import refuse_ray_distances

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
        return _without_strays(scan, np.median(sample, axis=0), LARGEST_EXTENT_RATIO * expected_extent_mm)
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
    lower, upper = np.percentile(points, _PERCENTILES, axis=0)
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
