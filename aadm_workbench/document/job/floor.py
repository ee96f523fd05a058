"""A floor's columns with their scans: put into a document by name or from a job file, and saved as one."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aadm_workbench.bounded import BoundsError, read_bounded
from aadm_workbench.design.directions import up_deg
from aadm_workbench.document.column import column_design
from aadm_workbench.document.job.scan_names import owners_of, scans_by_name
from aadm_workbench.document.job.table import design_text, job_table, model_of_all, seen_from
from aadm_workbench.document.job.toml import LARGEST_JOB_BYTES, job_toml, read_job_table
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.scan_cloud import KINDS, make_scan
from aadm_workbench.document.scan_reading import unread
from aadm_workbench.errors import DesignError, JobError
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.file import DEPTH_MAPS

_NO_NAMES: tuple[str, ...] = ()


@dataclass(frozen=True)
class Assigned:
    """What belongs to one column: files of its sleeves and of its rebars, and which side is up, where that is known."""

    sleeves: tuple[Path, ...] = ()
    rebars: tuple[Path, ...] = ()
    up: str = ""

    @property
    def files(self) -> tuple[Path, ...]:
        """All of them."""
        return (*self.sleeves, *self.rebars)


def names_of(column: Any) -> tuple[str, ...]:
    """All that a column is called, in jobs and in names of files."""
    try:
        known = column_design(column).names
    except DesignError:
        known = _NO_NAMES
    return tuple(dict.fromkeys(name for name in (column.ColumnId, column.PieceMark, column.GlobalId, *known) if name))


def assigned_now(column: Any) -> Assigned:
    """What the document says of a column."""
    files = {kind: tuple(Path(cloud.File) for cloud in column.Scans if cloud.Kind == kind) for kind in KINDS}
    up = column.SleevesUp if column.SleevesUp == column.RebarsUp else f"{column.SleevesUp} / {column.RebarsUp}"
    return Assigned(files[KINDS[0]], files[KINDS[1]], up)


def assigned_by_name(folder: Path, columns: Sequence[Any]) -> dict[str, Assigned]:
    """Scans of a folder for each column, by its object's name; what the document says else is kept."""
    found = scans_by_name(folder, {column.Name: names_of(column) for column in columns})
    now = {column.Name: assigned_now(column) for column in columns}
    return {
        name: Assigned(sleeves or now[name].sleeves, rebars or now[name].rebars, now[name].up)
        for name, (sleeves, rebars) in found.items()
    }


def owner_by_name(file: Path, columns: Sequence[Any]) -> Any:
    """The column that a scan's name speaks of; None where it speaks of none, or of several."""
    names = owners_of(file.name, {column.Name: names_of(column) for column in columns})
    return next((column for column in columns if [column.Name] == names), None)


def shortest_name(columns: Sequence[Any]) -> str:
    """The shortest name that the first of some columns shares with no other: with it a scan is found."""
    known = {column.Name: names_of(column) for column in columns}
    first = columns[0]
    own = [name for name in known[first.Name] if owners_of(name, known) == [first.Name]]
    return min(own, key=len, default=str(first.ColumnId))


def assigned_by_job(job: Path, columns: Sequence[Any]) -> tuple[dict[str, Assigned], list[str]]:
    """What a job file says of the columns, by their objects' names; and ids of the job that no column has.

    Raises
    ------
    JobError
        Where the file is none.
    """
    by_name = {name: column for column in reversed(columns) for name in names_of(column)}
    found, unknown = {}, []
    for entry in read_job_table(job)["columns"]:
        column = by_name.get(str(entry["id"]))
        if column is None:
            unknown.append(str(entry["id"]))
            continue
        sleeves, rebars = (_paths(entry.get(kind), job.parent) for kind in KINDS)
        ups = [str(entry.get(key, entry.get("up", ""))) for key in ("sleeves_up", "rebars_up")]
        found[column.Name] = Assigned(sleeves, rebars, ups[0] if ups[0] == ups[1] else " / ".join(ups))
    return found, unknown


def put_scans(
    column: Any, assigned: Assigned, *, units: str, camera: Mapping[str, float] | None, depth_scale_mm: float | None
) -> None:
    """Give a column these scans; those that it has already, read alike, stay as they are.

    Raises
    ------
    JobError
        Where ``up`` is no direction.
    """
    ups = [one.strip() for one in assigned.up.split("/")] if "/" in assigned.up else [assigned.up.strip()] * 2
    for up in ups:
        up_deg(up, column.Label)
    column.SleevesUp, column.RebarsUp = ups[0], ups[-1]
    for kind, files in zip(KINDS, (assigned.sleeves, assigned.rebars), strict=True):
        for cloud in [cloud for cloud in column.Scans if cloud.Kind == kind]:
            if Path(cloud.File) not in files or cloud.Units != units:
                column.Scans = [one for one in column.Scans if one.Name != cloud.Name]
                column.Document.removeObject(cloud.Name)
        there = [Path(cloud.File) for cloud in column.Scans if cloud.Kind == kind]
        for file in files:
            if file not in there:
                needs = camera is not None and (file.is_dir() or file.suffix.lower() in DEPTH_MAPS)
                read = unread(camera if needs else None, depth_scale_mm if needs else None)
                make_scan(column, file, kind, units, read)


def camera_work(file: Path) -> Work:
    """What the private process is asked about a file of intrinsics."""
    question = json.dumps({"about": "camera", "file": str(file.resolve())})
    return Work(("ask", "question.json", "answer.json"), {"question.json": question}, "answer.json")


def save_job(columns: Sequence[Any], job: Path, profile: str = "") -> None:
    """Write the job of these columns; where there is one, what the document does not know of is kept.

    A job that says the same already stays as it is, with its comments. Designs that are those of a model's file name
    that file; others are written beside the job. ``profile`` is the file of what was learned of the camera.

    Raises
    ------
    AadmError
        Where a column cannot be checked, or the file cannot be written.
    """
    earlier = read_job_table(job) if job.exists() else None
    model = model_of_all(columns)
    designs = job.with_name(f"{job.stem}-design.json")
    try:
        if model is None:
            job.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(designs, design_text(columns).encode())
        named = designs.name if model is None else seen_from(model, job.parent)
        table = job_table(columns, named, job.parent, earlier, profile)
        if table != earlier:
            job.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(job, job_toml(table).encode())
    except OSError as error:
        raise JobError.about(job, "document.job_unwritten", why=error.strerror) from error


def camera_file_near(folder: Path) -> Path | None:
    """A job or a file of intrinsics in a folder of scans or in the one around it; None where there is none, or several.

    It is only offered: what is in it is read, and refused, by the private process.
    """
    for place in (folder, folder.parent):
        found = [path for path in sorted(place.glob("*.toml")) if _speaks_of_a_camera(path)]
        if len(found) == 1:
            return found[0]
    return None


def _speaks_of_a_camera(path: Path) -> bool:
    try:
        text = read_bounded(path, LARGEST_JOB_BYTES).decode(errors="replace")
    except (BoundsError, OSError):
        return False
    return re.search(r"^\s*fx\s*=", text, re.MULTILINE) is not None


def _paths(written: Any, folder: Path) -> tuple[Path, ...]:
    names = [written] if isinstance(written, str) else list(written or ())
    return tuple(folder / name for name in names if isinstance(name, str))
