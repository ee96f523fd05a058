"""Elements of models that are no IFC files, without bodies that have no extent or lie nowhere."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from aadm_workbench.design.elements import Element, Solid
from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.design.sound import FARTHEST_MM
from aadm_workbench.model import Array, Reason

_NO_LENGTH_MM = 1e-6  # a thousandth of what designs are read to
_SHOWN = 6  # elements in a warning


def sound_elements(elements: Iterable[Element]) -> tuple[list[Element], list[str]]:
    """Elements with the bodies that are some, and a line on each element of which bodies were left out."""
    kept: list[Element] = []
    lines: list[str] = []
    for element in elements:
        solids = tuple(solid for solid in element.solids if _is_sound(solid))
        placed = _is_frame(element.T_model_element)
        if len(solids) < len(element.solids) or not placed:
            called = element.Name or element.GlobalId
            what = Reason("sound.placement") if not placed else Reason("sound.body")
            lines.append(Reason("sound.left_out", type=element.is_a() or "object", called=repr(called), why=what))
        if solids and placed:
            kept.append(replace(element, solids=solids))
    more = len(lines) - _SHOWN
    return kept, [*lines[:_SHOWN], Reason("sound.more", count=more)] if more > 0 else lines


def _is_sound(solid: Solid) -> bool:
    return (
        bool(solid.edges)
        and all(_is_line(line) for line in solid.edges)
        and all(_is_tube(tube) for tube in solid.tubes)
        and all(_is_bar(bar) for bar in solid.bars)
    )


def _is_line(line: Array) -> bool:
    return line.ndim == 2 and line.shape[1:] == (3,) and len(line) > 1 and _within(line)


def _is_tube(tube: Tube) -> bool:
    if not (_is_point(tube.start) and _is_point(tube.end) and tube.length_mm > _NO_LENGTH_MM):
        return False
    return all(_is_size(size) for size in (tube.outer_mm, *tube.bore_mm) if size is not None)


def _is_bar(bar: Course) -> bool:
    if not bar.legs or not _is_size(bar.diameter_mm):
        return False
    legs = [leg.points for leg in bar.legs]
    return all(_is_line(points) for points in legs) and all(leg.length_mm > _NO_LENGTH_MM for leg in bar.legs)


def _is_frame(T: Array) -> bool:
    if T.shape != (4, 4) or not _within(T):
        return False
    return abs(float(np.linalg.det(T[:3, :3]))) > _NO_LENGTH_MM


def _is_point(point: Array) -> bool:
    return point.shape == (3,) and _within(point)


def _is_size(size_mm: float) -> bool:
    return _NO_LENGTH_MM < size_mm < FARTHEST_MM


def _within(numbers: Array) -> bool:
    return bool((np.abs(numbers) < FARTHEST_MM).all())
