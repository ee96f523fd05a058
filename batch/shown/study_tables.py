"""The tables of a method study: the paper's own with our rows beside it, and what the paper does not report.

The tables of a hoisting study: the paper's own numbers with ours beside them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from aadm_workbench.model import Kind, Vector2
from aadm_workbench.twin.study.hoisting import REFINED, Cell, FrameResult
from aadm_workbench.twin.study.hoisting_plots import mean_key_error
from aadm_workbench.twin.study.hoisting_tables import CELLS, CONDITIONS, TITLES, Keys
from aadm_workbench.twin.study.published import TABLES, PublishedRow
from aadm_workbench.twin.study.scores import Score, Spread, bare_seconds, scores

from .terminal import new_table

if TYPE_CHECKING:
    from aadm_workbench.twin.study.hoisting import HoistingStudy
    from aadm_workbench.twin.study.methods import MethodStudy

BARE_CALLS = "fusion, bare calls"

_COMPARISON = (
    "Rebar diameter",
    "Adjacent rebars",
    "Sleeve diameter",
    "Adjacent sleeves",
    "Rebars s",
    "Sleeves s",
)
_OWN = (
    "Found",
    "False",
    "Mean",
    "95 %",
    "RMSE",
    "Max",
    "Radial",
    "x",
    "y",
    "> 3 u",
    "In 95 %",
    "Time s",
    "x fusion",
    "x bare",
)

_KEYS = ("Left", "Middle", "Right", "Mean")
_ALL = ("Seen pairs", "Mean seen", "Max seen", "Mean inferred", "In 95 %", "Move mm", "Turn deg", "Time s")


def study_tables(study: MethodStudy) -> list[Table | str]:
    """Two tables for each setting, with what is to be known about them below."""
    parts: list[Table | str] = []
    rated = scores(study)
    for setting in study.settings:
        own = [score for score in rated if score.setting == setting]
        parts += [_comparison(study, setting, own), TABLES[setting].slips, "", _own_rows(setting, own), ""]
    scenes = f"{study.scenes} scene{'' if study.scenes == 1 else 's'} a setting, seed {study.seed}"
    parts += [
        f"Synthetic scans, {scenes}. Errors against the truth, in the scan frame, without any fit, mm.",
        "> 3 u: largest error beyond three of its own u; all where there is no u.",
        "The camera's own scale error (up to 0.01 %) is not in the errors; it is in u.",
        "Times are medians, of the extraction alone; bare calls: RANSAC plane, raster and Hough circles by themselves.",
    ]
    return parts


def _comparison(study: MethodStudy, setting: str, own: Sequence[Score]) -> Table:
    """The paper's table: mean absolute error ± standard deviation, and the time of one scan."""
    published = TABLES[setting]
    title = f"{published.title} of the paper, and {setting} scenes: mean absolute error ± standard deviation, mm"
    table = new_table("", "Method", *_COMPARISON, numbers=_COMPARISON, title=title)
    for row in published.rows:
        table.add_row("paper", row.title, *_published_cells(row))
    for method in study.methods:
        bars, sleeves = (_of(own, method, kind) for kind in (Kind.REBAR, Kind.SLEEVE))
        spreads = (bars.diameter, bars.spacing, sleeves.diameter, sleeves.spacing)
        times = (f"{score.seconds:.3f}" for score in (bars, sleeves))
        table.add_row("here", method, *(_mean_and_sd(spread) for spread in spreads), *times)
    alone = [bare_seconds(study, setting, kind) for kind in (Kind.REBAR, Kind.SLEEVE)]
    if any(alone):
        table.add_row("here", BARE_CALLS, "", "", "", "", *("" if s is None else f"{s:.3f}" for s in alone))
    return table


def _own_rows(setting: str, own: Sequence[Score]) -> Table:
    title = f"Centres in the plane, {setting} scenes, mm; radial is away from the camera's foot point"
    table = new_table("Points", "Method", *_OWN, numbers=_OWN, title=title)
    for kind in Kind:
        for score in (score for score in own if score.kind is kind):
            table.add_row(kind.plural, score.method, *_own_cells(score))
    return table


def _own_cells(score: Score) -> list[str]:
    centre = score.centre
    sizes = [""] * 4
    if centre is not None:
        low, high = centre.interval_mm
        mean, rmse, largest = (f"{size:.3f}" for size in (centre.mean_mm, centre.rmse_mm, centre.largest_mm))
        sizes = [mean, f"{low:.3f} to {high:.3f}", rmse, largest]
    return [
        f"{score.found}/{score.expected}",
        str(score.false),
        *sizes,
        *("" if value is None else f"{value:+.3f}" for value in (score.radial_mm, score.x_mm, score.y_mm)),
        "none" if score.unflagged_mm is None else f"{score.unflagged_mm:.3f}",
        "no u" if score.coverage is None else f"{100 * score.coverage:.1f} %",
        f"{score.seconds:.3f}",
        *("" if ratio is None else f"{ratio:.2f}" for ratio in (score.times_fusion, score.times_bare)),
    ]


