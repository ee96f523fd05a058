"""Pictures, decoded and encoded by OpenCV: their size before they are unpacked, and their pixels."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import numpy.typing as npt

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.scan.file import ScanFile

Pixels = np.ndarray[Any, np.dtype[Any]]

_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_TIFF_WIDTH, _TIFF_HEIGHT, _TIFF_COMPRESSION, _TIFF_ROWS_PER_STRIP, _TIFF_PREDICTOR = 256, 257, 259, 278, 317
_TIFF_DEFLATE, _TIFF_NO_PREDICTOR, _TIFF_HORIZONTAL = 8, 1, 2
_TIFF_VALUE_FORMATS = {3: "H", 4: "I", 16: "Q"}


def _opencv() -> Any:
    try:
        import cv2
    except ImportError as error:
        install = "pip install opencv-python-headless"
        raise MissingDependencyError("opencv-python-headless", "a depth map or a picture", install) from error
    return cv2


def size_of(file: ScanFile) -> tuple[int, int]:
    """Return width and height that a PNG or TIFF announces, without unpacking it.

    Raises
    ------
    ScanError
        Where the file is neither, or ends within its header.
    """
    content = file.content
    try:
        if content.startswith(_PNG_SIGNATURE):
            width, height = struct.unpack_from(">II", content, 16)
            return int(width), int(height)
        if content[:4] in (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"):
            return _tiff_size(content)
    except (struct.error, KeyError) as error:
        raise file.wrong(f"ends or breaks off within its header ({len(content)} bytes); copy it again") from error
    raise file.wrong("is neither a TIFF nor a PNG; a depth map is one of the two, check its extension")


def _tiff_size(content: bytes) -> tuple[int, int]:
    order = "<" if content[:2] == b"II" else ">"
    is_big = content[2:4] in (b"+\0", b"\0+")
    directory = struct.unpack_from(order + ("Q" if is_big else "I"), content, 8 if is_big else 4)[0]
    count = struct.unpack_from(order + ("Q" if is_big else "H"), content, directory)[0]
    first, step, value_at = (directory + 8, 20, 12) if is_big else (directory + 2, 12, 8)
    sizes: dict[int, int] = {}
    for entry in range(first, first + min(count, 4096) * step, step):
        tag, kind = struct.unpack_from(order + "HH", content, entry)
        if tag in (_TIFF_WIDTH, _TIFF_HEIGHT):
            sizes[tag] = struct.unpack_from(order + _TIFF_VALUE_FORMATS[kind], content, entry + value_at)[0]
    return sizes[_TIFF_WIDTH], sizes[_TIFF_HEIGHT]


def pixels_of(file: ScanFile) -> Pixels:
    """Return the pixels of a picture as they are stored, (h, w) or (h, w, channels).

    Raises
    ------
    ScanError
        Where it cannot be decoded: no picture, damaged, or cut off.
    """
    cv2 = _opencv()
    return _decoded(file, cv2.IMREAD_UNCHANGED)


def grey_of(file: ScanFile) -> npt.NDArray[np.uint8]:
    """Return a picture as (h, w) uint8 grey values, in the orientation of the sensor.

    Raises
    ------
    ScanError
        Where it cannot be decoded: no picture, damaged, or cut off.
    """
    cv2 = _opencv()
    return _decoded(file, cv2.IMREAD_GRAYSCALE | cv2.IMREAD_IGNORE_ORIENTATION)


def _decoded(file: ScanFile, flags: int) -> Pixels:
    cv2 = _opencv()
    try:
        pixels: Pixels | None = cv2.imdecode(np.frombuffer(file.content, np.uint8), flags)
    except cv2.error:
        pixels = None
    if pixels is None:
        raise file.wrong("cannot be decoded: it is no picture, damaged or cut off; copy or export it again")
    return pixels


def encode_tiff(pixels: npt.NDArray[np.uint16]) -> bytes:
    """Return the smallest lossless TIFF of an (h, w) uint16 array that common readers understand.

    Deflate in one strip, with the predictor (none or horizontal) that packs a band across the middle better: slanted
    surfaces gain from differences, noise grows by them.
    """
    middle = pixels[len(pixels) // 2 :][:64]
    predictor = min((_TIFF_NO_PREDICTOR, _TIFF_HORIZONTAL), key=lambda choice: len(_encoded(middle, choice)))
    return _encoded(pixels, predictor)


def _encoded(pixels: npt.NDArray[np.uint16], predictor: int) -> bytes:
    options = [_TIFF_COMPRESSION, _TIFF_DEFLATE, _TIFF_PREDICTOR, predictor, _TIFF_ROWS_PER_STRIP, len(pixels)]
    _, encoded = _opencv().imencode(".tiff", pixels, options)
    content: bytes = encoded.tobytes()
    return content
