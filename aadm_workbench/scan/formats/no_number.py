"""What programs print where there is no number: ``1.#QNAN``, ``-nan(ind)``, ``#N/A``; read as NaN, no measurement.

Microsoft's runtime printed ``1.#QNAN``, ``-1.#IND`` and ``1.#INF`` until 2013, cut to the digits that were asked for
(``1.#J``, ``-1.#IO``), and prints ``-nan(ind)`` since.
"""

from __future__ import annotations

import math
import re

_WITH_SIGN = re.compile(rb"[-+]?\d\.[#$]\w*|#(?:N/?A|NUM!|VALUE!|DIV/0!|REF!|NAME\?|NULL!|NV|ZAHL!|WERT!)")
_WORDS = re.compile(
    rb"(?<![^\s,;])(?:[-+]?s?q?nan[sq]?(?:\s?\([^()\s]{0,20}\))?|n/?a|null|none|nil|invalid|(?:---?))(?![^\s,;])",
    re.IGNORECASE,
)


def without_signs(body: bytes) -> bytes:
    """Return rows in which what has a ``#`` and is no comment is "nan", before anybody takes it for one."""
    return _WITH_SIGN.sub(b"nan", body) if b"#" in body or b".$" in body else body


def without_words(body: bytes) -> bytes:
    """Return rows in which all that programs write for no number is "nan"."""
    return _WORDS.sub(b"nan", without_signs(body))


def number_in(field: str) -> float | None:
    """Return the number in a field, NaN where it says that there is none, None where it is something else."""
    text = without_words(field.strip().strip("\"'").encode()).decode()
    try:
        return float(text)
    except ValueError:
        return None


def is_finite(field: str) -> bool:
    """Whether a field holds a number that is one."""
    value = number_in(field)
    return value is not None and math.isfinite(value)


def is_none(field: str) -> bool:
    """Whether a field says that there is no number."""
    return number_in(field) is not None and not is_finite(field)
