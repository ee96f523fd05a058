"""IFC files: opened, or refused with the place and the reason; never half read in silence.

The IFC model in an .ifczip, the packed form that buildingSMART defines.
"""

from __future__ import annotations

import hashlib
import re
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path, PurePosixPath
from time import perf_counter
from typing import Any

from aadm_workbench.bounded import ArchiveBounds, BoundsError, entry_bytes, opened_archive, read_bounded
from aadm_workbench.design.ifc.names import Naming
from aadm_workbench.design.ifc.text.prepared import prepared
from aadm_workbench.design.ifc.text.step import numbered_once
from aadm_workbench.design.model_file import LARGEST_MODEL_BYTES
from aadm_workbench.errors import DesignError, needed
from aadm_workbench.model import Reason, in_one
from aadm_workbench.model.reason import listed

_LOG_ERROR = re.compile(r"\[error\]\s*(?:\[[^\]]*\]\s*)*(?P<text>.+)")
_AT_OFFSET = re.compile(r"\s*at offset (?P<offset>\d+)")
_COMMENT = re.compile(rb"/\*.*?\*/", re.DOTALL)
_OVERWRITTEN = re.compile(r"Overwriting instance with name #(\d+)")
_SHOWN = 4  # complaints, or names, in a message

IFCZIP_BOUNDS = ArchiveBounds(
    "zip archive of a model", entries=10_000, entry_bytes=LARGEST_MODEL_BYTES, all_bytes=LARGEST_MODEL_BYTES
)
"""A model, and what some programs pack with it: pictures, documents."""


@dataclass(frozen=True, eq=False)
class OpenedIfc:
    """An open model: ``file`` is ifcopenshell's, lengths in it are multiples of ``mm``, angles of ``radians``.

    Areas are multiples of ``mm2``; None where the file does not say of what. ``seconds`` is what opening took.
    """

    source: str
    sha256: str
    file: Any
    mm: float
    radians: float
    mm2: float | None
    warnings: tuple[str, ...]
    seconds: float

    @property
    def draws_coarsely(self) -> bool:
        """Whether it comes from a program that may draw circles with four sides (FreeCAD, in files in metres)."""
        names = (application.ApplicationFullName for application in self.file.by_type("IfcApplication"))
        return any("freecad" in name.lower() for name in names if isinstance(name, str))

    @cached_property
    def naming(self) -> Naming:
        """What its elements are called."""
        return Naming(self.file)


def open_ifc(path: str | Path) -> OpenedIfc:
    """Open an IFC model of schema IFC2X3, IFC4 or IFC4X3.

    Raises
    ------
    DesignError
        Where there is no such file, or it is no complete IFC model; names the file, the line and the reason.
    MissingDependencyError
        Where ifcopenshell is not installed.
    """
    ifcopenshell = _ifcopenshell()
    began = perf_counter()
    path = Path(path)
    # Of what is on the disk as it is to be parsed no copy is in memory meanwhile.
    sha256, content, notes = _text_of(path, ifcopenshell.ifcopenshell_wrapper.schema_names())
    file, warnings = _parsed(path, content)
    return OpenedIfc(
        source=str(path),
        sha256=sha256,
        file=file,
        mm=_length_unit_mm(path, file),
        radians=_angle_unit(path, file),
        mm2=_area_unit_mm2(path, file),
        warnings=(*notes, *warnings),
        seconds=perf_counter() - began,
    )


def _text_of(path: Path, schemas: Sequence[str]) -> tuple[str, bytes | None, tuple[str, ...]]:
    """Hash of a file, the text to parse, None where that is the file itself, and what was not as STEP wants it."""
    written = _bytes(path)
    content = model_in_archive(path) if path.suffix.lower() == ".ifczip" else written
    _check_frame(path, content)
    text = prepared(content, schemas)
    if text.schema not in schemas:
        named = Reason("ifc.names_schema" if text.schema else "ifc.names_no_schema", schema=text.schema)
        raise DesignError(Reason("ifc.schema", path=path, why=named))
    parsed = None if text.content == written else text.content
    return hashlib.sha256(written).hexdigest(), parsed, text.notes


