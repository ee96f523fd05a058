"""The unit of a LAS file by its coordinate system, written as well-known text or as GeoTIFF keys."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Reason
from aadm_workbench.scan.file import ScanFile
from aadm_workbench.scan.formats.las_header import VariableRecord

_WELL_KNOWN_TEXT, _GEOTIFF_KEYS = 2112, 34735  # numbers of the records that hold a coordinate system (ASPRS LAS 1.4, 3)
_WRITER = "LASF_Projection"

_UNIT = re.compile(r'\b(?:LENGTH)?UNIT\s*[\[(]\s*"([^"]{0,80})"\s*,\s*([-+.\deE]{1,40})')
_ANGLE = re.compile("deg|rad|grad|gon|arc|mil", re.IGNORECASE)
_SYSTEM_OF_2019 = re.compile(r"\bCS\s*[\[(]")
_PLANE = re.compile(r"\b(PROJCS|PROJCRS|PROJECTEDCRS|LOCAL_CS|ENGCRS|ENGINEERINGCRS|GEOCCS|CARTESIAN)", re.IGNORECASE)

_MODEL_KEY, _UNIT_KEY, _HEIGHT_UNIT_KEY = 1024, 3076, 4099  # GeoTIFF 1.1: GTModelType, ProjLinearUnits, VerticalUnits
_GEOGRAPHIC = 2  # GeoTIFF 1.1: a model in degrees
_METRES_OF_CODE = {9001: ("metre", 1.0), 9002: ("foot", 0.3048), 9003: ("US survey foot", 1200.0 / 3937.0)}
_SAME_UNIT = 1e-5
"""Relative; the two feet differ by 2e-6, which no component notices."""


def unit_of(file: ScanFile, records: Sequence[VariableRecord]) -> tuple[float, str] | None:
    """Return millimetres per unit and what says so; None where the file does not say its unit.

    Raises
    ------
    ScanError
        For coordinates in degrees, and where heights have another unit than the plane.
    """
    for number, units in ((_WELL_KNOWN_TEXT, _units_of_text), (_GEOTIFF_KEYS, _units_of_keys)):
        for record in records:
            if record.user == _WRITER and record.number == number and (found := units(file, record.content)):
                return _one(file, found)
    return None


def _one(file: ScanFile, units: Sequence[tuple[str, float]]) -> tuple[float, str] | None:
    name, metres = units[0]
    if not (math.isfinite(metres) and metres > 0.0):
        return None
    for other, other_metres in units[1:]:
        # The factor of a height is often left at 1 where its unit is named rightly.
        if other.lower() != name.lower() and not abs(other_metres / metres - 1.0) < _SAME_UNIT:
            raise file.wrong(Reason("formats.las_units_differ", other=other, name=name))
    return 1000.0 * metres, Reason("formats.las_unit", name=name)


def _units_of_text(file: ScanFile, content: bytes) -> list[tuple[str, float]]:
    text = content.decode("latin-1").partition("\0")[0]
    system = _SYSTEM_OF_2019.search(text)
    if text.strip() and not _PLANE.search(text):
        if re.match(r"\s*GEO", text):
            raise _degrees(file)
        return []
    # The newer text gives units of its ellipsoid and parameters, too; those of the axes come last.
    named = _UNIT.findall(text, system.start() if system else 0)
    return [(name, _number(factor)) for name, factor in named if not _ANGLE.search(name)]


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _units_of_keys(file: ScanFile, content: bytes) -> list[tuple[str, float]]:
    values = np.frombuffer(content, "<u2", len(content) // 2)
    keys = {
        int(key): int(value) for key, place, _, value in values[4 : len(values) // 4 * 4].reshape(-1, 4) if not place
    }
    if keys.get(_MODEL_KEY) == _GEOGRAPHIC:
        raise _degrees(file)
    codes = [keys[key] for key in (_UNIT_KEY, _HEIGHT_UNIT_KEY) if keys.get(key) in _METRES_OF_CODE]
    return [_METRES_OF_CODE[code] for code in codes] if keys.get(_UNIT_KEY) in _METRES_OF_CODE else []


def _degrees(file: ScanFile) -> ScanError:
    return file.wrong(Reason("formats.las_degrees"))
