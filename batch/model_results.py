"""Results into the model: what ``aadm writeback`` and ``aadm check --write-ifc`` have in common."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from aadm_workbench.errors import JobError

from .shown.told import words_for

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


def written_lines(done: WriteBack, options: argparse.Namespace) -> Iterator[str]:
    """What was done, for people."""
    words = words_for(options, "told_writeback")
    if done.columns:
        columns = words.counted("columns", len(done.columns))
        sets, marks = words.counted("sets", done.property_sets), words.counted("marks", done.annotations)
        yield words("counted", columns=columns, sets=sets, marks=marks, schema=done.schema)
    if done.missing:
        yield words("missing", names=", ".join(done.missing))
    yield from (words.said(note) for note in done.notes)
    if done.backup is not None:
        yield words("backup", path=done.backup)
    yield words("model" if done.changed else "already", path=done.out)


def written_json(done: WriteBack) -> bytes:
    """What was done, for programs."""
    from aadm_workbench.report.json import encode

    return encode(asdict(done))


def _link(folder: Path, out: Path) -> str:
    """The report as seen from the written model."""
    name = next((name for name in _REPORTS if (folder / name).exists()), _REPORTS[-1])
    report = (folder / name).resolve()
    try:
        return Path(os.path.relpath(report, out.resolve().parent)).as_posix()
    except ValueError:  # on another drive
        return report.as_uri()
