"""The scripted session: from a model to written results, as a person would do it. Runs inside FreeCAD, on a screen.

It finds ``result`` (to be filled), ``folder`` (for its files), ``MODEL`` (text that draws a model), ``SAMPLES``.
"""

# ruff: noqa: E402, F821, PLW0603 - a script in the order of the session, with names that the runner puts in
import time
from pathlib import Path

import FreeCAD
import FreeCADGui as Gui
import numpy as np
from PySide import QtCore, QtGui

from aadm_workbench.gui.aadm_process import _RUNNING

# Where a machine has no Chinese font, thin boxes would be looked at.
QtGui.QFontDatabase.addApplicationFont(
    str(Path(SAMPLES).parent / "aadm_workbench" / "resources" / "fonts" / "wqy-microhei-subset.ttf")
)
namespace = {}
exec(MODEL, namespace)
window = Gui.getMainWindow()
longest_gap_s = 0.0
rounds = 0


def spin(until, limit_s=60.0):
    """Let the window live until something has happened; notes the longest that it has calculated instead."""
    global longest_gap_s, rounds
    begin, last = time.perf_counter(), time.process_time()
    while not until() and time.perf_counter() - begin < limit_s:
        Gui.updateGui()
        rounds += 1
        time.sleep(0.02)
        now = time.process_time()  # of this process: others may be at work on the machine
        longest_gap_s = max(longest_gap_s, now - last)
        last = now
    return bool(until())


def settle(seconds=0.5):
    spin(lambda: False, seconds)


def screenshot(name):
    settle()
    QtGui.QApplication.primaryScreen().grabWindow(0).save(str(folder / name))


def sentences():
    """The sentences on the screen, which are closed."""
    settle(0.1)
    boxes = [box for box in window.findChildren(QtGui.QMessageBox) if box.isVisible()]
    said = [box.text() for box in boxes]
    for box in boxes:
        box.close()
    settle(0.1)
    return said


def panel(kind):
    from aadm_workbench.gui.panels.task_panel import open_panel_of

    return open_panel_of(kind)


def is_active(name):
    from importlib import import_module

    from aadm_workbench.gui.commands import COMMANDS

    module, command = COMMANDS[name]
    return getattr(import_module(f"aadm_workbench.gui.commands.{module}"), command)().IsActive()


def run_anyway(name):
    """Run a command although it is greyed out, as a macro may; returns the sentences that it says."""
    from importlib import import_module

    from aadm_workbench.gui.commands import COMMANDS

    module, command = COMMANDS[name]
    getattr(import_module(f"aadm_workbench.gui.commands.{module}"), command)().Activated()
    spin(lambda: not _RUNNING)
    return sentences()


# Views jump where they are sent: a picture of one that is still turning shows neither here nor there.
FreeCAD.ParamGet("User parameter:BaseApp/Preferences/View").SetBool("UseNavigationAnimations", False)

# The workbench, as it is found.
result["freecad"] = ".".join(FreeCAD.Version()[:2])
result["listed"] = "AADMWorkbench" in Gui.listWorkbenches()
result["loaded_early"] = "aadm_workbench.gui.commands.about" in sys.modules
Gui.activateWorkbench("AADMWorkbench")
active = Gui.activeWorkbench()
result.update(name=active.MenuText, tooltip=active.ToolTip)
result["commands"] = sorted(name for name in Gui.listCommands() if name.startswith("AADM_"))
result["toolbars"] = [bar.windowTitle() for bar in window.findChildren(QtGui.QToolBar) if bar.isVisible()]
result["icon_is_drawn"] = not Gui.getIcon(active.Icon).pixmap(64, 64).isNull()
NEED_SOMETHING = [
    "AADM_SampleDesign",
    "AADM_ImportScan",
    "AADM_CaptureScan",
    "AADM_CheckColumn",
    "AADM_WriteResults",
    "AADM_Report",
]
result["active_without_document"] = [name for name in NEED_SOMETHING if is_active(name)]
result["said_without_document"] = {name: run_anyway(name) for name in NEED_SOMETHING}

