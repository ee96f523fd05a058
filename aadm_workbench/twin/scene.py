"""One scan with its truth: parts, camera and noise put together."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Array, AssemblyPoint, Camera, Kind, Scan
from aadm_workbench.scan.camera import depth_to_points
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.finite_pixel import seen_by_pixels
from aadm_workbench.twin.meshes import surface_of
from aadm_workbench.twin.noise import CameraNoise, captured
from aadm_workbench.twin.parts import BarGroup, Foot, PlateAsBuilt, axis_of
from aadm_workbench.twin.raycast import caster_of, rays_of
from aadm_workbench.twin.surface import Surface, moved

_ABOUT_X = np.array([1.0, -1.0, -1.0])  # a turn by 180 degrees about x


@dataclass(frozen=True, eq=False)
class TrueScan:
    """A synthetic scan, with the true points in the column frame and the true pose of the camera.

    ``depth`` (h, w) float32, mm. ``T_column_scan`` (4, 4). ``scale``: the camera's lengths are this much too long,
    relatively. ``brightness`` (h, w), where the camera has it: of the light that a depth was read from.
    """

    depth: npt.NDArray[np.float32]
    camera: Camera
    points: tuple[AssemblyPoint, ...]
    T_column_scan: Array
    scale: float = 0.0
    brightness: npt.NDArray[np.float32] | None = None

    def scan(self, source: str = "") -> Scan:
        """The scan as the readers would give it."""
        return Scan(depth_to_points(self.depth, self.camera), source, "", self.camera, np.zeros(3))

    def points_scan(self) -> Array:
        """True centres (n, 3), mm, scan frame."""
        T = np.linalg.inv(self.T_column_scan)
        return np.array([T[:3, :3] @ point.centre + T[:3, 3] for point in self.points])

    def axes_scan(self) -> Array:
        """True axes (n, 3), unit, scan frame."""
        return np.array([self.T_column_scan[:3, :3].T @ point.axis for point in self.points])


def scan_of(
    part: Foot | BarGroup | PlateAsBuilt,
    T_column_scan: Array,
    noise: CameraNoise,
    rng: np.random.Generator,
    camera: Camera = PRO_M,
) -> TrueScan:
    """Scan a foot, a bar group or a plate from a pose of the camera."""
    return shot(surface_of(part), truth_of(part), T_column_scan, noise, rng, camera)


def shot(
    surface: Surface,
    truth: tuple[AssemblyPoint, ...],
    T_column_scan: Array,
    noise: CameraNoise,
    rng: np.random.Generator,
    camera: Camera = PRO_M,
) -> TrueScan:
    """Scan any surface, given in the column frame."""
    caster = caster_of(moved(surface, np.asarray(np.linalg.inv(T_column_scan), np.float64)))
    view = caster.view(rays_of(camera))
    if noise.pixel is not None:
        view = seen_by_pixels(view, caster, camera, noise.pixel, rng)
    return TrueScan(captured(view, camera, noise, rng), camera, truth, T_column_scan, noise.scale)


def truth_of(part: Foot | BarGroup | PlateAsBuilt) -> tuple[AssemblyPoint, ...]:
    """The true assembly points of a part, in the order in which it lists them; of a plate holes, then pins."""
    if isinstance(part, PlateAsBuilt):
        bored = (replace(one, centre=one.centre * _ABOUT_X, axis=one.axis * _ABOUT_X) for one in truth_of(part.foot))
        return (*bored, *truth_of(BarGroup(part.pins, 0.0)))
    if isinstance(part, Foot):
        return tuple(
            AssemblyPoint(
                f"S{k}", Kind.SLEEVE, np.array([s.x, s.y, part.level_at(s.x, s.y)]), axis_of(s.lean), s.diameter
            )
            for k, s in enumerate(part.sleeves, 1)
        )
    return tuple(
        AssemblyPoint(f"R{k}", Kind.REBAR, np.array([b.x, b.y, b.top]), axis_of(b.lean), b.core_diameter)
        for k, b in enumerate(part.bars, 1)
    )
