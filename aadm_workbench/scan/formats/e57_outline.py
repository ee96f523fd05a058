"""What an E57 file announces, read from its XML part before a library unpacks anything.

The file is cut into pages of 1024 bytes, the last four of each a checksum (ASTM E2807, 8.1). XML that declares
entities, is nested deeper or is longer than any exporter writes is refused.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass, field
from xml.parsers import expat

from aadm_workbench.model import Reason
from aadm_workbench.scan.file import LARGEST_POINT_COUNT, ScanFile

LONGEST_XML_BYTES = 2**24
"""The outline of a thousand scans with their poses takes a megabyte."""
MOST_SCANS = 1000
"""A survey has some hundred stations; more are a file that means harm."""

_SIGNATURE = b"ASTM-E57"
_PAGE_BYTES, _CHECKSUM_BYTES = 1024, 4  # of the format: each page ends with a checksum (ASTM E2807)
_DEEPEST_XML = 50  # the format's own nests a few deep
_BITS_OF_FLOAT = {"single": 32}
_BITS_OF_DOUBLE = 64  # of a float whose precision is not given (ASTM E2807)
_LARGEST_INTEGER = 2**63  # bounds of an integer whose own are not given (ASTM E2807)


@dataclass
class _Reading:
    """Where a pass over the XML has come to, and the largest scan so far."""

    path: list[str] = field(default_factory=list)
    scans: int = 0
    records: int = 0
    bits_of_record: int = 0
    announced: list[tuple[int, int]] = field(default_factory=list)


def check_outline(file: ScanFile) -> None:
    """Check that the scans that an E57 file announces can be in it.

    Raises
    ------
    ScanError
        For a file that is no E57 file or cut off, XML that no exporter writes, and more points than there is room for.
    """
    reading = _Reading()
    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = lambda *_: _refuse(file, Reason("formats.e57_doctype"))
    parser.EntityDeclHandler = lambda *_: _refuse(file, Reason("formats.e57_entities"))
    parser.StartElementHandler = lambda name, attributes: _start(file, reading, name, attributes)
    parser.EndElementHandler = lambda _: _end(reading)
    try:
        parser.Parse(_xml(file), True)
    except (expat.ExpatError, LookupError, ValueError) as error:
        raise file.wrong(Reason("formats.e57_xml", why=error)) from error
    for records, bits in reading.announced:
        if records > LARGEST_POINT_COUNT or records * bits > 8 * len(file.content):
            raise file.wrong(Reason("formats.e57_announces", records=records, bits=bits, size_bytes=len(file.content)))


def _xml(file: ScanFile) -> bytes:
    content = file.content
    if not content.startswith(_SIGNATURE):
        raise file.wrong(Reason("formats.no_e57"))
    if len(content) < 48:
        raise file.wrong(Reason("formats.ends_in_header", size_bytes=len(content)))
    file_bytes, xml_at, xml_bytes, page_bytes = struct.unpack_from("<QQQQ", content, 16)
    if page_bytes != _PAGE_BYTES:
        raise file.wrong(Reason("formats.e57_pages", page_bytes=page_bytes))
    if file_bytes > len(content):
        raise file.wrong(Reason("formats.e57_size", file_bytes=file_bytes, size_bytes=len(content)))
    if not (48 <= xml_at < file_bytes and 0 < xml_bytes <= LONGEST_XML_BYTES):
        raise file.wrong(Reason("formats.e57_xml_place", xml_bytes=xml_bytes, xml_at=xml_at))
    text = bytearray()
    position = xml_at
    while len(text) < xml_bytes and position < len(content):
        page_end = (position // _PAGE_BYTES + 1) * _PAGE_BYTES
        text += content[position : page_end - _CHECKSUM_BYTES]
        position = page_end
    return bytes(text[:xml_bytes])


def _refuse(file: ScanFile, what: str) -> None:
    raise file.wrong(Reason("formats.e57_harm", what=what))


def _start(file: ScanFile, reading: _Reading, name: str, attributes: dict[str, str]) -> None:
    reading.path.append(name)
    if len(reading.path) > _DEEPEST_XML:
        _refuse(file, Reason("formats.e57_deep", most=_DEEPEST_XML))
    above = reading.path[-2] if len(reading.path) > 1 else ""
    if attributes.get("type") == "CompressedVector":
        reading.records, reading.bits_of_record = _whole(attributes.get("recordCount", "0")), 0
    elif above == "prototype":
        reading.bits_of_record += _bits(attributes)
    elif above == "data3D":
        reading.scans += 1
        if reading.scans > MOST_SCANS:
            _refuse(file, Reason("formats.e57_many", most=MOST_SCANS))


def _end(reading: _Reading) -> None:
    if reading.path.pop() == "prototype":
        reading.announced.append((reading.records, reading.bits_of_record))


def _bits(attributes: dict[str, str]) -> int:
    """Return the bits that one value takes: those of a float, or of the range of an integer."""
    kind = attributes.get("type", "")
    if kind == "Float":
        return _BITS_OF_FLOAT.get(attributes.get("precision", "double"), _BITS_OF_DOUBLE)
    if kind not in ("Integer", "ScaledInteger"):
        return 0
    lowest = _whole(attributes.get("minimum", str(-_LARGEST_INTEGER)))
    highest = _whole(attributes.get("maximum", str(_LARGEST_INTEGER - 1)))
    return math.ceil(math.log2(highest - lowest + 1)) if highest > lowest else 0


def _whole(text: str) -> int:
    """Return a whole number of the XML.

    Raises
    ------
    ValueError
        For a text that is none, or longer than any.
    """
    if len(text) > 40:
        raise ValueError(Reason("formats.digits", count=len(text)))
    return int(text)
