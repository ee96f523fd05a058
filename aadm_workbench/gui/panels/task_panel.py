"""Panels in FreeCAD's task view: one of ours at a time, and never over somebody else's."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtGui

from aadm_workbench.errors import AadmError
from aadm_workbench.gui.resources import icon_path

translate = FreeCAD.Qt.translate
_OPEN: list[Any] = []


class TaskPanel:
    """A panel with a title, an icon and the button Close; ``self.form`` is its widget, ``self.layout`` stacks it up."""

    ICON = "aadm"

    def __init__(self, title: str) -> None:
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(title)
        self.form.setWindowIcon(QtGui.QIcon(icon_path(self.ICON)))
        self.layout = QtGui.QVBoxLayout(self.form)

    def getStandardButtons(self) -> int:
        """The button Close alone: what changes something has a button of its own, with its name on it."""
        return number_of(QtGui.QDialogButtonBox.Close)

    def reject(self) -> bool:
        """Close it."""
        close_panel(self)
        return True

    def closing(self) -> None:
        """What has to be ended when it closes."""


def show_panel(panel: TaskPanel) -> None:
    """Show a panel; another one of ours makes room.

    Raises
    ------
    AadmError
        Where another workbench has a panel open.
    """
    if FreeCADGui.Control.activeDialog():
        if not _OPEN:
            raise AadmError(translate("AADM", "Another panel is open in the task view: close it first."))
        close_panel(_OPEN[0])
    for chooser in panel.form.findChildren(QtGui.QComboBox):
        # The task view is narrow: a long text must not widen the panel beyond it.
        chooser.setSizeAdjustPolicy(QtGui.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        chooser.setMinimumContentsLength(6)
    _OPEN.append(panel)
    FreeCADGui.Control.showDialog(panel)


def close_panel(panel: TaskPanel) -> None:
    """Close a panel, if it is open."""
    panel.closing()
    if panel in _OPEN:
        _OPEN.remove(panel)
        FreeCADGui.Control.closeDialog()


def open_panel_of(kind: type) -> Any:
    """The panel of a kind that is open; None without one."""
    return next((panel for panel in _OPEN if isinstance(panel, kind)), None)


def number_of(flag: Any) -> int:
    """A flag of Qt as a number, in PySide2 and in PySide6."""
    return int(getattr(flag, "value", flag))
