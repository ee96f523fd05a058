"""Starts that no other part makes: a STEP file, and the folders of two captures. Runs inside FreeCAD.

It finds what :mod:`tests.gui.session_body` and :mod:`tests.gui.capture_body` find and have defined.
"""

# ruff: noqa: F821 - a script in the order of the session, with names that the runner puts in
import ImportGui

drawn = FreeCAD.newDocument("drawn")
namespace["make_model"](drawn, (7800.0, 13200.0, 7200.0))
ImportGui.export(drawn.Objects, str(folder / "column.step"))
FreeCAD.closeDocument(drawn.Name)
document = FreeCAD.newDocument("step")
ImportGui.insert(str(folder / "column.step"), document.Name)
Gui.Selection.clearSelection()
Gui.runCommand("AADM_SampleDesign")
spin(lambda: panel(DesignPanel) is not None, 60)
result["step_columns"] = [one.ColumnId for one in api.columns_in(document)]
panel(DesignPanel).reject()

(column,) = api.columns_in(document)
column.SleevesUp = column.RebarsUp = "+y"
bars_folder = folder / "capture of rebars"
bars_folder.mkdir()
(bars_folder / "depth.tiff").write_bytes((scans / "C-302-bars.tiff").read_bytes())
(bars_folder / "camera.toml").write_bytes((camera_folder / "camera.toml").read_bytes())


def import_folder(capture, kind):
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(column)
    Gui.runCommand("AADM_ImportScan")
    importing = panel(ImportPanel)
    importing.file.set_text(str(capture))
    importing.kind.setCurrentIndex(importing.kind.findData(kind))
    importing.camera.set_text("")
    before = len(column.Scans)
    importing.start()
    spin(lambda: len(column.Scans) > before or importing.start_button.isEnabled(), 60)
    return sentences()


result["said_by_folders"] = [import_folder(camera_folder, "sleeves"), import_folder(bars_folder, "rebars")]
Gui.Selection.clearSelection()
Gui.Selection.addSelection(column)
Gui.runCommand("AADM_CheckColumn")
checking = panel(CheckPanel)
checking.start()
spin(lambda: column.Result is not None and checking.start_button.isEnabled(), 60)
result["said_by_step_check"] = sentences()
result["step_verdict"] = [column.Result.Verdict, column.Result.GoesOn, list(column.Result.Reasons)]
checking.reject()
FreeCAD.closeDocument(document.Name)
