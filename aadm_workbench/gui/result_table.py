"""The table of a result: every number that was compared with a limit, to sort, to filter, to click."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

from aadm_workbench.document.display.colours import of_verdict, text_on
from aadm_workbench.document.display.result_rows import (
    ABSOLUTE,
    DISTANCE,
    POSITION,
    SPACING,
    Row,
    only_what_fails,
    result_rows,
)
from aadm_workbench.document.words import in_words, length_text
from aadm_workbench.gui.language import in_language
from aadm_workbench.gui.resources import icon

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
_BY = QtCore.Qt.UserRole
_ROW = QtCore.Qt.UserRole + 1  # a role of our own: the place of the row that an item shows


_WHAT = {
    POSITION: QT_TRANSLATE_NOOP("AADM_Rows", "position"),
    SPACING: QT_TRANSLATE_NOOP("AADM_Rows", "spacing"),
    ABSOLUTE: QT_TRANSLATE_NOOP("AADM_Rows", "position in the building"),
    DISTANCE: QT_TRANSLATE_NOOP("AADM_Rows", "distance in the trial"),
}


class ResultTable(QtGui.QTableWidget):
    """Rows of a result, the worst first; ``chosen`` is sent with the row that was clicked."""

    chosen = QtCore.Signal(object)

    def __init__(self) -> None:
        super().__init__(0, 7)
        self.setObjectName("AADM_ResultTable")
        self.setHorizontalHeaderLabels(
            [
                "",
                translate("AADM_Table", "Point"),
                translate("AADM_Table", "Deviation"),
                translate("AADM_Table", "Limit"),
                "± u",
                translate("AADM_Table", "What"),
                translate("AADM_Table", "Clause"),
            ]
        )
        self.verticalHeader().hide()
        self.setEditTriggers(QtGui.QAbstractItemView.NoEditTriggers)
        self.setSelectionBehavior(QtGui.QAbstractItemView.SelectRows)
        self.setSelectionMode(QtGui.QAbstractItemView.SingleSelection)
        self.itemSelectionChanged.connect(self._tell)
        self.rows: Sequence[Row] = ()

    def show_rows(self, found: Mapping[str, Any], trial: str, *, only_failing: bool) -> None:
        """Fill it from a column's entry in report.json."""
        rows = result_rows(found, trial)
        self.rows = only_what_fails(rows) if only_failing else rows
        self.blockSignals(True)
        self.setSortingEnabled(False)
        self.setRowCount(len(self.rows))
        for place, row in enumerate(self.rows):
            self._fill(place, row)
        self.sortItems(0, QtCore.Qt.AscendingOrder)
        self.horizontalHeader().setSortIndicator(0, QtCore.Qt.AscendingOrder)
        self.setSortingEnabled(True)
        self.resizeColumnsToContents()
        self.clearSelection()
        self.blockSignals(False)

    def _fill(self, place: int, row: Row) -> None:
        what = translate("AADM_Rows", _WHAT[row.what])
        value = length_text(row.value_mm, signed=row.signed) if row.value_mm is not None else in_words(row.verdict)
        cells = (
            ("", place),
            (row.name, _natural(row.name)),
            (value, -1.0 if row.value_mm is None else abs(row.value_mm)),
            (length_text(row.limit_mm), row.limit_mm or 0.0),
            (length_text(row.u_mm), row.u_mm or 0.0),
            (what, what),
            (row.clause, row.clause),
        )
        said = in_language(row.reason) if row.reason else f"{row.name}: {in_words(row.verdict)}"
        for column, (text, key) in enumerate(cells):
            item = _Cell(text)
            item.setData(_BY, key)
            item.setToolTip(said)
            if column in (2, 3, 4):
                item.setTextAlignment(QtCore.Qt.AlignRight | QtCore.Qt.AlignVCenter)
            self.setItem(place, column, item)
        first = self.item(place, 0)
        first.setIcon(icon(f"verdict-{row.verdict}"))
        first.setData(_ROW, place)
        if row.verdict not in {"pass", "not_assessed"}:
            colour, value = of_verdict(row.verdict), self.item(place, 2)
            font = value.font()
            font.setBold(True)
            value.setFont(font)
            value.setBackground(QtGui.QColor.fromRgbF(*colour))
            value.setForeground(QtGui.QColor.fromRgbF(*text_on(colour)))

    def _tell(self) -> None:
        places = {index.row() for index in self.selectedIndexes()}
        if len(places) == 1:
            self.chosen.emit(self.rows[self.item(places.pop(), 0).data(_ROW)])


class _Cell(QtGui.QTableWidgetItem):
    """Sorts by its number, not by the text of it."""

    def __lt__(self, other: Any) -> bool:
        return self.data(_BY) < other.data(_BY)


def _natural(name: str) -> str:
    """S2 before S10."""
    return re.sub(r"\d+", lambda number: number[0].zfill(4), name)
