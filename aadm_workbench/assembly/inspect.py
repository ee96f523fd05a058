"""Inspection of one group, the sleeves or the rebars of a column, against design (paper, 2.1.2).

Two different checks: the position of each centre after the fit, and the spacing of adjacent centres.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule, agree_on_points, agree_on_spacing, agreed, decide_signed
from aadm_workbench.assembly.matching.match import Match, Placement
from aadm_workbench.assembly.pairs import PlacedPoint, place_points
from aadm_workbench.assembly.pose.eopa import wrap
from aadm_workbench.assembly.position import describe_limits, inspect_positions, inspect_spacing
from aadm_workbench.assembly.tolerances import (
    applicable_rules,
    counted_verdict,
    describe_clause,
    not_assessed,
    position_result,
    rules_for,
    spacing_result,
)
from aadm_workbench.model import (
    AssemblyPoint,
    Candidate,
    Extraction,
    Fit,
    GroupReport,
    PointResult,
    Profile,
    Reason,
    Rule,
    RuleResult,
    SpacingResult,
    Verdict,
    in_one,
    worst,
)

_FEWEST_TO_BLAME = 4
"""With three points or fewer, no majority says where the others should be."""

NO_ABSOLUTE_POSITION = Reason("assembly.no_absolute_position")


@dataclass(frozen=True)
class _Inspected:
    """One placement, inspected."""

    points: tuple[PointResult, ...]
    spacing: tuple[SpacingResult, ...]
    rules: tuple[RuleResult, ...]
    blamed: Mapping[str, float] = field(default_factory=dict)

    @property
    def verdict(self) -> Verdict:
        return counted_verdict(self.rules)


def inspect_group(
    design: Sequence[AssemblyPoint],
    extraction: Extraction,
    match: Match,
    profile: Profile,
    *,
    decision: DecisionRule = "guarded",
    scale_error: float = 0.0,
    design_exposed_mm: float | None = None,
    source: str = "",
    sha256: str = "",
) -> GroupReport:
    """Position and spacing of the sleeves or the rebars of one column.

    Parameters
    ----------
    design
        The design points of that kind, labelled, in the column frame.
    extraction
        What was found in the scan.
    match
        How it lies on the design; an ambiguous match is inspected in all its placements, and only what they
        agree on stands.
    profile
        The limits. Rules for which there is no input are listed as not assessed.
    scale_error
        Relative standard uncertainty (k = 1) of the camera's lengths, where the covariances do not hold it.
    design_exposed_mm
        Exposed length of the rebars by design, where it is known.
    source, sha256
        Of the scan, for the report.
    """
    if not match:
        return _not_matched(design, extraction, match, profile, source, sha256)
    inspected = [
        _inspect(
            design, place_points(extraction, placement), extraction, profile, decision, scale_error, design_exposed_mm
        )
        for placement in match.evaluated
    ]
    verdict = agreed(result.verdict for result in inspected)
    return GroupReport(
        source=source,
        sha256=sha256,
        method=extraction.method,
        expected=len(design),
        found=match.placements[0].found,
        verdict=verdict,
        points=agree_on_points([result.points for result in inspected]),
        spacing=agree_on_spacing([result.spacing for result in inspected]),
        fit=_fit(design, match, [result.verdict for result in inspected]),
        rules=_agreed_rules(inspected),
        reasons=_reasons(match, inspected[0], verdict),
        notes=_notes(extraction, match),
        quality=extraction.quality,
        blamed=() if len(inspected) > 1 else tuple(inspected[0].blamed),
    )


def _inspect(
    design: Sequence[AssemblyPoint],
    placed: Sequence[PlacedPoint | None],
    extraction: Extraction,
    profile: Profile,
    decision: DecisionRule,
    scale_error: float,
    design_exposed_mm: float | None,
) -> _Inspected:
    kind = extraction.kind.value
    missing = extraction.reason or Reason("extract.not_found")
    position_rules, skipped = applicable_rules(profile, f"{kind}_position")
    spacing_rules, more_skipped = applicable_rules(profile, f"{kind}_spacing")
    by_position = [
        inspect_positions(design, placed, rule, decision=decision, scale_error=scale_error, missing=missing)
        for rule in position_rules or (None,)
    ]
    by_spacing = [
        inspect_spacing(design, placed, rule, decision=decision, scale_error=scale_error)
        for rule in spacing_rules or (None,)
    ]
    rules = [position_result(rule, points) for rule, points in zip(position_rules, by_position, strict=False)]
    rules += [spacing_result(rule, spacing) for rule, spacing in zip(spacing_rules, by_spacing, strict=False)]
    for rule in rules_for(profile, f"{kind}_exposed_length"):
        rules.append(inspect_exposed_length(design, placed, rule, design_exposed_mm))
    rules += [not_assessed(rule, NO_ABSOLUTE_POSITION) for rule in (*skipped, *more_skipped)]
    rules += [not_assessed(rule, NO_ABSOLUTE_POSITION) for rule in rules_for(profile, "group_position")]
    blamed = _blamed(design, by_position[0], position_rules[0]) if position_rules else {}
    return _Inspected(by_position[0], by_spacing[0], tuple(rules), blamed)


def _blamed(design: Sequence[AssemblyPoint], points: Sequence[PointResult], rule: Rule) -> dict[str, float]:
    """Who is really off, and how far, mm, where the fit of all points lets others fail."""
    failing = {point.label for point in points if point.verdict is Verdict.FAIL}
    known = [(target, point.aligned_mm) for target, point in zip(design, points, strict=True) if point.aligned_mm]
    if not failing or len(known) < _FEWEST_TO_BLAME:
        return {}
    from aadm_workbench.assembly.blame import blamed_of_group

    measured = np.array([aligned for _, aligned in known])[:, :2]
    places = np.array([target.centre for target, _ in known])[:, :2]
    return blamed_of_group([target.label for target, _ in known], measured, places, failing, rule)


def _agreed_rules(inspected: Sequence[_Inspected]) -> tuple[RuleResult, ...]:
    results = []
    for first, same in zip(inspected[0].rules, zip(*(result.rules for result in inspected), strict=True), strict=True):
        verdict = agreed(result.verdict for result in same)
        results.append(
            RuleResult(first.rule, first.clause, first.source, verdict, first.counted, first.reason, first.worst_mm)
        )
    return tuple(results)


def _fit(design: Sequence[AssemblyPoint], match: Match, verdicts: Sequence[Verdict]) -> Fit:
    chosen = match.placements[0]
    candidates = tuple(
        _candidate(design, placement, chosen, verdicts[index] if index < len(verdicts) else None)
        for index, placement in enumerate(match.placements)
    )
    up = None if match.declared is None or len(match.placements) == 1 else direction_name(match.declared)
    return Fit(chosen.T_design_scan, chosen.rms_mm, chosen.max_mm, match.orientation, candidates, chosen.scale, up)


def direction_name(angle: float) -> str:
    """A direction of the column frame, radians from +x, as jobs declare it: ``+y``, or degrees."""
    degrees = math.degrees(angle) % 360.0
    named = {0: "+x", 90: "+y", 180: "-x", 270: "-y"}  # degrees
    return named.get(round(degrees), f"{degrees:.0f}°") if abs(degrees - round(degrees)) < 1e-6 else f"{degrees:.1f}°"


def _candidate(
    design: Sequence[AssemblyPoint], placement: Placement, chosen: Placement, verdict: Verdict | None
) -> Candidate:
    label_of = {
        measured: target.label
        for target, measured in zip(design, placement.matched.tolist(), strict=True)
        if measured >= 0
    }
    labels = {
        target.label: label_of[measured]
        for target, measured in zip(design, chosen.matched.tolist(), strict=True)
        if measured in label_of
    }
    return Candidate(
        labels=labels,
        yaw_deg=math.degrees(wrap(placement.yaw - chosen.yaw)),
        rms_mm=placement.rms_mm,
        max_mm=placement.max_mm,
        matched=placement.found,
        up_deg=None if placement.up is None else math.degrees(placement.up),
        verdict=verdict,
    )


def _reasons(match: Match, first: _Inspected, verdict: Verdict) -> tuple[str, ...]:
    texts: list[PointResult | SpacingResult] = [*first.points, *first.spacing]
    order = (Verdict.FAIL, Verdict.NOT_MEASURED, Verdict.INCONCLUSIVE)
    reasons = [text.reason for kind in order for text in texts if text.verdict is kind and text.reason]
    reasons += [
        rule.reason
        for rule in first.rules
        if rule.rule.endswith("exposed_length") and rule.verdict is Verdict.FAIL and rule.counted
    ]
    if first.blamed:
        from aadm_workbench.assembly.blame import said_of_blamed

        reasons = [said_of_blamed(first.blamed), *reasons]
    if match.orientation != "ambiguous":
        return tuple(reasons)
    if verdict is Verdict.PASS:
        return ()
    code = "assembly.first_place" if match.is_shifted else "assembly.first_turn"
    return (describe_ambiguity(match), *(Reason(code, why=reason) for reason in reasons))


def describe_ambiguity(match: Match) -> str:
    """In how many turns the pattern fits, and what to declare; in how many places, and what to scan."""
    if match.is_shifted:
        return Reason("assembly.places", count=len(match.placements))
    ups = [placement.up for placement in match.placements]
    turns = [f"{round(math.degrees(up)) % 360}°" for up in ups if up is not None]
    return Reason("assembly.turns_at" if turns else "assembly.turns", count=len(ups), turns=turns)


def _notes(extraction: Extraction, match: Match) -> tuple[str, ...]:
    notes: list[str] = [NO_ABSOLUTE_POSITION]
    if match.orientation == "ambiguous":
        notes.append(describe_ambiguity(match))
    if match.extra:
        one = len(match.extra) == 1
        kind = extraction.kind.value if one else extraction.kind.plural
        notes.append(Reason("assembly.one_extra" if one else "assembly.extra", count=len(match.extra), kind=kind))
    return tuple(notes)


def _not_matched(
    design: Sequence[AssemblyPoint], extraction: Extraction, match: Match, profile: Profile, source: str, sha256: str
) -> GroupReport:
    nothing = (None,) * len(design)
    kind = extraction.kind.value
    position = next(iter(applicable_rules(profile, f"{kind}_position")[0]), None)
    spacing = next(iter(applicable_rules(profile, f"{kind}_spacing")[0]), None)
    return GroupReport(
        source=source,
        sha256=sha256,
        method=extraction.method,
        expected=len(design),
        found=0,
        verdict=Verdict.NOT_MEASURED,
        points=inspect_positions(design, nothing, position, decision="simple", missing=match.reason),
        spacing=inspect_spacing(design, nothing, spacing, decision="simple"),
        fit=None,
        reasons=(Reason("said.of", what=extraction.kind.plural, why=match.reason),),
        notes=(NO_ABSOLUTE_POSITION,),
        quality=extraction.quality,
    )


def inspect_exposed_length(
    design: Sequence[AssemblyPoint],
    placed: Sequence[PlacedPoint | None],
    rule: Rule,
    design_exposed_mm: float | None,
) -> RuleResult:
    """Worst verdict on the exposed lengths, mm, measured minus design, by value alone.

    Not assessed where the design gives no exposed length or the scan shows no floor.
    """
    clause, counted = describe_clause(rule), not rule.advisory
    if design_exposed_mm is None:
        reason = Reason("assembly.no_exposed_length")
        return RuleResult(rule.name, clause, rule.source, Verdict.NOT_ASSESSED, counted, reason)
    verdicts, reasons, deviations = [], [], []
    for target, point in zip(design, placed, strict=True):
        if point is None or point.exposed_length_mm is None:
            continue
        deviation_mm = point.exposed_length_mm - design_exposed_mm
        verdict = decide_signed(deviation_mm, None, rule.lower, rule.upper, "simple").verdict
        verdicts.append(verdict)
        deviations.append(deviation_mm)
        if verdict is Verdict.FAIL:
            reasons.append(
                Reason(
                    "assembly.sticks_out",
                    label=target.label,
                    exposed_mm=point.exposed_length_mm,
                    deviation_mm=deviation_mm,
                    limits=describe_limits(rule),
                    clause=clause,
                )
            )
    if not verdicts:
        reason = Reason("assembly.no_floor")
        return RuleResult(rule.name, clause, rule.source, Verdict.NOT_ASSESSED, counted, reason)
    return RuleResult(
        rule.name, clause, rule.source, worst(verdicts), counted, in_one(reasons), max(deviations, key=abs)
    )
