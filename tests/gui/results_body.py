"""The second part of the scripted session: results written, saved, opened; columns deleted; a job. Inside FreeCAD.

It finds what :mod:`tests.gui.session_body` finds, and what that has defined.
"""

# ruff: noqa: E402, F821 - a script in the order of the session, with names that the runner puts in
import json

# Write results onto the model, save, write report.json.
from aadm_workbench.gui.panels.report import ReportPanel
from aadm_workbench.gui.panels.write import WritePanel

column_body.ViewObject.Visibility = True
document.saveAs(str(folder / "session.FCStd"))
Gui.runCommand("AADM_WriteResults")
writing = panel(WritePanel)
writing.start()
settle(0.2)
result["said_by_write"] = sentences()
result["on_model"] = [column_body.AADM_Verdict, column_body.AADM_LargestRebarDeviation.Value]
writing.into_ifc.setChecked(True)
writing.start()
result["said_without_ifc"] = sentences()
writing.reject()
Gui.runCommand("AADM_Report")
reporting = panel(ReportPanel)
reporting.folder.set_text(str(folder / "report"))
for box in reporting.forms.values():
    box.setChecked(False)
reporting.start()
result["said_by_report"] = sentences()
result["report"] = json.loads((folder / "report" / "report.json").read_text())["columns"][0]["verdict"]
result["picture_of_report"] = (folder / "report" / "view.png").is_file()
reporting.reject()
document.save()

# Saved, closed, opened.
name = document.Name
FreeCAD.closeDocument(name)
document = FreeCAD.openDocument(str(folder / "session.FCStd"))
settle(0.3)
(column,) = api.columns_in(document)
result["reopened"] = {
    "visible": column.Result.ViewObject.isVisible(),
    "view": type(column.Result.ViewObject.Proxy).__name__,
    "children": [obj.Name for obj in column.ViewObject.Proxy.claimChildren()],
    "icon": Path(column.ViewObject.Proxy.getIcon()).name,
    "labels": len(column.Result.ViewObject.Proxy.label_places()),
}

# Deleting a column takes its scans and its result along; one undo brings all back.
document.UndoMode = 1
document.openTransaction("delete")
Gui.Selection.clearSelection()
Gui.Selection.addSelection(column)
Gui.runCommand("Std_Delete", 0)
document.commitTransaction()
settle(0.1)
result["left_after_delete"] = [obj.Name for obj in document.Objects if obj.Name.startswith("AADM_")]
document.undo()
settle(0.1)
result["labels_after_undo"] = sum(len(places) for _, places in KEEPER._alive())
result["back_after_undo"] = sorted(obj.Name for obj in document.Objects if obj.Name.startswith("AADM_"))
FreeCAD.closeDocument(document.Name)

# A job of a whole floor: cancelled, refused, then done.
from aadm_workbench.gui.panels.job import JobPanel

floor = FreeCAD.newDocument("floor")
Gui.runCommand("AADM_RunJob")
job = panel(JobPanel)
job.start()
result["said_without_job"] = sentences()
broken = folder / "broken.toml"
broken.write_text("schema = 1\nnonsense = 2\n")
job.job.set_text(str(broken))
job.start()
spin(lambda: job.work is None, 30)
result["said_for_broken_job"] = sentences()
job.job.set_text(str(Path(SAMPLES) / "floor" / "job.toml"))
job.folder.set_text(str(folder / "cancelled"))
job.start()
settle(0.3)
job.cancel()
spin(lambda: job.work is None, 30)
result["said_by_cancelled_job"] = sentences()
result["shown_by_cancelled_job"] = len(api.columns_in(floor))
short = folder / "short.toml"
text = (Path(SAMPLES) / "lab" / "job.toml").read_text(encoding="utf-8")
short.write_text(text.replace('"scans/', f'"{(Path(SAMPLES) / "lab" / "scans").as_posix()}/'), encoding="utf-8")
job.job.set_text(str(short))
job.folder.set_text(str(folder / "lab"))
longest_gap_s = 0.0
job.start()
spin(lambda: job.work is None, 90)
result["said_by_job"] = sentences()
result["job_lines"] = [job.lines.item(place).text() for place in range(job.lines.count())]
result["job_columns"] = [[one.ColumnId, one.Result.Verdict] for one in api.columns_in(floor)]
result["longest_gap_in_job_s"] = longest_gap_s
if panel(JobPanel) is not None:
    job.reject()
FreeCAD.closeDocument(floor.Name)
