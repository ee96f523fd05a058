"""STEP and BREP through FreeCAD's kernel: exact cylinders, names where the file has them."""

from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.design.read import read_model
from aadm_workbench.errors import DesignError
from aadm_workbench.model import ColumnDesign
from tests.conftest import FreeCADRunner, find_freecad

AUTHOR = Path(__file__).parents[1] / "document"
EXACT_MM = 0.001

WRITE = """\
import sys
sys.path.insert(0, {author!r})
import FreeCAD, Import, Part
import freecad_author as author
place = author.turned(1234.5, -876.5, 250.0, 20.0)
shapes = [author.moved(author.block(chamfer=2.0), place)]
shapes += [author.moved(author.bar_shape(x, y), place) for x, y in author.RING]
Part.Compound(shapes).exportBrep(str(folder / "baked.brep"))
document = FreeCAD.newDocument("named")
unit = document.addObject("App::Part", "Unit")
unit.Label = "C-301"
author.feature(document, "Concrete", shapes[0], "预制柱", parent=unit)
for number, shape in enumerate(shapes[1:]):
    author.feature(document, "Bar", shape, f"连接钢筋 {{number}}", parent=unit)
document.recompute()
Import.export([unit], str(folder / "named.step"))
"""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a STEP and a BREP file that FreeCAD wrote."""
    folder = tmp_path_factory.mktemp("files")
    FreeCADRunner(find_freecad("freecadcmd", "FreeCADCmd"), folder).run(WRITE.format(author=str(AUTHOR)))
    return folder


def worst_mm(column: ColumnDesign) -> float:
    """Largest distance of a sleeve or bar from where it was drawn, and of a diameter from its own."""
    turn = np.radians(20.0)
    T = np.eye(4)
    T[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
    T[:3, 3] = (1234.5, -876.5, 250.0)
    ring = [(x, y) for x in (-240, -80, 80, 240) for y in (-240, -80, 80, 240) if max(abs(x), abs(y)) == 240]
    assert column.T_model_column is not None
    worst = 0.0
    for points, level, diameter_mm in ((column.sleeves, 0.0, 36.0), (column.rebars, 160.0, 20.0)):
        drawn = np.array([(T @ [x, y, level, 1.0])[:3] for x, y in ring])
        found = np.array([(column.T_model_column @ [*point.centre, 1.0])[:3] for point in points])
        apart_mm = np.linalg.norm(found[:, np.newaxis] - drawn, axis=2)
        assert sorted(apart_mm.argmin(axis=1)) == list(range(12))
        worst = max(worst, apart_mm.min(axis=1).max(), *(abs(point.diameter_mm - diameter_mm) for point in points))
    return worst


@pytest.mark.freecad
@pytest.mark.parametrize(("name", "called"), [("named.step", "C-301"), ("baked.brep", None)])
def test_cylinders_are_exact(files: Path, name: str, called: str | None) -> None:
    model = read_model(files / name)
    (column,) = model.columns
    assert worst_mm(column) < EXACT_MM
    assert column.size_mm == pytest.approx((600.0, 600.0), abs=EXACT_MM)
    assert not model.loose_sleeves
    assert not model.loose_rebars
    if called:
        assert model.column(called) is column
        assert "连接钢筋" in column.rebars[0].why


def test_a_step_file_that_is_cut_short_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.step"
    path.write_text("ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n#1=")
    with pytest.raises(DesignError, match=r"a\.step is cut short"):
        read_model(path)


def test_an_ifc_model_under_another_name_is_said(tmp_path: Path) -> None:
    path = tmp_path / "a.stp"
    path.write_text("ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n")
    with pytest.raises(DesignError, match=r"is an IFC model: name it \.ifc"):
        read_model(path)


def test_what_is_no_brep_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.brep").write_text("solid x\nendsolid x\n")
    with pytest.raises(DesignError, match=r"a\.brep is no BREP file"):
        read_model(tmp_path / "a.brep")


@pytest.mark.freecad
def test_a_step_file_without_geometry_is_said(tmp_path: Path) -> None:
    path = tmp_path / "a.step"
    path.write_text(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n"
    )
    with pytest.raises(DesignError, match=r"a\.step"):
        read_model(path)
