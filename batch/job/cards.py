"""Scan cards from a job: the columns' designs are there before any scan is."""

from __future__ import annotations

from collections.abc import Sequence

from aadm_workbench.errors import DesignError
from aadm_workbench.inspection.job import Job
from aadm_workbench.inspection.tasks import chosen_columns, model_of
from aadm_workbench.report.pages.scan_card import CardDesign, ScanCard, design_cards


def job_cards(job: Job, only: Sequence[str] = ()) -> list[ScanCard]:
    """The cards of a job's columns, in its order; of some of them, where they are named.

    Raises
    ------
    JobError
        Where the job has no such column.
    DesignError
        Where the model cannot be read, or does not hold a column.
    """
    columns = chosen_columns(job, only)
    model = model_of(job)
    designs = []
    for column in columns:
        design = column.design
        if design is None:
            if model is None:
                raise DesignError(f"column {column.id} has no design")
            design = model.column(column.id)
        designs.append(CardDesign(column.id, design, column.sleeves_up_deg, column.rebars_up_deg))
    return design_cards(designs, job.camera)
