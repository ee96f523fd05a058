"""One column as the HTML report shows it: facts, sketches, tables, what the 3-D view draws."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from aadm_workbench.model import (
    ColumnReport,
    JobReport,
    Kind,
    PointResult,
    RepairReport,
)
from aadm_workbench.report.column_view import (
    DRAWN_DIAMETER_MM,
    Titled,
    column_notes,
    foot_sketches,
    window_sketch,
)
from aadm_workbench.report.findings import Finding
from aadm_workbench.report.hoist import Hoist
from aadm_workbench.report.pages.svg import svg_of
from aadm_workbench.report.sheets.column_tables import Block, column_blocks
from aadm_workbench.report.words.labels import Phrase, phrase

_VIEW_FACTORS = (50, 40, 30, 20, 10, 5, 2, 1)  # magnifications that a person can divide by


@dataclass(frozen=True)
class View:
    """What the 3-D view draws, mm, column frame.

    Each of the ``points`` is a label, the design place, the offset (None: not measured), the radius, the length of the
    bar and the verdict.
    """

    points: list[tuple[str, float, float, float, float | None, float | None, float, float, str]]
    size: tuple[float, float] | None
    foot: float
    block: float
    middle: float
    reach: float
    factor: int


def view_of(column: ColumnReport) -> View:
    """The points of a column as the 3-D view draws them."""
    known = [(kind, point) for kind in Kind for point in column.points(kind)]
    ends = [abs(round(value, 1)) for _, point in known for value in point.design_mm[:2]]
    reach = max([*ends, *(side / 2.0 for side in column.size_mm or ()), 1.0])
    longest_mm = max((abs(round(value, 2)) for _, point in known for value in point.offset_mm or ()), default=0.0)
    # The foot is lifted over the bars, as it hangs before it is lowered: else each bar hides in its sleeve.
    lift = 0.0
    if column.sleeves and column.rebars:
        lift = max([0.0, *(round(point.design_mm[2], 1) for _, point in known)]) + 0.35 * reach
    return View(
        points=[_drawn(kind, point, lift) for kind, point in known],
        size=column.size_mm if column.sleeves else None,
        foot=lift,
        block=0.5 * reach,
        middle=(lift + 0.2 * reach) / 2.0,
        reach=reach,
        factor=next((factor for factor in _VIEW_FACTORS if factor * longest_mm <= 0.25 * reach), 1),
    )


def _drawn(
    kind: Kind, point: PointResult, lift: float
) -> tuple[str, float, float, float, float | None, float | None, float, float, str]:
    x, y, z = (round(value, 1) for value in point.design_mm)
    dx, dy = (None, None) if point.offset_mm is None else (round(value, 2) for value in point.offset_mm)
    radius = round((point.diameter_mm or DRAWN_DIAMETER_MM[kind]) / 2.0, 1)
    if kind is Kind.SLEEVE:
        return point.label, x, y, z + lift, dx, dy, radius, 0, point.verdict
    return point.label, x, y, z, dx, dy, radius, round(point.exposed_length_mm or point.design_mm[2], 1), point.verdict


@dataclass(frozen=True)
class Entry:
    """What the template needs of one column beside its report; drawings as SVG."""

    finding: Finding
    column: ColumnReport
    sketches: list[tuple[Titled, str]]
    view: View
    window_svg: str
    after_repair: Phrase | None
    tables: list[Block]
    notes: list[str]
    search: str


def column_entry(report: JobReport, finding: Finding, as_markup: Callable[[str], str]) -> Entry:
    """What the template needs of one column; ``as_markup`` marks a drawing as one that is not escaped again."""
    column = finding.column
    window = None if column.trial_assembly is None else window_sketch(column.trial_assembly)
    return Entry(
        finding=finding,
        column=column,
        sketches=[
            (titled, as_markup(svg_of(titled.foot.sketch, label=f"{column.id}: {phrase(titled.title).en}")))
            for titled in foot_sketches(column)
        ],
        view=view_of(column),
        window_svg="" if window is None else as_markup(svg_of(window, label="window", css_class="bars")),
        after_repair=None if column.repair is None else _after(column.repair),
        tables=column_blocks(report, column),
        notes=column_notes(column),
        search=_search(column, finding.hoist),
    )


def _after(repair: RepairReport) -> Phrase | None:
    """What the repair comes to, where that was found out."""
    if repair.after is None or repair.probability is None:
        return None
    percent = f"{100.0 * repair.probability:.0f}"
    return phrase("ui.after_repair", max_mm=f"{repair.after.max_mm:.2f}", percent=percent)


def _search(column: ColumnReport, hoist: Hoist) -> str:
    names = (column.id, column.grid, column.storey, column.piece_mark, column.global_id, column.verdict)
    texts = [name or "" for name in names]
    texts += [part for reason in hoist.reasons for part in dict.fromkeys(reason)]
    return " ".join([*texts, *hoist.cause, *phrase(f"verdict.{column.verdict}")]).lower()
