"""Triangle meshes of the as-built parts, with a surface number for every triangle.

Boolean work is Manifold's (through ``manifold3d``); bars are height fields over (angle, length).

Meshes of what stands about in a scene and is neither a foot nor a bar: boxes, boards, hoses.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from aadm_workbench.model import Array
from aadm_workbench.twin.blocks import block_of, broken_off
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Box, Foot, Grout, Hose, PlateAsBuilt, SleeveAsBuilt, axis_of
from aadm_workbench.twin.surface import (
    BAR,
    CONCRETE,
    DARK,
    FLOOR,
    OBJECT,
    SLEEVE_WALL,
    TAPE,
    Surface,
    joined,
    moved,
    one_kind,
)

_RIB_INCLINATION = np.radians(60.0)  # of transverse ribs against the bar's axis; 45 to 70 degrees are usual
_SHIFT_DEPTHS_MM = (1.5, 2.0)  # behind the face: over so much depth a wall goes aside that is shifted; its mouth stays
_RING_WIDTH_MM, _RING_ROOT_MM = 4.0, 20.0  # a tube with a wall of 4 mm, cast in by 20 mm
_PIN_ROOT_MM = -5.0  # height to which a pin goes into its plate: below the face it ends unseen
_CAP_LENGTH_MM = 25.0  # of the caps that protect threads
SEGMENTS = 256  # of a bore's outline: the chord stays within 0.003 mm of a 36 mm circle

_CORNERS = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])  # (8, 3), of a unit box
# their numbers, counter-clockwise from outside
_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
_AROUND = 32  # corners of a hose's section
_STEP_MM = 4.0  # of a hose's path: a choice by eye


def surface_of(part: Foot | BarGroup | PlateAsBuilt) -> Surface:
    """Mesh of a foot, of a group of bars or of a plate."""
    if isinstance(part, PlateAsBuilt):
        pins = [_bar(pin, number, _PIN_ROOT_MM) for number, pin in enumerate(part.pins)]
        return joined([moved(foot_surface(part.foot), np.diag([1.0, -1.0, -1.0, 1.0])), *pins])
    return foot_surface(part) if isinstance(part, Foot) else bars_surface(part)


@lru_cache(maxsize=2)  # frame after frame shows one foot; a mesh of a rough face takes 100 MB
def foot_surface(foot: Foot) -> Surface:
    """Mesh of the foot with its bores, plugs, chips, tapes and grout, and of what is beside it; to be read alone."""
    import manifold3d

    block = block_of(foot).as_original()
    rings = [_ring(sleeve) for sleeve in foot.sleeves if sleeve.proud > 0]
    if rings:
        block = manifold3d.Manifold.batch_boolean([block, *rings], manifold3d.OpType.Add)
    bores = [_bore(sleeve, foot.level_at(sleeve.x, sleeve.y)).as_original() for sleeve in foot.sleeves]
    cutters = [*bores, *broken_off(foot)]
    cutters += [_chip(sleeve) for sleeve in foot.sleeves if sleeve.chip > 0]
    solid = manifold3d.Manifold.batch_boolean([block, *cutters], manifold3d.OpType.Subtract)
    if foot.grout:
        splashes = [_splash(grout) for grout in foot.grout]
        solid = manifold3d.Manifold.batch_boolean([solid, *splashes], manifold3d.OpType.Add)
    owner_of = {bore.original_id(): number for number, bore in enumerate(bores)}
    surfaces = [_labelled(solid, owner_of, [sleeve.chamfer for sleeve in foot.sleeves])]
    surfaces += [_tape(sleeve, number) for number, sleeve in enumerate(foot.sleeves) if sleeve.taped > 0]
    surfaces += [object_surface(thing) for thing in foot.beside]
    return joined(surfaces)


def _ring(sleeve: SleeveAsBuilt) -> Any:
    """The end of the sleeve's own body, out of the face."""
    import manifold3d

    height = sleeve.proud + _RING_ROOT_MM
    ring = manifold3d.Manifold.cylinder(height, sleeve.diameter / 2 + _RING_WIDTH_MM, circular_segments=SEGMENTS)
    return ring.translate([sleeve.x, sleeve.y, -sleeve.proud])


