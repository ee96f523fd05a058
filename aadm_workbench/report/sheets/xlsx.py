"""report.xlsx: a sheet for each question, with numbers that are numbers, for the yard to sort and filter.

Names and reasons are written as texts, never as formulas, whatever they begin with.
"""

from __future__ import annotations

import io
from datetime import datetime
from importlib import import_module
from pathlib import Path
from typing import Any

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.model import JobReport
from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.sheets.sheets import job_tables
from aadm_workbench.report.sheets.tables import Cell, CellKind, Table
from aadm_workbench.report.tower import TowerShown, tower_tables
from aadm_workbench.report.words.labels import HEAD, SIGN, Language, phrase, rule_words, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages

_FORMATS: dict[CellKind, str] = {
    "mm": "0.00",
    "mm_signed": "+0.00;-0.00;0.00",
    "mm_fine": "0.000",
    "deg": "0.00",
    "share": "0.0%",
    "ratio": "0.00",
    "count": "0",
}
_FILLS = {
    "pass": ("#d7f0e3", "#00543d"),
    "fail": ("#fbd9c8", "#8a2900"),
    "inconclusive": ("#fdeec4", "#6b4800"),
    "not_measured": ("#e3e6ea", "#3d444d"),
    "error": ("#f3d9e9", "#7a1f5c"),
    "not_assessed": ("#f2f3f5", "#5b6470"),
}
# A fixed date, so that the same report gives the same bytes.
_CREATED = datetime(2020, 1, 1)  # noqa: DTZ001 - the format holds no zone
_WIDEST, _NARROWEST = 60, 9  # characters: a sentence that is broken, a number with its unit
_FORBIDDEN_IN_SHEET_NAMES = str.maketrans(dict.fromkeys("[]:*?/\\", " "))
_LONGEST_CELL = 32_767  # characters of a cell, Excel's own bound


def write_xlsx(report: JobReport, path: Path, language: Language = "en", *, tower: TowerShown | None = None) -> None:
    """Write report.xlsx, whole or not at all; with two sheets more where the job asks for the ``tower``.

    Raises
    ------
    MissingDependencyError
        Without the package xlsxwriter.
    AadmError
        Where the file cannot be written.
    """
    try:
        xlsxwriter: Any = import_module("xlsxwriter")
    except ImportError as error:
        raise MissingDependencyError("xlsxwriter", "report.xlsx") from error
    content = io.BytesIO()
    # Row by row, through a temporary file: the workbook of a thousand columns has a million cells.
    options = {
        "constant_memory": True,
        "strings_to_formulas": False,
        "strings_to_urls": False,
        "nan_inf_to_errors": False,
    }
    book = xlsxwriter.Workbook(content, options)
    title = phrase("ui.title").in_language(language)
    book.set_properties({"title": f"{title}: {report.job['name']}", "created": _CREATED})
    sheets = _Sheets(book, language)
    for table in (*job_tables(report, language), *(tower_tables(tower, language) if tower else ())):
        sheets.add(table)
    sheets.add_about(report)
    book.close()
    write_atomically(path, content.getvalue())


class _Sheets:
    """Writes tables into one workbook; formats are made once."""

    def __init__(self, book: Any, language: Language) -> None:
        self.book = book
        self.language = language
        self.plain = {kind: book.add_format({"num_format": text, "valign": "top"}) for kind, text in _FORMATS.items()}
        self.text = book.add_format({"valign": "top", "text_wrap": True})
        self.label = book.add_format({"valign": "top", "bold": True})
        self.head = book.add_format(
            {"bold": True, "bg_color": HEAD, "font_color": "#ffffff", "text_wrap": True, "valign": "vcenter"}
        )
        self.fills = {
            name: book.add_format({"bg_color": fill, "font_color": colour}) for name, (fill, colour) in _FILLS.items()
        }

    def add(self, table: Table) -> None:
        """One sheet: headings that stay, a filter, and verdicts that are coloured by what they say."""
        sheet = self.book.add_worksheet(table.name.in_language(self.language).translate(_FORBIDDEN_IN_SHEET_NAMES)[:31])
        titles = [heading.in_full().in_language(self.language) for heading in table.headings]
        self._arrange(sheet, table, titles)
        for column, title in enumerate(titles):
            sheet.write_string(0, column, title, self.head)
        for row, cells in enumerate(table.rows, start=1):
            for column, (cell, heading) in enumerate(zip(cells, table.headings, strict=True)):
                self._write(sheet, row, column, cell, heading.kind)

    def _write(self, sheet: Any, row: int, column: int, cell: Cell, kind: CellKind) -> None:
        if cell is None or cell == "":
            return
        if not isinstance(cell, str):
            sheet.write_number(row, column, cell, self.plain.get(kind))
        elif kind == "verdict":
            sheet.write_string(row, column, verdict_words(cell, self.language))
        else:
            said = self._in_words(cell, kind)
            sheet.write_string(row, column, said[:_LONGEST_CELL], self.label if column == 0 else self.text)

    def _in_words(self, cell: str, kind: CellKind) -> str:
        """A text in the language of the workbook; names, and what the table of sentences does not know, stay."""
        if kind == "source":
            return phrase(f"ui.{cell}").in_language(self.language)
        if kind == "rule":
            return rule_words(cell).in_language(self.language)
        return in_both_languages(cell).in_language(self.language) if self.language == "zh" else cell

    def _arrange(self, sheet: Any, table: Table, titles: list[str]) -> None:
        last_row, last_column = max(len(table.rows), 1), len(titles) - 1
        sheet.freeze_panes(1, 1)
        sheet.autofilter(0, 0, last_row, last_column)
        sheet.set_row(0, 32)
        sheet.set_landscape()
        sheet.set_paper(9)
        sheet.fit_to_pages(1, 0)
        sheet.repeat_rows(0)
        for column, heading in enumerate(table.headings):
            longest = max((_width(row[column]) for row in table.rows), default=0)
            width = longest if heading.kind == "text" else 8
            sheet.set_column(column, column, min(_WIDEST, max(_NARROWEST, width + 3, _width(titles[column]) // 2 + 4)))
            if heading.kind == "verdict":
                for name in SIGN:
                    rule = {"type": "cell", "criteria": "==", "format": self.fills[name]}
                    said = verdict_words(name, self.language)
                    sheet.conditional_format(1, column, last_row, column, rule | {"value": f'"{said}"'})

    def add_about(self, report: JobReport) -> None:
        """The last sheet: the job, its inputs by hash, and how to read the numbers."""
        sheet = self.book.add_worksheet(phrase("ui.job").in_language(self.language))
        sheet.set_column(0, 0, 24)
        sheet.set_column(1, 1, 90)
        lines = [
            *(
                (f"{part}.{key}", value)
                for part, said in (
                    ("job", report.job),
                    ("model", report.model),
                    ("capture", report.capture),
                    ("tool", report.tool),
                )
                for key, value in (said or {}).items()
            ),
            ("profile", f"{report.profile.name}: {report.profile.title}"),
            (phrase("ui.notes").in_language(self.language), phrase("ui.frames_note").in_language(self.language)),
            (
                phrase("ui.unverified").in_language(self.language),
                phrase("ui.unverified_note").in_language(self.language),
            ),
        ]
        for row, (key, value) in enumerate(lines):
            sheet.write_string(row, 0, str(key), self.label)
            sheet.write_string(row, 1, str(value)[:_LONGEST_CELL], self.text)


def _width(cell: Cell) -> int:
    """Characters that a cell takes; a Chinese one takes two."""
    return sum(2 if ord(sign) > 0x2E7F else 1 for sign in cell) if isinstance(cell, str) else 0
