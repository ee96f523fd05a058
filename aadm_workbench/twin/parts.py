"""As-built geometry of a column foot and of a group of connecting rebars, in the column frame.

Lengths in mm, angles in radians. A lean ``(lx, ly)`` tilts the axis to the direction (lx, ly, 1).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from aadm_workbench.model import Array


@dataclass(frozen=True)
class SleeveAsBuilt:
    """One grouting sleeve: a leaning bore with chamfer and inner ribs, open at the foot face (z = 0).

    ``plugged_at`` is the depth of a plug behind the face (0: flush with it); None for an open sleeve.
    ``taped`` is the part of the mouth covered by tape, 0..1. ``chip`` is the reach of a spalled rim. ``proud`` is how
    far the sleeve's own ring, 4 mm wide, stands out of the face.
    ``wall_shift`` is how far light that bounces inside makes the wall appear beside its place, from 2 mm behind
    the face on.
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
    wall_shift: tuple[float, float] = (0.0, 0.0)
    proud: float = 0.0


@dataclass(frozen=True)
class BarAsBuilt:
    """One connecting rebar: a ribbed cylinder whose top ends at ``top`` with a cut of some slant.

    (x, y, top) is where the axis of the core meets the top: the bar's centre. ``bend`` is how far its top is bent
    off the line on which the bar leaves the floor: in a curve from there on, or at a kink ``kinked_at`` below the top.
    ``cap`` is the thickness of a plastic cap that covers the top and 25 mm of the bar below it. ``burr`` is what
    shearing pushed out at the top: all around, or most towards ``burr_direction``. ``rust`` is the share of the
    top that returns no light, a sector about
    ``rust_direction``; ``missing_top`` the depth of a piece broken off its +x side.
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
    burr_direction: float | None = None
    missing_top: float = 0.0
    bend: tuple[float, float] = (0.0, 0.0)
    rust: float = 0.0
    rust_direction: float = 0.0
    kinked_at: float | None = None
    cap: float = 0.0


@dataclass(frozen=True)
class Roughness:
    """A foot's face roughened by order (6 mm and more): it lies between z = 0 and ``depth`` inside the foot.

    ``washed``: the mortar is washed off, grains of about ``grain`` mm stand out; else ``keyed``, pockets that are so
    wide and so far apart. The same ``seed`` gives the same face. Either reaches up to the mouths.
    """

    depth: float = 6.0
    grain: float = 10.0
    law: Literal["washed", "keyed"] = "washed"
    seed: int = 0


@dataclass(frozen=True)
class Grout:
    """A splash of grout on a foot face about (x, y): a flat dome, ``thickness`` high in its middle."""

    x: float
    y: float
    radius: float
    thickness: float


@dataclass(frozen=True)
class Box:
    """A box or a board between two corners, sides along the axes of the column frame."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]


@dataclass(frozen=True)
class Hose:
    """A hose whose middle lies at ``height``, on a smooth line through plan positions."""

    path: tuple[tuple[float, float], ...]
    height: float
    diameter: float = 25.0


@dataclass(frozen=True)
class Break:
    """A piece broken off the edge ``side`` (``-x`` …, or two for a corner, ``+x+y``) of a foot's face.

    ``at`` is its middle along the edge from the edge's own middle, towards +x or +y; ``depth`` how far it reaches into
    the face, and up the side. A corner's is a ball of that radius about the corner.
    """

    side: str
    at: float
    length: float
    depth: float


@dataclass(frozen=True)
class Cast:
    """How a foot's block differs from an upright one about the column's axis; its sides are those of the foot.

    ``offset``: where the middle of the section lies; ``turn``: the section's, counter-clockwise from above; ``shear``:
    by how much the angle between its sides is less than a right one. ``bow`` is how far the middle of the face lies
    inside of its corners, ``warp`` how far the corners +x+y and -x-y lie inside of the other two.
    """

    offset: tuple[float, float] = (0.0, 0.0)
    turn: float = 0.0
    shear: float = 0.0
    bow: float = 0.0
    warp: float = 0.0
    breaks: tuple[Break, ...] = ()

    def plan(self) -> Array:
        """The map (2, 3) from places of an upright section about its middle to the column frame."""
        c, s = np.cos(self.turn), np.sin(self.turn)
        sheared = np.array([[1.0, np.tan(self.shear)], [0.0, 1.0]])
        return np.column_stack([np.array([[c, -s], [s, c]]) @ sheared, self.offset])

    def level(self, size: tuple[float, float], x: Array, y: Array) -> Array:
        """How far inside the foot the face lies at places of the upright section about its middle, mm."""
        u, v = 2.0 * x / size[0], 2.0 * y / size[1]
        return np.asarray(self.bow * (1.0 - (u**2 + v**2) / 2.0) + self.warp / 2.0 * u * v)


UPRIGHT = Cast()


@dataclass(frozen=True)
class Foot:
    """The foot of a column: a block above z = 0 whose face, seen from below, holds the sleeves.

    ``grout`` sticks to its face; ``beside`` stands between it and the camera, or around it.
    """

    size: tuple[float, float]
    sleeves: tuple[SleeveAsBuilt, ...]
    height: float = 400.0
    grout: tuple[Grout, ...] = ()
    beside: tuple[Box | Hose, ...] = ()
    roughness: Roughness | None = None
    cast: Cast = UPRIGHT

    def level_at(self, x: float, y: float) -> float:
        """How far inside the foot its face lies at a place of the column frame, mm; a rough one's mean is left out."""
        plan = self.cast.plan()
        about = np.linalg.solve(plan[:, :2], np.array([x, y]) - plan[:, 2])
        return float(self.cast.level(self.size, about[0], about[1]))

    def corners(self) -> Array:
        """Corners (4, 2) mm of its section, column frame, from (-x, -y) counter-clockwise seen from above."""
        plan = self.cast.plan()
        half = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * np.array(self.size) / 2.0
        return np.asarray(half @ plan[:, :2].T + plan[:, 2])


@dataclass(frozen=True)
class BarGroup:
    """Connecting rebars that stick out of a floor at ``floor``; its normal leans by ``floor_lean``.

    ``debris`` are cubes (x, y, edge) on the floor; ``beside`` is what else stands about.
    """

    bars: tuple[BarAsBuilt, ...]
    floor: float
    floor_size: tuple[float, float] = (2600.0, 2000.0)
    floor_lean: tuple[float, float] = (0.0, 0.0)
    debris: tuple[tuple[float, float, float], ...] = ()
    beside: tuple[Box | Hose, ...] = ()


@dataclass(frozen=True)
class PlateAsBuilt:
    """A plate with holes and pins, in the plate's frame: z out of its face, towards the camera.

    ``foot`` holds the bores, in a frame of its own, which is the plate's turned by 180 degrees about x.
    """

    foot: Foot
    pins: tuple[BarAsBuilt, ...]


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
