"""What stands where it is not known how the column is turned: only what all candidates agree on."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from aadm_workbench.model import PointResult, Reason, SpacingResult, Verdict

AMBIGUOUS_POINT = Reason("assembly.turn_decides")


def agreed(verdicts: Iterable[Verdict]) -> Verdict:
    """The verdict of all candidates where they agree, else inconclusive; of none, not measured."""
    present = set(verdicts)
    if not present:
        return Verdict.NOT_MEASURED
    return present.pop() if len(present) == 1 else Verdict.INCONCLUSIVE


def agree_on_points(candidates: Sequence[Sequence[PointResult]]) -> tuple[PointResult, ...]:
    """The points as the first candidate has them, with the verdicts that all candidates agree on."""
    return tuple(
        point if len({other.verdict for other in same}) == 1 else _undecided_point(point)
        for point, same in zip(candidates[0], zip(*candidates, strict=True), strict=True)
    )


def agree_on_spacing(candidates: Sequence[Sequence[SpacingResult]]) -> tuple[SpacingResult, ...]:
    """The spacings as the first candidate has them, with the verdicts that all candidates agree on."""
    return tuple(
        spacing if len({other.verdict for other in same}) == 1 else _undecided_spacing(spacing)
        for spacing, same in zip(candidates[0], zip(*candidates, strict=True), strict=True)
    )


def _undecided_point(point: PointResult) -> PointResult:
    return replace(point, verdict=Verdict.INCONCLUSIVE, reason=Reason("said.of", what=point.label, why=AMBIGUOUS_POINT))


def _undecided_spacing(spacing: SpacingResult) -> SpacingResult:
    reason = Reason("said.between", first=spacing.between[0], second=spacing.between[1], why=AMBIGUOUS_POINT)
    return replace(spacing, verdict=Verdict.INCONCLUSIVE, reason=reason)
