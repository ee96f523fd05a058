"""What a report says of its job: who made it, from what, and what only all columns together show."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version

from aadm_workbench import __version__
from aadm_workbench.assembly.findings.same_scan import with_same_scans
from aadm_workbench.inspection.tasks import JobPlan
from aadm_workbench.model import ColumnReport, JobReport, MouldDrift, Profile, StackSettings

_NUMERICAL_PACKAGES = ("numpy", "scipy", "opencv-python-headless", "ifcopenshell")


def report_of(plan: JobPlan, columns: Sequence[ColumnReport]) -> JobReport:
    """The report of a job on its columns, as they were inspected one by one."""
    job, model = plan.job, plan.model
    columns = with_same_scans(columns)
    return JobReport(
        tool=tool_entry(),
        job=job_entry(plan),
        capture=job.capture,
        model=None if model is None else {"source": model.source, "sha256": model.sha256},
        profile=job.profile,
        columns=columns,
        mould_drift=_mould_drift(columns, job.profile),
    )


def _mould_drift(columns: Sequence[ColumnReport], profile: Profile) -> tuple[MouldDrift, ...]:
    if len(columns) < 2:  # one says nothing about its mould
        return ()
    from aadm_workbench.assembly.mould.moulds import assess_moulds

    return assess_moulds(columns, profile)


def job_entry(plan: JobPlan) -> dict[str, str]:
    """What reports say about the job, and how it was run."""
    settings = plan.settings
    return {
        "name": plan.job.name,
        "sha256": plan.job.sha256,
        "units": plan.job.units,
        "method": settings.method,
        "decision": settings.decision,
        "seed": str(settings.seed),
        **({} if plan.job.stack == StackSettings() else {"stack": plan.job.stack.text}),
    }


def tool_entry() -> dict[str, str]:
    """What reports say about the program: its version and those of the packages that the numbers come from."""
    found = {"name": "aadm", "version": __version__}
    for name in _NUMERICAL_PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:  # installed under another name
            continue
    return found
