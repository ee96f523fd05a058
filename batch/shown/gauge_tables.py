"""A gauge study for the terminal: a table of each quantity, and what follows in one sentence."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from aadm_workbench.calibration.gauge.page import interval, lines_of_variances

from .terminal import new_table, verdict_text

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.calibration.gauge.study import GaugeStudy, QuantityStudy


def gauge_tables(found: GaugeStudy) -> Iterator[Table | str]:
    """The tables and sentences, quantity by quantity."""
    for one in found.quantities:
        yield from _quantity(one)
    yield from (str(reason) for reason in found.not_studied)


def _quantity(found: QuantityStudy) -> Iterator[Table | str]:
    study = found.study
    parts, operators, repeats = study.values.shape[1:]
    title = f"{study.quantity}: {parts} parts, {operators} operators or set-ups, {repeats} captures by each"
    table = new_table(
        "Component", "Standard deviation, mm (95 %)", numbers=("Standard deviation, mm (95 %)",), title=title
    )
    for name, value in lines_of_variances(found):
        table.add_row(name.en, value)
    yield table
    numbers = ("%GRR (95 %)", "ndc")
    against = new_table("Against", *numbers, "Verdict", numbers=numbers)
    against.add_row("the parts of this study", interval(found.percent_of_study, 1), str(found.categories), "")
    for limit in found.against:
        percent = interval(limit.percent, 1)
        against.add_row(f"± {limit.limit_mm:g} mm", percent, str(limit.categories), verdict_text(limit.verdict))
    yield against
    yield f"{study.quantity}: {found.stated.reason}"
    yield from (str(reason) for reason in study.left_out)
