"""report.json, and what the journal remembers of it: where nothing has changed since, it is not made again.

Reports that are handed to others name no absolute path of the machine that made them.
"""

from __future__ import annotations

import hashlib
import json
import re
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import partial
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import TYPE_CHECKING, Any, TypeVar

from aadm_workbench.inspection.job import Job
from aadm_workbench.model.made import Made
from aadm_workbench.own_files import open_to_read

from .switches import exit_code_of

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


Part = TypeVar("Part")


def without_absolute_paths(report: Part, job: Job) -> Part:
    """The report with each file called as the job calls it, or, where that is an absolute path, by its last part.

    Parameters
    ----------
    report
        A :class:`~aadm_workbench.model.JobReport`, a :class:`~aadm_workbench.model.ShipmentReport` or a part of one.
    job
        Whose files and folder may be named in it.
    """
    shown = _shown_names(job)
    # The longest first, for a folder's name begins those of the files in it.
    listed = "|".join(map(re.escape, sorted(shown, key=len, reverse=True)))
    # Not within a longer path or word: the name "/T" is not meant in "GB/T".
    pattern = re.compile(rf"(?<![\w.]){listed.join(('(?:', ')'))}")
    result: Part = _mapped(report, lambda written: pattern.sub(lambda found: shown[found[0]], written))
    return result


def _shown_names(job: Job) -> dict[str, str]:
    """What absolute paths are to be replaced by: files by their last part, folders by nothing."""
    folders = (job.folder.absolute(), job.folder.resolve(), Path(tempfile.gettempdir()))
    shown = {f"{folder}/": "" for folder in folders if len(folder.parts) > 1}
    names = [name for column in job.columns for name in column.files()]
    if job.model is not None:
        names.append(job.model.path)
    for name in names:
        for kind in (PurePosixPath, PureWindowsPath):
            path = kind(name)
            if path.is_absolute():
                shown[name] = path.name or name
    return shown


def _mapped(value: Any, text: Callable[[str], str]) -> Any:
    """A value with all its texts changed; what has none is the same object."""
    # Verdicts are texts, too, and not to be changed.
    if type(value) is str:
        new = text(value)
        return value if new == value else new
    if isinstance(value, Made):
        return value.changed(lambda _, item: _mapped(item, text))
    if isinstance(value, tuple):
        items = tuple(_mapped(item, text) for item in value)
        return value if all(one is other for one, other in zip(items, value, strict=True)) else items
    if isinstance(value, dict):
        return {key: _mapped(item, text) for key, item in value.items()}
    if is_dataclass(value) and not isinstance(value, type):
        found = {item.name: getattr(value, item.name) for item in fields(value)}
        changed = {name: new for name, old in found.items() if (new := _mapped(old, text)) is not old}
        return replace(value, **changed) if changed else value
    return value
