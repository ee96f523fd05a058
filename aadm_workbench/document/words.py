"""Verdicts and lengths as people read them: in their language, in the unit that they have set FreeCAD to."""

from __future__ import annotations

import math

import FreeCAD

translate = FreeCAD.Qt.translate

_FINEST_MM = 0.01
"""Scans do not tell less, so nothing is shown with more decimals than this needs."""


def in_words(verdict: str) -> str:
    """A verdict in the user's language."""
    words = {
        "pass": translate("AADM", "pass"),
        "fail": translate("AADM", "fail"),
        "inconclusive": translate("AADM", "inconclusive"),
        "not_measured": translate("AADM", "not measured"),
        "error": translate("AADM", "error"),
        "not_assessed": translate("AADM", "not assessed"),
    }
    return words.get(verdict, verdict or translate("AADM", "not checked"))


def length_text(value_mm: float | None, *, signed: bool = False) -> str:
    """A length in the unit that FreeCAD is set to, to about 0.01 mm; a dash for none.

    One unit for all: FreeCAD's own text of a quantity goes over to µm below 0.1 mm, which is hard to compare.
    """
    if value_mm is None or not math.isfinite(value_mm):
        return "–"
    _, mm_in_unit, unit = FreeCAD.Units.Quantity(1.0, FreeCAD.Units.Length).getUserPreferred()
    if not mm_in_unit or unit in {"µm", "nm"} or mm_in_unit > 1000:
        mm_in_unit, unit = 1.0, "mm"
    decimals = max(0, math.ceil(math.log10(mm_in_unit / _FINEST_MM) - 1e-9))
    return f"{value_mm / mm_in_unit:{'+' if signed else ''}.{decimals}f} {unit}"
