"""Placements of FreeCAD and 4x4 transforms, mm, float64, in both directions; where an object stands in its document."""

from __future__ import annotations

from typing import Any

import FreeCAD
import numpy as np

from aadm_workbench.model import Array

_UNMOVED_MM = 1e-7  # a tenth of a nanometre: rounding
_UNTURNED = 1e-14  # 1 - |q·q'| of unit quaternions: rounding


def placement_of(T_to_from: Array) -> FreeCAD.Placement:
    """The placement that maps as a rigid 4x4 transform does, mm."""
    matrix = FreeCAD.Matrix(*(float(value) for value in np.asarray(T_to_from, dtype=np.float64).reshape(16)))
    return FreeCAD.Placement(matrix)


def transform_of(placement: FreeCAD.Placement) -> Array:
    """The (4, 4) float64 transform of a placement, mm."""
    matrix = placement.toMatrix()
    return np.array([[getattr(matrix, f"A{row}{column}") for column in range(1, 5)] for row in range(1, 5)])


def global_placement(obj: Any) -> FreeCAD.Placement:
    """Where an object stands in its document, containers included."""
    return obj.getGlobalPlacement() if hasattr(obj, "getGlobalPlacement") else FreeCAD.Placement()


def world_point(result: Any, place_mm: tuple[float, float]) -> Array:
    """A place (x, y) on the foot of a result's column as a point (3,) mm of the model."""
    return np.array(result.Placement.multVec(FreeCAD.Vector(place_mm[0], place_mm[1], 0.0)))


def same_place(one: FreeCAD.Placement, other: FreeCAD.Placement) -> bool:
    """Whether two placements differ by less than any display or file can tell."""
    # Two quaternions with opposite signs are one rotation.
    alike = abs(sum(p * q for p, q in zip(one.Rotation.Q, other.Rotation.Q, strict=True)))
    return (one.Base - other.Base).Length < _UNMOVED_MM and alike > 1.0 - _UNTURNED


def move_to(obj: Any, placement: FreeCAD.Placement) -> None:
    """Put an object somewhere; one that is there is not touched, so that FreeCAD does not think it has changed."""
    if not same_place(obj.Placement, placement):
        obj.Placement = placement
