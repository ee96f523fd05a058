"""Marks at as-built centres: where they stand, what they look like in a viewer and in FreeCAD."""

from __future__ import annotations

import site
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.geom
import ifcopenshell.util.element
import ifcopenshell.util.placement
import ifcopenshell.validate
import numpy as np
import pytest

from aadm_workbench.report.ifc.model import write_ifc
from tests.report.floor_schemas import made_report
from tests.report.ifc_models import floor, one_column
from tests.report.typed import typed


@pytest.mark.parametrize(
    ("wcs", "far"),
    [
        ((0.0, 0.0, 0.0), (1000.0, 2000.0, 0.0)),
        ((400_000_000.0, 3_500_000_000.0, 12_000.0), (0.0, 0.0, 0.0)),
        ((0.0, 0.0, 0.0), (500_000_000.0, 4_400_000_000.0, 45_000.0)),
    ],
)
@pytest.mark.parametrize("unit", ["mm", "m"])
def test_marks_stand_at_the_measured_centres(
    wcs: tuple[float, float, float], far: tuple[float, float, float], unit: str, tmp_path: Path
) -> None:
    model, out = one_column(tmp_path, "IFC4", unit, wcs=wcs, far=far), tmp_path / "out.ifc"
    report = made_report(model)
    column = report["columns"][0]
    write_ifc(typed(report), model, out)
    file = ifcopenshell.open(out)
    T_model_column = np.array(column["T_model_column"])
    mm = 1.0 if unit == "mm" else 1000.0
    marks = {mark.Name: mark for mark in file.by_type("IfcAnnotation")}
    assert len(marks) == 6
    for kind in ("sleeves", "rebars"):
        for point in column[kind]["points"]:
            if point["aligned_mm"] is None:
                assert f"{point['label']} as-built" not in marks
                continue
            mark = marks[f"{point['label']} as-built"]
            placed = ifcopenshell.util.placement.get_local_placement(mark.ObjectPlacement)[:3, 3] * mm + wcs
            truth = (T_model_column @ [*point["aligned_mm"], 1.0])[:3]
            np.testing.assert_allclose(placed, truth, rtol=0.0, atol=5.3e-4)  # written to a micrometre
            assert ifcopenshell.util.element.get_container(mark).Name == "2F"


def test_marks_are_visible_where_they_say(tmp_path: Path) -> None:
    """Their solids, as a viewer draws them: a disk around the centre, and an arrow twenty times the deviation."""
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    report = made_report(model)
    column = report["columns"][0]
    write_ifc(typed(report), model, out)
    settings = ifcopenshell.geom.settings()
    settings.set("use-world-coords", True)
    file = ifcopenshell.open(out)
    mark = next(mark for mark in file.by_type("IfcAnnotation") if mark.Name == "S1 as-built")
    shape = ifcopenshell.geom.create_shape(settings, mark, mark.Representation.Representations[0])
    vertices = 1000.0 * np.array(shape.geometry.verts).reshape(-1, 3)
    T = np.array(column["T_model_column"])
    local = (vertices - T[:3, 3]) @ T[:3, :3]
    point = column["sleeves"]["points"][0]
    built, offset = np.array(point["aligned_mm"]), np.array([*point["offset_mm"], 0.0])
    np.testing.assert_allclose(
        local.max(axis=0)[:2], np.maximum(built + 6.0, built - offset + 20 * offset)[:2], atol=1.5
    )
    assert local[:, 2].min() == pytest.approx(-2.0, abs=1e-6)
    assert local[:, 2].max() == pytest.approx(0.0, abs=1e-6), "outside of the concrete"
    red, green, _ = shape.geometry.materials[0].diffuse.components
    assert red > 2.0 * green, "what fails is red"


