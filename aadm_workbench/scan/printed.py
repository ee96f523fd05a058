"""Printed text of cameras and their programs, as named numbers: ``fx: 2425.5``, matrices in rows, lists, tables.

What a program prints follows no grammar, but numbers follow their names. YAML, INI and what OpenCV, ROS, MATLAB and the
cameras' SDKs print are read alike.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from aadm_workbench.scan.distortion import plain

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"

_TOKEN = re.compile(rf"(?P<word>[^\W\d_]\w*)|(?P<number>{NUMBER})|(?P<colon>[:=])|(?P<comma>[,;])|(?P<line>\n)")
_SHAPE = re.compile(
    r"(?:!!opencv-matrix)?\s{0,40}(?:\b(?:rows|cols|dt)[ \t]{0,20}:[ \t]{0,20}\w{1,9}\s{1,40}){1,3}data[ \t]{0,20}:",
    re.IGNORECASE,
)
_INDEX = re.compile(r"\b([A-Za-z_]{1,40})[\[(](\d{1,2})[\])](?=[ \t]{0,20}[:=])")
_SIDES = re.compile(r"(?<=\d)[ \t]?[x×][ \t]?(?=\d)")
_PAIR_OF_WORDS = re.compile(r"[^,\d\n]{1,80},[^,\d\n]{1,80}")
_CAMERAS = {
    "depth": ("depth", "tiefe", "深度"),
    "texture": ("texture", "color", "colour", "rgb", "彩色", "纹理"),
}


@dataclass(frozen=True)
class Entry:
    """Numbers of a text and the words before them.

    ``camera`` is the one that was spoken of last, ``own_camera`` that of the words since the numbers before, both as
    :func:`kind_of` calls them.
    """

    camera: str
    own_camera: str
    words: tuple[str, ...]
    numbers: tuple[float, ...]

    @property
    def name(self) -> str:
        """The words in one, without capitals and signs."""
        return plain("".join(self.words))

    @property
    def last(self) -> str:
        """The last word, without capitals and signs."""
        return plain(self.words[-1]) if self.words else ""


def kind_of(label: str) -> str:
    """Return which of a device's cameras a label speaks of: "depth", "texture" or, where it does not say, ""."""
    small = label.lower()
    return next((kind for kind, words in _CAMERAS.items() if any(word in small for word in words)), "")


@dataclass
class _Reading:
    """Where the pass over a text has come to: the words and numbers since the last entry, and those of this line."""

    camera: str = ""
    own_camera: str = ""
    words: list[str] = field(default_factory=list)
    numbers: list[float] = field(default_factory=list)
    since_colon: int = 0
    has_colon: bool = False

    def taken(self) -> Iterator[Entry]:
        """Yield what was gathered, where it has numbers, and begin anew."""
        if self.numbers:
            entry = Entry(self.camera, self.own_camera, tuple(self.words), tuple(self.numbers))
            self.words, self.numbers, self.own_camera = [], [], ""
            yield from _by_columns(entry)


def entries_of(text: str) -> list[Entry]:
    """Return the numbers of a text in the order in which they are printed, each group with its words."""
    text = _SHAPE.sub(" ", text.replace("\r\n", "\n").replace("\r", "\n"))
    text = _SIDES.sub(" ", _INDEX.sub(r"\1\2", text))
    # A pair of words is a name and what it is set to, as in a table of two columns.
    text = "\n".join(line.replace(",", ":", 1) if _PAIR_OF_WORDS.fullmatch(line) else line for line in text.split("\n"))
    reading = _Reading()
    entries: list[Entry] = []
    for token in _TOKEN.finditer(text):
        entries.extend(_next(reading, str(token.lastgroup), token.group()))
    entries.extend(reading.taken())
    return entries


def _next(reading: _Reading, kind: str, text: str) -> Iterator[Entry]:
    if kind == "number":
        reading.numbers.append(float(text))
    elif kind == "word":
        yield from reading.taken()
        reading.words.append(text)
        reading.own_camera = kind_of(text) or reading.own_camera
        reading.camera = reading.own_camera or reading.camera
        reading.since_colon += 1
    elif kind == "colon":
        yield from reading.taken()
        reading.has_colon, reading.since_colon = True, 0
    else:
        if reading.has_colon and reading.since_colon and not reading.numbers:
            # What a name was set to is a word: no number follows.
            reading.words = []
        reading.has_colon, reading.since_colon = reading.has_colon and kind == "comma", 0


def _by_columns(entry: Entry) -> Iterator[Entry]:
    """Yield an entry; one with as many names as numbers is a table of one row."""
    if len(entry.words) == len(entry.numbers) > 1:
        for word, number in zip(entry.words, entry.numbers, strict=True):
            yield Entry(entry.camera, entry.own_camera, (word,), (number,))
    else:
        yield entry
