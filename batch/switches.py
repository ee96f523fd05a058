"""Switches that the commands have in common, and types of arguments that check themselves."""

from __future__ import annotations

import argparse
import math
import re

_BYTES = {"mb": 10**6, "mib": 2**20, "gb": 10**9, "gib": 2**30}
_SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}

LEAST_MEMORY_BYTES = 256 * 10**6
"""The packages alone take about as much; below it nothing could be checked."""
_UNITS_S = {"": 1.0, "s": 1.0, "ms": 1e-3, "min": 60.0}  # of a time


def add_switches(parser: argparse.ArgumentParser, *, prints_json: str | None) -> None:
    """``--quiet``, ``--debug`` and, for a command that prints a table, ``--json``, which prints ``prints_json``."""
    if prints_json is not None:
        parser.add_argument("--json", action="store_true", help=f"print {prints_json} as JSON instead of a table")
    parser.add_argument(
        "--quiet", action="store_true", help="no progress and no table: errors and what --json asks for"
    )
    parser.add_argument("--debug", action="store_true", help="show where an internal error happened")


def whole_number(text: str) -> int:
    """A whole number above zero."""
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number above zero")
    return int(text)


def length(text: str) -> float:
    """A length above zero."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0.0):
        raise argparse.ArgumentTypeError(f"{text!r} is not a length above zero")
    return value


def memory_size(text: str) -> int:
    """A size of memory with its unit, in bytes."""
    size = int(_quantity(text, _BYTES, "limit; write 2GB or 600MB"))
    if size < LEAST_MEMORY_BYTES:
        raise argparse.ArgumentTypeError(f"{text!r} is too little memory to check anything; give 600MB or more")
    return size


def time_span(text: str) -> float:
    """A time with its unit, in seconds."""
    return _quantity(text, _SECONDS, "limit; write 90s, 15min or 1h")


def duration(text: str) -> float:
    """A time, in seconds: 2, 2s, 500ms, 1min."""
    return _quantity(text, _UNITS_S, "time; write 2s, 500ms or 1min")


def _quantity(text: str, units: dict[str, float] | dict[str, int], wanted: str) -> float:
    found = re.fullmatch(r"(\d+(?:\.\d+)?)\s*([a-z]*)", text.strip().lower())
    unit = units.get(found[2]) if found else None
    if found is None or unit is None or float(found[1]) == 0.0:
        raise argparse.ArgumentTypeError(f"{text!r} is no {wanted}")
    return float(found[1]) * unit
