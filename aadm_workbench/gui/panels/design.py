"""The panel of a column's design: which sleeves and bars were found and why, which belong together, ``up``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

from aadm_workbench.design.directions import up_deg
from aadm_workbench.document.column import column_design, set_design
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.document.words import length_text
from aadm_workbench.errors import DesignError
from aadm_workbench.gui.language import in_language
from aadm_workbench.gui.panels.task_panel import TaskPanel, show_panel
from aadm_workbench.gui.sentences import sentences
from aadm_workbench.model import UP_DEG, AssemblyPoint

translate = FreeCAD.Qt.translate
REBAR_PLACE = 1
"""Place in the table of what can be changed there: at FreeCAD's own width of the panel it is still seen."""


class DesignPanel(TaskPanel):
    """Sleeves in rows, each with its bar."""

    ICON = "sample-design"

    def __init__(self, column: Any) -> None:
        super().__init__(translate("AADM_Design", "Design of {column}").format(column=column.ColumnId), column)
        self.column = column
        self.design = column_design(column)
        self.headline = QtGui.QLabel()
        self.headline.setWordWrap(True)
        self.table = QtGui.QTableWidget(len(self.design.sleeves), 5)
        self.sleeves_up, self.rebars_up = _up_chooser(column.SleevesUp), _up_chooser(column.RebarsUp)
        form = QtGui.QFormLayout()
        form.addRow(translate("AADM_Design", "Up in pictures of sleeves"), self.sleeves_up)
        form.addRow(translate("AADM_Design", "Up in pictures of rebars"), self.rebars_up)
        self.apply_button = QtGui.QPushButton(translate("AADM_Design", "Apply"))
        self.apply_button.setToolTip(translate("AADM_Design", "Keeps pairing and directions, in one undo step"))
        self.apply_button.clicked.connect(self.apply)
        for part in (self.headline, self.table):
            self.layout.addWidget(part)
        self.layout.addLayout(form)
        self.layout.addWidget(self.apply_button)
        self._fill()

    def _fill(self) -> None:
        said = translate("AADM_Design", "{sleeves} sleeves, {rebars} rebars. Column frame: z up along the column.")
        lines = [said.format(sleeves=len(self.design.sleeves), rebars=len(self.design.rebars)), *self.design.warnings]
        self.headline.setText("\n".join(lines))
        self.table.setHorizontalHeaderLabels(
            [
                translate("AADM_Design", "Sleeve"),
                translate("AADM_Design", "Its rebar"),
                translate("AADM_Design", "Diameter"),
                "x, y",
                translate("AADM_Design", "Why"),
            ]
        )
        self.table.verticalHeader().hide()
        self.table.setSelectionBehavior(QtGui.QAbstractItemView.SelectRows)
        for row, sleeve in enumerate(self.design.sleeves):
            x, y = (length_text(float(value)) for value in sleeve.centre[:2])
            texts = (sleeve.label, "", length_text(sleeve.diameter_mm), f"{x}, {y}", self._why(row))
            for place, text in enumerate(texts):
                item = QtGui.QTableWidgetItem(text)
                item.setFlags(item.flags() & ~QtCore.Qt.ItemIsEditable)
                item.setToolTip(text)
                self.table.setItem(row, place, item)
            self.table.setCellWidget(row, REBAR_PLACE, self._rebar_chooser(row))
        self.table.resizeColumnsToContents()
        self.table.horizontalHeader().setStretchLastSection(True)

    def _why(self, row: int) -> str:
        bar = self.design.rebars[row].why if row < len(self.design.rebars) else translate("AADM_Design", "no rebar")
        return f"{in_language(self.design.sleeves[row].why)} / {in_language(bar)}"

    def _rebar_chooser(self, row: int) -> Any:
        chooser = QtGui.QComboBox()
        for rebar in self.design.rebars:
            chooser.addItem(f"{rebar.label}  ({length_text(rebar.diameter_mm)})")
        chooser.setCurrentIndex(row if row < len(self.design.rebars) else -1)
        chooser.activated.connect(lambda chosen, row=row: self.swap(row, int(chosen)))
        return chooser

    def chosen_rebars(self) -> list[int]:
        """Number of the rebar that each sleeve has now."""
        return [self.table.cellWidget(row, REBAR_PLACE).currentIndex() for row in range(self.table.rowCount())]

    def swap(self, row: int, chosen: int) -> None:
        """A sleeve takes a rebar; the sleeve that had it takes the one that becomes free."""
        taken = self.chosen_rebars()
        free = next((rebar for rebar in range(len(self.design.rebars)) if rebar not in taken), None)
        other = next((one for one, rebar in enumerate(taken) if rebar == chosen and one != row), None)
        if other is not None and free is not None:
            self.table.cellWidget(other, REBAR_PLACE).setCurrentIndex(free)

    def apply(self) -> None:
        """Keep what was chosen, in one undo step."""
        with sentences(self.title):
            ups = [self.sleeves_up.currentText().strip(), self.rebars_up.currentText().strip()]
            for written in ups:
                up_deg(written, self.column.Label)
            design = replace(self.design, rebars=_paired(self.design.rebars, self.chosen_rebars()))
            with undo_step(self.column.Document, translate("AADM_Design", "Change design")):
                self.column.SleevesUp, self.column.RebarsUp = ups
                if design.rebars != self.design.rebars:
                    set_design(self.column, design)
            self.design = design
            self._fill()


def open_panel(column: Any) -> DesignPanel:
    """Show the design of a column."""
    panel = DesignPanel(column)
    show_panel(panel)
    return panel


def _up_chooser(written: str) -> Any:
    chooser = QtGui.QComboBox()
    chooser.setEditable(True)
    chooser.addItems(["", *UP_DEG])
    chooser.setCurrentText(written)
    tooltip = translate(
        "AADM_Design", "Side of the column at the top of the picture: +x, -x, +y, -y, or degrees from +x"
    )
    chooser.setToolTip(tooltip)
    return chooser


def _paired(rebars: tuple[AssemblyPoint, ...], chosen: list[int]) -> tuple[AssemblyPoint, ...]:
    """The rebars in the order of the sleeves that they belong to, labelled as those are."""
    if not rebars:
        return rebars
    if sorted(chosen) != list(range(len(rebars))):
        raise DesignError(translate("AADM_Design", "Two sleeves have the same rebar: give each its own."))
    if chosen == list(range(len(rebars))):
        return rebars
    return tuple(replace(rebars[number], label=f"R{place}") for place, number in enumerate(chosen, start=1))
