"""What was learned of a camera, and whether it still holds, for the terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from aadm_workbench.calibration.learn.edges import SIDES
from aadm_workbench.model import Kind

from .terminal import new_table, verdict_text

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.assembly.matching.reversal import Reversal
    from aadm_workbench.calibration.learn.learn import Learned
    from aadm_workbench.calibration.learn.verify import Checked
    from aadm_workbench.calibration.reversal import ColumnReversal
    from aadm_workbench.model import Measure

_PER_MILLION = 1e6  # of relative figures: what a metre gains in micrometres


def learned_tables(found: Learned) -> Iterator[Table]:
    """The figures, and the edges side by side."""
    table = new_table("Figure", "Value", "u", numbers=("Value", "u"))
    table.add_row("scale, by steps, µm/m", *_relative(found.scale))
    for kind in Kind:
        edges = found.edges[kind]
        table.add_row(f"stretch of {kind.plural}, µm/m", *_relative(edges.stretch))
        table.add_row(f"scatter of {kind.plural}, mm per axis", f"{found.stretches.scatter_mm[kind]:.3f}", "")
    lengths, faces = found.lengths, found.faces
    table.add_row(f"length error over {lengths.over_mm:.0f} mm, mm", f"{lengths.worst_mm:+.3f}", f"{lengths.u_mm:.3f}")
    table.add_row("flatness, mm", f"{max(face.flatness_mm for face in faces):.3f}", "")
    table.add_row("form of 95 %, mm", f"{max(face.form_95_mm for face in faces):.3f}", "")
    table.add_row("noise of a point, mm", f"{max(face.noise_mm for face in faces):.3f}", "")
    if found.noise_grows is not None:
        table.add_row("noise grows with distance to the power", *_pair(found.noise_grows, 2))
    yield table
    numbers = ("Lost, pixels", "Overhang, pixels", "Curl, mm")
    sides = new_table("Edges", "Side", *numbers, numbers=numbers)
    for kind in Kind:
        for side in SIDES:
            one = found.sides[kind][side]
            cells = (" ± ".join(_pair(measure, 2)) for measure in (one.lost, one.overhang, one.curl_mm))
            sides.add_row(kind.plural, side, *cells)
    yield sides


def _relative(measure: Measure) -> tuple[str, str]:
    return f"{measure.value * _PER_MILLION:+.0f}", f"{measure.u * _PER_MILLION:.0f}"


def _pair(measure: Measure | None, decimals: int) -> tuple[str, ...]:
    if measure is None:
        return ("not measured",)
    return f"{measure.value:.{decimals}f}", f"{measure.u:.{decimals}f}"


def verified_table(checks: Sequence[Checked]) -> Table:
    """Each figure from what was learned, its limit and its verdict."""
    table = new_table("Figure", "Off", "Limit", "Verdict", numbers=("Off", "Limit"))
    for one in checks:
        table.add_row(one.name, f"{one.value:+.5f}", f"{one.limit:.5f}", verdict_text(one.verdict))
    return table


def reversal_tables(each: Sequence[ColumnReversal]) -> Iterator[Table]:
    """One line for each group, with what is not told, or why; then offsets and bend of the first capture, if any."""
    numbers = ("Captures", "Bend, mm", "u", "Stated u")
    table = new_table("Column", "Group", *numbers, "Not told", "Verdict", numbers=numbers)
    for one in each:
        cells: tuple[str, ...] = (*("–",) * 3, str(one.found))
        if not isinstance(one.found, str):
            lengths = (one.found.largest_mm, one.found.u_mm, one.found.stated_u_mm)
            cells = (*(f"{length:.3f}" for length in lengths), ", ".join(one.found.untold) or "–")
        table.add_row(one.column, one.kind.plural, str(one.captures), *cells, verdict_text(one.verdict))
    yield table
    for one in each:
        if not isinstance(one.found, str) and one.found.shown:
            yield _bend_table(one, one.found)


def _bend_table(one: ColumnReversal, found: Reversal) -> Table:
    numbers = ("Part x", "Part y", "Bend x", "Bend y")
    table = new_table(f"{one.column}, mm", *numbers, numbers=numbers)
    for label, part, bend in zip(one.labels, found.part, found.bias[0], strict=True):
        table.add_row(label, *(f"{value:+.3f}" for value in (*part, *bend)))
    return table
