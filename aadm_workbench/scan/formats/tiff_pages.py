"""The pages of a TIFF file, read from its directories without unpacking anything; one page of it as a file of its own.

Tags: Adobe, TIFF revision 6.0; BigTIFF as the Aware Systems' proposal has it.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from aadm_workbench.model import Reason

SIGNATURES = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
MOST_PAGES = 10_000  # scanners save some; it bounds the time

_MOST_ENTRIES = 4096  # a directory has twenty; so many take no time
_VALUE_FORMATS = {3: "H", 4: "I", 16: "Q"}
_TEXT = 2  # field type of TIFF 6.0
_SUBFILE, _WIDTH, _HEIGHT, _BITS, _COMPRESSION, _PHOTOMETRIC = 254, 256, 257, 258, 259, 262  # tags of TIFF 6.0
_DESCRIPTION, _ORIENTATION, _SAMPLES, _PAGE_NAME, _SAMPLE_FORMAT = 270, 274, 277, 285, 339  # tags of TIFF 6.0
# of TIFF 6.0
_DEFAULTS = {_SUBFILE: 0, _BITS: 1, _COMPRESSION: 1, _PHOTOMETRIC: 1, _ORIENTATION: 1, _SAMPLES: 1, _SAMPLE_FORMAT: 1}
_REDUCED_OR_MASK = 0b101  # bits of the subfile type
_PALETTE, _FLOATING = 3, 3  # values of photometric interpretation and of sample format
_UPRIGHT = 1  # first row at the top


@dataclass(frozen=True)
class Page:
    """One page: its size and type, what it is called, and where in the file it says so.

    Parameters
    ----------
    number
        From 1 on.
    samples, bits, is_float
        Values of a pixel and what each is.
    compression, orientation
        Numbers of the tags of that name.
    is_secondary
        Whether it is a smaller copy of another page, or its mask.
    is_palette
        Whether its values are places in a table of colours.
    name
        Its name and description, as far as they are short.
    at, orientation_at, next_at
        Byte offsets of its directory, of the value of its orientation (0 without one), and of the offset of the next
        directory.
    """

    number: int
    width: int
    height: int
    samples: int
    bits: int
    is_float: bool
    compression: int
    orientation: int
    is_secondary: bool
    is_palette: bool
    name: str
    at: int
    orientation_at: int
    next_at: int


@dataclass(frozen=True)
class _Form:
    """How a file writes its numbers: byte order, and offsets of 32 or 64 bits."""

    order: str
    is_big: bool

    @property
    def offset(self) -> str:
        return self.order + ("Q" if self.is_big else "I")


def pages_of(content: bytes) -> list[Page]:
    """Return the pages of a TIFF file in their order, as far as its directories can be followed.

    Raises
    ------
    struct.error, KeyError, OverflowError
        For a file that ends or breaks off within its first directory, or lacks the size of a page.
    """
    form = _form(content)
    at: int = struct.unpack_from(form.offset, content, _first_at(form))[0]
    pages = [_page(content, form, at, 1)]
    seen = {0}
    while pages[-1].next_at and len(pages) < MOST_PAGES:
        seen.add(at)
        at = struct.unpack_from(form.offset, content, pages[-1].next_at)[0]
        if at in seen:
            break
        try:
            pages.append(_page(content, form, at, len(pages) + 1))
        except (struct.error, KeyError, OverflowError):
            break
    return pages


def alone(content: bytes, page: Page) -> bytes:
    """Return a file with one page alone, whose pixels stand as they are stored, whatever its orientation says."""
    form = _form(content)
    first_at = _first_at(form)
    is_first = struct.unpack_from(form.offset, content, first_at)[0] == page.at
    is_last = not page.next_at or struct.unpack_from(form.offset, content, page.next_at)[0] == 0
    if is_first and is_last and page.orientation == _UPRIGHT:
        return content
    changed = bytearray(content)
    struct.pack_into(form.offset, changed, first_at, page.at)
    if page.next_at:
        struct.pack_into(form.offset, changed, page.next_at, 0)
    if page.orientation_at:
        struct.pack_into(form.order + "H", changed, page.orientation_at, _UPRIGHT)
    return bytes(changed)


def _form(content: bytes) -> _Form:
    return _Form("<" if content[:2] == b"II" else ">", content[2:4] in (b"+\0", b"\0+"))


def _first_at(form: _Form) -> int:
    return 8 if form.is_big else 4


def _page(content: bytes, form: _Form, at: int, number: int) -> Page:
    if at > len(content):
        raise struct.error(Reason("formats.tiff_directory"))
    count = struct.unpack_from(form.order + ("Q" if form.is_big else "H"), content, at)[0]
    first, step, value_at = (at + 8, 20, 12) if form.is_big else (at + 2, 12, 8)
    values, places, name = dict(_DEFAULTS), {}, ""
    for entry in range(first, first + min(count, _MOST_ENTRIES) * step, step):
        tag, kind = struct.unpack_from(form.order + "HH", content, entry)
        if tag in _DEFAULTS or tag in (_WIDTH, _HEIGHT):
            values[tag], places[tag] = _value(content, form, entry, kind, value_at)
        elif tag in (_DESCRIPTION, _PAGE_NAME) and kind == _TEXT:
            name += _text(content, form, entry, value_at)
    end = first + count * step
    return Page(
        number,
        values[_WIDTH],
        values[_HEIGHT],
        values[_SAMPLES],
        values[_BITS],
        values[_SAMPLE_FORMAT] == _FLOATING,
        values[_COMPRESSION],
        values[_ORIENTATION],
        bool(values[_SUBFILE] & _REDUCED_OR_MASK),
        values[_PHOTOMETRIC] == _PALETTE,
        name,
        at,
        places.get(_ORIENTATION, 0),
        end if end + struct.calcsize(form.offset) <= len(content) else 0,
    )


def _value(content: bytes, form: _Form, entry: int, kind: int, value_at: int) -> tuple[int, int]:
    """Return the first value of an entry and where it stands: in the entry, or where the entry says."""
    letter = _VALUE_FORMATS[kind]
    _, place = _extent(content, form, entry, struct.calcsize(letter), value_at)
    return struct.unpack_from(form.order + letter, content, place)[0], place


def _text(content: bytes, form: _Form, entry: int, value_at: int) -> str:
    count, place = _extent(content, form, entry, 1, value_at)
    return content[place : place + min(count, 400)].partition(b"\0")[0].decode("utf-8", errors="replace") + " "


def _extent(content: bytes, form: _Form, entry: int, item_bytes: int, value_at: int) -> tuple[int, int]:
    """Return how many items an entry has and where the first one stands."""
    count: int = struct.unpack_from(form.offset, content, entry + 4)[0]
    room = 8 if form.is_big else 4
    if count * item_bytes <= room:
        return count, entry + value_at
    return count, int(struct.unpack_from(form.offset, content, entry + value_at)[0])
