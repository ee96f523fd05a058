"""A predicted value against the limit of a profile: guarded as all decisions are, and never without its clause."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule, decide_radial, decide_signed, standard_uncertainty
from aadm_workbench.assembly.tolerances import describe_clause, rules_for
from aadm_workbench.model import Array, Profile, Rule, Verdict
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.report.words.reasons import in_both_languages
from aadm_workbench.stack.result import Judged, Top

_OF_VERDICT = {Verdict.FAIL: "beyond", Verdict.INCONCLUSIVE: "too_close"}


@dataclass(frozen=True)
class Limits:
    """The rules that predictions are held against, and how it is decided."""

    profile: Profile
    decision: DecisionRule

    def rule(self, quantity: str) -> Rule | None:
        """The governing rule of a quantity; None where the profile has none."""
        return next(iter(rules_for(self.profile, quantity)), None)

    def signed(self, quantity: str, value: float, u: float, what: str | None = None) -> Judged:
        """A signed value against a rule with two ends, or one that holds for both sides alike; ``what`` is its name."""
        rule = self.rule(quantity)
        if rule is None:
            return Judged(value, u, None, "", Verdict.NOT_ASSESSED)
        limit = (-rule.upper if rule.lower is None else rule.lower, rule.upper)
        verdict = decide_signed(value, u, *limit, self.decision).verdict
        return Judged(
            value,
            u,
            limit,
            describe_clause(rule),
            verdict,
            _reason(verdict, f"{value:+.2f}", u, rule, what or quantity),
        )

    def top(self, offset: Array, covariance: Array, unknown: Phrase | None) -> Top:
        """The top of a column (2,) mm against the limit of its axis; ``unknown`` says why it cannot be held to it."""
        u_mm, length_mm = standard_uncertainty(covariance) or 0.0, math.hypot(*offset.tolist())
        rule = self.rule("column_axis")
        if unknown is not None:
            judged = Judged(length_mm, u_mm, None, "", Verdict.NOT_MEASURED, unknown)
        elif rule is None:
            judged = Judged(length_mm, u_mm, None, "", Verdict.NOT_ASSESSED)
        else:
            verdict = decide_radial(offset, covariance, rule.upper, self.decision).verdict
            reason = _reason(verdict, f"{length_mm:.2f}", u_mm, rule, "column_axis")
            judged = Judged(length_mm, u_mm, (0.0, rule.upper), describe_clause(rule), verdict, reason)
        return Top((float(offset[0]), float(offset[1])), u_mm, judged)


def unjudged(reason: Phrase, value: float | None = None, u: float | None = None) -> Judged:
    """A value, or none, that cannot be held against a limit because something was not measured."""
    return Judged(value, u, None, "", Verdict.NOT_MEASURED, reason)


def standard(covariance: Array, row: Array) -> float:
    """Standard uncertainty of row · ξ."""
    return math.sqrt(max(float(row @ np.asarray(covariance) @ row), 0.0))


def _reason(verdict: Verdict, value: str, u: float, rule: Rule, what: str) -> Phrase | None:
    name = _OF_VERDICT.get(verdict)
    if name is None:
        return None
    clause, named = describe_clause(rule), phrase(f"stack.of_{what}")
    said = phrase(f"stack.{name}")
    parts = {"value": value, "limit": f"{rule.upper:g}", "u": f"{u:.2f}"}
    return Phrase(
        said.en.format(what=named.en, clause=clause, **parts),
        said.zh.format(what=named.zh, clause=in_both_languages(clause).zh, **parts),
    )
