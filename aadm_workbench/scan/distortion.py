"""What cameras' files call the distortion of a lens: the names under which coefficients stand, and the coefficients.

A depth map of a lens that was not straightened is off by millimetres at the edge of the picture, so that a name too
many costs a question, and a name too few a wrong verdict.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

_OF_A_LENS = re.compile(
    "dist(?!ance)|radial|tangential|thinprism|conrady|kannala|fisheye|畸变|畸變|歪|verzeichnung|"
    "^(?:lens|camera|depth|intrinsics?|k)?coef|^kc$|^skew$"
)
_OF_NONE = re.compile(
    "undist(?!.*coef)|correct|remov|rectif|cent(?:er|re)|enabled|applied|error|rms|sigma|uncertain|version"
)
"""What is said of a distortion and is no coefficient of it."""

_OF_NONE_ALONE = re.compile("model|type|name|count")
"""What is none where a single number follows."""

_SINGLE = re.compile("[kps][1-9]|kappa[1-9]?|xi")
_LISTED = re.compile("d[0-9]?")
_FEWEST_LISTED = 4
"""Coefficients in the shortest list that is called by one letter (ROS: D of the fisheye model)."""

_SHAPE = frozenset({"rows", "cols", "dt", "typeid", "count", "size"})
_NAMES_OF_NAMES, _NAMES_OF_VALUES = ("name", "key", "id"), ("value", "data", "values")
_ONLY_NUMBERS = re.compile(r"[-+\d.eE,;\s\[\]()]{1,2000}")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def plain(name: str) -> str:
    """Return a name in small letters, without signs and spaces."""
    return re.sub(r"[\W_]", "", name.lower())


def is_coefficients(name: str, numbers: Sequence[float]) -> bool:
    """Whether numbers that stand under a name are coefficients of a distortion.

    Parameters
    ----------
    name
        As :func:`plain` gives it.
    """
    is_single = len(numbers) == 1
    if _OF_NONE.search(name) or (is_single and _OF_NONE_ALONE.search(name)):
        return False
    if _OF_A_LENS.search(name):
        return True
    if is_single:
        return _SINGLE.fullmatch(name) is not None
    return _LISTED.fullmatch(name) is not None and len(numbers) >= _FEWEST_LISTED


def numbers_in(value: Any) -> list[float]:
    """Return the numbers in nested lists and tables, in their order; what shape and kind they are of is left out."""
    if isinstance(value, Mapping):
        return [number for key, item in value.items() if not _is_about(plain(str(key))) for number in numbers_in(item)]
    if isinstance(value, list):
        return [number for item in value for number in numbers_in(item)]
    if isinstance(value, str) and _ONLY_NUMBERS.fullmatch(value):
        return [float(number) for number in _NUMBER.findall(value)]
    return [as_float(value)] if isinstance(value, int | float) and not isinstance(value, bool) else []


def _is_about(name: str) -> bool:
    return name in _SHAPE or any(words.search(name) for words in (_OF_NONE, _OF_NONE_ALONE))


def as_float(value: int | float) -> float:
    """Return a number as float; whole ones beyond its range are infinite."""
    try:
        return float(value)
    except OverflowError:
        return float("inf")


def coefficients_in(table: Any, label: str = "") -> Iterator[tuple[str, list[float]]]:
    """Yield all coefficients of distortion in a table and the tables in it, each with the path of keys to them."""
    if isinstance(table, list):
        for item in table:
            yield from coefficients_in(item, label)
    if not isinstance(table, Mapping):
        return
    for key, value in (*table.items(), *_by_name(table)):
        name, path = plain(str(key)), f"{label} {key}"
        is_table = isinstance(value, Mapping) and "data" not in value and not _OF_A_LENS.search(name)
        numbers = [] if is_table else numbers_in(value)
        if numbers and is_coefficients(name, numbers):
            yield path, numbers
        else:
            yield from coefficients_in(value, path)


def _by_name(table: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield what a table says of itself by a name and a value, as lists of parameters do."""
    name = next((table[key] for key in _NAMES_OF_NAMES if isinstance(table.get(key), str)), None)
    if name is not None:
        yield from ((name, table[key]) for key in _NAMES_OF_VALUES if key in table)
