"""The point-cloud method, after Zhao et al. 2022: everything in 3-D, circles and cylinders by RANSAC and least squares.

Source: the comparison in Long et al. (section 3.2, "point cloud processing method"). The text of Zhao et al. was not at
hand; what had to be interpreted:

* *Sleeves*: RANSAC plane (2 mm) of the foot, edge points of its inliers (see :mod:`.edge_points`), DBSCAN of these, and
  in each cluster a circle by RANSAC and least squares. The axis is the plane's normal.
* *Bars*: RANSAC plane (2 mm) of the floor, DBSCAN of what stands on it, and per cluster a plane through its top and a
  cylinder by RANSAC and least squares through its sides and the rim of its top; the centre is where its axis meets the
  top (Long et al., section 2.2.2, step 2). A bar whose sides are hardly seen is taken as square to the floor.
* A scan that shows no floor: bars are taken as standing along z.

One bar of a cloud: the plane of its top, the cylinder of its sides and rim, and where axis and top meet.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from aadm_workbench.extract.plane import axes_on, facing, from_plane, in_plane, turned_over
from aadm_workbench.extract.published.binary_image import pitch_mm
from aadm_workbench.extract.published.edge_points import dbscan, edge_points
from aadm_workbench.extract.published.pass_through import finite_points, near_is_low, out_of_the_concrete
from aadm_workbench.extract.published.ransac_plane import open3d_for, ransac_plane
from aadm_workbench.extract.published.round_fits import RoundFit, ransac_circle, ransac_cylinder
from aadm_workbench.model import Array, AssemblyPoint, Extraction, FloatArray, Kind, Plane, Reason, Scan

PLANE_DISTANCE_MM = 2.0  # after Zhao et al.: noise and warp, without the walls
PLANE_ITERATIONS = 500  # as the method that it is compared with
EDGE_NEIGHBOUR_OF_PITCH = 6.0  # DBSCAN of edge points
EDGE_CORE_POINTS = 4  # an outline has twelve within that distance; strays have fewer
CIRCLE_DISTANCE_MM = 0.5  # at least a pitch: edge points lie up to a pixel behind the edge
CIRCLE_SHARE = 0.5  # of the points of a cluster, and of the outline at the points' pitch
BAR_NEIGHBOUR_MM = 5.0  # DBSCAN of bars: well below the clear distance of adjacent ones
BAR_CORE_POINTS = 8  # points within 5 mm: strays have fewer
BAR_SHARE = 0.5  # of the points of one top: a cluster with less is no bar
ABOVE_FLOOR_MM = 15.0  # as in standing.py
FLOOR_SHARE = 0.3  # of the points: less is no floor; a choice, not tuned since
_POINTS_MIN = 100  # as in fusion.py
_CLUSTERED_MAX = 200_000  # DBSCAN takes seconds beyond

HIGHEST = 20  # points that give a bar's height (Long et al., 2.2.2)
TOP_ZONE_MM = 3.0  # below the highest points: a cut slanted by 8 degrees over a bar of 20 mm
TOP_DISTANCE_MM = 0.5  # as of circles and tops elsewhere: noise of the reference camera at 1 m, five times
TOP_ITERATIONS = 200  # a top that a third of its zone lies on is missed once in 1,900
TOP_LEAN_COSINE = 0.9  # 26 degrees: more is a side
CYLINDER_DISTANCE_MM = 0.6  # half a rib and noise (a choice, not tuned since)
SIDE_DEPTH_MM = 1.0  # below the rim of the top
SIDE_POINTS_MIN = 60  # fewer, on a shorter side, do not tell a lean (a choice, not tuned since)
SIDE_LENGTH_MIN_MM = 25.0  # over it a noise of 0.1 mm turns an axis by 0.2 degrees


def extract_sleeves(
    scan: Scan, diameter_mm: float, rng: np.random.Generator, places: Array | None = None
) -> Extraction:
    """Centres of all sleeves of one diameter, as circles among the edge points of a foot's face.

    Parameters
    ----------
    scan
        Organised or not; points in mm, scan frame.
    diameter_mm
        Nominal inner diameter at the mouth.
    rng
        Draws hypotheses.
    places
        Not used: the method looks nowhere twice.

    Raises
    ------
    MissingDependencyError
        Where Open3D is not installed.
    """
    open3d = open3d_for("pointcloud")
    points = finite_points(scan)
    plane = ransac_plane(open3d, points, PLANE_DISTANCE_MM, PLANE_ITERATIONS, rng)
    if plane is None or len(points) < _POINTS_MIN:
        return _nothing(Kind.SLEEVE, Reason("extract.no_plane"))
    face = points[np.abs(plane.height(points)) < PLANE_DISTANCE_MM].astype(np.float64)
    spacing_mm = pitch_mm(scan, (float(face[:, 2].min()), float(face[:, 2].max())), diameter_mm / 2)
    if spacing_mm is None:
        return _nothing(Kind.SLEEVE, Reason("extract.sparse"))
    local = in_plane(face, plane)[:, :2]
    edge = local[edge_points(local, spacing_mm)]
    circles = _circles(open3d, edge, spacing_mm, diameter_mm / 2, rng)
    centres = from_plane(np.array([[*circle.centre, 0.0] for circle in circles]).reshape(-1, 3), plane)
    plane = out_of_the_concrete(plane, scan, points, centres, diameter_mm / 2)
    quality = {"point_pitch_mm": spacing_mm, "plane_residual_mm": plane.residual_mm, "edge_points": len(edge)}
    return _sleeves_extraction(circles, centres, plane, quality)


def extract_rebars(scan: Scan, diameter_mm: float, rng: np.random.Generator, places: Array | None = None) -> Extraction:
    """Centres of the tops of all bars of one diameter, where the axis of a cylinder meets the plane of its top.

    Parameters and errors are those of :func:`extract_sleeves`; ``diameter_mm`` is the nominal one of the bars.
    """
    open3d = open3d_for("pointcloud")
    points = finite_points(scan)
    spacing_mm = pitch_mm(scan, None, diameter_mm / 2)
    if len(points) < _POINTS_MIN or spacing_mm is None:
        return _nothing(Kind.REBAR, Reason("extract.few_points"))
    floor = _floor(open3d, scan, points, rng)
    level = floor or _along_z(scan, points)
    upright = points if floor is None else points[floor.height(points) > ABOVE_FLOOR_MM]
    if len(upright) > _CLUSTERED_MAX:
        upright = upright[rng.integers(0, len(upright), _CLUSTERED_MAX)]
    standing = upright.astype(np.float64)
    points_of_a_top = np.pi * (diameter_mm / 2 / spacing_mm) ** 2
    clusters = dbscan(open3d, standing, BAR_NEIGHBOUR_MM, BAR_CORE_POINTS, BAR_SHARE * points_of_a_top)
    measured = [
        measured_bar(open3d, standing[cluster], level.normal, diameter_mm / 2, spacing_mm, rng) for cluster in clusters
    ]
    bars = [bar for bar in measured if bar is not None]
    return _bars_extraction(bars, floor, level, {"point_pitch_mm": spacing_mm, "clusters": len(clusters)})


def _circles(open3d: Any, edge: Array, spacing_mm: float, radius_mm: float, rng: np.random.Generator) -> list[RoundFit]:
    """Circles among edge points (n, 2) mm: clusters most of which lie on a circle of which they cover a good part."""
    lifted = np.column_stack([edge, np.zeros(len(edge))])
    points_min = CIRCLE_SHARE * 2.0 * np.pi * radius_mm / spacing_mm
    clusters = dbscan(open3d, lifted, EDGE_NEIGHBOUR_OF_PITCH * spacing_mm, EDGE_CORE_POINTS, points_min)
    inlier_distance_mm = max(CIRCLE_DISTANCE_MM, spacing_mm)
    fits = [ransac_circle(edge[cluster], radius_mm, inlier_distance_mm, rng) for cluster in clusters]
    found = [fit for fit in fits if fit is not None]
    return [fit for fit in found if fit.inliers.mean() > CIRCLE_SHARE and fit.inliers.sum() > points_min]


def _sleeves_extraction(circles: list[RoundFit], centres: Array, plane: Plane, quality: dict[str, float]) -> Extraction:
    points = tuple(
        AssemblyPoint("", Kind.SLEEVE, centre, -plane.normal, 2.0 * circle.radius_mm, why=_edge_evidence(circle))
        for centre, circle in zip(centres, circles, strict=True)
    )
    reason = "" if points else Reason("extract.no_circle.edges")
    return Extraction(
        Kind.SLEEVE, "pointcloud", points, plane, -plane.normal, "foot face", quality=quality, reason=reason
    )


def _edge_evidence(circle: RoundFit) -> str:
    return Reason("extract.circle_through", count=int(circle.inliers.sum()))


def _floor(open3d: Any, scan: Scan, points: FloatArray, rng: np.random.Generator) -> Plane | None:
    """The floor, its normal on the side of the bars; None where no plane holds a good part of the scan."""
    plane = ransac_plane(open3d, points, PLANE_DISTANCE_MM, PLANE_ITERATIONS, rng)
    if plane is None:
        return None
    height = plane.height(points)
    if (np.abs(height) < PLANE_DISTANCE_MM).mean() < FLOOR_SHARE:
        return None
    if scan.viewpoint is not None:
        return facing(plane, scan.viewpoint)
    above, below = (height > ABOVE_FLOOR_MM).sum(), (height < -ABOVE_FLOOR_MM).sum()
    return plane if above >= below else turned_over(plane)


def _along_z(scan: Scan, points: FloatArray) -> Plane:
    up = -1.0 if near_is_low(points[:, 2], scan.viewpoint) else 1.0
    return Plane(np.array([0.0, 0.0, up]), 0.0)


def _bars_extraction(
    bars: list[MeasuredBar], floor: Plane | None, level: Plane, quality: dict[str, float]
) -> Extraction:
    if not bars:
        return _nothing(Kind.REBAR, Reason("extract.no_bar_of_size"))
    points = tuple(
        AssemblyPoint("", Kind.REBAR, bar.centre, bar.axis, bar.diameter_mm, why=_bar_evidence(bar)) for bar in bars
    )
    exposed: tuple[float | None, ...] = ()
    if floor is not None:
        exposed = tuple(float(floor.height(bar.centre) / (bar.axis @ floor.normal)) for bar in bars)
    tops = Plane(level.normal, float(np.median([level.normal @ bar.centre for bar in bars])))
    source = "floor" if floor is not None else "z of the scan"
    return Extraction(Kind.REBAR, "pointcloud", points, tops, level.normal, source, exposed, quality)


def _bar_evidence(bar: MeasuredBar) -> str:
    return Reason("extract.cylinder" if bar.leaning else "extract.upright_cylinder")


def _nothing(kind: Kind, reason: str) -> Extraction:
    return Extraction(kind, "pointcloud", (), None, None, reason=reason)


@dataclass(frozen=True, eq=False)
class MeasuredBar:
    """Centre (3,) mm of a bar's top, its axis (3,) pointing up, and its diameter."""

    centre: Array
    axis: Array
    diameter_mm: float
    leaning: bool


