"""Which columns of a table are x, y and z, and in which unit, by their names: ``X [mm]``, PosX, X坐标, Points:0."""

from __future__ import annotations

import re
from collections.abc import Sequence

_MM_PER_UNIT = {
    "mm": 1.0,
    "毫米": 1.0,
    "millimeter": 1.0,
    "millimetre": 1.0,
    "cm": 10.0,
    "厘米": 10.0,
    "m": 1000.0,
    "米": 1000.0,
    "meter": 1000.0,
    "metre": 1000.0,
    "inch": 25.4,
    "ft": 304.8,
    "feet": 304.8,
}
_UNIT = re.compile(
    rf"(?<=.)[\s_\[(/（【<]{{1,3}}({'|'.join(sorted(_MM_PER_UNIT, key=len, reverse=True))})s?[\])）】>]?$"
)
_NOT_LETTERS = re.compile(r"[\W_]+")
_COORDINATES = (
    "坐标",
    "座标",
    "坐標",
    "座標",
    "轴",
    "值",
    "coordinates",
    "coordinate",
    "coords",
    "coord",
    "axis",
    "value",
)
_MAP = (
    {"east", "easting", "东", "e"},
    {"north", "northing", "北", "n"},
    {"up", "height", "elevation", "高程", "h", "z"},
)
_NO_PLACE = re.compile(
    "^n[0-2]?$|norm|grad|veloc|curv|colou?r|index|row|col|dir|rot|法|vector|error|sigma|std|^d$|^v$|^[iu]$"
)
"""What triples of columns hold that are no place: normals, colours, directions, places in a picture."""

_PLACES = re.compile("point|pos|xyz|vert|coord|loc|点|cart|^p$|^$")
"""What a numbered triple must be called to be a place; many tables number what they do not name."""


def named_columns(names: Sequence[str]) -> tuple[int, int, int] | None:
    """Return the columns of x, y and z; None where the names do not tell, or tell several.

    Three names belong together that are alike but for an x, y or z at their beginning or end, or, where they are
    called points, for a 0, 1 or 2. ``x``, ``y`` and ``z`` alone go before any others.
    """
    bare = [_bare(name) for name in names]
    triples = _triples(bare, "xyz") or _triples(bare, "012", _PLACES) or _triples(bare, "123", _PLACES)
    if "" in triples:
        return triples[""]
    if len(triples) == 1:
        return next(iter(triples.values()))
    on_map = [[k for k, name in enumerate(bare) if name in words] for words in _MAP]
    if not triples and all(len(found) == 1 for found in on_map):
        return on_map[0][0], on_map[1][0], on_map[2][0]
    return None


def named_unit(names: Sequence[str]) -> float | None:
    """Return the millimetres in one unit that all names of columns carry; None where they carry none."""
    found = [_UNIT.search(_small(name)) for name in names]
    units = {_MM_PER_UNIT[match[1]] for match in found if match}
    return units.pop() if len(units) == 1 and all(found) and found else None


def names_some_axis(names: Sequence[str]) -> bool:
    """Whether a name is that of one coordinate, whatever the others are."""
    return any(_bare(name) in ("x", "y", "z") for name in names)


def _small(name: str) -> str:
    return name.strip().strip("\"'").strip().lower()


def _bare(name: str) -> str:
    """Return a name without its unit, without signs, and without the words that all coordinates carry."""
    bare = _NOT_LETTERS.sub("", _UNIT.sub("", _small(name)))
    for word in _COORDINATES:
        bare = bare.replace(word, "")
    return bare


def _triples(names: Sequence[str], ends: str, called: re.Pattern[str] | None = None) -> dict[str, tuple[int, int, int]]:
    """Return the triples of names that are alike but for one end each, by what they have in common."""
    places: dict[str, list[dict[str, int]]] = {}
    for column, name in enumerate(names):
        for end, rest in ((name[-1:], name[:-1]), (name[:1], name[1:])):
            if end and end in ends and not _NO_PLACE.search(rest) and (called is None or called.search(rest)):
                places.setdefault(rest, [{}, {}])[0 if name.endswith(end) else 1].setdefault(end, column)
    found = {}
    for rest, sides in places.items():
        for side in sides:
            if len(side) == len(ends):
                found[rest] = (side[ends[0]], side[ends[1]], side[ends[2]])
    return found
