"""What a camera gives, whatever protocol it speaks: one frame, in millimetres, with all that is known of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import TracebackType
from typing import Protocol, Self, TypeAlias

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Camera, FloatArray, Json

Setting: TypeAlias = str | int | float | bool

RECORD_NAME = "capture.json"
"""The file of a capture folder that says when, by what and with which settings it was taken."""


@dataclass(frozen=True)
class Device:
    """A camera that answers: how it is addressed, who made it, and its serial number; empty where it does not say."""

    address: str
    vendor: str = ""
    model: str = ""
    serial: str = ""


@dataclass(frozen=True, eq=False)
class Frame:
    """One frame of a camera, whole.

    Parameters
    ----------
    device
        The camera.
    captured_s
        When it was captured, seconds since 1970.
    points
        (h, w, 3) float32, mm, camera frame (x right, y down, z forward); NaN where there is no return. None where
        ``depth_mm`` or ``files`` says what was measured.
    depth_mm
        (h, w) float32, mm along the optical axis of ``camera``; NaN where there is no return.
    camera
        Intrinsics, undistorted; None where the camera does not say them.
    grey
        (h, w) uint8, the picture of the same view.
    settings
        What was in force, by the names that the vendor gives it.
    notes
        What the owner of the camera should know, such as smoothing that is on.
    files
        Of a capture that is played again: its files as they are, by name; then nothing else need be there.
    """

    device: Device
    captured_s: float
    points: FloatArray | None = None
    depth_mm: FloatArray | None = None
    camera: Camera | None = None
    grey: npt.NDArray[np.uint8] | None = None
    settings: Mapping[str, Setting] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    files: Mapping[str, bytes] = field(default_factory=dict)

    def record(self, stamp: str) -> dict[str, Json]:
        """What stands in ``capture.json``; ``stamp`` is the time of capture as the state file writes it."""
        device = self.device
        return {
            "schema": 1,
            "captured": stamp,
            "camera": device.address,
            "vendor": device.vendor,
            "model": device.model,
            "serial": device.serial,
            "settings": dict(self.settings),
            "notes": list(self.notes),
        }


class FrameSource(Protocol):
    """A camera that is open: it gives one frame at a time, and is closed at the end."""

    device: Device

    def capture(self) -> Frame:
        """Take one frame now and return it whole.

        Raises
        ------
        CaptureError
            Where this frame was lost, and the next one may be had.
        CameraGoneError
            Where the camera does not answer any more: it must be opened again.
        EndOfFramesError
            Where there are no more frames.
        """

    def close(self) -> None:
        """Let go of the camera; once more does no harm."""

    def __enter__(self) -> Self:
        """Give itself."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close."""


class Closing:
    """What closes at the end of a ``with``: the part that all cameras have in common."""

    def close(self) -> None:
        """Let go of the camera."""
        raise NotImplementedError

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
