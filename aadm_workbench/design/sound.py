"""Whether a solid is one: exporters write sweeps without length, faces without corners, coordinates beyond all maps.

Elements of models that are no IFC files, without bodies that have no extent or lie nowhere.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from aadm_workbench.design.elements import Element, Solid
from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.paths import joined
from aadm_workbench.design.recognise.shapes import Cut, HalfSpace, Loop, Mesh, Prism, Shape, SweptDisk, Turned
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.model import Array, Reason

FARTHEST_MM = 1e12
"""Twenty times around the earth: coordinates beyond are no places, and their squares still fit a float."""

_NO_LENGTH_MM = 1e-6  # a thousandth of what designs are read to
_FEWEST_CORNERS = 3  # two make no face

_SHOWN = 6  # elements in a warning


class UnsoundError(ValueError):
    """A solid that encloses nothing, or lies nowhere."""


def sound(shape: Shape) -> Shape:
    """The solid without what has no length or area in it.

    Raises
    ------
    UnsoundError
        Where nothing is left; says what is wrong with it.
    """
    match shape:
        case SweptDisk():
            return _swept(shape)
        case Prism():
            return _prism(shape)
        case Turned():
            return _turned(shape)
        case Mesh():
            return _mesh(shape)
        case HalfSpace():
            _check_places(shape.point, shape.towards)
            return shape
        case Cut():
            return shape  # its body and its tool have been looked at before it was made


def _swept(disk: SweptDisk) -> SweptDisk:
    for leg in disk.legs:
        _check_places(leg.points)
    legs = tuple(joined(disk.legs))
    if not legs:
        raise UnsoundError(Reason("geometry.unsound_no_line"))
    _check_size(disk.radius_mm, "radius")
    return replace(disk, legs=legs)


def _prism(prism: Prism) -> Prism:
    _check_places(prism.sweep, *(loop.points for loop in (prism.outer, *prism.holes)))
    if float(np.linalg.norm(prism.sweep)) < _NO_LENGTH_MM:
        raise UnsoundError(Reason("geometry.unsound_no_depth"))
    if not _has_extent(prism.outer):
        raise UnsoundError(Reason("geometry.unsound_no_area"))
    return replace(prism, holes=tuple(hole for hole in prism.holes if _has_extent(hole)))


def _has_extent(loop: Loop) -> bool:
    if len(loop.points) < _FEWEST_CORNERS:
        return False
    spans = loop.points - loop.points[0]
    farthest = spans[int(np.argmax((spans**2).sum(axis=1)))]
    return bool(np.linalg.norm(np.cross(spans, farthest), axis=1).max() > _NO_LENGTH_MM)


def _turned(turned: Turned) -> Turned:
    _check_places(turned.origin, turned.axis, turned.outline_rz)
    if np.ptp(turned.outline_rz[:, 1]) < _NO_LENGTH_MM or turned.outline_rz[:, 0].max() < _NO_LENGTH_MM:
        raise UnsoundError(Reason("geometry.unsound_turned_no_area"))
    return turned


def _mesh(mesh: Mesh) -> Mesh:
    """The faces of three corners and more; a corner that is not there makes the whole solid doubtful."""
    _check_places(mesh.vertices)
    for face in mesh.faces:
        for loop in face:
            if len(loop) and (loop.min() < 0 or loop.max() >= len(mesh.vertices)):
                raise UnsoundError(Reason("geometry.unsound_no_corner"))
    faces = tuple(
        (face[0], *(hole for hole in face[1:] if len(hole) >= _FEWEST_CORNERS))
        for face in mesh.faces
        if face and len(face[0]) >= _FEWEST_CORNERS
    )
    if not faces:
        raise UnsoundError(Reason("geometry.unsound_no_faces"))
    return replace(mesh, faces=faces)


def _check_places(*places: Array) -> None:
    for points in places:
        if not (np.abs(points) < FARTHEST_MM).all():
            raise UnsoundError(Reason("geometry.unsound_far"))


def _check_size(size_mm: float, what: str) -> None:
    if not _NO_LENGTH_MM < size_mm < FARTHEST_MM:
        raise UnsoundError(Reason("geometry.unsound_size", what=what, size_mm=size_mm))


def sound_elements(elements: Iterable[Element]) -> tuple[list[Element], list[str]]:
    """Elements with the bodies that are some, and a line on each element of which bodies were left out."""
    kept: list[Element] = []
    lines: list[str] = []
    for element in elements:
        solids = tuple(solid for solid in element.solids if _is_sound(solid))
        placed = _is_frame(element.T_model_element)
        if len(solids) < len(element.solids) or not placed:
            called = element.Name or element.GlobalId
            what = Reason("geometry.unsound_placement") if not placed else Reason("geometry.unsound_body")
            lines.append(
                Reason("geometry.unsound_left_out", type=element.is_a() or "object", called=repr(called), why=what)
            )
        if solids and placed:
            kept.append(replace(element, solids=solids))
    more = len(lines) - _SHOWN
    return kept, [*lines[:_SHOWN], Reason("geometry.unsound_more", count=more)] if more > 0 else lines


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
