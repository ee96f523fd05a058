"""The table that ends a check: one line a column, the worst first; under it what can be done about it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.table import Table
from rich.text import Text

from aadm_workbench.model import WORST_FIRST, ColumnReport, JobReport, SpacingResult, Verdict
from aadm_workbench.model.reason import Language
from aadm_workbench.report.words.labels import phrase

from .terminal import in_words, new_table, show, verdict_text


def show_verdicts(report: JobReport, file: Path | None, language: Language = "en") -> None:
    """Show the table, what can be done, how many columns came to what, and where the report is if it was written."""
    lines = shown_columns(report, language)
    advice = [*(line.advice for line in lines if line.advice), *mould_lines(report, language)]
    show(_table(lines, language), "", *advice, *([""] if advice else []))
    show(summary_line(report, language))
    if file is not None:
        show(phrase("shown.report", file=file).in_language(language))


def verdict_table(report: JobReport, language: Language = "en") -> Table:
    """Verdict, column, its worst point with deviation and limit, whether it goes on its bars, and why."""
    return _table(shown_columns(report, language), language)


@dataclass(frozen=True)
class ShownColumn:
    """A column as the table shows it, and a line for advice on its repair; empty without any."""

    verdict: Verdict
    cells: tuple[Text | str, ...]
    advice: str


def shown_columns(report: JobReport, language: Language = "en") -> list[ShownColumn]:
    """Columns by verdict, the worst first; those of one verdict in the order of the job.

    Each is made once, and nothing is kept of it but what is shown: a shipment may have more than the memory holds.
    """
    lines = [_shown(column, language) for column in report.columns]
    return sorted(lines, key=lambda line: WORST_FIRST.index(line.verdict))


def _shown(column: ColumnReport, language: Language) -> ShownColumn:
    comparison = worst_comparison(column)
    cells = (
        verdict_text(column.verdict, language),
        Text(column.id),
        "" if comparison is None else comparison.point,
        "" if comparison is None else comparison.in_words(language),
        verdict_text(column.goes_on, language),
        Text(_reason(column, comparison, language)),
    )
    repair = column.repair
    advice = "" if repair is None else _filled("shown.repair", column.id, repair.advice, language)
    return ShownColumn(column.verdict, cells, advice)


def _table(lines: Sequence[ShownColumn], language: Language) -> Table:
    names = ("verdict", "column", "worst", "deviation_limit", "goes_on", "reason")
    headings = [phrase(f"shown.{name}").in_language(language) for name in names]
    table = new_table(*headings, numbers=(headings[3],))
    for line in lines:
        table.add_row(*line.cells)
    return table


def summary_line(report: JobReport, language: Language = "en") -> str:
    """``8 columns: 5 pass, 2 fail, 1 error``."""
    counted = [
        phrase("shown.counted", number=number, verdict=in_words(Verdict(name), language)).in_language(language)
        for name, number in report.summary().items()
        if number
    ]
    total = len(report.columns)
    said = phrase("shown.one_column" if total == 1 else "shown.columns", number=total).in_language(language)
    return f"{said}: {', '.join(counted)}" if language == "en" else f"{said}：{'，'.join(counted)}"


def mould_lines(report: JobReport, language: Language = "en") -> Iterator[str]:
    """One line for each mould that displaces sleeves."""
    for mould in report.mould_drift:
        if mould.drifting or any(sleeve.scatters_more for sleeve in mould.sleeves):
            name = mould.piece_mark or mould.columns[0]
            yield _filled("shown.mould", name, mould.conclusion, language)


def _filled(word: str, name: str, said: str, language: Language) -> str:
    return phrase(word).in_language(language).format(name=name, said=_said(said, language))


def _said(sentence: str, language: Language) -> str:
    if language == "en":
        return sentence
    from aadm_workbench.report.words.reasons import in_both_languages

    return in_both_languages(sentence).in_language(language)


def _reason(column: ColumnReport, comparison: Comparison | None, language: Language) -> str:
    """What is in the way, or why a failing point fails, else the column's first reason; and how many more there are."""
    if not column.reasons:
        return ""
    reason = column.reasons[0]
    trial = column.trial_assembly
    in_the_way = trial is not None and bool(trial.in_the_way)
    blamed = any(group.blamed for group in column.groups.values())
    if (
        column.verdict is Verdict.FAIL
        and not in_the_way
        and not blamed
        and comparison is not None
        and comparison.reason in column.reasons
    ):
        reason = comparison.reason
    more = len(column.reasons) - 1
    return _said(reason, language) + (phrase("shown.more", number=more).in_language(language) if more else "")


@dataclass(frozen=True)
class Comparison:
    """A measured value, mm, and its limit; ``point`` is a label, or two of them for what is between two points."""

    point: str
    value_mm: float | None
    limit_mm: float | None
    verdict: Verdict
    reason: str = ""
    is_signed: bool = False

    @property
    def ratio(self) -> float:
        """Share of the limit that is used up; below zero where there is nothing to compare."""
        if self.value_mm is None or not self.limit_mm:
            return -1.0
        return self.value_mm / self.limit_mm

    def in_words(self, language: Language = "en") -> str:
        """``2.41 / 2 mm``, measured over limit; what has a sign in its limit has one itself."""
        if self.value_mm is None:
            return ""
        none = phrase("shown.no_limit").in_language(language)
        limit = none if self.limit_mm is None else f"{self.limit_mm:g} mm"
        if not self.is_signed:
            return f"{self.value_mm:.2f} / {limit}"
        from aadm_workbench.report.sheets.numbers import signed

        return f"{signed(self.value_mm)} / {limit}"


def worst_comparison(column: ColumnReport) -> Comparison | None:
    """Of all comparisons that came to the column's own verdict the one nearest to its limit, or furthest beyond.

    Where none came to it (a collision, an orientation that is open), of all there are. None where nothing was
    compared.
    """
    every = list(_comparisons(column))
    deciding = [comparison for comparison in every if comparison.verdict is column.verdict]
    return max(deciding or every, key=lambda comparison: comparison.ratio, default=None)


def _comparisons(column: ColumnReport) -> Iterator[Comparison]:
    for group in (column.sleeves, column.rebars):
        if group is not None:
            for point in group.points:
                yield Comparison(point.label, point.deviation_mm, point.limit_mm, point.verdict, point.reason)
            for pair in group.spacing:
                label = "-".join(pair.between)
                limit_mm = _limit_on_its_side(pair)
                yield Comparison(label, pair.deviation_mm, limit_mm, pair.verdict, pair.reason, is_signed=True)
    trial = column.trial_assembly
    pose = None if trial is None else trial.best or trial.minimax
    if pose is not None:
        for one in pose.pairs:
            yield Comparison(f"{one.sleeve}/{one.rebar}", one.distance_mm, one.limit_mm, one.verdict, one.reason)


def _limit_on_its_side(pair: SpacingResult) -> float | None:
    """The lower limit of what is measured too short, the upper one of what is too long."""
    if pair.limit_mm is None or pair.deviation_mm is None:
        return None
    return pair.limit_mm[0 if pair.deviation_mm < 0.0 else 1]
