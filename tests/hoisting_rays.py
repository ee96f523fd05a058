"""A second virtual camera for hanging columns: rays on planes, cones and cylinders, solved in closed form.

It shares no formula with the twin (no mesh, no ray caster, other noise, other ways in which light is lost and bounces),
and lets a scene be what the twin's are not: rows of sleeves behind each other, a wall, a hand, a bar that is absent.
Lengths in mm, in the bars' frame: tops about z = 0, z up.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.model import Array, Camera, ColumnDesign, HoistingMeasurement, Scan
from aadm_workbench.scan.camera import depth_to_points

CAMERA = Camera(1330.0, 1330.0, 725.0, 533.0, 1440, 1080)
_RIB_MM, _RIB_PITCH_MM = 0.7, 8.0


@dataclass(frozen=True)
class Box:
    """A box between two corners: a hand, a board, a wall."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Scene:
    """Sleeves and bars as built, (k, 2) mm about their own axes, and where the column hangs.

    ``hang`` is (x, y, height, turn in degrees), ``tilt`` (2,) the slopes of its axis. ``taped`` sleeves are closed by a
    disc at the face, ``absent`` bars are not there. ``bounce_mm``: how far light that bounces pushes walls along a ray,
    in full from some ``growth_mm`` behind the face on.
    """

    design: ColumnDesign
    sleeves: Array
    bars: Array
    hang: tuple[float, float, float, float]
    tilt: tuple[float, float] = (0.0, 0.0)
    chamfer_mm: float = 0.5
    bounce_mm: float = 0.0
    growth_mm: float = 0.5
    floor_mm: float = -150.0
    taped: tuple[int, ...] = ()
    absent: tuple[int, ...] = ()
    boxes: tuple[Box, ...] = ()
    tops: Array = field(default_factory=lambda: np.zeros(0))

    @property
    def rotation(self) -> Array:
        """Of the column, to the bars' frame."""
        up = np.array([*self.tilt, 1.0]) / np.linalg.norm([*self.tilt, 1.0])
        turn = np.radians(self.hang[3])
        x = np.array([np.cos(turn), np.sin(turn), 0.0])
        x = (x - (x @ up) * up) / np.linalg.norm(x - (x @ up) * up)
        return np.column_stack([x, np.cross(up, x), up])

    def offsets(self) -> Array:
        """True offsets (k, 2), bar minus sleeve, the bar brought to the foot along its normal."""
        R = self.rotation
        mouths = np.column_stack([self.sleeves, np.zeros(len(self.sleeves))]) @ R.T + np.array(self.hang[:3])
        apart = np.column_stack([self.bars, self.heights()]) - mouths
        return np.asarray((apart - (apart @ R[:, 2])[:, None] * R[:, 2])[:, :2])

    def heights(self) -> Array:
        """Heights (k,) of the tops."""
        return self.tops if len(self.tops) else np.zeros(len(self.bars))


def column(
    centres: Array, *, sleeve_mm: float, bar_mm: float, size_mm: tuple[float, float], name: str = "X-1"
) -> ColumnDesign:
    """The design of a column with sleeves at (k, 2) mm."""
    table = {
        "sleeve_diameter": sleeve_mm,
        "rebar_diameter": bar_mm,
        "embedded_length": 150.0,
        "size": list(size_mm),
        "centres": centres.tolist(),
    }
    return inline_design(name, table)


def built(
    design: ColumnDesign, rng: np.random.Generator, hang: tuple[float, float, float, float], scatter_mm: float = 0.6
) -> Scene:
    """A column of a design, as it may have come out: even errors, not normal ones."""
    half = scatter_mm * np.sqrt(3.0)
    sleeves = np.array([point.centre[:2] for point in design.sleeves])
    bars = np.array([point.centre[:2] for point in design.rebars])
    return Scene(
        design,
        sleeves + rng.uniform(-half, half, sleeves.shape),
        bars + rng.uniform(-half, half, bars.shape),
        hang,
        tilt=(float(rng.uniform(-0.004, 0.004)), float(rng.uniform(-0.004, 0.004))),
        chamfer_mm=float(rng.uniform(0.0, 0.9)),
        bounce_mm=float(rng.uniform(-0.6, 0.6)),
        tops=rng.uniform(-3.0, 3.0, len(bars)),
    )


