"""What report.json holds: jobs, their columns, of each its section and what would have to be done for it to go on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

from aadm_workbench.model.across import MouldDrift, SettingReport
from aadm_workbench.model.hoisting import HoistingReport
from aadm_workbench.model.made import each
from aadm_workbench.model.measured import Array, Vector2
from aadm_workbench.model.results import (
    BestPose,
    Finding,
    GroupReport,
    PairResult,
    PointResult,
    RuleResult,
    TrialReport,
)
from aadm_workbench.model.verdicts import SUMMED, Kind, Profile, Verdict


@dataclass(frozen=True)
class EdgeChip:
    """A piece that is missing at an edge: ``at_mm`` of its middle along the edge, its length and its depth."""

    at_mm: float
    length_mm: float
    depth_mm: float


@dataclass(frozen=True)
class SectionEdge:
    """One edge of the foot's face, ``side`` is ``-x``, ``+x``, ``-y`` or ``+y`` of the column frame.

    ``measured_mm`` is its distance from the column's axis as the sleeves give it, outwards, ``design_mm`` that by
    design; ``turn_deg`` how it is turned against the design, counter-clockwise from above. ``seen`` is the share of the
    edge that was seen. What was not measured is None, and ``reason`` says why.
    """

    side: str
    design_mm: float
    measured_mm: float | None = None
    u_mm: float | None = None
    turn_deg: float | None = None
    u_turn_deg: float | None = None
    seen: float | None = None
    chips: tuple[EdgeChip, ...] = ()
    reason: str = ""


@dataclass(frozen=True)
class SectionCorner:
    """Where two edges would meet, column frame as the sleeves give it, mm; ``cov_mm2`` (2, 2) is its covariance."""

    name: str
    design_mm: Vector2
    measured_mm: Vector2
    cov_mm2: tuple[Vector2, Vector2]


@dataclass(frozen=True)
class SectionLength:
    """A length of the section against its design, mm: ``x`` and ``y`` its sides, ``flatness`` the range of the face."""

    name: str
    design_mm: float
    measured_mm: float | None = None
    deviation_mm: float | None = None
    u_mm: float | None = None
    limit_mm: tuple[float | None, float] | None = None
    verdict: Verdict = Verdict.NOT_ASSESSED
    probability: float | None = None
    reason: str = ""


@dataclass(frozen=True)
class PatternPlace:
    """Where the pattern of the sleeves sits in the section against the design: ``offset_mm`` and ``turn_deg`` of it.

    ``u_mm`` is the standard uncertainty of the offset per axis.
    """

    verdict: Verdict
    offset_mm: Vector2 | None = None
    u_mm: Vector2 | None = None
    turn_deg: float | None = None
    u_turn_deg: float | None = None
    limit_mm: float | None = None
    probability: float | None = None
    reason: str = ""


@dataclass(frozen=True)
class FaceMap:
    """Median heights, mm, of the face over its plane in square cells, rows from −y, columns from −x; None: not seen."""

    cell_mm: float
    origin_mm: Vector2
    heights_mm: tuple[tuple[float | None, ...], ...]


@dataclass(frozen=True)
class SectionReport:
    """The section of one foot. ``squareness_deg`` is by how much the angle at its corners differs from a right one."""

    verdict: Verdict
    edges: tuple[SectionEdge, ...]
    corners: tuple[SectionCorner, ...]
    lengths: tuple[SectionLength, ...]
    pattern: PatternPlace
    squareness_deg: float | None = None
    u_squareness_deg: float | None = None
    face: FaceMap | None = None
    rules: tuple[RuleResult, ...] = ()


class RepairAction(StrEnum):
    """What is advised, the gravest last."""

    RESCAN = "rescan"
    """At the measured values the column goes in; only their uncertainty stands against it."""
    REPOSITION = "reposition"
    """The column goes in without any bending, at another pose than that of the least distance: of older reports."""
    BEND = "bend"
    """Bend a bar within the profile's adjustment limit."""
    REJECT_SLEEVE = "reject_sleeve"
    """The sleeve stands off, not the bar: its position is to be rejected."""
    DISPOSAL_PLAN = "disposal_plan"
    """Nothing that may be advised: a disposal plan agreed with the designer is needed."""


@dataclass(frozen=True, slots=True)
class RepairStep:
    """One pair that stands in the way, and what would free it.

    Parameters
    ----------
    bend_mm
        (dx, dy) in the column frame of the bars, by which the bar moves: minus its offset from the sleeve at the
        repaired pose, shortened where the bar's own place asks for it. None where no bend helps.
    bend_length_mm, least_bend_mm
        Length of that bend, and the shortest one that lets this bar in at the repaired pose.
    upright
        Whether the bar must also be set upright, because its lean alone takes more room than the sleeve has.
    position_before_mm, position_after_mm, position_limit_mm
        Deviation of the bar from its design place, after the fit of all bars, and its limit; None where unknown.
    sleeve_off_mm
        Distance of the sleeve from the place that the other sleeves give it.
    blamed, off_mm
        Which of the two stands in the way, and how far it is off the place that the others of its kind give it.
    """

    action: RepairAction
    sleeve: str
    rebar: str
    bend_mm: Vector2 | None
    bend_length_mm: float | None
    least_bend_mm: float | None
    upright: bool
    position_before_mm: float
    position_after_mm: float | None
    position_limit_mm: float | None
    sleeve_off_mm: float
    reason: str
    blamed: str = ""
    off_mm: float = 0.0


@dataclass(frozen=True, eq=False, slots=True)
class RepairReport:
    """The smallest set of bars to bend so that the column goes in.

    Parameters
    ----------
    advice
        All of it in one line.
    steps
        One for each pair that stands in the way; empty where no bar has to be bent.
    exact
        Whether no smaller set of bars of this kind (those beyond their own limit, those of such sleeves, all) would
        do; else it is the best that was found.
    after
        The trial at its best pose once all steps are done; None where nothing was found.
    margin
        What that pose leaves of distances and rooms.
    probability
        That a pose exists then, at the present uncertainty; None where a pair was not measured.
    still_fails
        Labels of the bars that a check would then still find beyond their own limit of position.
    adjustment_limit_mm, clause
        How far the profile lets this advice bend a bar, and where that is written; None where it does not say.
    working_figure
        Whether no clause says so.
    """

    action: RepairAction
    advice: str
    steps: tuple[RepairStep, ...] = ()
    exact: bool = True
    after: BestPose | None = None
    margin: float | None = None
    probability: float | None = None
    adjustment_limit_mm: float | None = None
    clause: str = ""
    subject_to: str = "the engineer's release"
    notes: tuple[str, ...] = ()
    still_fails: tuple[str, ...] = ()
    working_figure: bool = False


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
        return each(self.columns, verdict_of)

    def summary(self) -> dict[str, int]:
        """How many columns came to each verdict: pass, fail, inconclusive, not_measured, error."""
        found = Counter(self.verdicts())
        return {verdict.value: found[verdict] for verdict in SUMMED}


def verdict_of(column: ColumnReport) -> Verdict:
    """The verdict of a column."""
    return column.verdict
