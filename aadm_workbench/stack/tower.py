"""Storey by storey: where the bars stand, where the column comes to stand on them, where its top is then.

ξ_top = A(H) ξ,  Σ_top = A Σ Aᵀ,  and for the bars of the next storey Σ + Q: F sets the tilt to zero where braces plumb
each column anew, and Q is what setting adds (:mod:`.settings`). Bars that control points tie to the
grid start anew from there; others are reached through the column below, where a report tells of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.pose.planar import in_degrees
from aadm_workbench.model import Array, StackSettings, Verdict
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.stack.advice import chosen_aim, is_worth, without_advice
from aadm_workbench.stack.limits import Limits
from aadm_workbench.stack.measured import MeasuredColumn
from aadm_workbench.stack.result import Advice, Basis, StackedColumn, Top
from aadm_workbench.stack.set_pose import OnBars, pose_on_bars
from aadm_workbench.stack.settings import of_bars, of_setting
from aadm_workbench.stack.torsor import STILL, Torsor, carried_to, in_plan, plumbed, seen_from

STOREY_MM = (1500.0, 12000.0)
"""From foot to foot of two columns of one tower: no storey is lower than a crawl space, and halls have 12 m."""

_SAME_AXIS_MM = 300.0
"""Between axes of columns that stand upon each other: half of a common column; they grow slimmer upwards."""


@dataclass(frozen=True, eq=False)
class Tower:
    """What is needed for every column alike; ``heights`` by the place of a column in the list, mm."""

    settings: StackSettings
    limits: Limits
    heights: Mapping[int, float]

    def stacked(self, columns: Sequence[MeasuredColumn]) -> tuple[StackedColumn, ...]:
        """All columns, in their order; each after those that it stands on."""
        found: dict[int, StackedColumn] = {}
        for place in sorted(range(len(columns)), key=lambda one: _foot_mm(columns[one])):
            below = _below(columns[place], found.values())
            found[place] = self._column(columns[place], self._height_mm(place, columns), below)
        return tuple(found[place] for place in range(len(columns)))

    def _height_mm(self, place: int, columns: Sequence[MeasuredColumn]) -> float | None:
        """Of the model, else of the settings, else up to the foot of the column above; None where nobody knows."""
        known = self.heights.get(place, self.settings.height_mm)
        ways = [_way_up(columns[place], other) for other in columns]
        return known if known is not None else min((way for way in ways if way is not None), default=None)

    def _column(self, column: MeasuredColumn, height_mm: float | None, below: StackedColumn | None) -> StackedColumn:
        ground, basis = self._ground(column, below)
        on_bars = pose_on_bars(column)
        through = below.measured.id if below is not None and basis == "storey_below" else None
        if on_bars is None:
            return StackedColumn(column, None, basis, through, height_mm=height_mm, reasons=(_why_not(column),))
        reasons = (phrase("stack.not_tied"),) if basis == "bars" else ()
        reasons = (*reasons, phrase("stack.told_cut")) if column.told_is_cut else reasons
        stacked = StackedColumn(column, None, basis, through, on_bars.origin, height_mm, reasons=reasons)
        placed = ground.plus(in_plan(on_bars.planar, np.zeros((3, 3))).values, self._settled(stacked, on_bars))
        stacked = replace(stacked, placed=placed)
        if height_mm is None:
            return without_advice(stacked, "no_height")
        stacked = replace(stacked, top=self._top(placed, stacked), next_bars=self._bars(placed, stacked))
        return self._advised(stacked, ground, on_bars)

    def _ground(self, column: MeasuredColumn, below: StackedColumn | None) -> tuple[Torsor, Basis]:
        """Where the bars stand, and what that is told against."""
        if column.ground is not None:
            return in_plan(column.ground.planar, column.ground.covariance), "control_points"
        if below is None or below.placed is None or below.basis == "bars":
            return STILL, "bars"
        carried = carried_over(below, column, braced=self.settings.braced)
        if not np.all(np.isfinite(carried.covariance)):
            return STILL, "bars"
        return carried.plus(np.zeros(6), of_bars(self.settings, column.radius_mm)), "storey_below"

    def _settled(self, stacked: StackedColumn, on_bars: OnBars) -> Array:
        """Covariance (6, 6) of a column on its bars: of the measurement, and what setting adds."""
        measured = in_plan(on_bars.planar, on_bars.covariance).covariance
        return measured + of_setting(self.settings, stacked.measured.radius_mm, stacked.height_mm)

    def _top(self, placed: Torsor, stacked: StackedColumn) -> Top:
        offset, covariance = placed.at(np.array([0.0, 0.0, stacked.height_mm or 0.0]))
        unknown = phrase("stack.not_tied_top") if stacked.basis == "bars" else None
        return self.limits.top(offset[:2], covariance[:2, :2], unknown)

    def _bars(self, placed: Torsor, stacked: StackedColumn) -> Torsor:
        """The bars in the head of a column that is placed so."""
        head = carried_to(np.array([0.0, 0.0, stacked.height_mm or 0.0]))
        return placed.through(head, of_bars(self.settings, stacked.measured.radius_mm))

    def _advised(self, stacked: StackedColumn, ground: Torsor, on_bars: OnBars) -> StackedColumn:
        """The column with the pose in its play that leads back to the grid, or with the reason why there is none."""
        if stacked.basis == "bars" or on_bars.origin == "hoisting":
            return stacked
        aim = chosen_aim(stacked, ground)
        if aim is None:
            return without_advice(stacked, "no_play")
        pose, moved = aim
        if on_bars.origin == "told" and not is_worth(pose - on_bars.planar, stacked.measured.radius_mm):
            return without_advice(stacked, "told_already")
        if not is_worth(moved, stacked.measured.radius_mm):
            return without_advice(stacked, "no_gain")
        placed = ground.plus(in_plan(pose, np.zeros((3, 3))).values, self._settled(stacked, on_bars))
        advice = Advice(in_degrees(pose), in_degrees(moved), self._top(placed, stacked), self._bars(placed, stacked))
        return replace(stacked, advice=advice)


def carried_over(below: StackedColumn, column: MeasuredColumn, *, braced: bool) -> Torsor:
    """The displacement of a column below, told where the next one stands and in its frame.

    Braces set the tilt of the next one anew: what the lean of the column below has moved, it keeps.
    """
    assert below.placed is not None
    assert below.measured.T_model_column is not None
    assert column.T_model_column is not None
    T = np.linalg.inv(below.measured.T_model_column) @ column.T_model_column
    carried = below.placed.through(seen_from(T[:3, :3].T) @ carried_to(T[:3, 3]))
    return carried.through(plumbed()) if braced else carried


def _below(column: MeasuredColumn, others: Iterable[StackedColumn]) -> StackedColumn | None:
    """The nearest column that another one stands on; None where no report tells of one."""
    near = [(way, other) for other in others if (way := _way_up(other.measured, column)) is not None]
    return min(near, key=lambda one: one[0])[1] if near else None


def _way_up(lower: MeasuredColumn, upper: MeasuredColumn) -> float | None:
    """From foot to foot, mm, of two columns that stand upon each other; None of any others."""
    if lower.T_model_column is None or upper.T_model_column is None:
        return None
    way = upper.T_model_column[:3, 3] - lower.T_model_column[:3, 3]
    stands = np.hypot(way[0], way[1]) <= _SAME_AXIS_MM and STOREY_MM[0] <= way[2] <= STOREY_MM[1]
    return float(way[2]) if stands else None


def _foot_mm(column: MeasuredColumn) -> float:
    return 0.0 if column.T_model_column is None else float(column.T_model_column[2, 3])


def _why_not(column: MeasuredColumn) -> Phrase:
    """Why nothing is predicted of a column."""
    if column.goes_on is Verdict.FAIL:
        return phrase("stack.goes_not_on")
    return phrase("stack.no_trial")
