"""The text of a STEP file, changed line by line: what is not touched keeps its bytes.

A model written anew by a library comes back with other number formats and another order, and with the names of raw
Chinese files re-encoded; a coordinator who compares two versions would then see every line as changed.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

# Strings and comments may hold semicolons. In UTF-8, GB 18030 and Shift-JIS no second byte is a quote, a semicolon or
# a slash, so bytes can be read without knowing which it is.
_STATEMENT = re.compile(rb"(?:[^';/]++|'[^']*+'|/\*.*?\*/|/)*+;", re.DOTALL)
_SKIPPED = re.compile(rb"(?:\s++|/\*.*?\*/)*+", re.DOTALL)
_NUMBER = re.compile(rb"#(\d+)\s*=")
_LINE_BREAK = re.compile(rb"\r?\n")


@dataclass(frozen=True)
class StepText:
    """A STEP file and where in it each entity stands: from its ``#`` to behind its semicolon."""

    content: bytes
    places: Mapping[int, tuple[int, int]]
    end_of_data: int
    line_break: bytes

    def statement(self, number: int) -> bytes:
        """The text of one entity, ``#12=IFCWALL(...);``."""
        begin, end = self.places[number]
        return self.content[begin:end]

    def edited(
        self,
        *,
        replaced: Mapping[int, bytes] | None = None,
        removed: Collection[int] = (),
        appended: Iterable[bytes] = (),
    ) -> Iterator[bytes]:
        """The file in parts, some entities replaced, some taken out with their line, and some put in at the end."""
        edits = {self.places[number]: text for number, text in (replaced or {}).items()}
        for number in removed:
            begin, end = self.places[number]
            line_break = _LINE_BREAK.match(self.content, end)
            edits[begin, line_break.end() if line_break else end] = b""
        at_end = (self.end_of_data, self.end_of_data)
        done = 0
        for begin, end in sorted([*edits, at_end]):
            yield self.content[done:begin]
            if (begin, end) == at_end:
                for line in appended:
                    yield line
                    yield self.line_break
            else:
                yield edits[begin, end]
            done = end
        yield self.content[done:]


def step_text(content: bytes) -> StepText:
    """Find every entity of a STEP file that ifcopenshell has read already."""
    places: dict[int, tuple[int, int]] = {}
    end_of_data = len(content)
    for found in _STATEMENT.finditer(content):
        skipped = _SKIPPED.match(content, found.start())
        begin = skipped.end() if skipped else found.start()
        number = _NUMBER.match(content, begin)
        if number:
            places.setdefault(int(number[1]), (begin, found.end()))  # of two with one number the first counts
        elif content[begin : found.end() - 1].strip().upper() == b"ENDSEC":
            end_of_data = begin
    first_break = _LINE_BREAK.search(content)
    return StepText(content, places, end_of_data, first_break[0] if first_break else b"\n")


def numbered_once(content: bytes) -> bytes:
    """The file without entities whose number an earlier one has, their lines left empty."""
    seen: set[bytes] = set()
    pieces, done = [], 0
    for found in _STATEMENT.finditer(content):
        skipped = _SKIPPED.match(content, found.start())
        begin = skipped.end() if skipped else found.start()
        number = _NUMBER.match(content, begin)
        if number and number[1] in seen:
            pieces += [content[done:begin], b"\n" * content.count(b"\n", begin, found.end())]
            done = found.end()
        elif number:
            seen.add(number[1])
    return b"".join([*pieces, content[done:]])
