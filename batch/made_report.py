"""report.json, and what the journal remembers of it: where nothing has changed since, it is not made again."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from aadm_workbench.own_files import open_to_read

from .exit_codes import exit_code_of

if TYPE_CHECKING:
    from aadm_workbench.model import JobReport

_PIECE_BYTES = 2**20  # bounds the memory, not the time


@dataclass(frozen=True)
class MadeReport:
    """A report.json that was written.

    Parameters
    ----------
    basis
        Hash of all that it follows from; empty where it may come out differently the next time.
    sha256
        Of its bytes.
    summary
        How many columns came to each verdict.
    """

    basis: str
    sha256: str
    summary: dict[str, int]

    @property
    def exit_code(self) -> int:
        """The code of its worst verdict."""
        from aadm_workbench.model import Verdict

        return exit_code_of(Verdict(name) for name, count in self.summary.items() if count)

    def text(self) -> str:
        """What the journal remembers."""
        return json.dumps(vars(self))


def still_there(remembered: str, basis: str, path: Path) -> MadeReport | None:
    """The report that the journal remembers, if it is of this very basis and stands unchanged in its file."""
    try:
        made = MadeReport(**json.loads(remembered))
        if not basis or made.basis != basis:
            return None
        with open(open_to_read(path), "rb") as stream:  # noqa: PTH123 - of a descriptor
            found = _hash(iter(partial(stream.read, _PIECE_BYTES), b""))
        return made if found == made.sha256 and made.exit_code is not None else None
    except (ValueError, TypeError, AttributeError, OSError):
        return None


def written(report: JobReport, basis: str, path: Path) -> MadeReport:
    """Write report.json.

    Raises
    ------
    AadmError
        Where it cannot be written.
    """
    from aadm_workbench.report.json import write_report

    return MadeReport(basis, write_report(report, path), report.summary())


def _hash(pieces: Iterator[bytes]) -> str:
    found = hashlib.sha256()
    for piece in pieces:
        found.update(piece)
    return found.hexdigest()
