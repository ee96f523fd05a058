"""The pass-through filter along z, and where its thresholds come from when nobody gives them.

The published method keeps a range of z (the direction of view: scans are taken vertically) and does not say how its
thresholds are chosen. Here they are read off the histogram of z, in slices of ``SLICE_MM``:

* a foot face is the run of neighbouring slices around the fullest one, down to ``RUN_SHARE`` of it;
* bar tops are what lies between the nearest point that is no stray one and the last slice that holds a good part
  of one top, both nearer than half the way to the floor.

A range of z is square to the view and not to the bars: from about 7 degrees of tilt on, the far tops of a large group
lie as deep as the floor under the near ones, and no thresholds part them.

On which side of a foot face the air is.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.plane import facing, in_plane, turned_over
from aadm_workbench.model import Array, FloatArray, Plane, Scan

SLICE_MM = 2.0  # twenty times the noise of the reference camera at 1 m
RUN_SHARE = 0.02  # of the fullest slice (a choice, not tuned since)
RUN_MARGIN_MM = 5.0  # a face that is tilted thins out towards its ends (a choice, not tuned since)
TOP_SHARE = 0.25  # of the points of one top: fewer in a slice are sides of bars
FLOOR_QUANTILE = 0.1  # bars cover less of a scan than this
FLOOR_GAP_MM = 40.0  # a scan that is shallower than this shows no floor
DEEPEST_MM = 50_000.0  # no scan of a component is as deep
_HIGHEST_TILT = 1.5  # of a slice: the lower rim of a top may lie in the slice after the one that counts

WALL_DEPTH_MM = 3.0  # from here on a point beside the plane is a wall and no noise
_AROUND = 1.1  # of the radius


def finite_points(scan: Scan) -> FloatArray:
    """All measured points (n, 3) mm of a scan, as a list."""
    points = scan.points.reshape(-1, 3)
    return points[np.isfinite(points).all(axis=1)]


def passed(points: FloatArray, z_range_mm: tuple[float, float]) -> Array:
    """Points (n, 3) mm whose z lies within a range (low, high), as float64."""
    z = points[:, 2]
    return points[(z >= z_range_mm[0]) & (z <= z_range_mm[1])].astype(np.float64)


def face_range_mm(points: FloatArray) -> tuple[float, float]:
    """Range of z, mm, of the surface that most points (n, 3) lie on."""
    counts, edges = _slices(points[:, 2])
    full = counts >= RUN_SHARE * counts.max()
    fullest = int(counts.argmax())
    after = np.flatnonzero(~full[fullest:])
    before = np.flatnonzero(~full[:fullest])
    high = edges[fullest + after[0]] if len(after) else edges[-1]
    low = edges[before[-1] + 1] if len(before) else edges[0]
    return float(low) - RUN_MARGIN_MM, float(high) + RUN_MARGIN_MM


def tops_range_mm(points: FloatArray, viewpoint: Array | None, points_of_a_top: float) -> tuple[float, float]:
    """Range of z, mm, that holds the tops of all bars among points (n, 3) and as little else as may be.

    ``points_of_a_top`` is how many points one top shows. The tops are on the viewpoint's side of the scan; without
    one, on the side where points lie farther from the floor.
    """
    sign = 1.0 if near_is_low(points[:, 2], viewpoint) else -1.0
    z = sign * points[:, 2].astype(np.float64)
    rank = min(int(points_of_a_top / 2), len(z) - 1)
    near = float(np.partition(z, rank)[rank])
    floor = float(np.quantile(z, FLOOR_QUANTILE))
    limit = (near + floor) / 2 if floor - near > FLOOR_GAP_MM else float(z.max())
    counts, edges = _slices(z[(z >= near - SLICE_MM) & (z <= limit)])
    tops = np.flatnonzero(counts >= TOP_SHARE * points_of_a_top)
    far = float(edges[tops[-1] + 1]) + _HIGHEST_TILT * SLICE_MM if len(tops) else limit
    low, high = near - RUN_MARGIN_MM, min(far, limit)
    return (low, high) if sign > 0 else (-high, -low)


def near_is_low(z: FloatArray, viewpoint: Array | None) -> bool:
    """Whether the side that a scan was taken from is that of small z."""
    middle = float(np.median(z))
    if viewpoint is not None:
        return bool(viewpoint[2] < middle)
    low, high = np.quantile(z, [0.002, 0.998])  # strays lie on either side
    return bool(middle - low >= high - middle)


def _slices(z: FloatArray) -> tuple[Array, Array]:
    """Histogram of z in slices; strays beyond the outermost thousandths do not stretch it."""
    low, middle, high = np.quantile(z, [0.0005, 0.5, 0.9995])  # as said above
    # Nor do strays without number and measure: no scan of a component is as deep as this.
    low, high = max(low, middle - DEEPEST_MM), min(high, middle + DEEPEST_MM)
    edges = np.arange(low - SLICE_MM, high + 2.0 * SLICE_MM, SLICE_MM)
    counts, edges = np.histogram(z, edges)
    return counts.astype(np.float64), np.asarray(edges, np.float64)


def out_of_the_concrete(plane: Plane, scan: Scan, points: FloatArray, centres: Array, radius_mm: float) -> Plane:
    """Turn the normal of a face to the viewpoint; without one, away from where its holes have their walls.

    ``points`` (n, 3) mm are all of the scan, ``centres`` (k, 3) mm those of the holes, both in the scan frame.
    """
    if scan.viewpoint is not None:
        return facing(plane, scan.viewpoint)
    beside = in_plane(points[np.abs(plane.height(points)) > WALL_DEPTH_MM].astype(np.float64), plane)
    balance = 0.0
    for centre in in_plane(centres, plane):
        inside = np.hypot(*(beside[:, :2] - centre[:2]).T) < _AROUND * radius_mm
        balance += float(np.sign(beside[inside, 2]).sum())
    return turned_over(plane) if balance > 0 else plane
