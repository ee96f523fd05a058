"""Alignment during hoisting as published: foot and bars to three key points each, by the paper's section 2.2.

Source: Long et al., section 2.2: pass-through filter along the camera's y splits foot from bars; foot: RANSAC plane
(50 mm, 500 iterations), orthogonal projection (Eq. 1), binary image, 3 x 3 dilation, Hough circles (at least 30 votes),
centres back to 3-D; bars: DBSCAN, RANSAC cylinder, top where the axis meets the mean height of the 20 highest points;
key points: smallest and largest x, smallest z.

What the paper leaves open, and how it was read:

* *Range thresholds* along y: the emptiest band between column and bars splits them. Of the column the band is kept in
  which its foot lies: from the lower end of its nearest edge down to that empty band.
* *Pixel size* of the binary image: the mean distance of the points that the face keeps.
* *30 votes*: as in :func:`.hough.votes_needed`.
* *Centres back to 3-D*: the binary image lies in the plane that the points were projected on; its pixels are lifted
  back from there, which is what the pinhole model with the depth of the plane (Eq. 7) comes to.
* *DBSCAN*: the neighbour distance is a quarter of the clear distance of adjacent bars, 8 mm at most: wider ones cost
  seconds and part no more.

The peers of the paper's tables are read in the same way: *pointcloud*, after Zhao et al. (plane, edge points in 3-D,
circles by RANSAC and least squares), and *image*, after Ye et al. (ellipses and strips in the depth map as a picture,
lifted by Eq. 7 with the depth beside them). Their papers' texts were not at hand.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from aadm_workbench.extract.method import BY_DESIGN
from aadm_workbench.extract.method import METHODS as RECIPES
from aadm_workbench.extract.plane import facing, from_plane, in_plane
from aadm_workbench.extract.published.binary_image import binary_image
from aadm_workbench.extract.published.edge_points import dbscan, edge_points
from aadm_workbench.extract.published.fusion import INLIER_DISTANCE_MM, ITERATIONS, projected_onto
from aadm_workbench.extract.published.hough import RADIUS_MISFIT, hough_circles, votes_needed
from aadm_workbench.extract.published.pass_through import finite_points
from aadm_workbench.extract.published.ransac_plane import open3d_for, ransac_plane
from aadm_workbench.extract.published.round_fits import ransac_circle, ransac_cylinder
from aadm_workbench.extract.sample import counts_in_cells
from aadm_workbench.model import Array, FloatArray, Plane, Reason, Scan

METHODS = tuple(method for method in RECIPES if method not in ("refined", *BY_DESIGN))
_SLICE_MM = 2.0  # as of the pass-through filter along z
# of what most slices hold; what the nearest edge of the column is deep (a choice, not tuned since)
_EMPTY_SHARE, _EDGE_MM = 0.02, 8.0
_LEVEL_COSINE, _TRIES = 0.9, 4  # 26 degrees; two sides of the column and its floor may come first
_DILATION = np.ones((3, 3), np.uint8)  # as published (2.2.1)
_CLUSTERED_MAX = 40_000  # DBSCAN takes seconds beyond
_NEIGHBOUR_SHARE, _NEIGHBOUR_MAX_MM = 0.25, 8.0  # of the clear distance of adjacent bars (2.2.2, step 1): see above
# within that distance, and of a cluster: fewer are strays; a choice, not tuned since
_CORE_POINTS, _CLUSTER_MIN = 8, 60
_CYLINDER_MM, _HIGHEST, _LEAN_MAX = 0.6, 20, 0.1  # half a rib and noise; as published (2.2.2); 6 degrees
_CYLINDER_TRIES = 5  # a cylinder that lies down is drawn once more
# as in pointcloud.py; three times that of a face seen squarely: pixels lie millimetres apart here
_FACE_MM, _CIRCLE_MM = 2.0, 1.5
_POINTS_MIN = 500  # on either side of the empty band: fewer are no foot, and no bars
_CELL_MM = 12.0  # as in sample.py


@dataclass(frozen=True, eq=False)
class KeyPoints:
    """What a published method found in a frame, scan frame, mm.

    ``sleeves`` (k, 3) and ``rebars`` (l, 3) with the foot's ``plane``, and the indices of the three key points (left,
    middle, right) of either. ``reason`` says what is missing; then there are no keys.
    """

    sleeves: Array
    rebars: Array
    plane: Plane | None
    sleeve_keys: tuple[int, ...] = ()
    rebar_keys: tuple[int, ...] = ()
    reason: str = ""

    def distances_mm(self) -> Array:
        """Eq. (11) for the three keys (3,): rebar projected on the foot's plane, to the sleeve."""
        if self.plane is None or self.reason:
            return np.full(3, np.nan)
        onto = projected_onto(self.rebars[list(self.rebar_keys)], self.plane)
        sleeves = projected_onto(self.sleeves[list(self.sleeve_keys)], self.plane)
        return np.asarray(np.linalg.norm(onto - sleeves, axis=1))