def measured_bar(
    open3d: Any, points: Array, vertical: Array, radius_mm: float, spacing_mm: float, rng: np.random.Generator
) -> MeasuredBar | None:
    """Measure one bar from its cluster of points (n, 3) mm; None where it shows no top or no round outline.

    ``vertical`` (3,) points up along the bars, ``radius_mm`` is nominal, ``spacing_mm`` the pitch of the points.
    """
    axes = axes_on(Plane(vertical, 0.0))
    local = points @ axes.T
    # heights from the top on, so that the lean of the axis does not depend on where the scan frame begins
    shift = np.array([0.0, 0.0, np.sort(local[:, 2])[-HIGHEST:].mean()])
    local = local - shift
    top = ransac_plane(open3d, local[np.abs(local[:, 2]) < TOP_ZONE_MM], TOP_DISTANCE_MM, TOP_ITERATIONS, rng)
    if top is None or abs(top.normal[2]) < TOP_LEAN_COSINE:
        return None
    depth = top.height(local) / top.normal[2]
    on_top = local[np.abs(depth) < TOP_DISTANCE_MM]
    sides = local[depth < -SIDE_DEPTH_MM]
    rim = on_top[edge_points(on_top[:, :2], spacing_mm)]
    leaning = len(sides) >= SIDE_POINTS_MIN and float(np.ptp(sides[:, 2])) >= SIDE_LENGTH_MIN_MM
    fit = ransac_cylinder(np.vstack([rim, sides]), radius_mm, CYLINDER_DISTANCE_MM, leaning, rng)
    if fit is None:
        return None
    centre, direction = _axis_on_top(fit, top)
    return MeasuredBar(axes.T @ (centre + shift), axes.T @ direction, 2.0 * fit.radius_mm, leaning)


def _axis_on_top(fit: RoundFit, top: Plane) -> tuple[Array, Array]:
    """Where the axis of a cylinder meets a plane, and the direction of the axis; both (3,)."""
    direction = np.array([*fit.lean, 1.0])
    foot = np.array([*fit.centre, 0.0])
    along = (top.offset - float(top.normal @ foot)) / float(top.normal @ direction)
    return foot + along * direction, direction / np.linalg.norm(direction)
