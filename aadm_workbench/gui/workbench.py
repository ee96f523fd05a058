"""The workbench as FreeCAD lists it; its commands are loaded when it is first opened."""

from pathlib import Path

import FreeCAD
import FreeCADGui

translate = FreeCAD.Qt.translate  # a module without a place on disk: it cannot be imported from

ICONS = Path(__file__).resolve().parents[1] / "resources" / "icons"


class AADMWorkbench(FreeCADGui.Workbench):
    """Precast columns: grouting sleeves against connecting rebars."""

    MenuText = "AADM"
    ToolTip = translate("AADM", "Checks precast columns against their connecting rebars before they are hoisted")
    Icon = str(ICONS / "aadm.svg")

    def Initialize(self) -> None:
        """Register the commands; FreeCAD calls this once, when the workbench is first opened."""
        from aadm_workbench.gui import about

        FreeCADGui.addCommand(about.NAME, about.About())
        self.appendMenu("AADM", [about.NAME])
        self.appendToolbar("AADM", [about.NAME])

    def GetClassName(self) -> str:
        """Name of FreeCAD's own class behind a workbench that is written in Python."""
        return "Gui::PythonWorkbench"
