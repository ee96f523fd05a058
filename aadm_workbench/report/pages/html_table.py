"""Tables of report.html as markup: not by the template, for a thousand columns have a million cells."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from html import escape

from aadm_workbench.report.sheets.numbers import is_number, number_text
from aadm_workbench.report.sheets.tables import Cell, CellKind, Heading, Row
from aadm_workbench.report.words.labels import Language, Phrase, all_words, phrase, rule_words, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages

_INPUTS = ("sleeves", "rebars", "hoisting")
_UNVERIFIED = ", unverified"


class TableWriter:
    """Writes tables in one language; ``number_of`` gives a phrase the number that the language switch knows it by."""

    def __init__(self, language: Language, number_of: Callable[[Phrase], int]) -> None:
        self.language: Language = language
        self._number_of = number_of
        self._verdict = cache(lambda name: f"<td class=v-{name}>{escape(verdict_words(name, language))}")
        self._said = cache(self._in_cell)

    def table(self, headings: Sequence[Heading], rows: Sequence[Row]) -> str:
        """A ``<table>`` that scrolls by itself where it is wide; every text of others is escaped."""
        kinds = [heading.kind for heading in headings]
        head = "".join(self._heading(heading) for heading in headings)
        body = "\n".join("<tr>" + "".join(map(self._cell, row, kinds)) for row in rows)
        return f'<div class="wide"><table class=num><thead><tr>{head}</thead><tbody>{body}\n</tbody></table></div>'

    def _heading(self, heading: Heading) -> str:
        return f"<th{'' if is_number(heading.kind) else ' class=t'}{self._said(heading.in_full())}"

    def _cell(self, cell: Cell, kind: CellKind) -> str:
        if cell is None or cell == "":
            return "<td>"
        if kind == "verdict":
            return self._verdict(str(cell))
        if is_number(kind):
            return f"<td>{escape(number_text(cell, kind))}"
        held = str(cell)
        if kind == "source":
            return f"<td class={'uv' if held == 'unverified' else 't'}{self._said(phrase(f'ui.{held}'))}"
        if kind == "rule":
            return f"<td class=t{self._said(rule_words(held))}"
        if held in _INPUTS:
            return f"<td class=t{self._said(all_words()[f'ui.{held}'])}"
        said = in_both_languages(cell if isinstance(cell, str) else held)
        return f"<td class={'uv' if held.endswith(_UNVERIFIED) else 't'}{self._said(said)}"

    def _in_cell(self, said: Phrase) -> str:
        """The rest of an opening tag, and the text."""
        number = "" if said.en == said.zh else f" data-p={self._number_of(said)}"
        return f"{number}>{escape(said.in_language(self.language))}"
