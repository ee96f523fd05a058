"""Zip archives that lie: every field of their structure can be another one than the content asks for."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass, field

import numpy as np

_LOCAL = struct.Struct("<4s5H3L2H")
_LISTED = struct.Struct("<4s6H3L5H2L")
_END = struct.Struct("<4s4H2LH")
_ODD_NUMBERS = (0, 1, 9, 255, 65535, 2**31 - 1, 2**31, 2**32 - 1)
_ODD_NAMES = ("", "..", "../../x", "/etc/x", "C:x", "a" * 3000, "markup.bcf", "柱", "a\x00b", "a\\..\\..\\b", "x/")


@dataclass
class Entry:
    """An entry, and what its two headers say instead of the truth: by the name of the field."""

    name: str
    content: bytes
    method: int = 8
    lies: dict[str, int] = field(default_factory=dict)
    listed: int = 1

    def packed(self) -> bytes:
        """The content as it stands in the archive."""
        if self.method != 8:
            return self.content
        packer = zlib.compressobj(6, zlib.DEFLATED, -15)
        return packer.compress(self.content) + packer.flush()

    def said(self, what: str, truth: int) -> int:
        """The value of a field, as far as the field can hold it."""
        most = 0xFFFF if what in {"flags", "method", "extra"} else 0xFFFFFFFF
        return self.lies.get(what, truth) & most


def written(entries: list[Entry], end: dict[str, int], comment: bytes = b"") -> bytes:
    """The archive."""
    body, listing, count = b"", b"", 0
    for entry in entries:
        name, packed, at = entry.name.encode()[:65535], entry.packed(), len(body)
        said = (
            entry.said("flags", 0),
            entry.said("method", entry.method),
            0,
            33,
            entry.said("crc", zlib.crc32(entry.content)),
            entry.said("packed", len(packed)),
            entry.said("unpacked", len(entry.content)),
            len(name),
            entry.said("extra", 0),
        )
        body += _LOCAL.pack(b"PK\x03\x04", 20, *said) + name + packed
        line = _LISTED.pack(b"PK\x01\x02", 20, 20, *said, 0, 0, 0, 0, entry.said("offset", at)) + name
        listing += line * entry.listed
        count += entry.listed
    fields = {"count": count & 0xFFFF, "list_bytes": len(listing), "list_at": len(body)} | end
    numbers = (fields["count"] & 0xFFFF, fields["list_bytes"] & 0xFFFFFFFF, fields["list_at"] & 0xFFFFFFFF)
    tail = _END.pack(b"PK\x05\x06", 0, 0, numbers[0], numbers[0], numbers[1], numbers[2], len(comment) & 0xFFFF)
    return body + listing + tail + comment


def harmed(entries: list[Entry], rng: np.random.Generator) -> bytes:
    """An archive of these entries that was harmed in one to four ways."""
    entries = [Entry(entry.name, entry.content, entry.method) for entry in entries]
    end: dict[str, int] = {}
    for _ in range(int(rng.integers(1, 5))):
        entry = entries[int(rng.integers(len(entries)))]
        match int(rng.integers(9)):
            case 0:
                what = ("flags", "method", "crc", "packed", "unpacked", "extra", "offset")[int(rng.integers(7))]
                entry.lies[what] = _odd(rng)
            case 1:
                entry.name = _ODD_NAMES[int(rng.integers(len(_ODD_NAMES)))]
            case 2:
                entries.append(Entry(entry.name, entry.content, entry.method))
            case 3:
                end[("count", "list_bytes", "list_at")[int(rng.integers(3))]] = _odd(rng)
            case 4:
                entry.listed = int(rng.choice([0, 2, 500, 100_000]))
            case 5:
                entry.method = int(rng.choice([0, 8, 9, 12, 14, 93, 99]))
            case 6:
                entry.content = bytes(int(rng.choice([0, 2**20, 2**26])))
            case _:
                entry.content = harmed_text(entry.content, rng)
    return _scratched(written(entries, end), rng)


def harmed_text(content: bytes, rng: np.random.Generator) -> bytes:
    """A text, of XML or any other, that was cut, doubled, nested, spoilt or given another encoding."""
    at, size = int(rng.integers(len(content) + 1)), int(rng.integers(1, 64))
    match int(rng.integers(8)):
        case 0:
            return content[:at]
        case 1:
            return content[:at] + content[at + size :]
        case 2:
            return content[:at] + content[at : at + size] * int(rng.choice([2, 1000])) + content[at:]
        case 3:
            deep = int(rng.choice([10, 1000, 100_000]))
            return content[:at] + b"<a>" * deep + b"</a>" * deep + content[at:]
        case 4:
            return b"<!DOCTYPE a [<!ENTITY b 'bbbb'><!ENTITY c '&b;&b;&b;'>]>" + content
        case 5:
            return content.decode("utf-8", errors="replace").encode("utf-16")
        case 6:
            return content[:at] + b"\x00\xff\xfe&#0;]]>" + content[at:]
        case _:
            return content[:at] + rng.bytes(size) + content[at + size :]


def _odd(rng: np.random.Generator) -> int:
    return int(rng.choice(_ODD_NUMBERS)) if rng.random() < 0.7 else int(rng.integers(2**32))


def _scratched(content: bytes, rng: np.random.Generator) -> bytes:
    """Some bytes changed, or the end cut off, now and then."""
    if rng.random() < 0.2:
        return content[: int(rng.integers(len(content) + 1))]
    spoilt = bytearray(content)
    for _ in range(int(rng.integers(3)) if rng.random() < 0.3 else 0):
        spoilt[int(rng.integers(len(spoilt)))] = int(rng.integers(256))
    return bytes(spoilt)
