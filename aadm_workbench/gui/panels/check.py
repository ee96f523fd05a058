"""The panel of a check: how it is done, then what it found, the worst first."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import FreeCAD
import numpy as np
from PySide import QtCore, QtGui

from aadm_workbench.document.checking import check_work, keep, lay_scans
from aadm_workbench.document.column import DECISIONS, METHODS
from aadm_workbench.document.display.colours import of_verdict, text_on
from aadm_workbench.document.display.marks import pitch_of
from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.display.result_rows import DISTANCE, Row
from aadm_workbench.document.display.setting import setting_said
from aadm_workbench.document.places import world_point
from aadm_workbench.document.result import found_of
from aadm_workbench.document.scan_cloud import fill_scan
from aadm_workbench.document.scan_reading import asked_again
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.document.words import in_words
from aadm_workbench.gui.chosen import look_at
from aadm_workbench.gui.language import in_language
from aadm_workbench.gui.panels.task_panel import WorkingPanel, is_there, show_panel
from aadm_workbench.gui.result_table import ResultTable
from aadm_workbench.gui.sentences import sentences
from aadm_workbench.gui.settings import camera_profile, most_points
from aadm_workbench.gui.view_camera import active_view, zoom_to
from aadm_workbench.private.answers import ReadScan

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

_VIEWS = (
    ("position", QT_TRANSLATE_NOOP("AADM_Check", "Against the design")),
    ("minimax", QT_TRANSLATE_NOOP("AADM_Check", "Trial assembly, best position (minimax)")),
    ("least_squares", QT_TRANSLATE_NOOP("AADM_Check", "Trial assembly, least squares")),
)
_SHOWN_REASONS = 3  # the panel is a hand wide; the table has all


class CheckPanel(WorkingPanel):
    """Settings on top, result below; the check runs beside the window."""

    ICON = "check-column"

    def __init__(self, column: Any) -> None:
        super().__init__(translate("AADM_Check", "Check {column}").format(column=column.ColumnId), column)
        self.column = column
        self._add_settings()
        self._add_result()
        self.refresh()

    def _add_settings(self) -> None:
        self.method, self.tolerances, self.decision = QtGui.QComboBox(), QtGui.QComboBox(), QtGui.QComboBox()
        self.method.addItems(METHODS)
        self.method.setCurrentText(self.column.Method)
        self.tolerances.setEditable(True)
        self.tolerances.addItems(_profiles())
        self.tolerances.setCurrentText(self.column.Tolerances)
        self.decision.addItems(DECISIONS)
        self.decision.setCurrentText(self.column.Decision)
        self.scans = QtGui.QLabel(wordWrap=True)
        form = QtGui.QFormLayout()
        form.addRow(translate("AADM_Check", "Scans"), self.scans)
        form.addRow(translate("AADM_Check", "Method"), self.method)
        form.addRow(translate("AADM_Check", "Tolerances"), self.tolerances)
        form.addRow(translate("AADM_Check", "Decision"), self.decision)
        if profile := camera_profile():
            form.addRow(translate("AADM_Check", "Camera profile"), QtGui.QLabel(Path(profile).name, toolTip=profile))
        self.layout.addLayout(form)
        self.show_scans = QtGui.QPushButton(translate("AADM_Check", "Show its scans"))
        self.show_scans.setToolTip(translate("AADM_Check", "Reads the points of its scans into the view"))
        self.show_scans.clicked.connect(lambda checked=False: self.read_scans())
        self.layout.addWidget(self.show_scans)
        self.add_start(translate("AADM_Check", "Check"))

    def _add_result(self) -> None:
        self.verdict = QtGui.QLabel(wordWrap=True)
        self.reasons = QtGui.QLabel(wordWrap=True)
        self.reasons.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        self.shows = QtGui.QComboBox()
        for name, text in _VIEWS:
            self.shows.addItem(translate("AADM_Check", text), name)
        self.shows.currentIndexChanged.connect(self._shows_changed)
        self.only_failing = QtGui.QCheckBox(translate("AADM_Check", "Only what fails"))
        self.only_failing.toggled.connect(self._fill_table)
        self.table = ResultTable()
        self.table.chosen.connect(self.go_to)
        for part in (self.verdict, self.reasons, self.shows, self.only_failing):
            self.layout.addWidget(part)
        self.layout.addWidget(self.table, 1)

    def start(self) -> None:
        """Check the column, beside the window."""
        with sentences(self.title):
            with undo_step(self.column.Document, translate("AADM_Check", "Settings of the check")):
                self.column.Method = self.method.currentText()
                self.column.Tolerances = self.tolerances.currentText().strip()
                self.column.Decision = self.decision.currentText()
            self.have_done(check_work(self.column, camera_profile()), self._take)

    def _take(self, report: Mapping[str, Any]) -> None:
        with undo_step(self.column.Document, translate("AADM_Check", "Check column")):
            result = keep(self.column, report)
        tell(f"{self.column.ColumnId}: {in_words(result.Verdict)}")
        self.refresh()
        look_at([result])

    def read_scans(self) -> None:
        """Read the points of scans that nobody has looked into yet, one after the other."""
        with sentences(self.title):
            cloud = next((one for one in self.column.Scans if not one.PointCount), None)
            if cloud is not None:
                work = asked_again(cloud, most_points()).work()
                self.have_done(work, lambda read: self._take_points(cloud, read))

    def _take_points(self, cloud: Any, read: ReadScan) -> None:
        with undo_step(self.column.Document, translate("AADM_Check", "Show its scans")):
            fill_scan(cloud, self.column, read)
            if self.column.Result is not None:
                lay_scans(self.column, found_of(self.column.Result))
        self.refresh()
        self.read_scans()

    def closing(self) -> None:
        """A check that still runs is ended, and no point stays picked."""
        super().closing()
        if is_there(self.column) and self.column.Result is not None:
            self.column.Result.ViewObject.Proxy.pick(None)

    def refresh(self) -> None:
        """Show what the column holds now."""
        scans = [f"{cloud.Kind}: {Path(cloud.File).name}" for cloud in self.column.Scans]
        self.scans.setText("\n".join(scans) or translate("AADM_Check", "none yet: Import scan"))
        self.show_scans.setVisible(any(not cloud.PointCount for cloud in self.column.Scans))
        result = self.column.Result
        for part in (self.shows, self.only_failing, self.table):
            part.setVisible(result is not None)
        if result is None:
            self.verdict.setText(translate("AADM_Check", "Not checked yet"))
            self.verdict.setStyleSheet("")
            self.reasons.setText("")
            return
        said = translate("AADM_Check", "{verdict} · goes on: {goes_on}").format(
            verdict=in_words(result.Verdict).upper(), goes_on=in_words(result.GoesOn)
        )
        self.verdict.setText(said)
        self.verdict.setStyleSheet(_chip(result.Verdict))
        found = found_of(result)
        advice = (found.get("repair") or {}).get("advice")
        notes = [f"→ {in_language(advice)}"] if advice else []
        lines = [f"• {in_language(reason)}" for reason in result.Reasons[:_SHOWN_REASONS]]
        more = len(result.Reasons) - _SHOWN_REASONS
        if more > 0:
            lines.append(translate("AADM_Check", "… and {count} more, see the table").format(count=more))
        lines += [*notes, *setting_said(found.get("setting")).lines]
        self.reasons.setText("\n".join(lines))
        self._say_what_is_shown()
        self._fill_table()

    def _say_what_is_shown(self) -> None:
        self.shows.blockSignals(True)
        self.shows.setCurrentIndex(self.shows.findData(self.column.Result.ViewObject.Shows))
        self.shows.blockSignals(False)

    def _shows_changed(self, index: int) -> None:
        if self.column.Result is not None:
            self.column.Result.ViewObject.Shows = self.shows.currentData()
            self._fill_table()

    def _fill_table(self, *_: Any) -> None:
        if self.column.Result is not None:
            trial = "least_squares" if self.shows.currentData() == "least_squares" else "minimax"
            only_failing = self.only_failing.isChecked()
            self.table.show_rows(found_of(self.column.Result), trial, only_failing=only_failing)

    def go_to(self, row: Row) -> None:
        """Show a row's point in the 3-D view."""
        result, view = self.column.Result, active_view()
        if result is None or row.place_mm is None:
            return
        trial = "least_squares" if self.shows.currentData() == "least_squares" else "minimax"
        result.ViewObject.Shows = trial if row.what == DISTANCE else "position"
        self._say_what_is_shown()
        result.ViewObject.Proxy.pick(row.place_mm)
        if view is not None:
            zoom_to(view, np.asarray(world_point(result, row.place_mm)), 3.0 * pitch_of(found_of(result)))


def open_panel(column: Any) -> CheckPanel:
    """Show the check of a column."""
    panel = CheckPanel(column)
    show_panel(panel)
    return panel


def _chip(verdict: str) -> str:
    """A style that stands out on light and on dark alike: the verdict's colour lies behind the text."""
    behind, text = (QtGui.QColor.fromRgbF(*rgb).name() for rgb in (of_verdict(verdict), text_on(of_verdict(verdict))))
    return f"background: {behind}; color: {text}; font-weight: bold; padding: 4px; border-radius: 3px"


def _profiles() -> tuple[str, ...]:
    from aadm_workbench.assembly.tolerances import profile_names

    return profile_names()
