"""Columns, sleeves and connecting rebars among the elements of a model that is no IFC file.

The directions that a body runs in: those of its placement where its edges agree, else those of its edges.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from aadm_workbench.design.elements import Element, Solid, counted_once, holdings
from aadm_workbench.design.ifc.bars import FoundBars
from aadm_workbench.design.ifc.columns import ColumnBody, feet_of
from aadm_workbench.design.ifc.design import points_of, with_ids
from aadm_workbench.design.ifc.model import NO_SLEEVES, loose_rebars_of, loose_sleeves_of
from aadm_workbench.design.ifc.search import FoundFoot, Nearby, sleeves_in
from aadm_workbench.design.ifc.sleeves import Candidate
from aadm_workbench.design.ifc.under import Under, bars_below, bars_under
from aadm_workbench.design.model_design import ModelDesign, NotTaken
from aadm_workbench.design.recognise.element_kind import is_column, is_thin, may_hold_sleeves, spoken
from aadm_workbench.design.recognise.selectors import called_by, select
from aadm_workbench.design.recognise.steel import (
    drawn_bars,
    named_bars,
    named_sleeves,
    own_holes,
    round_holes,
    unnamed_sleeves,
)
from aadm_workbench.design.sound import sound_elements
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign

_WIDEST_PLAN_RATIO = 4.0
"""A body that is wider than so many of its thicknesses is a wall, unless its class or its name says column."""

_PARALLEL_COS = float(np.cos(np.radians(0.1)))  # 0.1 degrees: directions of edges, up to rounding
_UP = np.array([0.0, 0.0, 1.0])
_SQUARE_SINE = 0.01  # 0.6 degrees: what is square to the axis, up to a slope that is drawn by hand


@dataclass(frozen=True)
class Rules:
    """Which elements are what, in the job's own words; None leaves it to class, name and geometry."""

    columns: str | None = None
    sleeves: str | None = None
    rebars: str | None = None


@dataclass(frozen=True, eq=False)
class Origin:
    """Where elements come from: file, hash and format."""

    source: str
    sha256: str
    schema: str
    warnings: tuple[str, ...] = ()


def recognise(
    elements: Sequence[Element], origin: Origin, rules: Rules | None = None, *, chosen: Sequence[Element] | None = None
) -> ModelDesign:
    """The as-designed points that elements make, by class, then name, then geometry, or by the job's rules.

    ``chosen`` are the elements that are columns, where somebody has pointed at them.

    Raises
    ------
    DesignError
        Where a rule is not understood or finds nothing.
    """
    rules = rules or Rules()
    elements, unsound = sound_elements(elements)
    elements = counted_once(elements)
    if rules.columns is not None:
        chosen = select(elements, origin.source, "columns", rules.columns)
    named, excluded = named_sleeves(elements, origin.source, rules.sleeves)
    bars = named_bars(elements, origin.source, rules.rebars)
    drawn = [] if rules.rebars is not None else drawn_bars(elements)
    all_bars = replace(bars, ends=(*bars.ends, *drawn))
    feet = _feet(elements, chosen, named, all_bars, selected=rules.sleeves is not None)
    shared = Counter(name for element in elements for name in set(called_by(element)))
    designs, used = _designs(feet, bars, all_bars, shared)
    bars = replace(bars, ends=(*bars.ends, *(end for end in drawn if id(end) in used or not bars.ends)))
    numbers = {number for number, end in enumerate(bars.ends) if id(end) in used}
    loose_sleeves, refused = loose_sleeves_of(named, feet)
    loose_rebars, inside = loose_rebars_of(bars, numbers, feet)
    notes: list[str] = []
    if not designs and not loose_sleeves and not loose_rebars:
        loose_sleeves, notes = round_holes(elements)
    guids = {element.GlobalId: element.ifc_guid for element in elements}
    return ModelDesign(
        source=origin.source,
        sha256=origin.sha256,
        schema=origin.schema,
        columns=with_ids([_with_objects(design, guids) for design in designs]),
        loose_sleeves=_objects(loose_sleeves, guids),
        loose_rebars=_objects(loose_rebars, guids),
        warnings=(*origin.warnings, *unsound, *notes, *bars.warnings),
        not_taken=(*_bare(feet), *excluded, *refused, *bars.not_taken, *inside),
        holdings=holdings(elements),
    )


def _designs(
    feet: Sequence[tuple[ColumnBody, FoundFoot]], bars: FoundBars, all_bars: FoundBars, shared: Counter[str]
) -> tuple[list[ColumnDesign], set[int]]:
    """The designs of all columns with sleeves, and which bar ends they stand on; bars by shape where no others are."""
    designs: list[ColumnDesign] = []
    used: set[int] = set()
    for body, found in feet:
        if not found.mouths:
            continue
        under = bars_under(body, found.foot, found.mouths, bars)
        if not all(under.bars) and len(all_bars.ends) > len(bars.ends):
            under = bars_under(body, found.foot, found.mouths, all_bars)
        used |= {id(end) for end in under.bars if end is not None}
        designs.append(replace(_design_of(body.element, found, under), names=_names(body.element, shared)))
    return designs, used


def _design_of(element: Element, found: FoundFoot, under: Under) -> ColumnDesign:
    return replace(
        points_of(found, under),
        global_id=element.GlobalId,
        piece_mark=element.piece_mark,
        storey=element.storey,
    )


def _names(element: Element, shared: Counter[str]) -> tuple[str, ...]:
    """All that a job may call a column by, its groups' names too.

    What people gave comes before what their program did, and before that what no other element is called.
    """
    own = called_by(element)
    given = [name for name in (*own, *element.wholes) if spoken(name)]
    given.sort(key=lambda name: shared[name] > 1)
    return tuple(dict.fromkeys([*given, *own, *element.wholes]))


