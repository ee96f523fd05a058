"""Results into the model: what ``aadm writeback`` and ``aadm check --write-ifc`` have in common."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from aadm_workbench.errors import JobError

if TYPE_CHECKING:
    from aadm_workbench.inspection.job import Job
    from aadm_workbench.model import JobReport
    from aadm_workbench.report.ifc.addition import Property
    from aadm_workbench.report.ifc.model import WriteBack

_REPORTS = ("report.html", "report.json")
"""What the columns of the model are linked to: the first of these that lies in the folder of the report."""


def ifc_model_of(job: Job) -> Path:
    """The model that results are to be written into.

    Raises
    ------
    JobError
        Where the job has no model, or one that is no IFC file.
    """
    if job.model is None:
        raise JobError.because("command.write_without_model", job=job.source)
    path = job.folder / job.model.path
    if path.suffix.lower() != ".ifc":
        raise JobError.because("command.write_into_other", job=job.source, model=job.model.path)
    return path


def write_results(
    report: JobReport,
    report_folder: Path,
    model: Path,
    out: Path,
    *,
    force: bool = False,
    setting: Mapping[str, Sequence[Property]] | None = None,
) -> WriteBack:
    """Write a report into a model and link the columns to the report's file; arguments and errors as ``write_ifc``.

    ``setting`` None: that of the report's own job, where it has [stack].
    """
    from aadm_workbench.report.ifc.model import write_ifc

    from .tower_plan import Tower

    setting = Tower(report, model).properties() if setting is None else setting
    return write_ifc(report, model, out, report_location=_link(report_folder, out), force=force, setting=setting)


def written_lines(done: WriteBack) -> Iterator[str]:
    """What was done, for people."""
    if done.columns:
        yield (
            f"{_counted(len(done.columns), 'column')}: {_counted(done.property_sets, 'property set')} and "
            f"{_counted(done.annotations, 'as-built mark')} in the model ({done.schema})"
        )
    if done.missing:
        yield f"Not in the model: {', '.join(done.missing)}"
    yield from done.notes
    if done.backup is not None:
        yield f"The model as it was: {done.backup}"
    yield f"Model: {done.out}" if done.changed else f"Model: {done.out} (was so already)"


def written_json(done: WriteBack) -> bytes:
    """What was done, for programs."""
    from aadm_workbench.report.json import encode

    return encode(asdict(done))


def _counted(number: int, name: str) -> str:
    return f"{number} {name}" if number == 1 else f"{number} {name}s"


def _link(folder: Path, out: Path) -> str:
    """The report as seen from the written model."""
    name = next((name for name in _REPORTS if (folder / name).exists()), _REPORTS[-1])
    report = (folder / name).resolve()
    try:
        return Path(os.path.relpath(report, out.resolve().parent)).as_posix()
    except ValueError:  # on another drive
        return report.as_uri()
