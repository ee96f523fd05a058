"""Connecting rebars of an IFC model: upright bars whose upper end a column can come down on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from aadm_workbench.design import ifc_names
from aadm_workbench.design.bar_sizes import nominal_of_over_ribs
from aadm_workbench.design.ifc_file import OpenedIfc
from aadm_workbench.design.ifc_shapes import Shapes
from aadm_workbench.design.model_design import NotTaken
from aadm_workbench.design.paths import Leg, Straight, joined
from aadm_workbench.design.shapes import SweptDisk
from aadm_workbench.model import Array, AssemblyPoint, Kind

UP = np.array([0.0, 0.0, 1.0])

_UPRIGHT_COS = float(np.cos(np.radians(10.0)))
_SHORTEST_MM = 100.0
"""A connecting rebar goes eight diameters into its sleeve; a shorter upright end is a hook or a drawing error."""

_HIGHEST_MM = 1.0
_NOT_CONNECTING = frozenset({"LIGATURE", "SHEAR", "STUD", "RING", "SPACEBAR", "PUNCHING"})
_OTHER_CLASSES = ("IfcBuildingElementProxy", "IfcElementComponent", "IfcMember", "IfcFastener", "IfcMechanicalFastener")
_UNITS_MM = {"feet": 304.8, "inches": 25.4, "metres": 1000.0}
_SHOWN = 6


@dataclass(frozen=True, eq=False)
class BarEnd:
    """An upright end of a bar, in the model frame.

    ``top`` (3,) mm is where the axis meets the top, ``axis`` (3,) points up and out of the bar, ``lowest_mm`` is the
    height of the bar's lowest point. ``wholes`` are the GlobalIds of what the bar is a part of.
    """

    global_id: str
    name: str
    ifc_class: str
    top: Array
    axis: Array
    lowest_mm: float
    diameter_mm: float
    length_mm: float
    over_ribs_mm: float | None
    wholes: frozenset[str]
    why: str

    def point(self, why: str) -> AssemblyPoint:
        """The assembly point of this end, in the model frame, without a label."""
        return AssemblyPoint(
            label="",
            kind=Kind.REBAR,
            centre=self.top,
            axis=self.axis,
            diameter_mm=self.diameter_mm,
            global_id=self.global_id,
            why=f"{self.why}; {why}",
            length_mm=self.length_mm,
        )


@dataclass(frozen=True, eq=False)
class FoundBars:
    """Upright ends, the bars that were left out, and what attributes say against the geometry."""

    ends: tuple[BarEnd, ...]
    not_taken: tuple[NotTaken, ...]
    warnings: tuple[str, ...]

    @cached_property
    def tops(self) -> Array:
        """(n, 3) mm, model frame, of all ends."""
        return np.array([end.top for end in self.ends]).reshape(-1, 3)


def find_bars(opened: OpenedIfc, shapes: Shapes, selector: str | None) -> FoundBars:
    """All upright bar ends of a model; one element may hold several bars.

    Elements are chosen by class and PredefinedType, then by name, or by the selector instead of both; what the
    geometry does not support is not taken even so: bars that lean, closed ones, fragments.
    """
    ends: list[BarEnd] = []
    left: list[NotTaken] = []
    contradictions: Counter[str] = Counter()
    for element, evidence in _candidates(opened, selector):
        said = ifc_names.texts(element)
        refused = None if selector else _refused_by_kind(element, said)
        bars = _bars_of(element, shapes)
        _compare_length(element, bars, opened.mm, contradictions)
        for legs, drawn_mm in bars:
            sizes = _sizes(element, drawn_mm, opened.mm, contradictions)
            tops = [] if refused else _upright_ends(legs)
            ends += [_end(element, said, evidence, legs, sizes, top) for top in tops]
            if not tops:
                left.append(_left_out(element, legs, sizes[0], refused or _geometric_reason(legs)))
    return FoundBars(tuple(ends), tuple(left), tuple(_counted(contradictions)))


def _candidates(opened: OpenedIfc, selector: str | None) -> Iterable[tuple[Any, str]]:
    if selector:
        chosen = ifc_names.select(opened.file, opened.source, "rebars", selector)
        yield from ((element, "chosen by the selector") for element in chosen)
        return
    yield from ((element, "IfcReinforcingBar") for element in opened.file.by_type("IfcReinforcingBar"))
    seen: set[int] = set()
    for ifc_class in _OTHER_CLASSES:
        for element in opened.file.by_type(ifc_class):
            if element.id() in seen or element.is_a("IfcReinforcingBar"):
                continue
            seen.add(element.id())
            said = ifc_names.texts(element)
            if ifc_names.REBAR.search(said) and not ifc_names.SLEEVE.search(said):
                yield element, element.is_a()


def _refused_by_kind(element: Any, said: str) -> str | None:
    kind = ifc_names.predefined_type(element)
    if kind in _NOT_CONNECTING:
        return f"is a {kind} by its PredefinedType"
    named = ifc_names.NOT_REBAR.search(said)
    if named and not ifc_names.REBAR.search(said):
        return f"is called {named.group()!r}: a stirrup, tie or spiral"
    return None


def _bars_of(element: Any, shapes: Shapes) -> list[tuple[list[Leg], float]]:
    """Bars of one element: their course and diameter, mm. Bars of other solids than swept disks are straight."""
    drawn = shapes.of_product(element)
    swept = [(joined(shape.legs), 2.0 * shape.radius_mm) for shape in drawn if isinstance(shape, SweptDisk)]
    if len(swept) == len(drawn):
        return [(legs, diameter_mm) for legs, diameter_mm in swept if legs]
    solid = shapes.tubes_of_product(element)
    return [([Straight(tube.start, tube.end)], tube.outer_mm) for tube in solid if tube.outer_mm is not None]


def _upright_ends(legs: list[Leg]) -> list[tuple[Array, Array]]:
    """(top, axis) of each end that rises straight and to which no other part of the bar comes up."""
    highest_mm = _highest(legs)
    found = []
    for leg in (legs[0].reversed(), legs[-1]):
        if not isinstance(leg, Straight) or leg.length_mm < _SHORTEST_MM:
            continue
        if float(leg.direction @ UP) > _UPRIGHT_COS and float(leg.end @ UP) > highest_mm - _HIGHEST_MM:
            found.append((leg.end, leg.direction))
    return found


def _geometric_reason(legs: list[Leg]) -> str:
    length_mm = sum(leg.length_mm for leg in legs)
    if length_mm < _SHORTEST_MM:
        return f"is {length_mm:.2f} mm long: a fragment"
    if np.linalg.norm(legs[0].start - legs[-1].end) < 1.0:
        return "is closed: a stirrup"
    if len(legs) == 1 and isinstance(legs[0], Straight):
        lean = np.degrees(np.arccos(min(1.0, abs(float(legs[0].direction @ UP)))))
        return f"leans {lean:.1f}° from the vertical"
    return f"has no straight upright end of {_SHORTEST_MM:.0f} mm: a stirrup, spiral or bent bar"


def _end(
    element: Any,
    said: str,
    evidence: str,
    legs: list[Leg],
    sizes: tuple[float, float | None],
    top: tuple[Array, Array],
) -> BarEnd:
    return BarEnd(
        global_id=element.GlobalId,
        name=element.Name or "",
        ifc_class=element.is_a(),
        top=top[0],
        axis=top[1],
        lowest_mm=min(float(leg.points[:, 2].min()) for leg in legs),
        diameter_mm=sizes[0],
        length_mm=sum(leg.length_mm for leg in legs),
        over_ribs_mm=sizes[1],
        wholes=frozenset(whole.GlobalId for whole in ifc_names.wholes(element)),
        why=f'{evidence} "{said}"' if said else evidence,
    )


def _left_out(element: Any, legs: list[Leg], diameter_mm: float, reason: str) -> NotTaken:
    points = np.vstack([leg.points for leg in legs])
    return NotTaken(
        what="rebar",
        ifc_class=element.is_a(),
        global_id=element.GlobalId,
        name=element.Name or "",
        reason=reason,
        point=points[int(points[:, 2].argmax())],
        diameter_mm=diameter_mm,
        length_mm=sum(leg.length_mm for leg in legs),
    )


def _highest(legs: list[Leg]) -> float:
    return max(float(leg.points[:, 2].max()) for leg in legs)


def _sizes(element: Any, drawn_mm: float, mm: float, found: Counter[str]) -> tuple[float, float | None]:
    """Nominal diameter of a bar and, where the model gives it, the one over its ribs, mm.

    The drawn diameter is believed, not the attribute; only where what is drawn is the diameter over the ribs of
    the very size that the attribute names, that size is nominal.
    """
    written_mm = _attribute(element, "NominalDiameter", mm)
    if written_mm is None or abs(written_mm - drawn_mm) < 0.1:
        return drawn_mm, None
    if nominal_of_over_ribs(drawn_mm) == round(written_mm, 3):
        found[f"drawn over the ribs, {drawn_mm:g} mm; the NominalDiameter of {written_mm:g} mm was taken"] += 1
        return written_mm, drawn_mm
    over_ribs = nominal_of_over_ribs(written_mm) == round(drawn_mm, 3)
    note = " (over the ribs)" if over_ribs else _unit_slip(written_mm, drawn_mm)
    found[f"NominalDiameter is {written_mm:g} mm{note}, drawn is {drawn_mm:g} mm, which was believed"] += 1
    return drawn_mm, written_mm if over_ribs else None


def _compare_length(element: Any, bars: list[tuple[list[Leg], float]], mm: float, found: Counter[str]) -> None:
    """Note a BarLength that is neither the length of one of the element's bars nor of all together."""
    written_mm = _attribute(element, "BarLength", mm)
    lengths = [sum(leg.length_mm for leg in legs) for legs, _ in bars]
    if written_mm is None or not lengths:
        return
    if any(abs(written_mm - drawn) < max(0.02 * drawn, 1.0) for drawn in (*lengths, sum(lengths))):
        return
    slip = _unit_slip(written_mm, lengths[0])
    found[f"BarLength is {written_mm:g} mm{slip}, drawn is {lengths[0]:.1f} mm, which was believed"] += 1


def _attribute(element: Any, name: str, mm: float) -> float | None:
    from ifcopenshell.util.element import get_type

    for holder in (element, get_type(element)):
        value = getattr(holder, name, None)
        if value:
            return mm * float(value)
    return None


def _unit_slip(written_mm: float, drawn_mm: float) -> str:
    """The unit in which an attribute must have been written to mean what is drawn."""
    for name, factor in _UNITS_MM.items():
        if abs(written_mm * factor / drawn_mm - 1.0) < 0.01:
            return f" (it is in {name})"
    return ""


def _counted(contradictions: Counter[str]) -> list[str]:
    shown = contradictions.most_common(_SHOWN)
    lines = [f"{times} bar element{'s' if times > 1 else ''}: {text}" for text, times in shown]
    rest = sum(contradictions.values()) - sum(times for _, times in shown)
    return [*lines, f"{rest} more bar elements have attributes that contradict what is drawn"] if rest else lines
