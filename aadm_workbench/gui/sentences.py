"""Whatever goes wrong behind a command becomes a sentence on the screen, never a stack of frames."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench.document.display.messages import complain
from aadm_workbench.errors import AadmError, NoEnvironmentError
from aadm_workbench.gui.language import in_language

translate = FreeCAD.Qt.translate
WINDOW_NAME = "AADM_Sentence"
Offer = tuple[str, Callable[[], object]]
WAYS_ON: dict[type[AadmError], Callable[[], tuple[Offer, ...]]] = {}
"""What is offered about errors of a kind, where who shows one offers nothing; panels say what they lead out of."""


@contextmanager
def sentences(title: str) -> Iterator[None]:
    """Around what a command does: errors are shown, and the window goes on."""
    try:
        yield
    except Exception as error:  # noqa: BLE001 - the boundary between the product and FreeCAD's window
        show_error(title, error)


def show_error(title: str, error: BaseException, *offers: Offer) -> None:
    """Say what went wrong in a window that does not block, and in the report view.

    ``offers``: buttons with what they do about it.
    """
    complain(sentence_of(error))
    box = QtGui.QMessageBox(FreeCADGui.getMainWindow())
    box.setObjectName(WINDOW_NAME)
    box.setAttribute(QtCore.Qt.WA_DeleteOnClose)
    box.setIcon(QtGui.QMessageBox.Warning)
    box.setWindowTitle(title)
    box.setText(sentence_of(error))
    box.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
    if isinstance(error, NoEnvironmentError):
        from aadm_workbench.gui.panels.environment import install

        offers = ((translate("AADM", "Install now"), install), *offers)
    for kind, ways in WAYS_ON.items():
        if isinstance(error, kind) and not offers:
            offers = ways()
    for text, act in offers:
        button = box.addButton(text, QtGui.QMessageBox.ActionRole)
        button.clicked.connect(lambda checked=False, act=act: act())
    if offers:
        box.addButton(QtGui.QMessageBox.Close)
    box.open()


def sentence_of(error: BaseException) -> str:
    """An error as people read it; where an unforeseen one came from goes to FreeCAD's log."""
    if isinstance(error, AadmError):
        return in_language(error.reason)
    FreeCAD.Console.PrintLog("".join(traceback.format_exception(error)))
    if isinstance(error, MemoryError):
        return translate("AADM", "There is not enough memory for this scan: crop it to the component, or close others.")
    if isinstance(error, OSError):
        return str(error)
    return translate(
        "AADM", "This should not happen ({kind}: {reason}). The log of the report view shows where."
    ).format(kind=type(error).__name__, reason=error)
