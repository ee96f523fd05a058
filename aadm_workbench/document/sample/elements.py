"""Objects of a FreeCAD document as elements: class, names, placement and bodies."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import numpy as np

from aadm_workbench.design.elements import Element, Solid, even_scale
from aadm_workbench.document.places import transform_of
from aadm_workbench.document.sample.objects import CLASS_PROPERTIES, Piece, is_spatial, originals, pieces, proxy_type
from aadm_workbench.document.sample.solids import solids_of, solids_of_mesh
from aadm_workbench.model import Reason

_PIECE_MARK = re.compile(r"^(piece ?mark|cast ?unit ?mark|构件编号|構件編號)$", re.IGNORECASE)
_KINDS = {"Rebar": "IfcReinforcingBar", "Floor": "IfcBuildingStorey"}
_NO_CLASS = frozenset({"", "Undefined", "IfcUndefined"})


def sample_elements(document: Any, problems: list[str]) -> list[Element]:
    """All elements of a document that have a body, each once; ``problems`` collects what was left out."""
    return elements_of(pieces(document, problems), problems)


def elements_of(found: Iterable[Piece], problems: list[str]) -> list[Element]:
    """The elements that pieces are: one for an object of a class, one for each body of an object without one."""
    bodies: dict[tuple[str, str], list[Solid]] = {}
    elements: list[Element] = []
    undrawn = 0
    for piece in found:
        key = (piece.obj.Document.Name, piece.obj.Name)
        if key not in bodies:
            bodies[key] = _bodies(piece.obj, problems)
            undrawn += not bodies[key] and _text(piece.obj, "ShapeMode") == "Coin"
        if not even_scale(piece.T_model_shape):
            problems.append(Reason("document.left_out.scaled", label=piece.shown.Label))
            continue
        elements += _elements(piece, [solid.moved(piece.T_model_shape) for solid in bodies[key]])
    if undrawn:
        problems.append(
            f"{undrawn} native IFC objects have no shape: set their ShapeMode to Shape, or read their .ifc file"
        )
    return elements


def ifc_class(obj: Any) -> str:
    """The IFC class of an object as its program knows it, such as IfcColumn; empty where it knows none."""
    for name in CLASS_PROPERTIES:
        said = str(getattr(obj, name, "") or "") if name in obj.PropertiesList else ""
        if said not in _NO_CLASS and (said.startswith("Ifc") or not name.endswith("Class")):
            return said if said.startswith("Ifc") else "Ifc" + "".join(word.capitalize() for word in said.split())
    own = _KINDS.get(proxy_type(obj), "")
    return own or next((said for original in originals(obj) if (said := ifc_class(original))), "")


def _bodies(obj: Any, problems: list[str]) -> list[Solid]:
    try:
        if hasattr(obj, "Mesh"):
            return solids_of_mesh(obj.Mesh)
        return solids_of(obj.Shape)
    except (RuntimeError, ValueError, ArithmeticError, AttributeError) as error:  # what the kernel raises of bad shapes
        problems.append(Reason("document.left_out.shape", label=obj.Label, why=error))
        return []


def _elements(piece: Piece, solids: list[Solid]) -> list[Element]:
    if not solids:
        return []
    known = "" if is_spatial(piece.obj) else ifc_class(piece.obj)
    if known or len(solids) == 1:
        return [_element(piece, piece.path, known, tuple(solids))]
    return [_element(piece, f"{piece.path}.Solid{k}", known, (solid,)) for k, solid in enumerate(solids, start=1)]


def _element(piece: Piece, path: str, known_class: str, solids: tuple[Solid, ...]) -> Element:
    obj = piece.obj
    own = [piece.shown.Label, obj.Label, *(_text(obj, name) for name in ("Description", "ObjectType", "Mark"))]
    own += [original.Label for original in originals(obj)]
    placement = getattr(obj, "Placement", None)
    T = piece.T_model_shape if placement is None else piece.T_model_shape @ transform_of(placement)
    return Element(
        GlobalId=path,
        Name=piece.shown.Label,
        said=" | ".join(dict.fromkeys(text for text in own if text)),
        solids=solids,
        T_model_element=_unscaled(T),
        Tag=_text(obj, "Tag"),
        ifc_class=known_class,
        kind=proxy_type(obj) or obj.TypeId,
        wholes=tuple(dict.fromkeys([obj.Label, *(group.Label for group in piece.inside if not is_spatial(group))])),
        ifc_guid=_guid(obj),
        predefined_type=_text(obj, "PredefinedType"),
        piece_mark=_piece_mark(obj),
        storey=next((group.Label for group in piece.inside if ifc_class(group) == "IfcBuildingStorey"), None),
    )


def _text(obj: Any, name: str) -> str:
    return str(getattr(obj, name, "") or "").strip() if name in obj.PropertiesList else ""


def _guid(obj: Any) -> str | None:
    kept = getattr(obj, "IfcData", None)
    return _text(obj, "GlobalId") or (kept.get("IfcUID") if isinstance(kept, dict) else None) or None


def _piece_mark(obj: Any) -> str | None:
    """The piece mark among an object's own properties, or among its IFC properties ("name;;set": "type;;value")."""
    for name in obj.PropertiesList:
        if _PIECE_MARK.match(name) and _text(obj, name):
            return _text(obj, name)
    kept = getattr(obj, "IfcProperties", None)
    for name, value in kept.items() if isinstance(kept, dict) else ():
        if _PIECE_MARK.match(name.split(";;")[0]) and value.split(";;")[-1]:
            return str(value.split(";;")[-1])
    return None


def _unscaled(T: np.ndarray) -> np.ndarray:
    """A placement (4, 4) without scale, and right-handed where a link mirrors."""
    T = T.copy()
    T[:3, :3] /= np.linalg.norm(T[:3, :3], axis=0)
    if np.linalg.det(T[:3, :3]) < 0.0:
        T[:3, 1] = -T[:3, 1]
    return T
