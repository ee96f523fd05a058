"""What the commands have in common: one thread, switches, arguments that check themselves, exit codes, safe text."""

from __future__ import annotations

import argparse
import math
import os
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from aadm_workbench.model import Verdict
    from aadm_workbench.model.reason import Language


# What the process returns. 1 is what a crash returns, so it means nothing else.
ALL_PASS = 0  # success
BAD_USAGE = 2  # as argparse ends, too
FAILS = 10  # from ten on the numbers are this command's own: neither shells nor libraries use them
UNDECIDED = 11  # better than a fail
ERRORS = 12  # worse than a fail
INTERNAL = 70  # EX_SOFTWARE of sysexits.h
INTERRUPTED = 130  # 128 + SIGINT, as shells say it

_OF_VERDICT = {
    "pass": ALL_PASS,
    "fail": FAILS,
    "inconclusive": UNDECIDED,
    "not_measured": UNDECIDED,
    "error": ERRORS,
}


def exit_code_of(verdicts: Iterable[Verdict]) -> int:
    """The code of the worst verdict of a job's columns."""
    from aadm_workbench.model import worst

    return _OF_VERDICT[worst(verdicts).value]


_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_BYTES = {"mb": 10**6, "mib": 2**20, "gb": 10**9, "gib": 2**30}
_SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}

LEAST_MEMORY_BYTES = 256 * 10**6
"""The packages alone take about as much; below it nothing could be checked."""
_UNITS_S = {"": 1.0, "s": 1.0, "ms": 1e-3, "min": 60.0}  # of a time


def calculate_in_one_thread() -> None:
    """Bind the libraries under numpy and scipy to one thread; to be called before either is imported.

    So the last bits of a sum do not depend on the machine's load or cores. The matrices here are small, so nothing is
    lost; columns are spread over processes instead.
    """
    os.environ.update(dict.fromkeys(_THREADS, "1"))


def is_in_one_thread() -> bool:
    """Whether this process was bound to one thread before it began."""
    return all(os.environ.get(name) == "1" for name in _THREADS)


def add_switches(parser: argparse.ArgumentParser, *, prints_json: str | None) -> None:
    """``--quiet``, ``--debug`` and, for a command that prints a table, ``--json``, which prints ``prints_json``."""
    if prints_json is not None:
        parser.add_argument("--json", action="store_true", help=f"print {prints_json} as JSON instead of a table")
    parser.add_argument(
        "--quiet", action="store_true", help="no progress and no table: errors and what --json asks for"
    )
    parser.add_argument("--debug", action="store_true", help="show where an internal error happened")


def spoken(asked: str | None) -> Language:
    """The language of what a command says: the one that was asked for, else the environment's, as gettext finds it."""
    if asked in {"en", "zh"}:
        return "zh" if asked == "zh" else "en"
    settings = (os.environ.get(name) for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"))
    return "zh" if next(filter(None, settings), "").startswith("zh") else "en"


def _wrong(code: str, text: str, **values: str) -> argparse.ArgumentTypeError:
    """What is wrong with an argument, by a sentence of the table; argparse hands on its English alone."""
    from aadm_workbench.model import Reason

    return argparse.ArgumentTypeError(Reason(code, value=repr(text), **values))


def port(text: str) -> int:
    """A TCP port."""
    if not text.isdecimal() or not 0 < int(text) < 2**16:
        raise _wrong("command.usage.port", text)
    return int(text)


def whole_number(text: str) -> int:
    """A whole number above zero."""
    if not text.isdecimal() or int(text) == 0:
        raise _wrong("command.usage.whole_number", text)
    return int(text)


def length(text: str) -> float:
    """A length above zero."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0.0):
        raise _wrong("command.usage.length", text)
    return value


def memory_size(text: str) -> int:
    """A size of memory with its unit, in bytes."""
    size = int(_quantity(text, _BYTES, "command.usage.limit", "2GB or 600MB"))
    if size < LEAST_MEMORY_BYTES:
        raise _wrong("command.usage.memory", text)
    return size


def time_span(text: str) -> float:
    """A time with its unit, in seconds."""
    return _quantity(text, _SECONDS, "command.usage.limit", "90s, 15min or 1h")


def duration(text: str) -> float:
    """A time, in seconds: 2, 2s, 500ms, 1min."""
    return _quantity(text, _UNITS_S, "command.usage.time", "2s, 500ms or 1min")


def _quantity(text: str, units: dict[str, float] | dict[str, int], code: str, example: str) -> float:
    found = re.fullmatch(r"(\d+(?:\.\d+)?)\s*([a-z]*)", text.strip().lower())
    unit = units.get(found[2]) if found else None
    if found is None or unit is None or float(found[1]) == 0.0:
        raise _wrong(code, text, example=example)
    return float(found[1]) * unit


_STEERING = re.compile(
    # Control characters; surrogates; line separators; marks that change the direction of what follows.
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]"
)


def printable(text: str) -> str:
    r"""The text with control characters as ``\x1b`` and the like; line breaks and tabs stay."""
    return _STEERING.sub(lambda found: _spelt(found[0]), text)


def steering_character(text: str, *, but: str = "") -> str | None:
    """The first character of a text that must not reach a terminal, or breaks a line, spelt out; None without one."""
    found = next((sign for sign in text if sign not in but and (sign in "\n\t" or _STEERING.match(sign))), None)
    return None if found is None else f"U+{ord(found):04X}"


def _spelt(sign: str) -> str:
    return f"\\x{ord(sign):02x}" if ord(sign) < 0x100 else f"\\u{ord(sign):04x}"
