"""The text of an IFC file as exporters write it, made what a strict parser reads: encodings, backslashes, schemas."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from aadm_workbench.design.ifc.text.encoding import CALLED, ENCODINGS, Evidence, decoded, weigh
from aadm_workbench.model import Reason

_BYTE_STRING = re.compile(rb"/\*.*?\*/|'[^']*+'", re.DOTALL)
_STRING = re.compile(r"/\*.*?\*/|'[^']*+'", re.DOTALL)
"""Strings, and comments, in which quotes mean nothing. In none of ENCODINGS a second byte is a quote."""

_DIRECTIVE = re.compile(
    r"\\(?:\\|S\\[ -~]|P[A-I]\\|N\\|X\\[0-9A-Fa-f]{2}"
    r"|X2\\(?:[0-9A-Fa-f]{4})++\\X0\\|X4\\(?:[0-9A-Fa-f]{8})++\\X0\\)?"
)
"""What a backslash may begin (ISO 10303-21, 6.4.3). One that begins nothing is a path's, and is meant as it is."""

_PLAIN = re.compile(rb"(?:[^\\]++|\\\\|\\N\\|\\X2\\(?:[0-9A-Fa-f]{4})++\\X0\\|\\X4\\(?:[0-9A-Fa-f]{8})++\\X0\\)*+")
"""A file whose backslashes begin directives that need no reading of ours: no code pages, no bytes."""

_BYTES = re.compile(r"(?:[ -&(-\[\]-~]|\\\\|\\X\\[0-9A-Fa-f]{2}|\\S\\[ -~])+")
_BYTE = re.compile(r"\\X\\([0-9A-Fa-f]{2})|\\S\\(.)|(\\\\|[^\\]+)")
_PAGE = re.compile(r"\\P[A-I]\\")
_NOT_ASCII = re.compile(r"[^\x00-\x7f]+")
_HEADER = re.compile(r"HEADER\s*;(?P<entries>(?:'[^']*+'|/\*.*?\*/|[^'])*?)ENDSEC\s*;", re.DOTALL | re.IGNORECASE)
_SCHEMA = re.compile(r"FILE_SCHEMA\s*\(\s*\((?P<names>[^)]*)\)\s*\)", re.IGNORECASE)
_BLANK = re.compile(r"('[^']*+')|/\*.*?\*/|\s+", re.DOTALL)
_TEXTS = r"\((?:'[^']*+',?)++\)"
_PLAIN_ENTRIES = re.compile(
    rf"FILE_DESCRIPTION\({_TEXTS},'[^']*+'\);FILE_NAME\((?:(?:'[^']*+'|\$|{_TEXTS}),?)++\);"
    r"FILE_SCHEMA\(\('[^']*+'\)\);",
    re.IGNORECASE,
)
_ENTRIES = "FILE_DESCRIPTION((''),'2;1');FILE_NAME('','',(''),(''),'','','');FILE_SCHEMA(('{}'));"
_HEADER_CHARACTERS = 65536  # headers have some hundred

_MEANT_BY_STEP = 12.0
"""Log odds that escaped bytes are what the standard says, Latin letters, and not those of a code page."""

_FAMILIES = (
    (re.compile(r"IFC2X3([_ ].*)?"), ("IFC2X3",)),
    (re.compile(r"IFC4([_ ].*|X[12]([_ ].*)?)?"), ("IFC4",)),
    (re.compile(r"IFC4X3([_ ].*)?"), ("IFC4X3_ADD2", "IFC4X3_ADD1", "IFC4X3")),
)
"""Identifiers of published versions, and the one of each family that columns, sleeves and bars are read by."""


@dataclass(frozen=True)
class PreparedText:
    """A STEP file in ASCII, line by line as it was; ``notes`` say what was not as STEP wants it.

    ``schema`` is what its header names, None where it names none.
    """

    content: bytes
    notes: tuple[str, ...]
    schema: str | None


def prepared(content: bytes, schemas: Sequence[str]) -> PreparedText:
    """The same file as a strict parser reads it.

    Parameters
    ----------
    content
        All bytes of the file.
    schemas
        Identifiers that the parser knows.
    """
    if (schema := _schema_of_plain(content, schemas)) is not None:
        return PreparedText(content, (), schema)
    notes: list[str] = []
    text = _text(content, notes)
    if "\\X\\" in text or "\\S\\" in text:
        text = _with_code_pages(text, notes)
    if "\\" in text:
        text = _with_plain_backslashes(text, notes)
    text, schema = _with_header(text, schemas, notes)
    if not text.isascii():
        text = _NOT_ASCII.sub(escaped, text)
    return PreparedText(text.encode("ascii"), tuple(notes), schema)


def _schema_of_plain(content: bytes, schemas: Sequence[str]) -> str | None:
    """The schema of a file in which nothing is to be changed, for a copy of a large one takes its time and memory."""
    if not content.isascii() or not _PLAIN.fullmatch(content):
        return None
    notes: list[str] = []
    header = content[:_HEADER_CHARACTERS].decode("ascii")
    text, schema = _with_header(header, schemas, notes)
    return schema if text == header and not notes else None


def escaped(found: re.Match[str]) -> str:
    """Characters beyond ASCII as STEP wants them."""
    text = found.group()
    if max(text) > "\uffff":
        return f"\\X4\\{text.encode('utf-32-be', 'replace').hex().upper()}\\X0\\"
    return f"\\X2\\{text.encode('utf-16-be', 'surrogatepass').hex().upper()}\\X0\\"


