"""The check of one column of a document: asked of the private process as a job, its report kept in the document."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.document.cloud import distance_from_design
from aadm_workbench.document.column import column_design
from aadm_workbench.document.job.table import DESIGN_FILE, design_text, job_table
from aadm_workbench.document.job.toml import job_toml
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.result import make_result
from aadm_workbench.document.scan_cloud import kind_of, lay_on_design
from aadm_workbench.errors import ScanError
from aadm_workbench.model import Kind

CHECKED = frozenset({0, 10, 11, 12})
"""Exit codes of a job whose columns were looked at: report.json is there."""


def check_work(column: Any, profile: str = "") -> Work:
    """What the private process is asked to do; its answer is a whole report.json with one column.

    ``profile`` is the file of what was learned of the camera; empty without.

    Raises
    ------
    AadmError
        Where there is nothing to check, or a scan is no longer what was imported.
    """
    table = job_table([column], DESIGN_FILE, profile=profile)
    files = {"job.toml": job_toml(table), DESIGN_FILE: design_text([column])}
    for cloud in column.Scans:
        check_unchanged(cloud)
    arguments = ("check", "job.toml", "--out", "out", "--method", column.Method, "--json")
    return Work(arguments, files, "out/report.json", CHECKED)


def keep(column: Any, report: Mapping[str, Any], *, checked_at: str | None = None) -> Any:
    """Put the outcome of a check into the document: the result, and its scans where they lie on the design.

    Parameters
    ----------
    checked_at
        When, in UTC; now by default.
    """
    found, report = report["columns"][0], {**report, "model": _model_of(column)}
    when = datetime.now(UTC).isoformat(timespec="seconds") if checked_at is None else checked_at
    result = make_result(column, report, found, when)
    lay_scans(column, found)
    return result


def lay_scans(column: Any, found: Mapping[str, Any]) -> None:
    """Put the scans of a column where a check has found that they lie; ``found`` is its entry of report.json."""
    design = column_design(column)
    for kind in Kind:
        clouds = [cloud for cloud in column.Scans if kind_of(cloud) is kind]
        fit = (found.get(kind.plural) or {}).get("fit")
        # Of several views the report keeps the pose of the first.
        if fit is not None and clouds and clouds[0].Points:
            T_design_scan = np.array(fit["T_design_scan"], dtype=np.float64)
            points = np.array([tuple(point) for point in clouds[0].Points]).reshape(-1, 3)
            placed = points @ T_design_scan[:3, :3].T + T_design_scan[:3, 3]
            distances_mm = distance_from_design(placed, design, kind)
            lay_on_design(clouds[0], T_design_scan, distances_mm, column.Placement)


def _model_of(column: Any) -> dict[str, str] | None:
    """The model as reports name it: that which the design was taken from, not the file that handed it over."""
    if not column.ModelSha256:
        return None
    project = {"ifc_project": column.ModelProject} if column.ModelProject else {}
    return {"source": Path(column.ModelFile).name, "sha256": column.ModelSha256, **project}


def check_unchanged(cloud: Any) -> None:
    """Raise ScanError where a scan is no longer what was imported."""
    if not cloud.File:
        raise ScanError.because("document.scan_nameless", label=cloud.Label)
    file = Path(cloud.File)
    if not file.exists():
        raise ScanError.about(file, "document.scan_gone")
    # The hash of a capture is that of its parts, which the process that reads it knows.
    if cloud.Sha256 and file.is_file():
        with file.open("rb") as stream:
            now = hashlib.file_digest(stream, "sha256").hexdigest()
        if now != cloud.Sha256:
            raise ScanError.about(file, "document.scan_changed")
