"""Virtual trial assembly: will this column go on these bars (paper, 2.1.3).

Bars are brought onto sleeves in the plane. Least squares, as published, says how they differ; minimax is the pose with
the smallest largest distance; and the best pose leaves most of distance and room over the ribs together. The column
goes on where some pose keeps every limit and every room: the verdict follows the probability that there is one.

In how many ways the sleeves of one scan may meet the bars of another, where it is open how the two lie. Turned
together, both make the same pairs again: what counts is which measured sleeve meets which measured bar. Of a square
ring that was seen whole four ways are left of sixteen; of parts of a row, that may be shifted against each other from
either side, all that differ.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule, agreed
from aadm_workbench.assembly.inspect import describe_ambiguity
from aadm_workbench.assembly.matching.match import Match, Placement
from aadm_workbench.assembly.matching.symmetry import SymmetricTurn, symmetric_turns
from aadm_workbench.assembly.pairs import Pair, embedded_length_mm, form_pairs, in_column_frame
from aadm_workbench.assembly.pose.best_pose import fit_best_pose
from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar
from aadm_workbench.assembly.pose.minimax import fit_minimax
from aadm_workbench.assembly.pose.pose_probability import SAMPLES, existence_of_a_pose
from aadm_workbench.assembly.tolerances import applicable_rules, describe_limit
from aadm_workbench.assembly.trial.pose import evaluate_best_pose, evaluate_pose, other_readings
from aadm_workbench.assembly.trial.verdict import collisions, judge_trial, judge_without_limits
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    ColumnDesign,
    Extraction,
    Profile,
    Reason,
    Rule,
    TrialReport,
    TurnResult,
    Verdict,
)

RIBBED_BAR_SOURCE = "GB/T 1499.2-2018, table 3, unverified"

_BEST_FIRST = (Verdict.PASS, Verdict.INCONCLUSIVE, Verdict.NOT_MEASURED, Verdict.FAIL, Verdict.NOT_ASSESSED)


def try_scans(
    design: ColumnDesign,
    sleeves: tuple[Extraction, Match],
    rebars: tuple[Extraction, Match],
    profile: Profile,
    generator: np.random.Generator,
    *,
    decision: DecisionRule = "guarded",
    turns: bool = False,
    samples: int = SAMPLES,
    measured_diameters: bool = False,
) -> TrialReport:
    """Trial assembly from two scans that were matched to the design.

    Where matches are ambiguous, the trial is made in every way of the bars against the sleeves that they leave open,
    and the verdict stands only where all of them agree. Parameters as :func:`try_assembly`.
    """
    for extraction, match in (sleeves, rebars):
        if not match:
            return TrialReport(
                Verdict.NOT_MEASURED, reasons=(Reason("said.of", what=extraction.kind.plural, why=match.reason),)
            )
    reports = []
    for sleeve_turn, rebar_turn in open_ways(design, sleeves[1], rebars[1]):
        report = try_assembly(
            design,
            in_column_frame(sleeves[0], sleeve_turn),
            in_column_frame(rebars[0], rebar_turn),
            profile,
            generator,
            decision=decision,
            turns=turns,
            samples=samples,
            measured_diameters=measured_diameters,
        )
        reports.append(report)
    ambiguous = next((match for _, match in (sleeves, rebars) if match.orientation == "ambiguous"), None)
    return reports[0] if ambiguous is None else _agree(reports, ambiguous)


def try_assembly(
    design: ColumnDesign,
    sleeves: Sequence[AssemblyPoint | None],
    rebars: Sequence[AssemblyPoint | None],
    profile: Profile,
    generator: np.random.Generator,
    *,
    decision: DecisionRule = "guarded",
    turns: bool = False,
    samples: int = SAMPLES,
    measured_diameters: bool = False,
) -> TrialReport:
    """Trial assembly of measured sleeves and rebars, each already in the column frame by its own fit.

    Parameters
    ----------
    sleeves, rebars
        In the order of the design, None where not measured. What is missing makes a trial that does not fail
        not measured: no pose of some pairs means no pose of all.
    profile
        Its tightest counted ``sleeve_rebar_distance`` is the limit; without one the room over the ribs is.
    generator
        For the probability that a pose exists, in a guarded decision.
    turns
        Whether the column may be turned by the symmetry of its sleeves: the best turn is reported, the design's
        own first.
    measured_diameters
        Inner diameters of the sleeves from the scan and not from the design.
    """
    centres = np.array([point.centre for point in design.sleeves])
    options = symmetric_turns(centres) if turns else (SymmetricTurn(0.0, np.arange(len(centres))),)
    reports = []
    for option in options:
        pairs, missing = form_pairs(
            design, sleeves, rebars, option.onto.tolist(), measured_diameters=measured_diameters
        )
        report = _try_both_ways(pairs, missing, profile, generator, decision, samples, embedded_length_mm(design))
        reports.append(replace(report, turn_deg=math.degrees(option.angle)))
    best = min(reports, key=lambda report: _BEST_FIRST.index(report.verdict))
    listed = tuple(
        TurnResult(report.turn_deg, None if report.minimax is None else report.minimax.max_mm, report.verdict)
        for report in reports
    )
    notes = _design_notes(design, profile)
    return replace(
        best, turns=listed if turns else (), embedded_length_mm=embedded_length_mm(design), notes=best.notes + notes
    )


def _design_notes(design: ColumnDesign, profile: Profile) -> tuple[str, ...]:
    """What of the design itself bears on the trial: an assumed size, and pairs that miss the limit as drawn."""
    given = design.rebar_outer_diameter_mm or all(bar.outer_diameter_mm for bar in design.rebars)
    notes = [] if given else [Reason("assembly.ribs_after", source=RIBBED_BAR_SOURCE)]
    for rule in applicable_rules(profile, "sleeve_rebar_distance")[0][:1]:
        for sleeve, rebar in zip(design.sleeves, design.rebars, strict=False):
            apart_mm = float(np.hypot(*(rebar.centre - sleeve.centre)[:2]))
            if apart_mm > rule.upper:
                pair = {"rebar": rebar.label, "sleeve": sleeve.label}
                notes.append(Reason("assembly.design_off", **pair, apart_mm=apart_mm, limit=describe_limit(rule)))
    return tuple(notes)


def _try_both_ways(
    pairs: tuple[Pair, ...],
    missing: tuple[str, ...],
    profile: Profile,
    generator: np.random.Generator,
    decision: DecisionRule,
    samples: int,
    length_mm: float,
) -> TrialReport:
    """The trial as measured; where axes may be otherwise, it is decided only as far as it does not depend on that."""
    report = measured = _try_pairs(pairs, missing, profile, generator, decision, samples)
    if measured.best is None:
        return measured
    for said, others in other_readings(pairs, length_mm):
        other = _try_pairs(others, missing, profile, generator, decision, samples)
        if other.verdict is measured.verdict:
            report = replace(report, notes=(*report.notes, said))
            continue
        verdict = Verdict.NOT_MEASURED if missing else Verdict.INCONCLUSIVE
        depends = Reason(
            "assembly.depends_on_lean", said=said, as_measured=measured.verdict.value, without=other.verdict.value
        )
        stated = None if missing else report.probability
        report = replace(report, verdict=verdict, probability=stated, reasons=(depends, *report.reasons))
    return report


def _try_pairs(
    pairs: tuple[Pair, ...],
    missing: tuple[str, ...],
    profile: Profile,
    generator: np.random.Generator,
    decision: DecisionRule,
    samples: int,
) -> TrialReport:
    rule = next(iter(applicable_rules(profile, "sleeve_rebar_distance")[0]), None)
    source = np.array([pair.rebar_xy for pair in pairs]).reshape(-1, 2)
    target = np.array([pair.sleeve_xy for pair in pairs]).reshape(-1, 2)
    squares = fit_eopa_planar(source, target)
    if isinstance(squares, NoFit):
        reason = Reason("assembly.no_trial", count=len(pairs), why=squares.reason)
        return TrialReport(Verdict.NOT_MEASURED, missing=missing, reasons=(reason,))
    limits = distance_limits(pairs, rule)
    fit = fit_minimax(source, target, np.ones(len(pairs)) if limits is None else limits)
    if isinstance(fit, NoFit):
        return TrialReport(Verdict.NOT_MEASURED, missing=missing, reasons=(fit.reason,))
    report = TrialReport(
        verdict=Verdict.NOT_ASSESSED,
        least_squares=evaluate_pose(pairs, squares.yaw, squares.t, rule, decision),
        minimax=(minimax := evaluate_pose(pairs, fit.yaw, fit.shift, rule, decision)),
        collisions=collisions(minimax),
        missing=missing,
    )
    best = None if limits is None else fit_best_pose(pairs, limits)
    if limits is None or best is None or isinstance(best, NoFit):
        return judge_without_limits(report)
    pose = evaluate_best_pose(pairs, limits, best, rule, decision)
    existence = existence_of_a_pose(pairs, limits, best, generator, samples) if decision == "guarded" else None
    report = replace(report, best=pose, collisions=collisions(pose))
    return judge_trial(report, pairs, best, existence, profile)


def distance_limits(pairs: Sequence[Pair], rule: Rule | None) -> Array | None:
    """Limit of the distance of each pair, (n,) mm; without a rule the room over the ribs, None where unknown."""
    if rule is not None:
        return np.full(len(pairs), rule.upper)
    rooms = [pair.room_mm for pair in pairs if pair.room_mm is not None]
    return np.array(rooms) if len(rooms) == len(pairs) and min(rooms) > 0.0 else None


def _agree(reports: Sequence[TrialReport], match: Match) -> TrialReport:
    """The first report, with the verdict that all turns agree on."""
    verdict = agreed(report.verdict for report in reports)
    note = describe_ambiguity(match)
    if verdict is Verdict.PASS:
        return replace(reports[0], verdict=verdict, notes=(*reports[0].notes, note))
    reasons = [note]
    if verdict is Verdict.INCONCLUSIVE:
        counts = [sum(report.verdict is kind for report in reports) for kind in _BEST_FIRST]
        found = [
            Reason("assembly.verdict_in", verdict=kind.value, count=count)
            for kind, count in zip(_BEST_FIRST, counts, strict=True)
            if count
        ]
        reasons.append(Reason("assembly.turns_come_to", turns=len(reports), found=found))
    reasons += [Reason("assembly.first_turn", why=reason) for reason in reports[0].reasons]
    return replace(reports[0], verdict=verdict, reasons=tuple(reasons))


def open_ways(design: ColumnDesign, sleeves: Match, rebars: Match) -> Iterator[tuple[Placement, Placement]]:
    """Placements of sleeves and of rebars, each that makes pairs of its own once, the chosen one first."""
    known = set()
    for sleeve_turn in sleeves.evaluated:
        for rebar_turn in rebars.evaluated:
            pairs = _pairs(design, sleeve_turn, rebar_turn)
            if pairs not in known:
                known.add(pairs)
                yield sleeve_turn, rebar_turn


def _pairs(design: ColumnDesign, sleeve_turn: Placement, rebar_turn: Placement) -> frozenset[tuple[float, ...]]:
    """Which measured points meet, with the sizes that the design gives them there."""
    pairs = set()
    places = zip(sleeve_turn.matched.tolist(), rebar_turn.matched.tolist(), strict=False)
    for place, (sleeve, rebar) in enumerate(places):
        bar = design.rebars[place]
        sizes = design.sleeves[place].diameter_mm, bar.diameter_mm, bar.outer_diameter_mm or 0.0
        pairs.add((sleeve, rebar, *sizes))
    return frozenset(pairs)