def bars_surface(group: BarGroup) -> Surface:
    """Mesh of a bar group, the floor it stands in and what stands beside it."""
    surfaces = [_bar(bar, number, group.floor - 5.0) for number, bar in enumerate(group.bars)]
    surfaces.append(_floor(group))
    surfaces += [object_surface(_cube(x, y, group.floor, edge)) for x, y, edge in group.debris]
    surfaces += [object_surface(thing) for thing in group.beside]
    return joined(surfaces)


def _bore_profile(sleeve: SleeveAsBuilt) -> list[tuple[float, float]]:
    radius, chamfer = sleeve.diameter / 2, sleeve.chamfer
    depth = sleeve.depth if sleeve.plugged_at is None else max(sleeve.plugged_at, 0.05)
    profile = [(0.0, -15.0), (radius + chamfer, -15.0)]
    profile += [(radius + chamfer, -sleeve.proud), (radius, chamfer - sleeve.proud)] if chamfer > 0 else []
    profile += [(radius, depth_mm) for depth_mm in _SHIFT_DEPTHS_MM if sleeve.wall_shift != (0.0, 0.0)]
    if sleeve.rib_height > 0:
        for start in np.arange(sleeve.rib_start, depth - 10.0, sleeve.rib_pitch):
            profile += [
                (radius, start),
                (radius - sleeve.rib_height, start + 1.5),
                (radius - sleeve.rib_height, start + 4.5),
                (radius, start + 6.0),
            ]
    return [*profile, (radius, depth), (0.0, depth)]


def _bore(sleeve: SleeveAsBuilt, level: float) -> Any:
    import manifold3d

    section = manifold3d.CrossSection([_bore_profile(sleeve)])
    upright = manifold3d.Manifold.revolve(section, SEGMENTS)
    if sleeve.wall_shift != (0.0, 0.0):
        upright = upright.warp_batch(lambda vertices: _shifted(vertices, sleeve.wall_shift))
    return upright.transform(_leaning(sleeve.lean, (sleeve.x, sleeve.y, level)))


def _shifted(vertices: Array, shift: tuple[float, float]) -> Array:
    """Vertices (n, 3) of an upright bore, those behind its mouth moved sideways."""
    share = np.interp(vertices[:, 2], _SHIFT_DEPTHS_MM, (0.0, 1.0))
    return np.asarray(vertices + share[:, None] * [*shift, 0.0])


def _leaning(lean: tuple[float, float], origin: tuple[float, float, float]) -> Array:
    z = axis_of(lean)
    x = np.cross([0.0, 1.0, 0.0], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z, origin])


def _chip(sleeve: SleeveAsBuilt) -> Any:
    import manifold3d

    reach = sleeve.diameter / 2 + 0.4 * sleeve.chip
    x = sleeve.x + reach * np.cos(sleeve.chip_direction)
    y = sleeve.y + reach * np.sin(sleeve.chip_direction)
    piece = manifold3d.Manifold.sphere(1.0, 64).scale([sleeve.chip * 0.6, sleeve.chip, 4.0])
    return piece.rotate([0.0, 0.0, float(np.degrees(sleeve.chip_direction))]).translate([x, y, 0.0])


def _splash(grout: Grout) -> Any:
    import manifold3d

    dome = manifold3d.Manifold.sphere(1.0, 96).scale([grout.radius, grout.radius, grout.thickness])
    return dome.translate([grout.x, grout.y, 0.0])


