"""Intrinsics in the many ways they are written down: TOML, JSON, XML and the text that the cameras' SDKs print."""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from aadm_workbench.errors import CameraError
from aadm_workbench.model import Camera, Reason
from aadm_workbench.scan.distortion import as_float, coefficients_in, is_coefficients, numbers_in
from aadm_workbench.scan.formats.xml_table import parse_xml
from aadm_workbench.scan.printed import Entry, entries_of, kind_of

_SHORTEST_FOCAL_LENGTH = 10.0
"""In pixels; a rotation matrix also has three rows, but its entries are at most 1."""

_UNLIKE_FOCAL_LENGTHS = 1.2
"""Pixels are square: where the first two of four numbers differ by more, they are no two focal lengths."""

_LARGEST_PIXEL_COUNT = 2**26  # as in picture.py
_DEFAULT_SCALE_ERROR = Camera.scale_error
_KEYS = frozenset({"fx", "fy", "cx", "cy", "width", "height"})
_OTHER_NAMES = {
    **{
        f"{word}{axis}": f"c{axis}"
        for word in ("pp", "principalpoint", "principal", "center", "centre")
        for axis in "xy"
    },
    **{f"{word}{axis}": f"f{axis}" for word in ("focal", "focallength") for axis in "xy"},
    **{f"{word}{name}": name for word in ("image", "img") for name in ("width", "height")},
    **{f"{word}{axis}": name for word in ("resolution", "size") for axis, name in (("x", "width"), ("y", "height"))},
    "imagesizex": "width",
    "imagesizey": "height",
}
Matrix: TypeAlias = tuple[float, float, float, float]
"""fx, fy, cx, cy in pixels."""


class BentLensError(CameraError):
    """Intrinsics of a lens whose distortion was not taken out: no depth map beside them can be believed."""


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
        table = read_table(text)
        chosen = _chosen(list(_from_table(table, "")))
        said = [(kind_of(path), numbers) for path, numbers in coefficients_in(table)]
        return replace(chosen, distortion=_of_the_camera(said, chosen.camera))
    except RecursionError as error:
        raise CameraError(Reason("scan.intrinsics_deep")) from error
    except ValueError as error:
        raise CameraError(Reason("scan.intrinsics_invalid", kind=suffix[1:].upper(), why=error)) from error


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
        raise CameraError(Reason("scan.no_fx"))
    if width is None or height is None:
        raise CameraError(Reason("scan.no_size"))
    if not (min(fx, fy) >= _SHORTEST_FOCAL_LENGTH and math.isfinite(fx) and math.isfinite(fy)):
        raise CameraError(Reason("scan.focal", fx=fx, fy=fy))
    if width * height > _LARGEST_PIXEL_COUNT:
        raise CameraError(Reason("scan.most_pixels", width=width, height=height))
    if not (0 < cx < width and 0 < cy < height):
        raise CameraError(Reason("scan.centre", cx=cx, cy=cy, width=width, height=height))
    if any(value != 0 for value in found.distortion):
        raise BentLensError(Reason("scan.distorted", distortion=list(found.distortion)))
    return Camera(fx, fy, cx, cy, width, height, found.scale_error)


def _chosen(candidates: list[Intrinsics]) -> Intrinsics:
    """Return the depth camera; else the only one, or the one that all agree on."""
    complete = [item for item in candidates if item.fx is not None]
    meant = [item for item in complete if item.camera == "depth"] or complete
    if not meant:
        return Intrinsics()
    values = {(item.fx, item.fy, item.cx, item.cy) for item in meant}
    if len(values) > 1:
        raise CameraError(Reason("scan.cameras_differ"))
    return meant[0]


def _from_table(table: Any, label: str, outer: Mapping[str, Any] | None = None) -> Iterator[Intrinsics]:
    """Yield the intrinsics of a table and of the tables in it; what a table lacks, the one around it may say."""
    if isinstance(table, list):
        for item in table:
            yield from _from_table(item, label, outer)
    if not isinstance(table, Mapping):
        return
    own = {_named(str(key)): _without_shape(value) for key, value in table.items()}
    known = {**(outer or {}), **own}
    matrix = _matrix_of(own)
    if matrix is not None:
        size = _size(known, "width"), _size(known, "height")
        if size == (None, None):
            size = _listed_size(numbers_in(own.get("imagesize", [])), *matrix[2:])
        yield Intrinsics(kind_of(label), *matrix, *size, _scale_error(known))
    passed_on = {key: value for key, value in known.items() if not isinstance(value, Mapping | list)}
    for key, value in table.items():
        yield from _from_table(value, f"{label} {key}", passed_on)


def _matrix_of(own: Mapping[str, Any]) -> Matrix | None:
    """Return fx, fy, cx, cy of a table, by name or as a matrix."""
    if {"fx", "fy", "cx", "cy"} <= own.keys():
        fx, fy, cx, cy = (_plain_number(own[key], key) for key in ("fx", "fy", "cx", "cy"))
        return fx, fy, cx, cy
    named = [numbers_in(own.get(key, [])) for key in ("focallength", "principalpoint")]
    if [len(numbers) for numbers in named] == [2, 2]:
        return _matrix(named[0] + named[1])
    listed = (numbers_in(value) for value in own.values() if not isinstance(value, str))
    return next((found for numbers in listed if (found := _matrix(numbers))), None)


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
        raise CameraError(Reason("scan.no_number", key=key, value=repr(value)))
    return as_float(value)


