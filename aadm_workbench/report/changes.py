"""What changed between two inspections of a job: verdicts, columns, and points that moved beyond their uncertainty."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from aadm_workbench.model import WORST_FIRST, ColumnReport, JobReport, Kind, PointResult, Reason, Verdict

Trend: TypeAlias = Literal["worse", "better", "same"]

COVERAGE = 2.448
"""95 % of the differences of a point that did not move lie within this many standard uncertainties per axis of it:
sqrt(-2 ln 0.05), the Rayleigh law."""

UNKNOWN_U_MM = 0.1
"""Supposed of the difference where a report gives no uncertainty."""

_ORDER = (Verdict.PASS, Verdict.NOT_ASSESSED, *WORST_FIRST[-2::-1])  # what is no longer assessed got worse


@dataclass(frozen=True)
class PointChange:
    """A sleeve or bar whose place against the design differs by more than the two scans can differ by themselves.

    ``from_mm``, ``to_mm``: offset (dx, dy), measured minus design; None where it was not measured. ``u_mm``: standard
    uncertainty of the difference, per axis.
    """

    label: str
    from_mm: tuple[float, float] | None
    to_mm: tuple[float, float] | None
    moved_mm: float | None
    u_mm: float | None
    from_verdict: str
    to_verdict: str


@dataclass(frozen=True)
class ColumnChange:
    """A column that both reports hold, and what of it is different."""

    id: str
    from_verdict: str
    to_verdict: str
    from_goes_on: str
    to_goes_on: str
    from_largest_mm: float | None
    to_largest_mm: float | None
    points: tuple[PointChange, ...]
    new_reasons: tuple[str, ...]
    gone_reasons: tuple[str, ...]

    @property
    def trend(self) -> Trend:
        """Whether its verdict, or else whether it goes on, became worse or better."""
        for before, after in ((self.from_verdict, self.to_verdict), (self.from_goes_on, self.to_goes_on)):
            step = _ORDER.index(after) - _ORDER.index(before)
            if step:
                return "worse" if step > 0 else "better"
        return "same"

    @property
    def is_change(self) -> bool:
        """Whether anything is different that does not lie within the uncertainty of the scans."""
        return self.trend != "same" or bool(self.points)


@dataclass(frozen=True)
class Changes:
    """All differences; ``changed`` holds the columns with a change, the worse ones first.

    ``inputs``: what the two checks do not share (model, profile, decision), so that their numbers may differ for it.
    """

    new: tuple[str, ...]
    missing: tuple[str, ...]
    changed: tuple[ColumnChange, ...]
    unchanged: tuple[str, ...]
    inputs: tuple[str, ...]

    @property
    def any_worse(self) -> bool:
        """Whether some column became worse."""
        return any(change.trend == "worse" for change in self.changed)

    @property
    def any_change(self) -> bool:
        """Whether anything is different."""
        return bool(self.new or self.missing or self.changed)


def compare_reports(before: JobReport, after: JobReport) -> Changes:
    """What is different in the later of two reports."""
    first = {column.id: column for column in before.columns}
    second = {column.id: column for column in after.columns}
    both = [_compare(first[name], second[name]) for name in second if name in first]
    rank = {"worse": 0, "better": 1, "same": 2}
    return Changes(
        new=tuple(name for name in second if name not in first),
        missing=tuple(name for name in first if name not in second),
        changed=tuple(sorted((c for c in both if c.is_change), key=lambda change: rank[change.trend])),
        unchanged=tuple(change.id for change in both if not change.is_change),
        inputs=tuple(_inputs(before, after)),
    )


def _inputs(before: JobReport, after: JobReport) -> Iterator[str]:
    models = [(report.model or {}).get("sha256") for report in (before, after)]
    if models[0] != models[1]:
        yield Reason("report.models_differ")
    if before.profile != after.profile:
        yield Reason("report.tolerances_differ", before=before.profile.name, after=after.profile.name)
    for key, code in (("decision", "report.decision_differs"), ("method", "report.method_differs")):
        values = [report.job.get(key, "") for report in (before, after)]
        if values[0] != values[1]:
            yield Reason(code, before=values[0], after=values[1])


def _compare(before: ColumnReport, after: ColumnReport) -> ColumnChange:
    return ColumnChange(
        id=after.id,
        from_verdict=before.verdict,
        to_verdict=after.verdict,
        from_goes_on=before.goes_on,
        to_goes_on=after.goes_on,
        from_largest_mm=_largest_mm(before),
        to_largest_mm=_largest_mm(after),
        points=tuple(change for kind in Kind for change in _points(before.points(kind), after.points(kind))),
        new_reasons=tuple(reason for reason in after.reasons if reason not in before.reasons),
        gone_reasons=tuple(reason for reason in before.reasons if reason not in after.reasons),
    )


def _largest_mm(column: ColumnReport) -> float | None:
    pose = None if column.trial_assembly is None else column.trial_assembly.minimax
    return None if pose is None else pose.max_mm


def _points(before: Sequence[PointResult], after: Sequence[PointResult]) -> Iterator[PointChange]:
    first, second = ({point.label: point for point in points} for points in (before, after))
    for label in dict.fromkeys((*first, *second)):
        change = _point(label, first.get(label), second.get(label))
        if change is not None:
            yield change


def _point(label: str, before: PointResult | None, after: PointResult | None) -> PointChange | None:
    """What is different at one point; None where that lies within the uncertainty, or it was never measured."""
    start, end = (None if point is None else point.offset_mm for point in (before, after))
    verdicts = tuple(Verdict.NOT_ASSESSED if point is None else point.verdict for point in (before, after))
    if start is None or end is None:
        same = (start is None) is (end is None) and verdicts[0] == verdicts[1]
        return None if same else PointChange(label, start, end, None, None, *verdicts)
    moved_mm = math.hypot(end[0] - start[0], end[1] - start[1])
    parts = [point.u_mm for point in (before, after) if point is not None and point.u_mm is not None]
    u_mm = UNKNOWN_U_MM if len(parts) < 2 else math.hypot(*parts)
    if moved_mm <= COVERAGE * u_mm and verdicts[0] == verdicts[1]:
        return None
    return PointChange(label, start, end, moved_mm, u_mm, *verdicts)