def _parsed(path: Path, content: bytes | None) -> tuple[Any, list[str]]:
    """The file of ifcopenshell, each number in it that of one entity, and what a person should know of it."""
    file, log = _read(path, content)
    complaints = _complaints(log, path, content)
    warnings: list[str] = [Reason("ifc.skipped", why=complaint) for complaint in complaints]
    twice = list(dict.fromkeys(int(number) for number in _OVERWRITTEN.findall(log)))
    if twice:
        # The parser gives both under one number, and what refers to it gets either.
        file, _ = _read(path, numbered_once(path.read_bytes() if content is None else content))
        code = "ifc.number" if len(twice) == 1 else "ifc.numbers"
        warnings.append(Reason(code, shown=listed([f"#{one}" for one in twice], _SHOWN)))
    if file is None or not _holds_project(file):
        why = in_one(complaints) or Reason("ifc.no_project")
        raise DesignError(Reason("ifc.unread", path=path, why=why))
    return file, warnings


def _read(path: Path, content: bytes | None) -> tuple[Any, str]:
    """A file from its text, or from the disk where that is None, and the parser's log."""
    ifcopenshell = _ifcopenshell()
    ifcopenshell.get_log()  # one log for all files: what others left there is not this one's
    try:
        if content is None:
            file = ifcopenshell.open(str(path))
        else:
            file = ifcopenshell.file.from_string(content.decode("ascii"))
    except (ifcopenshell.Error, OSError, RuntimeError, UnicodeDecodeError) as error:
        complaints = _complaints(ifcopenshell.get_log(), path, content)
        raise DesignError(Reason("ifc.unread", path=path, why="; ".join(complaints) or error)) from error
    return file, ifcopenshell.get_log()


def _holds_project(file: Any) -> bool:
    try:
        return bool(file.by_type("IfcProject"))
    except RuntimeError:  # the parser gave up at a line before it had a schema
        return False


def _ifcopenshell() -> Any:
    with needed("ifcopenshell", "reading IFC models"):
        import ifcopenshell
    return ifcopenshell


def _bytes(path: Path) -> bytes:
    try:
        content = read_bounded(path, LARGEST_MODEL_BYTES)
    except BoundsError as error:
        raise DesignError(Reason("design.refused", path=path, why=error)) from error
    except FileNotFoundError as error:
        raise DesignError(Reason("design.no_file", path=path)) from error
    except (OSError, ValueError) as error:
        raise DesignError(
            Reason("design.unopened", path=path, why=getattr(error, "strerror", None) or error)
        ) from error
    if not content.strip():
        raise DesignError(Reason("design.empty", path=path))
    return content


def _check_frame(path: Path, content: bytes) -> None:
    """Refuse what does not begin and end as a STEP file: a parser would give a part of it, or nothing."""
    if content.startswith(b"PK"):
        raise DesignError(Reason("ifc.is_zip", path=path))
    if content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        raise DesignError(Reason("ifc.is_xml", path=path))
    # A comment keeps its line breaks, so that the lines that are named are those of the file.
    head = _COMMENT.sub(lambda found: b"\n" * found.group().count(b"\n"), content[:65536])
    passed = 0
    for word in (b"ISO-10303-21", b"HEADER"):
        begin = len(head) - len(head[passed:].lstrip(b"\xef\xbb\xbf \t\r\n"))
        statement = head[begin:].split(b";", 1)[0]
        if statement.strip().upper() != word:
            number = head.count(b"\n", 0, begin) + 1
            shown = head[begin : begin + 40].partition(b"\n")[0].decode("utf-8", "replace")
            raise DesignError(Reason("ifc.damaged", path=path, number=number, shown=repr(shown), word=word.decode()))
        passed = begin + len(statement) + 1
    if b"END-ISO-10303-21" not in content[-4096:]:
        lines = content.count(b"\n") + 1
        raise DesignError(Reason("ifc.cut", path=path, lines=lines))