# An empty document, then a model; nothing selected, then the wrong thing.
document = FreeCAD.newDocument("session")
document.UndoMode = 1
result["said_in_empty_document"] = {name: run_anyway(name) for name in NEED_SOMETHING}
column_body, bars = namespace["make_model"](document, (7800.0, 13200.0, 7200.0))
torus = document.addObject("Part::Torus", "Ring")
torus.Placement.Base = (9000, 13200, 7200)
document.recompute()
Gui.Selection.clearSelection()
Gui.Selection.addSelection(torus)
result["said_with_wrong_selection"] = {name: run_anyway(name) for name in NEED_SOMETHING}
result["objects_after_nonsense"] = [obj.Name for obj in document.Objects if obj.Name.startswith("AADM")]
document.removeObject(torus.Name)

# Sample design, undo, redo.
from aadm_workbench.gui.panels.design import REBAR_PLACE, DesignPanel

Gui.Selection.clearSelection()
Gui.Selection.addSelection(column_body)
Gui.runCommand("AADM_SampleDesign")
spin(lambda: panel(DesignPanel) is not None)
from aadm_workbench.document import api
from aadm_workbench.document.places import transform_of

(column,) = api.columns_in(document)
design_panel = panel(DesignPanel)
result["design_rows"] = design_panel.table.rowCount()
result["column_place"] = transform_of(column.Placement).tolist()
design_panel.sleeves_up.setCurrentText("sideways")
design_panel.apply()
result["said_for_wrong_up"] = sentences()
design_panel.sleeves_up.setCurrentText("+y")
design_panel.rebars_up.setCurrentText("+y")
design_panel.table.cellWidget(0, REBAR_PLACE).setCurrentIndex(3)
design_panel.swap(0, 3)
design_panel.apply()
swapped = api.column_design(column)
result["swapped"] = [swapped.rebars[0].centre.tolist(), swapped.rebars[3].centre.tolist()]
document.undo()
back = api.column_design(column)
result["swapped_back"] = [back.rebars[0].centre.tolist(), back.rebars[3].centre.tolist()]
Gui.Control.closeDialog()
design_panel.reject()
column.SleevesUp = column.RebarsUp = "+y"
undo_name = document.UndoNames[0] if document.UndoNames else ""
result["undo_names"] = list(document.UndoNames)

# Import: a broken scan, then the two good ones.
from aadm_workbench.gui.panels.import_scan import ImportPanel

scans = Path(SAMPLES) / "floor" / "scans"
intrinsics = folder / "camera.toml"
intrinsics.write_text("fx = 2425.4796\nfy = 2425.3285\ncx = 959.7418\ncy = 632.7028\nwidth = 1920\nheight = 1200\n")


def import_scan(file, kind, camera=str(intrinsics)):
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(column)
    Gui.runCommand("AADM_ImportScan")
    importing = panel(ImportPanel)
    importing.file.set_text(str(file))
    importing.kind.setCurrentIndex(importing.kind.findData(kind))
    importing.camera.set_text(camera)
    importing.depth_scale.setValue(0.03)
    before = len(column.Scans)
    importing.start()
    spin(lambda: len(column.Scans) > before or importing.start_button.isEnabled(), 30)
    said = sentences()
    if panel(ImportPanel) is not None:
        importing.reject()
    return said


result["said_for_broken_scan"] = import_scan(scans / "C-306-bars.tiff", "rebars")
result["said_without_camera"] = import_scan(scans / "C-302-foot.tiff", "sleeves", "")
result["said_for_missing_file"] = import_scan(folder / "nowhere.ply", "sleeves")
result["scans_after_errors"] = len(column.Scans)
result["said_for_good_scans"] = import_scan(scans / "C-302-foot.tiff", "sleeves") + import_scan(
    scans / "C-302-bars.tiff", "rebars"
)
result["scans"] = [[cloud.Kind, cloud.PointCount, len(cloud.Points)] for cloud in column.Scans]

# Check: cancelled, then to its end, while the window lives.
from aadm_workbench.gui.panels.check import CheckPanel

