"""Runs methods over random scenes of a setting: what each made of each scan, and how long it took.

The published method without anything around it: what its three library calls alone take. RANSAC plane of Open3D (50 mm,
500 iterations) on all points of the scan, the raster of the face or of the tops at the scan's own pitch, Hough circles
of OpenCV. This is what a straightforward program of the paper's steps cannot do without, so it is the honest thing to
divide by: no thinning, no repeatable draw, no way back to 3-D, and the filter along z is not counted. On all points the
plane under bars is that of the floor: this is a time and no result.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from aadm_workbench.extract.method import Known, extract
from aadm_workbench.extract.plane import in_plane
from aadm_workbench.extract.published.binary_image import binary_image, pitch_mm
from aadm_workbench.extract.published.fusion import INLIER_DISTANCE_MM, ITERATIONS, projected_onto
from aadm_workbench.extract.published.hough import RADIUS_MISFIT, hough_circles, votes_needed
from aadm_workbench.extract.published.pass_through import face_range_mm, finite_points, passed, tops_range_mm
from aadm_workbench.extract.published.ransac_plane import SAMPLE, open3d_for
from aadm_workbench.model import Camera, Kind, Plane, Scan
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.scenes import Setting, random_bar_scan, random_sleeve_scan
from aadm_workbench.twin.study.errors import Comparison, compared
from aadm_workbench.twin.truth import sample_design

PUBLISHED = "fusion"
"""The method that the bare calls are part of, and that times are divided by."""

_WARM_UP_STEP = 4  # each fourth pixel: loads what is loaded once, and measures next to nothing
_RENDER = {Kind.SLEEVE: random_sleeve_scan, Kind.REBAR: random_bar_scan}

Clock = Callable[[], float]

_POINTS_MIN = 100  # as in the method itself (fusion.py)


@dataclass(frozen=True)
class Measurement:
    """One method on one scan: errors, time in seconds, and why nothing was found where nothing was."""

    setting: str
    scene: int
    method: str
    kind: Kind
    comparison: Comparison
    seconds: float
    reason: str


@dataclass(frozen=True)
class BareTime:
    """Seconds that the published method's library calls took by themselves on one scan; None where they could not."""

    setting: str
    scene: int
    kind: Kind
    seconds: float | None


@dataclass(frozen=True)
class MethodStudy:
    """All that was measured in a run, with what is needed to repeat it."""

    seed: int
    scenes: int
    settings: tuple[str, ...]
    methods: tuple[str, ...]
    measurements: tuple[Measurement, ...]
    bare: tuple[BareTime, ...]


def study_methods(
    settings: Sequence[Setting],
    methods: Sequence[str],
    *,
    scenes: int,
    seed: int,
    camera: Camera = PRO_M,
    finished: Callable[[str], None] = lambda step: None,
    clock: Clock = perf_counter,
) -> MethodStudy:
    """Run methods over the same random scenes: of each a foot and its bars.

    Times are of the extraction alone: the scan is in memory, and every package is loaded before.

    Parameters
    ----------
    scenes
        How many of each setting.
    seed
        The same seed gives the same scans.
    finished
        Called after each scene with what it was.

    Raises
    ------
    MissingDependencyError
        Where the ray caster or what a method needs is not installed.
    """
    measurements: list[Measurement] = []
    bare: list[BareTime] = []
    for setting in settings:
        for scene in range(scenes):
            rng = np.random.default_rng([seed, *setting.name.encode(), scene])
            for kind in Kind:
                measured, alone = _one_scan(setting, scene, kind, methods, camera, rng, clock, warm=bool(measurements))
                measurements += measured
                bare += alone
            finished(f"{setting.name} scene {scene + 1}")
    names = tuple(setting.name for setting in settings)
    return MethodStudy(seed, scenes, names, tuple(methods), tuple(measurements), tuple(bare))


def diameter_of(setting: Setting, kind: Kind) -> float:
    """Nominal diameter, mm, of what is looked for."""
    return setting.sleeve_diameter if kind is Kind.SLEEVE else setting.bar_diameter


def thinned_camera(camera: Camera, step: int) -> Camera:
    """The camera that would see every ``step``-th pixel of each row and column."""
    size = {"width": -(-camera.width // step), "height": -(-camera.height // step)}
    lens = {name: getattr(camera, name) / step for name in ("fx", "fy", "cx", "cy")}
    return replace(camera, **size, **lens)


def _one_scan(
    setting: Setting,
    scene: int,
    kind: Kind,
    methods: Sequence[str],
    camera: Camera,
    rng: np.random.Generator,
    clock: Clock,
    *,
    warm: bool,
) -> tuple[list[Measurement], list[BareTime]]:
    truth = _RENDER[kind](setting, rng, camera)
    scan = truth.scan()
    diameter_mm = diameter_of(setting, kind)
    if not warm:
        _load_all(scan, methods)
    measured = []
    # Scenes are taken with +y at the top of the picture.
    known = Known(sample_design(setting), 90.0)
    for method in methods:
        began = clock()
        found = extract(scan, kind, diameter_mm, method, np.random.default_rng(scene), known=known)
        seconds = clock() - began
        comparison = compared(found, truth, setting.centres(), diameter_mm / 2)
        measured.append(Measurement(setting.name, scene, method, kind, comparison, seconds, found.reason))
    if PUBLISHED not in methods:
        return measured, []
    return measured, [BareTime(setting.name, scene, kind, seconds_of_bare_calls(scan, kind, diameter_mm, clock))]


def _load_all(scan: Scan, methods: Sequence[str]) -> None:
    """Let every method import what it needs, on a few points: no import is part of a time."""
    assert scan.camera is not None
    step = _WARM_UP_STEP
    small = replace(scan, points=scan.points[::step, ::step], camera=thinned_camera(scan.camera, step))
    for kind in Kind:
        for method in methods:
            extract(small, kind, 25.0, method, np.random.default_rng(0))


def seconds_of_bare_calls(scan: Scan, kind: Kind, diameter_mm: float, clock: Callable[[], float]) -> float | None:
    """Seconds of the three calls on a scan in memory; None where it holds too little.

    Open3D and OpenCV use as many threads as they like.
    """
    open3d = open3d_for("fusion")
    points = finite_points(scan)
    pixel_mm = pitch_mm(scan, None, diameter_mm / 2)
    if len(points) < _POINTS_MIN or pixel_mm is None:
        return None
    points_of_a_top = np.pi * (diameter_mm / 2 / pixel_mm) ** 2
    is_foot = kind is Kind.SLEEVE
    kept = passed(points, face_range_mm(points) if is_foot else tops_range_mm(points, scan.viewpoint, points_of_a_top))
    if len(kept) == 0:
        return None
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points.astype(np.float64)))
    nominal = diameter_mm / 2 / pixel_mm
    began = clock()
    model, _ = cloud.segment_plane(INLIER_DISTANCE_MM, SAMPLE, ITERATIONS)
    length = float(np.linalg.norm(model[:3]))
    plane = Plane(np.asarray(model[:3]) / length, -float(model[3]) / length)
    on_plane = in_plane(projected_onto(kept, plane), plane)[:, :2]
    image = binary_image(on_plane, pixel_mm, diameter_mm).filled
    shown = np.asarray(image if is_foot else 255 - image, np.uint8)
    hough_circles(shown, ((1.0 - RADIUS_MISFIT) * nominal, (1.0 + RADIUS_MISFIT) * nominal), votes_needed(nominal))
    return clock() - began
