"""plate.dxf: the outline, the holes and the pins' bores for a machine, in AutoCAD's R12 format, mm.

R12 (AC1009) is the oldest text form that every program still reads; a file of it is pairs of lines, a code and a value.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.model import Kind
from aadm_workbench.own_files import write_atomically

_LAYERS = {Kind.SLEEVE: "HOLES", Kind.REBAR: "PINS"}
_TEXT_MM = 8.0  # height of labels: read on a print at 1 : 4


def plate_dxf(plate: Plate) -> str:
    """The text of the file; origin in the middle of the holes."""
    pairs = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), (9, "$INSUNITS"), (70, "4"), (0, "ENDSEC")]
    pairs += [(0, "SECTION"), (2, "ENTITIES"), *_entities(plate), (0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code:>3}\n{value}\n" for code, value in pairs)


def _entities(plate: Plate) -> Iterator[tuple[int, str]]:
    half = plate.size_mm / 2.0
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    for (x0, y0), (x1, y1) in zip(corners, [*corners[1:], corners[0]], strict=True):
        yield from ((0, "LINE"), (8, "OUTLINE"))
        yield from ((10, _mm(x0)), (20, _mm(y0)), (30, "0.0"), (11, _mm(x1)), (21, _mm(y1)), (31, "0.0"))
    for one in plate.places:
        at = ((10, _mm(one.x_mm)), (20, _mm(one.y_mm)), (30, "0.0"))
        yield from ((0, "CIRCLE"), (8, _LAYERS[one.kind]), *at, (40, _mm(one.diameter_mm / 2.0)))
        aside = one.x_mm + one.diameter_mm / 2.0 + _TEXT_MM / 2.0
        yield from ((0, "TEXT"), (8, "LABELS"), (10, _mm(aside)), (20, _mm(one.y_mm)), (30, "0.0"))
        yield from ((40, _mm(_TEXT_MM)), (1, one.label))


def _mm(value: float) -> str:
    return f"{value + 0.0:.6f}"


def write_plate_dxf(plate: Plate, path: Path) -> None:
    """Write plate.dxf, whole or not at all."""
    write_atomically(path, plate_dxf(plate).encode("ascii"))
