"""Pictures, decoded and encoded by OpenCV, those that it may unpack."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.scan.file import ScanFile
from aadm_workbench.scan.picture_size import check_whole, picture_size

Pixels = np.ndarray[Any, np.dtype[Any]]

LARGEST_PIXEL_COUNT = 2**26
"""Bound on what a picture may unpack to; a frame of today's largest cameras has 2**23 pixels."""

_TIFF_COMPRESSION, _TIFF_ROWS_PER_STRIP, _TIFF_PREDICTOR = 259, 278, 317  # tags of TIFF 6.0
_TIFF_DEFLATE, _TIFF_NO_PREDICTOR, _TIFF_HORIZONTAL = 8, 1, 2  # values of the first and the last of them


def _opencv() -> Any:
    try:
        import cv2
    except ImportError as error:
        raise MissingDependencyError("opencv-python-headless", "a depth map or a picture") from error
    return cv2


def pixels_of(file: ScanFile) -> Pixels:
    """Return the pixels of a picture as they are stored, (h, w) or (h, w, channels).

    Raises
    ------
    ScanError
        Where it cannot be decoded: no picture, too large, damaged, or cut off.
    """
    cv2 = _opencv()
    return _decoded(file, cv2.IMREAD_UNCHANGED)


def grey_of(file: ScanFile) -> npt.NDArray[np.uint8]:
    """Return a picture as (h, w) uint8 grey values, in the orientation of the sensor.

    Raises
    ------
    ScanError
        Where it cannot be decoded: no picture, too large, damaged, or cut off.
    """
    cv2 = _opencv()
    return _decoded(file, cv2.IMREAD_GRAYSCALE | cv2.IMREAD_IGNORE_ORIENTATION)


def _decoded(file: ScanFile, flags: int) -> Pixels:
    cv2 = _opencv()
    width, height = picture_size(file)
    if width * height > LARGEST_PIXEL_COUNT:
        raise file.wrong(f"announces {width} x {height} pixels, more than any camera has; export it again")
    check_whole(file)
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
