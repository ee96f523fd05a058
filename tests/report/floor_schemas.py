"""The sample floor in other schemas, entity by entity, and reports of checks that never took place."""

from __future__ import annotations

import contextlib
import hashlib
import json
from pathlib import Path
from typing import Any

import ifcopenshell
import numpy as np

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.model import AssemblyPoint, ColumnDesign
from aadm_workbench.report.json import profile_document
from tests.report.typed import typed

SCHEMAS = ("IFC2X3", "IFC4", "IFC4X3")

_WANTED_BY_2X3 = {
    "IfcSite": {"CompositionType": "ELEMENT"},
    "IfcBuilding": {"CompositionType": "ELEMENT"},
    "IfcBuildingStorey": {"CompositionType": "ELEMENT"},
    "IfcReinforcingBar": {"NominalDiameter": 20.0, "CrossSectionArea": 314.16, "BarRole": "MAIN"},
    "IfcElementAssembly": {"PredefinedType": "USERDEFINED"},
}


def converted(source: Path, schema: str, out: Path) -> Path:
    """A model of schema IFC4 with the same GlobalIds in another schema; what that schema lacks is left out."""
    file = ifcopenshell.open(source)
    if schema == "IFC4":
        out.write_bytes(source.read_bytes())
        return out
    made: Any = ifcopenshell.file(schema=schema)
    made.header.file_name.time_stamp = "2026-01-01T00:00:00"
    history = _history(made) if schema == "IFC2X3" else None
    known: dict[int, Any] = {}
    for entity in sorted(file, key=lambda entity: entity.id()):
        if schema == "IFC2X3" and entity.is_a("IfcReinforcingBarType"):
            continue
        if entity.is_a("IfcRelDefinesByType") and known.get(entity.RelatingType.id()) is None:
            continue
        known[entity.id()] = _carried_over(made, entity, known)
        if history is not None:
            _fill_2x3(known[entity.id()], history)
    made.write(str(out))
    return out


def _carried_over(made: Any, entity: Any, known: dict[int, Any]) -> Any:
    """An entity in the other file."""

    def carried(value: Any) -> Any:
        if isinstance(value, tuple):
            return [carried(item) for item in value]
        if not isinstance(value, ifcopenshell.entity_instance):
            return value
        return known.get(value.id()) if value.id() else made.create_entity(value.is_a(), value.wrappedValue)

    target = made.create_entity(entity.is_a())
    for name, value in entity.get_info(include_identifier=False).items():
        if name != "type" and value is not None and hasattr(target, name):
            with contextlib.suppress(RuntimeError):  # derived: nobody sets it
                setattr(target, name, carried(value))
    return target


def _fill_2x3(entity: Any, history: Any) -> None:
    """What IFC4 leaves to a default and IFC2X3 wants to see."""
    if entity.is_a("IfcRoot"):
        entity.OwnerHistory = history
    for name, value in _WANTED_BY_2X3.get(entity.is_a(), {}).items():
        setattr(entity, name, value)
    if entity.is_a("IfcParameterizedProfileDef") and entity.Position is None:
        at = entity.file.create_entity("IfcCartesianPoint", (0.0, 0.0))
        entity.Position = entity.file.create_entity("IfcAxis2Placement2D", at)
    if entity.is_a("IfcSweptDiskSolid"):
        entity.StartParam, entity.EndParam = 0.0, float(len(entity.Directrix.Points) - 1)


def _history(file: Any) -> Any:
    person = file.create_entity("IfcPerson", FamilyName="Wang")
    organization = file.create_entity("IfcOrganization", Name="Yard")
    application = file.create_entity("IfcApplication", organization, "1", "author", "author")
    user = file.create_entity("IfcPersonAndOrganization", person, organization)
    return file.create_entity("IfcOwnerHistory", user, application, None, "ADDED", CreationDate=1)


def made_report(model: Path, *, name: str = "层 3", seed: int = 1, only: tuple[str, ...] = ()) -> dict[str, Any]:
    """A report as a check of a model would give it: its points, each off by up to a few millimetres."""
    design = read_ifc(model)
    rng = np.random.default_rng(seed)
    columns = [_column(column, rng) for column in design.columns if not only or column.id in only]
    document = {
        "schema": 1,
        "tool": {"name": "aadm", "version": "0.1.0"},
        "job": {"name": name, "sha256": "b" * 64, "method": "refined", "decision": "guarded"},
        "capture": {"date": "2026-11-20", "operator": "王"},
        "model": {"source": model.name, "sha256": hashlib.sha256(model.read_bytes()).hexdigest()},
        "profile": profile_document(load_profile("cn")),
        "summary": {"pass": 0, "fail": len(columns), "inconclusive": 0, "not_measured": 0, "error": 0},
        "columns": columns,
    }
    plain: dict[str, Any] = json.loads(json.dumps(document))
    typed(plain)
    return plain


def _column(column: ColumnDesign, rng: np.random.Generator) -> dict[str, Any]:
    T = None if column.T_model_column is None else np.asarray(column.T_model_column).tolist()
    sleeves, rebars = (_group(points, rng) for points in (column.sleeves, column.rebars))
    return {
        "id": column.id,
        "global_id": column.global_id,
        "piece_mark": column.piece_mark,
        "storey": column.storey,
        "grid": column.grid,
        "size_mm": list(column.size_mm) if column.size_mm else None,
        "T_model_column": T,
        "verdict": "fail",
        "goes_on": "fail",
        "reasons": ["S1 is off", "S2 not measured: plugged"],
        "sleeves": sleeves,
        "rebars": rebars | {"absolute": None} if column.rebars else None,
        "trial_assembly": None,
        "hoisting": [],
    }


def _group(points: tuple[AssemblyPoint, ...], rng: np.random.Generator) -> dict[str, Any]:
    """The second point is not measured, the first fails."""
    entries = []
    for number, point in enumerate(points, start=1):
        centre = [round(float(value), 4) for value in point.centre]
        offset = [round(float(value), 4) for value in rng.normal(0.0, 0.4, 2)]
        if number == 1:
            offset = [2.5, -1.25]
        measured = number != 2
        verdict = "fail" if number == 1 else "pass" if measured else "not_measured"
        entries.append(
            {
                "label": point.label,
                "global_id": point.global_id,
                "design_mm": centre,
                "scan_mm": [1.0, 2.0, 800.0] if measured else None,
                "aligned_mm": [centre[0] + offset[0], centre[1] + offset[1], centre[2]] if measured else None,
                "diameter_mm": 36.1234 if measured else None,
                "axis_tilt_deg": 0.25 if measured else None,
                "offset_mm": offset if measured else None,
                "deviation_mm": round(float(np.hypot(*offset)), 4) if measured else None,
                "u_mm": 0.0512 if measured else None,
                "limit_mm": 2.0,
                "verdict": verdict,
                "reason": {"fail": f"{point.label} is off", "not_measured": "plugged"}.get(verdict, ""),
                "probability": 0.5 if measured else None,
                **({"exposed_length_mm": None} if point.label.startswith("R") else {}),
            }
        )
    return {
        "source": "scans/a.tiff",
        "sha256": "c" * 64,
        "method": "refined",
        "expected": len(entries),
        "found": len(entries) - 1,
        "verdict": "fail",
        "points": entries,
        "spacing": [],
        "fit": None,
        "rules": [],
        "reasons": ["off"],
        "notes": [],
        "quality": {},
    }
