"""Results into an IFC model: the same file with the same ids and GlobalIds, and what was found put behind it.

What is written can be taken out again, and then the file is the one from before, byte for byte. Written twice it is
the same as written once.
"""

from __future__ import annotations

import hashlib
import stat
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.ifc.text.file import OpenedIfc, open_ifc
from aadm_workbench.design.ifc.text.step import step_text
from aadm_workbench.errors import ReportError
from aadm_workbench.model import Array, ColumnReport, JobReport, PointResult, Reason
from aadm_workbench.model.reason import listed, said_of
from aadm_workbench.own_files import is_there, write_atomically
from aadm_workbench.report.ifc import sets as ifc_sets
from aadm_workbench.report.ifc.addition import Addition, Property
from aadm_workbench.report.ifc.assign import Assigner
from aadm_workbench.report.ifc.elements import Elements, check_named_once
from aadm_workbench.report.ifc.marks import Marks
from aadm_workbench.report.ifc.points import write_points
from aadm_workbench.report.ifc.records import add_records, add_report_link
from aadm_workbench.report.ifc.removal import Stripped, keep_book, without_results
from aadm_workbench.report.ifc.section_set import SECTION_SET, section_properties

_WRITABLE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH
_PART = 1 << 20  # bytes at once: more is no faster
_SHORT_HASH = 12  # 48 bits: no two states of a model share them


@dataclass(frozen=True)
class WriteBack:
    """What became of a model.

    ``changed`` is False where the file at ``out`` held the same bytes already. ``backup`` is the copy of a model that
    was changed in place. ``missing`` names columns and points of the report that the model does not hold.
    """

    out: Path
    changed: bool
    schema: str
    columns: tuple[str, ...] = ()
    property_sets: int = 0
    annotations: int = 0
    missing: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    backup: Path | None = None


def ids_path() -> Path:
    """The IDS (buildingSMART, 1.0) that checks what :func:`write_ifc` writes."""
    return Path(__file__).resolve().parents[2] / "resources" / "aadm-results.ids"


def write_ifc(
    report: JobReport,
    model: Path,
    out: Path,
    *,
    report_location: str | None = None,
    force: bool = False,
    setting: Mapping[str, Sequence[Property]] | None = None,
) -> WriteBack:
    """Write the results of a check into an IFC model.

    Parameters
    ----------
    report
        report.json, schema 1.
    model
        The model that was checked, with or without results of an earlier run: those are replaced.
    out
        The file to write, whole or not at all. Where it is the model itself, the model as it was is kept beside it.
    report_location
        Path of the report relative to ``out``, or its URI: the columns are linked to it.
    force
        Write into a model that has changed since the check; columns are found by their GlobalIds.
    setting
        What a stack plan says of elements, by their GlobalIds: the property set AADM_Setting.

    Raises
    ------
    ReportError
        Where the model is not the one that was checked, or holds none of the columns.
    DesignError
        Where the model cannot be read.
    AadmError
        Where ``out`` cannot be written.
    MissingDependencyError
        Where ifcopenshell is not installed.
    """
    stripped, opened = _original(model)
    same = _is_same_model(report, model, stripped)
    if not same and not force:
        raise ReportError(_not_the_same(report, model, stripped))
    elements = Elements(opened.file)
    of_column = {column.id: element for column in report.columns if (element := elements.column(column)) is not None}
    if not of_column:
        raise ReportError(_no_column(report, model, elements))
    check_named_once(of_column)
    frames = _frames(report, of_column) if same else _frames_now(stripped.content, elements)
    text = step_text(stripped.content)
    addition = Addition(opened, text)
    assigner, marks = Assigner(addition), Marks(addition)
    missing = [f"column {column.id}" for column in report.columns if column.id not in of_column]
    checked = [column for column in report.columns if column.id in of_column]
    for column in checked:
        element = of_column[column.id]
        assigner.assign(element, ifc_sets.COLUMN_SET, ifc_sets.column_properties(report, column))
        if section := section_properties(report, column):
            assigner.assign(element, SECTION_SET, section)
        if element.id() in frames:
            marks.draw(column, element, frames[element.id()])
        add_records(addition, report, column, element)
    missing += write_points(report, checked, elements, assigner)
    for global_id, properties in (setting or {}).items():
        if (element := elements.called(global_id)) is not None:
            assigner.assign(element, ifc_sets.SETTING_SET, properties)
    marks.finish()
    if report_location:
        add_report_link(addition, report_location, list(of_column.values()))
    checked_sha256 = (report.model or {}).get("sha256", "")
    keep_book(addition, text, checked_sha256, ifc_sets.write_back_properties(report))
    replaced = {number: _line(opened.file, number) for number in addition.altered}
    parts = text.edited(replaced=replaced, appended=addition.lines())
    # A backup for each state of the model without results, not for each night.
    changed, backup = _put(parts, out, model, _sha256(stripped.content))
    return WriteBack(
        out=out,
        changed=changed,
        schema=str(opened.file.schema_identifier),
        columns=tuple(of_column),
        property_sets=assigner.assigned,
        annotations=len(marks.drawn),
        missing=tuple(missing),
        notes=(*stripped.notes, *_notes(assigner), *elements.notes(_entries(report))),
        backup=backup,
    )


