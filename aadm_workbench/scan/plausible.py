"""Whether a scan can be what it is declared to be: enough points, and of the size of the component."""

from __future__ import annotations

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, Scan

FEWEST_POINTS = 500
"""Fewer than this cannot show a pattern of holes or bars."""

SMALLEST_EXTENT_RATIO = 1 / 20
LARGEST_EXTENT_RATIO = 100.0
"""Extent of a scan over extent of the pattern in it; a wrong unit is a factor of 1000."""

_PERCENTILES = (1.0, 99.0)
_SAMPLE_SIZE = 50_000
_MM_PER_INCH = 25.4


def check_plausible(scan: Scan, expected_extent_mm: float) -> None:
    """Check that a scan has points enough and spans about what the pattern spans that it should show.

    Nothing is rescaled: the unit is the job's to say.

    Parameters
    ----------
    scan
        Points in mm, by the unit that was declared.
    expected_extent_mm
        Longest side of the pattern of sleeves or bars by design.

    Raises
    ------
    ScanError
        Saying how many points there are, or what they span and what to write in the job.
    """
    name = scan.source or "the scan"
    finite = _finite_points(scan)
    if len(finite) < FEWEST_POINTS:
        raise ScanError(f"{name}: has {len(finite)} points, {FEWEST_POINTS} are the least to measure on; scan it again")
    spans_mm = _robust_spans(finite)
    ratio = float(spans_mm.max()) / expected_extent_mm
    if SMALLEST_EXTENT_RATIO <= ratio <= LARGEST_EXTENT_RATIO:
        return
    sizes = " x ".join(f"{span:.4g}" for span in spans_mm)
    raise ScanError(
        f"{name}: its points span {sizes} mm, but the pattern to be found in it spans {expected_extent_mm:.4g} mm; "
        f"{_suggestion(ratio)}"
    )


def _finite_points(scan: Scan) -> Array:
    flat = scan.points.reshape(-1, 3)
    return flat[np.isfinite(flat).all(axis=1)].astype(np.float64)


def _robust_spans(points: Array) -> Array:
    """Return (3,) the sides in mm of the box that holds the middle 98 % of the points along each axis."""
    sample = points[:: max(1, len(points) // _SAMPLE_SIZE)]
    lower, upper = np.percentile(sample, _PERCENTILES, axis=0)
    spans: Array = upper - lower
    return spans


def _is_plausible(ratio: float) -> bool:
    return SMALLEST_EXTENT_RATIO <= ratio <= LARGEST_EXTENT_RATIO


def _suggestion(ratio: float) -> str:
    if _is_plausible(ratio * 1000):
        if _is_plausible(ratio * _MM_PER_INCH):
            return 'it looks like metres or inches declared as mm: write units = "m" in the job, or convert the inches'
        return (
            'it looks like metres declared as mm: write units = "m" in the job, or for a 16-bit depth map the right '
            "depth_scale_mm"
        )
    if _is_plausible(ratio / 1000):
        return 'it looks like mm declared as metres: write units = "mm" in the job'
    return "no unit explains that: check that the scan shows this component, and crop what does not belong to it"