def _labelled(solid: Any, owner_of: dict[int, int], chamfers: list[float]) -> Surface:
    """Name every triangle: the bores are metal, the chamfers at their mouths are concrete as the face is."""
    mesh = solid.to_mesh64()
    vertices = np.asarray(mesh.vert_properties, np.float64)[:, :3]
    triangles = np.asarray(mesh.tri_verts, np.int64)
    kind = np.full(len(triangles), CONCRETE, np.int64)
    owner = np.full(len(triangles), -1, np.int64)
    bounds = np.asarray(mesh.run_index, np.int64) // 3
    depth = vertices[triangles, 2].mean(axis=1)
    for original, begin, end in zip(mesh.run_original_id, bounds[:-1], bounds[1:], strict=True):
        if int(original) in owner_of:
            owner[begin:end] = owner_of[int(original)]
            chamfer = chamfers[owner_of[int(original)]]
            kind[begin:end] = np.where(depth[begin:end] > chamfer, SLEEVE_WALL, CONCRETE)
    return Surface(vertices, triangles, kind, owner)


def _tape(sleeve: SleeveAsBuilt, number: int) -> Surface:
    """A strip 0.15 mm below the face that covers the side of the mouth towards ``chip_direction``."""
    radius = sleeve.diameter / 2 + 4.0
    begin = radius - 2 * radius * sleeve.taped
    along, across = np.array([np.cos(sleeve.chip_direction), np.sin(sleeve.chip_direction)]), None
    across = np.array([-along[1], along[0]])
    corners = [along * a + across * b for a in (begin, radius) for b in (-radius, radius)]
    vertices = np.array([[sleeve.x + corner[0], sleeve.y + corner[1], -0.15] for corner in corners])
    triangles = np.array([[0, 1, 2], [1, 3, 2]])
    return one_kind(vertices, triangles, TAPE, number)


def _rib_profile(bar: BarAsBuilt, angle: Array, below_top: Array) -> Array:
    """Height (rows, angles) of the ribs over the core: inclined crescents on two sides, two ridges along."""
    height = np.zeros((len(below_top), len(angle)))
    for side in (0, 1):
        turned = np.mod(angle - bar.rib_turn - side * np.pi, 2 * np.pi)
        crescent = np.where(turned < np.pi, np.sin(turned), 0.0) ** 0.7
        climb = (1 - 2 * side) * bar.core_diameter / 2 * (turned - np.pi / 2) / np.tan(_RIB_INCLINATION)
        place = np.mod((below_top[:, None] + climb[None, :]) / bar.rib_pitch + bar.rib_phase + 0.5 * side, 1.0) - 0.5
        bump = np.clip((1.5 - np.abs(place) * bar.rib_pitch) / 0.9, 0.0, 1.0)  # crest 1.2 mm, flanks of 45 degrees
        height = np.maximum(height, bar.rib_height * bump * crescent[None, :])
    ridge = np.abs(np.mod(angle - bar.rib_turn + np.pi / 2, np.pi) - np.pi / 2) * bar.core_diameter / 2
    return np.maximum(height, bar.longitudinal_rib * np.clip(2.0 - ridge / 0.7, 0.0, 1.0)[None, :])


def _bar(bar: BarAsBuilt, number: int, foot_z: float) -> Surface:
    angles = np.linspace(0.0, 2 * np.pi, 96, endpoint=False)
    length = bar.top - foot_z
    below_top = np.arange(0.0, length + 0.8, 0.8)
    radius = bar.core_diameter / 2 + _rib_profile(bar, angles, below_top)
    radius[:2] += _burr(bar, angles)
    if bar.cap > 0:
        radius[below_top < _CAP_LENGTH_MM] = bar.core_diameter / 2 + bar.rib_height + bar.cap
    x, y = radius * np.cos(angles), radius * np.sin(angles)
    cut = bar.slant[0] * x[0] + bar.slant[1] * y[0] - bar.missing_top * (x[0] > 0.2 * bar.core_diameter)
    fade = np.clip(1.0 - below_top / (0.6 * length), 0.0, 1.0)
    z = -below_top[:, None] + fade[:, None] * cut[None, :]
    bent = _bent(bar, below_top, length)[:, None]
    x, y = x + bent * bar.bend[0], y + bent * bar.bend[1]
    rows, columns = radius.shape
    local = np.stack([x, y, z], -1).reshape(-1, 3)
    T = _leaning(bar.lean, (bar.x, bar.y, bar.top))
    vertices = np.vstack([local, [[0.0, 0.0, 0.0]]]) @ T[:, :3].T + T[:, 3]
    grid = np.arange(rows * columns).reshape(rows, columns)
    beside = np.roll(grid, -1, axis=1)
    a, b, c, d = grid[:-1].ravel(), beside[:-1].ravel(), grid[1:].ravel(), beside[1:].ravel()
    cap = np.column_stack([grid[0], beside[0], np.full(columns, rows * columns)])
    triangles = np.vstack([np.column_stack([a, c, b]), np.column_stack([b, c, d]), cap])
    surface = one_kind(vertices, triangles, BAR, number)
    away = np.abs(np.mod(angles - bar.rust_direction + np.pi, 2 * np.pi) - np.pi)
    surface.kind[-columns:][away < np.pi * bar.rust] = DARK
    return surface


