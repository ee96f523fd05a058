"""Profiles of an IFC model as outlines with holes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from aadm_workbench.design.ifc.geometry.curve import Curves
from aadm_workbench.design.ifc.geometry.placement import Placements, UnreadableGeometryError, within
from aadm_workbench.design.recognise.circles import Circle, circle_through
from aadm_workbench.design.recognise.paths import outline
from aadm_workbench.design.recognise.shapes import Loop
from aadm_workbench.model import Array, Reason

_Z = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Area:
    """A plane area in the xy plane of its own frame, mm."""

    outer: Loop
    holes: tuple[Loop, ...] = ()

    def moved(self, T: Array) -> Area:
        """The same after a motion (4, 4)."""
        return Area(self.outer.moved(T), tuple(hole.moved(T) for hole in self.holes))


@dataclass(frozen=True, eq=False)
class Profiles:
    """Evaluates profiles."""

    placements: Placements
    curves: Curves
    _begun: set[int] = field(default_factory=set, repr=False)

    def areas(self, profile: Any) -> list[Area]:
        """The areas of a profile; several for a composite one.

        Raises
        ------
        UnreadableGeometryError
            For rolled steel sections and open profiles.
        """
        if profile.is_a("IfcArbitraryClosedProfileDef"):
            return [self._arbitrary(profile)]
        if profile.is_a("IfcCompositeProfileDef"):
            with within(self._begun, profile):
                return [area for part in profile.Profiles for area in self.areas(part)]
        if profile.is_a("IfcDerivedProfileDef"):
            with within(self._begun, profile):
                return [area.moved(self._operator(profile)) for area in self.areas(profile.ParentProfile)]
        if profile.is_a("IfcParameterizedProfileDef"):
            T = self.placements.of_axes(profile.Position)
            return [self._parameterized(profile).moved(T)]
        raise UnreadableGeometryError(Reason("geometry.not_evaluated", id=profile.id(), type=profile.is_a()))

    def _operator(self, profile: Any) -> Array:
        if profile.is_a("IfcMirroredProfileDef"):
            return np.diag([-1.0, 1.0, 1.0, 1.0])
        return self.placements.of_operator(profile.Operator)

    def _arbitrary(self, profile: Any) -> Area:
        inner = profile.InnerCurves if profile.is_a("IfcArbitraryProfileDefWithVoids") else ()
        return Area(self._loop(profile.OuterCurve), tuple(self._loop(curve) for curve in inner))

    def _loop(self, curve: Any) -> Loop:
        points = outline(self.curves.legs(curve))
        return Loop(points, circle_through(points))

    def _parameterized(self, profile: Any) -> Area:
        mm = self.placements.mm
        match profile.is_a():
            case "IfcCircleProfileDef":
                return Area(_circle(mm * profile.Radius))
            case "IfcCircleHollowProfileDef":
                outer_mm = mm * profile.Radius
                return Area(_circle(outer_mm), (_circle(outer_mm - mm * profile.WallThickness),))
            case "IfcRectangleProfileDef" | "IfcRoundedRectangleProfileDef":
                return Area(_rectangle(mm * profile.XDim, mm * profile.YDim))
            case "IfcRectangleHollowProfileDef":
                wall_mm = 2.0 * mm * profile.WallThickness
                hole = _rectangle(mm * profile.XDim - wall_mm, mm * profile.YDim - wall_mm)
                return Area(_rectangle(mm * profile.XDim, mm * profile.YDim), (hole,))
        raise UnreadableGeometryError(Reason("geometry.not_evaluated", id=profile.id(), type=profile.is_a()))


def _circle(radius_mm: float) -> Loop:
    angle = np.radians(np.arange(0.0, 360.0, 5.0))
    points = radius_mm * np.column_stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)])
    return Loop(points, Circle(np.zeros(3), _Z, radius_mm))


def _rectangle(x_mm: float, y_mm: float) -> Loop:
    corners = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
    return Loop(corners * [x_mm / 2.0, y_mm / 2.0, 0.0])
