"""What all GenICam cameras have in common, whatever carries their packets: how they are prepared and what they send."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from aadm_workbench.camera.coordinates import BEST_FORMATS, BEST_MODE, Part, measured
from aadm_workbench.camera.features import Features, coding_of
from aadm_workbench.camera.frame import Device, Frame
from aadm_workbench.camera.pinhole import camera_of
from aadm_workbench.camera.settings import warnings_of
from aadm_workbench.errors import CaptureError
from aadm_workbench.model.reason import Reason, reason_of

FRAME_WITHIN_S = 15.0
"""Cameras of this kind project, decode and send in half a second to five; then something is wrong."""

_LUMA = (0.299, 0.587, 0.114)  # of R, G, B: ITU-R BT.601
_CHANNELS = {"RGB8": (0, 1, 2, 3), "BGR8": (2, 1, 0, 3), "RGBa8": (0, 1, 2, 4), "BGRa8": (2, 1, 0, 4)}
"""Place of R, G and B among the values of a pixel, and how many these are."""


def prepare(features: Features) -> None:
    """Ask for all coordinates, in the camera's own system, and for what each frame says of them."""
    features.set("ChunkModeActive", True)
    for chunk in features.choices("ChunkSelector"):
        if chunk.startswith("Scan3d") and features.set("ChunkSelector", chunk):
            features.set("ChunkEnable", True)
    if features.set("ComponentSelector", "Range"):
        features.set("ComponentEnable", True)
    if BEST_MODE in features.choices("Scan3dOutputMode"):
        features.set("Scan3dOutputMode", BEST_MODE)
    offered = features.choices("PixelFormat")
    best = next((name for name in BEST_FORMATS if name in offered), None)
    if best is not None:
        features.set("PixelFormat", best)


def frame_of(device: Device, captured_s: float, parts: Sequence[Part], features: Features) -> Frame:
    """Return the frame that the parts of a buffer are, by what the device says of them.

    Raises
    ------
    CaptureError
        For parts in which nothing can be measured, with the address of the camera.
    """
    width, height = next(((p.width, p.height) for p in parts if p.format.startswith("Coord3D")), (0, 0))
    try:
        found = measured(parts, coding_of(features, width, height))
    except (CaptureError, ValueError) as error:
        raise CaptureError(Reason("said.of_file", file=device.address, why=reason_of(error))) from error
    settings = features.settings()
    camera = found.camera if found.points is None else camera_of(found.points)
    grey, notes = _grey(parts, width, height), warnings_of(settings)
    return Frame(device, captured_s, found.points, found.depth_mm, camera, grey, settings, notes)


def first_line(error: BaseException) -> str:
    """The first line of what a library says of an error; its kind where it says nothing."""
    return (str(error).splitlines() or [type(error).__name__])[0]


def _grey(parts: Sequence[Part], width: int, height: int) -> npt.NDArray[np.uint8] | None:
    """Return the picture of the same view, pixel for pixel; None where there is none."""
    for part in parts:
        if (part.width, part.height) != (width, height):
            continue
        if part.format == "Mono8" and part.values.size == width * height:
            return part.values.reshape(height, width).astype(np.uint8)
        channels = _CHANNELS.get(part.format)
        if channels is not None and part.values.size == width * height * channels[-1]:
            colours = part.values.reshape(height, width, channels[-1])[..., channels[:3]]
            grey: npt.NDArray[np.uint8] = np.rint(colours @ np.array(_LUMA)).astype(np.uint8)
            return grey
    return None
