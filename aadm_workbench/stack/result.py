"""What a stack plan says: of columns, of the members on them, and what was not found."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from aadm_workbench.model import Array, Verdict, worst
from aadm_workbench.report.words.labels import Phrase
from aadm_workbench.stack.measured import MeasuredColumn
from aadm_workbench.stack.set_pose import Origin
from aadm_workbench.stack.torsor import Torsor

Basis = Literal["control_points", "storey_below", "bars"]
"""What a displacement is told against: the building's grid, the same through the storey below, or the bars alone."""


@dataclass(frozen=True)
class Judged:
    """A value with its standard uncertainty, k = 1, and what it was held against; mm, or degrees of a skew.

    ``limit`` (lower, upper) and ``u`` are None where there is none; ``reason`` says why a verdict is not a pass.
    """

    value: float | None
    u: float | None
    limit: tuple[float, float] | None
    clause: str
    verdict: Verdict
    reason: Phrase | None = None


@dataclass(frozen=True, eq=False)
class Top:
    """The top of a column against design: ``offset_mm`` (dx, dy), ``u_mm`` per axis; ``judged``: its length."""

    offset_mm: tuple[float, float]
    u_mm: float
    judged: Judged


@dataclass(frozen=True, eq=False)
class Advice:
    """Where in its play to set a column: ``set_pose`` dx, dy mm and yaw degrees, from where its bars have it by design.

    ``from_trial`` is the same from the pose of the trial, which the crew knows; ``top`` what the top comes to then, and
    ``next_bars`` the bars of the next storey, as those of the column.
    """

    set_pose: tuple[float, float, float]
    from_trial: tuple[float, float, float]
    top: Top | None
    next_bars: Torsor | None = None


@dataclass(frozen=True, eq=False)
class StackedColumn:
    """One column of the tower, as it stands or is about to stand.

    Parameters
    ----------
    measured
        What its report tells.
    placed
        Its displacement from design, column frame; None where it does not go on its bars or was not measured.
    basis, below
        What it is told against, and the column below that it was reached through.
    origin
        What its pose on the bars was taken from.
    height_mm
        From foot to top.
    next_bars
        The bars of the next storey, as a group, against their design place, column frame.
    advice
        None where there is nothing to gain, or no grid to gain it against; ``reasons`` say so.
    """

    measured: MeasuredColumn
    placed: Torsor | None
    basis: Basis
    below: str | None = None
    origin: Origin | None = None
    height_mm: float | None = None
    top: Top | None = None
    next_bars: Torsor | None = None
    advice: Advice | None = None
    reasons: tuple[Phrase, ...] = ()


@dataclass(frozen=True, eq=False)
class StackedMember:
    """A beam: what its columns' displacements do to it, from where it lies by design.

    Parameters
    ----------
    ends
        Ids of the columns under its ends; None where none was found.
    why
        Of each end, how its column was found.
    points_mm
        (2, 3), the ends in the model.
    span_mm
        Change of the distance of its two supports.
    seat_mm
        Change of the bearing length at each end, the beam in its design place.
    skew_deg
        The larger of the turns of its two supports against the line between them.
    level_mm
        Height of the second support less that of the first.
    """

    id: str
    global_id: str | None
    ends: tuple[str | None, str | None]
    why: tuple[Phrase, Phrase]
    points_mm: Array
    span_mm: Judged
    seat_mm: tuple[Judged, Judged]
    skew_deg: Judged
    level_mm: Judged

    @property
    def judged(self) -> tuple[Judged, ...]:
        """All that was judged of it."""
        return (self.span_mm, *self.seat_mm, self.skew_deg, self.level_mm)

    @property
    def verdict(self) -> Verdict:
        """The worst of what has a limit."""
        counted = [judged.verdict for judged in self.judged if judged.verdict is not Verdict.NOT_ASSESSED]
        return worst(counted) if counted else Verdict.NOT_ASSESSED

    @property
    def reasons(self) -> tuple[Phrase, ...]:
        """Why it is no pass, each reason once."""
        return tuple(dict.fromkeys(judged.reason for judged in self.judged if judged.reason is not None))


@dataclass(frozen=True, eq=False)
class Neighbours:
    """Two members that meet over one column: ``flush_mm`` the height of the second less that of the first there."""

    column: str
    members: tuple[str, str]
    flush_mm: Judged


@dataclass(frozen=True)
class NotFound:
    """What the model does not hold, or does not say: what it is about, and the reason."""

    about: str
    reason: Phrase


@dataclass(frozen=True, eq=False)
class StackPlan:
    """The tower as far as it is known; ``model`` is the source of the relations, None without a model."""

    name: str
    columns: tuple[StackedColumn, ...]
    members: tuple[StackedMember, ...]
    neighbours: tuple[Neighbours, ...]
    not_found: tuple[NotFound, ...]
    model: str | None

    @property
    def clauses(self) -> tuple[str, ...]:
        """Where the limits are written, each once."""
        tops = [one.top.judged for one in self.columns if one.top is not None]
        judged = [*tops, *(one for member in self.members for one in member.judged)]
        judged += [pair.flush_mm for pair in self.neighbours]
        return tuple(dict.fromkeys(one.clause for one in judged if one.clause))

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """Of tops, members and neighbours; what could not be predicted is not measured."""
        tops = tuple(Verdict.NOT_MEASURED if one.top is None else one.top.judged.verdict for one in self.columns)
        members = tuple(judged.verdict for member in self.members for judged in member.judged)
        return (*tops, *members, *(pair.flush_mm.verdict for pair in self.neighbours))
