"""Which mouth of a hanging foot is which sleeve, and which thing below it is which bar."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.matching.pattern_search import PlanarPlacement, search_placements
from aadm_workbench.assembly.pose.eopa import turn, wrap
from aadm_workbench.model import Array, IntArray, Reason

# half of a quarter turn, at which the next one begins, and a degree for what is measured
_LARGEST_TURN = np.radians(46.0)
_SAME_COST_MM = 12.0  # 1 mm for each of twelve points: placements that differ by less are told apart by nothing
_CONTRADICTS_MM = 30.0  # 2.5 mm for each of twelve points: then the declared corner is wrong; a choice, not tuned since
_SLID_MM = 10.0  # what moves a pattern by more lays its points on others: no two are nearer to each other
_FEWEST = 3  # two points lie on every pattern


@dataclass(frozen=True, eq=False)
class Laid:
    """A pattern laid on what was found, in the axes of the foot face.

    ``pose`` (3,) is x, y mm and turn, from the pattern to the axes; ``matched`` (m,) the found thing at each place, -1
    for none.
    """

    pose: Array
    matched: IntArray
    cost_mm: float


@dataclass(frozen=True, eq=False)
class Matched:
    """Sleeves and bars, laid; ``orientation`` is ``declared``, ``resolved`` or ``ambiguous``.

    ``off_declared`` is how far, in radians, things hang and stand off what ``near`` claims, where it chose: the turn of
    the column against its bars, or that of the camera about the corner named. At 45° it would be the next turn.
    ``slid``: one of them lies as well some places farther along a row.
    """

    sleeves: Laid
    rebars: Laid
    orientation: str
    off_declared: float = 0.0
    slid: bool = False


@dataclass(frozen=True)
class NoMatch:
    """Why the patterns do not lie on what was found."""

    reason: str


def corner_name(near: tuple[int, int]) -> str:
    """A corner as jobs write it: ``-x-y``."""
    return "".join(f"{'+' if sign > 0 else '-'}{axis}" for sign, axis in zip(near, "xy", strict=True))


def match_hoisting(
    mouths: Array, bars: Array, eye: Array, sleeve_places: Array, rebar_places: Array, near: tuple[int, int] | None
) -> Matched | NoMatch:
    """Lay both patterns on what was found.

    Parameters
    ----------
    mouths, bars
        (k, 2), (l, 2) mm, in the axes of the foot face, z along the column.
    eye
        (2,) mm, where the camera stands.
    sleeve_places, rebar_places
        (m, 2) mm, the design in the column frame.
    near
        Signs of x and y of the corner of the bars nearest to the camera; the column hangs within 44 degrees of its
        final turn. None where nobody said it: then a symmetric pattern leaves several answers.
    """
    if len(mouths) < _FEWEST:
        return NoMatch(Reason("hoisting.few_sleeves", count=len(mouths)))
    if len(bars) < _FEWEST:
        return NoMatch(Reason("hoisting.few_bars", count=len(bars)))
    on_bars = _worth(search_placements(bars, rebar_places))
    on_foot = _worth(search_placements(mouths, sleeve_places))
    if not on_bars:
        return NoMatch(Reason("hoisting.bars_unfit"))
    if not on_foot:
        return NoMatch(Reason("hoisting.sleeves_unfit"))
    best = on_bars[0]
    alike = [found for found in on_bars if found.cost_mm < best.cost_mm + _SAME_COST_MM and _elsewhere(found, best)]
    chosen, orientation = best, "ambiguous" if alike else "resolved"
    if near is not None:
        fitting = [found for found in on_bars if _nearest_corner(found, eye, rebar_places) == near]
        if not fitting or fitting[0].cost_mm > best.cost_mm + _CONTRADICTS_MM:
            return NoMatch(_contradiction(near, _nearest_corner(best, eye, rebar_places)))
        chosen = fitting[0]
        orientation = "declared" if alike else "resolved"
    foot = _hung(on_foot, chosen)
    if foot is None:
        return NoMatch(Reason("hoisting.turned_far"))
    off = 0.0
    if near is not None:
        # What a pattern settles by itself, no declaration decides.
        off = _from_corner(chosen, eye, rebar_places) if orientation == "declared" else 0.0
        if any(_elsewhere(found, foot) for found in on_foot if found.cost_mm < foot.cost_mm + _SAME_COST_MM):
            off = max(off, abs(wrap(chosen.yaw - foot.yaw)))
    slid = _may_have_slid(on_bars, chosen, rebar_places) or _may_have_slid(on_foot, foot, sleeve_places)
    return Matched(_laid(foot), _laid(chosen), orientation, off, slid)


def _worth(found: list[PlanarPlacement]) -> list[PlanarPlacement]:
    return [placement for placement in found if (placement.matched >= 0).sum() >= _FEWEST]


def _elsewhere(one: PlanarPlacement, other: PlanarPlacement) -> bool:
    # patterns look alike at 90 degrees and less often at 60: a third of that is scatter
    return bool(abs(wrap(one.yaw - other.yaw)) > np.radians(20.0))


def _hung(on_foot: list[PlanarPlacement], bars: PlanarPlacement) -> PlanarPlacement | None:
    """The placement of the foot that is turned least against the bars, of those that lie alike; None if all are far."""
    turned = [found for found in on_foot if abs(wrap(bars.yaw - found.yaw)) < _LARGEST_TURN]
    close = [found for found in turned if found.cost_mm < turned[0].cost_mm + _SAME_COST_MM]
    return min(close, key=lambda found: abs(wrap(bars.yaw - found.yaw)), default=None)


def _may_have_slid(every: list[PlanarPlacement], chosen: PlanarPlacement, places: Array) -> bool:
    """Whether the pattern lies as well some places along a row: a row that is not seen whole tells no point's name."""
    middle = places.mean(axis=0)
    at = turn(-chosen.yaw) @ (middle - chosen.shift)
    return any(
        np.hypot(*(turn(-found.yaw) @ (middle - found.shift) - at)) > _SLID_MM
        for found in every
        if not _elsewhere(found, chosen) and found.cost_mm < chosen.cost_mm + _SAME_COST_MM
    )


def _nearest_corner(found: PlanarPlacement, eye: Array, places: Array) -> tuple[int, int]:
    """Signs of x and y of the corner of the pattern nearest to the camera, if it is laid so."""
    at = _eye_at(found, eye, places)
    return (1 if at[0] > 0 else -1), (1 if at[1] > 0 else -1)


def _eye_at(found: PlanarPlacement, eye: Array, places: Array) -> Array:
    """Where the camera stands (2,) mm from the middle of the pattern, if it is laid so."""
    return np.asarray(turn(found.yaw) @ eye + found.shift - 0.5 * (places.min(axis=0) + places.max(axis=0)))


def _from_corner(found: PlanarPlacement, eye: Array, places: Array) -> float:
    """Angle between the camera's direction and the middle of its quadrant, 0 to 45°, in radians."""
    x, y = np.abs(_eye_at(found, eye, places))
    return abs(float(np.arctan2(y, x)) - np.pi / 4.0)


def _contradiction(near: tuple[int, int], seen: tuple[int, int]) -> str:
    said, found = corner_name(near), corner_name(seen)
    return Reason("hoisting.near_contradicted", said=said, found=found)


def _laid(found: PlanarPlacement) -> Laid:
    """Found to design, turned round: design to found."""
    back = turn(-found.yaw)
    return Laid(np.array([*(-back @ found.shift), -found.yaw]), found.matched, found.cost_mm)
