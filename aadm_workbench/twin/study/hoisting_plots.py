"""Plots of a hoisting study, after the paper's Figs. 16 to 19 (errors over a parameter), 20 and 21 (methods, times)."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.own_files import write_atomically
from aadm_workbench.twin.study.hoisting import REFINED, Cell, HoistingStudy
from aadm_workbench.twin.study.hoisting_tables import CELLS, CONDITIONS, TITLES
from aadm_workbench.twin.study.plots import require_matplotlib

_COLOURS = {REFINED: "#0072B2", "fusion": "#D55E00", "pointcloud": "#009E73", "image": "#CC79A7"}
_LIMIT_MM = 3.0  # GB/T 51231-2016, 10.4


def write_hoisting_plots(study: HoistingStudy, folder: Path) -> tuple[Path, ...]:
    """Write the plots of a study into a folder that exists.

    Raises
    ------
    MissingDependencyError
        Where Matplotlib is not installed.
    AadmError
        Where a file cannot be written.
    """
    require_matplotlib()
    drawn = [("errors", _errors if study.name in CELLS else _conditions), ("times", _times)]
    paths = []
    for name, draw in drawn:
        paths.append(folder / f"{study.name}-{name}.png")
        write_atomically(paths[-1], _picture(study, draw))
    return tuple(paths)


def mean_key_error(study: HoistingStudy, cell: Cell, method: str) -> float | None:
    """Mean error, mm, over the key pairs of all scenes that were found; None where none was."""
    found = [error for result in study.of(cell, method) for error in result.keys if error is not None]
    return float(np.mean(found)) if found else None


def _picture(study: HoistingStudy, draw: Any) -> bytes:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    axes = figure.subplots()
    draw(axes, study)
    axes.set_ylim(bottom=0.0)
    axes.grid(axis="y", alpha=0.3)
    axes.legend(fontsize=8)
    scenes = f"{study.scenes} scene{'' if study.scenes == 1 else 's'} a cell, seed {study.seed}"
    axes.set_title(f"{TITLES[study.name]}; {scenes}; synthetic frames", fontsize=10)
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=110, metadata={"Software": None})
    return picture.getvalue()


def _errors(axes: Any, study: HoistingStudy) -> None:
    values = [cell.value for cell in study.cells]
    for method in study.methods:
        means = [mean_key_error(study, cell, method) for cell in study.cells]
        heights = [np.nan if mean is None else mean for mean in means]
        axes.plot(values, heights, "o-", color=_COLOURS.get(method), label=f"here, {method}")
    published = CELLS[study.name]
    for place, key in enumerate(("left", "middle", "right")):
        heights = [np.nan if (e := published[value].keys[place]) is None else e for value in values]
        axes.plot(values, heights, "s--", color="0.55", markersize=3, linewidth=0.8, label=f"paper, {key}")
    axes.axhline(_LIMIT_MM, color="0.3", linewidth=0.8)
    axes.set_xlabel(TITLES[study.name].partition(", ")[2])
    axes.set_ylabel("error of the distance, mm")


def _conditions(axes: Any, study: HoistingStudy) -> None:
    width = 0.8 / (2 * len(study.methods))
    for place, method in enumerate(study.methods):
        at = np.arange(len(study.cells)) + 2 * place * width
        here = [mean_key_error(study, cell, method) or 0.0 for cell in study.cells]
        paper = [CONDITIONS[cell.name].mean.get(method, 0.0) for cell in study.cells]
        axes.bar(at, here, width, color=_COLOURS.get(method), label=f"here, {method}")
        axes.bar(at + width, paper, width, color=_COLOURS.get(method), alpha=0.35)
    axes.axhline(_LIMIT_MM, color="0.3", linewidth=0.8)
    axes.set_xticks(np.arange(len(study.cells)) + 0.4, [cell.name for cell in study.cells], fontsize=8)
    axes.set_ylabel("mean error of the keys, mm (pale: the paper)")


def _times(axes: Any, study: HoistingStudy) -> None:
    for method in study.methods:
        medians = [float(np.median([r.seconds for r in study.of(cell, method)])) for cell in study.cells]
        axes.plot(np.arange(len(medians)), medians, "o-", color=_COLOURS.get(method), label=method)
    axes.set_xticks(np.arange(len(study.cells)), [cell.name for cell in study.cells], fontsize=8)
    axes.set_ylabel("median time of a frame in memory, s")