def test_marks_can_be_switched_off_together(tmp_path: Path) -> None:
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    write_ifc(typed(made_report(model)), model, out)
    file = ifcopenshell.open(out)
    marks = set(file.by_type("IfcAnnotation"))
    group = next(group for group in file.by_type("IfcGroup") if group.Name == "AADM as-built centres")
    assert set(ifcopenshell.util.element.get_grouped_by(group)) == marks
    layers = {layer.Name: set(layer.AssignedItems) for layer in file.by_type("IfcPresentationLayerAssignment")}
    assert set(layers) == {"AADM as-built sleeves", "AADM as-built bars"}
    assert {shape for mark in marks for shape in mark.Representation.Representations} == set.union(*layers.values())


def test_marks_move_with_a_column_that_was_moved_since(tmp_path: Path) -> None:
    model, out = one_column(tmp_path), tmp_path / "out.ifc"
    report = made_report(model)
    moved = ifcopenshell.open(model)
    storey = moved.by_type("IfcBuildingStorey")[0]
    storey.ObjectPlacement.RelativePlacement.Location.Coordinates = (100.0, 0.0, 4000.0)
    moved.write(str(model))
    write_ifc(typed(report), model, out, force=True)
    file = ifcopenshell.open(out)
    mark = next(mark for mark in file.by_type("IfcAnnotation") if mark.Name == "S1 as-built")
    now = np.array(made_report(model)["columns"][0]["T_model_column"])
    placed = ifcopenshell.util.placement.get_local_placement(mark.ObjectPlacement)[:3, 3]
    built = report["columns"][0]["sleeves"]["points"][0]["aligned_mm"]
    np.testing.assert_allclose(placed, (now @ [*built, 1.0])[:3], atol=1e-6)
    assert not np.allclose(now, report["columns"][0]["T_model_column"])


@pytest.mark.freecad
def test_freecad_shows_the_values_and_the_marks(freecad: Any, tmp_path: Path) -> None:
    model, out = floor(tmp_path, "IFC4"), tmp_path / "out.ifc"
    report = made_report(model, only=("C-301", "C-302"))
    write_ifc(typed(report), model, out)
    result = freecad.run(FREECAD_BODY.format(path=str(out)), python_path=site.getsitepackages()[0])
    held = {label: values for label, values in result["values"].items() if "Precast column C-301" in label}
    (values,) = held.values()
    assert values["Verdict;;AADM_ColumnCheck"] == "IfcLabel;;fail"
    assert values["LargestSleeveDeviation;;AADM_ColumnCheck"].startswith("IfcLengthMeasure;;2.795")
    truth = [
        (np.array(column["T_model_column"]) @ [*point["aligned_mm"], 1.0])[:3]
        for column in report["columns"]
        for kind in ("sleeves", "rebars")
        for point in column[kind]["points"]
        if point["aligned_mm"]
    ]
    marks = np.array(result["marks"])
    assert len(marks) == len(truth) == 44
    apart = np.linalg.norm(marks[:, None, :] - np.array(truth)[None, :, :], axis=2)
    assert apart.min(axis=0).max() < 1e-3


# The importer of FreeCAD 0.20 was written for an older ifcopenshell: two of its names are given back to it.
FREECAD_BODY = """
import FreeCAD, ifcopenshell, ifcopenshell.geom as geom
real, plain = geom.settings, ifcopenshell.file.by_type
class Settings(real):
    def __getattr__(self, name):
        return name if name.isupper() else super().__getattr__(name)
    def set(self, name, value):
        if name == 'USE_BREP_DATA':
            name, value = 'iterator-output', ifcopenshell.ifcopenshell_wrapper.SERIALIZED
        if not name.isupper():
            real.set(self, name, value)
        elif name == 'USE_WORLD_COORDS':
            real.set(self, 'use-world-coords', value)
geom.settings = Settings
ifcopenshell.file.by_type = lambda self, *a, **k: list(plain(self, *a, **k))
import importIFC
importIFC.open({path!r})
objects = FreeCAD.ActiveDocument.Objects
result['values'] = {{o.Label: dict(o.IfcProperties) for o in objects if getattr(o, 'IfcProperties', None)}}
marks = [o for o in objects if 'as_built' in o.Name and o.TypeId == 'Part::Feature']
result['marks'] = [list(o.Placement.Base) for o in marks if o.Shape.Edges]
"""
