"""What displaced columns do to the beams on them: span, seats, skew, level, and how flush neighbours meet.

A beam lies from a to b in direction e, level. Its supports move by u_a and u_b (:mod:`.torsor`), so that

    span    e · (u_b − u_a)                    between the supports; the beam itself is as long as it is
    seats   e · u_a  and  −e · u_b             the bearing length at each end, the beam in its design place
    skew    yaw − n · (u_b − u_a) / |b − a|    at each end, n across the beam: the larger one is told
    level   u_b,z − u_a,z                      the fall from one end to the other

Two columns are taken to be independent; what they share, the control points, is smaller than what setting adds.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from aadm_workbench.design.floor import Floor, FloorBeam, How, Support
from aadm_workbench.model import Array, Verdict
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.report.words.reasons import in_both_languages
from aadm_workbench.stack.limits import Limits, standard, unjudged
from aadm_workbench.stack.result import Judged, Neighbours, NotFound, StackedColumn, StackedMember
from aadm_workbench.stack.torsor import Torsor, point_matrix, seen_from

_DEGREES = 180.0 / math.pi
"""In a radian."""


@dataclass(frozen=True, eq=False)
class Carried:
    """An end of a beam on its column, told in the model frame.

    ``matrix`` (3, 6) is by how much the end moves with the column's displacement; ``missing`` says why that
    displacement is not known, and ``relative`` that it is known against the column's own bars alone.
    """

    matrix: Array
    placed: Torsor | None
    missing: Phrase | None
    relative: bool


@dataclass(frozen=True, eq=False)
class MembersOn:
    """Works out what becomes of each beam; ``columns`` by their places among those of the floor."""

    floor: Floor
    columns: Mapping[int, StackedColumn]
    limits: Limits

    def members(self) -> Iterator[StackedMember]:
        """Every beam of which at least one end lies on a column of the reports."""
        for beam, supports in zip(self.floor.beams, self.floor.supports, strict=True):
            if any(support.column in self.columns for support in supports):
                yield self._member(beam, supports)

    def not_found(self) -> Iterator[NotFound]:
        """Ends of those beams that lie on no column, and beams that lie on none of the reports."""
        for beam, supports in zip(self.floor.beams, self.floor.supports, strict=True):
            known = [support.column in self.columns for support in supports]
            for support, here in zip(supports, known, strict=True):
                if support.column is None and any(known):
                    yield NotFound(beam.id, _no_column(support))
                elif not here and any(known):
                    yield NotFound(beam.id, phrase("stack.not_in_report", column=self._name(support) or "?"))

    def neighbours(self) -> Iterator[Neighbours]:
        """Pairs of beams that meet over one column, and how flush."""
        over: dict[int, list[tuple[FloorBeam, int]]] = {}
        for beam, supports in zip(self.floor.beams, self.floor.supports, strict=True):
            for end, support in enumerate(supports):
                if support.column is not None and support.column in self.columns:
                    over.setdefault(support.column, []).append((beam, end))
        for place, ends in over.items():
            for (first, a), (second, b) in combinations(ends, 2):
                flush = self._flush(self._carried(place, first.ends[a]), self._carried(place, second.ends[b]))
                yield Neighbours(self.columns[place].measured.id, (first.id, second.id), flush)

    def _member(self, beam: FloorBeam, supports: Sequence[Support]) -> StackedMember:
        carried = [self._carried(support.column, end) for support, end in zip(supports, beam.ends, strict=True)]
        way = beam.ends[1] - beam.ends[0]
        length_mm = float(np.hypot(way[0], way[1]))
        along = np.array([way[0], way[1], 0.0]) / length_mm
        first, second = carried
        return StackedMember(
            id=beam.id,
            global_id=beam.global_id,
            ends=(self._name(supports[0]), self._name(supports[1])),
            why=(_why(supports[0]), _why(supports[1])),
            points_mm=beam.ends,
            span_mm=self._judged("span", (first, -along @ first.matrix), (second, along @ second.matrix)),
            seat_mm=(
                self._judged("bearing_length", (first, along @ first.matrix)),
                self._judged("bearing_length", (second, -along @ second.matrix)),
            ),
            skew_deg=self._skew(carried, along, length_mm),
            level_mm=_of_no_scan(self._judged("inclination", (first, -first.matrix[2]), (second, second.matrix[2]))),
        )

    def _name(self, support: Support) -> str | None:
        if support.column is None:
            return None
        known = self.columns.get(support.column)
        return self.floor.columns[support.column].id if known is None else known.measured.id

    def _carried(self, place: int | None, end: Array) -> Carried:
        """An end on its column; in the model frame, so that both ends of a beam speak of the same directions."""
        column = None if place is None else self.columns.get(place)
        if column is None or column.measured.T_model_column is None:
            missing = phrase("stack.end_free") if place is None else phrase("stack.end_unknown")
            return Carried(np.zeros((3, 6)), None, missing, False)
        T = column.measured.T_model_column
        matrix = point_matrix(end - T[:3, 3]) @ seen_from(T[:3, :3])
        if column.placed is None:
            return Carried(matrix, None, phrase("stack.end_not_set", column=column.measured.id), False)
        return Carried(matrix, column.placed, None, column.basis == "bars")

    def _skew(self, carried: Sequence[Carried], along: Array, length_mm: float) -> Judged:
        """The larger turn of a support against the line between both."""
        first, second = carried
        across = np.array([-along[1], along[0], 0.0]) / length_mm
        of_line = (across @ first.matrix, -across @ second.matrix)
        yaw = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0])  # z is up in both frames
        at_first = ((first, _DEGREES * (of_line[0] + yaw)), (second, _DEGREES * of_line[1]))
        at_second = ((first, _DEGREES * of_line[0]), (second, _DEGREES * (of_line[1] + yaw)))
        both = [self._judged("skew", *terms) for terms in (at_first, at_second)]
        return max(both, key=lambda one: abs(one.value or 0.0))

    def _judged(self, quantity: str, *terms: tuple[Carried, Array]) -> Judged:
        """The sum of row · ξ over some ends, against its limit where all of them are known against the grid."""
        missing = next((end.missing for end, _ in terms if end.missing is not None), None)
        if missing is None and len({end.relative for end, _ in terms}) > 1:
            missing = phrase("stack.unlike_bases")
        if missing is not None:
            return unjudged(missing)
        value, variance = 0.0, 0.0
        for end, row in terms:
            assert end.placed is not None
            value += float(row @ end.placed.values)
            variance += standard(end.placed.covariance, row) ** 2
        if terms[0][0].relative:
            return unjudged(phrase("stack.relative"), value, math.sqrt(variance))
        # However the beam is laid, no end loses more than the whole span.
        limited_as = "bearing_length" if quantity == "span" else quantity
        return self.limits.signed(limited_as, value, math.sqrt(variance), quantity)

    def _flush(self, first: Carried, second: Carried) -> Judged:
        """Two ends on one column move with it: only its tilt tells them apart, and no grid is needed."""
        if first.missing is not None or first.placed is None:
            return unjudged(first.missing or phrase("stack.end_unknown"))
        row = second.matrix[2] - first.matrix[2]
        return self.limits.signed("flushness", float(row @ first.placed.values), standard(first.placed.covariance, row))


def _of_no_scan(level: Judged) -> Judged:
    """A fall that is not settled, with what is missing: no scan tells heights, so nothing was too close to a limit."""
    if level.verdict is not Verdict.INCONCLUSIVE or level.limit is None or level.u is None:
        return level
    clause = in_both_languages(level.clause)
    said = phrase("stack.level_unknown")
    parts = {"u": f"{level.u:.1f}", "limit": f"{level.limit[1]:g}"}
    reason = Phrase(said.en.format(clause=clause.en, **parts), said.zh.format(clause=clause.zh, **parts))
    return replace(level, reason=reason)


def _why(support: Support) -> Phrase:
    """How the column under an end was found, or that none was."""
    if support.how is None:
        return _no_column(support)
    if support.how is not How.GEOMETRY:
        return phrase(f"stack.by_{support.how}")
    outside_mm = round(support.outside_mm or 0.0)
    return phrase("stack.by_geometry_beside", outside=outside_mm) if outside_mm else phrase("stack.by_geometry_on")


def _no_column(support: Support) -> Phrase:
    if support.outside_mm is None:
        return phrase("stack.no_column")
    return phrase("stack.nearest_column", outside=f"{support.outside_mm:.0f}")
