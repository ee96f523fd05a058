"""As-built geometry of a column foot and of a group of connecting rebars, in the column frame.

Lengths in mm, angles in radians. A lean ``(lx, ly)`` tilts the axis to the direction (lx, ly, 1).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from aadm_workbench.model import Array


@dataclass(frozen=True)
class SleeveAsBuilt:
    """One grouting sleeve: a leaning bore with chamfer and inner ribs, open at the foot face (z = 0).

    ``plugged_at`` is the depth of a plug behind the face (0: flush with it); None for an open sleeve.
    ``taped`` is the part of the mouth covered by tape, 0..1. ``chip`` is the reach of a spalled rim.
    """

    x: float
    y: float
    diameter: float
    depth: float = 310.0
    lean: tuple[float, float] = (0.0, 0.0)
    chamfer: float = 0.0
    rib_height: float = 0.0
    rib_start: float = 25.0
    rib_pitch: float = 22.0
    plugged_at: float | None = None
    taped: float = 0.0
    chip: float = 0.0
    chip_direction: float = 0.0


@dataclass(frozen=True)
class BarAsBuilt:
    """One connecting rebar: a ribbed cylinder whose top ends at ``top`` with a cut of some slant.

    (x, y, top) is where the axis of the core meets the top: the bar's centre.
    """

    x: float
    y: float
    top: float
    core_diameter: float
    lean: tuple[float, float] = (0.0, 0.0)
    rib_height: float = 0.9
    rib_pitch: float = 10.0
    rib_phase: float = 0.0
    rib_turn: float = 0.0
    longitudinal_rib: float = 0.0
    slant: tuple[float, float] = (0.0, 0.0)
    burr: float = 0.0
    missing_top: float = 0.0


@dataclass(frozen=True)
class Foot:
    """The foot of a column: a block above z = 0 whose face, seen from below, holds the sleeves."""

    size: tuple[float, float]
    sleeves: tuple[SleeveAsBuilt, ...]
    height: float = 400.0


@dataclass(frozen=True)
class BarGroup:
    """Connecting rebars that stick out of a floor at ``floor``; its normal leans by ``floor_lean``."""

    bars: tuple[BarAsBuilt, ...]
    floor: float
    floor_size: tuple[float, float] = (2600.0, 2000.0)
    floor_lean: tuple[float, float] = (0.0, 0.0)
    debris: tuple[tuple[float, float, float], ...] = field(default=())


def axis_of(lean: tuple[float, float]) -> Array:
    """Unit direction (3,) of an axis that leans by (lx, ly)."""
    direction = np.array([lean[0], lean[1], 1.0])
    return np.asarray(direction / np.linalg.norm(direction))


def ring(half_width: float, half_depth: float, per_side: int) -> Array:
    """Centres (n, 2) of a rectangular ring of points, ``per_side`` on each side, corners shared."""
    along_x = np.linspace(-half_width, half_width, per_side)
    along_y = np.linspace(-half_depth, half_depth, per_side)[1:-1]
    rows = [(x, y) for y in (-half_depth, half_depth) for x in along_x]
    rows += [(x, y) for x in (-half_width, half_width) for y in along_y]
    return np.array(rows)
