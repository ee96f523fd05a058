"""A column's design in its column frame, from its foot face, its sleeves and the bars under it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.design.ifc import names as ifc_names
from aadm_workbench.design.ifc.bars import BarEnd
from aadm_workbench.design.ifc.columns import ColumnBody, Foot, names
from aadm_workbench.design.ifc.grid import Crossing, grid_position
from aadm_workbench.design.ifc.search import FoundFoot
from aadm_workbench.design.ifc.sleeves import Mouth
from aadm_workbench.design.ifc.under import Under
from aadm_workbench.design.recognise.pattern import label_order
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Kind, Reason

_SAME_SIDE_MM = 0.5  # a tenth of what a section may be off
_PAIR_LIMIT_MM = 3.0
"""Between the centre lines of a bar and its sleeve: GB/T 51231-2016, 10.4."""

_OFF_AXIS_MM = 1.0  # between a sleeve and its bar in the design: a third of the limit, and more than rounding


def design_of(body: ColumnBody, found: FoundFoot, under: Under, grid: Sequence[Crossing]) -> ColumnDesign:
    """The as-designed points of one column, labelled and paired, in its column frame."""
    design = points_of(found, under)
    assert design.T_model_column is not None
    return replace(
        design,
        global_id=body.element.GlobalId,
        piece_mark=next((mark for mark in body.piece_marks if mark), None),
        storey=next((name for name in map(ifc_names.storey_name, (body.element, *body.wholes)) if name), None),
        grid=grid_position(grid, design.T_model_column[:2, 3]),
        names=names(body.element, body.piece_marks),
    )


def points_of(found: FoundFoot, under: Under) -> ColumnDesign:
    """Sleeves and bars of one column in its column frame, labelled and paired; the column still without a name."""
    foot = found.foot
    xy = np.array([mouth.centre for mouth in found.mouths])
    middle = xy.mean(axis=0)
    order = [int(index) for index in label_order(xy - middle)]
    mouths = [found.mouths[index] for index in order]
    bars = [under.bars[index] for index in order]
    T = foot.T_model_foot.copy()
    T[:3, 3] = T[:3, 3] + T[:3, :3] @ np.array([*middle, 0.0])
    sleeves = tuple(_sleeve(number, mouth, middle) for number, mouth in enumerate(mouths, start=1))
    rebars = _rebars(bars, sleeves, T)
    return ColumnDesign(
        id="",
        sleeves=sleeves,
        rebars=rebars,
        size_mm=(round(foot.sides_mm[0], 6), round(foot.sides_mm[1], 6)),
        T_model_column=T,
        section_middle_mm=_section_middle(foot, middle),
        rebar_outer_diameter_mm=_over_ribs(bars),
        embedded_length_mm=_embedded(bars, foot, mouths),
        warnings=(*found.warnings, *under.warnings, *_own_misses(sleeves, rebars)),
    )


def _section_middle(foot: Foot, middle: Array) -> tuple[float, float] | None:
    """Middle of the face in the column frame; None where the smallest rectangle around it stands askew."""
    if not np.allclose(foot.sides_mm, 2.0 * foot.half_size_mm, atol=_SAME_SIDE_MM):
        return None
    return -float(middle[0]), -float(middle[1])


def _own_misses(sleeves: Sequence[AssemblyPoint], rebars: Sequence[AssemblyPoint]) -> list[str]:
    """Pairs that stand apart in the model itself: a person should know before the site does."""
    apart_mm = {
        (bar.label, sleeve.label): float(np.linalg.norm(_off_axis(sleeve, bar)))
        for sleeve, bar in zip(sleeves, rebars, strict=False)
    }
    beyond = [
        Reason("ifc.beside", rebar=r, apart_mm=mm, sleeve=s) for (r, s), mm in apart_mm.items() if mm > _PAIR_LIMIT_MM
    ]
    if beyond:
        return [Reason("ifc.design_misses", limit_mm=_PAIR_LIMIT_MM, pairs=beyond)]
    worst_mm = max(apart_mm.values(), default=0.0)
    if worst_mm > _OFF_AXIS_MM:
        return [Reason("ifc.bars_beside", worst_mm=worst_mm)]
    return []


def _off_axis(sleeve: AssemblyPoint, bar: AssemblyPoint) -> Array:
    """From a sleeve's axis to a bar's top, in the plane of the foot face: the axis may lean."""
    on_axis = sleeve.centre + max(bar.centre[2], 0.0) / sleeve.axis[2] * sleeve.axis
    return np.asarray(bar.centre[:2] - on_axis[:2])


def with_ids(columns: Sequence[ColumnDesign]) -> tuple[ColumnDesign, ...]:
    """Give each column the shortest-lived name that it shares with no other: Tag, Mark, PieceMark, Name, else GlobalId.

    A Tag that a program made up comes after the others. ``names`` holds them in this order, GlobalId last.
    """
    owners = Counter(name for column in columns for name in set(column.names))
    named = []
    for column in columns:
        own = [name for name in column.names if owners[name] == 1 and name != column.global_id]
        spoken = [name for name in own if not ifc_names.is_machine_made(name)]
        named.append(replace(column, id=next(iter([*spoken, *own]), column.global_id or "")))
    return tuple(named)


def _sleeve(number: int, mouth: Mouth, middle: Array) -> AssemblyPoint:
    candidate = mouth.candidate
    shape = "round opening" if candidate.is_opening else "solid cylinder" if mouth.solid else "hollow cylinder"
    return AssemblyPoint(
        label=f"S{number}",
        kind=Kind.SLEEVE,
        centre=np.array([*(mouth.centre - middle), 0.0]),
        axis=mouth.axis,
        diameter_mm=round(mouth.bore_mm, 6),
        global_id=candidate.element.GlobalId,
        why=Reason("ifc.opens", why=candidate.why, shape=shape, bore_mm=mouth.bore_mm, length_mm=mouth.length_mm),
        length_mm=round(mouth.length_mm, 6),
    )


def _rebars(bars: Sequence[BarEnd | None], sleeves: Sequence[AssemblyPoint], T: Array) -> tuple[AssemblyPoint, ...]:
    """The bars in the column frame, as installed: z is the height of a top over the foot face as drawn.

    A sleeve without a bar among others that have one gets it assumed on its axis, of the common diameter and
    height: ``rebars[k]`` always belongs into ``sleeves[k]``.
    """
    there = [bar for bar in bars if bar is not None]
    if not there:
        return ()
    common_mm = Counter(round(bar.diameter_mm, 3) for bar in there).most_common(1)[0][0]
    height_mm = float(np.median([_local(T, bar.top)[2] for bar in there]))
    points = []
    for number, (bar, sleeve) in enumerate(zip(bars, sleeves, strict=True), start=1):
        if bar is None:
            assumed = sleeve.centre + height_mm / sleeve.axis[2] * sleeve.axis
            why = Reason("ifc.assumed", label=sleeve.label)
            points.append(AssemblyPoint(f"R{number}", Kind.REBAR, assumed, sleeve.axis, common_mm, why=why))
            continue
        centre = _local(T, bar.top)
        apart_mm = float(np.linalg.norm(centre[:2] - sleeve.centre[:2]))
        point = bar.point(Reason("ifc.under_foot", apart_mm=apart_mm, label=sleeve.label))
        axis = bar.axis @ T[:3, :3]
        points.append(replace(point, label=f"R{number}", centre=centre, axis=axis, outer_diameter_mm=bar.over_ribs_mm))
    return tuple(points)


def _local(T: Array, point: Array) -> Array:
    """A point of the model in the column frame; map coordinates cancel before they are turned."""
    local: Array = (point - T[:3, 3]) @ T[:3, :3]
    return local


def _over_ribs(bars: Sequence[BarEnd | None]) -> float | None:
    known = Counter(bar.over_ribs_mm for bar in bars if bar is not None and bar.over_ribs_mm is not None)
    return known.most_common(1)[0][0] if known else None


def _embedded(bars: Sequence[BarEnd | None], foot: Foot, mouths: Sequence[Mouth]) -> float | None:
    """How far bars reach into the sleeves as drawn: their median; None where the column is drawn above them."""
    reach = [float(foot.local(bar.top)[2]) for bar in bars if bar is not None]
    if not reach or np.median(reach) <= 0.0:
        return None
    return round(min(float(np.median(reach)), *(mouth.length_mm for mouth in mouths)), 6)