def _with_objects(design: ColumnDesign, guids: dict[str, str | None]) -> ColumnDesign:
    """The design with GlobalIds of IFC only where there are such, and objects by their own names."""
    return replace(
        design,
        sleeves=_objects(design.sleeves, guids),
        rebars=_objects(design.rebars, guids),
        global_id=guids.get(design.global_id or ""),
    )


def _objects(points: Iterable[AssemblyPoint], guids: dict[str, str | None]) -> tuple[AssemblyPoint, ...]:
    return tuple(
        point
        if point.global_id is None
        else replace(point, global_id=guids.get(point.global_id), object_name=point.global_id)
        for point in points
    )


def _feet(
    elements: Sequence[Element],
    chosen: Sequence[Element] | None,
    named: Sequence[Candidate],
    bars: FoundBars,
    *,
    selected: bool,
) -> list[tuple[ColumnBody, FoundFoot]]:
    """Columns with their foot faces: those that a rule chose, else by class and name, else by their holes alone."""
    called, others = Nearby(tuple(named)), Nearby(() if selected else tuple(unnamed_sleeves(elements)))
    if chosen is not None:
        # A group that somebody points at holds the column and what is cast into it.
        chosen = [element for element in chosen if not is_thin(element)] or chosen
        return [found for element in chosen if (found := _on(element, called, others, bars, selected)) is not None]
    certain = [element for element in elements if is_column(element) and not is_thin(element)]
    feet = [found for element in certain if (found := _on(element, called, others, bars, selected)) is not None]
    if any(found.mouths for _, found in feet):
        # Where columns say what they are, others must show it by holes of their own.
        called = others = Nearby(())
    uncertain = [e for e in elements if may_hold_sleeves(e) and not is_column(e) and not is_thin(e)]
    by_shape = [found for element in uncertain if (found := _on(element, called, others, bars, selected)) is not None]
    return feet + [
        (body, found) for body, found in by_shape if found.mouths and found.foot.stands and _column_like(found)
    ]


def _column_like(found: FoundFoot) -> bool:
    narrow_mm, wide_mm = sorted(float(side) for side in found.foot.half_size_mm)
    return wide_mm <= _WIDEST_PLAN_RATIO * narrow_mm


def _on(
    element: Element, named: Nearby, unnamed: Nearby, bars: FoundBars, selected: bool
) -> tuple[ColumnBody, FoundFoot] | None:
    """An element as a column; of a lying one's two ends the one with more sleeves. None where it has no extent."""
    solids = [shape for solid in element.solids for shape in [solid.body] if len(shape.vertices)]
    T = own_frame(element.T_model_element, element.solids)
    called = element.Tag or element.Name or element.GlobalId
    body = ColumnBody(element, (element,), feet_of(T, solids), (), called)
    if not body.feet:
        return None
    own = [] if selected else own_holes(element)
    found: list[FoundFoot] = []
    for foot in body.feet:
        others, below = partial(unnamed.to, foot, element), partial(bars_below, body, foot, bars)
        found.append(sleeves_in(foot, named.to(foot), own, others, others, below))
    return body, max(found, key=lambda there: len(there.mouths))


def _bare(feet: Sequence[tuple[ColumnBody, FoundFoot]]) -> list[NotTaken]:
    return [
        NotTaken.of("column", body.element, NO_SLEEVES, names=tuple(called_by(body.element)))
        for body, found in feet
        if not found.mouths
    ]


def own_frame(T_model_element: Array, solids: Sequence[Solid]) -> Array:
    """The frame (4, 4) that a body was drawn in.

    Imported bodies often stand turned under a placement that is not: then z is the direction of their long edges that
    is nearest to upright, and x that of the edges across, within 45 degrees of the placement's x.
    """
    edges = _straight(solids)
    length_mm = np.linalg.norm(edges, axis=1)
    total_mm = float(length_mm.sum())
    if total_mm <= 0.0:
        return T_model_element
    directions = edges / length_mm[:, np.newaxis]
    z = _strongest(directions, length_mm * (0.5 + np.abs(directions @ _UP)))
    across = np.abs(directions @ z) < _SQUARE_SINE
    x = _strongest(directions[across], length_mm[across]) if across.any() else T_model_element[:3, 0]
    if all(np.abs(T_model_element[:3, :3].T @ side).max() > _PARALLEL_COS for side in (z, x)):
        return T_model_element
    return _frame(T_model_element, z if float(z @ _UP) >= 0.0 else -z, x)


def _straight(solids: Sequence[Solid]) -> Array:
    """(n, 3) mm, the straight edges of bodies as vectors; none without length."""
    vectors = np.array([line[1] - line[0] for solid in solids for line in solid.edges if len(line) == 2])
    vectors = vectors.reshape(-1, 3)
    kept: Array = vectors[np.linalg.norm(vectors, axis=1) > 0.0]
    return kept


def _strongest(directions: Array, weight: Array) -> Array:
    """The direction that the greatest weight of edges has, of either sign."""
    longest = np.argsort(-weight, kind="stable")[:50]
    shares = [float(weight[np.abs(directions @ directions[k]) > _PARALLEL_COS].sum()) for k in longest]
    found: Array = directions[longest[int(np.argmax(shares))]]
    return found


def _frame(T_model_element: Array, z: Array, x: Array) -> Array:
    """A right-handed frame with z and about x, turned by quarters to be near the placement's x."""
    x = x - float(x @ z) * z
    x = x / np.linalg.norm(x)
    quarters = [x, np.cross(z, x), -x, -np.cross(z, x)]
    x = max(quarters, key=lambda side: float(side @ T_model_element[:3, 0]))
    T = T_model_element.copy()
    T[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    return T
