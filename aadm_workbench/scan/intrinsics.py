"""Intrinsics in the many ways they are written down: TOML, JSON, XML and the text that the cameras' SDKs print."""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from aadm_workbench.errors import CameraError
from aadm_workbench.model import Camera
from aadm_workbench.scan.xml_table import parse_xml

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_SHORTEST_FOCAL_LENGTH = 10.0
"""In pixels; a rotation matrix also has three rows, but its entries are at most 1."""

_UNLIKE_FOCAL_LENGTHS = 1.2
"""Pixels are square: where the first two of four numbers differ by more, they are no two focal lengths."""

_LARGEST_PIXEL_COUNT = 2**26  # as in picture.py
_DEFAULT_SCALE_ERROR = Camera.scale_error
_OTHER_NAMES = {"ppx": "cx", "ppy": "cy", "imagewidth": "width", "imageheight": "height"}


@dataclass(frozen=True)
class Intrinsics:
    """What was found in a file; ``camera`` says which of a device's cameras it describes ("depth", "texture", "")."""

    camera: str = ""
    fx: float | None = None
    fy: float | None = None
    cx: float | None = None
    cy: float | None = None
    width: int | None = None
    height: int | None = None
    scale_error: float = _DEFAULT_SCALE_ERROR
    distortion: tuple[float, ...] = ()


def parse(text: str, suffix: str) -> Intrinsics:
    """Find the intrinsics of the depth camera in a text.

    Parameters
    ----------
    text
        Content of the file.
    suffix
        ``.toml``, ``.json`` and ``.xml`` are read as such, everything else as printed text.

    Raises
    ------
    CameraError
        For text that is no TOML, JSON or XML although it should be, and for cameras that differ and none of which is
        called depth.
    """
    read_table = _READERS.get(suffix)
    if read_table is None:
        return _from_text(text)
    try:
        return _chosen(list(_from_table(read_table(text), "")))
    except RecursionError as error:
        raise CameraError("is nested deeper than any file of intrinsics") from error
    except ValueError as error:
        raise CameraError(f"is no valid {suffix[1:].upper()}: {error}") from error


_READERS: dict[str, Callable[[str], Any]] = {".json": json.loads, ".toml": tomllib.loads, ".xml": parse_xml}


def checked_camera(found: Intrinsics) -> Camera:
    """Return a camera from what was found, if it is complete and can be a camera.

    Raises
    ------
    CameraError
        Naming what is missing or impossible.
    """
    fx, fy, cx, cy, width, height = found.fx, found.fy, found.cx, found.cy, found.width, found.height
    if fx is None or fy is None or cx is None or cy is None:
        raise CameraError("holds no fx, fy, cx and cy that belong together; write them as fx = ..., fy = ..., ...")
    if width is None or height is None:
        raise CameraError("does not say how large the depth map is; add a line such as: width: 1920, height: 1200")
    if not (min(fx, fy) >= _SHORTEST_FOCAL_LENGTH and math.isfinite(fx) and math.isfinite(fy)):
        raise CameraError(f"has focal lengths fx = {fx}, fy = {fy}, which cannot be; they are in pixels")
    if width * height > _LARGEST_PIXEL_COUNT:
        raise CameraError(f"has {width} x {height} pixels, more than any camera")
    if not (0 < cx < width and 0 < cy < height):
        raise CameraError(
            f"has its centre (cx, cy) = ({cx:.1f}, {cy:.1f}) outside of its {width} x {height} pixels: "
            "the size belongs to another camera or another resolution"
        )
    if any(value != 0 for value in found.distortion):
        raise CameraError(
            f"has distortion coefficients {list(found.distortion)}, but points are computed for an undistorted camera: "
            "export undistorted depth maps, or point clouds instead of depth maps"
        )
    return Camera(fx, fy, cx, cy, width, height, found.scale_error)


