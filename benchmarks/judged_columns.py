"""Verdicts on whole columns, their probabilities and their advice, against the truth of :mod:`benchmarks.columns`."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from aadm_workbench.assembly.repair.bends import advise_repair
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.virtual import try_assembly
from aadm_workbench.model import Array, RepairAction, Verdict
from benchmarks.columns import Built, Scene, build_columns

BINS = (0.0, 0.001, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 0.999, 1.0)
_CN = load_profile("cn")
_PROMISED = 0.95

POSITION_MM = 2.0
"""Limit of a bar's own position (T/CCES 30-2022, 4.3.3)."""

_CLEAR_MM = 0.4
"""Three times what a scan with 0.1 mm per axis leaves open."""


@dataclass(frozen=True)
class Bin:
    """Of ``cases`` with a probability in one bin: the mean that was stated, the share that is feasible in truth.

    ``sigmas`` is how far these are apart in standard deviations of that share.
    """

    cases: int
    stated: float
    true: float
    sigmas: float


@dataclass(frozen=True)
class Judged:
    """Columns of one scene: shares of infeasible ones that pass, of feasible ones that fail, of undecided ones.

    ``undecided_far_off`` is of those whose margin is more than 3 u from zero. ``stated`` and ``true`` (k,) are the
    probabilities, where there are any, and whether the pairs that were measured are feasible.
    """

    scene: str
    cases: int
    feasible: int
    passes: int
    false_passes: float
    false_fails: float
    undecided: float
    undecided_far_off: float
    bins: tuple[Bin, ...] = field(repr=False)
    stated: Array = field(repr=False)
    true: Array = field(repr=False)


def judged_columns(scene: Scene, cases: int, rng: np.random.Generator) -> Judged:
    """Trials of columns whose true margins are spread evenly over ±1.5 mm.

    With pairs missing a trial may only fail: then its probability is that of the pairs that were measured, else none.
    """
    margins, seen_margins, probabilities, verdicts = [], [], [], []
    for built in build_columns(scene, cases, rng):
        report = try_assembly(built.design, built.sleeves, built.rebars, _CN, rng)
        margins.append(built.margin_mm)
        seen_margins.append(built.seen_margin_mm)
        probabilities.append(np.nan if report.probability is None else report.probability)
        verdicts.append(report.verdict)
    feasible = np.array(margins) >= 0.0
    passes, fails = (np.array([verdict is kind for verdict in verdicts]) for kind in (Verdict.PASS, Verdict.FAIL))
    known = ~np.isnan(probabilities)
    stated, true = np.array(probabilities)[known], np.array(seen_margins)[known] >= 0.0
    undecided, far = ~passes & ~fails, np.abs(margins) > 3.0 * scene.u_pair_mm
    return Judged(
        scene=scene.name,
        cases=cases,
        feasible=int(feasible.sum()),
        passes=int(passes.sum()),
        false_passes=_share(passes & ~feasible, ~feasible),
        false_fails=_share(fails & feasible, feasible),
        undecided=float(undecided.mean()),
        undecided_far_off=_share(undecided & far, far),
        bins=calibration(stated, true),
        stated=stated,
        true=true,
    )


def calibration(probabilities: Array, feasible: Array) -> tuple[Bin, ...]:
    """Stated probabilities (k,) against what is feasible (k,), in bins."""
    bins = []
    for low, high in pairwise(BINS):
        inside = (probabilities >= low) & ((probabilities < high) | (high == BINS[-1]))
        count = int(inside.sum())
        if count:
            stated, true = float(probabilities[inside].mean()), float(feasible[inside].mean())
            # Of a share near 0 or 1 the count itself limits what can be seen.
            deviation = np.sqrt(max(stated * (1.0 - stated), 1.0 / count) / count)
            bins.append(Bin(count, stated, true, (true - stated) / float(deviation)))
    return tuple(bins)


@dataclass(frozen=True)
class Repaired:
    """Failing columns: so many were promised to go on once repaired, and this share of them does.

    ``blamed`` is the share whose advice holds the bar that is furthest off; ``good_ones_bent`` counts advice that bends
    a bar within its own limit where bending those beyond theirs alone would do.
    """

    failing: int
    blamed: float
    promised: int
    kept: float
    good_ones_bent: int


def repaired_columns(
    scene: Scene, cases: int, rng: np.random.Generator, outlier_mm: tuple[float, float] | None = (4.0, 7.0)
) -> Repaired:
    """One bar far off and all others good, or any scatter; what is advised is done to the true bars."""
    failing, blamed, kept, needless = 0, 0, [], 0
    for built in build_columns(scene, cases, rng, outlier_mm=outlier_mm):
        trial = try_assembly(built.design, built.sleeves, built.rebars, _CN, rng)
        if trial.verdict is not Verdict.FAIL:
            continue
        repair = advise_repair(built.design, built.sleeves, built.rebars, trial, _CN, rng)
        assert repair is not None
        failing += 1
        off_mm = built.truth.off_mm()
        steps = [step.rebar for step in repair.steps]
        blamed += built.design.rebars[int(np.argmax(off_mm))].label in steps
        needless += _bends_needlessly(built, off_mm, steps)
        if repair.action is RepairAction.BEND and (repair.probability or 0.0) >= _PROMISED:
            kept.append(built.margin_after_mm(repair) >= 0.0)
    return Repaired(failing, blamed / max(failing, 1), len(kept), float(np.mean(kept or [1.0])), needless)


def _bends_needlessly(built: Built, off_mm: Array, steps: list[str]) -> bool:
    """Whether a bar is bent that is surely within its limit, though the others go on without those surely beyond."""
    labels = [bar.label for bar in built.design.rebars]
    good = any(off_mm[labels.index(label)] < POSITION_MM - _CLEAR_MM for label in steps)
    stay = off_mm < POSITION_MM + _CLEAR_MM
    return good and not stay.all() and float(built.truth.only(0, stay).margins_mm()[0]) > _CLEAR_MM


def _share(some: Array, of: Array) -> float:
    return float(some.sum() / max(of.sum(), 1))
