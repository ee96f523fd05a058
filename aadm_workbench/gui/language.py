"""The language of FreeCAD's window, for the sentences that come out of a check in English."""

from __future__ import annotations

import FreeCADGui

from aadm_workbench.model.reason import Language
from aadm_workbench.report.words.reasons import in_both_languages


def is_chinese() -> bool:
    """Whether the window speaks Chinese."""
    return str(FreeCADGui.getLocale()).startswith("Chinese")


def language() -> Language:
    """The language of the window, as far as the product speaks it."""
    return "zh" if is_chinese() else "en"


def in_language(sentence: str) -> str:
    """A sentence of a check in the language of the window."""
    return in_both_languages(sentence).in_language(language())
