"""The moulds of a job: which columns come from one, and what each mould does to its sleeves.

A limit that is radial holds for the length of (dx, dy); process capability is one number for each axis. It is taken
against the square inscribed in the circle, ± limit/√2: what keeps to it on both axes keeps to the circle. Its mean and
scatter are those of the position after each column's own fit, because that is what the limit holds for.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.mould.drift import CONFIDENCE, SharedDisplacement, cp_index, cpk_index, shared_displacement
from aadm_workbench.assembly.tolerances import applicable_rules
from aadm_workbench.model import (
    Array,
    Capability,
    ColumnReport,
    GroupReport,
    MouldDrift,
    Profile,
    Reason,
    Rule,
    SleeveDrift,
    Vector2,
)
from aadm_workbench.model.made import each

FEWEST_COLUMNS = 3
"""Columns of one mould: of two nobody can say what is the mould's and what is scatter."""

_SHARED_UNCERTAINTIES = 2.0
"""A displacement below this many uncertainties of a single centre may be one that all scans share."""

_SMALLEST_SCATTER_MM = 1e-9  # keeps a division: a picometre


def assess_moulds(columns: Sequence[ColumnReport], profile: Profile) -> tuple[MouldDrift, ...]:
    """What the columns of each mould have in common, in the order of the job.

    Columns are of one mould where they have the same piece mark, or the same inline design. Moulds of fewer than three
    columns are left out, and feet whose orientation is ambiguous: it is open which of their sleeves is which. A scan
    that is named for several columns shows one foot, and counts once.
    """
    moulds: dict[object, list[_Foot]] = {}
    first: dict[object, int] = {}
    counted: set[tuple[Hashable, str]] = set()
    for number, foot in enumerate(each(columns, foot_of)):
        if foot is not None and (foot.mould, foot.sha256) not in counted:
            if foot.sha256:
                counted.add((foot.mould, foot.sha256))
            moulds.setdefault(foot.mould, []).append(foot)
            first.setdefault(foot.mould, number)
    rule = next(iter(applicable_rules(profile, "sleeve_position")[0]), None)
    drifts = []
    for mould, feet in moulds.items():
        sleeves = columns[first[mould]].sleeves if len(feet) >= FEWEST_COLUMNS else None
        drift = None if sleeves is None else _assess(sleeves, feet, rule)
        drifts += [] if drift is None else [drift]
    return tuple(drifts)


def foot_of(column: ColumnReport) -> _Foot | None:
    """What moulds are judged by of a column; None where it is open which of its sleeves is which."""
    foot = column.sleeves
    if foot is None or foot.fit is None or foot.fit.orientation == "ambiguous":
        return None
    return _Foot.of(column, foot)


def _mould_of(column: ColumnReport, foot: GroupReport) -> Hashable:
    """What the columns of one mould share; an inline design by its hash, for each column may have its own."""
    if column.piece_mark is not None:
        return column.piece_mark, len(foot.points)
    places = np.array([point.design_mm for point in foot.points]) + 0.0  # no minus before a zero
    return hashlib.sha256(repr(column.size_mm).encode() + places.tobytes()).digest()


@dataclass(frozen=True, eq=False, slots=True)
class _Foot:
    """What is needed of the n sleeves of a foot, in little memory: offsets (n, 2) mm and u (n,) mm, NaN without any.

    ``mould`` is equal for the columns of one mould.
    """

    mould: Hashable
    id: str
    piece_mark: str | None
    sha256: str
    offsets: Array
    u_mm: Array

    @classmethod
    def of(cls, column: ColumnReport, foot: GroupReport) -> _Foot:
        points = foot.points
        offsets = np.array([point.offset_mm or (np.nan, np.nan) for point in points])
        u_mm = np.array([np.nan if point.offset_mm is None else point.u_mm or 0.0 for point in points])
        return cls(_mould_of(column, foot), column.id, column.piece_mark, foot.sha256, offsets, u_mm)


