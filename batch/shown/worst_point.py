"""The comparison with a limit that decided a column's verdict: what its line in a table names."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from aadm_workbench.model import ColumnReport, SpacingResult, Verdict


@dataclass(frozen=True)
class Comparison:
    """A measured value, mm, and its limit; ``point`` is a label, or two of them for what is between two points."""

    point: str
    value_mm: float | None
    limit_mm: float | None
    verdict: Verdict
    reason: str = ""

    @property
    def ratio(self) -> float:
        """Share of the limit that is used up; below zero where there is nothing to compare."""
        if self.value_mm is None or not self.limit_mm:
            return -1.0
        return self.value_mm / self.limit_mm

    def in_words(self) -> str:
        """``2.41 / 2 mm``, measured over limit."""
        if self.value_mm is None:
            return ""
        limit = "no limit" if self.limit_mm is None else f"{self.limit_mm:g} mm"
        return f"{self.value_mm:.2f} / {limit}"


def worst_comparison(column: ColumnReport) -> Comparison | None:
    """Of all comparisons that came to the column's own verdict the one nearest to its limit, or furthest beyond.

    Where none came to it (a collision, an orientation that is open), of all there are. None where nothing was
    compared.
    """
    every = list(_comparisons(column))
    deciding = [comparison for comparison in every if comparison.verdict is column.verdict]
    return max(deciding or every, key=lambda comparison: comparison.ratio, default=None)


def _comparisons(column: ColumnReport) -> Iterator[Comparison]:
    for group in (column.sleeves, column.rebars):
        if group is not None:
            for point in group.points:
                yield Comparison(point.label, point.deviation_mm, point.limit_mm, point.verdict, point.reason)
            for pair in group.spacing:
                label = "-".join(pair.between)
                yield Comparison(label, pair.deviation_mm, _limit_on_its_side(pair), pair.verdict, pair.reason)
    trial = column.trial_assembly
    pose = None if trial is None else trial.best or trial.minimax
    if pose is not None:
        for one in pose.pairs:
            yield Comparison(f"{one.sleeve}/{one.rebar}", one.distance_mm, one.limit_mm, one.verdict, one.reason)


def _limit_on_its_side(pair: SpacingResult) -> float | None:
    """The lower limit of what is measured too short, the upper one of what is too long."""
    if pair.limit_mm is None or pair.deviation_mm is None:
        return None
    return pair.limit_mm[0 if pair.deviation_mm < 0.0 else 1]
