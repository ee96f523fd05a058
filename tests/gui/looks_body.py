"""Every panel and window, light and dark, in both languages: pictures, and what cannot be read. Runs inside FreeCAD.

It finds what the earlier parts of the session have defined; the sample floor is open, checked.
"""

# ruff: noqa: F821 - a script in the order of the session, with names that the runner puts in
from aadm_workbench.gui.commands.about import AboutWindow
from aadm_workbench.gui.hoisting.window import HoistingWindow
from aadm_workbench.gui.panels.capture import open_panel as open_capture
from aadm_workbench.gui.panels.check import open_panel as open_check
from aadm_workbench.gui.panels.check_all import open_panel as open_check_all
from aadm_workbench.gui.panels.design import open_panel as open_design
from aadm_workbench.gui.panels.environment import EnvironmentWindow
from aadm_workbench.gui.panels.import_scan import open_panel as open_import
from aadm_workbench.gui.panels.job import open_panel as open_job
from aadm_workbench.gui.panels.report import open_panel as open_report_panel
from aadm_workbench.gui.panels.write import open_panel as open_write

looked_at = tried
FreeCAD.setActiveDocument(tried.Name)
failing = next(one for one in api.columns_in(looked_at) if one.ColumnId == "C-307")
PANELS = {
    "design": lambda: open_design(failing),
    "import": lambda: open_import(looked_at, [Path(SAMPLES) / "floor" / "scans" / "C-307-foot.tiff"], failing),
    "capture": lambda: open_capture(looked_at, failing),
    "check": lambda: open_check(failing),
    "check_all": lambda: open_check_all(looked_at),
    "job": lambda: open_job(str(Path(SAMPLES) / "floor" / "job.toml")),
    "report": lambda: open_report_panel(api.report_of(looked_at), looked_at),
    "write": lambda: open_write(looked_at),
}
WINDOWS = {"about": AboutWindow, "install": EnvironmentWindow, "hoisting": HoistingWindow}

application = QtGui.QApplication.instance()
light = application.styleSheet()
sheets = Path(FreeCAD.getResourceDir()) / "Gui" / "Stylesheets"
dark_sheets = [sheets / "Behave-dark.qss", sheets / "FreeCAD Dark.qss"]


def put_on(theme):
    """Light as FreeCAD starts; dark by one of its own style sheets, or by the palette where it has none as a file."""
    if theme == "light":
        application.setStyleSheet(light)
        return
    text = next((sheet.read_text(encoding="utf-8") for sheet in dark_sheets if sheet.is_file()), "")
    if "@" in text or not text:  # a template that FreeCAD fills in by itself
        text = "* { background: #2b2b2b; color: #e0e0e0; } *:disabled { color: #808080; }"
    application.setStyleSheet(text)


def come_to_rest(form):
    """Wait until a panel has unfolded, which FreeCAD does slowly, and nothing in it moves any more."""
    before = None
    for _ in range(40):
        now = places_in(form)
        if now == before:
            return
        before = now
        settle(0.25)


def dress(language):
    for name in (language, language.replace(" Simplified", " (Simplified)")):
        Gui.setLocale(name)
    settle(0.05)


main_tools = [dock for dock in window.findChildren(QtGui.QDockWidget) if dock.objectName() == "Combo View"]
window.resizeDocks(main_tools[:1], [300], QtCore.Qt.Horizontal)  # about what FreeCAD gives it at first
result["looks"] = {}
for theme in ("light", "dark"):
    put_on(theme)
    # Where texts are shown in both, styles are; a dark one differs from a light one in its colours alone.
    for language in ("English", "Chinese Simplified") if theme == "light" else ("Chinese Simplified",):
        dress(language)
        round_name = f"{theme}-{'en' if language == 'English' else 'zh'}"
        for name, open_it in (PANELS | WINDOWS).items():
            opened = open_it()
            form = getattr(opened, "form", opened)
            if form is opened:
                opened.show()
            come_to_rest(form)
            result["looks"][f"{name}-{round_name}"] = faults_in(form)
            QtGui.QApplication.primaryScreen().grabWindow(0).save(str(folder / f"look-{name}-{round_name}.png"))
            opened.close() if form is opened else opened.reject()
    settle(0.3)
    bars = [bar for bar in window.findChildren(QtGui.QToolBar) if bar.windowTitle() == "AADM" and bar.isVisible()]
    result["looks"][f"toolbar-{theme}"] = [fault for bar in bars for fault in faults_of_icons(bar)] or (
        [] if bars else ["there is no toolbar"]
    )
    put_on("light")
dress("English")

# What must be found: text on its own colour, a button too narrow, two on one place.
bad = QtGui.QWidget()
for number, (place, style) in enumerate(
    [((0, 0, 200, 30), "color: #fafafa; background: white"), ((0, 40, 25, 30), "")]
):
    made = QtGui.QPushButton("A text that is too long for it", bad) if number else QtGui.QLabel("pale", bad)
    made.setGeometry(*place)
    made.setStyleSheet(style)
QtGui.QCheckBox("on the same place", bad).setGeometry(0, 50, 200, 30)
bad.resize(220, 100)
bad.show()
settle(0.05)
result["bad_looks"] = faults_in(bad)
bad.close()
