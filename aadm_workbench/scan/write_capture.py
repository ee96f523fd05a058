"""A frame of a camera to a capture folder, whole or not there, as :mod:`aadm_workbench.scan.capture` reads it."""

from __future__ import annotations

import contextlib
import json
import shutil
import uuid
from pathlib import Path

from aadm_workbench.camera.frame import RECORD_NAME, Frame
from aadm_workbench.errors import AadmError, CaptureError
from aadm_workbench.model import Camera
from aadm_workbench.model.reason import reason_of, renamed, said_of
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.picture import encode_float_tiff, encode_png
from aadm_workbench.scan.write import write_pcd

CLOUD, DEPTH, INTRINSICS, PICTURE = "cloud.pcd", "depth.tiff", "intrinsics.json", "texture.png"


def write_capture(folder: Path, frame: Frame, stamp: str) -> None:
    """Write a frame as the folder of one capture, aside, and put it in its place when it is whole.

    Parameters
    ----------
    folder
        The capture; its parent must exist. An empty folder of that name is replaced.
    stamp
        The time of capture as text, UTC.

    Raises
    ------
    CaptureError
        Where the disk is full, the folder cannot be written or something stands in its place: nothing of the frame is
        then left.
    """
    aside = folder.with_name(f".{folder.name}.{uuid.uuid4().hex}.part")
    try:
        aside.mkdir()
        _write(aside, frame, stamp)
        _put(aside, folder)
    except CaptureError:
        raise
    except AadmError as error:
        raise CaptureError(renamed(reason_of(error), str(aside), str(folder))) from error
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise CaptureError(said_of(folder, "scan.capture_unwritten", why=reason)) from error
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _put(aside: Path, folder: Path) -> None:
    with contextlib.suppress(FileNotFoundError):
        if any(folder.iterdir()):
            raise CaptureError(said_of(folder, "scan.capture_there"))
        folder.rmdir()  # another system's rename does not replace even an empty one
    aside.rename(folder)


def _write(folder: Path, frame: Frame, stamp: str) -> None:
    for name, content in frame.files.items():
        write_atomically(folder / Path(name).name, content)
    if frame.depth_mm is not None:
        write_atomically(folder / DEPTH, encode_float_tiff(frame.depth_mm))
    if frame.points is not None:
        write_pcd(folder / CLOUD, frame.points, "binary")
    if frame.camera is not None:
        write_atomically(folder / INTRINSICS, _lines(_intrinsics(frame.camera)))
    if frame.grey is not None:
        write_atomically(folder / PICTURE, encode_png(frame.grey))
    write_atomically(folder / RECORD_NAME, _lines(frame.record(stamp)))


def _intrinsics(camera: Camera) -> dict[str, float | int]:
    return {name: getattr(camera, name) for name in ("fx", "fy", "cx", "cy", "width", "height")}


def _lines(document: object) -> bytes:
    return (json.dumps(document, ensure_ascii=False, indent=2) + "\n").encode()
