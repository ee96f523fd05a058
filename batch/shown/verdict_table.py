"""The table that ends a check: one line a column, the worst first; under it what can be done about it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rich.table import Table
from rich.text import Text

from aadm_workbench.model import WORST_FIRST, ColumnReport, JobReport, SpacingResult, Verdict

from .terminal import in_words, new_table, show, verdict_text


def show_verdicts(report: JobReport, last_line: str) -> None:
    """Show the table, what can be done, and how many columns came to what."""
    advice = list(advice_lines(report))
    show(verdict_table(report), "", *advice, *([""] if advice else []))
    show(summary_line(report), last_line)


def verdict_table(report: JobReport) -> Table:
    """Verdict, column, its worst point with deviation and limit, whether it goes on its bars, and why."""
    table = new_table(
        "Verdict", "Column", "Worst", "Deviation / limit", "Goes on", "Reason", numbers=("Deviation / limit",)
    )
    for column in worst_first(report.columns):
        comparison = worst_comparison(column)
        table.add_row(
            verdict_text(column.verdict),
            Text(column.id),
            "" if comparison is None else comparison.point,
            "" if comparison is None else comparison.in_words(),
            verdict_text(column.goes_on),
            Text(_reason(column, comparison)),
        )
    return table


def worst_first(columns: tuple[ColumnReport, ...]) -> list[ColumnReport]:
    """Columns by verdict, the worst first; those of one verdict in the order of the job."""
    return sorted(columns, key=lambda column: WORST_FIRST.index(column.verdict))


def summary_line(report: JobReport) -> str:
    """``8 columns: 5 pass, 2 fail, 1 error``."""
    counted = [f"{number} {in_words(Verdict(name))}" for name, number in report.summary().items() if number]
    total = len(report.columns)
    return f"{total} column{'' if total == 1 else 's'}: {', '.join(counted)}"


def advice_lines(report: JobReport) -> Iterator[str]:
    """One line for each column that has advice on its repair, and for each mould that displaces sleeves."""
    for column in worst_first(report.columns):
        if column.repair is not None:
            yield f"{column.id}: repair, {column.repair.advice}"
    for mould in report.mould_drift:
        if mould.drifting or any(sleeve.scatters_more for sleeve in mould.sleeves):
            yield f"Mould of {mould.piece_mark or mould.columns[0]}: {mould.conclusion}"


def _reason(column: ColumnReport, comparison: Comparison | None) -> str:
    """What is in the way, or why a failing point fails, else the column's first reason; and how many more there are."""
    if not column.reasons:
        return ""
    reason = column.reasons[0]
    trial = column.trial_assembly
    in_the_way = trial is not None and bool(trial.in_the_way)
    if (
        column.verdict is Verdict.FAIL
        and not in_the_way
        and comparison is not None
        and comparison.reason in column.reasons
    ):
        reason = comparison.reason
    more = len(column.reasons) - 1
    return reason + (f" (+{more} more)" if more else "")


@dataclass(frozen=True)
class Comparison:
    """A measured value, mm, and its limit; ``point`` is a label, or two of them for what is between two points."""

    point: str
    value_mm: float | None
    limit_mm: float | None
    verdict: Verdict
    reason: str = ""

    @property
    def ratio(self) -> float:
        """Share of the limit that is used up; below zero where there is nothing to compare."""
        if self.value_mm is None or not self.limit_mm:
            return -1.0
        return self.value_mm / self.limit_mm

    def in_words(self) -> str:
        """``2.41 / 2 mm``, measured over limit."""
        if self.value_mm is None:
            return ""
        limit = "no limit" if self.limit_mm is None else f"{self.limit_mm:g} mm"
        return f"{self.value_mm:.2f} / {limit}"


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
                yield Comparison(label, pair.deviation_mm, _limit_on_its_side(pair), pair.verdict, pair.reason)
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
