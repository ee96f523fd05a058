"""As-designed assembly points from an IFC model."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

import numpy as np

from aadm_workbench.design import ifc_names
from aadm_workbench.design.ifc_bars import FoundBars, find_bars
from aadm_workbench.design.ifc_columns import ColumnBody, find_columns, not_a_column
from aadm_workbench.design.ifc_design import design_of, with_ids
from aadm_workbench.design.ifc_file import OpenedIfc, open_ifc
from aadm_workbench.design.ifc_grid import crossings
from aadm_workbench.design.ifc_search import FoundFoot, SleeveSearch
from aadm_workbench.design.ifc_shapes import Shapes, evaluator
from aadm_workbench.design.ifc_sleeves import Candidate, left_out, loose_point, named_candidates
from aadm_workbench.design.ifc_under import bars_under
from aadm_workbench.design.model_design import ModelDesign, NotTaken
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign

_SHOWN_PROBLEMS = 6


def read_ifc(
    path: str | Path, *, columns: str | None = None, sleeves: str | None = None, rebars: str | None = None
) -> ModelDesign:
    """Columns, sleeves and connecting rebars that an IFC model holds.

    Geometry is evaluated first and attributes come second: placements, mapped items and world coordinate systems in
    float64, millimetres, from files in any unit. What is what follows from class and PredefinedType, then from
    names, then from geometry; a selector replaces class and name.

    Parameters
    ----------
    path
        A model in STEP format of schema IFC2X3, IFC4 or IFC4X3.
    columns, sleeves, rebars
        Optional selectors in the syntax of ``ifcopenshell.util.selector``.

    Raises
    ------
    DesignError
        Where the file is no complete IFC model, or a selector finds nothing. A model without sleeves is no error:
        :meth:`ModelDesign.column` raises where a column is asked for.
    MissingDependencyError
        Where ifcopenshell is not installed.
    """
    began = perf_counter()
    opened = open_ifc(path)
    shapes = evaluator(opened.mm, opened.radians)
    bodies, unreadable = find_columns(opened, shapes, columns)
    named, excluded = named_candidates(opened, shapes, sleeves)
    bars = find_bars(opened, shapes, rebars)
    search = SleeveSearch(opened, shapes, named, selected=sleeves is not None)
    feet = [(body, search.on(body)) for body in bodies]
    loose_sleeves, refused = _loose_sleeves(named, feet)
    designs, used_bars = _designs(opened, shapes, feet, bars)
    loose_rebars, inside = _loose_rebars(bars, used_bars, feet)
    return ModelDesign(
        source=opened.source,
        sha256=opened.sha256,
        schema=opened.file.schema_identifier,
        columns=with_ids(designs),
        loose_sleeves=loose_sleeves,
        loose_rebars=loose_rebars,
        warnings=(*opened.warnings, *bars.warnings, *_problems(shapes)),
        not_taken=(*unreadable, *_bare(feet), *excluded, *refused, *bars.not_taken, *inside),
        holdings=ifc_names.holdings(opened.file),
        T_model_file=_world(opened, shapes),
        seconds=perf_counter() - began,
    )


def _designs(
    opened: OpenedIfc, shapes: Shapes, feet: Sequence[tuple[ColumnBody, FoundFoot]], bars: FoundBars
) -> tuple[list[ColumnDesign], set[int]]:
    """The designs of all columns with sleeves, and the numbers of the bar ends that they stand on."""
    grid = crossings(opened.file, shapes)
    number = {id(end): k for k, end in enumerate(bars.ends)}
    designs: list[ColumnDesign] = []
    used: set[int] = set()
    for body, found in feet:
        if found.mouths:
            under = bars_under(body, found.foot, found.mouths, bars)
            used |= {number[id(end)] for end in under.bars if end is not None}
            designs.append(design_of(body, found, under, grid))
    return designs, used


def _loose_sleeves(
    named: Sequence[Candidate], feet: Sequence[tuple[ColumnBody, FoundFoot]]
) -> tuple[tuple[AssemblyPoint, ...], list[NotTaken]]:
    """Named sleeves that open in no foot face, and those that are none, with the reason."""
    taken = {mouth.candidate.element.GlobalId for _, found in feet for mouth in found.mouths}
    reasons = {id(candidate): reason for _, found in feet for candidate, reason in found.refused}
    loose: list[AssemblyPoint] = []
    refused: list[NotTaken] = []
    left = [candidate for candidate in named if candidate.element.GlobalId not in taken]
    middles = [(candidate.tube.start + candidate.tube.end) / 2.0 for candidate in left]
    for candidate, host in zip(left, _hosts(middles, feet), strict=True):
        # Sockets for lifting and bracing are called sleeves too.
        elsewhere = host and f"is in column {_called(host)} but does not open in its foot face"
        point = reasons.get(id(candidate)) or elsewhere or loose_point(candidate)
        if isinstance(point, str):
            refused.append(left_out(candidate, point))
        else:
            loose.append(point)
    return tuple(loose), refused


def _hosts(points: Sequence[Array], feet: Sequence[tuple[ColumnBody, FoundFoot]]) -> list[ColumnBody | None]:
    """The column in whose concrete each point of the model lies, if any."""
    hosts: list[ColumnBody | None] = [None] * len(points)
    stacked = np.array(points).reshape(-1, 3)
    for body, found in feet:
        for index in np.flatnonzero(found.foot.encloses(stacked)):
            hosts[index] = hosts[index] or body
    return hosts


def _loose_rebars(
    bars: FoundBars, used: set[int], feet: Sequence[tuple[ColumnBody, FoundFoot]]
) -> tuple[tuple[AssemblyPoint, ...], list[NotTaken]]:
    """Upright bars under no column of the model; those that end inside a column's concrete are its own."""
    loose: list[AssemblyPoint] = []
    inside: list[NotTaken] = []
    left = [end for number, end in enumerate(bars.ends) if number not in used]
    for end, host in zip(left, _hosts([end.top for end in left], feet), strict=True):
        if host is None:
            loose.append(end.point("upright, under no column with sleeves"))
        else:
            reason = f"ends inside column {_called(host)}: its own reinforcement"
            inside.append(
                NotTaken(
                    "rebar", end.ifc_class, end.global_id, end.name, reason, end.top, end.diameter_mm, end.length_mm
                )
            )
    return tuple(loose), inside


def _called(body: ColumnBody) -> str:
    return str(body.element.Tag or body.element.Name or body.element.GlobalId)


def _bare(feet: Sequence[tuple[ColumnBody, FoundFoot]]) -> list[NotTaken]:
    reason = "has no grouting sleeves in its foot face"
    return [not_a_column(body.element, reason) for body, found in feet if not found.mouths]


def _problems(shapes: Shapes) -> list[str]:
    counted = Counter(shapes.problems)
    shown = list(counted)[:_SHOWN_PROBLEMS]
    more = len(counted) - len(shown)
    return [*shown, f"the geometry of {more} more elements was left out"] if more else shown


def _world(opened: OpenedIfc, shapes: Shapes) -> Array:
    contexts = opened.file.by_type("IfcGeometricRepresentationContext", include_subtypes=False)
    model = next((context for context in contexts if context.ContextType == "Model"), None)
    return shapes.placements.of_context(model)
