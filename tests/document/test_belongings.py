"""Copies of columns are known as copies, and what belongs to a column goes with it, however it is deleted."""

from typing import Any

import pytest

from tests.conftest import FreeCADRunner

pytestmark = pytest.mark.freecad

SCRIPT = """
import json
from pathlib import Path
import FreeCAD
from aadm_workbench.document import api
from aadm_workbench.document.result import make_result
from aadm_workbench.document.scan_cloud import make_scan

READ = {"camera": None, "depth_scale_mm": None, "sha256": "", "count": 0, "points": [],
        "R_file_scan": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}
FOUND = {"id": "L-1", "global_id": "3rW1CmykLUif254YhpKjBc", "verdict": "pass"}

def names():
    return sorted(obj.Name for obj in document.Objects)

def told():
    return {one.ColumnId: [one.GlobalId, [scan.Name for scan in one.Scans], one.Result and one.Result.Name]
            for one in api.columns_in(document)}

document = FreeCAD.newDocument("copies")
document.UndoMode = 1
document.openTransaction("make")
column = api.describe(document, "L-1", {"centres": [[0, 0], [90, 0], [0, 90]], "sleeve_diameter": 26.0})
column.GlobalId = FOUND["global_id"]
make_scan(column, Path("L-1-foot.ply"), "sleeves", "mm", READ)
make_result(column, {"columns": [FOUND]}, FOUND)
document.commitTransaction()
result["first"] = told()
for name, whole in (("alone", False), ("whole", True)):
    document.openTransaction(name)
    copy = document.copyObject(column, whole)
    document.recompute()
    document.commitTransaction()
    result[name] = told()
result["design"] = api.column_design(copy).id, api.column_design(copy).global_id
result["reported"] = [entry["id"] for entry in api.report_of(document)["columns"]]
result["in_group"] = sorted(one.ColumnId for one in document.AADM.Group)
document.saveAs(str(folder / "copies.FCStd"))
FreeCAD.closeDocument(document.Name)
document = FreeCAD.openDocument(str(folder / "copies.FCStd"))
document.UndoMode = 1
result["reopened"] = told()
result["all"] = names()

document.openTransaction("delete one")
document.removeObject("AADM_Column")
document.commitTransaction()
result["one_deleted"] = names()
document.undo()
result["one_back"] = told()
document.openTransaction("delete all")
document.AADM.removeObjectsFromDocument()
document.removeObject("AADM")
document.commitTransaction()
result["all_deleted"] = names()
document.undo()
result["all_back"] = names()
document.redo()
result["all_deleted_again"] = names()
"""


@pytest.fixture(scope="module")
def told(freecadcmd: Any, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    return FreeCADRunner(freecadcmd, tmp_path_factory.mktemp("copies")).run(SCRIPT)


FIRST = ["3rW1CmykLUif254YhpKjBc", ["AADM_Scan"], "AADM_Result"]


def test_copy_without_its_scans_leaves_them_to_the_first(told: dict[str, Any]) -> None:
    assert told["first"] == {"L-1": FIRST}
    assert told["alone"] == {"L-1": FIRST, "L-1 (copy)": ["", [], None]}


def test_copy_with_its_scans_is_a_column_of_its_own(told: dict[str, Any]) -> None:
    assert told["whole"] == told["alone"] | {"L-1 (copy) 2": ["", ["AADM_Scan001"], "AADM_Result001"]}
    assert told["design"] == ["L-1 (copy) 2", None]
    assert sorted(told["reported"]) == ["L-1", "L-1 (copy) 2"]
    assert told["in_group"] == ["L-1", "L-1 (copy)", "L-1 (copy) 2"]


def test_opening_a_document_makes_no_copies(told: dict[str, Any]) -> None:
    assert told["reopened"] == told["whole"]


def test_scans_and_result_go_with_their_column_alone(told: dict[str, Any]) -> None:
    assert sorted(set(told["all"]) - set(told["one_deleted"])) == ["AADM_Column", "AADM_Result", "AADM_Scan"]
    assert told["one_back"] == told["reopened"]


def test_deleted_group_leaves_nothing_and_comes_back_whole(told: dict[str, Any]) -> None:
    assert told["all_deleted"] == told["all_deleted_again"] == []
    assert told["all_back"] == told["all"]
