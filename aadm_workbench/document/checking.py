"""The check of one column of a document, in three steps, so that the long one may run beside the window.

:func:`prepare` and :func:`keep` touch the document: main thread. :func:`run` only calculates: any thread.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench import __version__
from aadm_workbench.design.directions import up_deg
from aadm_workbench.document.cloud import distance_from_design
from aadm_workbench.document.column import column_design
from aadm_workbench.document.display.design_text import FROM_REPORT, write_design
from aadm_workbench.document.packages import naming_packages
from aadm_workbench.document.result import make_result
from aadm_workbench.document.scan_cloud import camera_of, kind_of, lay_on_design
from aadm_workbench.errors import AadmError, DesignError, ScanError
from aadm_workbench.model import Camera, ColumnDesign, Kind

Stage = Callable[[str], AbstractContextManager[None]]


@dataclass(frozen=True)
class ScanSource:
    """A scan file as it is to be read; ``sha256`` as it was imported."""

    kind: Kind
    file: Path
    units: str
    camera: Camera | None
    depth_scale_mm: float | None
    sha256: str


@dataclass(frozen=True, eq=False)
class CheckRequest:
    """All that the check of one column needs, without its document."""

    design: ColumnDesign
    scans: tuple[ScanSource, ...]
    sleeves_up_deg: float | None
    rebars_up_deg: float | None
    method: str
    tolerances: str
    decision: str
    turns: bool
    name: str


def prepare(column: Any) -> CheckRequest:
    """What there is to check of a column object.

    Raises
    ------
    AadmError
        Where it has no design or no scans, or says something that cannot be.
    """
    if not column.Scans:
        raise ScanError(f"{column.Label} has no scans yet: import one of its sleeves, its rebars or both")
    design = column_design(column)
    if any(point.why == FROM_REPORT for point in (*design.sleeves, *design.rebars)):
        raise DesignError(
            f"{column.Label} was made from a report, which holds no diameters of the design: sample its design first"
        )
    return CheckRequest(
        design=design,
        scans=tuple(_source(cloud) for cloud in column.Scans),
        sleeves_up_deg=up_deg(column.SleevesUp, f"{column.Label}, SleevesUp"),
        rebars_up_deg=up_deg(column.RebarsUp, f"{column.Label}, RebarsUp"),
        method=column.Method,
        tolerances=column.Tolerances,
        decision=column.Decision,
        turns=column.Turns,
        name=column.Document.Label,
    )


def run(request: CheckRequest, stage: Stage = lambda name: nullcontext()) -> dict[str, Any]:
    """Check a column; touches no document.

    Returns
    -------
    dict
        As report.json, with one column.

    Raises
    ------
    AadmError
        Where a scan cannot be read, or a package is missing; the message says what to do.
    """
    with naming_packages():
        return _run(request, stage)


def _run(request: CheckRequest, stage: Stage) -> dict[str, Any]:
    from aadm_workbench.assembly.tolerances import load_profile
    from aadm_workbench.inspection.check import CheckSettings, ColumnScans, check_column
    from aadm_workbench.model import JobReport
    from aadm_workbench.report.json import encode, report_document

    profile = load_profile(request.tolerances)
    settings = CheckSettings(profile, request.method, request.decision, None, request.turns)  # type: ignore[arg-type]
    with stage("read"):
        read = {kind: tuple(_read(one, request) for one in request.scans if one.kind is kind) for kind in Kind}
    scans = ColumnScans(read[Kind.SLEEVE], read[Kind.REBAR], request.sleeves_up_deg, request.rebars_up_deg)
    found = check_column(request.design, scans, settings, stage)
    job = {
        "name": request.name,
        "sha256": _fingerprint(request),
        "method": request.method,
        "decision": request.decision,
        "seed": str(settings.seed),
    }
    report = JobReport({"name": "aadm", "version": __version__}, job, {}, None, profile, (found,))
    # Through its text: what the document keeps has the same digits as a report on disk.
    plain: dict[str, Any] = json.loads(encode(report_document(report)))
    return plain


def _fingerprint(request: CheckRequest) -> str:
    """Hash of all that was asked, since there is no job file that could be hashed."""
    asked = [
        write_design(request.design),
        [(one.kind, one.sha256, one.units, one.depth_scale_mm, repr(one.camera)) for one in request.scans],
        [request.sleeves_up_deg, request.rebars_up_deg, request.method, request.tolerances, request.decision],
        request.turns,
    ]
    return hashlib.sha256(json.dumps(asked).encode()).hexdigest()


def keep(column: Any, report: dict[str, Any], *, checked_at: str | None = None) -> Any:
    """Put the outcome of a check into the document: the result, and its scans where they lie on the design.

    Parameters
    ----------
    checked_at
        When, in UTC; now by default.
    """
    found = report["columns"][0]
    when = datetime.now(UTC).isoformat(timespec="seconds") if checked_at is None else checked_at
    result = make_result(column, report, found, when)
    design = column_design(column)
    for kind in Kind:
        clouds = [cloud for cloud in column.Scans if kind_of(cloud) is kind]
        fit = (found.get(kind.plural) or {}).get("fit")
        # Of several views the report keeps the pose of the first.
        if fit is not None and clouds:
            T_design_scan = np.array(fit["T_design_scan"], dtype=np.float64)
            points = np.array([tuple(point) for point in clouds[0].Points]).reshape(-1, 3)
            placed = points @ T_design_scan[:3, :3].T + T_design_scan[:3, 3]
            distances_mm = distance_from_design(placed, design, kind)
            lay_on_design(clouds[0], T_design_scan, distances_mm, column.Placement)
    return result


def _source(cloud: Any) -> ScanSource:
    if not cloud.File:
        raise ScanError(f"{cloud.Label} names no file: import the scan again")
    return ScanSource(
        kind_of(cloud), Path(cloud.File), cloud.Units, camera_of(cloud), cloud.DepthScale or None, cloud.Sha256
    )


def _read(source: ScanSource, request: CheckRequest) -> Any:
    from aadm_workbench.scan.plausible import check_plausible, extent_mm
    from aadm_workbench.scan.read import read_scan

    points = request.design.points(source.kind)
    if not points:
        raise AadmError(f"the design of {request.design.id} has no {source.kind.plural}, but {source.file} shows them")
    scan = read_scan(
        source.file,
        units=source.units,
        camera=source.camera,
        depth_scale_mm=source.depth_scale_mm,
        source=source.file.name,
    )
    if source.sha256 and scan.sha256 != source.sha256:
        raise ScanError(f"{source.file}: has changed since it was imported; import it again, and check what it shows")
    return check_plausible(scan, extent_mm(points))