def _assess(first: GroupReport, feet: Sequence[_Foot], rule: Rule | None) -> MouldDrift | None:
    """``first`` is the group of the first foot, whose labels and places are those of all."""
    every = np.isfinite([foot.u_mm for foot in feet])
    often = np.flatnonzero(every.sum(axis=0) >= FEWEST_COLUMNS)
    if len(often) < 2:
        return None
    measured = every[:, often]
    offsets = np.nan_to_num([foot.offsets[often] for foot in feet], nan=0.0)
    design = np.array([first.points[k].design_mm[:2] for k in often])
    shared = shared_displacement(offsets, measured, design)
    u_mm = [np.mean([foot.u_mm[k] for foot in feet if np.isfinite(foot.u_mm[k])]) for k in often]
    limit_mm, axis_mm, said = _axis_limit(rule)
    sleeves = tuple(
        _sleeve(first.points[k].label, shared, index, float(u_mm[index]), axis_mm) for index, k in enumerate(often)
    )
    return MouldDrift(
        piece_mark=feet[0].piece_mark,
        columns=tuple(foot.id for foot in feet),
        p_value=shared.p_value,
        scatter_mm=shared.scatter_mm,
        limit_mm=limit_mm,
        axis_limit_mm=axis_mm,
        axis_limit_from=said,
        sleeves=sleeves,
        conclusion=_conclusion(sleeves, len(feet), shared.scatter_mm),
    )


def _axis_limit(rule: Rule | None) -> tuple[float | None, float | None, str]:
    if rule is None:
        return None, None, Reason("assembly.no_position_limit")
    if rule.kind == "per_axis":
        return rule.upper, rule.upper, Reason("assembly.limit_per_axis")
    return rule.upper, rule.upper / math.sqrt(2.0), Reason("assembly.inscribed")


def _sleeve(label: str, shared: SharedDisplacement, k: int, u_mm: float, axis_limit_mm: float | None) -> SleeveDrift:
    mean, fitted = _vector(shared.mean_mm[k]), _vector(shared.fitted_mean_mm[k])
    scatter = _vector(shared.scatter_each_mm[k])
    count, p_value = int(shared.counts[k]), float(shared.p_values[k])
    return SleeveDrift(
        label=label,
        columns=count,
        mean_mm=mean,
        interval_mm=_vector(shared.interval_mm[k]),
        scatter_mm=scatter,
        p_value=p_value,
        drifts=bool(shared.drifts[k]) and math.hypot(*mean) > _SHARED_UNCERTAINTIES * u_mm,
        scatters_more=bool(shared.scatters_more[k]),
        capability=tuple(
            _capability(axis, axis_limit_mm, fitted[index], scatter[index], count) for index, axis in enumerate("xy")
        ),
    )


def _capability(axis: str, limit_mm: float | None, mean_mm: float, scatter_mm: float, count: int) -> Capability:
    if limit_mm is None or scatter_mm <= _SMALLEST_SCATTER_MM:
        return Capability(axis, None, None, None, None)
    cp, cp_interval = cp_index(limit_mm, scatter_mm, count, CONFIDENCE)
    cpk, cpk_interval = cpk_index(limit_mm, mean_mm, scatter_mm, count, CONFIDENCE)
    return Capability(axis, cp, cp_interval, cpk, cpk_interval)


def _conclusion(sleeves: Sequence[SleeveDrift], columns: int, scatter_mm: float) -> str:
    drifting = [
        Reason("assembly.displaced", label=sleeve.label, dx_mm=sleeve.mean_mm[0], dy_mm=sleeve.mean_mm[1])
        for sleeve in sleeves
        if sleeve.drifts
    ]
    loose = [sleeve.label for sleeve in sleeves if sleeve.scatters_more]
    parts = [
        Reason("assembly.displaced_alike", columns=columns, sleeves=drifting)
        if drifting
        else Reason("assembly.none_displaced", columns=columns)
    ]
    if loose:
        parts.append(Reason("assembly.scatters", sleeves=loose))
    return Reason("assembly.mould", parts=parts, scatter_mm=scatter_mm)


def _vector(values: Sequence[float]) -> Vector2:
    return float(values[0]), float(values[1])
