"""stack.html: one self-contained page in both languages, with a sheet for the setting-out crew of the next storey.

What such pages have in common is :mod:`aadm_workbench.report.pages.static_page`.
"""

from __future__ import annotations

import math
from pathlib import Path

from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.pages.static_page import drawn, static_page
from aadm_workbench.report.sheets.numbers import signed
from aadm_workbench.report.words.labels import Language, Phrase, phrase, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages
from aadm_workbench.stack.result import Judged, StackPlan
from aadm_workbench.stack.shown import tower_shown
from aadm_workbench.stack.told import against, limit_reasons, member_reasons


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
    tower = tower_shown(plan)
    return {
        "plan": plan,
        "w": lambda name, **values: phrase(f"stack.{name}", **values),
        "word": phrase,
        "tower": tower,
        "plans": [(one, drawn(one.sketch, "plan")) for one in tower.plans],
        "said": limit_reasons(plan),
        "of_members": member_reasons(plan),
        "sentence": in_both_languages,
        "against": against,
        "origin": lambda column: phrase(f"stack.{column.origin}") if column.origin else Phrase("–", "–"),
        "number": number,
        "signed": signed,
        "pair": lambda values: ", ".join(f"{value:+.2f}" for value in values),
        "limit": limit_text,
        "degrees": math.degrees,
        "verdict_words": verdict_words,
    }


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
