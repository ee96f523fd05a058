"""As-designed assembly points from an IFC model."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import numpy as np

from aadm_workbench.design.ifc import names as ifc_names
from aadm_workbench.design.ifc.attributes import Contradictions
from aadm_workbench.design.ifc.bars import BarEnd, FoundBars, find_bars
from aadm_workbench.design.ifc.chosen import chosen_of
from aadm_workbench.design.ifc.columns import ColumnBody, find_columns, not_a_column
from aadm_workbench.design.ifc.crowd import Crowd
from aadm_workbench.design.ifc.design import design_of, with_ids
from aadm_workbench.design.ifc.geometry.kernel import closing_kernel
from aadm_workbench.design.ifc.geometry.shapes import Shapes, evaluator
from aadm_workbench.design.ifc.geometry.solids import BROKEN
from aadm_workbench.design.ifc.grid import Families, crossings, grid_axes, grids_of
from aadm_workbench.design.ifc.hints import explain
from aadm_workbench.design.ifc.ids import shared_id_warning, shared_ids, with_shared_ids
from aadm_workbench.design.ifc.search import FoundFoot, Nearby, SleeveSearch
from aadm_workbench.design.ifc.sleeves import MOUTH_TO_FOOT_MM, Candidate, left_out, loose_point, named_candidates
from aadm_workbench.design.ifc.text.file import OpenedIfc, open_ifc
from aadm_workbench.design.ifc.under import bars_under
from aadm_workbench.design.ifc.walls import ends_in_walls
from aadm_workbench.design.model_design import ModelDesign, NotTaken
from aadm_workbench.design.recognise.body_faces import faces
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Reason

NO_SLEEVES = Reason("ifc.no_sleeves")
_SHOWN_PROBLEMS = 6  # of a sort: more fill a screen and say no more


def read_ifc(
    path: str | Path,
    *,
    columns: str | None = None,
    sleeves: str | None = None,
    rebars: str | None = None,
    bodies: dict[str, list[Array]] | None = None,
    only: Collection[str] | None = None,
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
    bodies
        Gets the faces of each column's concrete by its GlobalId, polygons (n, 3) mm in the model frame: for the eye.
    only
        Names of the columns that are asked for; others, and all that belongs to none of these, may be left out.

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
    shapes = evaluator(opened.mm, opened.radians, coarse=opened.draws_coarsely)
    # Numbers that overflow are looked at where they come out.
    with np.errstate(all="ignore"), closing_kernel(shapes.solids.kernel):
        found = _found(opened, shapes, columns, sleeves, rebars, bodies, only)
    return replace(found, seconds=perf_counter() - began - opened.seconds, parse_seconds=opened.seconds)


def _found(
    opened: OpenedIfc,
    shapes: Shapes,
    columns: str | None,
    sleeves: str | None,
    rebars: str | None,
    drawn: dict[str, list[Array]] | None,
    only: Collection[str] | None = None,
) -> ModelDesign:
    """What a model holds; elements that are broken are left out one by one."""
    bodies, unreadable = find_columns(opened, shapes, columns)
    chosen = chosen_of(bodies, only)
    bodies = bodies if chosen is None else list(chosen.bodies)
    named, excluded = named_candidates(opened, shapes, sleeves)
    bars = find_bars(opened, shapes, rebars, None if chosen is None else chosen.near)
    search = SleeveSearch(opened, shapes, Nearby(named), selected=sleeves is not None, bodies=bodies, bars=bars)
    searched, lost = _searched(shapes, search, bodies)
    feet, doubles = _one_column_each(searched)
    if chosen is not None:
        feet = [(body, found) for body, found in feet if body in chosen and found.mouths]
        if len(feet) < len(chosen.wanted):  # why one has none is told by a look at all
            return _found(opened, shapes, columns, sleeves, rebars, drawn)
        named = [candidate for candidate in named if chosen.near(candidate.tube.start)]
    loose_sleeves, refused = loose_sleeves_of(named, feet)
    grids = grids_of(opened.file, shapes)
    designs, used_bars, broken = _designs(shapes, feet, bars, grids)
    loose_rebars, inside = loose_rebars_of(bars, used_bars, feet, lambda ends: ends_in_walls(opened, shapes, ends))
    not_taken = (
        *unreadable,
        *lost,
        *broken,
        *doubles,
        *_bare(feet, search),
        *excluded,
        *refused,
        *bars.not_taken,
        *inside,
    )
    if drawn is not None:
        for body, _ in feet:
            drawn[body.element.GlobalId] = faces(shape for part in body.drawn for shape in shapes.of_product(part))
    shared = shared_ids(opened.file)
    return ModelDesign(
        source=opened.source,
        sha256=opened.sha256,
        schema=opened.file.schema_identifier,
        columns=with_ids([with_shared_ids(design, shared) for design in designs]),
        loose_sleeves=loose_sleeves,
        loose_rebars=loose_rebars,
        warnings=(
            *opened.warnings,
            *shared_id_warning(shared),
            *bars.warnings,
            *_sleeve_sizes(opened, shapes, feet, named),
            *_problems(shapes),
        ),
        not_taken=not_taken,
        holdings=ifc_names.holdings(opened.file),
        hint=explain(opened, feet, search, not_taken, len(loose_sleeves), len(loose_rebars)),
        T_model_file=_world(opened, shapes),
        grid=grid_axes(grids),
        project=next((project.GlobalId for project in opened.file.by_type("IfcProject")), ""),
    )


def _searched(
    shapes: Shapes, search: SleeveSearch, bodies: Sequence[ColumnBody]
) -> tuple[list[tuple[ColumnBody, FoundFoot]], list[NotTaken]]:
    """Columns with what opens in their feet, and those over which the search broke off."""
    feet: list[tuple[ColumnBody, FoundFoot]] = []
    lost: list[NotTaken] = []
    for body in bodies:
        with shapes.guarded(body.element):
            feet.append((body, search.on(body)))
            continue
        lost.append(not_a_column(body.element, shapes.undrawn(body.element)))
    return feet, lost


def _one_column_each(
    feet: Sequence[tuple[ColumnBody, FoundFoot]],
) -> tuple[list[tuple[ColumnBody, FoundFoot]], list[NotTaken]]:
    """Columns without those whose sleeves another one has: a column is drawn twice, or a part is called like it."""
    owners: dict[int, ColumnBody] = {}
    doubles: dict[int, str] = {}
    for body, found in sorted(feet, key=lambda item: not item[0].element.is_a("IfcColumn")):
        claimed = [id(mouth.candidate) for mouth in found.mouths]
        other = next((owners[candidate] for candidate in claimed if candidate in owners), None)
        if other is not None:
            doubles[id(body)] = Reason("ifc.same_place", column=other.called)
            continue
        owners.update((candidate, body) for candidate in claimed)
    kept = [(body, found) for body, found in feet if id(body) not in doubles]
    left = [not_a_column(body.element, doubles[id(body)]) for body, _ in feet if id(body) in doubles]
    return kept, left


def _designs(
    shapes: Shapes, feet: Sequence[tuple[ColumnBody, FoundFoot]], bars: FoundBars, grids: Sequence[Families]
) -> tuple[list[ColumnDesign], set[int], list[NotTaken]]:
    """The designs of all columns with sleeves, the numbers of the bar ends under them, and columns that are broken."""
    grid = crossings(grids)
    number = {id(end): k for k, end in enumerate(bars.ends)}
    designs: list[ColumnDesign] = []
    used: set[int] = set()
    lost: list[NotTaken] = []
    for body, found in feet:
        if not found.mouths:
            continue
        with shapes.guarded(body.element):
            under = bars_under(body, found.foot, found.mouths, bars)
            designs.append(design_of(body, found, under, grid))
            used |= {number[id(end)] for end in under.bars if end is not None}
            continue
        lost.append(not_a_column(body.element, shapes.undrawn(body.element)))
    return designs, used, lost


def loose_sleeves_of(
    named: Sequence[Candidate], feet: Sequence[tuple[ColumnBody, FoundFoot]]
) -> tuple[tuple[AssemblyPoint, ...], list[NotTaken]]:
    """Named sleeves that open in no foot face, and those that are none, with the reason."""
    taken = {mouth.candidate.element.id() for _, found in feet for mouth in found.mouths}
    reasons = {id(candidate): reason for _, found in feet for candidate, reason in found.refused}
    loose: list[AssemblyPoint] = []
    refused: list[NotTaken] = []
    left = [candidate for candidate in named if candidate.element.id() not in taken]
    middles = [(candidate.tube.start + candidate.tube.end) / 2.0 for candidate in left]
    for candidate, host in zip(left, _hosts(middles, feet), strict=True):
        # Sockets for lifting and bracing are called sleeves too.
        elsewhere = host and Reason("ifc.in_column", column=host.called)
        point = reasons.get(id(candidate)) or elsewhere or loose_point(candidate)
        if isinstance(point, str):
            refused.append(left_out(candidate, point))
        else:
            loose.append(point)
    return tuple(loose), refused


def _hosts(points: Sequence[Array], feet: Sequence[tuple[ColumnBody, FoundFoot]]) -> list[ColumnBody | None]:
    """The column in whose concrete each point of the model lies, if any."""
    hosts: list[ColumnBody | None] = [None] * len(points)
    crowd = Crowd.of(points)
    for body, found in feet:
        foot = found.foot
        near = crowd.about(foot.T_model_foot[:3, 3], foot.T_model_foot[:3, 2], foot.reach_mm)
        for index in near[foot.encloses(crowd.points[near])]:
            hosts[index] = hosts[index] or body
    return hosts


def loose_rebars_of(
    bars: FoundBars,
    used: set[int],
    feet: Sequence[tuple[ColumnBody, FoundFoot]],
    walls: Callable[[Sequence[BarEnd]], Mapping[int, str]] = lambda ends: {},
) -> tuple[tuple[AssemblyPoint, ...], list[NotTaken]]:
    """Upright bars under no column of the model; those that end inside a column's concrete or a wall's are its own.

    ``walls`` tells which of the ends that are left stand in a wall, and in which.
    """
    left = [end for number, end in enumerate(bars.ends) if number not in used]
    hosts = _hosts([end.top for end in left], feet)
    reasons = [
        Reason("ifc.ends_inside", column=host.called) if host and _begins_in(end, host) else ""
        for end, host in zip(left, hosts, strict=True)
    ]
    outside = [number for number, reason in enumerate(reasons) if not reason]
    for place, wall in walls([left[number] for number in outside]).items():
        reasons[outside[place]] = Reason("ifc.in_wall", wall=wall)
    loose = [end.point(Reason("ifc.under_none")) for end, why in zip(left, reasons, strict=True) if not why]
    inside = [
        NotTaken("rebar", end.ifc_class, end.global_id, end.name, why, end.top, end.diameter_mm, end.length_mm)
        for end, why in zip(left, reasons, strict=True)
        if why
    ]
    return tuple(loose), inside


def _begins_in(end: BarEnd, host: ColumnBody) -> bool:
    """Whether a bar that ends in a column begins there too; else it comes from below and only has no sleeve."""
    return not host.feet[0].stands or end.lowest_mm > float(host.feet[0].T_model_foot[2, 3]) - MOUTH_TO_FOOT_MM


def _sleeve_sizes(
    opened: OpenedIfc, shapes: Shapes, feet: Sequence[tuple[ColumnBody, FoundFoot]], named: Sequence[Candidate]
) -> list[str]:
    """What sizes written on fasteners say against those drawn; of the sleeves of columns and of the loose ones."""
    contradictions = Contradictions(opened)
    taken = [mouth.candidate for _, found in feet for mouth in found.mouths]
    for candidate in {id(candidate): candidate for candidate in (*taken, *named)}.values():
        if ifc_names.is_of(candidate.element, "IfcMechanicalFastener"):
            tube = candidate.tube
            drawn_mm = [size for size in (*tube.bore_mm, tube.outer_mm) if size is not None]
            with shapes.guarded(candidate.element):
                contradictions.compare_sleeve(candidate.element, drawn_mm, tube.length_mm)
    return contradictions.lines()


def _bare(feet: Sequence[tuple[ColumnBody, FoundFoot]], search: SleeveSearch) -> list[NotTaken]:
    return [not_a_column(body.element, _why_bare(body, search)) for body, found in feet if not found.mouths]


def _why_bare(body: ColumnBody, search: SleeveSearch) -> str:
    if count := search.on_its_head(body):
        return Reason("ifc.on_head", count=count)
    return NO_SLEEVES


def _problems(shapes: Shapes) -> list[str]:
    counted = Counter(shapes.problems)
    shown = list(counted)[:_SHOWN_PROBLEMS]
    more = len(counted) - len(shown)
    return [*shown, Reason("ifc.more_left_out", count=more)] if more else shown


def _world(opened: OpenedIfc, shapes: Shapes) -> Array:
    contexts = opened.file.by_type("IfcGeometricRepresentationContext", include_subtypes=False)
    model = next((context for context in contexts if context.ContextType == "Model"), None)
    try:
        return shapes.placements.of_context(model)
    except BROKEN:
        return np.eye(4)