def find_key_points(
    scan: Scan, method: str, sleeve_mm: float, rebar_mm: float, clear_mm: float, rng: np.random.Generator
) -> KeyPoints:
    """Key points of foot and bars by a method of the literature.

    Parameters
    ----------
    method
        One of ``METHODS``.
    sleeve_mm, rebar_mm
        Nominal diameters; ``clear_mm`` is the clear distance of adjacent bars.

    Raises
    ------
    MissingDependencyError
        Where Open3D is not installed.
    """
    open3d = open3d_for(method)
    points = finite_points(scan)
    parts = _split(points) if len(points) >= _POINTS_MIN else None
    if parts is None:
        return _missing(Reason("extract.no_band"))
    foot, bars = parts
    if method == "image":
        from aadm_workbench.extract.published.hoisting_image import image_points

        sleeves, rebars, plane = image_points(scan, foot, bars, sleeve_mm, rebar_mm)
    else:
        sleeves, plane = _sleeves(open3d, foot, method, sleeve_mm / 2, rng)
        up = np.array([0.0, -1.0, 0.0]) if plane is None else -plane.normal
        rebars = _bars(open3d, bars, up, rebar_mm / 2, clear_mm, rng)
    return _keys(sleeves, rebars, plane)


def _missing(reason: str) -> KeyPoints:
    return KeyPoints(np.empty((0, 3)), np.empty((0, 3)), None, reason=reason)


def _keys(sleeves: Array, rebars: Array, plane: Plane | None) -> KeyPoints:
    for found, what in ((sleeves, "sleeves of the foot"), (rebars, "bars")):
        if len(found) < 3:
            return KeyPoints(
                sleeves, rebars, plane, reason=Reason("extract.few_key_points", count=len(found), what=what)
            )
    first, second = _extremes(sleeves), _extremes(rebars)
    if len(set(first)) < 3 or len(set(second)) < 3:
        return KeyPoints(sleeves, rebars, plane, reason=Reason("extract.same_key_points"))
    return KeyPoints(sleeves, rebars, plane, first, second)


def _extremes(found: Array) -> tuple[int, ...]:
    """Indices of the smallest x, the smallest z and the largest x of points (n, 3)."""
    return int(found[:, 0].argmin()), int(found[:, 2].argmin()), int(found[:, 0].argmax())


def _split(points: FloatArray) -> tuple[Array, Array] | None:
    """The foot of the column and the bars (n, 3) mm, by their y."""
    y = points[:, 1].astype(np.float64)
    low, high = np.quantile(y, [0.0005, 0.9995])  # strays do not stretch it
    counts, edges = np.histogram(y, np.arange(low - _SLICE_MM, high + 2 * _SLICE_MM, _SLICE_MM))
    empty = counts < _EMPTY_SHARE * np.median(counts[counts > 0])
    change = np.flatnonzero(np.diff(np.concatenate([[False], empty, [False]]).astype(int)))
    runs = [(a, b) for a, b in change.reshape(-1, 2) if counts[:a].sum() > _POINTS_MIN < counts[b:].sum()]
    if not runs:
        return None
    begin, end = max(runs, key=lambda run: run[1] - run[0])
    column = points[y < edges[begin]].astype(np.float64)
    # the foot begins where the nearest edge of the column ends, and reaches down to the emptiest band
    nearest = column[column[:, 2] < np.quantile(column[:, 2], 0.001) + _EDGE_MM]
    top = float(np.quantile(nearest[:, 1], 0.995)) - _SLICE_MM  # all but strays
    foot = column[column[:, 1] >= top]
    return foot, points[y >= edges[end]].astype(np.float64)


