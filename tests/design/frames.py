"""Motions, and the placements, axes and maps that say them in IFC."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from aadm_workbench.model import Array
from tests.design.authoring import Author


def motion(rng: np.random.Generator, reach_mm: float = 5000.0, *, upright: bool = False) -> Array:
    """A random motion (4, 4); an upright one turns about z alone."""
    T = np.eye(4)
    if upright:
        turn = rng.uniform(0.0, 2.0 * math.pi)
        T[:2, :2] = [[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]]
    else:
        q, r = np.linalg.qr(rng.normal(size=(3, 3)))
        q = q * np.sign(np.diag(r))
        T[:3, :3] = q if np.linalg.det(q) > 0.0 else -q
    T[:3, 3] = rng.uniform(-reach_mm, reach_mm, 3)
    return T


def shift(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Array:
    """A motion that turns nothing."""
    T = np.eye(4)
    T[:3, 3] = (x, y, z)
    return T


def on(T: Array, points: Any) -> Array:
    """Points (..., 3) after a motion."""
    return np.asarray(points, dtype=np.float64) @ T[:3, :3].T + T[:3, 3]


def axes(model: Author, T: Array) -> Any:
    return model.axes(T[:3, 3].tolist(), T[:3, 2].tolist(), T[:3, 0].tolist())


def placement(model: Author, parent: Any, T: Array) -> Any:
    return model.new("IfcLocalPlacement", parent, axes(model, T))


def mapped(model: Author, items: Sequence[Any], T: Array) -> Any:
    """An item mapped by a motion; the source's origin is its own frame."""
    drawn = model.new("IfcShapeRepresentation", model.body, "Body", "SolidModel", items)
    source = model.new("IfcRepresentationMap", model.axes(), drawn)
    target = model.new(
        "IfcCartesianTransformationOperator3D",
        Axis1=model.direction(T[:3, 0].tolist()),
        Axis2=model.direction(T[:3, 1].tolist()),
        Axis3=model.direction(T[:3, 2].tolist()),
        LocalOrigin=model.point(T[:3, 3].tolist()),
    )
    return model.new("IfcMappedItem", source, target)
