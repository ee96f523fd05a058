"""A live camera in the scripted session: none named, one that is not there, one that plays a capture again, undo.

It finds what :mod:`tests.gui.session_body` finds, and what that has defined.
"""

# ruff: noqa: F821 - a script in the order of the session, with names that the runner puts in
from aadm_workbench.gui.panels.capture import CapturePanel

document = FreeCAD.openDocument(str(folder / "session.FCStd"))
document.UndoMode = 1
(column,) = api.columns_in(document)
camera_folder = folder / "camera"
camera_folder.mkdir()
(camera_folder / "depth.tiff").write_bytes((scans / "C-302-foot.tiff").read_bytes())
(camera_folder / "camera.toml").write_text(f"{intrinsics.read_text()}depth_scale_mm = 0.03\n")
Gui.Selection.clearSelection()
Gui.Selection.addSelection(column)
Gui.runCommand("AADM_CaptureScan")
capturing = panel(CapturePanel)
result["capture_kept_in"] = str(Path(capturing.folder.text()).relative_to(folder))
capturing.camera.setText("")
capturing.start()
result["said_without_camera_named"] = sentences()
capturing.camera.setText(f"replay:{camera_folder}")
kept_in = capturing.folder.text()
capturing.folder.set_text("")
capturing.start()
result["said_without_folder"] = sentences()
capturing.folder.set_text(kept_in)
capturing.camera.setText(f"replay:{folder / 'nowhere'}")
capturing.start()
spin(capturing.start_button.isEnabled, 30)
result["said_for_no_camera"] = sentences()
capturing.camera.setText(f"replay:{camera_folder}")
before = len(column.Scans)
capturing.start()
spin(lambda: len(column.Scans) > before and capturing.start_button.isEnabled(), 30)
result["said_by_capture"] = sentences()
result["captures"] = sorted(path.name for path in (folder / "captures").iterdir())
captured = column.Scans[-1]
result["captured"] = [captured.Kind, captured.PointCount, Path(captured.File).name]
screenshot("capture.png")
capturing.reject()
result["capture_undo"] = document.UndoNames[0]
document.undo()
result["scans_after_capture_undone"] = [before, len(column.Scans)]
FreeCAD.closeDocument(document.Name)
