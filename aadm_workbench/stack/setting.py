"""What report.json and the model are told of the tower: the setting of columns, the property set AADM_Setting."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace

from aadm_workbench.model import SettingReport
from aadm_workbench.report.ifc.addition import Property, Scalar
from aadm_workbench.stack.result import Judged, StackedColumn, StackedMember, StackPlan

_LENGTH, _LABEL, _TEXT, _ANGLE = "IfcLengthMeasure", "IfcLabel", "IfcText", "IfcPlaneAngleMeasure"
_Told = Iterable[tuple[str, str, Scalar | None]]


def setting_properties(plan: StackPlan) -> dict[str, list[Property]]:
    """Properties by the GlobalIds of columns and beams; what is not known is left out, ``Reasons`` says why."""
    told = {one.measured.global_id: list(_column(one)) for one in plan.columns}
    told |= {member.global_id: list(_member(member)) for member in plan.members}
    return {
        global_id: [Property(name, measure, value) for name, measure, value in values if value is not None]
        for global_id, values in told.items()
        if global_id
    }


def setting_report(column: StackedColumn) -> SettingReport:
    """What report.json holds of a column's setting."""
    placed, top, advice = column.placed, column.top, column.advice
    found = SettingReport(column.basis)
    if placed is not None:
        dx, dy, _, _, _, yaw = placed.values.tolist()
        found = replace(found, foot_mm=(dx, dy), yaw_deg=math.degrees(yaw))
    if top is not None:
        limit = top.judged.limit
        found = replace(
            found,
            top_mm=top.offset_mm,
            top_u_mm=top.u_mm,
            top_limit_mm=None if limit is None else limit[1],
            top_verdict=top.judged.verdict,
        )
    if advice is not None:
        after = None if advice.top is None else advice.top.judged.value
        found = replace(found, set_pose=advice.set_pose, set_pose_top_mm=after)
    return found


def _column(column: StackedColumn) -> _Told:
    yield "Against", _LABEL, column.basis
    yield "Through", _LABEL, column.below
    yield "PoseFrom", _LABEL, column.origin
    if column.placed is not None:
        dx, dy, dz, _, _, yaw = column.placed.values.tolist()
        yield from (("SetX", _LENGTH, dx), ("SetY", _LENGTH, dy), ("SetZ", _LENGTH, dz))
        yield "SetTurn", _ANGLE, math.degrees(yaw)
    if column.top is not None:
        yield from (("TopX", _LENGTH, column.top.offset_mm[0]), ("TopY", _LENGTH, column.top.offset_mm[1]))
        yield from _judged("Top", column.top.judged)
    if column.advice is not None:
        dx, dy, yaw_deg = column.advice.set_pose
        yield from (("AimX", _LENGTH, dx), ("AimY", _LENGTH, dy), ("AimTurn", _ANGLE, yaw_deg))
    yield "Reasons", _TEXT, "; ".join(reason.en for reason in column.reasons) or None


def _member(member: StackedMember) -> _Told:
    yield "Columns", _TEXT, " - ".join(end or "?" for end in member.ends)
    yield "FoundBy", _TEXT, "; ".join(dict.fromkeys(why.en for why in member.why))
    yield "Verdict", _LABEL, member.verdict.value
    named = (("Span", member.span_mm), ("SeatA", member.seat_mm[0]), ("SeatB", member.seat_mm[1]))
    for name, judged in (*named, ("Fall", member.level_mm)):
        yield from _judged(name, judged)
    yield "Skew", _ANGLE, member.skew_deg.value
    yield "Reasons", _TEXT, "; ".join(reason.en for reason in member.reasons) or None


def _judged(name: str, judged: Judged) -> Iterator[tuple[str, str, Scalar | None]]:
    yield name, _LENGTH, judged.value
    yield f"{name}Uncertainty", _LENGTH, judged.u
    yield f"{name}Limit", _LENGTH, None if judged.limit is None else judged.limit[1]
    yield f"{name}Verdict", _LABEL, judged.verdict.value
    yield f"{name}Clause", _TEXT, judged.clause or None
