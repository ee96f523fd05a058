"""What the process returns. 1 is what a crash returns, so it means nothing else."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from aadm_workbench.model import Verdict

ALL_PASS = 0
BAD_USAGE = 2
FAILS = 10
UNDECIDED = 11
ERRORS = 12
INTERNAL = 70
INTERRUPTED = 130

_OF_VERDICT = {
    "pass": ALL_PASS,
    "fail": FAILS,
    "inconclusive": UNDECIDED,
    "not_measured": UNDECIDED,
    "error": ERRORS,
}


def exit_code_of(verdicts: Iterable[Verdict]) -> int:
    """The code of the worst verdict of a job's columns."""
    from aadm_workbench.model import worst

    return _OF_VERDICT[worst(verdicts).value]