def _bent(bar: BarAsBuilt, below_top: Array, length: float) -> Array:
    """Share (rows,) of the bend by which each height is off the top, 0 to -1."""
    if bar.kinked_at is None:
        return np.asarray((1.0 - below_top / length) ** 2 - 1.0)
    return np.asarray(-np.minimum(below_top / bar.kinked_at, 1.0))


def _burr(bar: BarAsBuilt, angles: Array) -> Array:
    """How far the burr stands out (angles,)."""
    if bar.burr_direction is None:
        return np.full(len(angles), bar.burr)
    return np.asarray(bar.burr * np.clip(np.cos(angles - bar.burr_direction), 0.0, 1.0))


def _floor(group: BarGroup) -> Surface:
    half_x, half_y = group.floor_size[0] / 2, group.floor_size[1] / 2
    corners = np.array([[x, y] for x in (-half_x, half_x) for y in (-half_y, half_y)])
    heights = group.floor - corners @ np.asarray(group.floor_lean)
    vertices = np.column_stack([corners, heights])
    return one_kind(vertices, np.array([[0, 2, 1], [1, 2, 3]]), FLOOR)


def _cube(x: float, y: float, floor: float, edge: float) -> Box:
    return Box((x - edge / 2, y - edge / 2, floor), (x + edge / 2, y + edge / 2, floor + edge))


def object_surface(thing: Box | Hose) -> Surface:
    """Mesh of one object, in the column frame."""
    return _box(thing) if isinstance(thing, Box) else _hose(thing)


def _box(box: Box) -> Surface:
    low, high = np.asarray(box.low), np.asarray(box.high)
    quads = np.array(_SIDES)
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return one_kind(low + _CORNERS * (high - low), triangles, OBJECT)


def _hose(hose: Hose) -> Surface:
    """A tube of constant height, swept along a line through the given plan positions."""
    line = _resampled(np.asarray(hose.path))
    along = np.gradient(line, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    beside = np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(line))])
    turn = np.linspace(0.0, 2 * np.pi, _AROUND, endpoint=False)
    ring = np.cos(turn)[None, :, None] * beside[:, None] + np.sin(turn)[None, :, None] * np.array([0.0, 0.0, 1.0])
    middle = np.column_stack([line, np.full(len(line), hose.height)])
    vertices = (middle[:, None] + hose.diameter / 2 * ring).reshape(-1, 3)
    grid = np.arange(len(vertices)).reshape(len(line), _AROUND)
    beyond = np.roll(grid, -1, axis=1)
    a, b, c, d = grid[:-1].ravel(), beyond[:-1].ravel(), grid[1:].ravel(), beyond[1:].ravel()
    return one_kind(vertices, np.vstack([np.column_stack([a, c, b]), np.column_stack([b, c, d])]), OBJECT)


def _resampled(path: Array) -> Array:
    """Points (n, 2) every few mm on a smooth line through the corners of a path (k, 2)."""
    from scipy.interpolate import CubicSpline

    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    line: Array = CubicSpline(length, path)(np.arange(0.0, length[-1], _STEP_MM))
    return line
