"""plate.step: the plate with its holes and its pins as solids for a machine, by ISO 10303-214, mm.

Faces are planes and cylinders alone, each edge is shared by the two faces that meet in it: what any kernel reads.
The tubes behind the holes are no work of the machine, and are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TypeAlias

from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.model import Kind
from aadm_workbench.own_files import write_atomically

_Point: TypeAlias = tuple[float, float, float]
_Edge: TypeAlias = tuple[str, bool]
"""An edge, and whether it is walked the way it was drawn."""

_HEADER = """\
ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('a plate for learning a camera'),'2;1');
FILE_NAME('plate.step','',(''),(''),'aadm camera plate','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
"""

_UP, _X = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)  # axes of the drawing, unit vectors


def plate_step(plate: Plate) -> str:
    """The text of the file: the plate as one solid, and each pin as one, from the plate's back to its end."""
    drawn = _Drawn()
    solids = [_plate(drawn, plate), *(_pin(drawn, plate, number) for number in range(len(plate.of(Kind.REBAR))))]
    drawn.product("plate", solids)
    return _HEADER + "".join(drawn.lines) + "ENDSEC;\nEND-ISO-10303-21;\n"


def write_plate_step(plate: Plate, path: Path) -> None:
    """Write plate.step, whole or not at all."""
    write_atomically(path, plate_step(plate).encode("ascii"))


def _plate(drawn: _Drawn, plate: Plate) -> str:
    """A block with round holes through it, those of the pins as well."""
    half, low = plate.size_mm / 2.0, -plate.thickness_mm
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    top = [drawn.vertex((x, y, 0.0)) for x, y in corners]
    bottom = [drawn.vertex((x, y, low)) for x, y in corners]
    after = [1, 2, 3, 0]
    above = [drawn.line((*corners[k], 0.0), (*corners[j], 0.0), top[k], top[j]) for k, j in enumerate(after)]
    below = [drawn.line((*corners[k], low), (*corners[j], low), bottom[k], bottom[j]) for k, j in enumerate(after)]
    rising = [drawn.line((*at, low), (*at, 0.0), bottom[k], top[k]) for k, at in enumerate(corners)]
    holes = [drawn.barrel((one.x_mm, one.y_mm), one.diameter_mm / 2.0, low, 0.0) for one in plate.places]
    faces = [
        drawn.flat((0.0, 0.0, 0.0), _UP, [[(e, True) for e in above], *([(hole.top, False)] for hole in holes)]),
        drawn.flat(
            (0.0, 0.0, low),
            (0.0, 0.0, -1.0),
            [[(e, False) for e in reversed(below)], *([(hole.bottom, True)] for hole in holes)],
        ),
    ]
    for k, j in enumerate(after):
        out = (corners[j][1] - corners[k][1], corners[k][0] - corners[j][0])
        length = abs(out[0]) + abs(out[1])
        around = [(below[k], True), (rising[j], True), (above[k], False), (rising[k], False)]
        faces.append(drawn.flat((*corners[k], low), (out[0] / length, out[1] / length, 0.0), [around]))
    faces += [drawn.round(hole, is_hole=True) for hole in holes]
    return drawn.solid("plate", faces)


def _pin(drawn: _Drawn, plate: Plate, number: int) -> str:
    one, low = plate.of(Kind.REBAR)[number], -plate.thickness_mm
    pin = drawn.barrel((one.x_mm, one.y_mm), one.diameter_mm / 2.0, low, one.z_mm)
    faces = [
        drawn.flat((one.x_mm, one.y_mm, one.z_mm), _UP, [[(pin.top, True)]]),
        drawn.flat((one.x_mm, one.y_mm, low), (0.0, 0.0, -1.0), [[(pin.bottom, False)]]),
        drawn.round(pin, is_hole=False),
    ]
    return drawn.solid(one.label, faces)


class _Barrel:
    """An upright cylinder: its two circles, counter-clockwise from above, and the line that joins them, rising."""

    def __init__(self, surface: str, top: str, bottom: str, seam: str) -> None:
        self.surface, self.top, self.bottom, self.seam = surface, top, bottom, seam


class _Drawn:
    """Entities in the order in which they were asked for; each call names what it made, ``#12``."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def add(self, text: str) -> str:
        """Put one entity in."""
        name = f"#{len(self.lines) + 1}"
        self.lines.append(f"{name}={text};\n")
        return name

    def vertex(self, at: _Point) -> str:
        """A corner at (3,) mm."""
        return self.add(f"VERTEX_POINT('',{self._point(at)})")

    def line(self, begin: _Point, end: _Point, first: str, last: str) -> str:
        """A straight edge between two corners."""
        length = sum((b - a) ** 2 for a, b in zip(begin, end, strict=True)) ** 0.5
        along = ((end[0] - begin[0]) / length, (end[1] - begin[1]) / length, (end[2] - begin[2]) / length)
        vector = self.add(f"VECTOR('',{self._direction(along)},1.)")
        carrier = self.add(f"LINE('',{self._point(begin)},{vector})")
        return self.add(f"EDGE_CURVE('',{first},{last},{carrier},.T.)")

    def barrel(self, at: tuple[float, float], radius_mm: float, low: float, high: float) -> _Barrel:
        """The edges and the surface of an upright cylinder, from low to high."""
        ends = [(at[0] + radius_mm, at[1], z) for z in (low, high)]
        corners = [self.vertex(end) for end in ends]
        circles = []
        for z, corner in zip((low, high), corners, strict=True):
            circle = self.add(f"CIRCLE('',{self._axes((*at, z), _UP, _X)},{_real(radius_mm)})")
            circles.append(self.add(f"EDGE_CURVE('',{corner},{corner},{circle},.T.)"))
        seam = self.line(ends[0], ends[1], *corners)
        surface = self.add(f"CYLINDRICAL_SURFACE('',{self._axes((*at, low), _UP, _X)},{_real(radius_mm)})")
        return _Barrel(surface, circles[1], circles[0], seam)

    def flat(self, at: _Point, normal: _Point, loops: Sequence[Sequence[_Edge]]) -> str:
        """A plane face: its outline, then its holes, each walked with the face on the left."""
        beside = _X if abs(normal[0]) < 0.5 else (0.0, 1.0, 0.0)  # any direction within the face
        plane = self.add(f"PLANE('',{self._axes(at, normal, beside)})")
        kinds = ["FACE_OUTER_BOUND"] + ["FACE_BOUND"] * (len(loops) - 1)
        bounds = [self.add(f"{kind}('',{self._loop(loop)},.T.)") for kind, loop in zip(kinds, loops, strict=True)]
        return self.add(f"ADVANCED_FACE('',({','.join(bounds)}),{plane},.T.)")

    def round(self, barrel: _Barrel, *, is_hole: bool) -> str:
        """The side of a cylinder, seen from within where it is a hole."""
        around = [(barrel.bottom, True), (barrel.seam, True), (barrel.top, False), (barrel.seam, False)]
        if is_hole:
            around = [(barrel.top, True), (barrel.seam, False), (barrel.bottom, False), (barrel.seam, True)]
        bound = self.add(f"FACE_OUTER_BOUND('',{self._loop(around)},.T.)")
        return self.add(f"ADVANCED_FACE('',({bound}),{barrel.surface},.{'F' if is_hole else 'T'}.)")

    def solid(self, name: str, faces: Sequence[str]) -> str:
        """A solid of closed faces."""
        shell = self.add(f"CLOSED_SHELL('',({','.join(faces)}))")
        return self.add(f"MANIFOLD_SOLID_BREP('{name}',{shell})")

    def product(self, name: str, solids: Sequence[str]) -> None:
        """What makes of solids a product, with its units."""
        length = self.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
        angle = self.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        whole = self.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        near = self.add(f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),{length},'distance_accuracy_value','')")
        context = self.add(
            f"(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({near}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{whole}))REPRESENTATION_CONTEXT('',''))"
        )
        items = ",".join([self._axes((0.0, 0.0, 0.0), _UP, _X), *solids])
        shape = self.add(f"ADVANCED_BREP_SHAPE_REPRESENTATION('{name}',({items}),{context})")
        use = self.add("APPLICATION_CONTEXT('automotive design')")
        self.add(f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{use})")
        field = self.add(f"PRODUCT_CONTEXT('',{use},'mechanical')")
        product = self.add(f"PRODUCT('{name}','{name}','',({field}))")
        version = self.add(f"PRODUCT_DEFINITION_FORMATION('','',{product})")
        stage = self.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{use},'design')")
        definition = self.add(f"PRODUCT_DEFINITION('design','',{version},{stage})")
        of_product = self.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
        self.add(f"SHAPE_DEFINITION_REPRESENTATION({of_product},{shape})")

    def _point(self, at: _Point) -> str:
        return self.add(f"CARTESIAN_POINT('',({','.join(map(_real, at))}))")

    def _direction(self, along: _Point) -> str:
        return self.add(f"DIRECTION('',({','.join(map(_real, along))}))")

    def _axes(self, at: _Point, normal: _Point, beside: _Point) -> str:
        parts = f"{self._point(at)},{self._direction(normal)},{self._direction(beside)}"
        return self.add(f"AXIS2_PLACEMENT_3D('',{parts})")

    def _loop(self, edges: Sequence[_Edge]) -> str:
        walked = [self.add(f"ORIENTED_EDGE('',*,*,{edge},.{'T' if ahead else 'F'}.)") for edge, ahead in edges]
        return self.add(f"EDGE_LOOP('',({','.join(walked)}))")


def _real(value: float) -> str:
    """A number as the format wants it: with a point, a millionth of a millimetre exact."""
    return f"{value + 0.0:.6f}"
