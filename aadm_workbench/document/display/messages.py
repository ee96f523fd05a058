"""Messages in FreeCAD's report view: sentences that say what to do, never a stack of frames."""

from __future__ import annotations

import FreeCAD


def tell(text: str) -> None:
    """Something that was done."""
    FreeCAD.Console.PrintMessage(f"AADM: {text}\n")


def complain(text: str) -> None:
    """Something that could not be done, and what to do about it."""
    FreeCAD.Console.PrintError(f"AADM: {text}\n")
