"""Which rule of the profile a number was held against: its clause, and whether its text was verified."""

from __future__ import annotations

from typing import NamedTuple

from aadm_workbench.model import JobReport


class Clause(NamedTuple):
    """Where a limit is written; both empty where the profile has no such rule."""

    text: str
    source: str


def clause_of(report: JobReport, quantity: str, limit_mm: float | None) -> Clause:
    """The counted rule of a quantity (``sleeve_position``) with that upper limit; else the first of the quantity."""
    if limit_mm is None:
        return Clause("", "")
    rules = [rule for rule in report.profile.rules if quantity in (rule.limits, rule.name)]
    rules.sort(key=lambda rule: (abs(rule.upper_mm - limit_mm) > 1e-6, rule.advisory))
    return Clause(rules[0].clause, rules[0].source) if rules else Clause("", "")
