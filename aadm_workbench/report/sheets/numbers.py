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
