"""What a report says of its job."""

from __future__ import annotations

from aadm_workbench.assembly.mould.moulds import assess_moulds
from aadm_workbench.check import CheckSettings
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.model import ColumnReport, JobReport, StackSettings

from .job.model import Job
from .program import tool_entry


def report_of(
    job: Job, model: ModelDesign | None, settings: CheckSettings, columns: tuple[ColumnReport, ...]
) -> JobReport:
    """The report of a job on columns that were checked."""
    return JobReport(
        tool=tool_entry(),
        job=job_entry(job, settings),
        capture=job.capture,
        model=None if model is None else {"source": model.source, "sha256": model.sha256},
        profile=job.profile,
        columns=columns,
        mould_drift=assess_moulds(columns, job.profile),
    )


def job_entry(job: Job, settings: CheckSettings) -> dict[str, str]:
    """What reports say about the job, and how it was run."""
    return {
        "name": job.name,
        "sha256": job.sha256,
        "units": job.units,
        "method": settings.method,
        "decision": settings.decision,
        "seed": str(settings.seed),
        **({} if job.stack == StackSettings() else {"stack": job.stack.text}),
    }
