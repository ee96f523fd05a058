"""FreeCAD opens an IFC file as it did before this workbench and its environment were installed."""

import os
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import ROOT, FreeCADRunner
from tests.freecad_environment import environments

pytestmark = pytest.mark.freecad

SCRIPT = f"""
import FreeCAD
from importlib import import_module
from importlib.util import find_spec
for workbench in ("NativeIFC", "BIM"):
    FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/" + workbench).SetBool("AskAgain", False)
FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/NativeIFC").SetBool("ShowDialog", False)

def versions():
    found = {{}}
    for name in ("numpy", "scipy", "ifcopenshell", "cv2"):
        try:
            module = import_module(name)
        except ImportError:
            found[name] = None
        else:
            found[name] = [getattr(module, "__version__", ""), module.__file__]
    return found

def opened():
    file = {str(ROOT / "samples" / "floor" / "floor3.ifc")!r}
    told = {{}}
    for name in ("importIFC", "nativeifc.ifc_import"):
        if find_spec(name.partition(".")[0]) is None:
            told[name] = "there is no such importer"
            continue
        before = set(FreeCAD.listDocuments())
        try:
            import_module(name).open(file)
        except BaseException as error:
            told[name] = f"{{type(error).__name__}}: {{error}}"
        else:
            told[name] = "opened"
        new = [FreeCAD.getDocument(one) for one in set(FreeCAD.listDocuments()) - before]
        told[name] = [told[name], sorted((obj.TypeId, obj.Label) for document in new for obj in document.Objects)]
        for document in new:
            FreeCAD.closeDocument(document.Name)
    return told

result["versions"] = versions()
result["opened"] = opened()
result["addon"] = find_spec("aadm_workbench") is not None
if result["addon"]:
    from aadm_workbench.document import api
    # Used, and then asked again.
    document = FreeCAD.newDocument("used")
    result["columns"] = len(api.sample(document, file={str(ROOT / "samples" / "floor" / "floor3.ifc")!r}))
    FreeCAD.closeDocument(document.Name)
    result["versions_after"], result["opened_after"] = versions(), opened()
"""


def run(freecadcmd: Path, folder: Path, *, installed: bool) -> dict[str, Any]:
    folder.mkdir()
    runner = FreeCADRunner(freecadcmd, folder, environments=environments() if installed else None)
    if not installed:
        (folder / "home" / "Mod" / "AADM").mkdir(parents=True)  # an empty folder in the place of the addon
    # FreeCAD brings no ifcopenshell on Debian: tests/freecad_versions.sh names a folder with one that opens files.
    return runner.run(SCRIPT, python_path=os.environ.get("AADM_FREECAD_PACKAGES", ""), timeout_s=300.0)


def test_ifc_opens_the_same_before_and_after(freecadcmd: Path, tmp_path: Path) -> None:
    before = run(freecadcmd, tmp_path / "before", installed=False)
    after = run(freecadcmd, tmp_path / "after", installed=True)
    assert (before["addon"], after["addon"]) == (False, True)
    assert after["columns"] == 8
    assert after["versions"] == after["versions_after"] == before["versions"]
    assert after["opened"] == after["opened_after"] == before["opened"]
    assert before["versions"]["numpy"], "numpy is FreeCAD's own"
