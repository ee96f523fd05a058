"""``aadm report --fcstd``: a FreeCAD document of the results, written by a FreeCAD without a screen."""

import hashlib
import xml.etree.ElementTree as ElementTree
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest
from aadm_batch.fcstd import model_of, write_fcstd

from aadm_workbench.errors import AadmError
from tests.report.checked_floor import Case, floor_report
from tests.report.typed import typed


@pytest.mark.freecad
def test_document_holds_the_columns_and_shows_them(freecadcmd: Path, tmp_path: Path) -> None:
    path = tmp_path / "report.FCStd"
    write_fcstd(typed(floor_report(Case("C-1"))), path)
    with zipfile.ZipFile(path) as written:
        document = written.read("Document.xml").decode()
        shown = ElementTree.fromstring(written.read("GuiDocument.xml"))
    assert "AADM::" not in document, "proxies keep nothing"
    assert "aadm_workbench.document.column" in document
    views = {entry.get("name"): entry for entry in shown.iter("ViewProvider")}
    assert {"AADM_Column", "AADM_Result"} <= views.keys()
    for view in views.values():
        (visible,) = [one for one in view.iter("Property") if one.get("name") == "Visibility"]
        assert visible.find("Bool").get("value") == "true"
    assert [file.name for file in tmp_path.iterdir()] == ["report.FCStd"], "nothing is left beside it"


@pytest.mark.freecad
def test_report_without_columns_gets_a_sentence(freecadcmd: Path, tmp_path: Path) -> None:
    with pytest.raises(AadmError, match="no columns"):
        write_fcstd(replace(typed(floor_report(Case("C-1"))), columns=()), tmp_path / "report.FCStd")
    assert list(tmp_path.iterdir()) == []


def test_model_is_used_only_as_it_was_checked(tmp_path: Path) -> None:
    folder = tmp_path / "job-report"
    folder.mkdir()
    model = tmp_path / "floor.FCStd"
    model.write_bytes(b"a document")
    checked = {"source": "floor.FCStd", "sha256": hashlib.sha256(b"a document").hexdigest()}
    assert model_of(checked, folder / "report.FCStd") == model
    model.write_bytes(b"another")
    assert model_of(checked, folder / "report.FCStd") is None
    assert model_of({"source": "floor.ifc", "sha256": ""}, folder / "report.FCStd") is None
    assert model_of(None, folder / "report.FCStd") is None
