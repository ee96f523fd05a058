"""Many columns at once: scans by name in a folder, a job file, what goes wrong in one of them. Runs inside FreeCAD.

It finds what the earlier parts of the session have defined.
"""

# ruff: noqa: F821 - a script in the order of the session, with names that the runner puts in
import tomllib

from aadm_workbench.document.job.floor import put_scans, save_job
from aadm_workbench.document.job.opened import insert as insert_job
from aadm_workbench.gui.panels.check_all import CheckAllPanel
from aadm_workbench.gui.panels.import_scan import open_panel as open_import_of

first_document = document
FLOOR_IDS = [f"C-30{number}" for number in range(1, 9)]
project = folder / "project"
shutil.copytree(Path(SAMPLES) / "floor", project)
job_file = project / "job.toml"
written = job_file.read_text(encoding="utf-8")


def all_rows():
    found = panel(CheckAllPanel).table.rows()
    return [
        [[file.name for file in row.sleeves], [file.name for file in row.rebars], row.up, row.wanted] for row in found
    ]


# A job that is opened: its columns come from its model, its scans stand in the table; saved, it is what it was.
document = FreeCAD.newDocument("job")
document.UndoMode = 1
insert_job(str(job_file), document.Name)
spin(lambda: panel(CheckAllPanel) is not None, 60)
result["job_rows"] = all_rows()
result["job_camera"] = panel(CheckAllPanel).camera.text() == str(job_file)
panel(CheckAllPanel).reject()

# The same scans by their names in the folder.
Gui.Selection.clearSelection()
Gui.runCommand("AADM_CheckAll")
checking_all = panel(CheckAllPanel)
checking_all.folder.set_text(str(project / "scans"))
result["folder_rows"] = all_rows()
result["folder_camera"] = Path(checking_all.camera.text()).name
result["folder_job"] = checking_all.job.text().removeprefix(str(project))

# Two of them are checked, one of which has a scan that breaks off; then cancelled.
checking_all.table.set_all_up("+y")
checking_all.table.switch_on([name in {"C-301", "C-306"} for name in FLOOR_IDS])
checking_all.job.set_text(str(project / "two.toml"))
checking_all.start()
spin(lambda: checking_all.work is None, 120)
result["said_by_two"] = sentences()
result["two"] = {one.ColumnId: [one.Result.Verdict, [Path(cloud.File).name for cloud in one.Scans]]
                 for one in api.columns_in(document) if one.Result}  # fmt: skip
result["two_undo"] = list(document.UndoNames)
result["two_seen_mm"] = camera_of(active_view()).height_mm
Gui.Selection.clearSelection()
checked = api.columns_in(document)[0]
Gui.Selection.addSelection(checked)
Gui.runCommand("AADM_CheckColumn")
result["scans_to_show"] = not panel(CheckPanel).show_scans.isHidden()
panel(CheckPanel).read_scans()
spin(lambda: all(cloud.PointCount for cloud in checked.Scans) and not _RUNNING, 60)
result["shown_scans"] = [[cloud.PointCount > 1_000_000, len(cloud.Distances) == len(cloud.Points) > 0, cloud.Aligned]
                         for cloud in checked.Scans]  # fmt: skip
result["bodies"] = [len(json.loads(one.Body)) for one in api.columns_in(document)]
Gui.Selection.clearSelection()
Gui.runCommand("AADM_CheckAll")
checking_all = panel(CheckAllPanel)
checking_all.table.switch_on([name in {"C-301", "C-306"} for name in FLOOR_IDS])
checking_all.start()
spin(lambda: bool(_RUNNING), 30)
checking_all.cancel()
spin(lambda: checking_all.work is None, 30)
result["said_by_cancelled_all"] = [sentences(), checking_all.step.text()]

# The document remembers both; without any scan a sentence says so.
result["remembered"] = [Path(checking_all.job.text()).name, all_rows()[0][:2]]
checking_all.reject()
document.saveAs(str(folder / "floor-check.FCStd"))
FreeCAD.closeDocument(document.Name)
document = FreeCAD.openDocument(str(folder / "floor-check.FCStd"))
Gui.runCommand("AADM_CheckAll")
checking_all = panel(CheckAllPanel)
result["remembered_after_opening"] = [Path(checking_all.job.text()).name, all_rows()[0][:2]]
checking_all.table.switch_on([False] * 8)
checking_all.start()
result["said_without_wanted"] = sentences()

# The job, saved by the document: the same file where nothing has changed, the same job where it is written anew.
checking_all.take_job(job_file)
camera = tomllib.loads(written)["camera"]
step_mm = camera.pop("depth_scale_mm")
for one, row in zip(api.columns_in(document), checking_all.table.rows(), strict=True):
    put_scans(one, row, units="mm", camera=camera, depth_scale_mm=step_mm)
save_job(api.columns_in(document), job_file)
result["job_is_as_it_was"] = job_file.read_text(encoding="utf-8") == written
api.columns_in(document)[0].SleevesUp = "-x"
save_job(api.columns_in(document), job_file)
anew = tomllib.loads(job_file.read_text(encoding="utf-8"))
result["anew"] = anew
save_job(api.columns_in(document), project / "elsewhere.toml")
result["project"] = str(project)
checking_all.reject()

# A job with columns that the document lacks, and one that is none.
stranger = project / "stranger.toml"
stranger.write_text(written.replace("C-308", "C-999"), encoding="utf-8")
insert_job(str(stranger), document.Name)
result["said_for_strangers"] = sentences()
panel(CheckAllPanel).reject()
FreeCAD.closeDocument(document.Name)
settle(0.1)

# An IFC file that FreeCAD shows natively, of which only the project is loaded, and that is selected: its file is read.
native = FreeCAD.newDocument("native")
root = native.addObject("Part::Feature", "IfcObject")
root.addProperty("App::PropertyString", "IfcFilePath")
root.IfcFilePath = str(project / "floor3.ifc")
Gui.Selection.clearSelection()
Gui.Selection.addSelection(root)
Gui.runCommand("AADM_SampleDesign")
spin(lambda: panel(DesignPanel) is not None, 60)
result["native_columns"] = sorted(one.ColumnId for one in api.columns_in(native))
panel(DesignPanel).reject()
FreeCAD.closeDocument(native.Name)

# A scan alone: its model is asked for, then it is back, and its column is known by its name.
alone = FreeCAD.newDocument("alone")
lonely = project / "scans" / "C-305-bars.tiff"
open_import_of(alone, [lonely]).start()
offered = [box for box in window.findChildren(QtGui.QMessageBox) if box.isVisible()]
QtGui.QFileDialog.getOpenFileName, asked_before = (
    staticmethod(lambda *_: (str(project / "floor3.ifc"), "")), QtGui.QFileDialog.getOpenFileName
)  # fmt: skip
next(button for box in offered for button in box.buttons() if "IFC" in button.text()).click()
spin(lambda: bool(api.columns_in(alone)) and panel(ImportPanel) is not None, 60)
QtGui.QFileDialog.getOpenFileName = asked_before
back = panel(ImportPanel)
result["back_with_scan"] = [Path(back.file.text()).name, back.column.currentText(), back.kind.currentData()]
back.reject()
FreeCAD.closeDocument(alone.Name)
settle(0.1)
document = first_document
