"""The third part of the scripted session: the private environment, and models that stay as they are. Inside FreeCAD.

It finds what :mod:`tests.gui.session_body` finds, and what that has defined.
"""

# ruff: noqa: E402, F821 - a script in the order of the session, with names that the runner puts in
import os
import shutil

from aadm_workbench.document.result import job_of
from aadm_workbench.document.scan_reading import AskedScan, take_scan
from aadm_workbench.gui.panels import sampling

# Columns of an IFC file, which this FreeCAD need not be able to open; its path is remembered.
model = folder / "model"
model.mkdir()
shutil.copy(Path(SAMPLES) / "floor" / "floor3.ifc", model)
ifc = model / "floor3.ifc"
before = ifc.read_bytes()
document = FreeCAD.newDocument("ifc")
document.UndoMode = 1
sampling.sample(document, None, ifc)
spin(lambda: panel(DesignPanel) is not None)
known = {one.ColumnId: one for one in api.columns_in(document)}
result["ifc_columns"] = sorted(known)
result["ifc_undo"] = list(document.UndoNames)

# One of them, checked as the command checks it.
column = known["C-302"]
column.SleevesUp = column.RebarsUp = "+y"
Gui.Selection.clearSelection()
exact = folder / "exact.toml"
exact.write_text(CAMERA)
for name, kind in (("C-302-foot.tiff", "sleeves"), ("C-302-bars.tiff", "rebars")):
    result[f"said_by_{kind}"] = import_scan(scans / name, kind, str(exact))
Gui.Selection.clearSelection()
Gui.Selection.addSelection(column)
Gui.runCommand("AADM_CheckColumn")
checking = panel(CheckPanel)
checking.start()
spin(lambda: column.Result is not None and checking.start_button.isEnabled(), 60)
result["said_by_ifc_check"] = sentences()
result["panel_report"] = {**job_of(column.Result), "columns": [found_of(column.Result)]}

# A click on a row shows what the row is about.
checking.shows.setCurrentIndex(checking.shows.findData("minimax"))
result["shown_by_choice"] = column.Result.ViewObject.Shows
checking.table.selectRow(0)
result["shown_by_row"] = [checking.table.rows[0].what, column.Result.ViewObject.Shows, checking.shows.currentData()]

# Written beside the model; in place where that is chosen; refused where the model is not what was checked.
Gui.runCommand("AADM_WriteResults")
writing = panel(WritePanel)


def write_ifc():
    writing.start()
    spin(lambda: writing.work is None, 60)
    return sentences()


result["ifc_is_known"] = writing.model.text()
result["said_by_write_beside"] = write_ifc()
result["model_is_as_it_was"] = ifc.read_bytes() == before
result["written_beside"] = sorted(path.name for path in model.iterdir())
ifc.write_bytes(before.replace(b"ENDSEC;", b"/* moved */\nENDSEC;", 1))
changed = ifc.read_bytes()
(model / "floor3-checked.ifc").unlink()
result["said_for_changed_model"] = write_ifc()
result["written_for_changed_model"] = (model / "floor3-checked.ifc").exists() or ifc.read_bytes() != changed
ifc.write_bytes(before)
writing.in_place.setChecked(True)
result["said_by_write_in_place"] = write_ifc()
result["written_in_place"] = [ifc.read_bytes() != before, sorted(path.name for path in model.iterdir())]

# A document is closed while its panel is open, and while that checks: the session goes on.
for begin in (False, True):
    another = FreeCAD.newDocument("closed")
    column = api.describe(another, "L-1", {"centres": [[0, 0], [90, 0], [0, 90]], "sleeve_diameter": 26.0})
    if begin:
        asked = AskedScan("sleeves", scans / "C-302-foot.tiff")
        take_scan(column, asked, {"camera": None, "depth_scale_mm": None, "sha256": "", "count": 0, "points": [],
                                  "R_file_scan": np.eye(3).tolist()})  # fmt: skip
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(column)
    Gui.runCommand("AADM_CheckColumn")
    checking = panel(CheckPanel)
    result[f"opened_{begin}"] = checking is not None
    if begin:
        checking.start()
        result["ran_when_closed"] = bool(_RUNNING)
    FreeCAD.closeDocument(another.Name)
    settle(0.3)
    result[f"after_closing_{begin}"] = [panel(CheckPanel) is None, Gui.Control.activeDialog(), sentences()]
spin(lambda: not _RUNNING, 10)
result["left_running"] = len(_RUNNING)
FreeCAD.setActiveDocument(document.Name)
Gui.runCommand("AADM_RunJob")
result["job_after_closing"] = panel(JobPanel) is not None
panel(JobPanel).reject()

