"""Scan cards from a job: the columns' designs are there before any scan is."""

from __future__ import annotations

from collections.abc import Sequence

from aadm_workbench.errors import DesignError, JobError
from aadm_workbench.report.scan_card import CardDesign, ScanCard, design_cards

from .job import Job
from .job_table import did_you_mean


def job_cards(job: Job, only: Sequence[str] = ()) -> list[ScanCard]:
    """The cards of a job's columns, in its order; of some of them, where they are named.

    Raises
    ------
    JobError
        Where the job has no such column.
    DesignError
        Where a column's design is not found in the model.
    """
    known = [column.id for column in job.columns]
    for name in only:
        if name not in known:
            raise JobError(f'{job.source} has no column "{name}" (--only); {did_you_mean(name, known)}')
    model = None
    if job.model is not None:
        from aadm_workbench.design.read import read_model

        said = job.model
        model = read_model(job.folder / said.path, columns=said.columns, sleeves=said.sleeves, rebars=said.rebars)
    designs = []
    for column in job.columns:
        design = column.design
        if design is None:
            if model is None:
                raise DesignError(f"column {column.id} has no design")
            design = model.column(column.id)
        designs.append(CardDesign(column.id, design, column.sleeves_up_deg, column.rebars_up_deg))
    cards = design_cards(designs, job.camera)
    return [card for card in cards if not only or card.id in only]
