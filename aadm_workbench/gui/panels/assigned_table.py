"""The table of columns and their scans: each can be switched off, given other files, turned."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

from aadm_workbench.document.job.floor import Assigned
from aadm_workbench.document.words import in_words
from aadm_workbench.gui.resources import icon
from aadm_workbench.scan.file import CLOUDS, DEPTH_MAPS, TABLES

translate = FreeCAD.Qt.translate
_COLUMN, _SLEEVES, _REBARS, _UP = range(4)  # places in the table, from left to right
_FILES = QtCore.Qt.UserRole
_MOST_OF_A_NAME = 24
"""Letters of mean width: a mark of ten with its box, its icon and the longest verdict behind it."""

_FORMATS = " ".join(f"*{suffix}" for suffix in (*DEPTH_MAPS, *CLOUDS, *TABLES))


@dataclass(frozen=True)
class Row(Assigned):
    """What a row says: whether the column is to be checked, too."""

    wanted: bool = True


class AssignedTable(QtGui.QTableWidget):
    """One row a column: a box with its id and verdict, its files, which side is up.

    Signals: ``chosen`` with the number of a row that was clicked, ``opened`` with that of one whose id was
    double-clicked. A double click on files chooses others, on ``Up`` edits it.
    """

    chosen = QtCore.Signal(int)
    opened = QtCore.Signal(int)

    def __init__(self, ids: Sequence[str]) -> None:
        super().__init__(len(ids), 4)
        self.setObjectName("AADM_AssignedTable")
        self.setHorizontalHeaderLabels(
            [
                translate("AADM_CheckAll", "Column"),
                translate("AADM_CheckAll", "Sleeves"),
                translate("AADM_CheckAll", "Rebars"),
                translate("AADM_CheckAll", "Up"),
            ]
        )
        self.verticalHeader().hide()
        self.setSelectionBehavior(QtGui.QAbstractItemView.SelectRows)
        self.setSelectionMode(QtGui.QAbstractItemView.SingleSelection)
        self.setEditTriggers(QtGui.QAbstractItemView.DoubleClicked | QtGui.QAbstractItemView.EditKeyPressed)
        for place, name in enumerate(ids):
            for column in range(4):
                item = QtGui.QTableWidgetItem(name if column == _COLUMN else "")
                if column != _UP:
                    item.setFlags(item.flags() & ~QtCore.Qt.ItemIsEditable)
                self.setItem(place, column, item)
            self.item(place, _COLUMN).setFlags(self.item(place, _COLUMN).flags() | QtCore.Qt.ItemIsUserCheckable)
            self.item(place, _COLUMN).setCheckState(QtCore.Qt.Checked)
            self.item(place, _COLUMN).setToolTip(name)
        self.setWordWrap(False)
        self.setTextElideMode(QtCore.Qt.ElideMiddle)
        self._ids = list(ids)
        self.itemSelectionChanged.connect(self._tell)
        self.cellDoubleClicked.connect(self._double_clicked)

    def show_rows(self, rows: Sequence[Assigned]) -> None:
        """Show what belongs to each column."""
        for place, row in enumerate(rows):
            self._put_files(place, _SLEEVES, row.sleeves)
            self._put_files(place, _REBARS, row.rebars)
            self.item(place, _UP).setText(row.up)
        self._fit()

    def rows(self) -> list[Row]:
        """What stands in the table now."""
        return [
            Row(
                tuple(self.item(place, _SLEEVES).data(_FILES) or ()),
                tuple(self.item(place, _REBARS).data(_FILES) or ()),
                self.item(place, _UP).text().strip(),
                self.item(place, _COLUMN).checkState() == QtCore.Qt.Checked,
            )
            for place in range(self.rowCount())
        ]

    def switch_on(self, wanted: Sequence[bool]) -> None:
        """Switch rows on or off."""
        for place, one in enumerate(wanted):
            self.item(place, _COLUMN).setCheckState(QtCore.Qt.Checked if one else QtCore.Qt.Unchecked)

    def set_all_up(self, up: str) -> None:
        """Give all rows the same side."""
        for place in range(self.rowCount()):
            self.item(place, _UP).setText(up)

    def show_verdicts(self, verdicts: Sequence[str]) -> None:
        """Show what the last check found, by icon and word."""
        for place, verdict in enumerate(verdicts):
            item = self.item(place, _COLUMN)
            item.setText(f"{self._ids[place]}  {in_words(verdict)}" if verdict else self._ids[place])
            item.setIcon(icon(f"verdict-{verdict}") if verdict else QtGui.QIcon())
            font = item.font()
            font.setBold(verdict not in {"", "pass"})
            item.setFont(font)
        self._fit()

    def _fit(self) -> None:
        """As wide as what stands in it; long names of columns give way in their middle, so that scans are seen."""
        self.resizeColumnsToContents()
        widest = _MOST_OF_A_NAME * self.fontMetrics().averageCharWidth()
        self.setColumnWidth(_COLUMN, min(self.columnWidth(_COLUMN), widest))

    def _put_files(self, place: int, column: int, files: Sequence[Path]) -> None:
        item = self.item(place, column)
        item.setData(_FILES, list(files))
        item.setText(", ".join(file.name for file in files) or "–")
        item.setToolTip("\n".join(map(str, files)) or translate("AADM_CheckAll", "Double-click to choose its scan"))

    def _tell(self) -> None:
        places = {index.row() for index in self.selectedIndexes()}
        if len(places) == 1:
            self.chosen.emit(places.pop())

    def _double_clicked(self, place: int, column: int) -> None:
        if column == _COLUMN:
            self.opened.emit(place)
        elif column in {_SLEEVES, _REBARS}:
            self._choose(place, column)

    def _choose(self, place: int, column: int) -> None:
        title = translate("AADM_CheckAll", "Scans of {column}").format(column=self._ids[place])
        known: Any = self.item(place, column).data(_FILES)
        begin = str(known[0].parent) if known else ""
        chosen, _ = QtGui.QFileDialog.getOpenFileNames(self, title, begin, f"{title} ({_FORMATS})")
        if chosen:
            self._put_files(place, column, [Path(one) for one in chosen])
            self._fit()
