"""What goes wrong between a camera and a job: a lens, a unit or a name that is not the scan's, and what is not seen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Camera
from aadm_workbench.twin.filters import Depth
from aadm_workbench.twin.scene import TrueScan

_OUTLIERS, _OUTLIER_REACH_MM = 0.02, 80.0  # share and reach of what bad captures hold
_ABOVE_FLOOR_MM = 60.0  # below the tops a depth range ends that does not reach the floor


@dataclass(frozen=True)
class Slip:
    """What the job says that is not so, as factors of the truth, and what the scans lack.

    ``focal`` of fx and fy; ``principal_px`` is added to cx and cy; ``lengths`` of depths that were measured;
    ``unit`` is that of the job; ``up_deg`` is added to the direction of the image's top; ``swapped`` files; the bars'
    file ``twice``; ``mirrored`` pictures were stored as in a mirror;
    ``outliers`` is the share of pixels that lie up to 80 mm off; without ``floor`` the bars' depth range ends above it.
    """

    focal: float = 1.0
    principal_px: tuple[float, float] = (0.0, 0.0)
    lengths: float = 1.0
    unit: str = "mm"
    up_deg: float = 0.0
    swapped: bool = False
    twice: bool = False
    mirrored: bool = False
    outliers: float = 0.0
    floor: bool = True


NO_SLIP = Slip()

SLIPS: Mapping[str, Slip] = MappingProxyType(
    {
        "focal-half": Slip(focal=0.5),
        "focal-double": Slip(focal=2.0),
        "focal-2-percent": Slip(focal=1.02),
        "principal-point": Slip(principal_px=(80.0, -80.0)),
        "depth-x10": Slip(lengths=10.0),
        "depth-by-10": Slip(lengths=0.1),
        "unit": Slip(unit="m"),
        "up": Slip(up_deg=180.0),
        "swapped": Slip(swapped=True),
        "twice": Slip(twice=True),
        "mirrored": Slip(mirrored=True),
        "outliers": Slip(outliers=_OUTLIERS),
        "no-floor": Slip(floor=False),
    }
)
"""Slips by name; ``focal-half`` and its like are what the job says of the camera."""


def slip_of(names: Sequence[str]) -> Slip:
    """All slips of some names at once.

    Raises
    ------
    AadmError
        Where a name is none of :data:`SLIPS`.
    """
    slip = NO_SLIP
    for name in names:
        if name not in SLIPS:
            raise AadmError.because("command.twin_slip", name=name, known=tuple(SLIPS))
        other = SLIPS[name]
        changed = {key: value for key, value in vars(other).items() if value != getattr(NO_SLIP, key)}
        slip = replace(slip, **changed)
    return slip


def told_camera(camera: Camera, slip: Slip) -> Camera:
    """The camera that the job tells of."""
    across, down = slip.principal_px
    return replace(
        camera,
        fx=camera.fx * slip.focal,
        fy=camera.fy * slip.focal,
        cx=camera.cx + across,
        cy=camera.cy + down,
    )


def seen_with(scan: TrueScan, slip: Slip, rng: np.random.Generator, *, is_foot: bool = False) -> TrueScan:
    """The scan with what a slip does to scans themselves: outliers, and no floor under bars."""
    if slip.mirrored:
        scan = _mirrored(scan)
    depth = scan.depth if slip.floor or is_foot else _without_floor(scan)
    if slip.outliers:
        depth = _strewn(depth, slip.outliers, rng)
    return replace(scan, depth=depth)


def _mirrored(scan: TrueScan) -> TrueScan:
    """Left and right the wrong way round, which the job does not know; the truth stays that of the scene."""
    camera = scan.camera
    return replace(scan, depth=scan.depth[:, ::-1], camera=replace(camera, cx=camera.width - 1.0 - camera.cx))


def told_scan(scan: TrueScan, slip: Slip) -> TrueScan:
    """The scan as the job tells of it: its lengths and its camera; the truth remains that of the scene."""
    return replace(scan, depth=scan.depth * np.float32(slip.lengths), camera=told_camera(scan.camera, slip))


def _without_floor(scan: TrueScan) -> Depth:
    """What lies deep under the tops is out of the camera's range."""
    far_mm = float(np.median(scan.points_scan()[:, 2])) + _ABOVE_FLOOR_MM
    return np.where(scan.depth < far_mm, scan.depth, np.float32(np.nan))


def _strewn(depth: Depth, share: float, rng: np.random.Generator) -> Depth:
    astray = rng.random(depth.shape) < share
    off = rng.uniform(-_OUTLIER_REACH_MM, _OUTLIER_REACH_MM, depth.shape).astype(np.float32)
    return np.where(astray, depth + off, depth)
