"""The panel in which a camera proves itself, in the real window: a plate is drawn, a profile is shown, used, left."""

from typing import Any

import pytest

from aadm_workbench.model import Camera, CameraProfile, Kind, LearnedEdges, Measure
from aadm_workbench.scan.camera_profile import profile_text, read_profile
from tests.calibration.painted_plate import Painter, painted_captures
from tests.conftest import ROOT, FreeCADRunner
from tests.freecad_environment import with_environment

pytestmark = pytest.mark.freecad

OPENED = """\
import time
from pathlib import Path
import FreeCAD, FreeCADGui as Gui
from PySide import QtGui
QtGui.QFontDatabase.addApplicationFont(FONT)
for name in (LOCALE, LOCALE.replace(" Simplified", " (Simplified)")):  # FreeCAD 1.1 calls it otherwise
    Gui.setLocale(name)
Gui.activateWorkbench("AADMWorkbench")

def spin(until, limit_s):
    begin = time.perf_counter()
    while not until() and time.perf_counter() - begin < limit_s:
        Gui.updateGui()
        time.sleep(0.02)
    return bool(until())

def picture(name):
    spin(lambda: False, 1.0)
    QtGui.QApplication.primaryScreen().grabWindow(0).save(str(folder / name))

def said():
    spin(lambda: False, 0.2)
    boxes = [box for box in Gui.getMainWindow().findChildren(QtGui.QMessageBox) if box.isVisible()]
    texts = [box.text() for box in boxes]
    for box in boxes:
        box.close()
    return texts

Gui.runCommand("AADM_Camera")
from aadm_workbench.gui.panels.camera_proof import CameraProofPanel
from aadm_workbench.gui.panels.task_panel import open_panel_of
panel = open_panel_of(CameraProofPanel)
"""

FONT = str(ROOT / "aadm_workbench" / "resources" / "fonts" / "wqy-microhei-subset.ttf")

BODY = """\
result["pages"] = [panel.pages.tabText(k) for k in range(panel.pages.count())]
result["buttons"] = []
for k in range(3):
    panel.pages.setCurrentIndex(k)
    result["buttons"].append(panel.start_button.text())
result["unused"] = panel.in_use.text()
result["asked"] = []
for k in (1, 2):
    panel.pages.setCurrentIndex(k)
    panel.start()
    result["asked"] += said()
panel.pages.setCurrentIndex(0)
panel.holes.setValue(16)
panel.plate_folder.set_text(str(folder / "plate"))
panel.start()
result["drawn"] = spin(lambda: panel.start_button.isEnabled(), 120)
result["said_by_plate"] = said()
result["files"] = sorted(path.name for path in (folder / "plate").iterdir())
result["plate_on_page_learn"] = panel.plate.text()
picture("plate.png")
panel.pages.setCurrentIndex(1)
panel.set_captures([str(folder / "plate" / "plate.toml")])
panel.profile.set_text(str(folder / "new.toml"))
panel.start()
spin(lambda: panel.start_button.isEnabled(), 120)
result["said_by_no_capture"] = said()
panel._learned(folder / "camera-0042.toml")
result["learned"] = panel.found.text()
result["used"] = panel.in_use.text()
picture("learned.png")
panel.use("")
result["left"] = panel.in_use.text()
program = folder / "not a program"
program.write_bytes(b"no program")
program.chmod(0o755)
FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/AADM").SetString("AadmProgram", str(program))
panel.pages.setCurrentIndex(0)
panel.start()
result["free_again"] = spin(lambda: panel.start_button.isEnabled(), 120)
result["said_by_no_program"] = said()
"""

