"""Limits as people write them on a command line: ``2GB``, ``600MB``, ``90s``, ``15min``."""

from __future__ import annotations

import argparse
import re

_BYTES = {"mb": 10**6, "mib": 2**20, "gb": 10**9, "gib": 2**30}
_SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}

LEAST_MEMORY_BYTES = 256 * 10**6
"""The packages alone take about as much; below it nothing could be checked."""


def memory_size(text: str) -> int:
    """A size of memory with its unit, in bytes."""
    size = int(_quantity(text, _BYTES, "2GB or 600MB"))
    if size < LEAST_MEMORY_BYTES:
        raise argparse.ArgumentTypeError(f"{text!r} is too little memory to check anything; give 600MB or more")
    return size


def time_span(text: str) -> float:
    """A time with its unit, in seconds."""
    return _quantity(text, _SECONDS, "90s, 15min or 1h")


def _quantity(text: str, units: dict[str, float] | dict[str, int], example: str) -> float:
    found = re.fullmatch(r"(\d+(?:\.\d+)?) ?([a-z]+)", text.strip().lower())
    unit = units.get(found[2]) if found else None
    if found is None or unit is None or float(found[1]) == 0.0:
        raise argparse.ArgumentTypeError(f"{text!r} is no limit; write {example}")
    return float(found[1]) * unit
