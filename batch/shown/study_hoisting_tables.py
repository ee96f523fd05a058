"""The tables of a hoisting study: the paper's own numbers with ours beside them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from aadm_workbench.twin.study.hoisting import REFINED, Cell, FrameResult
from aadm_workbench.twin.study.hoisting_plots import mean_key_error
from aadm_workbench.twin.study.hoisting_tables import CELLS, CONDITIONS, TITLES, Keys

from .terminal import new_table

if TYPE_CHECKING:
    from aadm_workbench.twin.study.hoisting import HoistingStudy

_KEYS = ("Left", "Middle", "Right", "Mean")
_ALL = ("Seen pairs", "Mean seen", "Max seen", "Mean inferred", "In 95 %", "Move mm", "Turn deg", "Time s")


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
