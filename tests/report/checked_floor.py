"""Floors that are checked without any scan: real verdicts, real repairs, exact centres, columns turned in the plan."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from hashlib import sha256
from typing import Any
from unittest import mock

import numpy as np

from aadm_workbench.assembly.mould.moulds import assess_moulds
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.inspection import measure
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import Array, AssemblyPoint, ColumnReport, Extraction, JobReport, Kind, Scan, Verdict
from aadm_workbench.report.json import encoded_report
from aadm_workbench.twin.parts import ring

PROFILE = load_profile("cn")
CENTRES = ring(240.0, 240.0, 4)
DIAMETERS_MM = {Kind.SLEEVE: 36.0, Kind.REBAR: 20.0}
DESIGN = {
    "sleeve_diameter": DIAMETERS_MM[Kind.SLEEVE],
    "rebar_diameter": DIAMETERS_MM[Kind.REBAR],
    "rebar_outer_diameter": 22.0,
    "embedded_length": 160.0,
    "size": [600.0, 600.0],
    "centres": CENTRES.tolist(),
}
GRID_DEG = 30.0
HOSTILE = "<script>window.hacked=1</script>"
U_MM = 0.05

# A scan frame as a camera has it that looks down: x right, y down, z forward, 1.3 m above the tops.
LOOKING_DOWN = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]])


@dataclass(frozen=True)
class Case:
    """A column of a floor: what of it is off, mm, column frame; None for a point that is not seen.

    ``off`` counts the points in the order of :data:`CENTRES`; their labels follow another.
    """

    name: str
    grid: str | None = None
    turned_deg: float = 0.0
    off: Mapping[str, tuple[float, float] | None] = field(default_factory=dict)
    kinds: tuple[Kind, ...] = (Kind.SLEEVE, Kind.REBAR)
    u_mm: float = U_MM


def place_of(grid: str) -> Array:
    """Where the crossing of a grid label stands, mm: letters count along one axis, numbers along the other."""
    letter, number = grid.split("/")
    along = np.array([6000.0 * (int(number) - 1), 7000.0 * (ord(letter) - ord("A"))])
    angle = math.radians(GRID_DEG)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return np.array([250_000.0, 90_000.0]) + turn @ along


def checked(case: Case) -> ColumnReport:
    """The column's report; a broken file where it has no kinds."""
    design = inline_design(case.name, DESIGN)
    if case.grid is not None:
        angle = math.radians(GRID_DEG + case.turned_deg)
        T = np.eye(4)
        T[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
        T[:2, 3] = place_of(case.grid)
        design = replace(design, grid=case.grid, storey="3F", piece_mark="PCZ-1", T_model_column=T)
    if not case.kinds:
        named = {"grid": design.grid, "storey": design.storey, "T_model_column": design.T_model_column}
        reason = (f"scans/{case.name}.tiff: ends or breaks off within its header (12 bytes); copy it again",)
        return ColumnReport(case.name, Verdict.ERROR, Verdict.NOT_ASSESSED, reason, **named)
    files = {kind: f"{case.name}-{kind.plural}.ply" for kind in case.kinds}
    scans = {kind: (Scan(np.zeros((9, 3)), file, sha256(file.encode()).hexdigest()),) for kind, file in files.items()}
    up = {f"{kind.plural}_up_deg": 90.0 for kind in case.kinds}
    given = ColumnScans(scans.get(Kind.SLEEVE, ()), scans.get(Kind.REBAR, ()), **up)
    with mock.patch.object(measure, "extract_sizes", lambda scan, kind, *_, **__: _found(case, kind)):
        return check_column(design, given, CheckSettings(PROFILE))


def _found(case: Case, kind: Kind) -> Extraction:
    """Exact centres in a camera's frame: bars from above, the foot from below."""
    letter = kind.letter
    points = []
    rotation = LOOKING_DOWN if kind is Kind.REBAR else LOOKING_DOWN @ np.diag([-1.0, 1.0, -1.0])
    for number, xy in enumerate(CENTRES, start=1):
        off = case.off.get(f"{letter}{number}", (0.0, 0.0))
        if off is None:
            continue
        place = rotation @ np.array([*(xy + off), 0.0]) + [0.0, 0.0, 1300.0]
        axis = rotation @ np.array([0.0, 0.0, 1.0])
        diameter_mm = DIAMETERS_MM[kind]
        points.append(AssemblyPoint("", kind, place, axis, diameter_mm, case.u_mm**2 * np.eye(3)))
    up = rotation @ np.array([0.0, 0.0, 1.0])
    return Extraction(
        kind, "refined", tuple(points), None, up, "exact", quality={"point_pitch_mm": 0.5, "note": HOSTILE}
    )


def floor_report(*cases: Case) -> dict[str, Any]:
    """report.json of some columns, as it is read back."""
    columns = tuple(checked(case) for case in cases)
    report = JobReport(
        {"name": "aadm", "version": "0.0"},
        {"name": f"Floor 3 {HOSTILE}", "sha256": "c" * 64},
        {"date": "2026-11-20", "operator": "=2+5"},
        {"source": "floor3.ifc", "sha256": "d" * 64},
        PROFILE,
        columns,
        assess_moulds(columns, PROFILE),
    )
    document: dict[str, Any] = json.loads(encoded_report(report))
    return document


def far_apart(*, reach_mm: float) -> dict[str, tuple[float, float]]:
    """Two bars in opposite corners that stand too far from each other, so that one has to be bent."""
    return {"R1": (-reach_mm, -0.85 * reach_mm), "R7": (reach_mm, 0.85 * reach_mm)}


CASES = (
    Case("C-1", "A/1", 0.0, {"S3": (0.4, -0.3), "R5": (0.3, 0.6)}),
    Case("C-2", "A/2", 90.0, {"R5": (3.0, 1.0)}),
    Case("C-3", "A/3", 180.0, far_apart(reach_mm=3.4)),
    Case("C-4", "B/1", -90.0, {"S7": None}),
    Case("C-5", "B/2", kinds=()),
    Case("C-6", "B/3", 0.0, {"S2": (0.1, 0.2)}, kinds=(Kind.SLEEVE,)),
    Case("C-7", "C/2", 0.0, {"R4": (1.7, 0.9)}, u_mm=0.2),
    Case(HOSTILE, None, 0.0, {"R9": (-0.5, 0.2)}),
)
"""A pass, one out of tolerance that goes on, one that does not, one not measured, an error, a foot alone, one that is
inconclusive, and one of hostile name that no model places."""