def stand(scene: Scene, corner: tuple[float, float], distance_mm: float, below_mm: float = 60.0) -> Array:
    """T_bars_scan (4, 4) of a camera beside a corner, ``distance_mm`` from the outermost bar along its direction."""
    way = np.array(corner) / np.linalg.norm(corner)
    first = float((scene.bars @ way).max())
    place = np.array([*((first + distance_mm) * way), -below_mm])
    ahead = np.array([0.0, 0.0, 0.4 * scene.hang[2]]) - place
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = np.column_stack([right, np.cross(ahead, right), ahead]), place
    return pose


def shot(scene: Scene, T_bars_scan: Array, rng: np.random.Generator, camera: Camera = CAMERA) -> Scan:
    """A scan of a scene."""
    rays = _Rays(T_bars_scan, camera)
    _floor(rays, scene)
    for number, place in enumerate(scene.bars):
        if number not in scene.absent:
            _bar(rays, np.array([*place, scene.heights()[number]]), scene, number)
    _foot(rays, scene)
    for box in scene.boxes:
        _box(rays, box)
    depth = _noisy(rays, scene, rng)
    return Scan(depth_to_points(depth, camera), "frame", "", camera, np.zeros(3))


class _Rays:
    """All rays of a picture (h, w), with the depth, the cosine and the push of what each has met so far."""

    def __init__(self, T_bars_scan: Array, camera: Camera) -> None:
        u = (np.arange(camera.width) - camera.cx) / camera.fx
        v = (np.arange(camera.height) - camera.cy) / camera.fy
        own = np.stack([*np.broadcast_arrays(u[None, :], v[:, None]), np.ones((camera.height, camera.width))], -1)
        self.T, self.camera = T_bars_scan, camera
        self.eye = T_bars_scan[:3, 3]
        self.way = own @ T_bars_scan[:3, :3].T
        self.depth = np.full(own.shape[:2], np.inf)
        self.cosine = np.ones(own.shape[:2])
        self.inside = np.zeros(own.shape[:2])

    def window(self, corners: Array) -> tuple[slice, slice]:
        """Rows and columns that hold points (n, 3)."""
        local = (corners - self.eye) @ self.T[:3, :3]
        camera = self.camera
        if (local[:, 2] < 50.0).any():
            return slice(0, camera.height), slice(0, camera.width)
        u = local[:, 0] / local[:, 2] * camera.fx + camera.cx
        v = local[:, 1] / local[:, 2] * camera.fy + camera.cy
        low = np.clip(np.floor([v.min(), u.min()]).astype(int) - 1, 0, None)
        high = np.clip(np.ceil([v.max(), u.max()]).astype(int) + 2, 0, None)
        return slice(low[0], high[0]), slice(low[1], high[1])

    def meet(self, window: tuple[slice, slice], at: Array, normal: Array, inside: Array | float = 0.0) -> None:
        """Keep what is met at depths (h, w), NaN for nothing, with its normals (..., 3) and its depth in a bore."""
        way = self.way[window]
        nearer = np.nan_to_num(at, nan=np.inf) < self.depth[window]
        nearer &= np.nan_to_num(at, nan=-1.0) > 1.0
        cosine = np.abs((way * normal).sum(-1)) / np.linalg.norm(way, axis=-1)
        self.depth[window] = np.where(nearer, at, self.depth[window])
        self.cosine[window] = np.where(nearer, cosine, self.cosine[window])
        self.inside[window] = np.where(nearer, inside, self.inside[window])


