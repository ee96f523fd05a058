"""A stack plan as ``aadm stack --json`` prints it: mm and degrees; keys may be added, these stay."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array
from aadm_workbench.stack.result import Advice, Judged, Neighbours, StackedColumn, StackedMember, StackPlan, Top
from aadm_workbench.stack.torsor import Torsor

SCHEMA = 1
"""Of the document."""

_TO_DEGREES = np.array([1.0, 1.0, 1.0, *(180.0 / np.pi,) * 3])
"""From mm and radians to mm and degrees."""

_NAMES = ("dx_mm", "dy_mm", "dz_mm", "rx_deg", "ry_deg", "yaw_deg")


def stack_document(plan: StackPlan) -> dict[str, object]:
    """The plan as plain values; what is not known is null, and reasons say why."""
    return {
        "schema": SCHEMA,
        "columns": [_column(column) for column in plan.columns],
        "members": [_member(member) for member in plan.members],
        "neighbours": [_neighbours(pair) for pair in plan.neighbours],
        "not_found": [{"about": one.about, "reason": one.reason.en} for one in plan.not_found],
        "model": plan.model,
    }


def _column(column: StackedColumn) -> dict[str, object]:
    measured, advice = column.measured, column.advice
    return {
        "id": measured.id,
        "global_id": measured.global_id,
        "storey": measured.storey,
        "grid": measured.grid,
        "against": column.basis,
        "through": column.below,
        "from": column.origin,
        "height_mm": column.height_mm,
        "set": None if column.placed is None else _torsor(column.placed),
        "top": None if column.top is None else _top(column.top),
        "play": measured.window,
        "set_pose": None if advice is None else list(advice.set_pose),
        "advice": None if advice is None else _advice(advice),
        "next_bars": None if column.next_bars is None else _torsor(column.next_bars),
        "reasons": [reason.en for reason in column.reasons],
    }


def _torsor(torsor: Torsor) -> dict[str, object]:
    """``cov`` is in the order of the six, in their units."""
    values = dict(zip(_NAMES, (torsor.values * _TO_DEGREES).tolist(), strict=True))
    return {**values, "cov": _plain(torsor.covariance * np.outer(_TO_DEGREES, _TO_DEGREES))}


def _plain(covariance: Array) -> list[list[float | None]]:
    return [[value if np.isfinite(value) else None for value in row] for row in covariance.tolist()]


def _top(top: Top) -> dict[str, object]:
    judged = _judged(top.judged)
    return {"offset_mm": list(top.offset_mm), "u_mm": top.u_mm, "length_mm": judged.pop("value"), **judged}


def _advice(advice: Advice) -> dict[str, object]:
    return {
        "from_trial": dict(zip(("dx_mm", "dy_mm", "yaw_deg"), advice.from_trial, strict=True)),
        "top": None if advice.top is None else _top(advice.top),
    }


def _member(member: StackedMember) -> dict[str, object]:
    return {
        "id": member.id,
        "global_id": member.global_id,
        "ends": list(member.ends),
        "found_by": [why.en for why in member.why],
        "span_mm": _judged(member.span_mm),
        "seat_mm": [_judged(seat) for seat in member.seat_mm],
        "skew_deg": _judged(member.skew_deg),
        "level_mm": _judged(member.level_mm),
    }


def _neighbours(pair: Neighbours) -> dict[str, object]:
    return {"column": pair.column, "members": list(pair.members), "flush_mm": _judged(pair.flush_mm)}


def _judged(judged: Judged) -> dict[str, object]:
    return {
        "value": judged.value,
        "u": judged.u,
        "limit": None if judged.limit is None else list(judged.limit),
        "clause": judged.clause or None,
        "verdict": judged.verdict.value,
        "reason": None if judged.reason is None else judged.reason.en,
    }
