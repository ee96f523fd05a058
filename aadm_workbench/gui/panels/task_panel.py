"""Panels in FreeCAD's task view: one of ours at a time, and never over somebody else's."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench.document.private_process import Work
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.aadm_process import PrivateWork
from aadm_workbench.gui.resources import icon
from aadm_workbench.gui.sentences import sentences, show_error

translate = FreeCAD.Qt.translate
_OPEN: list[Any] = []
_MOST_OF_A_TITLE = 24
"""Letters of mean width: with icon and arrow as much as FreeCAD's task view shows at the width that it starts with."""


class TaskPanel:
    """A panel with a title, an icon and the button Close; ``self.form`` is its widget, ``self.layout`` stacks it up.

    ``owner`` is the document or the object that it is about: with that it goes.
    """

    ICON = "aadm"

    def __init__(self, title: str, owner: Any = None) -> None:
        # FreeCAD takes the form away from a panel that it closes.
        self.title, self.owner = title, owner
        self.form = QtGui.QWidget()
        # The title is never narrower than its text, and with it the panel: the name of a column may have forty letters.
        metrics = self.form.fontMetrics()
        widest = _MOST_OF_A_TITLE * metrics.averageCharWidth()
        self.form.setWindowTitle(metrics.elidedText(title, QtCore.Qt.ElideMiddle, widest))
        self.form.setWindowIcon(icon(self.ICON))
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


class WorkingPanel(TaskPanel):
    """A panel with a button that has work done by the private process, one that cancels it, and a bar."""

    def __init__(self, title: str, owner: Any = None) -> None:
        super().__init__(title, owner)
        self.work: PrivateWork | None = None
        self.start_button = QtGui.QPushButton()
        self.start_button.clicked.connect(self.start)
        self.cancel_button = QtGui.QPushButton(translate("AADM", "Cancel"), enabled=False)
        self.cancel_button.clicked.connect(self.cancel)
        self.progress = QtGui.QProgressBar(maximum=0, visible=False)
        self.step = QtGui.QLabel(wordWrap=True)

    def add_start(self, text: str) -> None:
        """Put the buttons and the bar here."""
        self.start_button.setText(text)
        buttons = QtGui.QHBoxLayout()
        buttons.addWidget(self.start_button, 1)
        buttons.addWidget(self.cancel_button)
        self.layout.addLayout(buttons)
        self.layout.addWidget(self.progress)
        self.layout.addWidget(self.step)

    def start(self) -> None:
        """What the button does."""

    def have_done(
        self, work: Work, take: Callable[[Any], None], failed: Callable[[AadmError], None] | None = None
    ) -> None:
        """Have work done beside the window, then ``take`` its answer; what goes wrong is shown, unless ``failed`` is.

        Raises
        ------
        NoEnvironmentError
            Where nothing can do it.
        """
        running = PrivateWork(work)
        running.stepped.connect(lambda *step: self in _OPEN and self.stepped(*step))
        running.said.connect(lambda line: self in _OPEN and self.said(line))
        running.done.connect(lambda answer: self._over(lambda: take(answer)))
        running.failed.connect(lambda error: self._over(lambda: (failed or self.show_error)(error)))
        running.cancelled.connect(lambda: self._over(self.was_cancelled))
        self.work = running
        self._busy(True)
        running.begin()

    def stepped(self, done: int, total: int, what: str) -> None:
        """A step of the work is done."""
        self.progress.setMaximum(total)
        self.progress.setValue(done)

    def said(self, line: str) -> None:
        """The work says something."""

    def show_error(self, error: BaseException) -> None:
        """Show what went wrong."""
        show_error(self.title, error)

    def was_cancelled(self) -> None:
        """The work has ended because somebody asked for that."""
        self.step.setText(translate("AADM", "cancelled"))

    def cancel(self) -> None:
        """Ask for an end."""
        if self.work is not None:
            self.step.setText(translate("AADM", "cancelling…"))
            self.work.cancel()

    def closing(self) -> None:
        """Work that is not done is ended."""
        self.cancel()

    def _over(self, then: Callable[[], None]) -> None:
        self.work = None
        if self not in _OPEN or not is_there(self.owner):
            return  # closed, or its document is: nobody waits for the answer
        with sentences(self.title):
            self._busy(False)
            then()

    def _busy(self, busy: bool) -> None:
        self.start_button.setEnabled(not busy)
        self.cancel_button.setEnabled(busy)
        self.progress.setMaximum(0)
        self.progress.setVisible(busy)
        self.step.setText("")


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
    _OPEN.clear()  # what FreeCAD has closed by itself
    for rows in panel.form.findChildren(QtGui.QFormLayout):
        rows.setRowWrapPolicy(QtGui.QFormLayout.WrapLongRows)
    for chooser in panel.form.findChildren(QtGui.QComboBox):
        # The task view is narrow: a long text must not widen the panel beyond it.
        chooser.setSizeAdjustPolicy(QtGui.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        chooser.setMinimumContentsLength(6)
    _OPEN.append(panel)
    FreeCADGui.Control.showDialog(panel)


def close_panel(panel: TaskPanel) -> None:
    """Close a panel, if it is open; it is forgotten whatever happens."""
    was_open = panel in _OPEN
    if was_open:
        _OPEN.remove(panel)
    try:
        panel.closing()
    finally:
        if was_open:
            FreeCADGui.Control.closeDialog()


def close_orphans() -> None:
    """Close the panel whose document or object is gone."""
    for panel in [one for one in _OPEN if not is_there(one.owner)]:
        with sentences(panel.title):
            close_panel(panel)


def is_there(owner: Any) -> bool:
    """Whether a document or an object of one still exists; None, which belongs to nobody, does."""
    if owner is None:
        return True
    try:
        document = owner.Document if hasattr(owner, "Document") else owner
        return document is not None and document.Name in FreeCAD.listDocuments()
    except (ReferenceError, RuntimeError):
        return False


def open_panel_of(kind: type) -> Any:
    """The panel of a kind that is open; None without one."""
    return next((panel for panel in _OPEN if isinstance(panel, kind)), None)


def number_of(flag: Any) -> int:
    """A flag of Qt as a number, in PySide2 and in PySide6."""
    return int(getattr(flag, "value", flag))
