"""What only several columns together tell: how a mould drifts, which goes on which bars, how a floor stands."""

from __future__ import annotations

from dataclasses import dataclass, fields

from aadm_workbench.model.measured import Vector2, Vector3
from aadm_workbench.model.verdicts import Verdict


@dataclass(frozen=True, slots=True)
class Capability:
    """Process capability along one axis, with 95 % intervals; None where the scatter is zero."""

    axis: str
    cp: float | None
    cp_interval: Vector2 | None
    cpk: float | None
    cpk_interval: Vector2 | None


@dataclass(frozen=True, slots=True)
class SleeveDrift:
    """One sleeve over all columns of a mould, mm, column frame, measured minus design.

    Parameters
    ----------
    columns
        In how many columns it was measured.
    mean_mm, interval_mm
        Mean displacement (dx, dy) against the sleeves that do not drift, and half the width of its 95 % confidence
        interval.
    scatter_mm
        Standard deviation (dx, dy) over the columns, after each column's own fit.
    p_value
        Of the F test of a mean displacement of zero, after Holm's correction for the number of sleeves.
    drifts
        Whether the displacement is significant at 5 % over all sleeves, and beyond what the scans may share.
    scatters_more
        Whether its scatter is significantly larger than that of the other sleeves; then it is judged by its own.
    capability
        Along x and y, of the position after each column's own fit.
    """

    label: str
    columns: int
    mean_mm: Vector2
    interval_mm: Vector2
    scatter_mm: Vector2
    p_value: float | None
    drifts: bool
    scatters_more: bool
    capability: tuple[Capability, ...] = ()


@dataclass(frozen=True, slots=True)
class MouldDrift:
    """The sleeves of all columns of one piece mark.

    Parameters
    ----------
    piece_mark
        None for columns that share an inline design without one.
    columns
        Ids of the columns that were used.
    p_value
        Of the F test that no sleeve is displaced at all, against the scatter of the columns.
    scatter_mm
        Pooled standard deviation per axis about the means.
    limit_mm, axis_limit_mm, axis_limit_from
        Limit of position; what capability is taken against on each axis, and how it follows from that limit.
    """

    piece_mark: str | None
    columns: tuple[str, ...]
    p_value: float | None
    scatter_mm: float
    limit_mm: float | None
    axis_limit_mm: float | None
    axis_limit_from: str
    sleeves: tuple[SleeveDrift, ...] = ()
    conclusion: str = ""

    @property
    def name(self) -> str:
        """The piece mark, or the first column."""
        return self.piece_mark or next(iter(self.columns), "")

    @property
    def drifting(self) -> tuple[SleeveDrift, ...]:
        """The sleeves that the mould holds in a wrong place."""
        return tuple(sleeve for sleeve in self.sleeves if sleeve.drifts)


@dataclass(frozen=True, slots=True)
class FitCell:
    """A column tried on a group of bars, in its best turn.

    ``margin`` is 1 minus the largest ratio of distance to limit; where a bar would touch its sleeve it is the
    (negative) room that is missing, in parts of that room. Below zero the column does not go on. None: not all pairs
    were measured, or no limit is known; ``reason`` says which.
    """

    margin: float | None
    max_mm: float | None = None
    turn_deg: float = 0.0
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Assignment:
    """A column and the bars it is to go on; ``position`` is the job's column whose bars these are."""

    column: str
    position: str
    turn_deg: float
    margin: float
    max_mm: float | None
    verdict: Verdict
    probability: float | None = None
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ShipmentGroup:
    """Columns that are interchangeable, and the groups of bars that they may go on.

    Parameters
    ----------
    piece_mark
        None for columns that share an inline design without one.
    columns, positions
        Ids; rows and columns of ``cells``.
    assignments
        The best ones, in the order of ``columns``.
    smallest_margin, sum_of_margins
        Of these assignments.
    as_listed_margin
        The smallest margin where every column goes on the bars that the job lists with it; None where it lists none.
    spare_columns, open_positions
        Ids without a partner.
    """

    piece_mark: str | None
    columns: tuple[str, ...]
    positions: tuple[str, ...]
    cells: tuple[tuple[FitCell, ...], ...]
    assignments: tuple[Assignment, ...]
    smallest_margin: float | None = None
    sum_of_margins: float | None = None
    as_listed_margin: float | None = None
    spare_columns: tuple[str, ...] = ()
    open_positions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ShipmentProblem:
    """A column or a group of bars that could not be matched, and why."""

    id: str
    what: str
    verdict: Verdict
    reasons: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ShipmentReport:
    """Everything that match.json holds."""

    tool: dict[str, str]
    job: dict[str, str]
    profile: str
    turns: bool
    groups: tuple[ShipmentGroup, ...]
    problems: tuple[ShipmentProblem, ...] = ()

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """Of all assignments, of what could not be matched, and of columns left beside bars that are free."""
        assigned = (assignment.verdict for group in self.groups for assignment in group.assignments)
        apart = (Verdict.NOT_MEASURED for group in self.groups if group.spare_columns and group.open_positions)
        return (*assigned, *(problem.verdict for problem in self.problems), *apart)


