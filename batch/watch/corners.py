"""The last frame from each corner of a column: whether the newest contradicts them, and what it tells with them."""

from __future__ import annotations

from dataclasses import replace

from aadm_workbench.hoisting.sequence.contradiction import contradiction_of
from aadm_workbench.hoisting.turn_findings import with_contradiction
from aadm_workbench.inspection.hoisting import Before, join_frames
from aadm_workbench.inspection.tasks import ColumnTask
from aadm_workbench.model import ColumnDesign, HoistingMeasurement

_JOINED_FOR_S = 600.0  # a crew walks a camera around a column in minutes; what was seen an hour ago may be bent since
Corner = tuple[int, int] | None


class Corners:
    """Keeps one frame for each corner; a frame without a known corner has a place of its own."""

    def __init__(self, task: ColumnTask, design: ColumnDesign, before: Before) -> None:
        self._task, self._design, self._before = task, design, before
        self._last: dict[Corner, tuple[float, HoistingMeasurement]] = {}

    def with_newest(self, measurement: HoistingMeasurement, near: Corner, at_s: float) -> HoistingMeasurement:
        """The newest frame as it is to be acted upon: joined with those of the other corners.

        Without a correction, where the last frame of some corner contradicts it. ``at_s``: seconds since 1970.
        """
        if measurement.report.max_mm is None:
            return measurement
        others = [(corner, *last) for corner, last in self._last.items()]
        self._last[near] = (at_s, measurement)
        for corner, _, other in others:
            # of one camera all frames have the same label: between them the column swings, and is pushed
            finding = contradiction_of(other, measurement, self._design, swings=corner == near)
            if finding is not None:
                return replace(measurement, report=with_contradiction(measurement.report, finding))
        seen = sorted((time_s, k) for k, (corner, time_s, _) in enumerate(others) if corner != near)
        recent = [others[k][2] for time_s, k in seen if abs(at_s - time_s) < _JOINED_FOR_S]
        return join_frames(self._task, self._design, [*recent, measurement], self._before) or measurement
