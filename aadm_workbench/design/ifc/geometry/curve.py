"""Curves of an IFC model as paths: polylines, arcs, lines, trimmed, composite and indexed curves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from aadm_workbench.design.ifc.geometry.placement import (
    NothingThereError,
    Placements,
    UnreadableGeometryError,
    unit,
    within,
)
from aadm_workbench.design.recognise.paths import Arc, Leg, Straight, arc_through, cut, polyline
from aadm_workbench.model import Array, Reason

_FULL_TURN = 2.0 * math.pi  # rad
_MOST_TURNS = 100.0
"""The spiral of a column's stirrups has some dozens."""

_MOST_LEGS = 20_000
"""A spiral drawn in small steps has some thousands; curves of curves of curves may have more than can be counted."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Evaluates curves; ``radians`` is the angle of one unit of the file."""

    placements: Placements
    radians: float
    _begun: set[int] = field(default_factory=set, repr=False)

    def legs(self, curve: Any) -> list[Leg]:
        """The legs of a bounded curve, mm, in the curve's own frame.

        The ``span`` of a leg is its length in the curve's parameter, by which other entities cut it.

        Raises
        ------
        UnreadableGeometryError
            For kinds of curve that bars and profiles are not made of (splines, offsets, spirals).
        """
        match curve.is_a():
            case "IfcPolyline":
                return polyline([self.placements.point(point) for point in curve.Points])
            case "IfcIndexedPolyCurve":
                return self._indexed(curve)
            case "IfcTrimmedCurve":
                with within(self._begun, curve):
                    return self._trimmed(curve)
            case "IfcCircle" | "IfcEllipse":
                return [self._conic(curve, 0.0, _FULL_TURN)]
            case "IfcLine":
                return [self._line(curve, 0.0, 1.0)]
            case "IfcCompositeCurve" | "Ifc2DCompositeCurve" | "IfcBoundaryCurve" | "IfcOuterBoundaryCurve":
                with within(self._begun, curve):
                    return self._joined_up(curve)
        raise UnreadableGeometryError(Reason("geometry.not_evaluated", id=curve.id(), type=curve.is_a()))

    def _joined_up(self, curve: Any) -> list[Leg]:
        legs: list[Leg] = []
        for segment in curve.Segments:
            legs += self._segment(segment)
            if len(legs) > _MOST_LEGS:
                raise NothingThereError(Reason("geometry.legs", id=curve.id(), type=curve.is_a(), most=_MOST_LEGS))
        return legs

    def swept(self, curve: Any, begin: float | None, stop: float | None) -> list[Leg]:
        """The part of a directrix between two of its parameters, as an IfcSweptDiskSolid takes it."""
        if curve.is_a("IfcLine"):
            return [self._line(curve, begin or 0.0, 1.0 if stop is None else stop)]
        if curve.is_a("IfcConic"):
            first = 0.0 if begin is None else begin * self.radians
            last = _FULL_TURN if stop is None else stop * self.radians
            return [self._conic(curve, first, last)]
        legs = self.legs(curve)
        return legs if self._is_whole(curve, legs, begin, stop) else cut(legs, begin, stop)

    def _is_whole(self, curve: Any, legs: Sequence[Leg], begin: float | None, stop: float | None) -> bool:
        """Whether a range is the whole curve in another parameter than the curve's own.

        Exporters count from 0 to 1, in lengths, or, on a trimmed curve, in the parameter of what was trimmed.
        """
        if begin is None or stop is None:
            return False
        length = sum(leg.length_mm for leg in legs) / self.placements.mm
        if begin == 0.0 and (stop == 1.0 or math.isclose(stop, length, rel_tol=1e-4)):
            return True
        if curve.is_a("IfcTrimmedCurve"):
            trims = [_parameter(trim) for trim in (curve.Trim1, curve.Trim2)]
            return all(
                t is not None and math.isclose(t, v, abs_tol=1e-9) for t, v in zip(trims, (begin, stop), strict=True)
            )
        return False

    def _indexed(self, curve: Any) -> list[Leg]:
        points = [self.placements.coordinates(point) for point in curve.Points.CoordList]
        if not curve.Segments:
            return polyline(points)
        legs: list[Leg] = []
        for segment in curve.Segments:
            corners = [points[index - 1] for index in segment.wrappedValue]
            if segment.is_a("IfcArcIndex"):
                legs.append(arc_through(corners[0], corners[1], corners[2]))
            else:
                legs += polyline(corners)
        return legs

    def _segment(self, segment: Any) -> list[Leg]:
        if not hasattr(segment, "ParentCurve"):
            raise UnreadableGeometryError(Reason("geometry.not_evaluated", id=segment.id(), type=segment.is_a()))
        legs = self.legs(segment.ParentCurve)
        return legs if segment.SameSense else [leg.reversed() for leg in reversed(legs)]

    def _line(self, line: Any, begin: float, stop: float) -> Straight:
        origin = self.placements.point(line.Pnt)
        step = self.placements.mm * line.Dir.Magnitude * unit(line.Dir.Orientation.DirectionRatios)
        return Straight(origin + begin * step, origin + stop * step, abs(stop - begin))

    def _conic(self, conic: Any, begin: float, stop: float) -> Arc:
        check_turn(conic, stop - begin)
        T = self.placements.of_axes(conic.Position)
        radii = (conic.Radius, conic.Radius) if conic.is_a("IfcCircle") else (conic.SemiAxis1, conic.SemiAxis2)
        u, v = (self.placements.mm * radius * T[:3, axis] for axis, radius in enumerate(radii))
        return Arc(T[:3, 3], u, v, begin, stop, abs(stop - begin) / self.radians)

    def _trimmed(self, curve: Any) -> list[Leg]:
        basis, forwards = curve.BasisCurve, bool(curve.SenseAgreement)
        if basis.is_a("IfcConic"):
            return [self._trimmed_conic(curve, basis, forwards)]
        if basis.is_a("IfcLine"):
            return [self._trimmed_line(curve, basis)]
        begin, stop = (_parameter(trim) for trim in (curve.Trim1, curve.Trim2))
        if begin is None or stop is None:
            raise UnreadableGeometryError(Reason("geometry.trimmed_by_points", id=curve.id(), type=basis.is_a()))
        legs = cut(self.legs(basis), min(begin, stop), max(begin, stop))
        return legs if forwards else [leg.reversed() for leg in reversed(legs)]

    def _trimmed_line(self, curve: Any, line: Any) -> Leg:
        ends = []
        for trim in (curve.Trim1, curve.Trim2):
            point, parameter = self._cartesian(trim), _parameter(trim)
            if point is not None and (parameter is None or curve.MasterRepresentation == "CARTESIAN"):
                ends.append(point)
            elif parameter is not None:
                ends.append(self._line(line, 0.0, parameter).end)
            else:
                raise UnreadableGeometryError(Reason("geometry.no_trim", id=curve.id()))
        magnitude_mm = self.placements.mm * line.Dir.Magnitude
        leg = Straight(ends[0], ends[1])
        return replace(leg, span=leg.length_mm / magnitude_mm)

    def _trimmed_conic(self, curve: Any, conic: Any, forwards: bool) -> Leg:
        begin, stop = (self._angle(curve, conic, trim) for trim in (curve.Trim1, curve.Trim2))
        turn = (stop - begin if forwards else begin - stop) % _FULL_TURN
        # A trim of a whole turn comes back to its start; rounding leaves it a hair before or behind.
        if turn < 1e-9:
            turn = _FULL_TURN
        return self._conic(conic, begin, begin + turn if forwards else begin - turn)

    def _angle(self, curve: Any, conic: Any, trim: Sequence[Any]) -> float:
        parameter, point = _parameter(trim), self._cartesian(trim)
        if parameter is not None and (point is None or curve.MasterRepresentation != "CARTESIAN"):
            return parameter * self.radians
        if point is None:
            raise UnreadableGeometryError(Reason("geometry.no_trim", id=curve.id()))
        arc = self._conic(conic, 0.0, 0.0)
        spoke = point - arc.centre
        return math.atan2(float(spoke @ arc.v) / float(arc.v @ arc.v), float(spoke @ arc.u) / float(arc.u @ arc.u))

    def _cartesian(self, trim: Sequence[Any]) -> Array | None:
        return next((self.placements.point(value) for value in trim if value.is_a("IfcCartesianPoint")), None)


def check_turn(entity: Any, turn: float) -> None:
    """Refuse an arc of more turns, in radians, than anything is wound.

    Raises
    ------
    NothingThereError
        Naming the entity.
    """
    if not abs(turn) <= _MOST_TURNS * _FULL_TURN:
        raise NothingThereError(
            Reason("geometry.turns", id=entity.id(), type=entity.is_a(), turns=abs(turn) / _FULL_TURN)
        )


def _parameter(trim: Sequence[Any]) -> float | None:
    return next((float(value.wrappedValue) for value in trim if value.is_a("IfcParameterValue")), None)
