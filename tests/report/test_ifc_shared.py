"""Results never go to the wrong element: GlobalIds of several, bars of two columns in one element, one column twice."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.util.element
import pytest

from aadm_workbench.errors import ReportError
from aadm_workbench.report.bcf.findings import topic_guid
from aadm_workbench.report.ifc.model import remove_ifc, write_ifc
from tests.design.authoring import Author
from tests.report.floor_schemas import made_report
from tests.report.ifc_models import CORNERS
from tests.report.ifc_results import read_ifc_results
from tests.report.typed import typed


def two_columns(folder: Path, *, one_bar_element: bool = False, same_column_id: bool = False) -> Path:
    """Two columns beside each other; all bars may be one element, as rebar programs export them."""
    author = Author(folder)
    site = author.rooted("IfcSite", ObjectPlacement=author.placement(), CompositionType="ELEMENT")
    author.aggregate(author.project, [site])
    made: list[Any] = []
    disks: list[Any] = []
    for k, x0 in enumerate((0.0, 2000.0)):
        at = author.placement(site.ObjectPlacement, (x0, 0.0, 0.0))
        column = author.column(at, Name=f"C-{k}", Tag=f"C-{k}")
        made += [column, *author.sleeves(at, CORNERS)]
        if one_bar_element:
            disks += [author.disk([(x0 + x, y, -400.0), (x0 + x, y, 160.0)], 20.0) for x, y in CORNERS]
        else:
            made += author.rebars(at, CORNERS)
    if one_bar_element:
        made.append(author.element("IfcReinforcingBar", disks, site.ObjectPlacement, Name="REBAR"))
    if same_column_id:
        first, second = (element for element in made if element.is_a("IfcColumn"))
        second.GlobalId = first.GlobalId
    author.contain(site, made)
    return author.write()


def test_one_element_may_draw_the_bars_of_two_columns(tmp_path: Path) -> None:
    model, out = two_columns(tmp_path, one_bar_element=True), tmp_path / "out.ifc"
    report = made_report(model)
    done = write_ifc(typed(report), model, out)
    assert done.missing == ()
    file = ifcopenshell.open(out)
    (bars,) = file.by_type("IfcReinforcingBar")
    sets = ifcopenshell.util.element.get_psets(bars)
    own = {name: held for name, held in sets.items() if name.startswith("AADM_RebarCheck_")}
    assert set(own) == {f"AADM_RebarCheck_C-{k}_R{n}" for k in range(2) for n in range(1, 5)}
    for column in report["columns"]:
        for point in column["rebars"]["points"]:
            held = own[f"AADM_RebarCheck_{column['id']}_{point['label']}"]
            assert (held["Column"], held["Label"], held["Verdict"]) == (column["id"], point["label"], point["verdict"])
    worst = sets["AADM_RebarCheck"]
    assert any(held["Verdict"] == worst["Verdict"] and held["Label"] == worst["Label"] for held in own.values())
    assert write_ifc(typed(report), out, out).changed is False
    remove_ifc(out, out)
    assert out.read_bytes() == model.read_bytes()


def test_columns_of_one_global_id_are_told_by_their_names(tmp_path: Path) -> None:
    model, out = two_columns(tmp_path, same_column_id=True), tmp_path / "out.ifc"
    report = made_report(model)
    assert len({column["global_id"] for column in report["columns"]}) == 1
    write_ifc(typed(report), model, out)
    file = ifcopenshell.open(out)
    for element in file.by_type("IfcColumn"):
        held = ifcopenshell.util.element.get_psets(element)["AADM_ColumnCheck"]
        (column,) = (entry for entry in report["columns"] if entry["id"] == element.Tag)
        assert (held["Verdict"], held["GoesOn"]) == (column["verdict"], column["goes_on"])
    assert len({topic_guid(typed(report), column) for column in typed(report).columns}) == 2


def test_points_of_one_global_id_get_nothing_and_are_named(tmp_path: Path) -> None:
    author_model, out = two_columns(tmp_path), tmp_path / "out.ifc"
    file = ifcopenshell.open(author_model)
    first, second = file.by_type("IfcDiscreteAccessory")[:2]
    second.GlobalId = first.GlobalId
    file.write(str(author_model))
    report = made_report(author_model)
    done = write_ifc(typed(report), author_model, out)
    assert len(done.missing) == 2
    assert any("1 GlobalIds are those of several elements" in note and first.GlobalId in note for note in done.notes)
    written = ifcopenshell.open(out)
    for element in written.by_type("IfcDiscreteAccessory"):
        sets = ifcopenshell.util.element.get_psets(element)
        assert ("AADM_SleeveCheck" in sets) == (element.GlobalId != first.GlobalId)


def test_a_global_id_of_something_else_is_no_obstacle(tmp_path: Path) -> None:
    """Exporters give relations and property sets the GlobalIds of elements: an element is meant."""
    model, out = two_columns(tmp_path), tmp_path / "out.ifc"
    file = ifcopenshell.open(model)
    column = file.by_type("IfcColumn")[0]
    file.create_entity("IfcGroup", column.GlobalId, Name="same id")
    file.write(str(model))
    done = write_ifc(typed(made_report(model)), model, out)
    assert len(done.columns) == 2
    written = ifcopenshell.open(out)
    assert ifcopenshell.util.element.get_psets(written.by_type("IfcColumn")[0])["AADM_ColumnCheck"]


def test_a_report_that_names_a_column_twice_is_refused(tmp_path: Path) -> None:
    model = two_columns(tmp_path)
    report = made_report(model)
    twice = {**report["columns"][0], "id": report["columns"][0]["global_id"]}
    report["columns"].append(twice)
    with pytest.raises(ReportError, match=r"columns C-0 and .* are one element"):
        write_ifc(typed(report), model, tmp_path / "out.ifc")


def test_archives_are_not_written_into(tmp_path: Path) -> None:
    path = tmp_path / "model.ifczip"
    path.write_bytes(b"PK")
    with pytest.raises(ReportError, match="unpack it"):
        write_ifc({"columns": []}, path, tmp_path / "out.ifc")


def test_names_in_a_code_page_survive_the_write_back(tmp_path: Path) -> None:
    """What is not touched keeps its bytes, and is read as before."""
    model, out = two_columns(tmp_path), tmp_path / "out.ifc"
    content = model.read_bytes().replace(b"'REBAR'", b"''")
    raw = content.decode("ascii").replace("FILE_SCHEMA(('IFC4'))", "FILE_SCHEMA(('IFC4_ADD2'))")
    raw = raw.replace("'\\X2\\704C6D4659577B52\\X0\\ GTQ4Z-20'", "'灌浆套筒 20'")
    model.write_bytes(raw.encode("gb18030"))
    report = made_report(model)
    done = write_ifc(typed(report), model, out)
    assert done.missing == ()
    assert set(model.read_bytes().splitlines()) <= set(out.read_bytes().splitlines())
    assert len(read_ifc_results(out)) >= 10
    remove_ifc(out, out)
    assert out.read_bytes() == model.read_bytes()
