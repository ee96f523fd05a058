"""A line that holds a file or a folder, with a button that chooses one."""

from __future__ import annotations

from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

translate = FreeCAD.Qt.translate
_FOLDER = QtGui.QStyle.SP_DirOpenIcon


class FileLine(QtGui.QWidget):
    """``patterns`` such as ``*.ply *.pcd``; an empty text means a folder.

    ``save``: the file need not be there. ``folder``: a folder may be chosen instead, with a button of its own.
    """

    changed = QtCore.Signal(str)

    def __init__(self, title: str, patterns: str, value: str = "", *, save: bool = False, folder: bool = False) -> None:
        super().__init__()
        self._title, self._patterns, self._save = title, patterns, save
        self.line = QtGui.QLineEdit(value)
        style = self.style()
        button = QtGui.QToolButton(icon=style.standardIcon(QtGui.QStyle.SP_FileIcon if patterns else _FOLDER))
        button.setToolTip(translate("AADM", "Choose"))
        button.clicked.connect(self._choose)
        layout = QtGui.QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.line, 1)
        layout.addWidget(button)
        if folder:
            another = QtGui.QToolButton(icon=style.standardIcon(_FOLDER))
            another.setToolTip(translate("AADM", "Choose a folder: a capture as the camera saves it"))
            another.clicked.connect(self._choose_folder)
            layout.addWidget(another)
        self.line.editingFinished.connect(lambda: self.changed.emit(self.text()))

    def text(self) -> str:
        """The path."""
        return self.line.text().strip()

    def set_text(self, value: str) -> None:
        """Put a path in."""
        self.line.setText(value)
        self.changed.emit(value)

    def _choose(self) -> None:
        if not self._patterns:
            self._choose_folder()
            return
        dialog: Any = QtGui.QFileDialog
        ask = dialog.getSaveFileName if self._save else dialog.getOpenFileName
        chosen, _ = ask(self, self._title, self.text(), f"{self._title} ({self._patterns})")
        if chosen:
            self.set_text(chosen)

    def _choose_folder(self) -> None:
        chosen = QtGui.QFileDialog.getExistingDirectory(self, self._title, self.text())
        if chosen:
            self.set_text(chosen)
