"""stack.html: one self-contained page in both languages, with a sheet for the setting-out crew of the next storey.

It has no script: the switch of the language is a pair of buttons of the page itself, and a Content-Security-Policy lets
nothing run. Names from models and jobs are escaped wherever they stand.
"""

from __future__ import annotations

import base64
import hashlib
import math
from importlib import import_module
from pathlib import Path
from typing import Any

from aadm_workbench.atomic import write_atomically
from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.report.pages.fonts import embedded_font_css
from aadm_workbench.report.pages.svg import svg_of, svg_styles
from aadm_workbench.report.sheets.numbers import signed
from aadm_workbench.report.words.labels import Language, Phrase, phrase, resource_folder, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages
from aadm_workbench.stack.result import Judged, StackPlan
from aadm_workbench.stack.shown import tower_shown
from aadm_workbench.stack.told import against, limit_reasons, member_reasons

_LANGUAGES: tuple[Language, Language] = ("en", "zh")


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
    try:
        jinja2: Any = import_module("jinja2")
    except ImportError as error:
        raise MissingDependencyError("jinja2", "stack.html") from error
    loader = jinja2.FileSystemLoader(resource_folder())
    environment = jinja2.Environment(loader=loader, autoescape=True, undefined=jinja2.StrictUndefined)
    template, context = environment.get_template("stack.html.j2"), _context(plan, language)
    folder = resource_folder()
    style = (
        "".join((folder / name).read_text(encoding="utf-8") for name in ("report.css", "tower.css", "stack.css"))
        + svg_styles()
    )
    plain = template.render(**context, style="", policy="")
    style = embedded_font_css(plain) + style
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    policy = f"default-src 'none'; style-src 'sha256-{digest}'; font-src data:; base-uri 'none'; form-action 'none'"
    text: str = template.render(**context, style=_raw(style), policy=policy)
    return text


def _raw(text: str) -> Any:
    """A text of this product's own that is not escaped: style, drawings whose labels are escaped already."""
    return import_module("markupsafe").Markup(text)


def _context(plan: StackPlan, language: Language) -> dict[str, object]:
    tower = tower_shown(plan)
    return {
        "plan": plan,
        "language": language,
        "languages": _LANGUAGES,
        "w": lambda name, **values: phrase(f"stack.{name}", **values),
        "word": phrase,
        "tower": tower,
        "plans": [(one, _raw(svg_of(one.sketch, label="plan", css_class="plan"))) for one in tower.plans],
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