Gui.Selection.clearSelection()
Gui.Selection.addSelection(column_body)
Gui.runCommand("AADM_CheckColumn")
checking = panel(CheckPanel)
checking.start()
checking.cancel()
spin(checking.start_button.isEnabled, 30)
result["result_after_cancel"] = column.Result is not None
longest_gap_s = 0.0
rounds = 0
checking.start()
spin(lambda: column.Result is not None and checking.start_button.isEnabled(), 60)
result["longest_gap_s"] = longest_gap_s
result["rounds"] = rounds
result["said_by_check"] = sentences()
found = column.Result
result["verdict"] = [found.Verdict, found.GoesOn, list(found.Reasons)]
result["rows"] = [[row.name, row.what, row.verdict] for row in checking.table.rows]
result["first_shown"] = checking.table.item(0, 1).text()
result["scan_places"] = [transform_of(cloud.Placement).tolist() for cloud in column.Scans]
checking.only_failing.setChecked(True)
result["failing_rows"] = checking.table.rowCount()

# What is seen: the whole, and the foot from below with the colours at their places.
from aadm_workbench.document.display.projection import project
from aadm_workbench.document.places import world_point
from aadm_workbench.document.result import found_of
from aadm_workbench.gui.label_keeper import KEEPER
from aadm_workbench.gui.picture import save_picture
from aadm_workbench.gui.view_camera import active_view, camera_of, zoom_to

window.resizeDocks(
    [dock for dock in window.findChildren(QtGui.QDockWidget) if dock.isVisible()][:1], [420], QtCore.Qt.Horizontal
)
for dock in window.findChildren(QtGui.QDockWidget):
    if dock.objectName() in {"Python console", "Report view", "Selection view"}:
        dock.hide()
for cloud in column.Scans:
    cloud.ViewObject.Visibility = False
view = active_view()
view.viewIsometric()
view.fitAll()
screenshot("column.png")
checking.table.selectRow(0)
settle(0.3)
result["zoomed_height_mm"] = camera_of(view).height_mm
screenshot("zoomed.png")


def colours_at(name, places):
    """Colours of a picture of the view at places (x, y) of the foot, and the picture's file."""
    save_picture(view, folder / name)
    picture = QtGui.QImage(str(folder / name))
    world = np.array([world_point(column.Result, place) for place in places])
    pixels, _ = project(world, camera_of(view))
    seen = []
    for x, y in pixels:
        at = QtGui.QColor(picture.pixel(round(x), round(picture.height() - 1 - y)))
        seen.append([at.red(), at.green(), at.blue()])
    return seen


column.Result.ViewObject.Proxy.pick(None)
column_body.ViewObject.Visibility = False
for bar in bars:
    bar.ViewObject.Visibility = False
view.viewTop()
zoom_to(view, np.array(world_point(column.Result, (0, 0))), 760.0)
settle(0.3)
points = {point["label"]: point for kind in ("sleeves", "rebars") for point in found_of(found)[kind]["points"]}
factor = column.Result.ViewObject.Proxy.magnification()
result["factor"] = factor
bad, good = points["R5"], points["S8"]
middle_of_arrow = [bad["design_mm"][k] + 0.5 * factor * (bad["aligned_mm"][k] - bad["design_mm"][k]) for k in (0, 1)]
edge_of_sleeve = [good["aligned_mm"][0] + good["diameter_mm"] / 2.0, good["aligned_mm"][1]]
nowhere = [0.0, 345.0]
result["colours"] = colours_at("foot.png", [middle_of_arrow, edge_of_sleeve, nowhere])
result["boxes"] = [list(box) for box in KEEPER.boxes]
column.Result.ViewObject.Shows = "minimax"
result["colours_minimax"] = colours_at("minimax.png", [middle_of_arrow])
column.Result.ViewObject.Shows = "position"
for cloud in column.Scans:
    cloud.ViewObject.Visibility = cloud.Kind == "sleeves"
column.Result.ViewObject.Visibility = False
save_picture(view, folder / "cloud.png")
column.Result.ViewObject.Visibility = True

# The model moves: the column follows. The unit changes: labels follow.
column_body.Placement.Base = column_body.Placement.Base + FreeCAD.Vector(0, 500, 0)
settle(0.2)
result["followed_mm"] = column.Placement.Base.y, column.Result.Placement.Base.y
units = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Units")
from aadm_workbench.document.words import length_text

before = length_text(2.54)
FreeCAD.Units.setSchema(3)
result["lengths"] = [before, length_text(2.54)]
FreeCAD.Units.setSchema(0)
column_body.Placement.Base = column_body.Placement.Base - FreeCAD.Vector(0, 500, 0)
settle(0.2)
if panel(CheckPanel) is not None:
    checking.reject()
