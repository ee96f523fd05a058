"""What an IFC product is drawn as: its solids, the tubes and the bars in them, its axis; in the model frame."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, NamedTuple, TypeVar

import numpy as np

from aadm_workbench.design.ifc.geometry.curve import Curves
from aadm_workbench.design.ifc.geometry.grid_placement import grid_frame
from aadm_workbench.design.ifc.geometry.placement import NothingThereError, Placements
from aadm_workbench.design.ifc.geometry.profile import Profiles
from aadm_workbench.design.ifc.geometry.representation import axis_items, body_of
from aadm_workbench.design.ifc.geometry.solids import BROKEN, Solids
from aadm_workbench.design.ifc.names import optional
from aadm_workbench.design.recognise.bar_courses import Course, courses, whole_bars
from aadm_workbench.design.recognise.paths import Leg, joined
from aadm_workbench.design.recognise.shapes import Mesh, Shape
from aadm_workbench.design.recognise.tubes import Tube, moved, tubes
from aadm_workbench.model import Array, Reason
from aadm_workbench.model.reason import reason_of

Part = TypeVar("Part")

_FEWEST_SIDES = 4  # FreeCAD draws circles with four
_MOST_ITEMS = 100_000
"""Pieces of one element; a cage of reinforcement has some thousands."""

_SAME_MM = 1e-4
"""Vertices that differ by less are drawn alike."""


class _Source(NamedTuple):
    """An IfcRepresentationMap: number of what it shows, items and origin; ``plain`` where none of them is mapped."""

    number: int
    items: Sequence[Any]
    T: Array
    plain: bool


@dataclass(frozen=True, eq=False)
class Shapes:
    """Evaluates the shapes of products and keeps those that are drawn many times.

    ``problems`` collects what could not be evaluated, one line for each kind; ``reasons`` says by the number of a
    product why nothing, or not all, is drawn of it. ``coarse`` where the file comes from a program that draws circles
    with four sides.
    """

    solids: Solids
    coarse: bool = False
    problems: list[str] = field(default_factory=list)
    reasons: dict[int, str] = field(default_factory=dict)
    _coarse_tubes: dict[int, tuple[Tube, ...]] = field(default_factory=dict, repr=False)
    _tubes: dict[int, tuple[Tube, ...]] = field(default_factory=dict, repr=False)
    _congruent: dict[tuple[str, bytes, bytes, bytes], Any] = field(default_factory=dict, repr=False)
    _courses: dict[int, tuple[Course, ...]] = field(default_factory=dict, repr=False)
    _sources: dict[int, _Source] = field(default_factory=dict, repr=False)

    @property
    def placements(self) -> Placements:
        """Where things stand."""
        return self.solids.placements

    @property
    def curves(self) -> Curves:
        """What bars are bent along."""
        return self.solids.curves

    def of_product(self, product: Any) -> tuple[Shape, ...]:
        """The bodies of a product, mm, in the model frame; none where it has none or they are broken."""
        found: list[Shape] = []
        for item, T in self._items(product):
            try:
                found += [shape.moved(T) for shape in self._shapes(product, item)]
            except BROKEN as error:
                self._note(product, error)
        return tuple(found)

    def tubes_of_product(
        self, product: Any, *, coarse: bool = False, near: Callable[[Array], bool] | None = None
    ) -> tuple[Tube, ...]:
        """Straight round bodies and holes of a product, mm, in the model frame.

        ``coarse`` where even a regular polygon of four sides is a circle: the product is known to be round.
        ``near`` tells for a point (3,) mm of a solid whether that solid is of interest; others are not evaluated.
        """
        if coarse or self.coarse:
            return self._parts(product, self._coarse_tubes, _coarse_tubes, moved, near)
        return self._parts(product, self._tubes, tubes, moved, near)

    def bars_of_product(self, product: Any) -> list[Course]:
        """Bars that a product's bodies are, mm, in the model frame."""
        return whole_bars(self._parts(product, self._courses, courses, Course.moved))

    def axes_of_product(self, product: Any) -> list[tuple[Leg, ...]]:
        """The lines in space that a product is drawn along, mm, in the model frame."""
        found = []
        try:
            T = self.placements.of_product(product)
            for item, T_product_item in self._leaves(axis_items(product), np.eye(4)):
                curves = item.Elements if item.is_a("IfcGeometricSet") else (item,)
                legs = [joined(self.curves.legs(curve)) for curve in curves if curve.is_a("IfcCurve")]
                found += [tuple(leg.moved(T @ T_product_item) for leg in line) for line in legs if line]
        except BROKEN as error:
            self._note(product, error)
        return found

    def _parts(
        self,
        product: Any,
        known: dict[int, tuple[Part, ...]],
        recognise: Callable[[Shape], Sequence[Part]],
        move: Callable[[Part, Array], Part],
        near: Callable[[Array], bool] | None = None,
    ) -> tuple[Part, ...]:
        """What is recognised in a product's solids, once for all occurrences of a type: facets take their time."""
        found: list[Part] = []
        for item, T in self._items(product):
            anchor = None if near is None else self.solids.anchor(item)
            if anchor is not None and near is not None and not near(T[:3, :3] @ anchor + T[:3, 3]):
                continue
            try:
                if item.id() not in known:
                    shapes = self._shapes(product, item)
                    known[item.id()] = tuple(part for s in shapes for part in self._parts_of(s, recognise, move))
                found += [move(part, T) for part in known[item.id()]]
            except BROKEN as error:
                known[item.id()] = ()
                self._note(product, error)
        return tuple(found)

    def _parts_of(
        self, shape: Shape, recognise: Callable[[Shape], Sequence[Part]], move: Callable[[Part, Array], Part]
    ) -> Sequence[Part]:
        """What is recognised in a solid; in facets that are drawn again at another place, from the first of them."""
        if not isinstance(shape, Mesh):
            return recognise(shape)
        place = np.eye(4)
        place[:3, 3] = shape.vertices[0]
        local = shape.vertices - shape.vertices[0]
        loops = [loop for face in shape.faces for loop in face]
        lengths = np.array([len(loop) for loop in loops] + [len(face) for face in shape.faces])
        drawing = np.round(local / _SAME_MM).astype(np.int64)
        key = recognise.__name__, drawing.tobytes(), lengths.tobytes(), np.concatenate(loops).tobytes()
        if key not in self._congruent:
            self._congruent[key] = recognise(Mesh(local, shape.faces))
        return [move(part, place) for part in self._congruent[key]]

    def _items(self, product: Any) -> list[tuple[Any, Array]]:
        """The items of a product's body, each with the motion that places it in the model; mapped ones resolved."""
        try:
            context, items = body_of(product)
            leaves = self._leaves(items, self.placements.of_product(product, context))
            found = list(islice(leaves, _MOST_ITEMS))
            if next(leaves, None) is not None:
                raise NothingThereError(Reason("geometry.pieces", most=_MOST_ITEMS))
            return found
        except BROKEN as error:
            self._note(product, error)
            return []

    def _leaves(self, items: Iterable[Any], T: Array, within: tuple[int, ...] = ()) -> Iterator[tuple[Any, Array]]:
        for item in items:
            if item.is_a() != "IfcMappedItem":
                yield item, T
                continue
            source = self._source(optional(item, "MappingSource"))
            if source.number in within:
                raise NothingThereError(Reason("geometry.own_mapped", id=item.id()))
            T_item = T @ (self.placements.of_operator(optional(item, "MappingTarget")) @ source.T)
            if source.plain:
                yield from ((leaf, T_item) for leaf in source.items)
            else:
                yield from self._leaves(source.items, T_item, (*within, source.number))

    def _source(self, drawn: Any) -> _Source:
        """What thousands of mapped items share, read once."""
        number = drawn.id()
        if number not in self._sources:
            items = optional(optional(drawn, "MappedRepresentation"), "Items")
            plain = not any(item.is_a() == "IfcMappedItem" for item in items)
            shown = optional(drawn, "MappedRepresentation").id()
            self._sources[number] = _Source(
                shown, items, self.placements.of_axes(optional(drawn, "MappingOrigin")), plain
            )
        return self._sources[number]

    def _shapes(self, product: Any, item: Any) -> tuple[Shape, ...]:
        try:
            return self.solids.of_item(item)
        except BROKEN as error:
            self.solids.leave_out(item)
            self._note(product, error)
            return ()

    @contextmanager
    def guarded(self, product: Any) -> Iterator[None]:
        """Leave a product out where something of it, or related to it, is broken; the rest of the model is read."""
        try:
            yield
        except BROKEN as error:
            self._note(product, error)

    def undrawn(self, product: Any) -> str:
        """Why nothing is drawn of a product, for the list of what was left out."""
        reason = self.reasons.get(product.id())
        return Reason("geometry.none.since" if reason else "geometry.none", why=reason)

    def _note(self, product: Any, error: Exception) -> None:
        said = reason_of(error) or type(error).__name__
        self.reasons.setdefault(product.id(), said)
        self.problems.append(Reason("geometry.left_out", type=product.is_a(), global_id=product.GlobalId, why=said))


def _coarse_tubes(shape: Shape) -> list[Tube]:
    return tubes(shape, _FEWEST_SIDES)


def evaluator(mm: float, radians: float, *, coarse: bool = False) -> Shapes:
    """An evaluator for a file whose units of length and angle are given in millimetres and radians."""
    placements = Placements(mm, grid_frame)
    curves = Curves(placements, radians)
    return Shapes(Solids(placements, curves, Profiles(placements, curves)), coarse)
