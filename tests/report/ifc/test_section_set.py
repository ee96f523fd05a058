"""The property set of a column's section: it says what the report says, in the model's unit, and the IDS holds it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.util.element
import pytest

from aadm_workbench.report.ifc.model import ids_path, remove_ifc, write_ifc
from aadm_workbench.report.ifc.section_set import SECTION_SET
from tests.report.floor_schemas import made_report
from tests.report.ifc_models import one_column
from tests.report.typed import typed


def edge(side: str, **more: Any) -> dict[str, Any]:
    return {"side": side, "design_mm": 200.0, "measured_mm": 201.0, "u_mm": 0.05, "seen": 1.0, **more}


def length(name: str, **more: Any) -> dict[str, Any]:
    return {"name": name, "design_mm": 400.0, "limit_mm": [-5.0, 5.0], "verdict": "pass", **more}


SECTION = {
    "verdict": "not_assessed",
    "edges": [
        edge("-y", measured_mm=None, u_mm=None, reason="too little of this edge is in the picture"),
        edge("+x", chips=[{"at_mm": 10.0, "length_mm": 30.0, "depth_mm": 8.5}]),
        edge("+y", chips=[{"at_mm": -50.0, "length_mm": 12.0, "depth_mm": 6.0}]),
        edge("-x"),
    ],
    "corners": [],
    "lengths": [
        length("x", measured_mm=402.25, deviation_mm=2.25, u_mm=0.125),
        length("y", verdict="not_measured", reason="edge -y: too little of this edge is in the picture"),
        length(
            "flatness", design_mm=0.0, measured_mm=4.5, deviation_mm=4.5, u_mm=0.1, limit_mm=[None, 4.0], verdict="fail"
        ),
    ],
    "pattern": {"verdict": "pass", "offset_mm": [1.75, -0.5], "u_mm": [0.1, 0.2], "turn_deg": -0.25, "limit_mm": 5.0},
    "squareness_deg": 0.125,
    "u_squareness_deg": 0.01,
    "rules": [],
}


def written(folder: Path, unit: str) -> tuple[Path, Path, dict[str, Any]]:
    """A model, the same with results, and what its column says of its section."""
    model, out = one_column(folder, "IFC4", unit), folder / "out.ifc"
    report = made_report(model)
    report["columns"][0]["section"] = SECTION
    write_ifc(typed(report), model, out)
    file = ifcopenshell.open(out)
    column = file.by_guid(report["columns"][0]["global_id"])
    return model, out, ifcopenshell.util.element.get_psets(column)[SECTION_SET]


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_the_section_is_told_in_the_unit_of_the_model(unit: str, tmp_path: Path) -> None:
    model, out, held = written(tmp_path, unit)
    mm = {"mm": 1.0, "m": 1000.0}[unit]
    assert held["SideX"] == pytest.approx(402.25 / mm)
    assert held["SideXDeviation"] == pytest.approx(2.25 / mm)
    assert held["SideLimit"] == pytest.approx(5.0 / mm)
    assert "SideY" not in held
    assert held["SideYVerdict"] == "not_measured"
    assert (held["PatternOffsetX"], held["PatternOffsetY"]) == pytest.approx((1.75 / mm, -0.5 / mm))
    assert held["PatternUncertainty"] == pytest.approx(0.2 / mm)
    assert (held["FlatnessVerdict"], held["Flatness"]) == ("fail", pytest.approx(4.5 / mm))
    assert (held["EdgesMeasured"], held["Chips"], held["DeepestChip"]) == (3, 2, pytest.approx(8.5 / mm))
    assert held["EdgesNotMeasured"] == "-y: too little of this edge is in the picture"
    remove_ifc(out, out)
    assert out.read_bytes() == model.read_bytes()


def test_the_ids_holds_the_section_to_its_types_and_verdicts(tmp_path: Path) -> None:
    ids = pytest.importorskip("ifctester.ids")
    _, out, _ = written(tmp_path, "m")

    def passes(path: Path) -> bool:
        checks = ids.open(str(ids_path()), validate=True)
        checks.validate(ifcopenshell.open(path))
        return all(check.status for check in checks.specifications)

    assert passes(out)
    text = out.read_text()
    for spoilt in (
        text.replace("'PatternVerdict',$,IFCLABEL('pass')", "'PatternVerdict',$,IFCLABEL('good')", 1),
        text.replace("'PatternOffsetX',$,IFCLENGTHMEASURE", "'PatternOffsetX',$,IFCREAL", 1),
        text.replace("'EdgesMeasured'", "'EdgesSeen'", 1),
    ):
        assert spoilt != text
        (tmp_path / "spoilt.ifc").write_text(spoilt)
        assert not passes(tmp_path / "spoilt.ifc")
