"""NumPy archives (.npz): an array ``points``, or an array ``depth`` that goes with the job's camera."""

from __future__ import annotations

import io
import math
import struct
import tokenize
import zipfile
import zlib
from typing import IO, Any

import numpy as np

from aadm_workbench.model import Reason
from aadm_workbench.scan.depth import cloud_of_depth_map
from aadm_workbench.scan.file import LARGEST_POINT_COUNT, Cloud, Declared, ScanFile
from aadm_workbench.scan.formats.records import coordinate_dtype

_ERRORS_OF_ARCHIVES = (
    zipfile.BadZipFile,
    zlib.error,
    struct.error,
    EOFError,
    OSError,
    OverflowError,
    RuntimeError,
    ValueError,
)
"""What the standard library raises for archives that are damaged on purpose, too."""


def read_npz(file: ScanFile, declared: Declared) -> Cloud:
    """Read ``points``, (n, 3) or (h, w, 3), else ``depth``, (h, w), from a NumPy archive.

    Sizes are checked before anything is unpacked, and pickled objects are refused.

    Raises
    ------
    ScanError
        For an archive that is damaged, lacks both arrays, or holds arrays of another shape or type.
    CameraError
        For ``depth`` without a camera or of another size.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(file.content)) as archive:
            names = archive.namelist()
            name = next((name for name in ("points", "depth") if f"{name}.npy" in names), None)
            if name is None:
                raise file.wrong(Reason("formats.npz_no_array", names=", ".join(names)[:80]))
            if archive.getinfo(f"{name}.npy").compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
                raise file.wrong(Reason("formats.npz_packed", name=repr(name)))
            with archive.open(f"{name}.npy") as member:
                values = _array(file, name, member)
    except _ERRORS_OF_ARCHIVES as error:
        raise file.wrong(Reason("formats.npz_damaged", why=error)) from error
    if name == "depth":
        return cloud_of_depth_map(file, values, declared)
    return Cloud(values.astype(coordinate_dtype([values.dtype]), order="C"), declared.mm_per_unit)


def _array(file: ScanFile, name: str, member: IO[bytes]) -> np.ndarray[Any, np.dtype[Any]]:
    try:
        version = np.lib.format.read_magic(member)
        read_header = {
            (1, 0): np.lib.format.read_array_header_1_0,
            (2, 0): np.lib.format.read_array_header_2_0,
        }[version]
        shape, in_columns, dtype = read_header(member)
    except (ValueError, KeyError, SyntaxError, tokenize.TokenError) as error:
        raise file.wrong(Reason("formats.npz_header", name=repr(name), why=error)) from error
    is_right_shape = len(shape) == 2 if name == "depth" else len(shape) in (2, 3) and shape[-1] == 3
    if not is_right_shape or dtype.kind not in "fiu" or dtype.itemsize > 8:
        needed = "(h, w)" if name == "depth" else "(n, 3) or (h, w, 3)"
        raise file.wrong(Reason("formats.npz_type", name=repr(name), dtype=dtype, shape=shape, needed=needed))
    if math.prod(shape) > 3 * LARGEST_POINT_COUNT:
        raise file.wrong(Reason("formats.npz_large", name=repr(name), shape=shape))
    size_bytes = math.prod(shape) * dtype.itemsize
    content = member.read(size_bytes)
    if len(content) < size_bytes or size_bytes == 0:
        raise file.wrong(
            Reason("formats.npz_short", name=repr(name), shape=shape, found_bytes=len(content), size_bytes=size_bytes)
        )
    return np.frombuffer(content, dtype).reshape(shape, order="F" if in_columns else "C")
