"""A column tried on bars that may be those of another one: only its margin, so that a whole shipment takes seconds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.matching.match import Match
from aadm_workbench.assembly.matching.symmetry import SymmetricTurn, symmetric_turns
from aadm_workbench.assembly.pairs import form_pairs, in_column_frame
from aadm_workbench.assembly.pose.best_pose import fit_best_pose
from aadm_workbench.assembly.pose.eopa import NoFit
from aadm_workbench.assembly.tolerances import applicable_rules
from aadm_workbench.assembly.trial.pose import evaluate_pose
from aadm_workbench.assembly.trial.virtual import distance_limits, open_ways
from aadm_workbench.model import AssemblyPoint, ColumnDesign, Extraction, Profile, Reason
from aadm_workbench.model.across import FitCell

SAME_PLACE_MM = 0.5
"""Columns of one mark differ by less: a quarter of what a sleeve may stand off."""

NO_ROOM_MARGIN = -1.0
"""Margin of a column one of whose bars is as wide as its sleeve: as of a distance of twice its limit."""

_Points = Sequence[AssemblyPoint | None]


def interchangeable(first: ColumnDesign, second: ColumnDesign) -> bool:
    """Whether two columns may take each other's place: one piece mark, or one inline design, and one pattern."""
    if first.piece_mark != second.piece_mark:
        return False
    if first.piece_mark is None and (first.global_id is not None or second.global_id is not None):
        return False
    return _alike(first.sleeves, second.sleeves) and _alike(first.rebars, second.rebars)


def _alike(first: Sequence[AssemblyPoint], second: Sequence[AssemblyPoint]) -> bool:
    if not first or not second:
        return True
    if len(first) != len(second):
        return False
    return all(
        float(np.hypot(*(a.centre - b.centre)[:2])) <= SAME_PLACE_MM
        and abs(a.diameter_mm - b.diameter_mm) <= SAME_PLACE_MM
        for a, b in zip(first, second, strict=True)
    )


def joined_design(column: ColumnDesign, position: ColumnDesign) -> ColumnDesign:
    """The design of a column on the bars of a position."""
    return replace(column, rebars=position.rebars) if position.rebars else column


def try_margin(
    design: ColumnDesign,
    sleeves: tuple[Extraction, Match],
    rebars: tuple[Extraction, Match],
    profile: Profile,
    *,
    turns: bool = False,
) -> FitCell:
    """The margin with which measured sleeves go on measured bars, by value alone, in the best of the permitted turns.

    Where it is open how a scan is turned, the worst of what it may be counts.
    """
    cells = []
    for sleeve_turn, rebar_turn in open_ways(design, sleeves[1], rebars[1]):
        feet = in_column_frame(sleeves[0], sleeve_turn)
        tops = in_column_frame(rebars[0], rebar_turn)
        cells.append(_best_turn(design, feet, tops, profile, turns))
    return min(cells, key=_by_margin)


def _best_turn(design: ColumnDesign, sleeves: _Points, rebars: _Points, profile: Profile, turns: bool) -> FitCell:
    centres = np.array([point.centre for point in design.sleeves])
    options = symmetric_turns(centres) if turns else (SymmetricTurn(0.0, np.arange(len(centres))),)
    # Of equal margins the first stays, so that what fits as drawn is not turned.
    return max((_in_turn(design, sleeves, rebars, profile, option) for option in options), key=_by_margin)


def _in_turn(
    design: ColumnDesign, sleeves: _Points, rebars: _Points, profile: Profile, option: SymmetricTurn
) -> FitCell:
    turn_deg = math.degrees(option.angle)
    pairs, missing = form_pairs(design, sleeves, rebars, option.onto.tolist())
    if not pairs:
        return FitCell(None, turn_deg=turn_deg, reason=Reason("assembly.missing", labels=missing))
    rule = next(iter(applicable_rules(profile, "sleeve_rebar_distance")[0]), None)
    limits_mm = distance_limits(pairs, rule)
    if limits_mm is None:
        return FitCell(None, turn_deg=turn_deg, reason=Reason("assembly.no_limit_nor_room.cell"))
    fit = fit_best_pose(pairs, limits_mm)
    if isinstance(fit, NoFit):
        return FitCell(None, turn_deg=turn_deg, reason=fit.reason)
    pose = evaluate_pose(pairs, fit.yaw, fit.shift, rule, "simple")
    margin = NO_ROOM_MARGIN if fit.margin is None else fit.margin
    if missing and margin >= 0.0:
        return FitCell(None, pose.max_mm, turn_deg, Reason("assembly.missing", labels=missing))
    return FitCell(margin, pose.max_mm, turn_deg)


def _by_margin(cell: FitCell) -> float:
    """For comparisons: what is not known is worse than any margin."""
    return -math.inf if cell.margin is None else round(cell.margin, 9)  # equals stay equal on every machine
