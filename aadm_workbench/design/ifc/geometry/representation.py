"""Which of a product's representations draws its body, which its axis, and in what context they are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from aadm_workbench.design.ifc.names import optional

_NOT_BODIES = frozenset(
    {
        *("annotation", "axis", "box", "clearance", "cog", "footprint", "lighting", "plan", "profile", "reference"),
        *("surveypoints", "structural", "mass"),
    }
)
_NOT_SOLIDS = frozenset(
    {
        *("annotation2d", "boundingbox", "curve", "curve2d", "curve3d", "geometriccurveset", "point", "pointcloud"),
        *("lightsource", "text", "fillarea"),
    }
)
_BODIES = ("body", "body-fallback", "facetation", "tessellation")
_PLANS = frozenset({"PLAN_VIEW", "REFLECTED_PLAN_VIEW", "SECTION_VIEW", "ELEVATION_VIEW", "SKETCH_VIEW"})


def body_of(product: Any) -> tuple[Any, list[Any]]:
    """The context of a product's body, and its representation items; not those of its axis, box or footprint.

    Where it has no body the context is that of whatever is drawn; None where nothing is.
    """
    drawn = _drawn(product)
    alone = len(drawn) == 1 and optional(drawn[0], "RepresentationIdentifier") == "Body"
    bodies = drawn if alone else _bodies(drawn)
    contexts = (optional(shape, "ContextOfItems") for shape in (*bodies, *drawn))
    context = next((context for context in contexts if context is not None), None)
    return context, [item for shape in bodies for item in optional(shape, "Items")]


def axis_items(product: Any) -> list[Any]:
    """The curves that a product is drawn along, where it has any in space."""
    return [
        item
        for shape in _drawn(product)
        if _identifier(shape) == "axis" or (not _identifier(shape) and _kind(shape) in ("curve3d", "curve"))
        for item in shape.Items
    ]


def _bodies(drawn: Sequence[Any]) -> Sequence[Any]:
    """The representations of one body: a product may be drawn a second time, for plans or in coarser facets."""
    solid = [shape for shape in drawn if _may_be_solid(shape)]
    solid = [shape for shape in solid if not _in_plan(shape.ContextOfItems)] or solid
    for identifier in _BODIES:
        named = [shape for shape in solid if _identifier(shape) == identifier]
        if named:
            return [shape for shape in named if shape.ContextOfItems == named[0].ContextOfItems]
    return solid[:1]


def _drawn(product: Any) -> Sequence[Any]:
    representation = optional(product, "Representation")
    return () if representation is None else optional(representation, "Representations")


def _may_be_solid(shape: Any) -> bool:
    return _identifier(shape) not in _NOT_BODIES and _kind(shape) not in _NOT_SOLIDS


def _in_plan(context: Any) -> bool:
    if context is None:
        return False
    return context.ContextType == "Plan" or optional(context, "TargetView") in _PLANS


def _identifier(shape: Any) -> str:
    return (shape.RepresentationIdentifier or "").strip().lower()


def _kind(shape: Any) -> str:
    return (shape.RepresentationType or "").strip().lower()
