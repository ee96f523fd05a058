"""The table that ends a check: one line a column, the worst first; under it what can be done about it."""

from __future__ import annotations

from collections.abc import Iterator

from rich.table import Table
from rich.text import Text

from aadm_workbench.model import WORST_FIRST, ColumnReport, JobReport, Verdict

from .terminal import in_words, new_table, verdict_text
from .worst_point import Comparison, worst_comparison


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
