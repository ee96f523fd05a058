"""A watch started, looked at and stopped from the hoisting window, on virtual frames. Runs inside FreeCAD.

It finds ``HUNG``: a folder with job.toml, and in ``captures`` the frames that a camera plays again.
"""

# ruff: noqa: F821 - a script with names that the runner puts in
import json
import shutil
import time
from pathlib import Path

import FreeCAD
import FreeCADGui as Gui
from PySide import QtGui

from aadm_workbench.gui.aadm_process import _RUNNING
from aadm_workbench.gui.hoisting.window import open_window

QtGui.QFontDatabase.addApplicationFont(FONT)
main = Gui.getMainWindow()
hung = Path(HUNG)
application = QtGui.QApplication.instance()
sheets = Path(FreeCAD.getResourceDir()) / "Gui" / "Stylesheets"
dark = next((sheet for sheet in (sheets / "Behave-dark.qss", sheets / "FreeCAD Dark.qss") if sheet.is_file()), None)
plain_dark = "* { background: #2b2b2b; color: #e0e0e0; } *:disabled { color: #808080; }"


def spin(until, limit_s=120.0):
    begin = time.perf_counter()
    while not until() and time.perf_counter() - begin < limit_s:
        Gui.updateGui()
        time.sleep(0.02)
    return bool(until())


def said():
    spin(lambda: False, 0.2)
    boxes = [box for box in main.findChildren(QtGui.QMessageBox) if box.isVisible()]
    texts = [box.text() for box in boxes]
    for box in boxes:
        box.close()
    return texts


def grab(name):
    spin(lambda: False, 0.6)
    QtGui.QApplication.primaryScreen().grabWindow(0).save(str(folder / name))


# One camera writes into the folder by itself; nothing is named yet.
window = open_window()
watch = window.watch
watch.start()
result["said_without_job"] = said()
watch.job.set_text(str(hung / "job.toml"))
watch.start()
result["said_without_column"] = said()
watch.column.setEditText("L-1")
watch.start()
result["said_without_folder"] = said()
window.folder.set_text(str(hung / "frames"))
watch.column.setEditText("no such column")
watch.start()
spin(lambda: not watch.is_watching())
result["said_for_wrong_column"] = said()

# A folder, into which frames are put while it is watched.
watch.column.setEditText("L-1")
watch.start()
result["button_while_watching"] = watch.button.text()
result["locked"] = not watch.job.isEnabled()
frames = sorted((hung / "captures").iterdir())
state = hung / "frames" / "aadm-state.json"
result["sequences"] = []
for number, frame in enumerate(frames):
    spin(lambda first=number == 0: first and "waiting" in watch.state.text(), 120.0 if number == 0 else 1.0)
    partly = hung / "frames" / f".{frame.name}.tmp"
    shutil.copyfile(frame / "depth.tiff", partly)
    partly.rename(hung / "frames" / f"{frame.name}.tiff")
    spin(lambda wanted=number + 1: state.is_file() and json.loads(state.read_text()).get("sequence") == wanted)
    result["sequences"].append(json.loads(state.read_text()).get("sequence") if state.is_file() else None)
    grab(f"watch-{number + 1}.png")
window.look()
result["state_said"] = watch.state.text()
result["shown_column"] = window.measurement.column if window.measurement else ""
result["light"] = window.picture._light()
result["guided"] = window.picture._guidance is not None
application.setStyleSheet(dark.read_text(encoding="utf-8") if dark else plain_dark)
grab("watch-dark.png")
application.setStyleSheet("")
window.full.setChecked(True)
grab("watch-full.png")
result["bar_in_full_screen"] = watch.isVisible()
window.full.setChecked(False)
watch.stop()
result["ended"] = spin(lambda: not watch.is_watching() and not _RUNNING, 20.0)
result["said_after_stop"] = said()
result["button_after_stop"] = watch.button.text()

# A camera that plays captures again; when it has no more the watch ends by itself, with the last verdict.
window.folder.set_text(str(hung / "played"))
watch.camera.setText(f"replay:{hung / 'captures'}")
watch.corner.setCurrentIndex(watch.corner.findData("-x-y"))
watch.start()
result["ended_by_itself"] = spin(lambda: not watch.is_watching())
result["said_by_camera"] = said()
result["played"] = json.loads((hung / "played" / "aadm-state.json").read_text())["sequence"]

# The window is closed while a watch runs: it ends with it.
watch.camera.setText("")
watch.start()
spin(lambda: "waiting" in watch.state.text())
result["ran"] = len(_RUNNING)
window.close()
result["ended_with_window"] = spin(lambda: not _RUNNING, 20.0)
