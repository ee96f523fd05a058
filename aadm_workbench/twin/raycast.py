"""What a pinhole camera and its projector see of a surface, by Open3D's ray casting (Embree)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from aadm_workbench.errors import needed
from aadm_workbench.model import BoolArray, Camera
from aadm_workbench.twin.surface import Surface

PROJECTOR_BASELINE_MM = 270.0  # along +x of the camera, as targets refer to it
_SHADOW_MARGIN_MM = 0.3  # a surface does not shade itself: more than rounding, less than a rib


@dataclass(frozen=True, eq=False)
class View:
    """What ideal rays hit: all (h, w), or of the shape of the rays. ``depth`` mm, NaN where nothing is hit."""

    depth: npt.NDArray[np.float32]
    cosine: npt.NDArray[np.float32]
    kind: npt.NDArray[np.int8]
    owner: npt.NDArray[np.int16]
    lit: BoolArray


def rays_of(camera: Camera) -> npt.NDArray[np.float32]:
    """Directions (h, w, 3) of the pixels' rays with z = 1, camera frame."""
    u, v = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    rays = np.stack([(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, np.ones(u.shape)], -1)
    return rays.astype(np.float32)


@dataclass(frozen=True, eq=False)
class Caster:
    """A surface, given in the camera frame, that rays from the camera's middle are cast against."""

    surface: Surface
    scene: Any

    def view(self, directions: npt.NDArray[np.float32]) -> View:
        """What rays with directions (..., 3), z = 1, hit; the arrays have the shape of the rays."""
        import open3d

        rays = np.concatenate([np.zeros_like(directions), directions], -1)
        answer = self.scene.cast_rays(open3d.core.Tensor(rays))
        depth = answer["t_hit"].numpy()
        normals = answer["primitive_normals"].numpy()
        triangle = answer["primitive_ids"].numpy()
        hit = np.isfinite(depth)
        triangle = np.where(hit, triangle, 0)
        length = np.linalg.norm(directions, axis=-1)
        cosine = np.abs(np.einsum("...k,...k->...", normals, directions)) / length
        lit = hit & ~_shadowed(self.scene, directions, depth, hit)
        return View(
            np.where(hit, depth, np.nan).astype(np.float32),
            np.where(hit, cosine, 0.0).astype(np.float32),
            np.where(hit, self.surface.kind[triangle], -1).astype(np.int8),
            np.where(hit, self.surface.owner[triangle], -1).astype(np.int16),
            lit,
        )


def caster_of(surface: Surface) -> Caster:
    """A surface in the camera frame, ready for rays.

    Raises
    ------
    MissingDependencyError
        Where Open3D is not installed.
    """
    with needed("open3d", "The virtual camera"):
        import open3d
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(
        open3d.core.Tensor(surface.vertices.astype(np.float32)),
        open3d.core.Tensor(surface.triangles.astype(np.uint32)),
    )
    return Caster(surface, scene)


def look(surface: Surface, camera: Camera) -> View:
    """Cast every pixel's ray against a surface that is given in the camera frame."""
    return caster_of(surface).view(rays_of(camera))


def _shadowed(
    scene: Any, directions: npt.NDArray[np.float32], depth: npt.NDArray[np.float32], hit: BoolArray
) -> BoolArray:
    import open3d

    points = directions[hit] * depth[hit][:, None]
    projector = np.array([PROJECTOR_BASELINE_MM, 0.0, 0.0], np.float32)
    towards = points - projector
    distance = np.linalg.norm(towards, axis=1)
    towards /= distance[:, None]
    rays = np.concatenate([np.broadcast_to(projector, towards.shape), towards], 1)
    reach = scene.cast_rays(open3d.core.Tensor(rays))["t_hit"].numpy()
    shadowed = np.zeros(hit.shape, bool)
    shadowed[hit] = reach < distance - _SHADOW_MARGIN_MM
    return shadowed
