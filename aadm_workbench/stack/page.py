"""stack.html: one self-contained page in both languages, with a sheet for the setting-out crew of the next storey.

What such pages have in common is :mod:`aadm_workbench.report.pages.static_page`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from aadm_workbench.atomic import write_atomically
from aadm_workbench.model import SUMMED, Verdict
from aadm_workbench.report.pages.static_page import drawn, static_page
from aadm_workbench.report.words.labels import Language, Phrase, phrase, verdict_words
from aadm_workbench.stack.drawing import stack_drawings
from aadm_workbench.stack.result import Judged, StackedColumn, StackPlan
from aadm_workbench.stack.told import advice_phrase, by_reason, headline

_VERDICTS = tuple(verdict.value for verdict in (*SUMMED, Verdict.NOT_ASSESSED))


@dataclass(frozen=True)
class SettingOut:
    """A line for the setting-out crew: the bars in the head of a column, mm and degrees, column frame."""

    id: str
    grid: str
    values: tuple[str, str, str, str]
    u: str
    against: Phrase


def write_stack_page(plan: StackPlan, path: Path, language: Language = "en") -> None:
    """Write stack.html, whole or not at all; ``language`` is the one that it opens in.

    Raises
    ------
    MissingDependencyError
        Without the packages jinja2 and fonttools.
    AadmError
        Where the file cannot be written.
    """
    write_atomically(path, stack_page(plan, language).encode("utf-8", errors="replace"))


def stack_page(plan: StackPlan, language: Language = "en") -> str:
    """The document; the same plan gives the same text."""
    return static_page("stack.html.j2", _context(plan), language, "stack.html")


def _context(plan: StackPlan) -> dict[str, object]:
    return {
        "plan": plan,
        "w": lambda name, **values: phrase(f"stack.{name}", **values),
        "word": phrase,
        "headline": headline(plan),
        "is_relative": any(column.basis == "bars" for column in plan.columns),
        "drawings": [(one, drawn(one.sketch, "plan")) for one in stack_drawings(plan)],
        "advised": [(column, advice_phrase(column)) for column in plan.columns if column.advice is not None],
        "said": by_reason(plan),
        "setting_out": list(_setting_out(plan.columns)),
        "aim": lambda pose: ", ".join(number(value, 2 + (k == 2)).lstrip("+") for k, value in enumerate(pose)),
        "legend": list(_legend(plan)),
        "against": against,
        "origin": lambda column: phrase(f"stack.{column.origin}") if column.origin else Phrase("–", "–"),
        "number": number,
        "pair": lambda values: ", ".join(f"{value:+.2f}" for value in values),
        "limit": limit_text,
        "degrees": math.degrees,
        "verdict_words": verdict_words,
    }


def _legend(plan: StackPlan) -> Iterable[str]:
    """The verdicts that the drawing shows."""
    shown = {(Verdict.NOT_MEASURED if one.top is None else one.top.judged.verdict).value for one in plan.columns}
    shown |= {judged.verdict.value for member in plan.members for judged in (member.span_mm, *member.seat_mm)}
    return (verdict for verdict in _VERDICTS if verdict in shown)


def against(column: StackedColumn) -> Phrase:
    """What the numbers of a column are told against."""
    if column.basis == "storey_below":
        return phrase("stack.storey_below", below=column.below)
    return phrase(f"stack.{column.basis}")


def number(value: float | None, decimals: int = 2, *, sign: bool = True) -> str:
    """``+0.31``; a dash where there is none."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value:+.{decimals}f}" if sign else f"{value:.{decimals}f}"
    return text.replace("-", "+") if float(text) == 0.0 else text


def limit_text(judged: Judged) -> str:
    """``±10``, ``8``; with the clause where the text asks for it, a dash where no rule limits it."""
    if judged.limit is None:
        return "–"
    lower, upper = judged.limit
    return f"±{upper:g}" if lower == -upper else f"{upper:g}" if lower == 0.0 else f"{lower:+g} … {upper:+g}"


def _setting_out(columns: Iterable[StackedColumn]) -> Iterable[SettingOut]:
    for column in columns:
        bars = column.next_bars
        if bars is None:
            continue
        dx, dy, dz = (number(value, 1) for value in bars.values[:3].tolist())
        u_mm = math.sqrt(float(bars.covariance[0, 0] + bars.covariance[1, 1]) / 2.0)
        turn = number(math.degrees(bars.values[5]))
        yield SettingOut(
            column.measured.id, column.measured.grid or "–", (dx, dy, dz, turn), f"{u_mm:.1f}", against(column)
        )
