"""One column as the HTML report shows it: facts, sketches, tables, what the 3-D view draws."""

from __future__ import annotations

from typing import Any

from aadm_workbench.report.column_view import (
    BAR_DIAMETER_MM,
    SLEEVE_DIAMETER_MM,
    column_facts,
    column_notes,
    foot_sketches,
    trial_facts,
    window_sketch,
    window_text,
)
from aadm_workbench.report.findings import Finding
from aadm_workbench.report.hoist import Hoist
from aadm_workbench.report.pages.svg import svg_of
from aadm_workbench.report.read import Report
from aadm_workbench.report.sheets.column_tables import column_blocks
from aadm_workbench.report.shown_pose import shown_pose
from aadm_workbench.report.words.labels import phrase
from aadm_workbench.report.words.reasons import in_both_languages

_VIEW_FACTORS = (50, 40, 30, 20, 10, 5, 2, 1)  # magnifications that a person can divide by


def view_of(column: dict[str, Any]) -> dict[str, Any]:
    """What the 3-D view draws, mm, column frame: label, design place, offset, radius, length of the bar, verdict."""
    points = [
        [
            point["label"],
            *(round(value, 1) for value in point["design_mm"]),
            *([round(value, 2) for value in point["offset_mm"]] if point["offset_mm"] else (None, None)),
            round((point["diameter_mm"] or nominal_mm) / 2.0, 1),
            round(point.get("exposed_length_mm") or point["design_mm"][2], 1) if kind == "rebars" else 0,
            point["verdict"],
        ]
        for kind, nominal_mm in (("sleeves", SLEEVE_DIAMETER_MM), ("rebars", BAR_DIAMETER_MM))
        for point in (column[kind] or {}).get("points", ())
    ]
    heights = [point[3] for point in points]
    flat = [abs(value) for point in points for value in point[1:3]]
    size = column["size_mm"]
    reach = max([*flat, *(side / 2.0 for side in size or ()), 1.0])
    longest_mm = max((abs(value) for point in points for value in point[4:6] if value is not None), default=0.0)
    # The foot is lifted over the bars, as it hangs before it is lowered: else each bar hides in its sleeve.
    lift = max([0.0, *heights]) + 0.35 * reach if column["sleeves"] and column["rebars"] else 0.0
    for point in points:
        if point[0].startswith("S"):
            point[3] += lift
    return {
        "points": points,
        "size": size if column["sleeves"] else None,
        "foot": lift,
        "block": 0.5 * reach,
        "middle": (lift + 0.2 * reach) / 2.0,
        "reach": reach,
        "factor": next((factor for factor in _VIEW_FACTORS if factor * longest_mm <= 0.25 * reach), 1),
    }


def sketch_entries(column: dict[str, Any]) -> list[dict[str, Any]]:
    """The foot sketches as SVG."""
    return [
        {
            "title": titled.title,
            "caption": titled.caption,
            "svg": svg_of(titled.foot.sketch, label=f"{column['id']}: {phrase(titled.title).en}"),
        }
        for titled in foot_sketches(column)
    ]


def column_entry(report: Report, finding: Finding) -> dict[str, Any]:
    """All that the template needs of one column."""
    column, hoist = finding.column, finding.hoist
    return {
        **{name: column[name] for name in ("id", "grid", "verdict", "goes_on")},
        "anchor": finding.anchor,
        "hoist": hoist,
        "key_reasons": finding.key_reasons,
        "more": finding.more,
        "largest": (shown_pose(column["trial_assembly"]) or {}).get("max_mm"),
        "facts": column_facts(column),
        "repair": _repair(column),
        "sketches": sketch_entries(column),
        "view_note": phrase("ui.view_3d_note", factor=view_of(column)["factor"]),
        "trial": _trial(column),
        "tables": column_blocks(report, column),
        "notes": [in_both_languages(note) for note in column_notes(column)],
        "search": _search(column, hoist),
    }


def _repair(column: dict[str, Any]) -> dict[str, Any] | None:
    repair = column.get("repair")
    if repair is None:
        return None
    after = repair["after"]
    outcome = None
    if after is not None and repair["probability"] is not None:
        percent = f"{100.0 * repair['probability']:.0f}"
        outcome = phrase("ui.after_repair", max_mm=f"{after['max_mm']:.2f}", percent=percent)
    return {
        "advice": in_both_languages(repair["advice"]),
        "after": outcome,
        "released": repair["subject_to"] in repair["advice"],
        "clause": f"({repair['adjustment_limit_mm']:g} mm: {repair['clause']})"
        if repair["adjustment_limit_mm"]
        else "",
        "notes": [in_both_languages(note) for note in repair["notes"]],
    }


def _trial(column: dict[str, Any]) -> dict[str, Any] | None:
    trial = column["trial_assembly"]
    if trial is None:
        return None
    window = window_sketch(trial)
    names = ("best", "minimax", "least_squares")
    return {
        "verdict": trial["verdict"],
        "facts": trial_facts(trial),
        "poses": [(f"ui.{name}", trial[name]) for name in names if trial.get(name) is not None],
        "window": window_text(trial),
        "window_svg": "" if window is None else svg_of(window, label="window", css_class="bars"),
    }


def _search(column: dict[str, Any], hoist: Hoist) -> str:
    texts = [column[name] or "" for name in ("id", "grid", "storey", "piece_mark", "global_id", "verdict")]
    texts += [part for reason in hoist.reasons for part in dict.fromkeys(reason)]
    return " ".join([*texts, *hoist.cause, *phrase(f"verdict.{column['verdict']}")]).lower()
