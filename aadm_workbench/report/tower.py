"""What a report shows of the tower: where tops come to, what to do, and where the next storey will find its bars.

Another room works it out (``aadm_workbench/stack/shown.py``); here is only what it is shown as.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from aadm_workbench.report.drawing.sketch import Sketch
from aadm_workbench.report.sheets.numbers import signed
from aadm_workbench.report.sheets.tables import Heading, Row, Table, heading
from aadm_workbench.report.words.labels import Language, Phrase, phrase


@dataclass(frozen=True)
class TowerPlan:
    """One storey; ``scale`` is how many times longer than they are the arrows are drawn, beside the plan."""

    storey: str
    scale: int
    sketch: Sketch


@dataclass(frozen=True)
class ToDo:
    """What is to be done with some columns: their names, the sentence, and ``set_pose`` for the job, if any."""

    names: str
    said: Phrase
    set_pose: str = ""


@dataclass(frozen=True)
class SettingOut:
    """A line for the next storey's crew: where the bars in the head of a column will stand off their design place.

    ``offset_mm`` (dx, dy) is in the axes of the plan, of the column where it has no place in a plan; ``set_as`` is how
    the column must have been set for that.
    """

    id: str
    grid: str
    set_as: Phrase
    offset_mm: tuple[float, float]
    turn_deg: float
    height_mm: float
    u_mm: float
    against: Phrase


@dataclass(frozen=True)
class TowerShown:
    """The tower as reports show it.

    Parameters
    ----------
    headline, mood
        What comes of it in one line; ``good``, ``bad`` or neither.
    warning
        What readers must know before anything else, if there is such a thing.
    to_do
        By column, what can be gained first.
    open_ends
        Of columns and beams, why something is beyond a limit, not settled or not said.
    legend
        The verdicts that the plans show.
    """

    headline: Phrase
    mood: str
    warning: Phrase | None
    to_do: tuple[ToDo, ...]
    open_ends: tuple[tuple[str, Phrase], ...]
    plans: tuple[TowerPlan, ...]
    legend: tuple[str, ...]
    setting_out: tuple[SettingOut, ...]


_SET_POSE = Phrase("set_pose", "set_pose")  # the job's own word, to be copied
_SETTING_OUT = (
    heading("column"),
    heading("grid"),
    Heading(phrase("stack.set_as"), "text"),
    Heading(phrase("stack.plan_x"), "mm_signed"),
    Heading(phrase("stack.plan_y"), "mm_signed"),
    Heading(phrase("stack.height"), "mm_signed"),
    Heading(phrase("stack.yaw"), "deg"),
    heading("u", "mm"),
    Heading(phrase("stack.against"), "text"),
)
_TO_DO = (heading("column"), Heading(phrase("stack.kind"), "text"), heading("note"), Heading(_SET_POSE, "text"))


def setting_out_table(lines: Sequence[SettingOut], language: Language) -> tuple[tuple[Heading, ...], list[Row]]:
    """The sheet of the setting-out crew as a table in one language, its numbers as a crew reads them."""
    rows: list[Row] = [
        (
            line.id,
            line.grid,
            line.set_as.in_language(language),
            *(signed(value, 1) for value in (*line.offset_mm, line.height_mm)),
            signed(line.turn_deg),
            f"{line.u_mm:.1f}",
            line.against.in_language(language),
        )
        for line in lines
    ]
    return _SETTING_OUT, rows


def tower_tables(tower: TowerShown, language: Language) -> list[Table]:
    """The tower as sheets: what to do and what is not settled, and where the next storey will find its bars."""
    to_do, open_ends = (phrase(f"stack.{name}").in_language(language) for name in ("to_do", "open_ends"))
    first = (
        tower.headline
        if tower.warning is None
        else Phrase(f"{tower.headline.en} {tower.warning.en}", f"{tower.headline.zh}{tower.warning.zh}")
    )
    rows: list[Row] = [
        ("", "", first.in_language(language), ""),
        *((one.names, to_do, one.said.in_language(language), one.set_pose) for one in tower.to_do),
        *((name, open_ends, reason.in_language(language), "") for name, reason in tower.open_ends),
    ]
    tables = [Table(phrase("stack.sheet"), _TO_DO, tuple(rows))]
    if tower.setting_out:
        lines = tuple(_setting_out_rows(tower.setting_out, language))
        tables.append(Table(phrase("stack.setting_out_sheet"), _SETTING_OUT, lines))
    return tables


def _setting_out_rows(lines: Sequence[SettingOut], language: Language) -> Iterator[Row]:
    """Rows under the headings of the setting-out crew, numbers as numbers."""
    for line in lines:
        first = (line.id, line.grid, line.set_as.in_language(language))
        moved = (*line.offset_mm, line.height_mm, line.turn_deg, line.u_mm)
        yield (*first, *moved, line.against.in_language(language))
