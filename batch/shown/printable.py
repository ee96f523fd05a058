"""Text from files of others, made safe to show: what could steer a terminal or turn a line around is spelt out."""

from __future__ import annotations

import re

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