LEARNED = """\
plate = folder / "a plate"
panel.pages.setCurrentIndex(1)
panel.plate.set_text(str(plate / "plate.toml"))
panel.set_captures([str(plate / f"plate-{number}.tiff") for number in range(1, 5)])
panel.camera.set_text(str(plate / "camera.toml"))
panel.depth_step.setValue(0.025)
panel.serial.setText("0042")
panel.date.setText("2026-11-20")
panel.profile.set_text(str(folder / "camera-0042.toml"))
panel.start()
result["busy"] = not panel.start_button.isEnabled()
result["learned"] = spin(lambda: panel.start_button.isEnabled(), 400)
result["said_by_learn"] = said()
result["figures"], result["used"] = panel.found.text(), panel.in_use.text()
picture("learned-from-captures.png")
panel.pages.setCurrentIndex(2)
panel.today.set_text(str(plate / "plate-5.tiff"))
panel.start()
result["verified"] = spin(lambda: panel.start_button.isEnabled(), 200)
result["said_by_verify"], result["verdicts"] = said(), panel.found.text()
result["files"] = sorted(path.name for path in folder.glob("camera-0042*"))
picture("verified.png")
"""


def found(window: FreeCADRunner, locale: str) -> dict[str, Any]:
    unknown = Measure(0.0, 1e-4)
    edges = {kind: LearnedEdges(Measure(4e-4, 3e-5), 1e-5, 0.1, unknown) for kind in Kind}
    camera = Camera(2425.0, 2425.0, 960.0, 600.0, 1920, 1200)
    profile = CameraProfile(
        "", "", "0042", "", "2026-11-20", 90, camera, (1300.0, 1450.0), (0.5, 4.0), Measure(5e-4, 3e-5), edges, "", 8
    )
    (window.folder / "camera-0042.toml").write_text(profile_text(profile))
    return with_environment(window).run(f"FONT, LOCALE = {FONT!r}, {locale!r}\n{OPENED}{BODY}", timeout_s=500.0)


def test_a_plate_is_drawn_and_a_profile_is_used_and_left(freecad_window: FreeCADRunner) -> None:
    seen = found(freecad_window, "English")
    assert seen["pages"] == ["Plate", "Learn", "Verify"]
    assert seen["buttons"] == ["Draw the plate", "Learn the camera", "Verify the camera"]
    assert [text.split(".")[0] for text in seen["asked"]] == ["Choose the plate"] * 2
    assert seen["drawn"]
    assert seen["said_by_plate"] == []
    assert seen["files"] == ["plate.dxf", "plate.pdf", "plate.step", "plate.toml"]
    assert seen["plate_on_page_learn"].endswith("plate.toml")
    assert len(seen["said_by_no_capture"]) == 1
    assert "This should not happen" not in seen["said_by_no_capture"][0]
    assert "scale: +500 ± 30 µm/m" in seen["learned"]
    assert "camera-0042.toml" in seen["used"]
    assert seen["left"] == seen["unused"] == "Checks use no profile of a camera."
    assert seen["free_again"]
    assert len(seen["said_by_no_program"]) == 1
    assert "not a program" in seen["said_by_no_program"][0]


def test_a_camera_is_learned_from_captures_and_verified(freecad_window: FreeCADRunner) -> None:
    """By the private process, as a person would: five captures of a camera whose scale is 0.05 % off."""
    painted_captures(freecad_window.folder / "a plate", Painter(scale=5e-4), 5, seed=4)
    seen = with_environment(freecad_window).run(
        f"FONT, LOCALE = {FONT!r}, 'English'\n{OPENED}{LEARNED}", timeout_s=900.0
    )
    assert seen["busy"]
    assert seen["learned"]
    assert seen["said_by_learn"] == []
    profile = read_profile(freecad_window.folder / "camera-0042.toml")
    assert (profile.serial, profile.date, profile.captures) == ("0042", "2026-11-20", 4)
    assert abs(profile.scale.value - 5e-4) < 3.0 * profile.scale.u
    assert f"scale: {1e6 * profile.scale.value:+.0f}" in seen["figures"]
    assert "camera-0042.toml" in seen["used"]
    assert seen["verified"]
    assert seen["said_by_verify"] == []
    assert seen["files"] == ["camera-0042-chart.html", "camera-0042-log.csv", "camera-0042.toml"]
    assert seen["verdicts"].count("pass") == 6


def test_it_speaks_chinese(freecad_window: FreeCADRunner) -> None:
    seen = found(freecad_window, "Chinese Simplified")
    assert seen["pages"] == ["标定板", "学习", "核验"]
    assert seen["unused"] == "检查不使用相机档案。"
    assert "比例: +500 ± 30 µm/m" in seen["learned"]
