"""Elements of models that are no IFC files: FreeCAD documents, STEP, meshes; in the words of IFC, in plain numbers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.shapes import Mesh
from aadm_workbench.design.recognise.tubes import Tube, moved
from aadm_workbench.model import Array, Reason

_SAME_SCALE_RATIO = 1e-6  # rounding of a transform that files write with seven digits
_FEW_POINTS = 16  # all of them are looked at; of more the ends of the box
_SUBTRACTIONS = frozenset({"IfcOpeningElement", "IfcVoidingFeature", "IfcOpeningStandardCase"})
_REINFORCING = frozenset(
    {"IfcReinforcingBar", "IfcReinforcingMesh", "IfcTendon", "IfcTendonAnchor", "IfcTendonConduit"}
)


@dataclass(frozen=True, eq=False)
class Solid:
    """One body of an element: what is round in it, and the lines that span its extent.

    ``bars`` are the bent ones; straight ones are tubes without a bore. ``edges`` holds polylines (k, 3) mm.
    """

    tubes: tuple[Tube, ...]
    bars: tuple[Course, ...]
    edges: tuple[Array, ...]

    def moved(self, T: Array) -> Solid:
        """The same after a motion (4, 4), which may scale alike in all directions or mirror."""
        return Solid(
            tubes=tuple(moved(tube, T) for tube in self.tubes),
            bars=tuple(bar.moved(T) for bar in self.bars),
            edges=tuple(line @ T[:3, :3].T + T[:3, 3] for line in self.edges),
        )

    @property
    def place(self) -> Array:
        """(4,) mm: where it stands and how large it is, the same for the same body however often it is drawn.

        Of a round body by its axis: where its seam lies differs from drawing to drawing.
        """
        if len(self.tubes) == 1 and self.tubes[0].outer_mm is not None:
            tube = self.tubes[0]
            return np.array([*(tube.start + tube.end) / 2.0, tube.length_mm + (tube.outer_mm or 0.0)])
        ends = np.array([line[[0, -1]] for line in self.edges])
        length_mm = float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())
        return np.array([*ends.reshape(-1, 3).mean(axis=0), length_mm])

    @property
    def body(self) -> Mesh:
        """Its outermost points, from which a column's foot face is found."""
        points = outermost(np.concatenate(self.edges))
        return Mesh(points, ((np.arange(len(points)),),))


def outermost(points: Array) -> Array:
    """The corners (m, 3) of the convex hull of points (n, 3); all of them where they lie in a plane."""
    from scipy.spatial import ConvexHull, QhullError  # slow to import, and only whole bodies need it

    distinct = np.unique(points, axis=0)
    if len(distinct) <= _FEW_POINTS:
        return distinct
    try:
        hull = ConvexHull(distinct - distinct[0])
    except QhullError:
        return distinct
    corners: Array = distinct[hull.vertices]
    return corners


@dataclass(frozen=True, eq=False)
class Element:
    """An element of a model, under the attribute names of IFC, so that one recipe serves all formats.

    Parameters
    ----------
    GlobalId
        What tells it from all others of the model; for FreeCAD the path to the object, such as ``Link.Body``.
    Name, Tag
        What people call it.
    ifc_class
        Its class where the model knows one, such as IfcColumn; else empty.
    kind
        What its own program calls this kind of object, such as ``Part::Cylinder``.
    said
        All that it is called, in one line.
    solids
        Its bodies, mm, model frame.
    T_model_element
        (4, 4): its placement.
    wholes
        What the groups and assemblies that it stands in are called, from near to far.
    ifc_guid
        GlobalId of the IFC element that it stands for, where known.
    predefined_type, piece_mark, storey
        As in IFC, where known.
    """

    GlobalId: str
    Name: str
    said: str
    solids: tuple[Solid, ...]
    T_model_element: Array
    Tag: str = ""
    ifc_class: str = ""
    kind: str = ""
    wholes: tuple[str, ...] = ()
    ifc_guid: str | None = None
    predefined_type: str = ""
    piece_mark: str | None = None
    storey: str | None = None

    def is_a(self, ifc_class: str | None = None) -> str | bool:
        """The class, or the kind where there is none; with an argument whether it is of that class or one above."""
        if ifc_class is None:
            return self.ifc_class or self.kind
        above = {"IfcElement", self.ifc_class}
        if self.ifc_class in _SUBTRACTIONS:
            above |= {"IfcFeatureElement", "IfcFeatureElementSubtraction"}
        if self.ifc_class in _REINFORCING:
            above.add("IfcReinforcingElement")
        return ifc_class in above

    def id(self) -> str:
        """What tells it from all others."""
        return self.GlobalId

    def moved(self, T: Array) -> Element:
        """The same after a motion (4, 4), which may scale alike in all directions; its placement keeps no scale."""
        placement = T @ self.T_model_element
        placement[:3, :3] /= np.linalg.norm(placement[:3, :3], axis=0)
        return replace(self, solids=tuple(solid.moved(T) for solid in self.solids), T_model_element=placement)

    @property
    def tubes(self) -> list[Tube]:
        """Straight round bodies and holes of all its bodies."""
        return [tube for solid in self.solids for tube in solid.tubes]


def even_scale(T: Array) -> bool:
    """Whether a motion (4, 4) scales alike in all directions, so that what is round stays round; it may mirror."""
    gram = T[:3, :3].T @ T[:3, :3]
    factor = float(np.trace(gram)) / 3.0
    return bool(np.abs(gram - factor * np.eye(3)).max() < _SAME_SCALE_RATIO * factor)


def counted_once(elements: Iterable[Element]) -> list[Element]:
    """Elements without the bodies that an earlier one draws in the same place; those left without any drop out.

    Programs draw a thing twice: as itself and in a group's own shape, or as an original under the first of its copies.
    """
    drawn: set[tuple[int, ...]] = set()
    kept: list[Element] = []
    for element in elements:
        solids = []
        for solid in element.solids:
            if not drawn.intersection(places := _places(solid)):
                solids.append(solid)
            drawn.update(places[:1])
        if solids:
            kept.append(replace(element, solids=tuple(solids)))
    return kept


_SAME_PLACE_MM = 0.01  # what is drawn twice is drawn at the same place, up to rounding


def _places(solid: Solid) -> list[tuple[int, ...]]:
    """Cells that a body of the same place and size may have been noted in, the first its own."""
    at = (solid.place / _SAME_PLACE_MM).tolist()
    own = [math.floor(value) for value in at]
    # A neighbour across the nearer border of a cell may differ by rounding alone.
    nearer = [cell - 1 if value - cell < 0.5 else cell + 1 for value, cell in zip(at, own, strict=True)]
    return list(product(*zip(own, nearer, strict=True)))


def holdings(elements: Sequence[Element]) -> str:
    """What a model holds, by class, the most frequent first: "2 IfcColumn, 24 Part::Cylinder"."""
    count: dict[str, int] = {}
    for element in elements:
        called = str(element.is_a())
        count[called] = count.get(called, 0) + 1
    ranked = sorted(count.items(), key=lambda item: (-item[1], item[0]))
    parts = [f"{number} {called}" for called, number in ranked]
    return Reason("said.list", parts=parts) if parts else Reason("design.no_solids")