def _chosen(candidates: list[Intrinsics]) -> Intrinsics:
    """Return the depth camera; else the only one, or the one that all agree on."""
    complete = [item for item in candidates if item.fx is not None]
    meant = [item for item in complete if item.camera == "depth"] or complete
    if not meant:
        return Intrinsics()
    values = {(item.fx, item.fy, item.cx, item.cy) for item in meant}
    if len(values) > 1:
        raise CameraError("describes cameras that differ, and none is called depth; keep the depth camera's only")
    return meant[0]


def _kind(label: str) -> str:
    return next((word for word in ("depth", "texture") if word in label.lower()), "")


def _from_table(table: Any, label: str, outer: Mapping[str, Any] | None = None) -> Iterator[Intrinsics]:
    """Yield the intrinsics of a table and of the tables in it; what a table lacks, the one around it may say."""
    if not isinstance(table, Mapping):
        return
    own = {_named(str(key)): _without_shape(value) for key, value in table.items()}
    known = {**(outer or {}), **own}
    matrix = next((found for value in own.values() if (found := _matrix(_flat(value)))), None)
    if {"fx", "fy", "cx", "cy"} <= own.keys():
        fx, fy, cx, cy = (_plain_number(own[key], key) for key in ("fx", "fy", "cx", "cy"))
        matrix = fx, fy, cx, cy
    if matrix is not None:
        yield Intrinsics(
            _kind(label), *matrix, _size(known, "width"), _size(known, "height"), _scale_error(known), _distortion(own)
        )
    passed_on = {key: value for key, value in known.items() if not isinstance(value, Mapping | list)}
    for key, value in table.items():
        yield from _from_table(value, f"{label} {key}", passed_on)


def _named(key: str) -> str:
    """Return a key without capitals and signs, and by one name where it has several."""
    plain = re.sub("[^a-z0-9]", "", key.lower())
    return _OTHER_NAMES.get(plain, plain)


def _without_shape(value: Any) -> Any:
    """Return the numbers of a matrix that is written with its shape (rows, cols, data), as OpenCV and ROS do."""
    if isinstance(value, Mapping) and isinstance(value.get("data"), list):
        return value["data"]
    return value


def _plain_number(value: Any, key: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise CameraError(f"has {key} = {value!r}, which is no number")
    return _as_float(value)


def _as_float(value: int | float) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _size(known: Mapping[str, Any], key: str) -> int | None:
    value = known.get(key)
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int) or value <= 0:
        raise CameraError(f"has {key} = {value!r}; it must be a whole number of pixels")
    return value


def _scale_error(known: Mapping[str, Any]) -> float:
    return _plain_number(known.get("scaleerror", _DEFAULT_SCALE_ERROR), "scale_error")


def _distortion(table: Mapping[str, Any]) -> tuple[float, ...]:
    is_coefficient = re.compile(r"k[1-6]|p[12]|d|dist.*|coeffs").fullmatch
    return tuple(number for key, value in table.items() if is_coefficient(key) for number in _flat(value))


def _flat(value: Any) -> list[float]:
    """Return the numbers in nested lists and tables."""
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list):
        return [number for item in value for number in _flat(item)]
    return [_as_float(value)] if isinstance(value, int | float) and not isinstance(value, bool) else []


def _from_text(text: str) -> Intrinsics:
    candidates = [Intrinsics(_kind(label), *matrix) for label, matrix in _printed_matrices(text)]
    candidates = candidates or [Intrinsics("", *values) for values in _printed_names(text)]
    chosen = _chosen(candidates)
    width, height = _printed_size(text)
    return Intrinsics(
        chosen.camera, chosen.fx, chosen.fy, chosen.cx, chosen.cy, width, height, distortion=_printed_distortion(text)
    )


