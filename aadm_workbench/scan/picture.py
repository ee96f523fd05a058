"""Pictures, decoded and encoded by OpenCV, those that it may unpack."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

import numpy as np
import numpy.typing as npt

from aadm_workbench.errors import needed
from aadm_workbench.model import Reason
from aadm_workbench.scan.depth_picture import DepthPicture
from aadm_workbench.scan.file import ScanFile
from aadm_workbench.scan.formats.packed_tiff import is_beyond_opencv, unpacked
from aadm_workbench.scan.formats.tiff_pages import SIGNATURES as TIFF_SIGNATURES
from aadm_workbench.scan.formats.tiff_pages import Page, alone, pages_of
from aadm_workbench.scan.picture_size import check_whole, picture_size

Pixels = np.ndarray[Any, np.dtype[Any]]

LARGEST_PIXEL_COUNT = 2**26
"""Bound on what a picture may unpack to; a frame of today's largest cameras has 2**23 pixels."""

_STANDARD_ERROR = 2  # its descriptor
_TIFF_COMPRESSION, _TIFF_ROWS_PER_STRIP, _TIFF_PREDICTOR = 259, 278, 317  # tags of TIFF 6.0
_TIFF_UNPACKED, _TIFF_DEFLATE, _TIFF_NO_PREDICTOR, _TIFF_HORIZONTAL = (
    1,
    8,
    1,
    2,
)  # values of the first and the last of them


def _opencv() -> Any:
    with needed("opencv-python-headless", "a depth map or a picture"):
        import cv2
    return cv2


def pixels_of(file: ScanFile, picture: DepthPicture) -> Pixels:
    """Return the pixels of a picture as they are stored, (h, w) or (h, w, channels).

    Raises
    ------
    ScanError
        Where it cannot be decoded: no picture, too large, damaged, or cut off.
    MissingDependencyError
        Where it is packed in a way that needs a package which is not installed.
    """
    _check_size(file, picture.width, picture.height)
    if is_beyond_opencv(picture):
        return unpacked(file, picture)
    return _decoded(file, picture.page, _opencv().IMREAD_UNCHANGED)


def grey_of(file: ScanFile) -> npt.NDArray[np.uint8]:
    """Return a picture as (h, w) uint8 grey values, in the orientation of the sensor.

    Raises
    ------
    ScanError
        Where it cannot be decoded: no picture, too large, damaged, or cut off.
    """
    cv2 = _opencv()
    _check_size(file, *picture_size(file))
    page = pages_of(file.content)[0] if file.content.startswith(TIFF_SIGNATURES) else None
    return _decoded(file, page, cv2.IMREAD_GRAYSCALE | cv2.IMREAD_IGNORE_ORIENTATION)


def _check_size(file: ScanFile, width: int, height: int) -> None:
    if width * height > LARGEST_PIXEL_COUNT:
        raise file.wrong(Reason("scan.picture_large", width=width, height=height))


def _decoded(file: ScanFile, page: Page | None, flags: int) -> Pixels:
    cv2 = _opencv()
    check_whole(file)
    content = file.content if page is None else alone(file.content, page)
    try:
        with _quiet():
            pixels: Pixels | None = cv2.imdecode(np.frombuffer(content, np.uint8), flags)
    except cv2.error:
        pixels = None
    if pixels is None:
        raise file.wrong(Reason("scan.no_picture"))
    return pixels


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep what OpenCV, libtiff and libpng print by themselves off the screen: the error that follows says it."""
    kept = None
    with suppress(OSError):
        kept = os.dup(_STANDARD_ERROR)
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, _STANDARD_ERROR)
        os.close(nowhere)
    try:
        yield
    finally:
        if kept is not None:
            os.dup2(kept, _STANDARD_ERROR)
            os.close(kept)


def encode_tiff(pixels: npt.NDArray[np.uint16]) -> bytes:
    """Return the smallest lossless TIFF of an (h, w) uint16 array that common readers understand.

    Deflate in one strip, with the predictor (none or horizontal) that packs a band across the middle better: slanted
    surfaces gain from differences, noise grows by them.
    """
    middle = pixels[len(pixels) // 2 :][:64]
    predictor = min((_TIFF_NO_PREDICTOR, _TIFF_HORIZONTAL), key=lambda choice: len(_encoded(middle, choice)))
    return _encoded(pixels, predictor)


def encode_float_tiff(pixels: npt.NDArray[np.float32]) -> bytes:
    """Return an (h, w) float32 array as a TIFF that is not packed: a camera does not wait, and depths pack badly."""
    _, encoded = _opencv().imencode(".tiff", pixels, [_TIFF_COMPRESSION, _TIFF_UNPACKED])
    content: bytes = encoded.tobytes()
    return content


def encode_png(pixels: npt.NDArray[np.uint8]) -> bytes:
    """Return an (h, w) uint8 picture as PNG."""
    _, encoded = _opencv().imencode(".png", pixels)
    content: bytes = encoded.tobytes()
    return content


def _encoded(pixels: npt.NDArray[np.uint16], predictor: int) -> bytes:
    options = [_TIFF_COMPRESSION, _TIFF_DEFLATE, _TIFF_PREDICTOR, predictor, _TIFF_ROWS_PER_STRIP, len(pixels)]
    _, encoded = _opencv().imencode(".tiff", pixels, options)
    content: bytes = encoded.tobytes()
    return content
