"""Scans to files: depth maps, PLY, PCD, XYZ and NumPy archives, each whole or not there."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import FloatArray, Reason
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.formats.pcd import STORAGES, compress
from aadm_workbench.scan.picture import encode_tiff

_LARGEST_STEP = 65_535  # of 16 bits


def write_depth_tiff(path: Path, depth_mm: FloatArray, depth_scale_mm: float) -> None:
    """Write a depth map as a compressed uint16 TIFF in steps of ``depth_scale_mm``; 0 is no return.

    Parameters
    ----------
    depth_mm
        (h, w) floating, mm; NaN, 0, negative and not finite is no return.
    depth_scale_mm
        Depth of one step; depths are rounded to the nearest.

    Raises
    ------
    ScanError
        Where a depth takes more than 65,535 steps.
    """
    has_return = (depth_mm > 0) & (depth_mm < np.inf)
    steps = np.rint(np.where(has_return, depth_mm, 0.0) / depth_scale_mm)
    deepest = float(steps.max(initial=0.0))
    if deepest > _LARGEST_STEP:
        # Rounded up: what the message proposes must do.
        least_mm = math.ceil(deepest * depth_scale_mm / _LARGEST_STEP * 1e4) / 1e4
        raise ScanError(
            Reason(
                "scan.write_depth",
                path=path,
                deepest_mm=deepest * depth_scale_mm,
                depth_scale_mm=depth_scale_mm,
                least_mm=least_mm,
            )
        )
    write_atomically(path, encode_tiff(steps.astype(np.uint16)))


def write_ply(path: Path, points: FloatArray, binary: bool = True) -> None:
    """Write points as vertices of a PLY file, in their own precision.

    Parameters
    ----------
    points
        (n, 3) or (h, w, 3) floating; all of them are written, row by row, also those that are NaN.
    binary
        Little endian; else text that reads back to the same numbers.
    """
    flat = _coordinates(points).reshape(-1, 3)
    kind = "float" if flat.dtype.itemsize == 4 else "double"
    encoding = "binary_little_endian" if binary else "ascii"
    properties = "".join(f"property {kind} {axis}\n" for axis in "xyz")
    header = f"ply\nformat {encoding} 1.0\nelement vertex {len(flat)}\n{properties}end_header\n"
    write_atomically(path, header.encode() + (flat.tobytes() if binary else _rows(flat)))


def write_pcd(path: Path, points: FloatArray, mode: str = "binary_compressed") -> None:
    """Write points as a PCD file of version 0.7, in their own precision, the viewpoint at the origin.

    Parameters
    ----------
    points
        (n, 3) or, written as a grid, (h, w, 3) floating.
    mode
        "ascii", "binary" or "binary_compressed".

    Raises
    ------
    MissingDependencyError
        For "binary_compressed" without the LZF library.
    """
    if mode not in STORAGES:
        raise ValueError(Reason("scan.write_mode", mode=repr(mode), known=STORAGES))
    coordinates = _coordinates(points)
    flat = coordinates.reshape(-1, 3)
    height, width = coordinates.shape[:2] if coordinates.ndim == 3 else (1, len(flat))
    size = flat.dtype.itemsize
    header = (
        f"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE {size} {size} {size}\n"
        f"TYPE F F F\nCOUNT 1 1 1\nWIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\n"
        f"POINTS {len(flat)}\nDATA {mode}\n"
    )
    write_atomically(path, header.encode() + _pcd_body(flat, mode))


def _pcd_body(flat: FloatArray, mode: str) -> bytes:
    if mode == "ascii":
        return _rows(flat)
    if mode == "binary":
        return flat.tobytes()
    planes = np.ascontiguousarray(flat.T).tobytes()
    packed = compress(planes)
    return np.array([len(packed), len(planes)], "<u4").tobytes() + packed


def _coordinates(points: FloatArray) -> np.ndarray[Any, np.dtype[Any]]:
    """Return points as little-endian float32 or, whatever else they are, float64."""
    if points.ndim not in (2, 3) or points.shape[-1] != 3:
        raise ValueError(Reason("scan.write_shape", shape=points.shape))
    return np.ascontiguousarray(points, "<f4" if points.dtype == np.float32 else "<f8")


def _rows(flat: FloatArray) -> bytes:
    # Nine digits tell any two float32 apart, seventeen any two float64.
    row = " ".join([f"%.{9 if flat.dtype.itemsize == 4 else 17}g"] * 3)
    return "".join(f"{row % tuple(point)}\n" for point in flat.tolist()).encode()
