"""Mutations of IFC models that know what a STEP file is made of, so that most of them get past the parser."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from tests.fuzz.dice import Dice

_NUMBERS = (
    "0",
    "0.",
    "-1",
    "-1.",
    "1E308",
    "-1E308",
    "1E-320",
    "1E19",
    "4294967296",
    "-2147483649",
    "1E12",
    "99999999",
)
_WORDS = (
    *("''", "'\\X\\B9\\X\\E0'", "'C:\\Users\\x'", "'\\X2\\D83D\\X0\\'", "'灌'", "'%s%n'", "'1E999'", "' '"),
    *("$", "*", "()", "(())", "((),())", ".T.", ".U.", ".NOTDEFINED.", ".XYZ.", "IFCLABEL('x')", "IFCREAL(1E308)"),
)
_CLASSES = (
    *("IFCCOLUMN", "IFCWALL", "IFCREINFORCINGBAR", "IFCDISCRETEACCESSORY", "IFCELEMENTASSEMBLY", "IFCPOLYLINE"),
    *("IFCCARTESIANPOINT", "IFCDIRECTION", "IFCLOCALPLACEMENT", "IFCMAPPEDITEM", "IFCBOOLEANRESULT", "IFCSPHERE"),
    *("IFCRIGHTCIRCULARCONE", "IFCHALFSPACESOLID", "IFCCOMPOSITECURVE", "IFCTRIMMEDCURVE", "IFCEXTRUDEDAREASOLID"),
    *("IFCSWEPTDISKSOLID", "IFCFACETEDBREP", "IFCRELAGGREGATES", "IFCPROPERTYSET", "IFCGRIDPLACEMENT", "IFCBLOCK"),
)
_NUMBER = re.compile(r"(?<![\w#.'\\])-?\d+\.?\d*(?:E[+-]?\d+)?(?![\w'])")
_REFERENCE = re.compile(r"#\d+")
_WORD = re.compile(r"'(?:[^']|'')*'|\.[A-Z_0-9]+\.|\$")
_LIST = re.compile(r"\([^()]*\)")
_CLASS = re.compile(r"(?<==)[A-Z0-9]+(?=\()")

Change = Callable[[Dice, list[str]], None]


def mutated(seed: bytes, rng: Dice) -> bytes:
    """A model with one to four changes, or rarely with damaged bytes."""
    lines = seed.decode("ascii").split("\n")
    for _ in range(rng.choice((1, 1, 1, 2, 2, 3, 4))):
        rng.choice(_CHANGES)(rng, lines)
    content = "\n".join(lines).encode("utf-8", "replace")
    return _damaged(content, rng) if rng.number() < 0.08 else content


def _entities(lines: Sequence[str]) -> list[int]:
    return [place for place, line in enumerate(lines) if line.startswith("#")]


def _place(rng: Dice, lines: Sequence[str]) -> int:
    """A line, of rare classes as often as of frequent ones."""
    of_class: dict[str, list[int]] = {}
    for place in _entities(lines):
        of_class.setdefault(lines[place].partition("=")[2].partition("(")[0], []).append(place)
    return rng.choice(of_class[rng.choice(sorted(of_class))]) if of_class else 0


def _replaced(rng: Dice, line: str, what: re.Pattern[str], by: str) -> str:
    found = list(what.finditer(line, line.find("(")))
    if not found:
        return line
    one = rng.choice(found)
    return f"{line[: one.start()]}{by}{line[one.end() :]}"


def _number(rng: Dice, lines: list[str]) -> None:
    place = _place(rng, lines)
    lines[place] = _replaced(rng, lines[place], _NUMBER, rng.choice(_NUMBERS))


def _same_numbers(rng: Dice, lines: list[str]) -> None:
    """All numbers of an entity alike: coincident points, lines without length."""
    place = _place(rng, lines)
    head, bracket, tail = lines[place].partition("(")
    lines[place] = head + bracket + _NUMBER.sub(rng.choice(("0.", "1.")), tail)


def _reference(rng: Dice, lines: list[str]) -> None:
    place = _place(rng, lines)
    own = lines[place].partition("=")[0]
    other = lines[rng.choice(_entities(lines) or [0])].partition("=")[0]
    lines[place] = _replaced(rng, lines[place], _REFERENCE, rng.choice((own, other, other, "#999999", "$")))


def _loop(rng: Dice, lines: list[str]) -> None:
    """What an entity refers to refers back to it."""
    place = _place(rng, lines)
    own = lines[place].partition("=")[0]
    named = _REFERENCE.findall(lines[place].partition("=")[2])
    behind = [k for k in _entities(lines) if named and lines[k].startswith(f"{rng.choice(named)}=")]
    if behind:
        lines[behind[0]] = _replaced(rng, lines[behind[0]], _REFERENCE, own)


def _word(rng: Dice, lines: list[str]) -> None:
    place = _place(rng, lines)
    lines[place] = _replaced(rng, lines[place], _WORD, rng.choice(_WORDS))


def _list(rng: Dice, lines: list[str]) -> None:
    place = _place(rng, lines)
    found = _LIST.findall(lines[place])
    inner = rng.choice(found) if found else "()"
    lines[place] = _replaced(rng, lines[place], _LIST, rng.choice(("()", "$", f"({inner},{inner})", inner[:-1] + ",)")))


def _class(rng: Dice, lines: list[str]) -> None:
    place = _place(rng, lines)
    others = [
        line.partition("=")[2].partition("(")[0] for line in [rng.choice(lines) for _ in range(20)] if "=" in line
    ]
    lines[place] = _CLASS.sub(rng.choice([*_CLASSES, *others]), lines[place], count=1)


def _dropped(rng: Dice, lines: list[str]) -> None:
    del lines[_place(rng, lines)]


def _doubled(rng: Dice, lines: list[str]) -> None:
    """A second entity of the same number."""
    place = _place(rng, lines)
    other = lines[_place(rng, lines)].partition("=")[2]
    lines.insert(_place(rng, lines), f"{lines[place].partition('=')[0]}={other}")


def _arguments(rng: Dice, lines: list[str]) -> None:
    """An argument too few or too many."""
    place = _place(rng, lines)
    line = lines[place]
    lines[place] = rng.choice((line.replace(",", "", 1), line.replace(");", ",$);"), re.sub(r",[^,]*\);", ");", line)))


def _header(rng: Dice, lines: list[str]) -> None:
    place = rng.below(min(7, len(lines)))
    lines[place] = _replaced(rng, lines[place], _WORD, rng.choice(("'IFC4X3'", "'IFC5'", "()", "'IFC2X2'", *_WORDS)))


_CHANGES: tuple[Change, ...] = (
    *(6 * (_number, _reference)),
    *(3 * (_loop, _word, _list, _class)),
    *(2 * (_same_numbers, _arguments)),
    *(_dropped, _doubled, _header),
)
"""The frequent ones several times."""


def _damaged(content: bytes, rng: Dice) -> bytes:
    """Bytes cut off, repeated or overwritten."""
    held = bytearray(content)
    for _ in range(1 + rng.below(4)):
        at = rng.below(max(1, len(held)))
        held[at : at + rng.below(7)] = rng.choice((b"", b"'", b"(", b"\xb9\xe0", b"\\", bytes([rng.below(256)])))
    return bytes(held[: rng.below(len(held))]) if rng.number() < 0.2 else bytes(held)
