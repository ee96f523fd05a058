"""Results in IFC models: what is added is all that differs, the numbers come back, and it can be taken out again."""

from __future__ import annotations

import copy
import difflib
from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.geom
import ifcopenshell.util.element
import ifcopenshell.util.placement
import ifcopenshell.validate
import numpy as np
import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.errors import DesignError, ReportError
from aadm_workbench.report.ifc.model import ids_path, remove_ifc, write_ifc
from tests.report.floor_schemas import SCHEMAS, made_report
from tests.report.ifc_models import complaints_about_additions, floor, one_column, to_micrometres
from tests.report.ifc_results import read_ifc_results
from tests.report.typed import typed

HOSTILE = "C'1\";<script>alert(1)</script>\n\x01灌浆😀\\X2\\"


def expected(report: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Numbers of the points of a report by GlobalId."""
    return {
        point["global_id"]: point
        for column in report["columns"]
        for kind in ("sleeves", "rebars")
        for point in (column[kind] or {"points": ()})["points"]
    }


@pytest.mark.parametrize("schema", SCHEMAS)
def test_the_written_model_differs_only_in_what_was_added(schema: str, tmp_path: Path) -> None:
    model = floor(tmp_path, schema)
    out = tmp_path / "out.ifc"
    done = write_ifc(typed(made_report(model)), model, out, report_location="floor/报告 1.html")
    assert len(done.columns) == 8
    assert done.annotations == 8 * 22
    assert (done.missing, done.notes, done.changed) == ((), (), True)
    before, after = (path.read_text(encoding="ascii").splitlines() for path in (model, out))
    changes = difflib.SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
    assert [tag for tag, *_ in changes] == ["equal", "insert", "equal"]
    assert before[changes[1][1]] == "ENDSEC;", "everything stands at the end of the data"


@pytest.mark.parametrize("schema", SCHEMAS)
def test_numbers_come_back_to_a_micrometre(schema: str, tmp_path: Path) -> None:
    model = floor(tmp_path, schema)
    report = made_report(model)
    write_ifc(typed(report), model, tmp_path / "out.ifc")
    found = read_ifc_results(tmp_path / "out.ifc")
    points = expected(report)
    assert len(points) == 8 * 24
    for global_id, point in points.items():
        held = found[global_id]["AADM_SleeveCheck" if point["label"].startswith("S") else "AADM_RebarCheck"]
        assert (held["Label"], held["Verdict"]) == (point["label"], point["verdict"])
        assert held["Measured"] is (point["scan_mm"] is not None)
        assert held.get("Deviation") == to_micrometres(point["deviation_mm"])
        assert [held.get("OffsetX"), held.get("OffsetY")] == to_micrometres(point["offset_mm"] or [None, None])
        assert [held.get(f"AsBuilt{axis}") for axis in "XYZ"] == to_micrometres(point["aligned_mm"] or [None] * 3)
        assert (held.get("Uncertainty"), held["Limit"]) == (to_micrometres(point["u_mm"]), 2.0)
        assert held.get("AxisTilt") == point["axis_tilt_deg"]
        assert held.get("Reason", "") == point["reason"]
        if schema == "IFC4X3":
            assert found[global_id]["Pset_Tolerance"]["HorizontalTolerance"] == 4.0, "it is a diameter"
        if schema == "IFC4X3" and point["u_mm"]:
            assert found[global_id]["Pset_Uncertainty"]["HorizontalUncertainty"] == pytest.approx(4 * 0.0512, abs=5e-4)
    for column in report["columns"]:
        assert found[column["global_id"]]["AADM_ColumnCheck"]["Verdict"] == "fail"
        assert found[column["global_id"]]["AADM_ColumnCheck"]["Reasons"] == "S1 is off; S2 not measured: plugged"


@pytest.mark.parametrize("schema", SCHEMAS)
def test_writing_twice_changes_nothing_and_removing_gives_the_original(schema: str, tmp_path: Path) -> None:
    model = floor(tmp_path, schema)
    original = model.read_bytes()
    report = made_report(model, only=("C-301", "C-302"))
    other_report = made_report(model, seed=2, only=("C-301", "C-302"))
    first = write_ifc(typed(report), model, model)
    assert first.backup is not None
    assert first.backup.read_bytes() == original
    written = model.read_bytes()
    again = write_ifc(typed(report), model, model)
    assert (again.changed, again.backup, model.read_bytes()) == (False, None, written)
    other = write_ifc(typed(other_report), model, model)
    assert (other.changed, other.backup) == (True, None), "one backup for each state of the model"
    assert model.read_bytes() != written
    remove_ifc(model, model)
    assert model.read_bytes() == original


@pytest.mark.parametrize("schema", SCHEMAS)
@pytest.mark.parametrize("unit", ["mm", "m", "foot"])
def test_lengths_are_in_the_unit_of_the_model_and_it_stays_valid(schema: str, unit: str, tmp_path: Path) -> None:
    model, out = one_column(tmp_path, schema, unit), tmp_path / "out.ifc"
    report = made_report(model)
    write_ifc(typed(report), model, out, report_location="report.json")
    file = ifcopenshell.open(out)
    point = report["columns"][0]["sleeves"]["points"][0]
    held = ifcopenshell.util.element.get_psets(file.by_guid(point["global_id"]))["AADM_SleeveCheck"]
    mm = {"mm": 1.0, "m": 1000.0, "foot": 304.8}[unit]
    assert held["OffsetX"] * mm == pytest.approx(2.5, abs=1e-6)
    assert held["Limit"] * mm == pytest.approx(2.0, abs=1e-6)
    if unit == "foot":  # one unit is enough: the rules do not know units
        assert complaints_about_additions(model, out) == []
    remove_ifc(out, out)
    assert out.read_bytes() == model.read_bytes()


def test_hostile_names_survive(tmp_path: Path) -> None:
    model, out = one_column(tmp_path, name=HOSTILE), tmp_path / "out.ifc"
    report = made_report(model, name=HOSTILE)
    report["columns"][0]["reasons"] = [HOSTILE * 40]
    write_ifc(typed(report), model, out)
    file = ifcopenshell.open(out)
    held = ifcopenshell.util.element.get_psets(file.by_guid(report["columns"][0]["global_id"]))["AADM_ColumnCheck"]
    assert held["Job"] == HOSTILE
    assert held["Reasons"] == HOSTILE * 40
    remove_ifc(out, out)
    assert out.read_bytes() == model.read_bytes()


@pytest.mark.parametrize("encoding", ["gb18030", "utf-8"])
def test_raw_chinese_names_keep_their_bytes(encoding: str, tmp_path: Path) -> None:
    model, out = one_column(tmp_path, name="ZHU"), tmp_path / "out.ifc"
    model.write_bytes(model.read_bytes().replace(b"'ZHU'", "'预制柱;1'".encode(encoding)).replace(b"\n", b"\r\n"))
    write_ifc(typed(made_report(model)), model, out)
    before, after = model.read_bytes(), out.read_bytes()
    end = before.rindex(b"ENDSEC;")
    assert after.startswith(before[:end])
    assert after.endswith(b"\r\n" + before[end:])
    assert b"\n" not in after.replace(b"\r\n", b"")
    remove_ifc(out, out)
    assert out.read_bytes() == before


def test_the_design_of_a_written_model_is_that_of_the_original(tmp_path: Path) -> None:
    model, out = floor(tmp_path, "IFC4"), tmp_path / "out.ifc"
    write_ifc(typed(made_report(model)), model, out)

    @cache
    def design(path: Path) -> list[tuple[Any, ...]]:
        return [
            (
                (column.id, column.global_id, np.asarray(column.T_model_column).tolist()),
                *((point.label, point.global_id, *point.centre) for point in (*column.sleeves, *column.rebars)),
            )
            for column in read_ifc(path).columns
        ]

    assert design(out) == design(model)


def test_a_report_of_another_model_is_refused(tmp_path: Path) -> None:
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    report = made_report(model)
    model.write_text(model.read_text().replace("'C-1'", "'C-2'"))
    with pytest.raises(ReportError, match=r"has changed since.*--force"):
        write_ifc(typed(report), model, out)
    assert not out.exists()
    assert write_ifc(typed(report), model, out, force=True).columns == ("C-1",)


def test_a_report_without_a_model_or_of_other_columns_is_refused(tmp_path: Path) -> None:
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    report = made_report(model)
    elsewhere = copy.deepcopy(report)
    elsewhere["columns"][0]["global_id"] = "0" * 22
    with pytest.raises(ReportError, match="holds none of the report's columns"):
        write_ifc(typed(elsewhere), model, out)
    report["model"] = None
    with pytest.raises(ReportError, match="not against a model"):
        write_ifc(typed(report), model, out)
    with pytest.raises(ReportError, match="holds no results"):
        remove_ifc(model, out)
    with pytest.raises(DesignError, match="does not exist"):
        write_ifc(typed(report), tmp_path / "no.ifc", out)
    assert not out.exists()


def test_columns_that_the_model_lacks_are_named(tmp_path: Path) -> None:
    model, out = floor(tmp_path, "IFC4"), tmp_path / "out.ifc"
    report = made_report(model)
    report["columns"][0]["global_id"] = None
    done = write_ifc(typed(report), model, out)
    assert done.missing == ("column C-301",)
    assert len(done.columns) == 7


def test_several_bars_in_one_entity_are_told_apart(tmp_path: Path) -> None:
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    report = made_report(model)
    points = report["columns"][0]["rebars"]["points"]
    points[2]["global_id"] = points[0]["global_id"]
    write_ifc(typed(report), model, out)
    held = read_ifc_results(out)[points[0]["global_id"]]
    assert held["AADM_RebarCheck"]["Label"] == "R1", "the worst of them"
    assert held["AADM_RebarCheck_R1"]["Deviation"] == to_micrometres(points[0]["deviation_mm"])
    assert held["AADM_RebarCheck_R3"]["Deviation"] == to_micrometres(points[2]["deviation_mm"])


@pytest.mark.parametrize("schema", SCHEMAS)
def test_the_ids_passes_on_what_was_written_and_on_nothing_else(schema: str, tmp_path: Path) -> None:
    ids = pytest.importorskip("ifctester.ids")
    model, out = one_column(tmp_path, schema, "m"), tmp_path / "out.ifc"
    write_ifc(typed(made_report(model)), model, out)

    def passes(path: Path) -> bool:
        checks = ids.open(str(ids_path()), validate=True)
        checks.validate(ifcopenshell.open(path))
        return all(check.status for check in checks.specifications)

    assert passes(out)
    assert not passes(model), "a model in which nothing was checked does not pass"
    text = out.read_text()
    for spoilt in (
        text.replace("'Verdict',$,IFCLABEL('fail')", "'Verdict',$,IFCLABEL('good')", 1),
        text.replace("'OffsetX',$,IFCLENGTHMEASURE", "'OffsetX',$,IFCREAL", 1),
        text.replace("'Reasons'", "'Remarks'", 1),
        text.replace("'Reason',$,IFCTEXT('plugged')", "'Remark',$,IFCTEXT('plugged')", 1),
    ):
        assert spoilt != text
        (tmp_path / "spoilt.ifc").write_text(spoilt)
        assert not passes(tmp_path / "spoilt.ifc")


def test_records_say_what_was_done(tmp_path: Path) -> None:
    for schema in SCHEMAS:
        model, out = one_column(tmp_path, schema), tmp_path / "out.ifc"
        write_ifc(typed(made_report(model)), model, out, report_location="../floor 3/报告.html")
        file = ifcopenshell.open(out)
        column = file.by_type("IfcColumn")[0]
        assert [rel.RelatingProcess.ObjectType for rel in column.HasAssignments] == ["INSPECTION"]
        kinds = {rel.is_a(): rel for rel in column.HasAssociations}
        link = kinds["IfcRelAssociatesDocument"].RelatingDocument.Location
        assert link == "../floor%203/%E6%8A%A5%E5%91%8A.html"
        approval = kinds["IfcRelAssociatesApproval"].RelatingApproval
        assert "Not Approved" in (getattr(approval, "Status", None), getattr(approval, "ApprovalStatus", None))


LAYOUTS: dict[str, Callable[[str], str]] = {
    "one line": lambda text: text.replace("\n", ""),
    "data ends within a line": lambda text: text.replace("\nENDSEC;\nEND-ISO", "ENDSEC;\nEND-ISO"),
    "comments": lambda text: text.replace("DATA;\n", "DATA; /* it's; #9999=IFCWALL('x'); */\n").replace(
        "\n#20=", "\n/* a;b */ #20="
    ),
    "statements over lines": lambda text: text.replace("=IFCBUILDINGSTOREY(", " = \n IFCBUILDINGSTOREY ("),
    "byte order mark": lambda text: f"\ufeff{text}",
    "keyword in a name": lambda text: text.replace("'2F'", "'ENDSEC; it''s /* 2F'"),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_files_that_are_laid_out_differently(layout: str, tmp_path: Path) -> None:
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    text = LAYOUTS[layout](model.read_text())
    assert text != model.read_text()
    model.write_bytes(text.encode())
    report = made_report(model)
    assert write_ifc(typed(report), model, out).annotations == 6
    assert not write_ifc(typed(report), out, out).changed
    remove_ifc(out, out)
    assert out.read_bytes() == model.read_bytes()


def test_each_night_replaces_the_results_of_the_night_before(tmp_path: Path) -> None:
    """The model is checked, written into, checked again as it is now, and written into again."""
    model = one_column(tmp_path)
    original = model.read_bytes()
    write_ifc(typed(made_report(model)), model, model)
    second = made_report(model, seed=2)
    first_size = model.stat().st_size
    write_ifc(typed(second), model, model)
    written = model.read_bytes()
    added = first_size - len(original)
    assert abs(len(written) - first_size) < 0.1 * added, "replaced, not added: marks share what is drawn, more or less"
    assert not write_ifc(typed(second), model, model).changed, "the model that was checked is known from its own record"
    assert model.read_bytes() == written
    offset = second["columns"][0]["sleeves"]["points"][2]["offset_mm"]
    held = read_ifc_results(model)[second["columns"][0]["sleeves"]["points"][2]["global_id"]]["AADM_SleeveCheck"]
    assert [held["OffsetX"], held["OffsetY"]] == to_micrometres(offset)
    remove_ifc(model, model)
    assert model.read_bytes() == original
    assert [path.name for path in tmp_path.glob("*.bak")] == [f"model.ifc.{sha256(original).hexdigest()[:12]}.bak"]