def _sleeves(
    open3d: Any, foot: Array, method: str, radius_mm: float, rng: np.random.Generator
) -> tuple[Array, Plane | None]:
    """Centres (k, 3) mm of the mouths, and the plane of the foot."""
    threshold_mm = INLIER_DISTANCE_MM if method == "fusion" else _FACE_MM
    plane = _level_plane(open3d, foot, threshold_mm, rng)
    if plane is None:
        return np.empty((0, 3)), None
    plane = facing(plane, np.zeros(3))
    inliers = foot[np.abs(plane.height(foot)) < threshold_mm]
    flat = in_plane(projected_onto(inliers, plane), plane)[:, :2]
    # From a camera that is close to one at 2 m; beyond, what was counted is no face.
    pitch_mm = float(np.clip(_CELL_MM / np.sqrt(np.median(counts_in_cells(flat, _CELL_MM))), 0.3, 3.0))
    find = _hough_centres if method == "fusion" else _edge_centres
    centres = find(open3d, flat, pitch_mm, radius_mm, rng)
    return from_plane(np.column_stack([centres, np.zeros(len(centres))]), plane), plane


def _level_plane(open3d: Any, foot: Array, threshold_mm: float, rng: np.random.Generator) -> Plane | None:
    """The plane of most points that is about square to y; what is found of side faces before is taken away."""
    left = foot
    for _ in range(_TRIES):
        if len(left) < _POINTS_MIN:
            return None
        plane = ransac_plane(open3d, left, threshold_mm, ITERATIONS, rng)
        if plane is None or abs(plane.normal[1]) > _LEVEL_COSINE:
            return plane
        left = left[np.abs(plane.height(left)) > threshold_mm]
    return None


def _hough_centres(open3d: Any, flat: Array, pitch_mm: float, radius_mm: float, rng: np.random.Generator) -> Array:
    image = binary_image(flat, pitch_mm, 2 * radius_mm)
    dilated = np.asarray(cv2.dilate(image.filled, _DILATION), np.uint8)
    nominal = radius_mm / image.pixel_mm
    radii = ((1.0 - RADIUS_MISFIT) * nominal - 1.0, (1.0 + RADIUS_MISFIT) * nominal)
    pixels, _ = hough_circles(dilated, radii, votes_needed(nominal))
    return image.millimetres(pixels)


def _edge_centres(open3d: Any, flat: Array, pitch_mm: float, radius_mm: float, rng: np.random.Generator) -> Array:
    edge = flat[edge_points(flat, pitch_mm)]
    lifted = np.column_stack([edge, np.zeros(len(edge))])
    clusters = dbscan(open3d, lifted, 3.0 * pitch_mm, 3, np.pi * radius_mm / (2.0 * pitch_mm))
    fits = [ransac_circle(edge[cluster], radius_mm, max(_CIRCLE_MM, pitch_mm), rng) for cluster in clusters]
    # Less than two fifths of a cluster on its circle: it is the outline of something else.
    return np.array([fit.centre for fit in fits if fit is not None and fit.inliers.mean() > 0.4]).reshape(-1, 2)


def _bars(open3d: Any, bars: Array, up: Array, radius_mm: float, clear_mm: float, rng: np.random.Generator) -> Array:
    """Centres (l, 3) mm of the tops of bars that stand about along ``up`` (3,)."""
    if len(bars) > _CLUSTERED_MAX:
        bars = bars[rng.integers(0, len(bars), _CLUSTERED_MAX)]
    neighbour_mm = min(_NEIGHBOUR_SHARE * clear_mm, _NEIGHBOUR_MAX_MM)
    level = Plane(up, 0.0)
    tops = []
    for cluster in dbscan(open3d, bars, neighbour_mm, _CORE_POINTS, _CLUSTER_MIN):
        local = in_plane(bars[cluster], level)
        top = float(np.sort(local[:, 2])[-_HIGHEST:].mean())
        local[:, 2] -= top
        for _ in range(_CYLINDER_TRIES):
            fit = ransac_cylinder(local, radius_mm, _CYLINDER_MM, True, rng)
            if fit is not None and np.abs(fit.lean).max() < _LEAN_MAX:
                tops.append(from_plane(np.array([*fit.centre, top]), level))
                break
    return np.array(tops).reshape(-1, 3)
