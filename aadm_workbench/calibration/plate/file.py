"""plate.toml: a plate with its places, and the table of a measuring machine that replaces them."""

from __future__ import annotations

import csv
import hashlib
import io
import math
import tomllib
from dataclasses import replace
from pathlib import Path

import msgspec

from aadm_workbench.bounded import toml_fault
from aadm_workbench.calibration.plate.plate import Place, Plate
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Kind
from aadm_workbench.model.reason import said_of
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.file import load

_NAMES = {Kind.SLEEVE: "hole", Kind.REBAR: "pin"}
_KINDS = {name: kind for kind, name in _NAMES.items()}
_SIZES = ("size_mm", "pin_height_mm", "thickness_mm", "bore_mm", "expansion_per_k")
_NUMBERS = ("x_mm", "y_mm", "z_mm", "diameter_mm", "u_mm")
_FEWEST = 4  # holes, and pins: three fix a turn, a fourth tells that they are the right ones
_FARTHEST_MM = 5.0  # a machined place is nearer to its drawing: farther, rows or axes are mistaken


class _Row(msgspec.Struct, forbid_unknown_fields=True):
    label: str
    kind: str
    x_mm: float
    y_mm: float
    z_mm: float
    diameter_mm: float
    u_mm: float


class _File(msgspec.Struct, forbid_unknown_fields=True):
    schema: int
    name: str
    size_mm: float
    pin_height_mm: float
    thickness_mm: float
    bore_mm: float
    expansion_per_k: float
    places: list[_Row]
    table: str = ""


def plate_text(plate: Plate) -> str:
    """What plate.toml holds."""
    lines = [
        "# A plate for `aadm camera learn`: places in mm, x right and y up as the camera sees it, z out of the face.",
        '# table = "plate.csv" takes the places that a measuring machine found: label,x_mm,y_mm,z_mm,diameter_mm,u_mm.',
        "schema = 1",
        f'name = "{plate.name}"',
        *(f"{name} = {getattr(plate, name):.9g}" for name in _SIZES),
    ]
    for one in plate.places:
        lines += ["", "[[places]]", f'label = "{one.label}"', f'kind = "{_NAMES[one.kind]}"']
        lines += [f"{name} = {getattr(one, name):.9g}" for name in _NUMBERS]
    return "\n".join(lines) + "\n"


def write_plate(plate: Plate, path: Path) -> None:
    """Write plate.toml, whole or not at all."""
    write_atomically(path, plate_text(plate).encode())


def read_plate(path: Path) -> Plate:
    """A plate from its file, with the places of its table where it names one.

    Raises
    ------
    DesignError
        Where the file is none, or its table does not fit; the message names the line or the place.
    """
    content = load(path, str(path)).content
    try:
        found = msgspec.convert(tomllib.loads(content.decode("utf-8-sig")), _File, strict=False)
        places = tuple(_place(row) for row in found.places)
    except (ValueError, KeyError, msgspec.ValidationError) as error:
        raise DesignError(said_of(path, "calibration.no_plate", why=toml_fault(error))) from error
    plate = Plate(
        found.name,
        found.size_mm,
        places,
        found.pin_height_mm,
        found.thickness_mm,
        found.bore_mm,
        found.expansion_per_k,
        sha256=hashlib.sha256(content).hexdigest(),
    )
    if min(len(plate.of(kind)) for kind in _NAMES) < _FEWEST or len({one.label for one in places}) < len(places):
        raise DesignError(said_of(path, "calibration.few_places", fewest=_FEWEST))
    return _calibrated(plate, path.parent / found.table) if found.table else plate


def _place(row: _Row) -> Place:
    numbers = [getattr(row, name) for name in _NUMBERS]
    if not all(map(math.isfinite, numbers)) or row.diameter_mm <= 0.0 or row.u_mm <= 0.0:
        raise ValueError(f"{row.label}: a number that is none, or no diameter or u above zero")
    return Place(row.label, _KINDS[row.kind], *numbers)


def _calibrated(plate: Plate, table: Path) -> Plate:
    """The plate with the places of a table; those that it lacks are left out, as nobody knows where they are."""
    content = load(table, str(table)).content
    found: dict[str, dict[str, float]] = {}
    where = "line 1"
    try:
        for number, row in enumerate(csv.DictReader(io.StringIO(content.decode("utf-8-sig"))), 2):
            where = f"line {number}"
            found[row["label"]] = {name: float(row[name]) for name in _NUMBERS}
    except (KeyError, TypeError, ValueError) as error:
        raise DesignError(said_of(table, "calibration.no_table", where=where, why=str(error))) from error
    places = []
    for one in plate.places:
        if one.label not in found:
            continue
        x, y, z, diameter, u = (found[one.label][name] for name in _NUMBERS)
        moved = replace(one, x_mm=x, y_mm=y, z_mm=z, diameter_mm=diameter, u_mm=u)
        off_mm = math.dist((one.x_mm, one.y_mm, one.z_mm), (moved.x_mm, moved.y_mm, moved.z_mm))
        if not off_mm <= _FARTHEST_MM or not moved.u_mm > 0.0:
            raise DesignError(said_of(table, "calibration.far_place", label=one.label, off_mm=off_mm))
        places.append(moved)
    both = hashlib.sha256(plate.sha256.encode() + content).hexdigest()
    calibrated = replace(plate, places=tuple(places), calibrated=True, sha256=both)
    if min(len(calibrated.of(kind)) for kind in _NAMES) < _FEWEST:
        raise DesignError(said_of(table, "calibration.few_places", fewest=_FEWEST))
    return calibrated
