"""Self-contained pages without a script, in both languages: the switch of the language is a pair of buttons.

A Content-Security-Policy lets nothing run. What comes from models and jobs is escaped wherever it stands.
"""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping
from importlib import import_module
from typing import Any

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.report.drawing.sketch import Sketch
from aadm_workbench.report.pages.fonts import embedded_font_css
from aadm_workbench.report.pages.svg import svg_of, svg_styles
from aadm_workbench.report.words.labels import Language, resource_folder

_LANGUAGES: tuple[Language, Language] = ("en", "zh")
_STYLES = ("report.css", "tower.css", "stack.css")


def static_page(template: str, context: Mapping[str, object], language: Language, needed_for: str) -> str:
    """The text of a page; the same context gives the same text.

    Parameters
    ----------
    template
        Its file in ``resources/report``; it is given ``style``, ``policy``, ``language`` and ``languages``, too.
    language
        The one that the page opens in.
    needed_for
        What the page is called where a package is missing.

    Raises
    ------
    MissingDependencyError
        Without the packages jinja2 and fonttools.
    """
    try:
        jinja2: Any = import_module("jinja2")
    except ImportError as error:
        raise MissingDependencyError("jinja2", needed_for) from error
    folder = resource_folder()
    loader = jinja2.FileSystemLoader(folder)
    environment = jinja2.Environment(loader=loader, autoescape=True, undefined=jinja2.StrictUndefined)
    given = {**context, "language": language, "languages": _LANGUAGES}
    page = environment.get_template(template)
    style = "".join((folder / name).read_text(encoding="utf-8") for name in _STYLES) + svg_styles()
    style = embedded_font_css(page.render(**given, style="", policy="")) + style
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    policy = f"default-src 'none'; style-src 'sha256-{digest}'; font-src data:; base-uri 'none'; form-action 'none'"
    text: str = page.render(**given, style=_unescaped(style), policy=policy)
    return text


def drawn(sketch: Sketch, label: str) -> Any:
    """A sketch for a template; ``label`` is what a screen reader says of it."""
    return _unescaped(svg_of(sketch, label=label, css_class="plan"))


def _unescaped(text: str) -> Any:
    """A text of this product's own that is not escaped: style, drawings whose labels are escaped already."""
    return import_module("markupsafe").Markup(text)
