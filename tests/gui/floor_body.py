"""The second half of the scripted session: a large floor, the hoisting window, the other language. Runs inside FreeCAD.

It finds what :mod:`tests.gui.session_body` finds, and what that has defined.
"""

# ruff: noqa: E402, F821 - a script in the order of the session, with names that the runner puts in
import copy
import subprocess

from aadm_workbench.gui.hoisting.window import open_window
from aadm_workbench.gui.view_camera import active_view as view_in_front

# Thirty columns.
one_floor = json.loads((folder / "report" / "report.json").read_text())
entry = one_floor["columns"][0]
one_floor["columns"] = []
for number in range(30):
    another = copy.deepcopy(entry)
    another["id"], another["global_id"] = f"C-{number:03d}", None
    T = np.eye(4)
    T[:3, 3] = [number % 6 * 6000.0, number // 6 * 6000.0, 3600.0]
    another["T_model_column"] = T.tolist()
    another["verdict"] = ("pass", "fail", "inconclusive", "not_measured", "error")[number % 5]
    one_floor["columns"].append(another)
(folder / "thirty.json").write_text(json.dumps(one_floor))
big = FreeCAD.newDocument("thirty")
begin = time.process_time()  # of this process: others may be at work on the machine
Gui.Control.closeDialog()
from aadm_workbench.document.report import opened as open_report

open_report.insert(str(folder / "thirty.json"), big.Name)
view = view_in_front()
view.viewTop()
view.fitAll()
Gui.updateGui()
result["thirty_s"] = time.process_time() - begin
result["thirty"] = len(api.columns_in(big))
turns = []
for turn in range(20):
    begin = time.process_time()
    view.getCameraNode().position.setValue(15000.0 + 100.0 * turn, 12000.0, 20000.0)
    Gui.updateGui()
    turns.append(time.process_time() - begin)
result["slowest_turn_s"] = max(turns)
view.viewTop()
view.fitAll()
save_picture(view, folder / "floor.png")
result["floor_boxes"] = [list(box) for box in KEEPER.boxes]
big.undo()
result["thirty_after_undo"] = len(api.columns_in(big))
open_report.insert(str(folder / "nowhere.json"), big.Name)
(folder / "odd.json").write_text('{"schema": 1, "columns": [{"id": 3}]}')
open_report.insert(str(folder / "odd.json"), big.Name)
result["thirty_after_odd_reports"] = len(api.columns_in(big))
FreeCAD.closeDocument(big.Name)

# A batch writes its results into the model without a screen; here it is opened.
plain = FreeCAD.newDocument("plain")
body, _ = namespace["make_model"](plain, (7800.0, 13200.0, 7200.0))
body.addProperty("App::PropertyString", "GlobalId")
body.GlobalId = "1rW1CmykLUif254YhpKjBc"
body.ViewObject.ShapeColor = (0.1, 0.2, 0.3)
plain.saveAs(str(folder / "plain.FCStd"))
FreeCAD.closeDocument(plain.Name)
entry["global_id"] = "1rW1CmykLUif254YhpKjBc"
(folder / "one.json").write_text(json.dumps({**one_floor, "columns": [entry]}))
words = [str(folder / "one.json"), str(folder / "annotated.FCStd"), str(folder / "plain.FCStd")]
code = f"import sys, runpy; sys.argv[1:] = {words!r}; "
code += "runpy.run_module('aadm_workbench.document.report.annotate', run_name='__main__', alter_sys=True)"
ended = subprocess.run([FREECADCMD, "-c", code], capture_output=True, text=True, timeout=60, check=False)
result["annotate"] = [ended.returncode, (folder / "annotated.FCStd").is_file()]
result["annotate_said"] = ended.stdout[-2000:] + ended.stderr[-2000:]
annotated = FreeCAD.openDocument(str(folder / "annotated.FCStd"))
settle(0.3)
(shown,) = api.columns_in(annotated)
result["annotated"] = {
    "visible": [obj.Name for obj in annotated.Objects if obj.ViewObject.Visibility],
    "objects": [obj.Name for obj in annotated.Objects],
    "colour": [round(value, 2) for value in annotated.Column.ViewObject.ShapeColor[:3]],
    "model": shown.Model.Name,
    "view": type(shown.Result.ViewObject.Proxy).__name__,
    "labels": len(shown.Result.ViewObject.Proxy.label_places()),
}
view = view_in_front()
view.viewBottom()
view.fitAll()
save_picture(view, folder / "annotated.png")
FreeCAD.closeDocument(annotated.Name)

# Far from the origin.
far = FreeCAD.newDocument("far")
one_floor["columns"] = one_floor["columns"][:1]
one_floor["columns"][0]["T_model_column"][0][3] = 4.0e8
(far_column,) = api.show(far, one_floor)
far.recompute()
view = view_in_front()
view.viewTop()
view.fitAll()
column = far_column
zoom_to(view, np.array(world_point(far_column.Result, (0, 0))), 760.0)
settle(0.3)
result["far_boxes"] = len(KEEPER.boxes)
result["far_place"] = list(far_column.Placement.Base)
save_picture(view, folder / "far.png")
FreeCAD.closeDocument(far.Name)

# Hoisting.
measured = folder / "measured"
measured.mkdir()
pairs = [{"sleeve": f"S{k}", "rebar": f"R{k}", "seen": True, "rebar_seen": True} for k in range(1, 5)]
move = {"dx_mm": 8.0, "dy_mm": -5.0, "yaw_deg": 0.4, "right_mm": 8.0, "away_mm": -5.0}
frame = {"source": "frame-1.tiff", "verdict": "fail", "max_mm": 12.9, "pairs": pairs, "orientation": "declared"}
frame |= {"height_mm": 90.0, "column_tilt_deg": 0.1, "correction": {**move, "over": ["S1", "S2", "S3", "S4"]}}


def put_state(age_s, **changes):
    from aadm_workbench.report.hoisting_fitness import stamp_of

    state = {"schema": 2, "column": "C-302", "captured": stamp_of(time.time() - age_s), "valid_for_s": 15.0}
    state |= {"still": True, "swing": {"amplitude_mm": 0.2}, "limit_mm": 3.0, "move": move, "largest_mm": 12.9}
    (measured / "state.json").write_text(json.dumps({**state, "frame": frame, **changes}))
    hoisting.look()
    result["lights"].append(hoisting.picture._light())


result["lights"] = []
hoisting = open_window(str(measured))
hoisting.look()
screenshot("waiting.png")
put_state(0.0, still=False)
result["hoisting"] = [hoisting.picture._guidance.right_mm, hoisting.picture._guidance.ahead_mm]
screenshot("hoisting.png")
passing = {**frame, "verdict": "pass", "max_mm": 1.2}
put_state(0.0, frame=passing, largest_mm=1.2)
put_state(60.0, frame=passing, largest_mm=1.2)
screenshot("stale.png")
put_state(0.0, frame=passing, largest_mm=1.2, still=False, swing=None, moving=True, move=None)
(measured / "state.json").write_text("{")
hoisting.look()
result["text_for_broken_state"] = hoisting.picture._text
hoisting.close()

# The window About, and the other language.
Gui.runCommand("AADM_About")
settle(0.2)
about = window.findChild(QtGui.QDialog, "AADM_About")
result["about"] = about.text.text()
result["about_state"] = about.state.text()
result["about_buttons"] = [button.text() for button in about.findChildren(QtGui.QPushButton)]
about.grab().save(str(folder / "about.png"))
about.close()
in_english = FreeCAD.Qt.translate("AADM_CheckColumn", "Check column")
for name in ("Chinese Simplified", "Chinese (Simplified)"):
    Gui.setLocale(name)
    settle(0.2)
    if FreeCAD.Qt.translate("AADM_CheckColumn", "Check column") != in_english:
        break
from aadm_workbench.gui.language import in_language

result["sentence"] = in_language("R5 is 3.47 mm from design, limit 2 mm (T/CCES 30-2022, 4.3.3)")
result["words"] = [in_english, FreeCAD.Qt.translate("AADM_CheckColumn", "Check column")]
menus = [menu for menu in window.findChildren(QtGui.QMenu) if menu.title() == "AADM"]
result["menu"] = [action.text() for action in menus[0].actions()] if menus else []
Gui.setLocale("English")
settle(0.2)
result["words"].append(FreeCAD.Qt.translate("AADM_CheckColumn", "Check column"))
