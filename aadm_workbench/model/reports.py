"""What report.json holds: hoisting frames, columns, jobs."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from aadm_workbench.model.arrays import Array, Vector2, Vector3
from aadm_workbench.model.drift import MouldDrift
from aadm_workbench.model.repairs import RepairReport
from aadm_workbench.model.results import GroupReport, RuleResult, TrialReport
from aadm_workbench.model.rules import Profile
from aadm_workbench.model.verdicts import Verdict


@dataclass(frozen=True)
class HoistingPair:
    """A sleeve of the hanging column over its bar, mm: ``offset_mm`` is rebar minus sleeve, in the bars' frame."""

    sleeve: str
    rebar: str
    sleeve_scan_mm: Vector3 | None
    rebar_scan_mm: Vector3 | None
    offset_mm: Vector2 | None
    distance_mm: float | None
    u_mm: float | None
    seen: bool
    reason: str = ""


@dataclass(frozen=True)
class Correction:
    """Displacement of the column: turned by yaw about the column frame's origin, then moved by dx, dy."""

    dx_mm: float
    dy_mm: float
    yaw_deg: float


@dataclass(frozen=True)
class HoistingReport:
    """One frame taken while the column hangs over its bars; it has its own verdict."""

    source: str
    keys: tuple[str, ...]
    mean_mm: float | None
    max_mm: float | None
    column_tilt_deg: float | None
    verdict: Verdict
    pairs: tuple[HoistingPair, ...] = ()
    correction: Correction | None = None
    reasons: tuple[str, ...] = ()
    sha256: str = ""
    method: str = ""
    quality: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class ColumnReport:
    """Everything that report.json holds about one column; ``repair`` where its trial did not pass."""

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
        counted = (Verdict.PASS, Verdict.FAIL, Verdict.INCONCLUSIVE, Verdict.NOT_MEASURED, Verdict.ERROR)
        return {verdict.value: sum(column.verdict is verdict for column in self.columns) for verdict in counted}
