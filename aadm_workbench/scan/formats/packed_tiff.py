"""TIFF files that OpenCV does not unpack, or whose channels it exchanges, through tifffile and imagecodecs."""

from __future__ import annotations

import io
import logging
import lzma
import struct
import zlib
from importlib import import_module
from types import MappingProxyType, ModuleType
from typing import Any

import numpy as np

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.model import Reason
from aadm_workbench.scan.depth_picture import DepthPicture
from aadm_workbench.scan.file import ScanFile

_UNCOMPRESSED = 1  # compression of TIFF 6.0
_READ_BY_OPENCV = frozenset({_UNCOMPRESSED, 5, 7, 8, 32773, 32946})
"""None, LZW, JPEG, deflate, PackBits, deflate by its old number."""

_NAMES = MappingProxyType(
    {
        33005: "JPEG 2000",
        34712: "JPEG 2000",
        34887: "LERC",
        34925: "LZMA",
        50000: "ZSTD",
        50001: "WebP",
        50002: "JPEG XL",
    }
)
_HALF_BITS = 16  # of a half float
_ERRORS = (
    AssertionError,
    AttributeError,
    EOFError,
    IndexError,
    KeyError,
    OSError,
    OverflowError,
    RuntimeError,
    TypeError,
    ValueError,
    ZeroDivisionError,
    lzma.LZMAError,
    struct.error,
    zlib.error,
)
"""What the two raise for files that are damaged; those of the codecs are RuntimeErrors."""


def is_beyond_opencv(picture: DepthPicture) -> bool:
    """Whether OpenCV cannot unpack a picture, or not without exchanging its channels."""
    page = picture.page
    if page is None:
        return False
    is_half = page.is_float and page.bits <= _HALF_BITS
    return picture.is_point_map or is_half or page.compression not in _READ_BY_OPENCV


def unpacked(file: ScanFile, picture: DepthPicture) -> np.ndarray[Any, np.dtype[Any]]:
    """Return the pixels of a TIFF's picture, (h, w) or (h, w, 3), as they are stored.

    Raises
    ------
    ScanError
        Where it is damaged.
    MissingDependencyError
        Without the packages; it also says how to do without them.
    """
    tifffile = _package("tifffile", file, picture)
    if picture.page is not None and picture.page.compression != _UNCOMPRESSED:
        _package("imagecodecs", file, picture)
    log = logging.getLogger("tifffile")
    log.propagate = False  # what it warns of is said by the errors here
    try:
        with tifffile.TiffFile(io.BytesIO(file.content)) as pages:
            pixels = np.asarray(_pixels(pages, picture))
    except _ERRORS as error:
        reason = (str(error).splitlines() or [type(error).__name__])[0][:120]
        raise file.wrong(Reason("formats.tiff_unpack", why=reason)) from error
    if picture.is_point_map and pixels.shape == (3, picture.height, picture.width):
        pixels = np.moveaxis(pixels, 0, -1)
    wanted = (picture.height, picture.width, 3)[: 3 if picture.is_point_map else 2]
    if pixels.shape != wanted:
        raise file.wrong(Reason("formats.tiff_shape", shape=pixels.shape, wanted=wanted))
    return pixels.astype(np.float32) if pixels.dtype == np.float16 else pixels.astype(pixels.dtype.newbyteorder("="))


def _pixels(pages: Any, picture: DepthPicture) -> Any:
    if picture.rows_as_pages:
        return np.stack([page.asarray(maxworkers=1) for page in pages.pages])
    number = 1 if picture.page is None else picture.page.number
    return pages.pages[number - 1].asarray(maxworkers=1)


def _package(name: str, file: ScanFile, picture: DepthPicture) -> ModuleType:
    try:
        return import_module(name)
    except ImportError as error:
        raise MissingDependencyError(
            name, Reason("formats.tiff_as_it_is", name=file.name, what=_remedy(picture))
        ) from error


def _remedy(picture: DepthPicture) -> str:
    page = picture.page
    if page is not None and page.compression not in _READ_BY_OPENCV:
        packed = _NAMES.get(page.compression, Reason("formats.tiff_method", number=page.compression))
        return Reason("formats.tiff_packed", packed=packed)
    if picture.is_point_map:
        return Reason("formats.tiff_xyz")
    return Reason("formats.tiff_half")
