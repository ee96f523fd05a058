"""What would have to be done for a column to go on its bars: advice, subject to the engineer's release."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from aadm_workbench.model.measured import Vector2
from aadm_workbench.model.results import BestPose


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
