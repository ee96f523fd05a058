"""Distances along the rays that were saved as depths along the optical axis: they make a bowl of every face.

A pixel's depth is its distance divided by s = sqrt(1 + (x/z)² + (y/z)²), which is 1 in the middle of the picture and
1.02 to 1.07 at its edge: a flat foot is then hollow by centimetres, and its sleeves lie a millimetre off. The largest
face tells: it is flat in one of the two readings alone.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, BoolArray, IntArray, Reason, Scan

_SAMPLE_SIZE = 2_000  # points: a bowl shows on far fewer
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
    points = sample[ahead][:: max(1, len(sample) // _SAMPLE_SIZE)]
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
