"""A column of a document as a job file, so that the panel asks what the command line would ask."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from aadm_workbench.design.design_text import write_model
from aadm_workbench.design.directions import up_deg
from aadm_workbench.document.column import column_design
from aadm_workbench.document.display.reported_design import FROM_REPORT
from aadm_workbench.document.scan_cloud import kind_of
from aadm_workbench.errors import DesignError, ScanError
from aadm_workbench.model import Kind

DESIGN_FILE = "design.json"
_INTRINSICS = ("fx", "fy", "cx", "cy", "width", "height", "scale_error")


def job_text(column: Any) -> str:
    """The text of a job that checks one column of a document; it names :data:`DESIGN_FILE` beside it as its model.

    Raises
    ------
    AadmError
        Where the column has no design or no scans, or says something that cannot be.
    """
    scans = list(column.Scans)
    if not scans:
        raise ScanError(f"{column.Label} has no scans yet: import one of its sleeves, its rebars or both")
    lines = [
        "schema = 1",
        f"name = {_quoted(column.Document.Label)}",
        f"units = {_quoted(_of_all(scans, 'Units', column))}",
        f"tolerances = {_quoted(_tolerances(column))}",
        f"decision = {_quoted(column.Decision)}",
        f"turns = {'true' if column.Turns else 'false'}",
        f"model = {{ path = {_quoted(DESIGN_FILE)} }}",
        *_camera(scans, column),
        "",
        "[[columns]]",
        f"id = {_quoted(column.ColumnId)}",
        *_scans(scans),
    ]
    for key, up in (("sleeves_up", column.SleevesUp), ("rebars_up", column.RebarsUp)):
        degrees = up_deg(up, f"{column.Label}, {key}")
        if degrees is not None:
            lines.append(f"{key} = {degrees!r}")
    return "\n".join(lines) + "\n"


def design_text(column: Any) -> str:
    """The text of :data:`DESIGN_FILE`: the column's design as the document holds it, and where it was taken from.

    Raises
    ------
    DesignError
        Where the column has none, or one from a report.
    """
    design = column_design(column)
    if any(point.why == FROM_REPORT for point in (*design.sleeves, *design.rebars)):
        raise DesignError(
            f"{column.Label} was made from a report, which holds no diameters of the design: sample its design first"
        )
    origin = {"source": Path(column.ModelFile).name or column.Document.Label, "sha256": column.ModelSha256}
    return write_model(origin, {column.ColumnId: design})


def _scans(scans: list[Any]) -> list[str]:
    """The files, absolute; several of a kind are several views."""
    lines = []
    for kind in Kind:
        files = [cloud.File for cloud in scans if kind_of(cloud) is kind]
        if files:
            named = _quoted(files[0]) if len(files) == 1 else f"[{', '.join(map(_quoted, files))}]"
            lines.append(f"{kind.plural} = {named}")
    return lines


def _camera(scans: list[Any], column: Any) -> list[str]:
    """Intrinsics of the scans that were imported with some; a job has one camera."""
    with_camera = [cloud for cloud in scans if cloud.Camera]
    if not with_camera:
        return []
    camera = json.loads(_of_all(with_camera, "Camera", column))
    entries = [f"{key} = {camera[key]!r}" for key in _INTRINSICS if camera.get(key) is not None]
    step_mm = {cloud.DepthScale for cloud in with_camera if cloud.DepthScale}
    if len(step_mm) > 1:
        raise ScanError(_unlike(column, "DepthScale"))
    entries += [f"depth_scale_mm = {value!r}" for value in step_mm]
    return [f"camera = {{ {', '.join(entries)} }}"]


def _of_all(scans: list[Any], name: str, column: Any) -> str:
    """A property that all scans have alike."""
    found = {str(getattr(cloud, name)) for cloud in scans}
    if len(found) > 1:
        raise ScanError(_unlike(column, name))
    return found.pop()


def _unlike(column: Any, name: str) -> str:
    return f"the scans of {column.Label} differ in {name}, and a check has one for all: import them again alike"


def _tolerances(column: Any) -> str:
    """A profile's name, or the path of its file as seen from the document."""
    written = str(column.Tolerances).strip()
    if written.lower().endswith(".toml"):
        return str(Path(column.Document.FileName or ".").absolute().parent / written)
    return written


def _quoted(text: str) -> str:
    """A text of TOML: JSON's escapes are its own."""
    return json.dumps(str(text), ensure_ascii=False)