def _size(known: Mapping[str, Any], key: str) -> int | None:
    value = known.get(key)
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int) or value <= 0:
        raise CameraError(Reason("scan.no_whole", key=key, value=repr(value)))
    return value


def _scale_error(known: Mapping[str, Any]) -> float:
    return _plain_number(known.get("scaleerror", _DEFAULT_SCALE_ERROR), "scale_error")


def _from_text(text: str) -> Intrinsics:
    entries = entries_of(text)
    chosen = _chosen(_printed_matrices(entries) or list(_printed_names(entries)))
    width, height = _printed_size(text, entries)
    if width is None and chosen.cx is not None and chosen.cy is not None:
        listed = next((entry.numbers for entry in entries if entry.last == "imagesize"), ())
        width, height = _listed_size(list(listed), chosen.cx, chosen.cy)
    said = [(entry.camera, list(entry.numbers)) for entry in entries if _is_coefficients(entry)]
    return replace(chosen, width=width, height=height, distortion=_of_the_camera(said, chosen.camera))


def _printed_matrices(entries: list[Entry]) -> list[Intrinsics]:
    """Return the cameras that are printed as matrices, each called as the words right before it call it, if any do."""
    found = [(entry, matrix) for entry in entries if (matrix := _matrix(list(entry.numbers))) is not None]
    is_called = any(entry.own_camera for entry, _ in found)
    return [Intrinsics(entry.own_camera if is_called else entry.camera, *matrix) for entry, matrix in found]


def _is_coefficients(entry: Entry) -> bool:
    return any(is_coefficients(name, entry.numbers) for name in (entry.name, entry.last) if name)


def _of_the_camera(said: list[tuple[str, list[float]]], camera: str) -> tuple[float, ...]:
    """Return the coefficients of a camera: those that are called its own, else all but those of another one."""
    kinds = {kind for kind, _ in said}
    if camera == "depth":
        said = (
            [item for item in said if item[0] == "depth"]
            if "depth" in kinds
            else [item for item in said if item[0] != "texture"]
        )
    return tuple(number for _, numbers in said for number in numbers)


def _matrix(numbers: list[float]) -> Matrix | None:
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


def _printed_names(entries: list[Entry]) -> Iterator[Intrinsics]:
    """Yield the cameras whose fx, fy, cx and cy are printed by name, in any order."""
    known: dict[str, float] = {}
    for entry in entries:
        known.update(zip(_keys_of(entry), entry.numbers, strict=False))
        if known.keys() >= {"fx", "fy", "cx", "cy"}:
            yield Intrinsics(entry.camera, known["fx"], known["fy"], known["cx"], known["cy"])
            known = {}


def _keys_of(entry: Entry) -> tuple[str, ...]:
    """Return what the numbers of an entry are, of fx, fy, cx, cy, width and height; none where they are something else.

    The name is the last word, or, as in "principal point x", the last three.
    """
    ends = [_named("".join(entry.words[-count:])) for count in (1, 2, 3)]
    if len(entry.numbers) == 1:
        return tuple(key for key in ends if key in _KEYS)[:1]
    pairs = {"focallength": ("fx", "fy"), "principalpoint": ("cx", "cy"), "f": ("fx", "fy"), "p": ("cx", "cy")}
    return next((pairs[key] for key in ends if key in pairs), ()) if len(entry.numbers) == 2 else ()


def _printed_size(text: str, entries: list[Entry]) -> tuple[int | None, int | None]:
    """Return the size of the depth map; of the only image where none is called depth."""
    sizes = list(_named_sizes(entries))
    for pair in [] if sizes else re.finditer(_SIZE, text):
        before = text[text.rfind("\n", 0, pair.start()) + 1 : pair.start()]
        sizes.append((kind_of(before), (int(pair.group(1)), int(pair.group(2)))))
    by_camera = dict(sizes)
    size = by_camera.get("depth") or (sizes[0][1] if len({size for _, size in sizes}) == 1 else None)
    return size or (None, None)


_SIZE = re.compile(
    r"(?i)(?:\b(?:resolution|size)\W{1,6}(?:x\s)?(?=\d{1,6}\W{1,6}(?:x\s)?\d)|(?<![\w.])(?=\d{1,6}\s?[x×]))"
    r"(\d{1,6})\W{0,6}(?:[x×]\s?)?(\d{1,6})\b"
)


def _named_sizes(entries: list[Entry]) -> Iterator[tuple[str, tuple[int, int]]]:
    """Yield width and height where they are printed by name, each pair with the camera it is of."""
    known: dict[str, int] = {}
    for entry in entries:
        key = next(iter(_keys_of(entry)), "")
        if key in ("width", "height") and entry.numbers[0].is_integer() and entry.numbers[0] > 0:
            known[key] = int(entry.numbers[0])
        if known.keys() >= {"width", "height"}:
            yield entry.camera, (known["width"], known["height"])
            known = {}


def _listed_size(numbers: list[float], cx: float, cy: float) -> tuple[int | None, int | None]:
    """Return width and height of two numbers in the order that has the optical axis nearer to the middle.

    MATLAB writes rows before columns, most others the width first.
    """
    if len(numbers) != 2 or not all(number > 0 and number.is_integer() for number in numbers):
        return None, None
    orders = (numbers, numbers[::-1])
    width, height = min(orders, key=lambda size: abs(cx / size[0] - 0.5) + abs(cy / size[1] - 0.5))
    return int(width), int(height)