def remove_ifc(model: Path, out: Path) -> WriteBack:
    """Take the results out of a model again; other people's entities stay as they are.

    Raises
    ------
    DesignError
        Where the model cannot be read.
    ReportError
        Where it holds no results.
    AadmError
        Where ``out`` cannot be written.
    """
    _check_writable(model)
    opened = open_ifc(model)
    stripped = without_results(opened.file, step_text(model.read_bytes()))
    if not stripped.found:
        raise ReportError.because("report.no_results", model=model)
    # What can be written again from the report needs no backup.
    changed, backup = _put([stripped.content], out, model, "" if stripped.exact else opened.sha256)
    how = Reason("report.as_before" if stripped.exact else "report.changed_since")
    return WriteBack(out, changed, str(opened.file.schema_identifier), notes=(*stripped.notes, how), backup=backup)


def _original(model: Path) -> tuple[Stripped, OpenedIfc]:
    """The model without results of earlier runs, and open."""
    _check_writable(model)
    opened = open_ifc(model)
    stripped = without_results(opened.file, step_text(model.read_bytes()))
    if not stripped.found:
        return stripped, opened
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.ifc"
        path.write_bytes(stripped.content)
        return stripped, open_ifc(path)


def _check_writable(model: Path) -> None:
    """Refuse forms of IFC in which no line can be put behind the others."""
    if model.suffix.lower() == ".ifczip":
        raise ReportError.about(model, "report.ifczip")
    with suppress(OSError), model.open("rb") as stream:  # whoever opens it says what is wrong
        if stream.read(2) in (b"\xff\xfe", b"\xfe\xff"):
            raise ReportError.about(model, "report.utf16")


def _is_same_model(report: JobReport, model: Path, stripped: Stripped) -> bool:
    if report.model is None:
        return False
    known = {_sha256(model.read_bytes()), _sha256(stripped.content)}
    if stripped.exact:
        known.add(stripped.checked_sha256)
    return report.model["sha256"] in known


def _not_the_same(report: JobReport, model: Path, stripped: Stripped) -> str:
    if report.model is None:
        return said_of(model, "report.no_model")
    now, checked = (text[:_SHORT_HASH] for text in (_sha256(stripped.content), report.model["sha256"]))
    return Reason("report.other_model", model=model, source=report.model["source"], now=now, checked=checked)


def _frames(report: JobReport, of_column: Mapping[str, Any]) -> dict[int, Array]:
    """``T_model_column`` (4, 4), mm, by the number of the column's element, as it was when the column was checked."""
    return {
        of_column[column.id].id(): np.array(column.T_model_column, dtype=float)
        for column in report.columns
        if column.T_model_column is not None and column.id in of_column
    }


def _frames_now(content: bytes, elements: Elements) -> dict[int, Array]:
    """The same in a model that has changed: a column that was moved since takes its marks along."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.ifc"
        path.write_bytes(content)
        columns = read_ifc(path).columns
    return {
        element.id(): np.array(column.T_model_column, dtype=float)
        for column in columns
        if column.T_model_column is not None and (element := elements.column(column)) is not None
    }


def _entries(report: JobReport) -> Iterator[ColumnReport | PointResult]:
    """Columns and points of a report: whatever has a GlobalId."""
    for column in report.columns:
        yield column
        for kind in ifc_sets.POINT_SETS:
            yield from column.points(kind)


def _line(file: Any, number: int) -> bytes:
    from aadm_workbench.report.ifc.addition import line_of

    return line_of(file.by_id(number))


def _no_column(report: JobReport, model: Path, elements: Elements) -> str:
    if notes := list(elements.notes(report.columns)):
        return Reason("said.of_file", file=model, why=notes[0])
    return Reason("report.no_element", model=model, shown=listed([column.id for column in report.columns], 5))


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _notes(assigner: Assigner) -> Iterator[str]:
    for name, count in assigner.left_alone.items():
        yield Reason("report.left_alone", name=name, count=count)
    if assigner.unshared:
        yield Reason("report.unshared", count=assigner.unshared)


def _put(parts: Iterable[bytes], out: Path, model: Path, keep_as: str) -> tuple[bool, Path | None]:
    """Write the file unless it is there already; a model that is replaced is kept, once for each ``keep_as``."""
    in_place = out.exists() and out.samefile(model)
    # The model may be named by a link, and that stays one: what it leads to is replaced. Any other link is replaced.
    place = out.resolve() if in_place else out
    with tempfile.TemporaryFile() as made:  # a floor's results are too many to hold them twice
        made.writelines(parts)
        if _holds(place, made):
            return False, None
        mode = place.stat().st_mode if in_place else None
        if mode is not None and not mode & _WRITABLE:
            raise ReportError.because("report.read_only", model=model)
        backup = _backup(model, keep_as) if keep_as and in_place else None
        write_atomically(place, _from_start(made))
    if mode is not None:
        # The new file is one in the place of the old; whoever could read that can read this.
        place.chmod(stat.S_IMODE(mode))
    return True, backup


def _backup(model: Path, keep_as: str) -> Path | None:
    """Keep a copy of a model beside it; None where that is there already."""
    kept = model.with_name(f"{model.name}.{keep_as[:_SHORT_HASH]}.bak")
    if is_there(kept):
        return None
    write_atomically(kept, model.read_bytes())
    return kept


def _holds(place: Path, made: IO[bytes]) -> bool:
    """Whether a file holds the same bytes as another one that is open."""
    if not is_there(place) or place.stat().st_size != made.tell():
        return False
    with place.open("rb") as there:
        return all(part == there.read(len(part)) for part in _from_start(made))


def _from_start(made: IO[bytes]) -> Iterator[bytes]:
    made.seek(0)
    while part := made.read(_PART):
        yield part
