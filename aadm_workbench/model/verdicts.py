"""Verdicts, the limits that they go by, and the two kinds of point they are about."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal, TypeAlias


class Verdict(StrEnum):
    """What a comparison with a limit came to; ``NOT_ASSESSED`` is listed and never counted."""

    PASS = "pass"
    INCONCLUSIVE = "inconclusive"
    NOT_MEASURED = "not_measured"
    FAIL = "fail"
    ERROR = "error"
    NOT_ASSESSED = "not_assessed"


WORST_FIRST = (Verdict.ERROR, Verdict.FAIL, Verdict.NOT_MEASURED, Verdict.INCONCLUSIVE, Verdict.PASS)
"""The verdicts that count, by severity: what a sum of verdicts, a table and a label go by."""

SUMMED = (Verdict.PASS, Verdict.FAIL, Verdict.INCONCLUSIVE, Verdict.NOT_MEASURED, Verdict.ERROR)
"""The same in the order of the summary in report.json."""


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the worst of some verdicts: error, fail, not_measured, inconclusive, pass.

    ``NOT_ASSESSED`` does not count; where nothing counts, the sum is ``NOT_MEASURED``: a check
    that applied to nothing has not passed.
    """
    present = set(verdicts)
    return next((verdict for verdict in WORST_FIRST if verdict in present), Verdict.NOT_MEASURED)


class Kind(StrEnum):
    """The two kinds of assembly point."""

    SLEEVE = "sleeve"
    REBAR = "rebar"

    @property
    def plural(self) -> str:
        """``sleeves`` or ``rebars``."""
        return f"{self.value}s"

    @property
    def letter(self) -> str:
        """What labels of this kind begin with."""
        return "S" if self is Kind.SLEEVE else "R"


Source: TypeAlias = Literal["verified", "unverified"]


@dataclass(frozen=True, slots=True)
class Rule:
    """One tolerance: what it limits, how far, and where that is written.

    ``advisory`` rules are reported and not counted. ``source`` is
    ``verified`` or ``unverified``. ``kind`` says how the deviation is taken (``radial``, ``per_axis`` or
    ``signed``), ``level`` what it is taken against (``bar_in_group``, ``group_to_datum`` or ``component``).
    ``working_figure``: nobody but this program, or who wrote the profile, says so; there is no clause.
    """

    name: str
    limits: str
    upper_mm: float
    lower_mm: float | None
    clause: str
    severity: str
    source: Source
    advisory: bool = False
    edition: str = ""
    note: str = ""
    kind: str = "radial"
    level: str = "bar_in_group"
    working_figure: bool = False

    @property
    def upper(self) -> float:
        """``upper_mm``, as sentences and comparisons name it."""
        return self.upper_mm

    @property
    def lower(self) -> float | None:
        """``lower_mm``, likewise."""
        return self.lower_mm


@dataclass(frozen=True, slots=True)
class Profile:
    """A named set of rules."""

    name: str
    title: str
    rules: tuple[Rule, ...]
    adjustment_limit_mm: float | None = None

    def rule(self, name: str) -> Rule | None:
        """The rule of that name, or None where the profile has none."""
        return next((rule for rule in self.rules if rule.name == name), None)


@dataclass(frozen=True, slots=True)
class Deviation:
    """A value against its limit: mm, with its standard uncertainty (per axis, k = 1) and clause."""

    value_mm: float
    u_mm: float | None
    lower_mm: float | None
    upper_mm: float
    clause: str
    verdict: Verdict
