"""Verdicts, and the two kinds of point they are about."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum


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
