"""FreeCAD's import hook for job files: a job that is opened is checked in a panel; its columns come from its model."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.document.asking import JOB_PANELS
from aadm_workbench.document.column import make_column
from aadm_workbench.document.display.import_hook import import_hook
from aadm_workbench.document.display.messages import complain
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.job.toml import read_job_table

translate = FreeCAD.Qt.translate


def _show(document: Any, file: Path) -> None:
    """A job on the columns of a document."""
    describe_columns(document, read_job_table(file))
    if JOB_PANELS:
        JOB_PANELS[0](document, file)
    else:
        complain(translate("AADM", "{file}: a job is checked in the window, or by: aadm check").format(file=file))


open, insert = import_hook(_show)  # noqa: A001 - the names that FreeCAD calls


def describe_columns(document: Any, table: Mapping[str, Any]) -> None:
    """Make the columns whose design stands in the job itself, where the document has none of that id.

    Raises
    ------
    DesignError
        Where a design is none.
    """
    from aadm_workbench.design.recognise.pattern import inline_design

    known = {column.ColumnId for column in columns_in(document)}
    for entry in table["columns"]:
        if isinstance(entry.get("design"), dict) and str(entry["id"]) not in known:
            make_column(document, inline_design(str(entry["id"]), entry["design"]))


def model_of(job: Path) -> Path | None:
    """The model that a job names; None where it names none.

    Raises
    ------
    JobError
        Where the file is no job.
    """
    model = read_job_table(job).get("model")
    path = model.get("path") if isinstance(model, dict) else None
    return job.parent / path if isinstance(path, str) else None
