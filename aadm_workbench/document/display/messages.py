"""Messages in FreeCAD's report view: sentences that say what to do, never a stack of frames."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.document.asking import LANGUAGES


def tell(text: str) -> None:
    """Something that was done."""
    FreeCAD.Console.PrintMessage(f"AADM: {text}\n")


def complain(text: str) -> None:
    """Something that could not be done, and what to do about it."""
    for in_language in LANGUAGES:
        text = in_language(text)
    FreeCAD.Console.PrintError(f"AADM: {text}\n")
