"""The folder of one capture, as a camera's SDK saves it: depth map or cloud, intrinsics, picture."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

from aadm_workbench.camera.frame import RECORD_NAME
from aadm_workbench.camera.record import Record, record_of
from aadm_workbench.errors import AadmError, CameraError, ScanError
from aadm_workbench.model import Camera, Reason
from aadm_workbench.model.reason import said_of
from aadm_workbench.scan.camera import (
    LARGEST_INTRINSICS_BYTES,
    LARGEST_PIXEL_OFFSET,
    read_camera,
    read_depth_scale_mm,
)
from aadm_workbench.scan.depth_picture import ColourPictureError, depth_picture
from aadm_workbench.scan.file import CLOUDS, DEPTH_MAPS, Declared, load
from aadm_workbench.scan.intrinsics import BentLensError
from aadm_workbench.scan.picture_size import picture_size

MOST_FILES = 1000
"""The folder of a capture holds a dozen files; a folder of a whole day is no capture."""

_PICTURES = (*DEPTH_MAPS, ".jpg", ".jpeg", ".bmp")
_INTRINSICS = (".toml", ".json", ".yaml", ".yml", ".xml", ".txt", ".ini", ".csv")
_DEPTH_WORDS = ("depth", "range", "tiefe", "深度")
_PICTURE_WORDS = ("texture", "color", "colour", "rgb", "gray", "grey", "image", "2d", "left", "mono")
_NO_MEASUREMENT_WORDS = ("preview", "colormap", "heat", "normal", "mask", "snr", "confidence", "render")


@dataclass(frozen=True, eq=False)
class Capture:
    """What was found in a folder: the file with the points, what is declared of it, the grey picture of its view."""

    scan: Path
    declared: Declared
    texture: Path | None
    intrinsics: Path | None
    notes: tuple[str, ...]

    def sha256(self, of_scan: str) -> str:
        """Hash of all files that count: that of the scan, followed by those of the others."""
        others = [load(path, path.name).sha256 for path in (self.intrinsics, self.texture) if path is not None]
        return hashlib.sha256("\n".join([of_scan, *others]).encode()).hexdigest() if others else of_scan


def find_capture(folder: Path, name: str, declared: Declared) -> Capture:
    """Find the scan in a folder, and the intrinsics and the grey picture that belong to it.

    A depth map goes before a cloud; a file belongs to the depth map by its name (``depth``) or by being the only one.

    Parameters
    ----------
    folder
        The folder; folders in it are not searched.
    name
        What messages call it.
    declared
        What the job says. Its camera holds where the folder has no intrinsics; two that differ are an error.

    Raises
    ------
    ScanError
        For a folder without a scan, or with several.
    CameraError
        For intrinsics that contradict the job's, and those of a lens that was not straightened beside a depth map.
    """
    files = _files(folder, name)
    scan = _scan(files, name)
    clouds = _of(files, CLOUDS)
    try:
        intrinsics, camera, notes = _camera(files, scan, declared)
    except BentLensError as error:
        if scan not in clouds and len(clouds) != 1:
            raise
        # The camera's program has straightened its cloud.
        scan = scan if scan in clouds else clouds[0]
        intrinsics, camera, notes = None, declared.camera, [Reason("scan.taken_since", name=scan.name, why=error)]
    if camera is None and scan not in clouds and len(clouds) == 1:
        notes.append(Reason("scan.taken_without", name=clouds[0].name, scan=scan.name))
        scan = clouds[0]
    if intrinsics is not None and declared.depth_scale_mm is None:
        declared = replace(declared, depth_scale_mm=read_depth_scale_mm(intrinsics))
    texture = _texture(files, scan)
    if texture is not None and camera is not None and _size(texture) != (camera.width, camera.height):
        notes.append(Reason("scan.texture_left_out", name=texture.name))
        texture = None
    notes += (record_of(folder) or Record()).notes
    return Capture(scan, replace(declared, camera=camera), texture, intrinsics, tuple(notes))


def _files(folder: Path, name: str) -> list[Path]:
    try:
        found = list(islice(folder.iterdir(), MOST_FILES + 1))
    except OSError as error:
        raise ScanError(said_of(name, "scan.folder_unreadable", why=error.strerror)) from error
    if len(found) > MOST_FILES:
        raise ScanError(Reason("scan.folder_full", name=name, most=MOST_FILES))
    return sorted(path for path in found if path.is_file() and not path.name.startswith("."))


def _of(files: Sequence[Path], suffixes: Sequence[str]) -> list[Path]:
    return [path for path in files if path.suffix.lower() in suffixes]


def _with(files: Sequence[Path], words: Sequence[str]) -> list[Path]:
    return [path for path in files if any(word in path.stem.lower() for word in words)]


def _scan(files: Sequence[Path], name: str) -> Path:
    """Return the depth map, else the cloud."""
    maps = [path for path in _of(files, (*DEPTH_MAPS, ".npz")) if path not in _with(files, _NO_MEASUREMENT_WORDS)]
    named = _with(maps, _DEPTH_WORDS)
    unnamed = [path for path in maps if path.suffix.lower() != ".png" and path not in _with(maps, _PICTURE_WORDS)]
    clouds = _of(files, CLOUDS)
    plain_clouds = [path for path in clouds if path not in _with(clouds, (*_PICTURE_WORDS, *_NO_MEASUREMENT_WORDS))]
    coloured = [path for path in (*named, *unnamed) if _is_in_colour(path)]
    for candidates in (named, unnamed, plain_clouds, clouds, coloured):
        if candidates is not coloured:
            candidates = [path for path in candidates if path not in coloured]
        if len(candidates) > 1:
            # A coloured view of the depth map is called after it, too.
            plain = [path for path in candidates if path not in _with(candidates, _PICTURE_WORDS)]
            candidates = plain or candidates
        if len(candidates) == 1:
            return candidates[0]
        if candidates:
            listed = ", ".join(path.name for path in candidates[:5])
            raise ScanError(Reason("scan.several_scans", name=name, listed=listed))
    raise ScanError(Reason("scan.folder_empty", name=name))


def _camera(files: Sequence[Path], scan: Path, declared: Declared) -> tuple[Path | None, Camera | None, list[str]]:
    """Return the file with the intrinsics, the camera that holds, and notes on it."""
    found, bent, unread = _intrinsics(files, scan)
    named = [item for item in found if _with([item[0]], _DEPTH_WORDS)]
    found = named or found
    for bent_path, why in bent:
        # Those of the texture camera beside straight ones of the depth map do not matter.
        if not named and not (found and _with([bent_path], _PICTURE_WORDS)):
            raise why
    if not found:
        return None, declared.camera, unread
    path, camera = found[0]
    for other_path, other in found[1:]:
        if not _same(camera, other):
            raise CameraError(Reason("scan.intrinsics_differ", first=path.name, second=other_path.name))
    if declared.camera is None:
        return path, camera, [Reason("scan.intrinsics_from", name=path.name)]
    if not _same(declared.camera, camera):
        raise CameraError(Reason("scan.intrinsics_not_job", name=path.name))
    return path, declared.camera, []


def _intrinsics(
    files: Sequence[Path], scan: Path
) -> tuple[list[tuple[Path, Camera]], list[tuple[Path, BentLensError]], list[str]]:
    """Return the cameras that are described beside a scan, those whose lens is bent, and what was not understood."""
    found: list[tuple[Path, Camera]] = []
    bent: list[tuple[Path, BentLensError]] = []
    unread: list[str] = []
    size = _size_of_depths(scan) if scan.suffix.lower() in _PICTURES else None
    for path in _of(files, _INTRINSICS):
        if path == scan or path.name == RECORD_NAME or path.stat().st_size > LARGEST_INTRINSICS_BYTES:
            continue
        try:
            found.append((path, read_camera(path, size)))
        except BentLensError as error:
            bent.append((path, error))
        except (CameraError, ScanError) as error:
            # Most texts beside a scan hold something else; of what is meant for intrinsics it is said why not.
            unread.append(Reason("scan.not_intrinsics", name=path.name, why=_reason(error)))
    return found, bent, unread


def _reason(error: AadmError) -> str:
    """What is wrong, without the file of which it is said."""
    said = error.reason
    return str(said.values["why"]) if isinstance(said, Reason) and said.code == "said.of_file" else said


def _same(one: Camera, other: Camera) -> bool:
    """Whether two cameras see a point in the same pixel, up to conventions."""
    if (one.width, one.height) != (other.width, other.height):
        return False
    corner = max(one.width / one.fx, one.height / one.fy)
    shifts = (one.cx - other.cx, one.cy - other.cy, corner * (one.fx - other.fx), corner * (one.fy - other.fy))
    return max(map(abs, shifts)) <= LARGEST_PIXEL_OFFSET


def _texture(files: Sequence[Path], scan: Path) -> Path | None:
    pictures = [path for path in _of(files, _PICTURES) if path != scan and path not in _with(files, _DEPTH_WORDS)]
    pictures = [path for path in pictures if path not in _with(pictures, _NO_MEASUREMENT_WORDS)]
    named = _with(pictures, _PICTURE_WORDS) or pictures
    return named[0] if len(named) == 1 else None


def _is_in_colour(path: Path) -> bool:
    """Whether a picture shows colours, such as a viewer's picture of a depth map."""
    if path.suffix.lower() not in _PICTURES:
        return False
    try:
        depth_picture(load(path, path.name))
    except ColourPictureError:
        return True
    except ScanError:
        return False
    return False


def _size_of_depths(path: Path) -> tuple[int, int] | None:
    """Return width and height of a depth map, None where it is none."""
    try:
        picture = depth_picture(load(path, path.name))
    except ScanError:
        return None
    return picture.width, picture.height


def _size(path: Path) -> tuple[int, int] | None:
    """Return width and height of a picture, None where it is none."""
    try:
        return picture_size(load(path, path.name))
    except ScanError:
        return None
