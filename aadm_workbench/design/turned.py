"""Cones and other turned solids: how wide they are where something ends in them, and what a plane leaves of them."""

from __future__ import annotations

import numpy as np

from aadm_workbench.design.recognise.shapes import Cut, HalfSpace, Shape, Turned
from aadm_workbench.model import Array

_ACROSS_COS = 1.0 - 1e-9  # 0.003 degrees: exporters write six digits
_INSIDE_MM = 1e-6  # a thousandth of what designs are read to


def as_turned(shape: Shape) -> Turned | None:
    """A solid as a full turn of an outline, where it is one, planes across its axis included; else None."""
    if isinstance(shape, Turned):
        return shape
    if isinstance(shape, Cut) and isinstance(shape.tool, HalfSpace):
        body = as_turned(shape.body)
        return None if body is None else _clipped(body, shape.tool)
    return None


def radius_at(turned: Turned, height_mm: float) -> float | None:
    """Outer radius, mm, at a height over the origin along the axis; None above and below the solid."""
    low, high = float(turned.outline_rz[:, 1].min()), float(turned.outline_rz[:, 1].max())
    if not low - _INSIDE_MM < height_mm < high + _INSIDE_MM:
        return None
    height_mm = min(max(height_mm, low), high)
    found: list[float] = []
    for (r0, h0), (r1, h1) in zip(turned.outline_rz, np.roll(turned.outline_rz, -1, axis=0), strict=True):
        if min(h0, h1) <= height_mm <= max(h0, h1):
            part = 0.0 if h0 == h1 else (height_mm - h0) / (h1 - h0)
            found += [float(r0), float(r1)] if h0 == h1 else [float(r0 + part * (r1 - r0))]
    return max(found)


def _clipped(turned: Turned, away: HalfSpace) -> Turned | None:
    cosine = float(turned.axis @ away.towards)
    if away.bounded or abs(cosine) < _ACROSS_COS:
        return None
    level_mm = float((away.point - turned.origin) @ turned.axis)
    side = 1.0 if cosine > 0.0 else -1.0
    outline = _below(turned.outline_rz * [1.0, side], side * level_mm) * [1.0, side]
    return Turned(turned.origin, turned.axis, outline) if len(outline) else None


def _below(outline: Array, level_mm: float) -> Array:
    """What a level leaves below it of a closed outline (n, 2) of radius and height (Sutherland and Hodgman)."""
    kept: list[Array] = []
    for here, onwards in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        if here[1] <= level_mm:
            kept.append(here)
        if (here[1] - level_mm) * (onwards[1] - level_mm) < 0.0:
            kept.append(here + (level_mm - here[1]) / (onwards[1] - here[1]) * (onwards - here))
    return np.array(kept).reshape(-1, 2)