def _plane(rays: _Rays, window: tuple[slice, slice], point: Array, normal: Array) -> Array:
    with np.errstate(divide="ignore"):
        return np.asarray(((point - rays.eye) @ normal) / (rays.way[window] @ normal))


def _floor(rays: _Rays, scene: Scene) -> None:
    everywhere = slice(None), slice(None)
    up = np.array([0.0, 0.0, 1.0])
    at = _plane(rays, everywhere, np.array([0.0, 0.0, scene.floor_mm]), up)
    rays.meet(everywhere, np.where((at > 0) & (at < 6000.0), at, np.nan), up)


def _cylinder(about: Array, way: Array, radius: Array | float) -> tuple[Array, Array]:
    """Depths (h, w) at which rays enter and leave an upright circle about the origin in the plan."""
    a = (way[..., :2] ** 2).sum(-1)
    b = way[..., :2] @ about[:2]
    c = about[:2] @ about[:2] - np.asarray(radius) ** 2
    with np.errstate(invalid="ignore"):
        root = np.sqrt(b**2 - a * c)
    return (-b - root) / a, (-b + root) / a


def _bar(rays: _Rays, top: Array, scene: Scene, number: int) -> None:
    radius = scene.design.rebars[number].diameter_mm / 2 * 0.965
    reach = radius + 2.0
    span = np.array([[x, y, z] for x in (-reach, reach) for y in (-reach, reach) for z in (scene.floor_mm - top[2], 1)])
    window = rays.window(span + top)
    way, about = rays.way[window], rays.eye - top
    core, _ = _cylinder(about, way, radius)
    at = about + core[..., None] * way
    turn, phase = np.arctan2(at[..., 1], at[..., 0]), 0.37 * number
    rib = _RIB_MM * np.clip(np.cos(2 * np.pi * (at[..., 2] + 2.0 * turn) / _RIB_PITCH_MM + phase) * 3.0 - 2.0, 0.0, 1.0)
    side, _ = _cylinder(about, way, radius + np.nan_to_num(rib))
    at = about + side[..., None] * way
    outward = at * np.array([1.0, 1.0, 0.0]) / radius
    rays.meet(window, np.where(at[..., 2] < 0.0, side, np.nan), outward)


def _foot(rays: _Rays, scene: Scene) -> None:
    R, origin = scene.rotation, np.array(scene.hang[:3])
    eye, way = (rays.eye - origin) @ R, rays.way @ R
    half = np.array(scene.design.size_mm or (400.0, 400.0)) / 2.0
    with np.errstate(divide="ignore", invalid="ignore"):
        at = -eye[2] / way[..., 2]
        plan = eye[:2] + at[..., None] * way[..., :2]
    on_face = (way[..., 2] > 0) & (np.abs(plan) < half).all(-1)
    for axis in (0, 1):  # its sides
        normal = np.zeros(3)
        normal[axis] = np.sign(eye[axis])
        with np.errstate(divide="ignore", invalid="ignore"):
            side = (normal[axis] * half[axis] - eye[axis]) / way[..., axis]
            point = eye + side[..., None] * way
        met = (point[..., 2] > 0) & (point[..., 2] < 500.0) & (np.abs(point[..., 1 - axis]) < half[1 - axis])
        rays.meet((slice(None), slice(None)), np.where(met & (side > 0), side, np.nan), R @ normal)
    for number, centre in enumerate(scene.sleeves):
        if number in scene.taped:
            continue
        radius = scene.design.sleeves[number].diameter_mm / 2
        wide = radius + scene.chamfer_mm
        mouth = on_face & ((plan - centre) ** 2).sum(-1).__lt__(wide**2)
        rows, columns = np.nonzero(mouth)
        if not len(rows):
            continue
        on_face &= ~mouth
        window = slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)
        _bore(rays, window, mouth[window], eye - np.array([*centre, 0.0]), way[window], radius, scene, R)
    rays.meet((slice(None), slice(None)), np.where(on_face, at, np.nan), R[:, 2])


