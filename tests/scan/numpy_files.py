"""Scans as NumPy itself writes them."""

from pathlib import Path

import numpy as np

from aadm_workbench.model import FloatArray


def write_xyz(path: Path, points: FloatArray) -> None:
    """Rows of x, y and z, of finite points alone."""
    flat = points.reshape(-1, 3)
    np.savetxt(path, flat[np.isfinite(flat).all(axis=1)], fmt="%.17g")


def write_npz(path: Path, points: FloatArray) -> None:
    """The array ``points`` of a compressed archive."""
    with path.open("wb") as stream:
        np.savez_compressed(stream, points=points)
