"""A scan by fringe projection: a surface in the column frame goes in, a depth map with its truth comes out.

From phases to depth: unwrapping by beats, and a plane of the projector met by a ray of the camera.

What the sensor records of the fringes: photons and read noise, digits, and the exposure that is used.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Array, AssemblyPoint, Camera
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.fringe.materials import Materials
from aadm_workbench.twin.fringe.render import Effort, rendered
from aadm_workbench.twin.fringe.rig import FringeRig, Fringes, Projector, Sensor
from aadm_workbench.twin.meshes import surface_of
from aadm_workbench.twin.parts import BarGroup, Foot, PlateAsBuilt
from aadm_workbench.twin.scene import TrueScan, truth_of
from aadm_workbench.twin.surface import Surface

_TURN = 2.0 * np.pi  # rad

Plane = npt.NDArray[np.float32]
_STEPS = 4  # quarter turns of each phase


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
    part: Foot | BarGroup | PlateAsBuilt,
    T_column_scan: Array,
    fringe: FringeCamera,
    rng: np.random.Generator,
    camera: Camera = PRO_M,
) -> TrueScan:
    """Scan a foot, a bar group or a plate from a pose of the camera, as ``scene.scan_of`` does with the ray caster."""
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


def unwrapped(phases: npt.NDArray[np.float32], fringes: Fringes) -> npt.NDArray[np.float64]:
    """Position (h, w) over the projector's width, 0..1, of wrapped phases (k, h, w).

    Each rung of the ladder says which turn the next one is in. A rung whose turn is wrong puts the position off by
    whole periods: nothing here mends that.
    """
    # The first beat has one period: about the middle of the width, no turn is left to choose.
    position = np.full(phases.shape[1:], 0.5)
    for weights, periods in fringes.ladder:
        beat = np.tensordot(np.asarray(weights, float), phases.astype(np.float64), 1) / _TURN
        position = (np.round(position * periods - beat) + beat) / periods
    return _mean_position(position, phases, fringes)


def _mean_position(
    position: npt.NDArray[np.float64], phases: npt.NDArray[np.float32], fringes: Fringes
) -> npt.NDArray[np.float64]:
    """Mean over all fringes, weighted as equal noise of their phases asks for; each in the turn of ``position``."""
    total = np.zeros(position.shape)
    for periods, phase in zip(fringes.periods, phases, strict=True):
        turns = phase.astype(np.float64) / _TURN
        total += periods * (np.round(position * periods - turns) + turns)
    return np.asarray(total / np.sum(np.square(fringes.periods)))


def depth_of(position: npt.NDArray[np.float64], camera: Camera, rig: FringeRig) -> npt.NDArray[np.float32]:
    """Depth (h, w) float32, mm, from positions over the projector's width; NaN outside of the camera's range."""
    normal, through = light_plane(position, rig.projector)
    u, v = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    ray = np.stack([(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, np.ones(u.shape)], -1)
    with np.errstate(divide="ignore", invalid="ignore"):
        depth = (normal @ through) / np.einsum("hwk,hwk->hw", normal, ray)
    depth[~((depth > rig.nearest) & (depth < rig.farthest))] = np.nan
    return np.asarray(depth, np.float32)


def light_plane(position: npt.NDArray[np.float64], projector: Projector) -> tuple[npt.NDArray[np.float64], ...]:
    """Normals (h, w, 3) of the planes of light at positions over the width, and the point (3,) that all contain."""
    axes = projector.rotation()
    slope = (position - 0.5) * projector.width / projector.focal
    # A direction (slope, anything, 1) of the projector's frame lies in the plane: its normal is (1, 0, -slope).
    normal = axes[:, 0] - slope[..., None] * axes[:, 2]
    return normal, np.array([projector.baseline, 0.0, 0.0])


@dataclass(frozen=True, eq=False)
class Recorded:
    """``phases`` (k, h, w) rad, -pi..pi, one per number of periods; NaN where the pixel is not trusted.

    ``amplitude`` (h, w): of the finest fringes, over the full scale at the middle exposure, NaN likewise.
    """

    phases: Plane
    amplitude: Plane


def recorded(light: Plane, reference: float, rig: FringeRig, rng: np.random.Generator) -> Recorded:
    """Record light (h, w, 1 + 2 k) with every exposure and keep, per pixel, the brightest that is not saturated.

    ``reference`` is the light of lit concrete, for which the middle exposure is made.
    """
    sensor = rig.sensor
    electrons = sensor.full_well * sensor.exposed_for / reference
    count = len(rig.fringes.periods)
    phases = np.full((count, *light.shape[:2]), np.nan, np.float32)
    amplitude = np.full(light.shape[:2], np.nan, np.float32)
    open_yet = np.ones(light.shape[:2], bool)
    for exposure in sorted(sensor.exposures, reverse=True):
        digits = [_digits(light, k, electrons * exposure, reference, sensor, rng) for k in range(count)]
        full = np.max([images.max(axis=0) for images in digits], axis=0) >= _top(sensor)
        used = open_yet & ~full
        for k, images in enumerate(digits):
            cosine, sine = images[0] - images[2], images[1] - images[3]
            weak = np.hypot(cosine, sine) / 2.0 < sensor.least_modulation * _top(sensor)
            phases[k][used] = np.where(weak, np.nan, np.arctan2(sine, cosine))[used]
            if k == 0:
                amplitude[used] = (np.hypot(cosine, sine) / 2.0 / _top(sensor) / exposure)[used]
        open_yet &= full
    phases[:, np.isnan(phases).any(axis=0)] = np.nan
    amplitude[np.isnan(phases[0])] = np.nan
    return Recorded(phases, amplitude)


def _top(sensor: Sensor) -> int:
    return int(2**sensor.bits - 1)


def _digits(
    light: Plane, k: int, electrons: float, reference: float, sensor: Sensor, rng: np.random.Generator
) -> Plane:
    """The four images (4, h, w) of one number of periods, in digits."""
    constant, cosine, sine = light[..., 0], light[..., 1 + 2 * k], light[..., 2 + 2 * k]
    ambient = np.float32(sensor.ambient * reference)
    images = np.empty((_STEPS, *constant.shape), np.float32)
    for step, wave in enumerate((cosine, sine, -cosine, -sine)):
        caught = np.maximum((0.5 * (constant + wave) + ambient) * np.float32(electrons), 0.0)
        spread = np.sqrt(caught + np.float32(sensor.read_noise**2))
        caught += spread * rng.standard_normal(caught.shape, dtype=np.float32)
        images[step] = np.clip(np.rint(caught * np.float32(_top(sensor) / sensor.full_well)), 0, _top(sensor))
    return images
