"""The workbench as FreeCAD lists it; its commands are loaded when it is first opened."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui

from aadm_workbench.document.asking import JOB_PANELS, LANGUAGES, SCAN_PANELS
from aadm_workbench.gui.resources import FORMS, ICONS, TRANSLATIONS, icon_path

translate = FreeCAD.Qt.translate  # a module without a place on disk: it cannot be imported from
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class AADMWorkbench(FreeCADGui.Workbench):
    """Precast columns: grouting sleeves against connecting rebars."""

    MenuText = "AADM"
    ToolTip = translate("AADM", "Checks precast columns against their connecting rebars before they are hoisted")
    Icon = icon_path("aadm")

    def Initialize(self) -> None:
        """Register the commands; FreeCAD calls this once, when the workbench is first opened."""
        from aadm_workbench.gui.commands import COMMANDS, TOOLBAR
        from aadm_workbench.gui.observer import watch_models

        for name, (module, command) in COMMANDS.items():
            FreeCADGui.addCommand(name, getattr(import_module(f"aadm_workbench.gui.commands.{module}"), command)())
        self.appendToolbar(QT_TRANSLATE_NOOP("Workbench", "AADM"), list(TOOLBAR))
        self.appendMenu(QT_TRANSLATE_NOOP("Workbench", "AADM"), list(COMMANDS))
        watch_models()

    def ContextMenu(self, recipient: str) -> None:
        """Offer what can be done with a column."""
        from aadm_workbench.gui.chosen import chosen_columns

        if chosen_columns():
            self.appendContextMenu(
                "AADM",
                ["AADM_ImportScan", "AADM_CaptureScan", "AADM_CheckColumn", "AADM_CheckAll", "AADM_WriteResults"],
            )

    def GetClassName(self) -> str:
        """Name of FreeCAD's own class behind a workbench that is written in Python."""
        return "Gui::PythonWorkbench"


def set_up() -> None:
    """What must be there before the workbench is opened: texts in the user's language, the page in the preferences."""
    FreeCADGui.addLanguagePath(str(TRANSLATIONS))
    FreeCADGui.updateLocale()
    FreeCADGui.addIconPath(str(ICONS))
    FreeCADGui.addPreferencePage(str(FORMS / "preferences.ui"), "AADM")
    FreeCADGui.addWorkbench(AADMWorkbench())
    SCAN_PANELS[:] = [_open_import_panel]
    JOB_PANELS[:] = [_open_job_panel]
    LANGUAGES[:] = [_in_language]


def _in_language(sentence: str) -> str:
    from aadm_workbench.gui.language import in_language

    return in_language(sentence)


def _open_import_panel(document: Any, files: list[Path]) -> None:
    from aadm_workbench.gui.panels.import_scan import open_panel

    open_panel(document, files)


def _open_job_panel(document: Any, job: Path) -> None:
    from aadm_workbench.gui.panels.check_all import open_job

    open_job(document, job)
