"""A line that holds a file or a folder, with a button that chooses one."""

from __future__ import annotations

from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

translate = FreeCAD.Qt.translate


class FileLine(QtGui.QWidget):
    """``patterns`` such as ``*.ply *.pcd``; an empty text means a folder. ``save``: the file need not be there."""

    changed = QtCore.Signal(str)

    def __init__(self, title: str, patterns: str, value: str = "", *, save: bool = False) -> None:
        super().__init__()
        self._title, self._patterns, self._save = title, patterns, save
        self.line = QtGui.QLineEdit(value)
        button = QtGui.QToolButton(text="…")
        button.setToolTip(translate("AADM", "Choose"))
        button.clicked.connect(self._choose)
        layout = QtGui.QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.line, 1)
        layout.addWidget(button)
        self.line.editingFinished.connect(lambda: self.changed.emit(self.text()))

    def text(self) -> str:
        """The path."""
        return self.line.text().strip()

    def set_text(self, value: str) -> None:
        """Put a path in."""
        self.line.setText(value)
        self.changed.emit(value)

    def _choose(self) -> None:
        dialog: Any = QtGui.QFileDialog
        if not self._patterns:
            chosen = dialog.getExistingDirectory(self, self._title, self.text())
        else:
            ask = dialog.getSaveFileName if self._save else dialog.getOpenFileName
            chosen, _ = ask(self, self._title, self.text(), f"{self._title} ({self._patterns})")
        if chosen:
            self.set_text(chosen)
