"""Say what changed between two inspections: A.json is the earlier report, B.json the later one.

Lists columns that are new or missing, verdicts that changed, columns that come to stand elsewhere, and sleeves and bars
that moved: those whose offset from design differs by more than 2.45 times the standard uncertainty of the difference,
which 95 % of the points that did not move stay within.

Exit codes: 0 nothing changed, 11 something changed and no column is worse than before, 10 some column is worse.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, FAILS, UNDECIDED, add_switches

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.report.changes import Changes, ColumnChange, PointChange
    from aadm_workbench.stack.changes import SetChange

    from ..shown.told import Words

EXAMPLE = """\
examples:
  aadm diff monday/report.json tuesday/report.json
  aadm diff before-repair/report.json after-repair/report.json --json > changes.json"""

NO_CHANGE, CHANGED, WORSE = ALL_PASS, UNDECIDED, FAILS


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("before", type=Path, metavar="A.json", help="report.json of the earlier check")
    parser.add_argument("after", type=Path, metavar="B.json", help="report.json of the later check")
    add_switches(parser, prints_json="the changes")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Compare two reports."""
    from aadm_workbench.report.changes import compare_reports
    from aadm_workbench.report.read import read_report
    from aadm_workbench.stack.changes import set_changes
    from aadm_workbench.stack.measured import measured_floor

    from ..shown.terminal import show, show_json
    from ..shown.told import words_for

    before, after = read_report(options.before), read_report(options.after)
    changes = compare_reports(before, after)
    set_otherwise = set_changes(measured_floor(before), measured_floor(after))
    if options.json:
        from aadm_workbench.report.json import encode

        trends = [{**asdict(change), "trend": change.trend} for change in changes.changed]
        summed = {"any_change": changes.any_change, "any_worse": changes.any_worse}
        show_json(encode({**asdict(changes), "changed": trends, **summed, "set": [*map(asdict, set_otherwise)]}))
    elif not options.quiet:
        words = words_for(options, "told_diff")
        show(*([_settings(set_otherwise, words)] if set_otherwise else []), *_parts(changes, words))
    if changes.any_worse:
        return WORSE
    return CHANGED if changes.any_change or set_otherwise else NO_CHANGE


def _parts(changes: Changes, words: Words) -> Iterator[Table | str]:
    """Tables and lines for people."""
    if changes.changed:
        yield _columns(changes, words)
        points = [(change, point) for change in changes.changed for point in change.points]
        if points:
            yield _points(points, words)
    if changes.new:
        yield words("new", names=words.listed(changes.new))
    if changes.missing:
        yield words("missing", names=words.listed(changes.missing))
    yield from (words("note", said=words.said(text)) for text in changes.inputs)
    total = len(changes.changed) + len(changes.unchanged)
    counted = {trend: sum(change.trend == trend for change in changes.changed) for trend in ("worse", "better")}
    if not changes.any_change:
        yield words("nothing", number=total)
        return
    moved = len(changes.changed) - sum(counted.values())
    yield words("compared", number=total, **counted, moved=moved, unchanged=len(changes.unchanged))


def _columns(changes: Changes, words: Words) -> Table:
    from rich.text import Text

    table = words.table("shown.column", "trend", "shown.verdict", "shown.goes_on", "largest", "new_reason")
    for change in changes.changed:
        table.add_row(
            Text(change.id),
            words(change.trend),
            _step(change.from_verdict, change.to_verdict, words),
            _step(change.from_goes_on, change.to_goes_on, words),
            _distances(change),
            Text(words.said(change.new_reasons[0]) if change.new_reasons and change.trend == "worse" else ""),
        )
    return table


def _settings(changes: Sequence[SetChange], words: Words) -> Table:
    from rich.text import Text

    table = words.table("shown.column", "comes_to_stand", "then", "moved", "u", numbers=("moved", "u"))
    for change in changes:
        table.add_row(
            Text(change.id),
            _offset(change.from_pose and change.from_pose[:2]),
            _offset(change.to_pose and change.to_pose[:2]),
            "" if change.moved_mm is None else f"{change.moved_mm:.2f} mm",
            "" if change.u_mm is None else f"{change.u_mm:.2f} mm",
        )
    return table


def _points(points: list[tuple[ColumnChange, PointChange]], words: Words) -> Table:
    from rich.text import Text

    numbers = ("from", "to", "moved", "u")
    table = words.table("shown.column", "ui.point", *numbers, "shown.verdict", numbers=numbers)
    for change, point in points:
        table.add_row(
            Text(change.id),
            point.label,
            _offset(point.from_mm),
            _offset(point.to_mm),
            "" if point.moved_mm is None else f"{point.moved_mm:.2f} mm",
            "" if point.u_mm is None else f"{point.u_mm:.2f} mm",
            _step(point.from_verdict, point.to_verdict, words),
        )
    return table


def _step(before: str, after: str, words: Words) -> str:
    said = [words.word(word) for word in (before, after)]
    return said[0] if before == after else f"{said[0]} → {said[1]}"


def _distances(change: ColumnChange) -> str:
    said = ["–" if value is None else f"{value:.2f} mm" for value in (change.from_largest_mm, change.to_largest_mm)]
    return "" if said[0] == said[1] == "–" else f"{said[0]} → {said[1]}"


def _offset(vector: tuple[float, float] | None) -> str:
    return "–" if vector is None else f"({vector[0]:+.2f}, {vector[1]:+.2f})"
