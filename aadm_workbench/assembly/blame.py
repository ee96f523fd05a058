"""What is in the way of a column that does not go on: the bars, or the sleeves, that would have to be put right.

Least squares and minimax spread one error over all pairs, so that innocent ones seem to fail. Blamed is what the advice
would put right, and what stands off the place that the others give it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.pose.eopa import robust_offsets
from aadm_workbench.model import Array, Reason, RepairReport, RepairStep, Rule, TrialReport, Verdict, in_one


def with_blame(trial: TrialReport, repair: RepairReport | None) -> TrialReport:
    """A trial that fails, with what is in its way: its first reason says so. Any other trial as it is."""
    if trial.verdict is not Verdict.FAIL or repair is None or not repair.steps:
        return trial
    sentence = in_one(Reason("assembly.in_the_way", label=step.blamed, why=_why(step)) for step in repair.steps)
    labels = tuple(step.blamed for step in repair.steps)
    return replace(trial, in_the_way=labels, reasons=(sentence, *trial.reasons))


def _why(step: RepairStep) -> str:
    if step.bend_mm is None:
        return Reason("assembly.ribs_and_lean", sleeve=step.sleeve)
    if step.upright:
        return Reason("assembly.lean_alone", sleeve=step.sleeve)
    others = "bars" if step.blamed == step.rebar else "sleeves"
    return Reason("assembly.off_own_place", off_mm=step.off_mm, others=others)


def blamed_of_group(
    labels: Sequence[str], measured: Array, design: Array, failing: set[str], rule: Rule
) -> dict[str, float]:
    """Who is really off where least squares lets others fail, and how far, mm, the worst first; empty for nobody else.

    Parameters
    ----------
    labels
        n labels of one group.
    measured, design
        (n, 2) float64, mm, column frame.
    failing
        Labels of those that fail by least squares.
    """
    off_mm = np.hypot(*robust_offsets(measured, design).T)
    blamed = [(label, off) for label, off in zip(labels, off_mm.tolist(), strict=True) if off > rule.upper]
    if {label for label, _ in blamed} >= failing:
        return {}
    return dict(sorted(blamed, key=lambda one: -one[1]))


def said_of_blamed(blamed: Mapping[str, float]) -> str:
    """One sentence on them; empty for nobody."""
    return in_one(
        Reason("assembly.stands_off", label=label, off_mm=off, others="bars" if label[0] == "R" else "sleeves")
        for label, off in blamed.items()
    )