def _of(own: Sequence[Score], method: str, kind: Kind) -> Score:
    return next(score for score in own if (score.method, score.kind) == (method, kind))


def _published_cells(row: PublishedRow) -> list[str]:
    pairs: tuple[Vector2, ...] = (
        row.rebar_diameter_mm,
        row.rebar_spacing_mm,
        row.sleeve_diameter_mm,
        row.sleeve_spacing_mm,
    )
    return [*(f"{mean:.2f} ± {sd:.2f}" for mean, sd in pairs), f"{row.rebar_s:.3f}", f"{row.sleeve_s:.3f}"]


def _mean_and_sd(spread: Spread | None) -> str:
    return "none found" if spread is None else f"{spread.mean_mm:.2f} ± {spread.sd_mm:.2f}"


def hoisting_tables(study: HoistingStudy) -> list[Table | str]:
    """The comparison of key errors, and what is measured beyond the three keys."""
    frames = f"{study.scenes} scene{'' if study.scenes == 1 else 's'} a cell, seed {study.seed}"
    notes = [
        f"Synthetic frames, {frames}: mean errors of the distance between sleeve and projected bar, mm; '-' is lost.",
        "Seen pairs have evidence of their own in the frame, the others are inferred from the pattern alone.",
        "Move and turn: errors of the correction against the minimax of the same pairs' true centres. Times: medians.",
    ]
    parts: list[Table | str] = [_keys_table(study), ""]
    if REFINED in study.methods:
        parts += [_pairs_table(study), ""]
    if ratio := _times_faster(study):
        parts.append(ratio)
    return [*parts, *notes]


def _keys_table(study: HoistingStudy) -> Table:
    title = f"{TITLES[study.name]}: errors of the three key pairs, mm"
    table = new_table("Cell", "", "Method", *_KEYS, "Time s", numbers=(*_KEYS, "Time s"), title=title)
    for cell in study.cells:
        for row in _published_rows(study, cell):
            table.add_row(*row)
        for method in study.methods:
            results = study.of(cell, method)
            keys = [_mean([r.keys[place] for r in results]) for place in range(3)]
            mean = mean_key_error(study, cell, method)
            table.add_row(
                cell.name, "here", method, *(_number(key) for key in keys), _number(mean), f"{_seconds(results):.3f}"
            )
    return table


def _published_rows(study: HoistingStudy, cell: Cell) -> list[tuple[str, ...]]:
    if study.name in CELLS:
        published = CELLS[study.name][cell.value]
        return [(cell.name, "paper", "fusion", *_cells(published.keys), _number(published.mean), "")]
    condition = CONDITIONS[cell.name]
    return [
        (cell.name, "paper", method, "", "", "", _number(mean), f"{condition.seconds[method]:.3f}")
        for method, mean in condition.mean.items()
    ]


def _pairs_table(study: HoistingStudy) -> Table:
    title = "All pairs by refined, mm"
    table = new_table("Cell", *_ALL, numbers=_ALL, title=title)
    for cell in study.cells:
        results = study.of(cell, REFINED)
        seen = [error for r in results for error in r.seen]
        inferred = [error for r in results for error in r.inferred]
        covered = [value for r in results for value in r.covered]
        moves = [r.correction for r in results if r.correction is not None]
        table.add_row(
            cell.name,
            str(len(seen)),
            _number(_mean(seen)),
            _number(max(seen, default=None)),
            _number(_mean(inferred)),
            f"{100 * float(np.mean(covered)):.0f} %" if covered else "-",
            _number(_mean([move[0] for move in moves])),
            _number(_mean([move[1] for move in moves])),
            f"{_seconds(results):.3f}",
        )
    return table


def _times_faster(study: HoistingStudy) -> str:
    if not {REFINED, "fusion"} <= set(study.methods):
        return ""
    times = {m: float(np.median([r.seconds for r in study.results if r.method == m])) for m in (REFINED, "fusion")}
    ratio = times["fusion"] / times[REFINED]
    return f"refined takes {times[REFINED]:.3f} s a frame, fusion {times['fusion']:.3f} s: {ratio:.1f} times as long."


def hoisting_document(study: HoistingStudy) -> dict[str, Any]:
    """The numbers of a study; lengths in mm, times in s."""
    return {
        "synthetic": True,
        "study": study.name,
        "seed": study.seed,
        "scenes": study.scenes,
        "cells": [
            {
                "cell": cell.name,
                "published": CELLS[study.name][cell.value] if study.name in CELLS else CONDITIONS[cell.name],
                "measured": {
                    method: {"mean_key_error_mm": mean_key_error(study, cell, method), "frames": study.of(cell, method)}
                    for method in study.methods
                },
            }
            for cell in study.cells
        ],
    }


def _seconds(results: Sequence[FrameResult]) -> float:
    return float(np.median([result.seconds for result in results]))


def _mean(values: Sequence[float | None]) -> float | None:
    found = [value for value in values if value is not None]
    return float(np.mean(found)) if found else None


def _cells(keys: Keys) -> tuple[str, ...]:
    return tuple(_number(key) for key in keys)


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"
