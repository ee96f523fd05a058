"""Numbers as reports print them: decimals by what they are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from aadm_workbench.report.sheets.tables import CellKind

_DECIMALS: dict[CellKind, int] = {"mm": 2, "mm_signed": 2, "mm_fine": 3, "deg": 2, "ratio": 2, "count": 0}


def is_number(kind: CellKind) -> bool:
    """Whether cells of a kind are set flush right."""
    return kind == "share" or kind in _DECIMALS


def number_text(value: float | int | str, kind: CellKind) -> str:
    """``2.41``, ``+0.31``, ``0.054``, ``95.0 %``; never a minus before a zero."""
    if isinstance(value, str):
        return value
    if kind == "share":
        return f"{100.0 * value:.1f} %"
    if kind == "mm_signed":
        return signed(value)
    text = f"{value:.{_DECIMALS.get(kind, 2)}f}"
    return text.removeprefix("-") if float(text) == 0.0 else text


def number_texts(values: Sequence[float | int | str | None], kind: CellKind) -> list[str]:
    """The same of the cells of a column, empty where there is none: a thousand columns have half a million."""
    if kind == "share" or any(isinstance(value, str) for value in values):
        return ["" if value is None or value == "" else number_text(value, kind) for value in values]
    sign, decimals = ("+", 2) if kind == "mm_signed" else ("", _DECIMALS.get(kind, 2))
    form, zero = f"%{sign}.{decimals}f", f"{0.0:.{decimals}f}"
    texts = ["" if value is None else form % value for value in values]
    below_zero = f"-{zero}"
    return [f"{sign}{zero}" if text == below_zero else text for text in texts] if below_zero in texts else texts


def signed(value: float, decimals: int = 2) -> str:
    """``+0.31``."""
    text = f"{value:+.{decimals}f}"
    return text.replace("-", "+") if float(text) == 0.0 else text


def pose_text(pose: Sequence[float]) -> str:
    """dx, dy mm and yaw degrees as a job has them: ``[1.20, -0.40, 0.050]``."""
    dx, dy, yaw_deg = (
        signed(value, decimals).removeprefix("+") for value, decimals in zip(pose, (2, 2, 3), strict=True)
    )
    return f"[{dx}, {dy}, {yaw_deg}]"