def _text(content: bytes, notes: list[str]) -> str:
    """The file as text: by its byte order mark, else in the encoding that its names are most likely in."""
    for mark, encoding in ((b"\xef\xbb\xbf", "utf-8"), (b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be")):
        if content.startswith(mark):
            content = content[len(mark) :]
            if encoding != "utf-8":
                notes.append(Reason("ifc.encoding", encoding=encoding))
                return content.decode(encoding, "replace")
    if content.isascii():
        return content.decode("ascii")
    evidence = weigh(name for name in _BYTE_STRING.findall(content) if not name.isascii())
    notes.append(_written("ifc.raw", evidence))
    if evidence.best == "utf-8":
        try:
            return content.decode("utf-8")
        except UnicodeDecodeError:
            pass
    return _read_string_by_string(content, evidence, notes)


def _read_string_by_string(content: bytes, evidence: Evidence, notes: list[str]) -> str:
    pieces: list[str] = []
    others = done = 0
    for found in _BYTE_STRING.finditer(content):
        if found.group().isascii():
            continue
        text, is_other = decoded(found.group(), evidence.ranked)
        others += is_other
        pieces += [content[done : found.start()].decode("latin-1"), text]
        done = found.end()
    if others:
        notes.append(Reason("ifc.other_encoding", others=others, best=_called(evidence.best)))
    return "".join([*pieces, content[done:].decode("latin-1")])


def _with_code_pages(text: str, notes: list[str]) -> str:
    r"""Names whose bytes an exporter escaped one by one (``\X\B9\X\E0``) in another code page than STEP means."""
    names = {_unescaped(piece) for name in _STRING.findall(text) for piece in _escaped_bytes(name)}
    evidence = weigh(sorted(names), ("latin-1", *ENCODINGS), "latin-1", _MEANT_BY_STEP)
    if evidence.best == "latin-1" or not names or _PAGE.search(text):
        return text
    notes.append(_written("ifc.escaped", evidence))

    def read(piece: re.Match[str]) -> str:
        is_bytes = _is_escaped_bytes(piece.group())
        return decoded(_unescaped(piece.group()), evidence.ranked)[0] if is_bytes else piece.group()

    return _STRING.sub(lambda name: _BYTES.sub(read, name.group()), text)


def _escaped_bytes(name: str) -> Iterator[str]:
    """Parts of a name that hold escaped bytes, with the ASCII around them: second bytes may be ASCII."""
    if "\\X\\" in name or "\\S\\" in name:
        yield from (piece for piece in _BYTES.findall(name) if _is_escaped_bytes(piece))


def _is_escaped_bytes(piece: str) -> bool:
    return "\\X\\" in piece or "\\S\\" in piece


def _unescaped(piece: str) -> bytes:
    found = []
    for byte, high, plain in _BYTE.findall(piece):
        if byte:
            found.append(bytes.fromhex(byte))
        elif high:
            found.append(bytes([ord(high) | 0x80]))
        else:
            found.append(b"\\" if plain == "\\\\" else plain.encode("ascii"))
    return b"".join(found)


def _with_plain_backslashes(text: str, notes: list[str]) -> str:
    """Backslashes that begin no directive of STEP doubled, which is how STEP writes one: Windows paths."""
    lines: list[int] = []

    def doubled(found: re.Match[str]) -> str:
        if found.group() != "\\":
            return found.group()
        lines.append(found.start())
        return "\\\\"

    repaired = _DIRECTIVE.sub(doubled, text)
    if lines:
        numbers = dict.fromkeys(text.count("\n", 0, place) + 1 for place in lines[:_SHOWN_LINES])
        code = "ifc.backslashes.others" if len(lines) > _SHOWN_LINES else "ifc.backslashes"
        notes.append(Reason(code, lines=list(map(str, numbers))))
    return repaired


_SHOWN_LINES = 4  # lines in a message


def _with_header(text: str, schemas: Sequence[str], notes: list[str]) -> tuple[str, str | None]:
    """The file with a header that the parser knows, and its schema; None where it names none that is read.

    A parser takes a header at its word: one that is put together in another way, or names a version of the schema that
    is not the parser's own, is replaced by one that says the same of the schema and nothing else.
    """
    section = _HEADER.search(text, 0, _HEADER_CHARACTERS)
    found = None if section is None else _SCHEMA.search(section["entries"])
    if section is None or found is None:
        return text, None
    names = re.findall(r"'([^']*)'", found["names"])
    taken = next((schema for name in names if (schema := _taken_as(name, schemas)) is not None), None)
    if taken is None:
        return text, names[0] if names else None
    if taken not in (name.strip().upper() for name in names):
        notes.append(Reason("ifc.schema_read", names=names, taken=taken))
    if _PLAIN_ENTRIES.fullmatch(_BLANK.sub(r"\1", section["entries"])) and [taken] == names:
        return text, taken
    lines = "\n" * section["entries"].count("\n")
    return f"{text[: section.start('entries')]}{_ENTRIES.format(taken)}{lines}{text[section.end('entries') :]}", taken


def _taken_as(name: str, schemas: Iterable[str]) -> str | None:
    spelt = name.strip().upper()
    if spelt in schemas:
        return spelt
    for family, members in _FAMILIES:
        if family.fullmatch(spelt):
            return next((member for member in members if member in schemas), None)
    return None


def _called(encoding: str) -> str:
    return CALLED.get(encoding, encoding)


def _written(code: str, evidence: Evidence) -> Reason:
    return Reason(
        f"{code}.close" if evidence.close else code, best=_called(evidence.best), close=_called(evidence.close or "")
    )
