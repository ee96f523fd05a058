"""Plots of a method study, in the order of the paper's Figs. 10 and 11 (laboratory), 24 and 25 (field).

Four panels: diameter and adjacent spacing of the rebars, then of the sleeves. *Scatter*: the absolute error of every
feature by its number. *Box*: median, quartiles and whiskers (1.5 times the box) of each method, with the mean that the
paper reports for it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.errors import needed
from aadm_workbench.model import Array, Kind
from aadm_workbench.own_files import write_atomically
from aadm_workbench.twin.study.methods import MethodStudy
from aadm_workbench.twin.study.published import TABLES

_PANELS = (
    (Kind.REBAR, "diameter", "(a) rebar diameter"),
    (Kind.REBAR, "spacing", "(b) adjacent rebar spacing"),
    (Kind.SLEEVE, "diameter", "(c) sleeve diameter"),
    (Kind.SLEEVE, "spacing", "(d) adjacent sleeve spacing"),
)
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00")  # apart for colour-blind eyes, too
_DOTS_PER_INCH = 110  # readable on a screen


def require_matplotlib() -> None:
    """Say at once what to install.

    Raises
    ------
    MissingDependencyError
        Where Matplotlib is not installed.
    """
    with needed("matplotlib", "Plots of a study"):
        import matplotlib.figure  # noqa: F401


def write_plots(study: MethodStudy, folder: Path) -> tuple[Path, ...]:
    """Write ``SETTING-scatter.png`` and ``SETTING-box.png`` for each setting into a folder that exists.

    Raises
    ------
    MissingDependencyError
        Where Matplotlib is not installed.
    AadmError
        Where a file cannot be written.
    """
    require_matplotlib()
    paths = []
    for setting in study.settings:
        for name, draw in (("scatter", _scatter), ("box", _box)):
            paths.append(folder / f"{setting}-{name}.png")
            write_atomically(paths[-1], _picture(study, setting, draw))
    return tuple(paths)


def _picture(study: MethodStudy, setting: str, draw: Any) -> bytes:
    import io

    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.0, 7.5), layout="constrained")
    for axes, (kind, quantity, title) in zip(figure.subplots(2, 2).flat, _PANELS, strict=True):
        draw(axes, study, setting, kind, quantity)
        axes.set_title(title, fontsize=10)
        axes.set_ylabel("absolute error, mm")
        axes.set_ylim(bottom=0.0)
        axes.grid(axis="y", alpha=0.3)
    scenes = f"{study.scenes} scene{'' if study.scenes == 1 else 's'}"
    figure.suptitle(f"{setting} setting, {scenes}, seed {study.seed}; synthetic scans", fontsize=10)
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=_DOTS_PER_INCH, metadata={"Software": None})
    return picture.getvalue()


def _scatter(axes: Any, study: MethodStudy, setting: str, kind: Kind, quantity: str) -> None:
    for place, method in enumerate(study.methods):
        number, error = _errors(study, setting, method, kind, quantity)
        beside = 0.12 * (place - (len(study.methods) - 1) / 2)
        colour = _COLOURS[place % len(_COLOURS)]
        label = method if len(error) == 0 else f"{method}: mean {error.mean():.2f}, rms {_rms(error):.2f}"
        axes.plot(number + beside, error, ".", color=colour, markersize=4, alpha=0.7, label=label)
        if len(error):
            axes.axhline(error.mean(), color=colour, linewidth=0.8, linestyle="--")
    axes.set_xlabel("pair of neighbours" if quantity == "spacing" else kind.value)
    axes.legend(fontsize=7)


def _box(axes: Any, study: MethodStudy, setting: str, kind: Kind, quantity: str) -> None:
    samples = [_errors(study, setting, method, kind, quantity)[1] for method in study.methods]
    places = np.arange(len(samples)) + 1
    axes.boxplot(samples, positions=places, widths=0.55, flierprops={"markersize": 3})
    axes.set_xticks(places, study.methods)
    rows = {row.method: row for row in TABLES[setting].rows} if setting in TABLES else {}
    for place, method in zip(places, study.methods, strict=True):
        if method in rows:
            mean_mm = getattr(rows[method], f"{kind.value}_{quantity}_mm")[0]
            axes.plot(place, mean_mm, "D", color="#D55E00", markersize=5, label="mean in the paper")
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        axes.legend(handles[:1], labels[:1], fontsize=7)


def _errors(study: MethodStudy, setting: str, method: str, kind: Kind, quantity: str) -> tuple[Array, Array]:
    """Numbers (n,) from 1 on and absolute errors (n,) mm of what one method found in all scenes."""
    chosen = [m.comparison for m in study.measurements if (m.setting, m.method, m.kind) == (setting, method, kind)]
    rows = [
        (number, abs(error))
        for comparison in chosen
        for number, error in enumerate(
            (feature.diameter_error_mm for feature in comparison.features)
            if quantity == "diameter"
            else (spacing.error_mm for spacing in comparison.spacings),
            start=1,
        )
        if error is not None
    ]
    table = np.array(rows, np.float64).reshape(-1, 2)
    return table[:, 0], table[:, 1]


def _rms(error: Array) -> float:
    return float(np.sqrt((error**2).mean()))
