"""Models of other people's programs give what was found in them by hand."""

from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.design.read import read_model
from aadm_workbench.errors import DesignError


def test_vertical_bar_of_revit_2015(reference_models: Path) -> None:
    """One K16 bar, 2,200 long, in IFC2X3; its top is 13 m over its storey's placement."""
    read = read_model(reference_models / "IfcOpenShell_Revit2015_329_K16_vertical.ifc")
    (point,) = read.loose_rebars
    assert point.centre == pytest.approx([21502.1965820487, 22121.0723997379, 18250.0], abs=1e-6)
    assert point.axis.tolist() == [0.0, 0.0, 1.0]
    assert (point.diameter_mm, point.length_mm) == (16.0, pytest.approx(2200.0))
    assert point.global_id == "3QhkDhZf9ADgvXKJk4QgqZ"
    assert (read.schema, read.columns, read.not_taken, read.warnings) == ("IFC2X3", (), (), ())


def test_bar_of_revit_2018_whose_length_is_in_feet(reference_models: Path) -> None:
    """The geometry is believed: Ø 20, 8.912 m; the bar lies and is no connecting rebar."""
    read = read_model(reference_models / "IfcOpenShell_Revit2018_708_IFC4_feetBarLength.ifc")
    assert read.loose_rebars == ()
    (left,) = read.not_taken
    assert (left.what, left.global_id, left.diameter_mm) == ("rebar", "3ee6etZgv51xFAFINLZ$Ev", 20.0)
    assert left.length_mm == pytest.approx(29.2399579353326 * 304.8, abs=0.01)
    (warning,) = read.warnings
    assert "BarLength is 29.24 mm (it is in feet), drawn is 8912.3 mm" in warning


def test_reinforcing_assembly_of_buildingsmart(reference_models: Path) -> None:
    """34 ligatures whose places are only in their mapping targets, their diameter only on the type."""
    read = read_model(reference_models / "buildingSMART_reinforcing-assembly.ifc")
    assert read.schema == "IFC4X3_ADD2"
    assert (read.columns, read.loose_rebars) == ((), ())
    assert len(read.not_taken) == 34
    assert {left.reason for left in read.not_taken} == {"is a LIGATURE by its PredefinedType"}
    assert {left.diameter_mm for left in read.not_taken} == {12.0}
    places = sorted(float(left.point[1]) for left in read.not_taken if left.point is not None)
    assert np.diff(places[:-1]) == pytest.approx(150.0, abs=1e-9)
    assert (places[0], places[-1]) == (25.0, pytest.approx(4975.0))
    # The type says 1150; its indexed curve of eleven legs and bends is 1.6 mm shorter.
    assert [left.length_mm for left in read.not_taken] == pytest.approx([1148.39] * 34, abs=0.01)


def test_column_of_freecad_in_metres(reference_models: Path) -> None:
    """Two entities of two bars each over the head of a column without sleeves; ten stirrups in one entity."""
    read = read_model(reference_models / "amrit3701_addon_SingleTie_column_FreeCAD020export.ifc")
    tops = sorted(point.centre.round(6).tolist() for point in read.loose_rebars)
    assert tops == [[x, y, 3300.0] for x in (-164.0, 164.0) for y in (-164.0, 164.0)]
    assert {point.diameter_mm for point in read.loose_rebars} == {16.0}
    owners = [point.global_id for point in read.loose_rebars]
    assert {owners.count(owner) for owner in owners} == {2}
    stirrups = [left for left in read.not_taken if left.what == "rebar"]
    assert len(stirrups) == 10
    assert [left.diameter_mm for left in stirrups] == pytest.approx([8.0] * 10)
    with pytest.raises(DesignError, match=r"'Column' .* has no grouting sleeves .* 3 IfcReinforcingBar, 1 IfcColumn"):
        read.column("Column")


def test_doubled_header(reference_models: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = reference_models / "xBimTeam_SweptDiskSolid_3_doubled_header.ifc"
    with pytest.raises(DesignError, match="line 2 reads 'ISO-10303-21;' where 'HEADER;' is due") as caught:
        read_model(path)
    assert str(path) in str(caught.value)
    assert capfd.readouterr() == ("", "")
