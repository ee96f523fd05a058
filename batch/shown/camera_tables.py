"""What was learned of a camera, and whether it still holds, for the terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from aadm_workbench.calibration.learn.edges import SIDES
from aadm_workbench.model import Kind

from .terminal import new_table, verdict_text
from .told import Words

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.assembly.matching.reversal import Reversal
    from aadm_workbench.calibration.learn.learn import Learned
    from aadm_workbench.calibration.learn.verify import Checked
    from aadm_workbench.calibration.reversal import ColumnReversal
    from aadm_workbench.model import Measure

_FIGURES = {
    "stretch of sleeves": "stretch_of_sleeves",
    "stretch of rebars": "stretch_of_rebars",
    "scatter of sleeves, mm": "scatter_of_sleeves",
    "scatter of rebars, mm": "scatter_of_rebars",
    "rings of pixels lost at sleeves": "rings_of_sleeves",
    "rings of pixels lost at rebars": "rings_of_rebars",
}
"""Names of the log, and the words of each."""
_PER_MILLION = 1e6  # of relative figures: what a metre gains in micrometres


def learned_tables(found: Learned, words: Words) -> Iterator[Table]:
    """The figures, and the edges side by side."""
    table = words.table("figure", "value", "u", numbers=("value", "u"))
    table.add_row(words("scale"), *_relative(found.scale))
    for kind in Kind:
        edges = found.edges[kind]
        table.add_row(words("stretched", kind=words(f"told.{kind.plural}")), *_relative(edges.stretch))
        scatter = words("scatter", kind=words(f"told.{kind.plural}"))
        table.add_row(scatter, f"{found.stretches.scatter_mm[kind]:.3f}", "")
    lengths, faces = found.lengths, found.faces
    table.add_row(words("length", over=lengths.over_mm), f"{lengths.worst_mm:+.3f}", f"{lengths.u_mm:.3f}")
    table.add_row(words("flatness"), f"{max(face.flatness_mm for face in faces):.3f}", "")
    table.add_row(words("form"), f"{max(face.form_95_mm for face in faces):.3f}", "")
    table.add_row(words("noise"), f"{max(face.noise_mm for face in faces):.3f}", "")
    if found.noise_grows is not None:
        table.add_row(words("grows"), *_pair(found.noise_grows, 2, words))
    yield table
    numbers = ("lost", "overhang", "curl")
    sides = words.table("edges", "side", *numbers, numbers=numbers)
    for kind in Kind:
        for side in SIDES:
            one = found.sides[kind][side]
            cells = (" ± ".join(_pair(measure, 2, words)) for measure in (one.lost, one.overhang, one.curl_mm))
            sides.add_row(words(f"told.{kind.plural}"), words(side), *cells)
    yield sides


def _relative(measure: Measure) -> tuple[str, str]:
    return f"{measure.value * _PER_MILLION:+.0f}", f"{measure.u * _PER_MILLION:.0f}"


def _pair(measure: Measure | None, decimals: int, words: Words) -> tuple[str, ...]:
    if measure is None:
        return (words.word("not_measured"),)
    return f"{measure.value:.{decimals}f}", f"{measure.u:.{decimals}f}"


def verified_table(checks: Sequence[Checked], words: Words) -> Table:
    """Each figure from what was learned, its limit and its verdict."""
    table = words.table("figure", "off", "limit", "shown.verdict", numbers=("off", "limit"))
    for one in checks:
        table.add_row(
            words(_FIGURES[one.name]),
            f"{one.value:+.5f}",
            f"{one.limit:.5f}",
            verdict_text(one.verdict, words.language),
        )
    return table


def reversal_tables(each: Sequence[ColumnReversal], words: Words) -> Iterator[Table]:
    """One line for each group, with what is not told, or why; then offsets and bend of the first capture, if any."""
    numbers = ("captures", "bend", "u", "stated_u")
    table = words.table("shown.column", "group", *numbers, "untold", "shown.verdict", numbers=numbers)
    for one in each:
        cells: tuple[str, ...] = (*("–",) * 3, words.said(str(one.found)))
        if not isinstance(one.found, str):
            lengths = (one.found.largest_mm, one.found.u_mm, one.found.stated_u_mm)
            cells = (
                *(f"{length:.3f}" for length in lengths),
                words.listed([words(term) for term in one.found.untold]) or "–",
            )
        table.add_row(
            one.column,
            words(f"told.{one.kind.plural}"),
            str(one.captures),
            *cells,
            verdict_text(one.verdict, words.language),
        )
    yield table
    for one in each:
        if not isinstance(one.found, str) and one.found.shown:
            yield _bend_table(one, one.found, words)


def _bend_table(one: ColumnReversal, found: Reversal, words: Words) -> Table:
    numbers = [words(name) for name in ("part_x", "part_y", "bend_x", "bend_y")]
    table = new_table(f"{one.column}, mm", *numbers, numbers=tuple(numbers))
    for label, part, bend in zip(one.labels, found.part, found.bias[0], strict=True):
        table.add_row(label, *(f"{value:+.3f}" for value in (*part, *bend)))
    return table
