"""Columns of a document as a job, so that the panel asks what the command line would ask."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from aadm_workbench.design.design_text import write_model
from aadm_workbench.design.directions import up_deg
from aadm_workbench.document.column import column_design
from aadm_workbench.document.display.reported_design import FROM_REPORT
from aadm_workbench.document.job.toml import Table
from aadm_workbench.document.scan_cloud import kind_of
from aadm_workbench.errors import DesignError, ScanError
from aadm_workbench.model import UP_DEG, Camera, Kind

_DEFAULTS = {"units": "mm", "tolerances": "cn", "decision": "guarded", "turns": False}
"""What holds where a job says nothing, as the command reads it."""

DESIGN_FILE = "design.json"
_INTRINSICS = ("fx", "fy", "cx", "cy", "width", "height", "scale_error")
_FARTHEST = 2  # folders up: a project is moved as a whole, a disk is not
_UPS = ("up", "sleeves_up", "rebars_up")


def job_table(
    columns: Sequence[Any],
    model: str,
    folder: Path | None = None,
    earlier: Mapping[str, Any] | None = None,
    profile: str = "",
) -> Table:
    """The values of a job that checks columns of one document.

    Parameters
    ----------
    model
        The model as the job names it: :data:`DESIGN_FILE`, or the file that the columns were taken from.
    folder
        Where the job will lie: paths below it are written as seen from there, others whole; None: all whole.
    earlier
        A job that this one takes the place of; what the document knows nothing of is kept.
    profile
        File of what was learned of the camera, for scans with intrinsics; empty: what ``earlier`` says, else none.

    Raises
    ------
    AadmError
        Where a column has no scans, or says something that cannot be, or columns differ in what a job has one of.
    """
    first, kept = columns[0], dict(earlier or {})
    scans = [cloud for column in columns for cloud in _scans_of(column)]
    table: Table = {"schema": 1, "name": kept.get("name") or first.Document.Label}
    table["units"] = _of_all(scans, "Units", first)
    table["tolerances"] = _alike(columns, _tolerances, "Tolerances")
    table["decision"] = _alike(columns, lambda column: str(column.Decision), "Decision")
    table["turns"] = _alike(columns, lambda column: bool(column.Turns), "Turns")
    table["model"] = {**{key: one for key, one in _dict(kept.get("model")).items() if key != "path"}, "path": model}
    camera = _camera(scans, first)
    if camera:
        learned = {"profile": seen_from(profile, folder)} if profile else {}
        table["camera"] = {**_dict(kept.get("camera")), **camera, **learned}
    known = {str(one["id"]): one for one in kept.get("columns", ())}
    entries = [_entry(column, folder, known.get(column.ColumnId, {})) for column in columns]
    if earlier is not None:
        table = _without_defaults(table, kept)
    rest = {key: value for key, value in kept.items() if key not in table and key != "columns"}
    return {**table, **rest, "columns": entries}


def _without_defaults(table: Table, earlier: Mapping[str, Any]) -> Table:
    """The same job without what it does not say and what holds anyway: it stays as its author wrote it."""
    silent = {key for key, value in _DEFAULTS.items() if key not in earlier and table[key] == value}
    camera = _dict(table.get("camera"))
    if "scale_error" not in _dict(earlier.get("camera")) and camera.get("scale_error") == Camera.scale_error:
        table = {**table, "camera": {key: value for key, value in camera.items() if key != "scale_error"}}
    return {key: value for key, value in table.items() if key not in silent}


def _entry(column: Any, folder: Path | None, earlier: Mapping[str, Any]) -> Table:
    replaced = {"id", *_UPS, *(kind.plural for kind in Kind), "design"}
    entry: Table = {"id": column.ColumnId}
    for kind in Kind:
        files = [seen_from(cloud.File, folder) for cloud in column.Scans if kind_of(cloud) is kind]
        if files:
            entry[kind.plural] = files[0] if len(files) == 1 else files
    for key, up in (("sleeves_up", column.SleevesUp), ("rebars_up", column.RebarsUp)):
        degrees = up_deg(up, f"{column.Label}, {key}")
        if degrees is not None:
            entry[key] = up.strip() if up.strip() in UP_DEG else degrees
    if "sleeves_up" in entry and entry["sleeves_up"] == entry.get("rebars_up", entry["sleeves_up"]):
        entry["up"] = entry.pop("sleeves_up")
        entry.pop("rebars_up", None)
    return {**entry, **{key: value for key, value in earlier.items() if key not in replaced}}


def design_text(columns: Sequence[Any]) -> str:
    """The text of :data:`DESIGN_FILE`: the designs as the document holds them, and where they were taken from.

    Raises
    ------
    DesignError
        Where a column has none, or one from a report.
    """
    designs = {}
    for column in columns:
        design = column_design(column)
        if any(point.why == FROM_REPORT for point in (*design.sleeves, *design.rebars)):
            raise DesignError.because("document.from_report", label=column.Label)
        designs[column.ColumnId] = design
    first = columns[0]
    origin = {"source": Path(first.ModelFile).name or first.Document.Label, "sha256": first.ModelSha256}
    origin["project"] = first.ModelProject
    return write_model(origin, designs)


def model_of_all(columns: Sequence[Any]) -> Path | None:
    """The file that all columns were taken from, where it and their designs are still what they were; else None."""
    files = {str(column.ModelFile) for column in columns}
    if len(files) != 1 or not all(column.SampledSha256 == sha256_of(column.Design) for column in columns):
        return None
    file = Path(files.pop())
    if not file.is_file() or file.suffix.lower() == ".fcstd":
        return None  # of a document the shapes were taken, as they were in the window
    with file.open("rb") as stream:
        now = hashlib.file_digest(stream, "sha256").hexdigest()
    return file if {now} == {column.ModelSha256 for column in columns} else None


def sha256_of(text: str) -> str:
    """Hash of a text."""
    return hashlib.sha256(text.encode()).hexdigest()


def _scans_of(column: Any) -> list[Any]:
    if not column.Scans:
        raise ScanError.because("document.no_scans", label=column.Label)
    return list(column.Scans)


def seen_from(file: str | Path, folder: Path | None) -> str:
    """A path as a job writes it: as seen from its folder where it lies in it or near it, else whole."""
    path = Path(file)
    if folder is None or not path.is_absolute():
        return os.fspath(file)
    for ups, place in enumerate((folder, *folder.parents[:_FARTHEST])):
        if path.is_relative_to(place):
            return (Path(*[".."] * ups) / path.relative_to(place)).as_posix()
    return os.fspath(file)


def _camera(scans: list[Any], column: Any) -> Table:
    """Intrinsics of the scans that were imported with some; a job has one camera."""
    with_camera = [cloud for cloud in scans if cloud.Camera]
    if not with_camera:
        return {}
    camera = json.loads(_of_all(with_camera, "Camera", column))
    entries = {key: camera[key] for key in _INTRINSICS if camera.get(key) is not None}
    step_mm = {cloud.DepthScale for cloud in with_camera if cloud.DepthScale}
    if len(step_mm) > 1:
        raise ScanError.because("document.scans_differ", label=column.Label, name="DepthScale")
    return entries | ({"depth_scale_mm": step_mm.pop()} if step_mm else {})


def _of_all(scans: list[Any], name: str, column: Any) -> str:
    """A property that all scans have alike."""
    found = {str(getattr(cloud, name)) for cloud in scans}
    if len(found) > 1:
        raise ScanError.because("document.scans_differ", label=column.Label, name=name)
    return found.pop()


def _alike(columns: Sequence[Any], value_of: Any, name: str) -> Any:
    """A setting that all columns have alike."""
    found = {value_of(column) for column in columns}
    if len(found) > 1:
        raise DesignError.because("document.columns_differ", name=name, values=sorted(map(str, found)))
    return found.pop()


def _dict(value: Any) -> Table:
    return dict(value) if isinstance(value, Mapping) else {}


def _tolerances(column: Any) -> str:
    """A profile's name, or the path of its file as seen from the document."""
    written = str(column.Tolerances).strip()
    if written.lower().endswith(".toml"):
        return str(Path(column.Document.FileName or ".").absolute().parent / written)
    return written