def _complaints(log: str, path: Path, content: bytes | None) -> list[str]:
    """What the parser had to say of a text, or else of the file, with the line instead of the offset."""
    complaints = []
    for line in log.splitlines():
        found = _LOG_ERROR.match(line.strip())
        if not found or "No support for file schema encountered ()" in line:
            continue
        text = found["text"].strip()
        offset = _AT_OFFSET.search(text)
        if offset:
            content = path.read_bytes() if content is None else content
            number = content.count(b"\n", 0, int(offset["offset"])) + 1
            text = Reason("ifc.line", number=number, said=_AT_OFFSET.sub("", text))
        complaints.append(text)
    return complaints


def _length_unit_mm(path: Path, file: Any) -> float:
    scale = _unit(path, file, "LENGTHUNIT", "length")
    if scale is None:
        raise DesignError(Reason("ifc.no_unit", path=path))
    return 1000.0 * scale


def _unit(path: Path, file: Any, kind: str, called: str) -> float | None:
    """A unit of the file in SI units; None where it declares none."""
    from ifcopenshell.util.unit import calculate_unit_scale, get_project_unit

    try:
        unit = get_project_unit(file, kind)
        if unit is None:
            return None
        _check_chain(unit)
        scale = float(calculate_unit_scale(file, kind))
    except (AttributeError, TypeError, ValueError, LookupError, ArithmeticError, RuntimeError) as error:
        raise DesignError(Reason("ifc.unit_senseless", path=path, called=called)) from error
    if not _SMALLEST_UNIT < scale < _LARGEST_UNIT:
        raise DesignError(Reason("ifc.unit", path=path, called=called, scale=scale))
    return scale


def _check_chain(unit: Any) -> None:
    """Refuse a unit that is defined by itself: who follows that comes to no end."""
    passed: set[int] = set()
    while unit.is_a("IfcConversionBasedUnit"):
        if unit.id() in passed:
            raise ValueError(Reason("ifc.unit_itself"))
        passed.add(unit.id())
        unit = unit.ConversionFactor.UnitComponent


_SMALLEST_UNIT, _LARGEST_UNIT = 1e-12, 1e9
"""Square micrometres and square kilometres, with room: programs write no smaller and no larger units."""


def _angle_unit(path: Path, file: Any) -> float:
    return _unit(path, file, "PLANEANGLEUNIT", "angle") or 1.0


def _area_unit_mm2(path: Path, file: Any) -> float | None:
    scale = _unit(path, file, "AREAUNIT", "area")
    return None if scale is None else 1e6 * scale


def model_in_archive(path: Path) -> bytes:
    """The bytes of the one .ifc file in an archive.

    Raises
    ------
    DesignError
        Where the archive is damaged or encrypted, holds no model or several, or would burst.
    """
    try:
        with opened_archive(path, IFCZIP_BOUNDS) as archive:
            return entry_bytes(archive, _model_of(path, archive))
    except BoundsError as error:
        message = Reason("ifc.zip_refused", path=path, why=error)
        raise DesignError(message) from error
    except OSError as error:
        raise DesignError(Reason("design.unopened", path=path, why=error.strerror)) from error


def _model_of(path: Path, archive: zipfile.ZipFile) -> zipfile.ZipInfo:
    parts = [part for part in archive.infolist() if not part.is_dir() and not part.filename.startswith("__MACOSX/")]
    models = [part for part in parts if PurePosixPath(part.filename.replace("\\", "/")).suffix.lower() == ".ifc"]
    if len(models) == 1:
        return models[0]
    shown = [part.filename for part in (models or parts)[:_SHOWN]] or Reason("ifc.zip_nothing")
    what = Reason("ifc.zip_models" if models else "ifc.zip_no_model", count=len(models))
    raise DesignError(Reason("ifc.zip_holds", path=path, what=what, shown=shown))
