"""A column that does not go on, as the search for a repair sees it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.constraints import PoseConstraints, pose_constraints
from aadm_workbench.assembly.pairs import Pair, form_pairs
from aadm_workbench.assembly.repair_places import FreePlace, free_place
from aadm_workbench.assembly.rules import applicable_rules
from aadm_workbench.assembly.symmetry import symmetric_turns
from aadm_workbench.assembly.tolerances import rules_for
from aadm_workbench.assembly.trial import distance_limits
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Profile, Rule, TrialPose, TrialReport


@dataclass(frozen=True, eq=False)
class RepairCase:
    """The measured pairs of a trial, their limits and their design places; arrays are (n, 2) or (n,), mm.

    ``yaw`` (radians) and ``shift`` (2,) mm are the trial's minimax pose.
    """

    pairs: tuple[Pair, ...]
    limits_mm: Array
    rebar_design: Array
    sleeve_design: Array
    yaw: float
    shift: Array
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
    if trial.minimax is None:
        return None
    rebar_of = _rebar_of(design, trial.turn_deg)
    pairs, _ = form_pairs(design, sleeves, rebars, rebar_of)
    rule = _governing(profile, "sleeve_rebar_distance")
    limits_mm = distance_limits(pairs, rule)
    if limits_mm is None:
        return None
    yaw, shift = pose_of(trial.minimax)
    tops = {bar.label: bar.centre[:2] for bar in design.rebars}
    mouths = {sleeve.label: sleeve.centre[:2] for sleeve in design.sleeves}
    return RepairCase(
        pairs=pairs,
        limits_mm=limits_mm,
        rebar_design=np.array([tops[pair.rebar] for pair in pairs]),
        sleeve_design=np.array([mouths[pair.sleeve] for pair in pairs]),
        yaw=yaw,
        shift=shift,
        constraints=pose_constraints(pairs, limits_mm, yaw, shift),
        places=tuple(free_place(pair, float(limit_mm), yaw) for pair, limit_mm in zip(pairs, limits_mm, strict=True)),
        distance_rule=rule,
        rebar_rule=_governing(profile, "rebar_position"),
        sleeve_rule=_governing(profile, "sleeve_position"),
        adjustment_rule=next(iter(rules_for(profile, "rebar_adjustment")), None),
    )


def pose_of(pose: TrialPose) -> tuple[float, Array]:
    """Yaw, radians, and shift (2,) mm of bars onto sleeves."""
    T = pose.T_sleeves_rebars
    return float(np.arctan2(T[1, 0], T[0, 0])), np.asarray(T[:2, 3])


def _rebar_of(design: ColumnDesign, turn_deg: float) -> list[int]:
    """For each sleeve the index of the rebar that enters it in that turn of the column."""
    turns = symmetric_turns(np.array([point.centre for point in design.sleeves]))
    chosen = min(turns, key=lambda found: abs(np.degrees(found.angle) - turn_deg))
    return [int(index) for index in chosen.onto]


def _governing(profile: Profile, quantity: str) -> Rule | None:
    return next(iter(applicable_rules(profile, quantity)[0]), None)
