"""A live camera whose frames are written as they come: one that goes away is opened again, and costs its frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from time import monotonic
from typing import Self

from aadm_workbench.camera.frame import Frame, FrameSource
from aadm_workbench.camera.open import open_camera
from aadm_workbench.errors import CameraGoneError, CaptureError, EndOfFramesError
from aadm_workbench.report.hoisting_fitness import stamp_of
from aadm_workbench.scan.write_capture import write_capture

# of the time between frames: a column that swings at the pace of its frames would seem to stand, so no two are apart
# alike (steps of the golden section, which come back to no pace)
_UNEVEN, _GOLDEN = (0.8, 1.2), 0.6180339887
_AGAIN_AFTER_S = 1.0  # a camera that starts takes some seconds: to ask more often only fills the screen


class Session:
    """A camera by its address. What is wrong with the address itself is said when it is opened first."""

    def __init__(self, address: str, opener: Callable[[str], FrameSource] = open_camera) -> None:
        self.address, self._opener = address, opener
        self._source: FrameSource | None = opener(address)

    def take(self, folder: Path) -> Frame:
        """Take a frame and write it as the capture ``folder``.

        Raises
        ------
        CaptureError
            Where there is none, or it cannot be written: nothing of it is left, and the next one may be had.
        EndOfFramesError
            Where there are no more.
        """
        source = self._source = self._source or self._opener(self.address)
        try:
            frame = source.capture()
        except CameraGoneError:
            self.close()
            raise
        write_capture(folder, frame, stamp_of(frame.captured_s) or "")
        return frame

    def close(self) -> None:
        """Let go of the camera."""
        if self._source is not None:
            source, self._source = self._source, None
            source.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


@dataclass
class LiveFolder:
    """A camera that writes a capture into a folder, every ``every_s`` seconds in the mean, whenever it is asked.

    ``ended``: it plays captures again, and has played and been asked after the last.
    """

    session: Session
    folder: Path
    every_s: float = 0.0
    clock: Callable[[], float] = monotonic
    ended: bool = False
    _next: float = field(default=0.0, init=False)
    _taken: int = field(default=0, init=False)

    def fault(self) -> str:
        """Write the next frame if it is time; what kept it from being written, empty where nothing did."""
        now = self.clock()
        if now < self._next:
            return ""
        self._taken += 1
        share = _UNEVEN[0] + (_UNEVEN[1] - _UNEVEN[0]) * (self._taken * _GOLDEN % 1.0)
        self._next = now + share * self.every_s
        try:
            self.session.take(self.folder / name_of(datetime.now(UTC)))
        except EndOfFramesError:
            self.ended = True
        except CaptureError as error:
            self._next = self.clock() + max(self.every_s, _AGAIN_AFTER_S)
            return str(error)
        return ""


def name_of(when: datetime) -> str:
    """What a capture of a series is called: its time, UTC, so that names sort as frames came."""
    return when.astimezone(UTC).strftime("%Y%m%dT%H%M%S%fZ")
