"""The section of a foot against its design: edges, size, squareness, the place of the sleeves in it, flatness.

All is told in the column frame as the sleeves give it: a scan is laid on its design by them. A pattern that was cast
beside its place in the section therefore shows as edges that are all off by one displacement, and the pattern by minus
that; a fit of the sleeves alone cannot see it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule, decide_signed
from aadm_workbench.assembly.tolerances import counted_verdict, not_assessed, rule_result, rules_for
from aadm_workbench.extract.section.outline import SIDES, FaceHeights, SeenEdge
from aadm_workbench.model import Array, ColumnDesign, Profile, Reason, Rule, RuleResult, Verdict, worst
from aadm_workbench.model.reason import in_one
from aadm_workbench.model.reports import (
    EdgeChip,
    FaceMap,
    PatternPlace,
    SectionCorner,
    SectionEdge,
    SectionLength,
    SectionReport,
)

_AXES = (("x", "-x", "+x"), ("y", "-y", "+y"))
_CORNERS = (("-x-y", "-x", "-y"), ("+x-y", "+x", "-y"), ("+x+y", "+x", "+y"), ("-x+y", "-x", "+y"))


@dataclass(frozen=True, eq=False)
class _Line:
    """An edge in the column frame: x @ outwards = offset + turn · (x @ along − at), with its covariance."""

    outwards: Array
    along: Array
    edge: SeenEdge

    @classmethod
    def of(cls, edge: SeenEdge) -> _Line:
        outwards = np.zeros(2)
        outwards["xy".index(edge.side[1])] = 1.0 if edge.side[0] == "+" else -1.0
        return cls(outwards, np.array([-outwards[1], outwards[0]]), edge)

    @property
    def slope(self) -> float:
        """Change of the distance outwards along the edge: an edge that turns counter-clockwise runs inwards."""
        return -math.tan(self.edge.turn)

    def offset_at(self, along_mm: float) -> tuple[float, float]:
        """Distance outwards, mm, at a place along the edge, and its own variance, mm²."""
        run = along_mm - self.edge.at_mm
        toward = np.array([1.0, -run])
        return self.edge.offset_mm + self.slope * run, float(toward @ self.edge.covariance @ toward)


def inspect_section(
    design: ColumnDesign,
    seen: Mapping[str, SeenEdge | Reason],
    heights: FaceHeights | None,
    profile: Profile,
    *,
    fit_u_mm: float,
    fit_u_turn: float,
    decision: DecisionRule,
) -> SectionReport | None:
    """The section of one foot; None where the design does not say where its section lies.

    Parameters
    ----------
    seen
        Edges by their sides in the column frame, or why one was not measured.
    fit_u_mm
        Standard uncertainty per axis of where the sleeves lay the scan, with which all edges move together.
    fit_u_turn
        The same of how they turn it, radians.
    """
    if design.size_mm is None or design.section_middle_mm is None:
        return None
    middle, half = np.array(design.section_middle_mm), np.array(design.size_mm) / 2.0
    lines = {side: _Line.of(edge) for side, edge in seen.items() if not isinstance(edge, Reason)}
    lengths = [_length(name, low, high, lines, seen, design, profile, decision) for name, low, high in _AXES]
    pattern = _pattern(lines, middle, profile, (fit_u_mm, fit_u_turn), decision)
    flat = _flatness(heights, profile, decision)
    square, square_u = _squareness(lines)
    rules = _rules(profile, lengths, pattern, flat)
    return SectionReport(
        verdict=counted_verdict(rules),
        edges=tuple(_edge(side, seen, lines, middle, half, (fit_u_mm, fit_u_turn)) for side in SIDES),
        corners=tuple(_corner(*corner, lines, middle, half) for corner in _CORNERS if _both(lines, *corner[1:])),
        lengths=(*lengths, flat),
        pattern=pattern,
        squareness_deg=square,
        u_squareness_deg=square_u,
        face=_face_map(heights),
        rules=tuple(rules),
    )


def _both(lines: Mapping[str, _Line], first: str, second: str) -> bool:
    return first in lines and second in lines


def _edge(
    side: str,
    seen: Mapping[str, SeenEdge | Reason],
    lines: Mapping[str, _Line],
    middle: Array,
    half: Array,
    fit_u: tuple[float, float],
) -> SectionEdge:
    axis, sign = "xy".index(side[1]), 1.0 if side[0] == "+" else -1.0
    design_mm = float(half[axis] + sign * middle[axis])
    found = seen[side]
    if isinstance(found, Reason):
        return SectionEdge(side, design_mm, reason=found)
    line = lines[side]
    measured_mm, variance = line.offset_at(float(middle @ line.along))
    return SectionEdge(
        side,
        design_mm,
        measured_mm,
        math.sqrt(variance + found.shared_u_mm**2 + fit_u[0] ** 2),
        math.degrees(found.turn),
        math.degrees(math.hypot(math.sqrt(found.covariance[1, 1]), fit_u[1])),
        found.seen,
        tuple(
            EdgeChip((chip.begin_mm + chip.end_mm) / 2.0, chip.end_mm - chip.begin_mm, chip.depth_mm)
            for chip in found.chips
        ),
    )


def _length(
    name: str,
    low: str,
    high: str,
    lines: Mapping[str, _Line],
    seen: Mapping[str, SeenEdge | Reason],
    design: ColumnDesign,
    profile: Profile,
    decision: DecisionRule,
) -> SectionLength:
    """The side along one axis, in the middle of the section: what edges share, they share with one sign."""
    assert design.size_mm is not None
    assert design.section_middle_mm is not None
    design_mm = design.size_mm["xy".index(name)]
    if not _both(lines, low, high):
        unseen = [
            Reason("assembly.section_edge", side=side, why=seen[side])
            for side in (low, high)
            if isinstance(seen[side], Reason)
        ]
        said = in_one(unseen)
        return SectionLength(name, design_mm, verdict=_unmeasured(profile, "section_size"), reason=said)
    middle = np.array(design.section_middle_mm)
    parts = [lines[side].offset_at(float(middle @ lines[side].along)) for side in (low, high)]
    shared = lines[low].edge.shared_u_mm + lines[high].edge.shared_u_mm
    measured_mm = parts[0][0] + parts[1][0]
    u_mm = math.sqrt(parts[0][1] + parts[1][1] + shared**2)
    found = SectionLength(name, design_mm, measured_mm, measured_mm - design_mm, u_mm)
    return _judged(found, _rule(profile, "section_size"), decision)


def _judged(found: SectionLength, rule: Rule | None, decision: DecisionRule) -> SectionLength:
    if rule is None or found.deviation_mm is None:
        return found
    decided = decide_signed(found.deviation_mm, found.u_mm, rule.lower, rule.upper, decision)
    off = Reason("assembly.section_off", part=found.name, off_mm=found.deviation_mm)
    return replace(
        found,
        limit_mm=(rule.lower, rule.upper),
        verdict=decided.verdict,
        probability=decided.probability,
        reason="" if decided.verdict is Verdict.PASS else off,
    )


def _pattern(
    lines: Mapping[str, _Line], middle: Array, profile: Profile, fit_u: tuple[float, float], decision: DecisionRule
) -> PatternPlace:
    """Where the sleeves sit in the section: minus where the section lies about them. ``fit_u``: mm and radians."""
    fit_u_mm, fit_u_turn = fit_u
    missing = [name for name, low, high in _AXES if not _both(lines, low, high)]
    if missing:
        reason = Reason("assembly.section_both", axes=missing)
        return PatternPlace(verdict=_unmeasured(profile, "pattern_in_section"), reason=reason)
    offset, u = np.zeros(2), np.zeros(2)
    for axis, (_, low, high) in enumerate(_AXES):
        (below, below_var), (above, above_var) = (
            lines[side].offset_at(float(middle @ lines[side].along)) for side in (low, high)
        )
        apart = lines[high].edge.shared_u_mm - lines[low].edge.shared_u_mm
        offset[axis] = middle[axis] - (above - below) / 2.0
        u[axis] = math.sqrt((below_var + above_var + apart**2) / 4.0 + fit_u_mm**2)
    turn, turn_u = _mean_turn(list(lines.values()))
    found = PatternPlace(
        Verdict.NOT_ASSESSED,
        (float(offset[0]), float(offset[1])),
        (float(u[0]), float(u[1])),
        -math.degrees(turn),
        math.degrees(math.hypot(turn_u, fit_u_turn)),
    )
    rule = _rule(profile, "pattern_in_section")
    if rule is None:
        return found
    lower = -rule.upper if rule.lower is None else rule.lower
    decided = [
        decide_signed(float(value), float(error), lower, rule.upper, decision)
        for value, error in zip(offset, u, strict=True)
    ]
    verdict = worst(one.verdict for one in decided)
    said = Reason("assembly.section_pattern", dx_mm=float(offset[0]), dy_mm=float(offset[1]))
    return replace(
        found,
        limit_mm=rule.upper,
        verdict=verdict,
        probability=None if decided[0].probability is None else min(one.probability or 0.0 for one in decided),
        reason="" if verdict is Verdict.PASS else said,
    )


def _mean_turn(lines: Sequence[_Line]) -> tuple[float, float]:
    """Turn of edges together, radians, each by what is known of it, and its standard uncertainty."""
    weight = np.array([1.0 / max(line.edge.covariance[1, 1], 1e-12) for line in lines])  # keeps a quotient finite
    turns = np.array([line.edge.turn for line in lines])
    mean = float(weight @ turns / weight.sum())
    scatter = float(weight @ (turns - mean) ** 2 / max(len(lines) - 1, 1))
    return mean, math.sqrt(max(scatter, 1.0) / float(weight.sum()))


def _squareness(lines: Mapping[str, _Line]) -> tuple[float | None, float | None]:
    """Angle, degrees, by which edges across y are turned against those across x, and its standard uncertainty."""
    across = [[lines[side] for side in sides if side in lines] for sides in (("-x", "+x"), ("-y", "+y"))]
    if not all(across):
        return None, None
    (first, first_u), (second, second_u) = (_mean_turn(one) for one in across)
    return math.degrees(second - first), math.degrees(math.hypot(first_u, second_u))


def _corner(
    name: str, across_x: str, across_y: str, lines: Mapping[str, _Line], middle: Array, half: Array
) -> SectionCorner:
    """Where two edges meet, with what is known of it."""
    pair = lines[across_x], lines[across_y]
    matrix = np.array([line.outwards - line.slope * line.along for line in pair])
    right = np.array([line.edge.offset_mm - line.slope * line.edge.at_mm for line in pair])
    place = np.linalg.solve(matrix, right)
    own = np.diag([line.offset_at(float(place @ line.along))[1] + line.edge.shared_u_mm**2 for line in pair])
    inverse = np.linalg.inv(matrix)
    covariance = inverse @ own @ inverse.T
    design = middle + half * np.array([1.0 if across_x[0] == "+" else -1.0, 1.0 if across_y[0] == "+" else -1.0])
    return SectionCorner(
        name,
        (float(design[0]), float(design[1])),
        (float(place[0]), float(place[1])),
        (
            (float(covariance[0, 0]), float(covariance[0, 1])),
            (float(covariance[1, 0]), float(covariance[1, 1])),
        ),
    )


def _flatness(heights: FaceHeights | None, profile: Profile, decision: DecisionRule) -> SectionLength:
    if heights is None:
        reason = Reason("assembly.section_rough")
        return SectionLength("flatness", 0.0, verdict=Verdict.NOT_ASSESSED, reason=reason)
    found = SectionLength("flatness", 0.0, heights.range_mm, heights.range_mm, heights.u_mm)
    return _judged(found, _rule(profile, "face_flatness"), decision)


def _face_map(heights: FaceHeights | None) -> FaceMap | None:
    if heights is None:
        return None
    rows = tuple(
        tuple(None if math.isnan(value) else round(value, 3) for value in row) for row in heights.heights_mm.tolist()
    )
    return FaceMap(heights.cell_mm, (float(heights.origin_mm[0]), float(heights.origin_mm[1])), rows)


def _rule(profile: Profile, quantity: str) -> Rule | None:
    return next(iter(rules_for(profile, quantity)), None)


def _unmeasured(profile: Profile, quantity: str) -> Verdict:
    return Verdict.NOT_ASSESSED if _rule(profile, quantity) is None else Verdict.NOT_MEASURED


def _rules(
    profile: Profile, lengths: Sequence[SectionLength], pattern: PatternPlace, flat: SectionLength
) -> list[RuleResult]:
    results = []
    for rule in rules_for(profile, "section_size"):
        off = [one.deviation_mm for one in lengths if one.deviation_mm is not None]
        said = in_one([one.reason for one in lengths if one.reason])
        results.append(rule_result(rule, worst(one.verdict for one in lengths), said, max(off, key=abs, default=None)))
    for rule in rules_for(profile, "pattern_in_section"):
        worst_mm = None if pattern.offset_mm is None else max(pattern.offset_mm, key=abs)
        results.append(rule_result(rule, pattern.verdict, pattern.reason, worst_mm))
    for rule in rules_for(profile, "face_flatness"):
        if flat.measured_mm is None:
            results.append(not_assessed(rule, flat.reason))
        else:
            results.append(rule_result(rule, flat.verdict, flat.reason, flat.measured_mm))
    return results
