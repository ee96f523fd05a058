"""Where things stand: placements and frames of an IFC model as (4, 4) matrices in millimetres."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from aadm_workbench.design.ifc.geometry.representation import body_of
from aadm_workbench.design.ifc.names import optional
from aadm_workbench.design.sound import FARTHEST_MM
from aadm_workbench.model import Array, Reason

_LARGEST_SCALE = 1e9
"""Millimetres drawn as kilometres and again as much; what is scaled by more is no drawing."""


class UnreadableGeometryError(ValueError):
    """A piece of geometry that is broken, or of a kind that is not evaluated here."""


class NothingThereError(UnreadableGeometryError):
    """A piece of geometry that no kernel makes anything of: it has no extent, lies nowhere, or is a part of itself."""


@contextmanager
def within(begun: set[int], entity: Any) -> Iterator[None]:
    """While an entity is evaluated it may not be met again.

    Raises
    ------
    NothingThereError
        Where it is: it is a part of itself.
    """
    number = entity.id()
    if number in begun:
        raise NothingThereError(Reason("geometry.own_part", id=number, type=entity.is_a()))
    begun.add(number)
    try:
        yield
    finally:
        begun.discard(number)


@dataclass(frozen=True, eq=False)
class Placements:
    """Evaluates placements; ``mm`` is the length of one unit of the file.

    ``on_grid`` evaluates those on grids, whose axes are curves: these need placements themselves.

    Coordinates of 6,700 km keep a millionth of a millimetre in float64, so long as no large numbers are turned:
    the chain is multiplied from the outside inwards, and each translation stays where it was written.
    """

    mm: float
    on_grid: Callable[[Placements, Any], Array]
    _known: dict[int, Array] = field(default_factory=dict, repr=False)
    _begun: set[int] = field(default_factory=set, repr=False)

    def of_product(self, product: Any, context: Any = None) -> Array:
        """``T_model_product``: the product's own frame in the model, world coordinate system included.

        The world coordinate system of the context in which its body is drawn moves everything in that context; some
        exporters put the whole georeference there.
        """
        if context is None:
            context, _ = body_of(product)
        return self.of_context(context) @ self.of_placement(optional(product, "ObjectPlacement"))

    def of_context(self, context: Any) -> Array:
        """World coordinate system of a representation context; the identity where it has none."""
        if context is None:
            return np.eye(4)
        if context.id() not in self._known:
            whole, passed = context, {context.id()}
            while whole.is_a("IfcGeometricRepresentationSubContext"):
                whole = whole.ParentContext
                if whole is None or whole.id() in passed:
                    raise UnreadableGeometryError(Reason("geometry.context", id=context.id()))
                passed.add(whole.id())
            self._known[context.id()] = self.of_axes(optional(whole, "WorldCoordinateSystem"))
        return self._known[context.id()]

    def of_placement(self, placement: Any) -> Array:
        """An IfcLocalPlacement with all that it is relative to.

        Raises
        ------
        UnreadableGeometryError
            Where placements are relative to each other in a circle, or on a grid of curves.
        """
        chain: list[tuple[int, Any]] = []
        passed: set[int] = set()
        T = _STILL
        while placement is not None:
            number = placement.id()
            if number in self._known:
                T = self._known[number]
                break
            if placement.is_a() == "IfcGridPlacement":
                T = self._known[number] = self._on_grid(placement)
                break
            axes = _axes_of(placement)
            if axes is None:
                raise UnreadableGeometryError(Reason("geometry.not_evaluated", id=number, type=placement.is_a()))
            if number in passed:
                raise UnreadableGeometryError(Reason("geometry.own_placement", id=number))
            passed.add(number)
            chain.append((number, axes))
            placement = optional(placement, "PlacementRelTo")
        for number, axes in reversed(chain):
            T = self._known[number] = T @ self.of_axes(axes)
        return T

    def _on_grid(self, placement: Any) -> Array:
        with within(self._begun, placement):
            return self.on_grid(self, placement)

    def of_axes(self, axes: Any) -> Array:
        """An IfcAxis2Placement3D or 2D, or an IfcAxis1Placement; None is the identity."""
        if axes is None:
            return np.eye(4)
        if axes.is_a() == "IfcAxis2Placement2D":
            return frame(self.point(axes.Location), None, _direction(axes.RefDirection))
        z, x = _direction(optional(axes, "Axis")), _direction(optional(axes, "RefDirection"))
        return frame(self.point(optional(axes, "Location")), z, x)

    def of_operator(self, operator: Any) -> Array:
        """An IfcCartesianTransformationOperator: the target of a mapped item, which may mirror and scale."""
        x, y, z = (_direction(optional(operator, name)) for name in ("Axis1", "Axis2", "Axis3"))
        T = frame(self.point(optional(operator, "LocalOrigin")), z, x)
        if y is not None and float(T[:3, 1] @ y) < 0.0:
            T[:3, 1] = -T[:3, 1]
        scales = [optional(operator, "Scale"), optional(operator, "Scale2"), optional(operator, "Scale3")]
        if scales != [None, None, None]:
            first = 1.0 if scales[0] is None else float(scales[0])
            T[:3, :3] *= [first if scale is None else float(scale) for scale in scales]
            if not 0.0 < abs(float(np.linalg.det(T[:3, :3]))) < _LARGEST_SCALE**3:
                raise UnreadableGeometryError(Reason("geometry.scales", id=operator.id(), scale=first))
        return T

    def point(self, point: Any) -> Array:
        """An IfcCartesianPoint as (3,) mm; a point of the plane gets z = 0."""
        return self.coordinates(optional(point, "Coordinates"))

    def coordinates(self, values: Any) -> Array:
        """Two or three coordinates of the file as (3,) mm."""
        if len(values) != 3:
            padded = np.zeros(3)
            padded[: len(values)] = values
            values = padded.tolist()
        xyz = [value * self.mm for value in values]  # of three numbers: numpy takes twice as long
        if not max(map(abs, xyz)) < FARTHEST_MM:
            raise NothingThereError(Reason("geometry.far", distance=max(map(abs, values))))
        return np.array(xyz)


def _axes_of(placement: Any) -> Any:
    """Axes of a local placement; of one along an alignment those that it is written with for who cannot follow it."""
    if placement.is_a() == "IfcLocalPlacement":
        return optional(placement, "RelativePlacement")
    return optional(placement, "CartesianPosition")


_STILL = np.eye(4)  # nothing moves
_STILL.setflags(write=False)


def frame(origin: Array, z: Array | None, x: Array | None) -> Array:
    """A right-handed frame (4, 4) from its origin, its z axis and a hint at its x axis, as IFC defines it."""
    if z is None and x is None:
        T = _STILL.copy()
        T[:3, 3] = origin
        return T
    up = np.array([0.0, 0.0, 1.0]) if z is None else z
    if x is None:
        x = np.array([0.0, 0.0, 1.0]) if abs(up[0]) > 1.0 - 1e-9 else np.array([1.0, 0.0, 0.0])
    across = x - float(x @ up) * up
    length = math.sqrt(float(across @ across))
    if length < 1e-9:
        raise UnreadableGeometryError(Reason("geometry.parallel"))
    T = np.eye(4)
    T[:3, 0] = across / length
    T[:3, 2] = up
    (a, b, c), (d, e, f) = up, T[:3, 0]
    T[:3, 1] = b * f - c * e, c * d - a * f, a * e - b * d  # np.cross takes longer than all the rest
    T[:3, 3] = origin
    return T


def _direction(direction: Any) -> Array | None:
    """An IfcDirection as (3,) unit; None where it is left out."""
    if direction is None:
        return None
    return unit(direction.DirectionRatios)


def unit(values: Any) -> Array:
    """Two or three components as a unit vector (3,)."""
    vector = np.zeros(3)
    vector[: len(values)] = values
    length = math.sqrt(float(vector @ vector))
    if not 0.0 < length < math.inf:
        raise UnreadableGeometryError(Reason("geometry.no_length"))
    return vector / length
