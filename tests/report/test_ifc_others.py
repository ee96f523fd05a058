"""Models that others have a hand in: shared property sets, copies, files saved again by other programs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.geom
import ifcopenshell.util.element
import ifcopenshell.util.placement
import ifcopenshell.validate
import pytest

from aadm_workbench.report.ifc.model import remove_ifc, write_ifc
from tests.design.authoring import Author
from tests.report.floor_schemas import made_report
from tests.report.ifc_models import one_column
from tests.report.ifc_results import read_ifc_results
from tests.report.typed import typed


def shared(name: str) -> Callable[[Author, list[Any]], None]:
    """Gives four sleeves one property set, as exporters and copying do."""

    def share(author: Author, sleeves: list[Any]) -> None:
        values = {"Deviation": 9.0, "Comment": 7.0}
        singles = [
            author.new("IfcPropertySingleValue", key, None, author.file.create_entity("IfcReal", value), None)
            for key, value in values.items()
        ]
        held = author.rooted("IfcPropertySet", Name=name, HasProperties=singles)
        author.rooted("IfcRelDefinesByProperties", RelatedObjects=sleeves[:4], RelatingPropertyDefinition=held)

    return share


@pytest.mark.parametrize("name", ["AADM_SleeveCheck", "Pset_Uncertainty"])
def test_a_shared_property_set_is_unshared_first(name: str, tmp_path: Path) -> None:
    model, out = one_column(tmp_path, "IFC4X3", then=shared(name)), tmp_path / "out.ifc"
    before = ifcopenshell.open(model)
    (sharing,) = before.by_type("IfcRelDefinesByProperties")
    ids = [element.GlobalId for element in sharing.RelatedObjects]
    report = made_report(model)
    points = report["columns"][0]["sleeves"]["points"]
    kept = [point["global_id"] for point in points if point["global_id"] in ids][-1]
    for point in points:  # one of the four was not checked
        point["global_id"] = None if point["global_id"] == kept else point["global_id"]
    done = write_ifc(typed(report), model, out)
    assert f"{next(p['label'] for p in points if p['global_id'] is None)} of column C-1" in done.missing
    file = ifcopenshell.open(out)
    psets = {global_id: ifcopenshell.util.element.get_psets(file.by_guid(global_id)) for global_id in ids}
    assert {key: psets[kept][name][key] for key in ("Deviation", "Comment")} == {"Deviation": 9.0, "Comment": 7.0}
    assert len(psets[kept]) == 1
    measured = {p["global_id"] for p in points if p["scan_mm"] is not None} & set(ids)
    written = {psets[global_id][name]["id"] for global_id in measured}
    assert len(written) == len(measured) >= 2, "each has a set of its own"
    assert psets[kept][name]["id"] not in written
    for global_id in measured:
        assert psets[global_id][name]["Comment"] == 7.0, "what is not ours stays with the element"
        assert psets[global_id]["AADM_SleeveCheck"]["Label"].startswith("S")
    again = write_ifc(typed(report), out, out)
    assert again.changed is False
    remove_ifc(out, out)
    assert out.read_bytes() == model.read_bytes()


def test_a_tolerance_that_the_engineer_wrote_stays(tmp_path: Path) -> None:
    model, out = one_column(tmp_path, "IFC4X3", then=shared("Pset_Tolerance")), tmp_path / "out.ifc"
    done = write_ifc(typed(made_report(model)), model, out)
    assert "Pset_Tolerance of 4 elements was in the model already and was left as it is" in done.notes
    assert set(model.read_text().splitlines()) <= set(out.read_text().splitlines())


def test_copies_made_of_an_element_keep_what_they_were_given(tmp_path: Path) -> None:
    """Another program copies a checked sleeve with its property set: the next check changes the original alone."""
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    report = made_report(model)
    write_ifc(typed(report), model, out)
    file = ifcopenshell.open(out)
    sleeve = file.by_guid(report["columns"][0]["sleeves"]["points"][0]["global_id"])
    copied = ifcopenshell.util.element.copy(file, sleeve)
    copied.GlobalId = ifcopenshell.guid.new()
    for relation in sleeve.IsDefinedBy:
        relation.RelatedObjects = [*relation.RelatedObjects, copied]
    file.write(str(out))
    later = made_report(model, seed=5)
    later["columns"][0]["sleeves"]["points"][0]["offset_mm"] = [0.5, 0.25]
    write_ifc(typed(later), out, out, force=True)
    write_ifc(typed(later), out, out, force=True)
    found = read_ifc_results(out)
    assert found[copied.GlobalId]["AADM_SleeveCheck"]["OffsetX"] == 2.5
    assert found[sleeve.GlobalId]["AADM_SleeveCheck"]["OffsetX"] == 0.5
    remove_ifc(out, out)
    found = read_ifc_results(out)
    assert set(found) == {copied.GlobalId}


def test_results_go_after_another_program_has_saved_the_model(tmp_path: Path) -> None:
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    write_ifc(typed(made_report(model)), model, out)
    file = ifcopenshell.open(out)
    wall = file.create_entity("IfcWall", ifcopenshell.guid.new(), Name="new")
    group = file.create_entity("IfcGroup", ifcopenshell.guid.new(), Name="theirs")
    mark = file.by_type("IfcAnnotation")[0]
    file.create_entity("IfcRelAssignsToGroup", ifcopenshell.guid.new(), None, None, None, [wall, mark], None, group)
    renumbered = ifcopenshell.file(schema="IFC4")
    for entity in reversed(list(file)):
        renumbered.add(entity)
    renumbered.write(str(out))
    done = remove_ifc(out, tmp_path / "back.ifc")
    assert "changed by another program" in done.notes[-1]
    back = ifcopenshell.open(tmp_path / "back.ifc")
    kinds = sorted(entity.is_a() for entity in back)
    theirs = ["IfcWall", "IfcGroup", "IfcRelAssignsToGroup"]
    assert kinds == sorted([*(entity.is_a() for entity in ifcopenshell.open(model)), *theirs])
    assert [e.GlobalId for e in back.by_type("IfcRelAssignsToGroup")[0].RelatedObjects] == [wall.GlobalId]


def test_a_shared_set_is_shared_again_with_those_who_joined(tmp_path: Path) -> None:
    """Another program puts a sleeve of its own into the relation that was altered."""
    model, out = one_column(tmp_path, then=shared("AADM_SleeveCheck")), tmp_path / "out.ifc"
    (sharing,) = ifcopenshell.open(model).by_type("IfcRelDefinesByProperties")
    write_ifc(typed(made_report(model)), model, out)
    file = ifcopenshell.open(out)
    joined = ifcopenshell.util.element.copy(file, file.by_type("IfcDiscreteAccessory")[0])
    joined.GlobalId = ifcopenshell.guid.new()
    relation = file.by_guid(sharing.GlobalId)
    relation.RelatedObjects = [*relation.RelatedObjects, joined]
    file.write(str(out))
    remove_ifc(out, out)
    back = ifcopenshell.open(out).by_guid(sharing.GlobalId)
    assert [element.GlobalId for element in back.RelatedObjects] == [
        *(element.GlobalId for element in sharing.RelatedObjects),
        joined.GlobalId,
    ]
    assert back.RelatingPropertyDefinition.GlobalId == sharing.RelatingPropertyDefinition.GlobalId
    assert len([e for e in ifcopenshell.open(out) if e.is_a("IfcPropertySet")]) == 1