_TALL_MM, _PLUMB_MM, _PLUMB_OF_TALL_MM = 6000.0, 5.0, 10.0
"""Verticality of columns and walls up to 6 m and above, GB/T 51231-2016, table 10.4.12 (unverified: recalled)."""


@dataclass(frozen=True)
class StackSettings:
    """``[stack]`` of a job: standard uncertainties, mm, k = 1, of what a trial does not give.

    Parameters
    ----------
    plumb_u_mm
        Of the top against the foot, per axis, once the column is plumbed; None: half of the 5 mm up to 6 m, and of the
        10 mm above, of GB/T 51231-2016, table 10.4.12 (unverified), a limit taken as k = 2.
    fit_u_mm
        Of where the column comes to stand in its play against where it was guided to, per axis; also of its concrete
        against its sleeves. A choice: a third of the 3 mm between bar and sleeve.
    bars_u_mm
        Of the bars in the head of a column, as a group, against its foot, per axis: half of the 2 mm of GB/T
        51231-2016, table 9.7.4-3 (unverified), a limit taken as k = 2.
    level_u_mm
        Of the height at which the column comes to stand, that of its top with it: half of the 5 mm that GB/T
        51231-2016, table 10.4.12 (unverified), gives the top or the bottom of an erected member, k = 2. Better known
        are shims alone; how long the column is, no scan of its foot tells.
    braced
        Whether braces plumb each column anew; else it leans as the one below it leans, and its own lean is added.
    height_mm
        Of columns of which no model says it.
    """

    plumb_u_mm: float | None = None
    fit_u_mm: float = 1.0
    bars_u_mm: float = 1.0
    level_u_mm: float = 2.5
    braced: bool = True
    height_mm: float | None = None

    def plumb_at(self, height_mm: float) -> float:
        """``plumb_u_mm`` of a column of that height, mm."""
        if self.plumb_u_mm is not None:
            return self.plumb_u_mm
        return (_PLUMB_MM if height_mm <= _TALL_MM else _PLUMB_OF_TALL_MM) / 2.0

    @property
    def text(self) -> str:
        """The lines of their table in a job, which report.json carries among what it says of the job."""
        known = {item.name: getattr(self, item.name) for item in fields(self)}
        return "\n".join(f"{key} = {str(value).lower()}" for key, value in known.items() if value is not None)


@dataclass(frozen=True, slots=True)
class SettingReport:
    """Where a set column comes to stand, and its top: mm and degrees, column frame; None where it is not predicted.

    Parameters
    ----------
    against
        What that is told against: ``control_points`` (the grid), ``storey_below`` (the grid, through the column below)
        or ``bars`` (its own bars alone, nothing is said of the grid).
    foot_mm, yaw_deg
        Displacement of the column from its design place, dx and dy, and its turn.
    top_mm, top_u_mm
        Displacement of its top, dx and dy, and the standard uncertainty per axis.
    top_limit_mm, top_verdict
        What the length of ``top_mm`` was held against, never against bars alone, and how that was decided.
    set_pose
        The pose in its play whose top is nearest to the grid, dx, dy mm and yaw degrees, as a job has it; None without.
    set_pose_top_mm
        How far the top is off then.
    """

    against: str
    foot_mm: Vector2 | None = None
    yaw_deg: float | None = None
    top_mm: Vector2 | None = None
    top_u_mm: float | None = None
    top_limit_mm: float | None = None
    top_verdict: Verdict = Verdict.NOT_MEASURED
    set_pose: Vector3 | None = None
    set_pose_top_mm: float | None = None
