"""The words of the reports, in English and Chinese; ``resources/report/words*.toml`` hold them all."""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from aadm_workbench.model import reason  # which loads numpy: aadm doctor speaks without it

Language: TypeAlias = "reason.Language"

SIGN = {"pass": "✓", "fail": "✗", "inconclusive": "?", "not_measured": "–", "error": "!", "not_assessed": "○"}
"""A sign beside each verdict, so that nothing depends on colour."""

COLOUR = {
    "pass": "#00795a",
    "fail": "#c03a00",
    "inconclusive": "#9a6700",
    "not_measured": "#5b6470",
    "error": "#a0307c",
    "not_assessed": "#5b6470",
}
"""Text colours after the palette of Okabe and Ito, darkened to 4.5 : 1 on white: told apart by the colour-blind too."""

INK, FAINT, HEAD, MOVE, WARN = "#1d2730", "#55606b", "#1f3a4d", "#0b5394", "#a33000"
"""Text, what is said beside it, heads of tables, what is to be moved, what to look at: on every kind of page."""


class Phrase(NamedTuple):
    """One text in both languages."""

    en: str
    zh: str

    def in_language(self, language: Language) -> str:
        """The text in one of them."""
        return self.en if language == "en" else self.zh

    def filled(self, **values: object) -> Phrase:
        """With its ``{places}`` filled in."""
        return Phrase(self.en.format(**values), self.zh.format(**values))


@cache
def all_words() -> dict[str, Phrase]:
    """Every text by its name, ``verdict.pass``."""
    sections: dict[str, dict[str, list[str]]] = {}
    for path in sorted(resource_folder().glob("words*.toml")):
        sections |= tomllib.loads(path.read_text(encoding="utf-8"))
    return {
        f"{section}.{name}": Phrase(english, chinese)
        for section, texts in sections.items()
        for name, (english, chinese) in texts.items()
    }


def phrase(name: str, /, **values: object) -> Phrase:
    """One text in both languages by its name, its ``{places}`` filled in."""
    found = all_words()[name]
    return found.filled(**values) if values else found


def told(name: Phrase, value: object) -> Phrase:
    """``Goes on: fail``, with the colon of each language."""
    known = value if isinstance(value, Phrase) else Phrase(str(value), str(value))
    colon = phrase("ui.colon")
    return Phrase(f"{name.en}{colon.en}{known.en}", f"{name.zh}{colon.zh}{known.zh}")


def rule_words(name: str) -> Phrase:
    """The name of a tolerance rule, or of its severity, in words; a profile's own names as they are, but for ``_``."""
    shown = name.replace("_", " ")
    return all_words().get(f"rule.{name}", Phrase(shown, shown))


def profile_words(name: str, title: str) -> Phrase:
    """The title of a tolerance profile; that of a profile of people's own stays as it is, whatever its name."""
    known = all_words().get(f"profile.{name}")
    return known if known is not None and known.en == title else Phrase(title, title)


def verdict_words(verdict: str, language: Language) -> str:
    """A verdict as people read it: ``✗ fail``."""
    return f"{SIGN[verdict]} {all_words()[f'verdict.{verdict}'].in_language(language)}"


def resource_folder() -> Path:
    """Where the templates and texts of the reports lie."""
    return Path(__file__).resolve().parents[2] / "resources" / "report"
