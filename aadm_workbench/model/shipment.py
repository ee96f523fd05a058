"""Which column of a shipment on which bars."""

from __future__ import annotations

from dataclasses import dataclass

from aadm_workbench.model.verdicts import Verdict


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