def _printed_matrices(text: str) -> Iterator[tuple[str, tuple[float, float, float, float]]]:
    """Yield the camera matrices in a text, each with the last words before it."""
    blocks: list[tuple[str, list[float]]] = [("", [])]
    for line in text.splitlines():
        words, bracket, rest = line.partition("[")
        if re.search("[A-Za-z]", words):
            blocks.append((words, []))
        else:
            rest = words + bracket + rest
        if not re.search("[A-DF-Za-df-z]", rest):
            blocks[-1][1].extend(float(number) for number in re.findall(_NUMBER, rest))
    for label, numbers in blocks:
        matrix = _matrix(numbers)
        if matrix is not None:
            yield label, matrix


def _matrix(numbers: list[float]) -> tuple[float, float, float, float] | None:
    """Return fx, fy, cx, cy of a camera matrix by rows or by columns, of these four numbers, or of fx, cx, fy, cy."""
    match numbers:
        case (
            [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0] | [fx, 0.0, 0.0, 0.0, fy, 0.0, cx, cy, 1.0] | [fx, fy, cx, cy]
        ) if min(fx, fy) >= _SHORTEST_FOCAL_LENGTH and min(cx, cy) > 0:
            if len(numbers) == 4 and _are_unlike(fx, fy) and not _are_unlike(fx, cx):
                return fx, cx, fy, cy
            return fx, fy, cx, cy
    return None


def _are_unlike(one: float, other: float) -> bool:
    return not 1.0 / _UNLIKE_FOCAL_LENGTHS < one / other < _UNLIKE_FOCAL_LENGTHS


def _printed_names(text: str) -> Iterator[tuple[float, float, float, float]]:
    """Yield the values of fx, fy, cx and cy where they are printed by name."""
    pattern = rf"(?i)\b{{}}\b[\"']?\s*[:=]\s*({_NUMBER})"
    columns = [re.findall(pattern.format(name), text) for name in ("fx", "fy", "cx", "cy")]
    yield from (tuple(map(float, values)) for values in zip(*columns, strict=False))  # type: ignore[misc]


def _printed_size(text: str) -> tuple[int | None, int | None]:
    """Return the size of the depth map; of the only image where none is called depth."""
    pairs = list(re.finditer(r"(?i)width\W{1,6}(\d{1,6})\W{1,40}(?:image_)?height\W{1,6}(\d{1,6})", text))
    pairs = pairs or list(re.finditer(r"(?i)(?:resolution|size)\W{1,6}(\d{1,6})\W{1,6}(?:x\s)?(\d{1,6})", text))
    if not pairs and (turned := re.search(r"(?i)height\W{1,6}(\d{1,6})\W{1,40}(?:image_)?width\W{1,6}(\d{1,6})", text)):
        return int(turned.group(2)), int(turned.group(1))
    by_camera = {_kind(text[text.rfind("\n", 0, pair.start()) + 1 : pair.start()]): pair for pair in pairs}
    pair = by_camera.get("depth") or (pairs[0] if len({pair.groups() for pair in pairs}) == 1 else None)
    return (int(pair.group(1)), int(pair.group(2))) if pair else (None, None)


def _printed_distortion(text: str) -> tuple[float, ...]:
    """Return the depth camera's coefficients, or all that are printed where none are called depth."""
    of_depth = re.search(r"(?i)depth[ \w]*dist[ \w]*:\s*(\S.*)", text)
    printed = of_depth.group(1) if of_depth else text
    coefficients = re.findall(rf"(?i)\b(?:k[1-6]|p[12])\b\s*[:=]\s*({_NUMBER})", printed)
    for listed in _LISTED_DISTORTION.findall(text):
        coefficients += re.findall(_NUMBER, listed)
    return tuple(float(value) for value in coefficients)


_LISTED_DISTORTION = re.compile(
    r"(?i)\bdist\w{0,40}[ \w]{0,20}:\s{0,80}(?:!!opencv-matrix)?(?:\s{0,80}(?:rows|cols|dt)\s?:\s?\w{1,9}){0,3}"
    r"\s{0,80}(?:data\s?:)?\s{0,80}\[([^\]]{0,2000})\]"
)