def _bore(
    rays: _Rays,
    window: tuple[slice, slice],
    mouth: Array,
    about: Array,
    way: Array,
    radius: float,
    scene: Scene,
    R: Array,
) -> None:
    """Rays that pass a mouth end on the cone of its chamfer, or on the wall above it."""
    _, wall = _cylinder(about, way, radius)
    point = about + wall[..., None] * way
    chamfer = scene.chamfer_mm
    if chamfer > 0.0:  # |p| = radius + chamfer - z
        apex = radius + chamfer - about[2]
        a = (way[..., :2] ** 2).sum(-1) - way[..., 2] ** 2
        b = way[..., :2] @ about[:2] + way[..., 2] * apex
        c = about[:2] @ about[:2] - apex**2
        with np.errstate(invalid="ignore"):
            cone = (-b + np.sqrt(b**2 - a * c)) / a
        low = about[2] + cone * way[..., 2]
        on_cone = (low < chamfer) & (low >= -1e-9)
        wall = np.where(on_cone, cone, wall)
        point = about + wall[..., None] * way
    inward = point * np.array([1.0, 1.0, 0.0]) / radius
    rays.meet(window, np.where(mouth & (point[..., 2] < 300.0), wall, np.nan), inward @ R.T, point[..., 2])


def _box(rays: _Rays, box: Box) -> None:
    low, high = np.array(box.low), np.array(box.high)
    everywhere = slice(None), slice(None)
    with np.errstate(divide="ignore", invalid="ignore"):
        near, far = (low - rays.eye) / rays.way, (high - rays.eye) / rays.way
    enter, leave = np.minimum(near, far), np.maximum(near, far)
    axis = enter.argmax(-1)
    at = enter.max(-1)
    normal = np.eye(3)[axis]
    rays.meet(everywhere, np.where((at < leave.min(-1)) & (at > 0), at, np.nan), normal)


def _noisy(rays: _Rays, scene: Scene, rng: np.random.Generator) -> Array:
    """Depth as a camera returns it: noise by distance and slant, a polynomial warp, loss at steps and slants."""
    depth = np.where(np.isfinite(rays.depth), rays.depth, np.nan)
    height, width = depth.shape
    noise = rng.standard_normal((height, width))
    noise = 0.8 * noise + 0.6 * np.roll(noise, 1, axis=1)
    sigma_mm = rng.uniform(0.05, 0.09) * (depth / 1000.0) ** 2 / np.maximum(rays.cosine, 0.06)
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, width), np.linspace(-1.0, 1.0, height))
    a, b, c, d = rng.normal(0.0, 0.03, 4)
    warp_mm = a * (u**2 - 0.33) + b * u * v + c * (v**2 - 0.33) + d * (u**3 - 0.6 * u)
    pushed_mm = scene.bounce_mm * (1.0 - np.exp(-rays.inside / scene.growth_mm))
    step = np.zeros(depth.shape, bool)
    for axis in (0, 1):
        jump = np.abs(np.diff(np.nan_to_num(depth, nan=1e4), axis=axis)) > 6.0
        step |= np.concatenate([jump, np.zeros_like(jump[:1] if axis == 0 else jump[:, :1])], axis=axis)
    lost = rng.random(depth.shape) < np.where(step, 0.6, 0.01) + np.clip(0.25 - rays.cosine, 0.0, 0.18) * 4.0
    return np.where(lost, np.nan, depth + sigma_mm * noise + warp_mm + pushed_mm).astype(np.float32)


def squares(found: HoistingMeasurement, scene: Scene) -> tuple[Array, Array]:
    """χ² (k,) of each pair's offset about the truth, two axes each, and its error (k,) mm."""
    off = found.offsets_mm - scene.offsets()
    squared = np.einsum("ki,kij,kj->k", off, np.linalg.inv(found.covariances), off)
    return squared, np.hypot(*off.T)
