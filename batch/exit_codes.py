"""What the process returns. 1 is what a crash returns, so it means nothing else."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from aadm_workbench.model import Verdict

ALL_PASS = 0  # success
BAD_USAGE = 2  # as argparse ends, too
FAILS = 10  # from ten on the numbers are this command's own: neither shells nor libraries use them
UNDECIDED = 11  # better than a fail
ERRORS = 12  # worse than a fail
INTERNAL = 70  # EX_SOFTWARE of sysexits.h
INTERRUPTED = 130  # 128 + SIGINT, as shells say it

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
