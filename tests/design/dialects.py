"""The ways in which programs draw a sleeve or a bar: each gives one representation item, baked in at a motion.

A sleeve begins at the origin and runs along z; so does a bar, whose top is at ``length`` along z. ``T`` (4, 4) mm is
where that frame stands in the element's. Motions may also be spread over placements and nested mapped items.
"""

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from aadm_workbench.model import Array
from tests.design.authoring import Author
from tests.design.frames import axes, on, shift

SIDES = 24
FOOT_MM, BEND_MM = 300.0, 60.0
"""Length of a bent bar's foot beyond the bend, and the radius of the bend's axis."""


def hollow_extrusion(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    return model.tube(inner, outer, length, axes(model, T))


def profile_with_voids(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    circles = [model.new("IfcCircle", model._flat(), model.length(d / 2.0)) for d in (outer, inner)]
    profile = model.new("IfcArbitraryProfileDefWithVoids", "AREA", None, circles[0], circles[1:])
    return model.extrusion(profile, length, axes(model, T))


def bored_cylinder(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    body = model.cylinder(outer / 2.0, length, axes(model, T))
    tool = model.cylinder(inner / 2.0, length + 40.0, axes(model, T @ shift(z=-20.0)))
    return model.new("IfcBooleanResult", "DIFFERENCE", body, tool)


def csg_cylinders(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    def cylinder(diameter: float, below: float) -> Any:
        at, height = axes(model, T @ shift(z=-below)), model.length(length + 2.0 * below)
        return model.new("IfcRightCircularCylinder", at, height, model.length(diameter / 2.0))

    cut = model.new("IfcBooleanResult", "DIFFERENCE", cylinder(outer, 0.0), cylinder(inner, 10.0))
    return model.new("IfcCsgSolid", cut)


def turned(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    """A half section about the y axis of its own frame, which the position stands along z; wider in its middle."""
    r, R = inner / 2.0, outer / 2.0
    corners = [(r, 0.0), (R, 0.0), (R, length), (r, length), (r - 2.0, length / 2.0)]
    profile = model.new("IfcArbitraryClosedProfileDef", "AREA", None, model.polygon(corners))
    axis = model.new("IfcAxis1Placement", model.point((0.0, 0.0, 0.0)), model.direction((0.0, 1.0, 0.0)))
    upright = np.eye(4)
    upright[:3, :3] = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return model.new("IfcRevolvedAreaSolid", profile, axes(model, T @ upright), axis, 360.0)


def pipe(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    line = model.new("IfcPolyline", [model.point(p) for p in on(T, [(0, 0, 0), (0, 0, length)])])
    return model.new("IfcSweptDiskSolid", line, model.length(outer / 2.0), model.length(inner / 2.0))


def circle(radius: float, z: float, sides: int = SIDES, phase: float = 0.1) -> Array:
    angle = phase + np.arange(sides) * 2.0 * np.pi / sides
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), np.full(sides, z)])


def _band(first: int, second: int, sides: int) -> list[list[int]]:
    return [
        [first * sides + k, first * sides + (k + 1) % sides, second * sides + (k + 1) % sides, second * sides + k]
        for k in range(sides)
    ]


def triangulated(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    rings = np.vstack([circle(d / 2.0, z) for z in (0.0, length) for d in (inner, outer)])
    quads = [quad for pair in ((1, 0), (0, 2), (2, 3), (3, 1)) for quad in _band(*pair, SIDES)]
    triangles = [[q[k] + 1 for k in three] for q in quads for three in ((0, 1, 2), (0, 2, 3))]
    points = model.new("IfcCartesianPointList3D", (on(T, rings) / model.unit_mm).tolist())
    return model.new("IfcTriangulatedFaceSet", Coordinates=points, Closed=True, CoordIndex=triangles)


def polygonal(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    """Faces with voids at both ends, quadrilaterals around."""
    rings = np.vstack([circle(d / 2.0, z) for z in (0.0, length) for d in (inner, outer)])
    around = [[k + 1 for k in quad] for pair in ((0, 2), (1, 3)) for quad in _band(*pair, SIDES)]
    faces = [model.new("IfcIndexedPolygonalFace", quad) for quad in around]
    loop = [list(range(r * SIDES + 1, (r + 1) * SIDES + 1)) for r in range(4)]
    faces += [model.new("IfcIndexedPolygonalFaceWithVoids", loop[r + 1], [loop[r][::-1]]) for r in (0, 2)]
    points = model.new("IfcCartesianPointList3D", (on(T, rings) / model.unit_mm).tolist())
    return model.new("IfcPolygonalFaceSet", points, True, faces)


def _faces(model: Author, T: Array, inner: float, outer: float, length: float) -> list[Any]:
    rings = {(d, z): [model.point(p) for p in on(T, circle(d / 2.0, z))] for d in (inner, outer) for z in (0.0, length)}
    found = []
    for z in (0.0, length):
        bounds = [(rings[inner, z][::-1], "IfcFaceBound"), (rings[outer, z], "IfcFaceOuterBound")]
        found.append(model.new("IfcFace", [_bound(model, loop, kind) for loop, kind in bounds]))
    for d in (inner, outer):
        low, high = rings[d, 0.0], rings[d, length]
        quads = [[low[k - 1], low[k], high[k], high[k - 1]] for k in range(SIDES)]
        found += [model.new("IfcFace", [_bound(model, quad, "IfcFaceOuterBound")]) for quad in quads]
    return found


def _bound(model: Author, loop: Sequence[Any], kind: str) -> Any:
    return model.new(kind, model.new("IfcPolyLoop", loop), True)


def faceted_brep(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    return model.new("IfcFacetedBrep", model.new("IfcClosedShell", _faces(model, T, inner, outer, length)))


def shell_model(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    shell = model.new("IfcClosedShell", _faces(model, T, inner, outer, length))
    return model.new("IfcShellBasedSurfaceModel", [shell])


def advanced_brep(model: Author, T: Array, inner: float, outer: float, length: float) -> Any:
    """Cylindrical faces with a seam and plane ring-shaped ends, as boundary-representation kernels export."""
    vertex, ring, seam = {}, {}, {}
    for d in (inner, outer):
        for z in (0.0, length):
            vertex[d, z] = model.new("IfcVertexPoint", model.point(on(T, (d / 2.0, 0.0, z))))
            curve = model.new("IfcCircle", axes(model, T @ shift(z=z)), model.length(d / 2.0))
            ring[d, z] = model.new("IfcEdgeCurve", vertex[d, z], vertex[d, z], curve, True)
        along = model.new("IfcVector", model.direction(T[:3, 2].tolist()), 1.0)
        line = model.new("IfcLine", model.point(on(T, (d / 2.0, 0.0, 0.0))), along)
        seam[d] = model.new("IfcEdgeCurve", vertex[d, 0.0], vertex[d, length], line, True)

    def loop(*edges: tuple[Any, bool]) -> Any:
        return model.new("IfcEdgeLoop", [model.new("IfcOrientedEdge", None, None, edge, way) for edge, way in edges])

    faces = []
    for d, outwards in ((inner, False), (outer, True)):
        surface = model.new("IfcCylindricalSurface", axes(model, T), model.length(d / 2.0))
        around = loop((ring[d, 0.0], True), (seam[d], True), (ring[d, length], False), (seam[d], False))
        faces.append(model.new("IfcAdvancedFace", [model.new("IfcFaceOuterBound", around, True)], surface, outwards))
    for z, upwards in ((0.0, False), (length, True)):
        plane = model.new("IfcPlane", axes(model, T @ shift(z=z)))
        bounds = [
            model.new("IfcFaceOuterBound", loop((ring[outer, z], upwards)), True),
            model.new("IfcFaceBound", loop((ring[inner, z], not upwards)), True),
        ]
        faces.append(model.new("IfcAdvancedFace", bounds, plane, upwards))
    return model.new("IfcAdvancedBrep", model.new("IfcClosedShell", faces))


Sleeve = Callable[[Author, Array, float, float, float], Any]
SLEEVES: dict[str, Sleeve] = {
    "hollow extrusion": hollow_extrusion,
    "profile with voids": profile_with_voids,
    "bored cylinder": bored_cylinder,
    "csg": csg_cylinders,
    "turned": turned,
    "pipe": pipe,
    "faceted brep": faceted_brep,
    "shell": shell_model,
}
SLEEVES_SINCE_IFC4: dict[str, Sleeve] = {
    "triangulated": triangulated,
    "polygonal": polygonal,
    "advanced brep": advanced_brep,
}


# Holes


def rod(model: Author, T: Array, diameter: float, length: float, sides: int) -> Any:
    """A round rod of so many plane sides: a hole where it is an opening."""
    low, high = ([model.point(p) for p in on(T, circle(diameter / 2.0, z, sides))] for z in (0.0, length))
    loops = [low[::-1], high, *([low[k - 1], low[k], high[k], high[k - 1]] for k in range(sides))]
    faces = [model.new("IfcFace", [_bound(model, loop, "IfcFaceOuterBound")]) for loop in loops]
    return model.new("IfcFacetedBrep", model.new("IfcClosedShell", faces))


def pierced_box(
    model: Author, T: Array, outline: Sequence[Any], holes: Sequence[Any], bore: float, depth: float, sides: int = SIDES
) -> Any:
    """A column of 3,000 mm in facets, with round blind holes of so many sides in its foot."""
    low, high = ([model.point(p) for p in on(T, [(*corner, z) for corner in outline])] for z in (0.0, 3000.0))
    loops = [high, *([low[k - 1], low[k], high[k], high[k - 1]] for k in range(len(outline)))]
    mouths = []
    for x, y in holes:
        mouth, end = ([model.point(p) for p in on(T @ shift(x, y), circle(bore / 2.0, z, sides))] for z in (0.0, depth))
        mouths.append(_bound(model, mouth, "IfcFaceBound"))
        loops += [end[::-1], *([mouth[k], mouth[k - 1], end[k - 1], end[k]] for k in range(sides))]
    faces = [model.new("IfcFace", [_bound(model, loop, "IfcFaceOuterBound")]) for loop in loops]
    faces.append(model.new("IfcFace", [_bound(model, low[::-1], "IfcFaceOuterBound"), *mouths]))
    return model.new("IfcFacetedBrep", model.new("IfcClosedShell", faces))


# Bars: each gives the items of one bar, its top at (0, 0, length); bent ones have their foot below.


def swept_polyline(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    return [model.disk(on(T, [(0, 0, 0), (0, 0, length)]).tolist(), diameter)]


def swept_downwards(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    """From its top to its foot, in three legs of one line."""
    points = [(0, 0, length), (0, 0, 0.6 * length), (0, 0, 0.2 * length), (0, 0, 0)]
    return [model.disk(on(T, points).tolist(), diameter)]


def _bend(model: Author, T: Array) -> Any:
    """A quarter turn from upright to level, about an axis at (bend, 0, bend): from (0, 0, bend) to (bend, 0, 0)."""
    around = np.eye(4)
    around[:3, :3] = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]).T
    at = axes(model, T @ shift(BEND_MM, 0.0, BEND_MM) @ around)
    return model.new("IfcCircle", at, model.length(BEND_MM))


def bent_composite(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    """A composite curve of a polyline, an arc trimmed by points and a line trimmed by parameters, two against it."""
    leg = model.new("IfcPolyline", [model.point(p) for p in on(T, [(0, 0, length), (0, 0, BEND_MM)])])
    ends = on(T, [(0, 0, BEND_MM), (BEND_MM, 0, 0)])
    trims = [[model.point(p)] for p in ends]
    arc = model.new("IfcTrimmedCurve", _bend(model, T), *trims, _turns_onwards(model, T, ends), "CARTESIAN")
    along = model.new("IfcVector", model.direction(T[:3, 0].tolist()), 1.0)
    line = model.new("IfcLine", model.point(on(T, (BEND_MM, 0, 0))), along)
    far = [[model.new("IfcParameterValue", v)] for v in (0.0, model.length(FOOT_MM))]
    foot = model.new("IfcTrimmedCurve", line, *far, True, "PARAMETER")
    segments = [model.new("IfcCompositeCurveSegment", "CONTINUOUS", True, part) for part in (leg, arc, foot)]
    path = model.new("IfcCompositeCurve", segments, False)
    return [model.new("IfcSweptDiskSolid", path, model.length(diameter / 2.0))]


def _turns_onwards(model: Author, T: Array, ends: Array) -> bool:
    """Whether the short way from the first end to the second is with the circle's own sense."""
    middle = on(T, (BEND_MM, 0.0, BEND_MM))
    normal = T[:3, :3] @ np.array([0.0, 1.0, 0.0])
    return bool(np.cross(ends[0] - middle, ends[1] - middle) @ normal > 0.0)


def bent_indexed(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    half = BEND_MM * (1.0 - math.sqrt(0.5))
    corners = [(0, 0, length), (0, 0, BEND_MM), (half, 0, half), (BEND_MM, 0, 0), (BEND_MM + FOOT_MM, 0, 0)]
    points = model.new("IfcCartesianPointList3D", (on(T, corners) / model.unit_mm).tolist())
    kinds = (("IfcLineIndex", (1, 2)), ("IfcArcIndex", (2, 3, 4)), ("IfcLineIndex", (4, 5)))
    segments = [model.file.create_entity(kind, index) for kind, index in kinds]
    curve = model.new("IfcIndexedPolyCurve", points, segments, False)
    return [model.new("IfcSweptDiskSolid", curve, model.length(diameter / 2.0))]


def line_with_range(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    """An unbounded line of which the solid takes a piece."""
    along = model.new("IfcVector", model.direction(T[:3, 2].tolist()), model.length(1.0))
    line = model.new("IfcLine", model.point(on(T, (0, 0, -500.0))), along)
    return [model.new("IfcSweptDiskSolid", line, model.length(diameter / 2.0), None, 500.0, 500.0 + length)]


def extruded(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    return [model.cylinder(diameter / 2.0, length, axes(model, T))]


def pieces(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    """Every leg and every bend a solid of its own: extrusions, and a disk turned about an axis beside it."""
    leg = model.cylinder(diameter / 2.0, length - BEND_MM, axes(model, T @ shift(z=BEND_MM)))
    sideways = np.eye(4)
    sideways[:3, :3] = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    foot = model.cylinder(diameter / 2.0, FOOT_MM, axes(model, T @ shift(x=BEND_MM) @ sideways))
    disk = model.profile("IfcCircleProfileDef", Radius=diameter / 2.0)
    # The disk lies in the xy plane at the upper end of the bend; the axis is beside it, along -y: downwards and on.
    axis = model.new("IfcAxis1Placement", model.point((BEND_MM, 0.0, 0.0)), model.direction((0.0, -1.0, 0.0)))
    bend = model.new("IfcRevolvedAreaSolid", disk, axes(model, T @ shift(z=BEND_MM)), axis, 90.0)
    return [foot, bend, leg]


def faceted_bar(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    """A hexagonal prism of plane faces: the coarsest that exporters write."""
    rings = [[model.point(p) for p in on(T, circle(diameter / 2.0, z, 6))] for z in (0.0, length)]
    loops = [
        rings[0][::-1],
        rings[1],
        *([rings[0][k - 1], rings[0][k], rings[1][k], rings[1][k - 1]] for k in range(6)),
    ]
    faces = [model.new("IfcFace", [_bound(model, loop, "IfcFaceOuterBound")]) for loop in loops]
    return [model.new("IfcFacetedBrep", model.new("IfcClosedShell", faces))]


def faceted_bent_bar(model: Author, T: Array, diameter: float, length: float) -> list[Any]:
    """Facets along the legs and the bend, ends closed by polygons of twelve sides."""
    sides, rings = 12, []
    level = circle(diameter / 2.0, 0.0, sides)
    for at, turn in _stations(length):
        turned_ring = level @ np.array(
            [[math.cos(turn), 0, -math.sin(turn)], [0, 1, 0], [math.sin(turn), 0, math.cos(turn)]]
        )
        rings.append([model.point(p) for p in on(T, turned_ring + at)])
    loops = [rings[0][::-1], rings[-1]]
    for low, high in pairwise(rings):
        loops += [[low[k - 1], low[k], high[k], high[k - 1]] for k in range(sides)]
    faces = [model.new("IfcFace", [_bound(model, loop, "IfcFaceOuterBound")]) for loop in loops]
    return [model.new("IfcFacetedBrep", model.new("IfcClosedShell", faces))]


def _stations(length: float) -> list[tuple[Array, float]]:
    """Points along the axis from the foot's end to the top, and the turn of the section about y, radians."""
    found = [(np.array([BEND_MM + FOOT_MM, 0.0, 0.0]), -math.pi / 2.0)]
    for turn in np.linspace(math.pi / 2.0, 0.0, 7):
        at = (BEND_MM * (1.0 - math.cos(turn)), 0.0, BEND_MM * (1.0 - math.sin(turn)))
        found.append((np.array(at), -float(turn)))
    return [*found, (np.array([0.0, 0.0, length]), 0.0)]


Bar = Callable[[Author, Array, float, float], list[Any]]
STRAIGHT: dict[str, Bar] = {
    "polyline": swept_polyline,
    "downwards": swept_downwards,
    "line with range": line_with_range,
    "extrusion": extruded,
    "facets": faceted_bar,
}
BENT: dict[str, Bar] = {
    "composite curve": bent_composite,
    "pieces": pieces,
    "bent facets": faceted_bent_bar,
}
BENT_SINCE_IFC4: dict[str, Bar] = {"indexed curve": bent_indexed}


def bent_length(length: float) -> float:
    """Length of a bent bar's axis."""
    return length - BEND_MM + BEND_MM * math.pi / 2.0 + FOOT_MM
