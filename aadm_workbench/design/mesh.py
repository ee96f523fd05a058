"""As-designed points of meshes: STL, OBJ and PLY, which know no units and mostly no names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from aadm_workbench.design.elements import Element, Solid
from aadm_workbench.design.mesh_sections import round_walls
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.model_file import MESHES, sha256_of
from aadm_workbench.design.model_units import MM_PER_UNIT, check_units
from aadm_workbench.design.recognise.columns import Origin, Rules, recognise
from aadm_workbench.design.recognise.facets import facet_solid, sharp_edges
from aadm_workbench.design.recognise.round_faces import tubes_of
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.errors import DesignError, needed
from aadm_workbench.model import Array, ColumnDesign, IntArray, Reason

_UP = np.array([0.0, 0.0, 1.0])
_SAME_VERTEX_RATIO = 1e-7  # of the largest coordinate: single precision keeps as much
_SLENDER_RATIO = 1.5  # length over width: a column lies or stands where it is longer
_ON_TUBE_MM = 0.5  # axes and walls of what is one tube, up to facets and rounding
_ALONG_COS = float(np.cos(np.radians(10.0)))  # 10 degrees
_UPRIGHT_COS = float(np.cos(np.radians(2.0)))  # 2 degrees: models stand square


@dataclass(frozen=True, eq=False)
class Body:
    """One connected body of a mesh: its name in the file, ``vertices`` (n, 3) mm and ``corners`` (m, 3)."""

    name: str
    vertices: Array
    corners: IntArray


def read_mesh(path: str | Path, rules: Rules | None = None, *, units: str = "mm") -> ModelDesign:
    """Columns, sleeves and connecting rebars of a mesh, by its shape and, in OBJ, by the names of its objects.

    Parameters
    ----------
    units
        Unit of its coordinates, which no mesh file tells: mm, cm, m, inch or foot.

    Raises
    ------
    DesignError
        Where the file is no such mesh, its size contradicts the unit, or a rule finds nothing.
    MissingDependencyError
        Where trimesh is not installed.
    """
    began = perf_counter()
    path = Path(path)
    sha256 = sha256_of(path)
    bodies = mesh_bodies(path, units)
    origin = Origin(str(path), sha256, MESHES[path.suffix.lower()])
    found = recognise(_elements(bodies), origin, rules)
    if not found.columns:
        low, high = bounds(bodies)

        def columns_in(other: str) -> Sequence[ColumnDesign]:
            factor = MM_PER_UNIT[other] / MM_PER_UNIT[units]
            scaled = [replace(body, vertices=factor * body.vertices) for body in bodies]
            return recognise(_elements(scaled), origin).columns

        check_units(str(path), units, high - low, columns_in)
    return replace(found, seconds=perf_counter() - began)


def mesh_bodies(path: Path, units: str) -> list[Body]:
    """The connected bodies of a mesh file, mm.

    Raises
    ------
    DesignError
        Where the file is no such mesh, or its size contradicts the unit.
    MissingDependencyError
        Where trimesh is not installed.
    """
    if units not in MM_PER_UNIT:
        raise DesignError(Reason("design.units", units=repr(units), known=MM_PER_UNIT))
    with needed("trimesh", "reading meshes"):
        import trimesh
    try:
        with path.open("rb") as stream:
            scene: Any = trimesh.load_scene(stream, file_type=path.suffix[1:].lower(), **_options(path))
        parts = [(_given(path, str(name)), _placed(scene, name)) for name in scene.graph.nodes_geometry]
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, NotImplementedError, MemoryError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise DesignError(Reason("design.mesh_unread", path=path, why=reason)) from error
    bodies = [body for name, (vertices, corners) in parts for body in _connected(name, vertices, corners, units)]
    if not bodies:
        raise DesignError(Reason("design.no_triangles", path=path))
    return bodies


def _options(path: Path) -> dict[str, Any]:
    return {"split_objects": True, "skip_materials": True} if path.suffix.lower() == ".obj" else {}


def _given(path: Path, name: str) -> str:
    """The name that a file gives a body; trimesh makes up names of its own."""
    return "" if name.startswith(("geometry_", "world")) or name.split("_", maxsplit=1)[0] == path.name else name


def _placed(scene: Any, node: str) -> tuple[Array, IntArray]:
    T_scene_node, name = scene.graph[node]
    mesh = scene.geometry[name]
    vertices = np.asarray(getattr(mesh, "vertices", np.zeros((0, 3))), dtype=np.float64)
    corners = np.asarray(getattr(mesh, "faces", np.zeros((0, 3))), dtype=np.int64).reshape(-1, 3)
    if not np.isfinite(vertices).all():
        raise ValueError(Reason("design.no_coordinates"))
    if len(corners) and (corners.min() < 0 or corners.max() >= len(vertices)):
        raise ValueError(Reason("design.no_vertices"))
    return vertices @ T_scene_node[:3, :3].T + T_scene_node[:3, 3], corners


def _connected(name: str, vertices: Array, corners: IntArray, units: str) -> list[Body]:
    """Bodies whose triangles share vertices; vertices at one place are one."""
    if not len(corners):
        return []
    vertices = MM_PER_UNIT[units] * vertices
    middle = vertices.mean(axis=0)
    step_mm = max(1e-3, _SAME_VERTEX_RATIO * float(np.abs(vertices).max()))
    _, first, number = np.unique(
        np.round((vertices - middle) / step_mm).astype(np.int64), axis=0, return_index=True, return_inverse=True
    )
    vertices, corners = vertices[first], number.reshape(-1)[corners]
    from scipy.sparse import coo_matrix  # slow to import, and only meshes need it
    from scipy.sparse.csgraph import connected_components

    pairs = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]]])
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(vertices), len(vertices)))
    label = connected_components(graph, directed=False)[1][corners[:, 0]]
    order = np.argsort(label, kind="stable")
    cuts = np.flatnonzero(np.diff(label[order])) + 1
    return [_body(name, vertices, corners[part]) for part in np.split(order, cuts)]


def _body(name: str, vertices: Array, corners: IntArray) -> Body:
    used, number = np.unique(corners, return_inverse=True)
    return Body(name, vertices[used], number.reshape(corners.shape).astype(np.int64))


def _elements(bodies: Sequence[Body]) -> list[Element]:
    return [
        Element(
            GlobalId=f"{body.name or 'body'}-{number}",
            Name=body.name,
            said=body.name,
            solids=(_solid(body),),
            T_model_element=np.eye(4),
            kind="Mesh",
        )
        for number, body in enumerate(bodies, start=1)
    ]


def _solid(body: Body) -> Solid:
    """A body with what is round in it: by its rims where these explain all of it, else by sections."""
    by_rims = facet_solid(body.vertices, body.corners)
    if by_rims.bars or (len(by_rims.tubes) == 1 and _explains(by_rims.tubes[0], body.vertices)):
        return by_rims
    walls = [wall for axis in _axes(body.vertices) for wall in round_walls(body.vertices, body.corners, axis)]
    found = tubes_of(walls)
    crossing = [tube for tube in by_rims.tubes if not any(_parallel(tube, other) for other in found)]
    return Solid((*found, *crossing), (), sharp_edges(body.vertices, body.corners))


def _explains(tube: Tube, vertices: Array) -> bool:
    """Whether all vertices of a body lie on the walls of a tube, or on its rims."""
    if tube.outer_mm is None:
        return False
    along = (tube.end - tube.start) / tube.length_mm
    spokes = vertices - tube.start
    off_axis_mm = np.linalg.norm(spokes - (spokes @ along)[:, np.newaxis] * along, axis=1)
    widths_mm = np.array([tube.outer_mm, *(bore for bore in tube.bore_mm if bore is not None)])
    on_axis = off_axis_mm < _ON_TUBE_MM
    on_wall = np.abs(off_axis_mm[:, np.newaxis] - widths_mm / 2.0).min(axis=1) < _ON_TUBE_MM
    return bool(np.all(on_wall | on_axis))


def _axes(vertices: Array) -> list[Array]:
    """Directions that holes and bars may run along: upright, and the long way of a slender body that lies or leans."""
    centred = vertices - vertices.mean(axis=0)
    _, spread, rows = np.linalg.svd(centred, full_matrices=False)
    if (
        len(spread) == 3
        and spread[0] > _SLENDER_RATIO * spread[1]
        and abs(float(rows[0] @ _UP)) < np.cos(np.radians(2.0))
    ):
        return [rows[0]]
    return [_UP]


def _parallel(first: Tube, second: Tube) -> bool:
    ways = [(tube.end - tube.start) / tube.length_mm for tube in (first, second)]
    return abs(float(ways[0] @ ways[1])) > _ALONG_COS


def bounds(bodies: Sequence[Body]) -> tuple[Array, Array]:
    """Lowest and highest corner (3,) mm of all bodies."""
    corners = np.array([(body.vertices.min(axis=0), body.vertices.max(axis=0)) for body in bodies])
    return corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)
