"""Tolerances: rules, profiles, and a value against its limit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from aadm_workbench.model.verdicts import Verdict

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
