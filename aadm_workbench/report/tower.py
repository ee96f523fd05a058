"""What a report shows of the tower: where tops come to, what to do, and where the next storey will find its bars.

Another room works it out (``aadm_workbench/stack/shown.py``); here is only what it is shown as.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from aadm_workbench.report.drawing.sketch import Sketch
from aadm_workbench.report.sheets.numbers import signed
from aadm_workbench.report.sheets.tables import Heading, Row, heading
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


_SETTING_OUT = (
    heading("column"),
    heading("grid"),
    Heading(phrase("stack.set_as"), "text"),
    Heading(phrase("stack.plan_x"), "mm"),
    Heading(phrase("stack.plan_y"), "mm"),
    Heading(phrase("stack.height"), "mm"),
    Heading(phrase("stack.yaw"), "deg"),
    heading("u", "mm"),
    Heading(phrase("stack.against"), "text"),
)


def setting_out_table(lines: Sequence[SettingOut], language: Language) -> tuple[tuple[Heading, ...], list[Row]]:
    """The sheet of the setting-out crew as a table in one language."""
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
