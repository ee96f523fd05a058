"""A column that does not go on, as the search for a repair sees it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.matching.symmetry import symmetric_turns
from aadm_workbench.assembly.pairs import Pair, form_pairs
from aadm_workbench.assembly.pose.best_pose import BestFit, PoseConstraints, fit_best_pose, pose_constraints
from aadm_workbench.assembly.pose.eopa import NoFit, robust_offsets
from aadm_workbench.assembly.repair.places import FreePlace, free_place
from aadm_workbench.assembly.tolerances import applicable_rules, rules_for
from aadm_workbench.assembly.trial.virtual import distance_limits
from aadm_workbench.model import Array, AssemblyPoint, BoolArray, ColumnDesign, Profile, Rule, TrialReport

GUARD_SIGMAS = 1.645
"""A limit is narrowed by so many standard uncertainties: what is inside it then is inside it with 95 %."""

_MOST_NARROWED = 0.5  # of a limit: where less were left, no bend could be advised at all


@dataclass(frozen=True, eq=False)
class RepairCase:
    """The measured pairs of a trial, their limits and their design places; arrays are (n, 2) or (n,), mm.

    ``best`` is the trial's best pose. ``rebar_off_mm`` and ``sleeve_off_mm`` (n,) are how far each of the two stands
    from the place that most of the others give it. ``constraints`` and ``places`` may be narrower than the limits, see
    :func:`guarded_case`.
    """

    pairs: tuple[Pair, ...]
    limits_mm: Array
    rebar_design: Array
    sleeve_design: Array
    best: BestFit
    rebar_off_mm: Array
    sleeve_off_mm: Array
    constraints: PoseConstraints
    places: tuple[FreePlace, ...]
    distance_rule: Rule | None
    rebar_rule: Rule | None
    sleeve_rule: Rule | None
    adjustment_rule: Rule | None

    @property
    def rebars(self) -> Array:
        """Measured centres (n, 2) mm of the bars, in the column frame of their own fit."""
        return np.array([pair.rebar_xy for pair in self.pairs])

    @property
    def sleeves(self) -> Array:
        """Measured centres (n, 2) mm of the sleeves, in the column frame of their own fit."""
        return np.array([pair.sleeve_xy for pair in self.pairs])

    @property
    def rebar_fails(self) -> BoolArray:
        """Which bars (n,) stand beyond their own limit of position; none where there is no such limit."""
        return _beyond(self.rebar_off_mm, self.rebar_rule)

    @property
    def sleeve_fails(self) -> BoolArray:
        """Which sleeves (n,) do."""
        return _beyond(self.sleeve_off_mm, self.sleeve_rule)

    @property
    def adjustment_mm(self) -> float | None:
        """How far the profile lets a bar be bent; None where it does not say."""
        return None if self.adjustment_rule is None else self.adjustment_rule.upper

    @property
    def position_limit_mm(self) -> float | None:
        """Limit of a bar's own position within its group."""
        return None if self.rebar_rule is None else self.rebar_rule.upper


def repair_case(
    design: ColumnDesign,
    sleeves: Sequence[AssemblyPoint | None],
    rebars: Sequence[AssemblyPoint | None],
    trial: TrialReport,
    profile: Profile,
) -> RepairCase | None:
    """The case of a trial; None for a trial without a pose or without limits."""
    if trial.best is None:
        return None
    pairs, _ = form_pairs(design, sleeves, rebars, _rebar_of(design, trial.turn_deg))
    rule = _governing(profile, "sleeve_rebar_distance")
    limits_mm = distance_limits(pairs, rule)
    best = None if limits_mm is None else fit_best_pose(pairs, limits_mm)
    if limits_mm is None or best is None or isinstance(best, NoFit):
        return None
    tops = {bar.label: bar.centre[:2] for bar in design.rebars}
    mouths = {sleeve.label: sleeve.centre[:2] for sleeve in design.sleeves}
    rebar_design = np.array([tops[pair.rebar] for pair in pairs])
    sleeve_design = np.array([mouths[pair.sleeve] for pair in pairs])
    return RepairCase(
        pairs=pairs,
        limits_mm=limits_mm,
        rebar_design=rebar_design,
        sleeve_design=sleeve_design,
        best=best,
        rebar_off_mm=_off_mm(np.array([pair.rebar_xy for pair in pairs]), rebar_design),
        sleeve_off_mm=_off_mm(np.array([pair.sleeve_xy for pair in pairs]), sleeve_design),
        constraints=pose_constraints(pairs, limits_mm, best.yaw, best.shift),
        places=_places(pairs, limits_mm, best.yaw),
        distance_rule=rule,
        rebar_rule=_governing(profile, "rebar_position"),
        sleeve_rule=_governing(profile, "sleeve_position"),
        adjustment_rule=next(iter(rules_for(profile, "rebar_adjustment")), None),
    )


def guarded_case(case: RepairCase) -> RepairCase:
    """The same with limits and rooms narrowed by what is not known of each pair, by at most half of each.

    Advice that keeps these holds for the column as it is and not only as it was measured.
    """
    guards = [_guard_mm(pair.covariance) for pair in case.pairs]
    limits_mm = np.array([_narrowed(limit, guard) for limit, guard in zip(case.limits_mm, guards, strict=True)])
    pairs = tuple(_with_less_room(pair) for pair in case.pairs)
    return replace(
        case,
        constraints=pose_constraints(pairs, limits_mm, case.best.yaw, case.best.shift),
        places=_places(pairs, limits_mm, case.best.yaw),
    )


def _with_less_room(pair: Pair) -> Pair:
    if pair.room_mm is None:
        return pair
    lean_mm = max(_guard_mm(pair.bar_shift_covariance), _guard_mm(pair.sleeve_shift_covariance))
    guard_mm = math.hypot(_guard_mm(pair.covariance), lean_mm, GUARD_SIGMAS * pair.room_u_mm)
    return replace(pair, room_mm=_narrowed(pair.room_mm, guard_mm))


def _guard_mm(covariance: Array | None) -> float:
    return 0.0 if covariance is None else GUARD_SIGMAS * math.sqrt(max(float(np.trace(covariance)) / 2.0, 0.0))


def _narrowed(limit_mm: float, guard_mm: float) -> float:
    return limit_mm - min(guard_mm, _MOST_NARROWED * limit_mm) if limit_mm > 0.0 else limit_mm


def _places(pairs: Sequence[Pair], limits_mm: Array, yaw: float) -> tuple[FreePlace, ...]:
    return tuple(free_place(pair, float(limit_mm), yaw) for pair, limit_mm in zip(pairs, limits_mm, strict=True))


def _off_mm(measured: Array, design: Array) -> Array:
    return np.asarray(np.hypot(*robust_offsets(measured, design).T))


def _beyond(off_mm: Array, rule: Rule | None) -> BoolArray:
    return np.asarray(off_mm > (np.inf if rule is None else rule.upper))


def _rebar_of(design: ColumnDesign, turn_deg: float) -> list[int]:
    """For each sleeve the index of the rebar that enters it in that turn of the column."""
    turns = symmetric_turns(np.array([point.centre for point in design.sleeves]))
    chosen = min(turns, key=lambda found: abs(np.degrees(found.angle) - turn_deg))
    return [int(index) for index in chosen.onto]


def _governing(profile: Profile, quantity: str) -> Rule | None:
    return next(iter(applicable_rules(profile, quantity)[0]), None)
