"""From phases to depth: unwrapping by beats, and a plane of the projector met by a ray of the camera."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Camera
from aadm_workbench.twin.fringe.rig import FringeRig, Fringes, Projector

_TURN = 2.0 * np.pi  # rad


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
