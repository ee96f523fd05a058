"""What report.json holds: columns, jobs."""

from __future__ import annotations

from dataclasses import dataclass

from aadm_workbench.model.arrays import Array
from aadm_workbench.model.drift import MouldDrift
from aadm_workbench.model.findings import Finding
from aadm_workbench.model.hoisting import HoistingReport
from aadm_workbench.model.repairs import RepairReport
from aadm_workbench.model.results import GroupReport, RuleResult, TrialReport
from aadm_workbench.model.rules import Profile
from aadm_workbench.model.section import SectionReport
from aadm_workbench.model.verdicts import SUMMED, Verdict


@dataclass(frozen=True, eq=False)
class ColumnReport:
    """Everything that report.json holds about one column; ``repair`` where its trial did not pass.

    ``findings`` are what contradicts the design, what was declared, or the camera. ``section`` is that of the foot;
    None where the design does not say where its section lies, or nothing says which edge is which.
    """

    id: str
    verdict: Verdict
    goes_on: Verdict
    reasons: tuple[str, ...] = ()
    sleeves: GroupReport | None = None
    rebars: GroupReport | None = None
    trial_assembly: TrialReport | None = None
    hoisting: tuple[HoistingReport, ...] = ()
    global_id: str | None = None
    piece_mark: str | None = None
    storey: str | None = None
    grid: str | None = None
    size_mm: tuple[float, float] | None = None
    T_model_column: Array | None = None
    rules: tuple[RuleResult, ...] = ()
    notes: tuple[str, ...] = ()
    repair: RepairReport | None = None
    findings: tuple[Finding, ...] = ()
    section: SectionReport | None = None


@dataclass(frozen=True, eq=False)
class JobReport:
    """Everything that report.json holds: one job, its inputs by hash, its columns."""

    tool: dict[str, str]
    job: dict[str, str]
    capture: dict[str, str]
    model: dict[str, str] | None
    profile: Profile
    columns: tuple[ColumnReport, ...]
    mould_drift: tuple[MouldDrift, ...] = ()

    def summary(self) -> dict[str, int]:
        """How many columns came to each verdict: pass, fail, inconclusive, not_measured, error."""
        return {verdict.value: sum(column.verdict is verdict for column in self.columns) for verdict in SUMMED}
