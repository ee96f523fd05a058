"""A scan by fringe projection: a surface in the column frame goes in, a depth map with its truth comes out."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Array, AssemblyPoint, Camera
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.fringe.materials import Materials
from aadm_workbench.twin.fringe.phases import depth_of, unwrapped
from aadm_workbench.twin.fringe.render import Effort, rendered
from aadm_workbench.twin.fringe.rig import FringeRig
from aadm_workbench.twin.fringe.sensor import recorded
from aadm_workbench.twin.meshes import surface_of
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import TrueScan, truth_of
from aadm_workbench.twin.surface import Surface


@dataclass(frozen=True, eq=False)
class FringeImage:
    """Light that came into the camera, without noise: draw as many scans from it as are wanted.

    ``light`` (h, w, 1 + 2 k) float32, constant, cosines and sines in any unit; ``reference`` is that of lit concrete.
    """

    light: npt.NDArray[np.float32]
    reference: float
    rig: FringeRig
    camera: Camera

    def drawn(self, rng: np.random.Generator) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Depth (h, w) float32, mm, with fresh noise of the sensor, and the fringes' amplitude (h, w)."""
        taken = recorded(self.light, self.reference, self.rig, rng)
        depth = depth_of(unwrapped(taken.phases, self.rig.fringes), self.camera, self.rig)
        return depth, taken.amplitude


@dataclass(frozen=True)
class FringeCamera:
    """The camera with what its scenes are made of, and how much work is put into a picture."""

    rig: FringeRig = field(default_factory=FringeRig)
    materials: Materials = field(default_factory=Materials)
    effort: Effort = field(default_factory=Effort)


def fringe_image(
    surface: Surface, T_column_scan: Array, fringe: FringeCamera, rng: np.random.Generator, camera: Camera = PRO_M
) -> FringeImage:
    """Render a surface that is given in the column frame.

    Raises
    ------
    MissingDependencyError
        Where Mitsuba, or the LLVM that it compiles with, is not installed.
    """
    light, reference = rendered(surface, T_column_scan, fringe.rig, fringe.materials, fringe.effort, rng, camera)
    return FringeImage(light, reference, fringe.rig, camera)


def fringe_scan_of(
    part: Foot | BarGroup,
    T_column_scan: Array,
    fringe: FringeCamera,
    rng: np.random.Generator,
    camera: Camera = PRO_M,
) -> TrueScan:
    """Scan a foot or a bar group from a pose of the camera, as ``scene.scan_of`` does with the ray caster."""
    return fringe_shot(surface_of(part), truth_of(part), T_column_scan, fringe, rng, camera)


def fringe_shot(
    surface: Surface,
    truth: tuple[AssemblyPoint, ...],
    T_column_scan: Array,
    fringe: FringeCamera,
    rng: np.random.Generator,
    camera: Camera = PRO_M,
) -> TrueScan:
    """Scan any surface, given in the column frame."""
    depth, amplitude = fringe_image(surface, T_column_scan, fringe, rng, camera).drawn(rng)
    return TrueScan(depth, camera, truth, T_column_scan, brightness=amplitude)