# A panel makes room for another while its job runs: what the job still says has nowhere to go.
Gui.runCommand("AADM_RunJob")
leaving = panel(JobPanel)
leaving.job.set_text(str(Path(SAMPLES) / "floor" / "job.toml"))
leaving.folder.set_text(str(folder / "left"))
leaving.start()
spin(lambda: leaving.lines.count() > 0, 60)
Gui.Selection.clearSelection()
Gui.Selection.addSelection(known["C-302"])
Gui.runCommand("AADM_ImportScan")
spin(lambda: not _RUNNING, 10)
result["after_leaving"] = [panel(ImportPanel) is not None, len(_RUNNING), sentences()]
panel(ImportPanel).reject()

# A column is deleted under its panel.
doomed = api.describe(document, "D-1", {"centres": [[0, 0], [90, 0], [0, 90]], "sleeve_diameter": 26.0})
Gui.Selection.clearSelection()
Gui.Selection.addSelection(doomed)
Gui.runCommand("AADM_CheckColumn")
document.removeObject(doomed.Name)
settle(0.3)
result["after_deleting"] = [panel(CheckPanel) is None, Gui.Control.activeDialog(), sentences()]

# Without the environment: one button, whatever needs it; what does not need it works.
environments = os.environ["AADM_ENVIRONMENTS"]
os.environ["AADM_ENVIRONMENTS"] = str(folder / "none yet")


def buttons_of(start):
    start()
    settle(0.2)
    boxes = [box for box in window.findChildren(QtGui.QMessageBox) if box.isVisible()]
    return [button.text() for box in boxes for button in box.buttons()], sentences()


def import_without():
    import_scan(scans / "C-302-foot.tiff", "sleeves", str(exact))


def check_without():
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(known["C-302"])
    Gui.runCommand("AADM_CheckColumn")
    panel(CheckPanel).start()


def job_without():
    Gui.runCommand("AADM_RunJob")
    panel(JobPanel).job.set_text(str(Path(SAMPLES) / "floor" / "job.toml"))
    panel(JobPanel).start()


def report_without():
    Gui.runCommand("AADM_Report")
    panel(ReportPanel).folder.set_text(str(folder / "report without"))
    panel(ReportPanel).start()


FreeCAD.setActiveDocument(document.Name)
result["without"] = {
    "sample": buttons_of(lambda: sampling.sample(document, None, ifc)),
    "check": buttons_of(check_without),
    "job": buttons_of(job_without),
    "report": buttons_of(report_without),
    "try": buttons_of(lambda: Gui.runCommand("AADM_TryIt")),
}
if panel(ReportPanel) is not None:
    panel(ReportPanel).reject()
from aadm_workbench.document import open_scan

alone = open_scan.open(str(Path(SAMPLES) / "lab" / "scans" / "L-1-foot.ply"))
result["scan_alone"] = buttons_of(lambda: panel(ImportPanel).start())
panel(ImportPanel).reject()
FreeCAD.closeDocument(alone.Name)
opened = FreeCAD.newDocument("opened")
open_report.insert(str(folder / "report" / "report.json"), opened.Name)
result["opened_without"] = [[one.ColumnId, one.Result.Verdict] for one in api.columns_in(opened)]
FreeCAD.closeDocument(opened.Name)

# The button itself, where the folder of wheels is empty, and where somebody changes their mind.
from aadm_workbench.gui.panels.environment import install

(folder / "empty").mkdir()
installing = install(str(folder / "empty"))
spin(lambda: installing.process is None, 60)
result["installing"] = [installing.problem, installing.state.text()]
installing.copy()
result["copied"] = QtGui.QApplication.clipboard().text()
installing.grab().save(str(folder / "installing.png"))
installing.start()
settle(0.2)
installing.close()
spin(lambda: not _RUNNING, 10)
left = folder / "none yet"
result["left_of_installing"] = sorted(path.name for path in left.iterdir() if path.is_dir()) if left.exists() else []
os.environ["AADM_ENVIRONMENTS"] = environments

# Try it: one click in About, and a column that fails is shown.
Gui.runCommand("AADM_About")
settle(0.2)
about, *_ = [one for one in window.findChildren(QtGui.QDialog, "AADM_About") if one.isVisible()]
about.try_button.click()
spin(lambda: panel(CheckPanel) is not None, 120)
tried = FreeCAD.ActiveDocument
result["tried"] = {one.ColumnId: one.Result.Verdict for one in api.columns_in(tried)}
result["tried_shows"] = [panel(CheckPanel).column.ColumnId, panel(CheckPanel).column.Result.GoesOn]
result["said_by_try"] = sentences()
result["open_after_try"] = [one.objectName() for one in window.findChildren(QtGui.QDialog) if one.isVisible()]
screenshot("tried.png")
