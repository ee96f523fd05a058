"""Pair by pair: is the bar to be bent, is the sleeve to be rejected, or may neither be advised."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar
from aadm_workbench.assembly.repair.case import RepairCase
from aadm_workbench.assembly.repair.places import own_places
from aadm_workbench.assembly.repair.plan import Bend, RepairPlan, after_repair
from aadm_workbench.assembly.tolerances import describe_clause, describe_limit
from aadm_workbench.model import Array, Reason, RepairAction, RepairStep


def repair_steps(case: RepairCase, plan: RepairPlan) -> tuple[RepairStep, ...]:
    """One step for each bend of a plan, in the order of the pairs."""
    bent = [bend.pair for bend in plan.bends]
    before = _deviations(case.rebars, case.rebar_design)
    after = _deviations(np.array([pair.rebar_xy for pair in after_repair(case, plan)]), case.rebar_design)
    rebars_off = _off_own_places(case.rebars, case.rebar_design, bent)
    sleeves_off = _off_own_places(case.sleeves, case.sleeve_design, bent)
    return tuple(
        _step(case, bend, *(float(values[bend.pair]) for values in (before, after, rebars_off, sleeves_off)))
        for bend in plan.bends
    )


def still_beyond(case: RepairCase, pairs: Sequence[Pair]) -> tuple[str, ...]:
    """Labels of the bars that a check would then find beyond their limit of position, after the fit of all bars."""
    if case.position_limit_mm is None:
        return ()
    off_mm = _deviations(np.array([pair.rebar_xy for pair in pairs]), case.rebar_design)
    return tuple(pair.rebar for pair, off in zip(pairs, off_mm, strict=True) if off > case.position_limit_mm)


def _step(
    case: RepairCase, bend: Bend, before_mm: float, after_mm: float, rebar_off_mm: float, sleeve_off_mm: float
) -> RepairStep:
    pair = case.pairs[bend.pair]
    limit_mm = case.position_limit_mm
    keeps_own = bend.by is not None and (limit_mm is None or after_mm <= limit_mm)
    sleeve_is_off = case.sleeve_rule is not None and sleeve_off_mm > case.sleeve_rule.upper
    rebar_is_right = limit_mm is None or rebar_off_mm <= limit_mm
    sleeve_to_blame = sleeve_is_off and rebar_is_right
    may_bend = case.adjustment_mm is not None and bend.length_mm <= case.adjustment_mm + 1e-9
    if may_bend and keeps_own:
        action, reason = RepairAction.BEND, ""
    elif sleeve_to_blame:
        action = RepairAction.REJECT_SLEEVE
        reason = Reason("repair.sleeve_off", sleeve=pair.sleeve, off_mm=sleeve_off_mm, rebar=pair.rebar)
    elif may_bend:
        action = RepairAction.BEND
        reason = Reason(
            "repair.then_from_design", rebar=pair.rebar, after_mm=after_mm, limit=describe_limit(case.rebar_rule)
        )
    else:
        action, reason = RepairAction.DISPOSAL_PLAN, _why_not_bent(case, bend)
    return RepairStep(
        action=action,
        sleeve=pair.sleeve,
        rebar=pair.rebar,
        bend_mm=None if bend.by is None else (float(bend.by[0]), float(bend.by[1])),
        bend_length_mm=None if bend.by is None else bend.length_mm,
        least_bend_mm=None if bend.by is None else bend.least_mm,
        upright=bend.upright,
        position_before_mm=before_mm,
        position_after_mm=None if bend.by is None else after_mm,
        position_limit_mm=limit_mm,
        sleeve_off_mm=sleeve_off_mm,
        reason=reason,
        blamed=pair.sleeve if sleeve_to_blame else pair.rebar,
        off_mm=sleeve_off_mm if sleeve_to_blame else rebar_off_mm,
    )


def _why_not_bent(case: RepairCase, bend: Bend) -> str:
    pair = case.pairs[bend.pair]
    if bend.by is None:
        return Reason("repair.no_bend_helps", rebar=pair.rebar, sleeve=pair.sleeve)
    if case.adjustment_rule is None:
        return Reason("repair.too_far.no_rule", rebar=pair.rebar, length_mm=bend.length_mm)
    far = Reason("repair.too_far", rebar=pair.rebar, length_mm=bend.length_mm)
    rule = case.adjustment_rule
    return Reason("assembly.beyond", how=far, upper=rule.upper, clause=describe_clause(rule))


def _deviations(measured: Array, design: Array) -> Array:
    """Distance (n,) mm of each centre from its design place after the fit of all of them."""
    fit = fit_eopa_planar(measured, design)
    offsets = measured - design if isinstance(fit, NoFit) else fit.residuals
    return np.asarray(np.hypot(*offsets.T))


def _off_own_places(measured: Array, design: Array, bent: list[int]) -> Array:
    """Distance (n,) mm of each centre from the place that those of the other pairs give it."""
    places = own_places(measured, design, bent)
    return _deviations(measured, design) if places is None else np.asarray(np.hypot(*(measured - places).T))
