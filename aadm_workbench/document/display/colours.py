"""Colours that people with any colour vision can tell apart (after Okabe and Ito, 2008), RGB from 0 to 1.

A verdict is never told by colour alone: icons differ in shape, labels and tables say it in words.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from aadm_workbench.model import Array

Rgb = tuple[float, float, float]

VERDICTS: Mapping[str, Rgb] = MappingProxyType(
    {
        "pass": (0.0, 0.62, 0.45),
        "fail": (0.84, 0.37, 0.0),
        "inconclusive": (0.90, 0.62, 0.0),
        "not_measured": (0.45, 0.45, 0.45),
        "error": (0.55, 0.20, 0.50),
        "not_assessed": (0.60, 0.60, 0.60),
    }
)
DESIGN: Rgb = (0.0, 0.45, 0.70)  # blue of the same palette: no verdict
BAR: Rgb = (0.76, 0.49, 0.07)  # as in the icons
GHOST: Rgb = (0.70, 0.70, 0.68)  # concrete, in front of white and of dark alike
FAR: Rgb = (0.62, 0.62, 0.62)
"""Points further from the design than the scale reaches."""

_SCALE = np.array([[0.05, 0.25, 0.60], [0.35, 0.62, 0.85], [0.78, 0.78, 0.70], [0.95, 0.55, 0.35], [0.65, 0.05, 0.12]])
"""Blue (below) over a light grey, seen on white and on dark alike, to red (above)."""


def of_verdict(verdict: str) -> Rgb:
    """The colour of a verdict; grey for one that is not known."""
    return VERDICTS.get(verdict, VERDICTS["not_assessed"])


def text_on(colour: Rgb) -> Rgb:
    """Black or white: whichever stands out more from a colour (WCAG 2.2, relative luminance)."""
    value = np.array(colour)
    linear = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
    luminance = float(linear @ [0.2126, 0.7152, 0.0722])
    return (0.0, 0.0, 0.0) if (luminance + 0.05) / 0.05 >= 1.05 / (luminance + 0.05) else (1.0, 1.0, 1.0)


def of_distances(distances_mm: Array, reach_mm: float) -> Array:
    """Colours (n, 3) of signed distances (n,) mm; grey beyond ``reach_mm``."""
    place = (np.clip(distances_mm / reach_mm, -1.0, 1.0) + 1.0) / 2.0 * (len(_SCALE) - 1)
    steps = np.arange(len(_SCALE))
    colours = np.stack([np.interp(place, steps, _SCALE[:, channel]) for channel in range(3)], axis=1)
    colours[np.abs(distances_mm) > reach_mm] = FAR
    return colours
