"""GlobalIds that several elements of a model have, as copying and careless exporters give them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from aadm_workbench.model import ColumnDesign, Reason
from aadm_workbench.model.reason import listed

_SHOWN = 3  # ids in a message
_GLOBAL_ID = 0  # place of the GlobalId among the attributes of an IfcRoot


def elements_by_id(file: Any) -> dict[str, list[Any]]:
    """The elements of a model by GlobalId; several where they share one."""
    found: dict[str, list[Any]] = {}
    for element in file.by_type("IfcElement"):
        found.setdefault(element[_GLOBAL_ID], []).append(element)
    return found


def shared_ids(file: Any) -> dict[str, list[Any]]:
    """GlobalIds that more than one element has, with those elements."""
    return {global_id: elements for global_id, elements in elements_by_id(file).items() if len(elements) > 1}


def shared_id_warning(shared: dict[str, list[Any]]) -> list[str]:
    """One line on all of them; none where each element has its own."""
    if not shared:
        return []
    shown = [Reason("said.of", what=one, why=_listed(elements)) for one, elements in list(shared.items())[:_SHOWN]]
    more = [Reason("assembly.more", count=len(shared) - _SHOWN)] if len(shared) > _SHOWN else []
    code = "ifc.shared_id" if len(shared) == 1 else "ifc.shared_ids"
    return [Reason(code, count=len(shared), shown=[*shown, *more])]


def with_shared_ids(design: ColumnDesign, shared: dict[str, list[Any]]) -> ColumnDesign:
    """A column that says which of its points, or whether it itself, has a GlobalId that another element has too."""
    points = [point.label for point in (*design.sleeves, *design.rebars) if point.global_id in shared]
    return replace(design, shared_ids=(*(["column"] if design.global_id in shared else []), *points))


def _listed(elements: Sequence[Any]) -> str:
    return listed([f"#{element.id()} {element.is_a()}" for element in elements], _SHOWN)
