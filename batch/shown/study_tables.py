"""The tables of a method study: the paper's own with our rows beside it, and what the paper does not report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.table import Table

from aadm_workbench.model import Kind, Vector2
from aadm_workbench.twin.study.published import TABLES, PublishedRow
from aadm_workbench.twin.study.scores import Score, Spread, bare_seconds, scores

from .terminal import new_table

if TYPE_CHECKING:
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
