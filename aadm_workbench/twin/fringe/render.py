"""Which pixels need how many paths, and the picture that comes of it.

Triangles small enough for a ray tracer to tell apart.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from aadm_workbench.model import Array, BoolArray, Camera, IntArray
from aadm_workbench.twin.fringe.light import relief_tile
from aadm_workbench.twin.fringe.materials import Materials, bsdf_of, has_relief
from aadm_workbench.twin.fringe.renderer import mitsuba_ready
from aadm_workbench.twin.fringe.rig import FringeRig
from aadm_workbench.twin.surface import Surface, moved

_REACH_PX = 4  # a pixel's share of light from further off is nothing for sharp optics, and small for blurred
_LONGEST_MM = 25.0  # of an edge: about as wide as what is drilled into a face
_STEP_MM = 3.0  # over the reach; a face tilted by 15 degrees stays below it


@dataclass(frozen=True)
class Effort:
    """Paths per pixel: ``smooth`` where one plain surface fills the pixel, ``busy`` at edges, on metal and bars.

    ``dim`` where no light comes straight from the projector: what bounces there is mixed from many places, and a
    mean of few paths would look like fringes that are not there. ``at_once`` bounds the paths
    that are in memory together.
    """

    smooth: int = 8
    busy: int = 64
    dim: int = 256
    at_once: int = 3_000_000


@dataclass(frozen=True, eq=False)
class _Glance:
    """What a pinhole sees: all (h, w). ``depth`` mm, NaN where there is nothing."""

    depth: npt.NDArray[np.float32]
    shape: npt.NDArray[np.int64]
    lit: BoolArray


def rendered(
    surface: Surface,
    T_column_scan: Array,
    rig: FringeRig,
    materials: Materials,
    effort: Effort,
    rng: np.random.Generator,
    camera: Camera,
) -> tuple[npt.NDArray[np.float32], float]:
    """Light (h, w, 1 + 2 k) from a surface in the column frame, and the light that lit concrete sends."""
    stage, cast = _staged(surface, T_column_scan, materials, rng)
    from aadm_workbench.twin.fringe.light import traced

    glance = _glance(stage, rig, camera)
    dim = np.isfinite(glance.depth) & ~ndimage.maximum_filter(glance.lit, 5)
    busy = _busy(glance, cast) & ~dim
    light = np.zeros((camera.height, camera.width, 1 + 2 * len(rig.fringes.periods)), np.float32)
    near = ndimage.binary_dilation(np.isfinite(glance.depth), iterations=6)
    smooth = near & ~busy & ~dim
    for wanted, paths in ((smooth, effort.smooth), (near & busy, effort.busy), (dim, effort.dim)):
        for pixels in _portions(wanted, effort.at_once // paths):
            seed = int(rng.integers(2**31))
            light[pixels[:, 1], pixels[:, 0]] = traced(stage, rig, camera, pixels, paths, seed)
    plain = glance.lit & np.isin(glance.shape, np.flatnonzero(cast))
    return light, float(np.percentile(light[..., 0][plain if plain.any() else glance.lit], 95))


def _portions(wanted: BoolArray, size: int) -> Iterator[npt.NDArray[np.int64]]:
    rows, columns = np.nonzero(wanted)
    pixels = np.column_stack([columns, rows])
    for start in range(0, len(pixels), size):
        yield pixels[start : start + size]


def _staged(
    surface: Surface, T_column_scan: Array, materials: Materials, rng: np.random.Generator
) -> tuple[Any, BoolArray]:
    """The scene for the tracer, and which of its shapes are cast concrete."""
    mi = mitsuba_ready()
    import drjit as dr

    from aadm_workbench.twin.fringe.light import Stage

    in_scan = moved(surface, np.asarray(np.linalg.inv(T_column_scan), np.float64))
    kinds = [int(kind) for kind in np.unique(surface.kind)]
    shapes = tuple(_mesh(mi, in_scan, kind, materials) for kind in kinds)
    scene = mi.load_dict({"type": "scene", **{f"kind{kind}": shape for kind, shape in zip(kinds, shapes, strict=True)}})
    cast = np.array([has_relief(kind) for kind in kinds])
    tile = relief_tile(materials.relief, materials.mottling, rng)
    relief = mi.Texture2f(mi.TensorXf(tile), wrap_mode=dr.WrapMode.Repeat)
    pose = mi.Transform4f(np.asarray(T_column_scan, np.float64))
    return Stage(scene, shapes, cast, relief, pose), cast


def _mesh(mi: Any, surface: Surface, kind: int, materials: Materials) -> Any:
    """The triangles of one kind, flat: what looks round is made of narrow facets."""
    vertices, triangles = divided(surface.vertices, surface.triangles[surface.kind == kind], _LONGEST_MM)
    used, corners = np.unique(triangles, return_inverse=True)
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(bsdf_of(kind, materials))
    mesh = mi.Mesh(f"kind{kind}", len(used), len(triangles), props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = mi.Float(vertices[used].astype(np.float32).ravel())
    parameters["faces"] = mi.UInt32(corners.astype(np.uint32).ravel())
    parameters.update()
    return mesh


def _glance(stage: Any, rig: FringeRig, camera: Camera) -> _Glance:
    """Ray through the middle of each pixel, and whether the middle of the projector's lens is seen from there."""
    import mitsuba as mi

    u, v = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    ray = np.stack([(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, np.ones(u.shape)])
    length = np.linalg.norm(ray, axis=0)
    directions = mi.Vector3f(*[mi.Float((axis / length).astype(np.float32).ravel()) for axis in ray])
    si = stage.scene.ray_intersect(mi.Ray3f(mi.Point3f(0.0), directions))
    lit = si.is_valid() & ~stage.scene.ray_test(si.spawn_ray_to(mi.Point3f(rig.projector.baseline, 0.0, 0.0)))
    shape = mi.Int32(-1)
    for number, one in enumerate(stage.shapes):
        shape[si.is_valid() & (si.shape == mi.ShapePtr(one))] = number
    depth = np.where(si.is_valid().numpy(), si.t.numpy(), np.nan).reshape(u.shape) / length
    return _Glance(depth.astype(np.float32), shape.numpy().reshape(u.shape), lit.numpy().reshape(u.shape))


def _busy(glance: _Glance, cast: BoolArray) -> BoolArray:
    """Pixels (h, w) near a step, a shadow's edge or anything that is not cast concrete."""
    reach = 2 * _REACH_PX + 1
    deep = np.where(np.isnan(glance.depth), np.float32(1e6), glance.depth)
    spread = ndimage.maximum_filter(deep, reach) - ndimage.minimum_filter(deep, reach)
    other = ~np.isin(glance.shape, np.flatnonzero(cast))
    border = ndimage.maximum_filter(glance.lit, reach) != ndimage.minimum_filter(glance.lit, reach)
    return np.asarray((spread > _STEP_MM) | border | ndimage.maximum_filter(other, reach))


def divided(vertices: Array, triangles: IntArray, longest_mm: float) -> tuple[Array, IntArray]:
    """Vertices (n, 3) and triangles (m, 3) of the same surface, with no edge longer than ``longest_mm``.

    A drilled face comes as slivers from hole to hole, whose boxes overlap by the hundred; a tracer that has to try
    them all takes ten times as long. Edges are halved, the longest of each triangle first.
    """
    done = []
    while len(triangles):
        corners = vertices[triangles]
        lengths = np.linalg.norm(corners[:, [1, 2, 0]] - corners, axis=2)
        long = lengths.max(axis=1) > longest_mm
        done.append(triangles[~long])
        # Turned so that the longest edge runs from the first corner to the second.
        turn = (lengths[long].argmax(axis=1)[:, None] + np.arange(3)) % 3
        a, b, c = np.take_along_axis(triangles[long], turn, 1).T
        edges, middle = np.unique(np.sort(np.column_stack([a, b]), axis=1), axis=0, return_inverse=True)
        halfway = middle.ravel() + len(vertices)
        vertices = np.vstack([vertices, vertices[edges].mean(axis=1)])
        triangles = np.vstack([np.column_stack([a, halfway, c]), np.column_stack([halfway, b, c])])
    return vertices, np.vstack(done)
