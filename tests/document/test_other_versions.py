"""Documents that other versions of FreeCAD have saved; ``tests/freecad_versions.sh`` collects them."""

import os
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.freecad

FOLDER = os.environ.get("AADM_DOCUMENTS", "")


@pytest.mark.skipif(not FOLDER, reason="AADM_DOCUMENTS names no folder with documents of other versions")
def test_documents_of_all_versions_open(freecad: Any) -> None:
    documents = sorted(str(path) for path in Path(FOLDER).glob("*.FCStd"))
    assert documents, "no version has saved a document"
    result = freecad.run(
        "import FreeCAD\n"
        "from aadm_workbench.document import api\n"
        "result['found'] = {}\n"
        f"for path in {documents!r}:\n"
        "    document = FreeCAD.openDocument(path)\n"
        "    (column,) = api.columns_in(document)\n"
        "    document.recompute()\n"
        "    kept = [column.Result.Verdict, column.SleeveCount, [len(scan.Points) > 30000 for scan in column.Scans]]\n"
        "    result['found'][path] = [*kept, round(column.Placement.Base.x, 3), column.Model.Name, column.isValid()]\n"
    )
    for path, found in result["found"].items():
        assert found == ["fail", 12, [True, True], 7800.0, "Column", True], path
