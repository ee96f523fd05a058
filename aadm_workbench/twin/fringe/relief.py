"""The fine relief and the stains of cast concrete, as a tile that repeats."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy import ndimage

TEXEL_MM = 0.2  # finer than half a pixel's width on the nearest face
_TEXELS = 1024  # 205 mm: no two sleeves of a face lie on the same part of it
_GRAIN_MM = (0.4, 1.5, 6.0)  # sand, trowel marks and the formwork's waves
_GRAIN_SHARES = (0.5, 0.6, 0.6)  # amplitudes of these lengths: a choice by eye
_STAIN_MM = (0.6, 8.0)  # lengths of stains: sand, and damp patches
_STAIN_SHARES = (0.6, 0.8)  # their amplitudes: a choice by eye


def relief_tile(relief_mm: float, mottling: float, rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """Height in mm and relative albedo (n, n, 2) of a square tile with sides of n times :data:`TEXEL_MM`."""
    height = relief_mm * _noise(_GRAIN_MM, _GRAIN_SHARES, rng)
    albedo = np.clip(1.0 + mottling * _noise(_STAIN_MM, _STAIN_SHARES, rng), 0.3, 1.7)
    return np.stack([height, albedo], -1).astype(np.float32)


def _noise(
    lengths_mm: tuple[float, ...], shares: tuple[float, ...], rng: np.random.Generator
) -> npt.NDArray[np.float64]:
    """Smooth noise (n, n) of some lengths, with mean 0 and variance 1."""
    total = np.zeros((_TEXELS, _TEXELS))
    for length, share in zip(lengths_mm, shares, strict=True):
        white = rng.standard_normal((_TEXELS, _TEXELS), dtype=np.float32)
        layer = ndimage.gaussian_filter(white, length / 2.0 / TEXEL_MM, mode="wrap")
        total += share * layer / layer.std()
    return np.asarray((total - total.mean()) / total.std())
