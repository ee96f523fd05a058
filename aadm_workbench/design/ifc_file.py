"""IFC files: opened, or refused with the place and the reason; never half read in silence."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from time import perf_counter
from typing import Any

from aadm_workbench.design.ifc_names import Naming
from aadm_workbench.errors import DesignError, MissingDependencyError

_LOG_ERROR = re.compile(r"\[error\]\s*(?:\[[^\]]*\]\s*)*(?P<text>.+)")
_AT_OFFSET = re.compile(r"\s*at offset (?P<offset>\d+)")
_COMMENT = re.compile(rb"/\*.*?\*/", re.DOTALL)
_NOT_ASCII = re.compile(r"[^\x00-\x7f]+")


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
        return any("freecad" in (name or "").lower() for name in names)

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
    content = _bytes(path)
    sha256 = hashlib.sha256(content).hexdigest()
    _check_frame(path, content)
    ifcopenshell.get_log()  # one log for all files: what others left there is not this one's
    warnings: list[str] = []
    try:
        if content.isascii():
            file = ifcopenshell.open(str(path))
        else:
            content, encoding = _escaped(content)
            warnings.append(f"names are written in raw {encoding}, not as STEP wants it; they were read as {encoding}")
            file = ifcopenshell.file.from_string(content.decode("ascii"))
    except (ifcopenshell.Error, OSError, RuntimeError, UnicodeDecodeError) as error:
        reasons = "; ".join(_complaints(ifcopenshell.get_log(), content)) or str(error)
        raise DesignError(f"{path} cannot be read as an IFC model: {reasons}. Export it again.") from error
    complaints = _complaints(ifcopenshell.get_log(), content)
    if file is None or not file.by_type("IfcProject"):
        reasons = "; ".join(complaints) or "it holds no IfcProject"
        raise DesignError(f"{path} cannot be read as an IFC model: {reasons}. Export it again.")
    warnings += [f"a line was skipped: {complaint}" for complaint in complaints]
    return OpenedIfc(
        source=str(path),
        sha256=sha256,
        file=file,
        mm=_length_unit_mm(path, file),
        radians=_angle_unit(file),
        mm2=_area_unit_mm2(file),
        warnings=tuple(warnings),
        seconds=perf_counter() - began,
    )


def _ifcopenshell() -> Any:
    try:
        import ifcopenshell
    except ImportError as error:
        raise MissingDependencyError("ifcopenshell", "reading IFC models") from error
    return ifcopenshell


def _bytes(path: Path) -> bytes:
    if path.is_dir():
        raise DesignError(f"{path} is a folder: name the model's file.")
    try:
        content = path.read_bytes()
    except FileNotFoundError as error:
        raise DesignError(f"{path} does not exist. Paths in a job are relative to the job file.") from error
    except OSError as error:
        raise DesignError(f"{path} cannot be opened: {error.strerror}.") from error
    if not content.strip():
        raise DesignError(f"{path} is empty: export the model again.")
    return content


def _check_frame(path: Path, content: bytes) -> None:
    """Refuse what does not begin and end as a STEP file: a parser would give a part of it, or nothing."""
    if content.startswith(b"PK"):
        raise DesignError(f"{path} is a zip archive, not an IFC model: unpack it and name the .ifc file in it.")
    if content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        raise DesignError(f"{path} is XML: export the model as IFC in STEP format (.ifc), not as ifcXML.")
    # A comment keeps its line breaks, so that the lines that are named are those of the file.
    head = _COMMENT.sub(lambda found: b"\n" * found.group().count(b"\n"), content[:65536])
    passed = 0
    for word in (b"ISO-10303-21", b"HEADER"):
        begin = len(head) - len(head[passed:].lstrip(b"\xef\xbb\xbf \t\r\n"))
        statement = head[begin:].split(b";", 1)[0]
        if statement.strip().upper() != word:
            number = head.count(b"\n", 0, begin) + 1
            shown = head[begin : begin + 40].splitlines()[0].decode("utf-8", "replace")
            raise DesignError(
                f"{path} is no IFC model or a damaged one: line {number} reads {shown!r} where '{word.decode()};' is "
                "due. Export it again, or repair that line."
            )
        passed = begin + len(statement) + 1
    if b"END-ISO-10303-21" not in content[-4096:]:
        lines = content.count(b"\n") + 1
        raise DesignError(f"{path} is cut short: line {lines} is its last, without END-ISO-10303-21. Copy it again.")


def _escaped(content: bytes) -> tuple[bytes, str]:
    """The same file with names in raw UTF-8, Chinese or Japanese encoding written as STEP wants them.

    ifcopenshell drops such bytes; several Chinese programs write them.
    """
    for encoding in ("utf-8", "gb18030", "shift_jis", "latin-1"):
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        return _NOT_ASCII.sub(_escape, text.lstrip("\ufeff")).encode("ascii"), encoding
    raise AssertionError("latin-1 decodes everything")


def _escape(found: re.Match[str]) -> str:
    return "\\X2\\" + found.group().encode("utf-16-be").hex().upper() + "\\X0\\"


def _complaints(log: str, content: bytes) -> list[str]:
    """What the parser had to say, with the line instead of the offset."""
    complaints = []
    for line in log.splitlines():
        found = _LOG_ERROR.match(line.strip())
        if not found or "No support for file schema encountered ()" in line:
            continue
        text = found["text"].strip()
        offset = _AT_OFFSET.search(text)
        if offset:
            number = content.count(b"\n", 0, int(offset["offset"])) + 1
            text = f"line {number}: {_AT_OFFSET.sub('', text)}"
        complaints.append(text)
    return complaints


def _length_unit_mm(path: Path, file: Any) -> float:
    from ifcopenshell.util.unit import calculate_unit_scale, get_project_unit

    if get_project_unit(file, "LENGTHUNIT") is None:
        raise DesignError(f"{path} declares no unit of length (IfcUnitAssignment): export it again with units.")
    return 1000.0 * float(calculate_unit_scale(file))


def _angle_unit(file: Any) -> float:
    from ifcopenshell.util.unit import calculate_unit_scale

    return float(calculate_unit_scale(file, "PLANEANGLEUNIT"))


def _area_unit_mm2(file: Any) -> float | None:
    from ifcopenshell.util.unit import calculate_unit_scale, get_project_unit

    if get_project_unit(file, "AREAUNIT") is None:
        return None
    return 1e6 * float(calculate_unit_scale(file, "AREAUNIT"))
