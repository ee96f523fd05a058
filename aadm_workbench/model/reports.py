"""What report.json holds: columns, jobs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from aadm_workbench.model.drift import MouldDrift
from aadm_workbench.model.findings import Finding
from aadm_workbench.model.hoisting import HoistingReport
from aadm_workbench.model.made import each
from aadm_workbench.model.measured import Array, Vector2
from aadm_workbench.model.repairs import RepairReport
from aadm_workbench.model.results import GroupReport, PairResult, PointResult, RuleResult, TrialReport
from aadm_workbench.model.rules import Profile
from aadm_workbench.model.section import SectionReport
from aadm_workbench.model.stack import SettingReport
from aadm_workbench.model.verdicts import SUMMED, Kind, Verdict

LONGEST_ID = 1024
"""Characters of the id of a column: four times what IFC allows a label to have (IfcLabel)."""


@dataclass(frozen=True, eq=False, slots=True)
class ColumnReport:
    """Everything that report.json holds about one column; ``repair`` where its trial did not pass.

    ``findings`` are what contradicts the design, what was declared, or the camera. ``section`` is that of the foot;
    None where the design does not say where its section lies, or nothing says which edge is which. ``setting`` is where
    the column comes to stand, where the job asks for that ([stack]). ``hoisting_joint`` is what two and more frames of
    the hanging column tell together.
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
    setting: SettingReport | None = None
    hoisting_joint: HoistingReport | None = None

    def group(self, kind: Kind) -> GroupReport | None:
        """Its sleeves or its rebars."""
        return self.sleeves if kind is Kind.SLEEVE else self.rebars

    @property
    def groups(self) -> dict[Kind, GroupReport]:
        """Sleeves and rebars, those of them that there are."""
        return {kind: group for kind in Kind if (group := self.group(kind)) is not None}

    def points(self, kind: Kind) -> tuple[PointResult, ...]:
        """Its sleeves or its rebars, one by one; empty without them."""
        group = self.group(kind)
        return () if group is None else group.points

    @property
    def hoisting_frames(self) -> tuple[HoistingReport, ...]:
        """Its frames, and last what they tell together where they do."""
        return self.hoisting if self.hoisting_joint is None else (*self.hoisting, self.hoisting_joint)

    @property
    def parts(self) -> tuple[ColumnReport | GroupReport | TrialReport, ...]:
        """The column, its groups and its trial: what has rules and notes of its own."""
        found = (self.sleeves, self.rebars, self.trial_assembly)
        return (self, *(part for part in found if part is not None))

    @property
    def pairs(self) -> tuple[PairResult, ...]:
        """The pairs of the trial at the pose that is shown; empty without one."""
        pose = None if self.trial_assembly is None else self.trial_assembly.shown
        return () if pose is None else pose.pairs


@dataclass(frozen=True, slots=True)
class GridAxis:
    """A straight axis of the model's grid seen from above: its ends, mm, model frame.

    ``family`` is that of IFC (u, v, w): axes of one family do not cross.
    """

    tag: str
    family: Literal["u", "v", "w"]
    start_mm: Vector2
    end_mm: Vector2


@dataclass(frozen=True, eq=False, slots=True)
class JobReport:
    """Everything that report.json holds: one job, its inputs by hash, its columns, the axes of its model's grid."""

    tool: dict[str, str]
    job: dict[str, str]
    capture: dict[str, str]
    model: dict[str, str] | None
    profile: Profile
    columns: Sequence[ColumnReport]
    mould_drift: tuple[MouldDrift, ...] = ()
    grid: tuple[GridAxis, ...] = ()

    def verdicts(self) -> list[Verdict]:
        """The verdict of each column."""
        return each(self.columns, _verdict)

    def summary(self) -> dict[str, int]:
        """How many columns came to each verdict: pass, fail, inconclusive, not_measured, error."""
        found = Counter(self.verdicts())
        return {verdict.value: found[verdict] for verdict in SUMMED}


def _verdict(column: ColumnReport) -> Verdict:
    return column.verdict
