"""What of a column fails by itself, and what fails only because something else does.

One bar that stands 7 mm off lets its neighbours' spacing fail, and least squares and minimax spread its error over
pairs that are right. Whoever reads that twelve pairs fail looks for twelve errors; there is one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from aadm_workbench.model import (
    ColumnReport,
    GroupReport,
    PairResult,
    PointResult,
    Reason,
    SpacingResult,
    Verdict,
)
from aadm_workbench.model.reason import listed

_FAILING = (Verdict.FAIL, Verdict.INCONCLUSIVE)
_MOST_NAMED = 4  # of what follows: more is not read, and the tables have it all


@dataclass(frozen=True)
class Blame:
    """Labels of what is to be put right, the bar or sleeve in the way first, and what fails only because of it.

    ``follows`` holds labels of points, ``R4–R5`` of a spacing, ``S1/R1`` of a pair, in the order of the report.
    """

    culprits: tuple[str, ...] = ()
    follows: tuple[str, ...] = ()


def blame_of(column: ColumnReport) -> Blame:
    """Whom the check blames in a column, and what follows from that."""
    trial = column.trial_assembly
    in_the_way = () if trial is None or trial.verdict is not Verdict.FAIL else trial.in_the_way
    culprits, follows = dict.fromkeys(in_the_way), list[str]()
    for group in column.groups.values():
        failing = sorted((one for one in group.points if one.verdict in _FAILING), key=_worst_first)
        own = _own(column, group, {point.label for point in failing}, in_the_way)
        culprits |= dict.fromkeys(point.label for point in failing if point.label in own)
        follows += [point.label for point in group.points if point.verdict in _FAILING and point.label not in own]
        follows += [name_of(one) for one in group.spacing if one.verdict in _FAILING and own & {*one.between}]
    # Without advice nobody knows that the pairs would be right once the culprit is.
    if in_the_way:
        pairs = [pair for pair in column.pairs if pair.verdict in _FAILING]
        follows += [name_of(pair) for pair in pairs if not {pair.sleeve, pair.rebar} & {*in_the_way}]
    return Blame(tuple(culprits), tuple(follows))


def _own(column: ColumnReport, group: GroupReport, failing: set[str], in_the_way: tuple[str, ...]) -> set[str]:
    """Labels of the points of a group that are off by themselves: those blamed, else all that fail.

    Where bars are to be bent, those that would still fail after it are, and those to be bent.
    """
    if group.blamed:
        return {*group.blamed}
    bent = {*in_the_way} & {point.label for point in group.points}
    repair = column.repair
    if group is column.sleeves or not bent or repair is None or repair.after is None:
        return bent | failing
    return bent | (failing & {*repair.still_fails})


def _worst_first(point: PointResult) -> float:
    return -(point.deviation_mm or 0.0)


def name_of(one: PointResult | SpacingResult | PairResult) -> str:
    """``R5``, ``R4–R5``, ``S1/R1``."""
    if isinstance(one, PointResult):
        return one.label
    return "–".join(one.between) if isinstance(one, SpacingResult) else f"{one.sleeve}/{one.rebar}"


def told_once(column: ColumnReport) -> ColumnReport:
    """The column, whose reasons say of what is blamed what it is, and name in one sentence what follows from it."""
    blame = blame_of(column)
    follows, groups = {*blame.follows}, column.groups.values()
    judged: list[PointResult | SpacingResult | PairResult] = [*column.pairs]
    for group in groups:
        judged += [*group.points, *group.spacing]
    merged = {one.reason for one in judged if one.reason and name_of(one) in follows} & {*column.reasons}
    if not merged:
        return column
    kept = [reason for reason in column.reasons if reason not in merged]
    said = Reason("assembly.follows", culprits=blame.culprits, what=listed(blame.follows, _MOST_NAMED))
    return replace(column, reasons=(*kept, said))
