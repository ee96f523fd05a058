"""The recipe: reports and a model in, a plan of the tower out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from aadm_workbench.design.floor import Floor
from aadm_workbench.model import Profile, StackSettings
from aadm_workbench.report.words.labels import phrase
from aadm_workbench.stack.limits import Limits
from aadm_workbench.stack.measured import MeasuredColumn, MeasuredFloor
from aadm_workbench.stack.members import MembersOn
from aadm_workbench.stack.result import NotFound, StackedColumn, StackPlan
from aadm_workbench.stack.tower import Tower


def plan_stack(
    floors: Sequence[MeasuredFloor], settings: StackSettings, profile: Profile, floor: Floor | None = None
) -> StackPlan:
    """What the columns of some reports do to each other, to the beams on them and to the next storey.

    Parameters
    ----------
    floors
        One report each, in the order in which they were named: of a column that several tell of, the last one counts.
    profile
        Limits of tops and members.
    floor
        Columns and beams of the model; without it there are no members, and heights come from the settings.
    """
    columns = _each_once(floors)
    limits = Limits(profile, "simple" if all(one.decision == "simple" for one in floors) else "guarded")
    places = {} if floor is None else _places(columns, floor)
    heights = {} if floor is None else {k: floor.columns[place].height_mm for k, place in places.items()}
    stacked = Tower(settings, limits, heights).stacked(columns)
    name = ", ".join(dict.fromkeys(one.name for one in floors))
    if floor is None:
        missing = NotFound(name, phrase("stack.no_model"))
        return StackPlan(name, stacked, (), (), (missing, *_undrawn(stacked)), None)
    on = MembersOn(floor, {place: stacked[k] for k, place in places.items()}, limits)
    members = tuple(on.members())
    not_found = (*_unplaced(stacked, places), *_undrawn(stacked), *on.not_found(), *_left_out(floor, bool(members)))
    return StackPlan(name, stacked, members, tuple(on.neighbours()), not_found, floor.source)


def _each_once(floors: Sequence[MeasuredFloor]) -> list[MeasuredColumn]:
    """All columns, a repeated one as its last report has it; one name in two storeys is two columns."""
    found: dict[tuple[str, str | None, str | None], MeasuredColumn] = {}
    for floor in floors:
        for column in floor.columns:
            found[column.id, column.storey, column.global_id] = column
    return list(found.values())


def _places(columns: Sequence[MeasuredColumn], floor: Floor) -> Mapping[int, int]:
    """The columns of the reports, by their places in the list, among those of the model."""
    found = ((k, floor.place_of(column.global_id, column.id)) for k, column in enumerate(columns))
    return {k: place for k, place in found if place is not None}


def _unplaced(stacked: Sequence[StackedColumn], places: Mapping[int, int]) -> Iterator[NotFound]:
    for k, column in enumerate(stacked):
        if k not in places:
            yield NotFound(column.measured.id, phrase("stack.not_in_model"))


def _undrawn(stacked: Sequence[StackedColumn]) -> Iterator[NotFound]:
    names = [one.measured.id for one in stacked if one.measured.T_model_column is None]
    if names:
        yield NotFound(", ".join(names), phrase("stack.no_place"))


def _left_out(floor: Floor, any_member: bool) -> Iterator[NotFound]:
    if not floor.beams:
        yield NotFound(floor.source, phrase("stack.no_beams"))
    elif not any_member:
        yield NotFound(floor.source, phrase("stack.no_relations", beams=len(floor.beams)))
    for name, reason in floor.left_out:
        yield NotFound(name, phrase("stack.left_out", reason=reason))
