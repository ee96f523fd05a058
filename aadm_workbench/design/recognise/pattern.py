"""The pattern of a column's assembly points: labels, pairs, neighbours, sizes of bars, and designs without a model."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeGuard

import numpy as np

from aadm_workbench.design.recognise.rings import are_closed, distances_mm, ring_edges, rings
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, IntArray, Kind, Reason

_SAME_POINT_MM = 1.0
"""Two centres of one design closer than this are one hole written twice."""

_NEAREST_RATIO = 1.1
"""Neighbours of a point in an irregular pattern: all within this multiple of its nearest one's distance."""

_SIDE_SHARE = 0.05  # of the width of a pattern: its outermost row, which as-built places and round numbers bend

OVER_RIBS_MM = {
    12.0: 14.7,
    14.0: 17.0,
    16.0: 19.2,
    18.0: 21.3,
    20.0: 23.5,
    22.0: 26.1,
    25.0: 29.4,
    28.0: 32.6,
    32.0: 37.0,
    36.0: 41.4,
    40.0: 45.7,
}
"""Diameter over the longitudinal ribs of crescent-ribbed bars by nominal diameter: d1 + 2 h1 of GB/T 1499.2-2018,
Table 3 (recalled, not verified against the printed standard)."""

_SAME_SIZE_MM = 0.05  # sizes are whole millimetres
_LIKELY_OVER_RIBS_MM = 1.2
"""Catalogues round the diameter over the ribs in their own ways (20 mm bars: 22.7 to 23.5)."""


def label_order(xy: Array) -> IntArray:
    """Order in which the points of a pattern get their labels 1, 2, 3, ...

    The first is the point of the outer ring nearest to the corner (-x, -y); then counter-clockwise seen from
    above, ring by ring from outside. Of two points equally near to that corner the first counter-clockwise begins.

    Parameters
    ----------
    xy
        (n, 2) float64, mm, column frame (z towards the viewer).

    Returns
    -------
    (n,) int64
        Index of the point that gets label k + 1, for each k.
    """
    found = rings(xy)
    return np.concatenate(found) if found else np.zeros(0, dtype=np.int64)


def side_labels(places: Mapping[str, Sequence[float]], unit: tuple[float, float]) -> tuple[str, str] | None:
    """First and last label of the points on one side of the pattern, as they stand in the row; None below two.

    ``places`` are x, y (and more) mm in the frame of the direction ``unit``; the row is told counter-clockwise.
    """
    if not places:
        return None
    reach = {label: place[0] * unit[0] + place[1] * unit[1] for label, place in places.items()}
    most, least = max(reach.values()), min(reach.values())
    row = [label for label, value in reach.items() if value > most - _SIDE_SHARE * (most - least) - _SAME_POINT_MM]
    row.sort(key=lambda label: places[label][1] * unit[0] - places[label][0] * unit[1])
    return (row[0], row[-1]) if len(row) > 1 else None


def pair(sleeves: Array, rebars: Array, within_mm: float = math.inf) -> IntArray:
    """Which rebar belongs to which sleeve, by the smallest sum of distances in the plane.

    Parameters
    ----------
    sleeves
        (n, 2) float64, mm.
    rebars
        (m, 2) float64, mm, the same frame.
    within_mm
        No pair is further apart than this.

    Returns
    -------
    (n,) int64
        Index of each sleeve's rebar; -1 where it has none.
    """
    partner = np.full(len(sleeves), -1, dtype=np.int64)
    if not len(sleeves) or not len(rebars):
        return partner
    distance_mm = distances_mm(sleeves, rebars)
    nearest = distance_mm.argmin(axis=1)
    if len(np.unique(nearest)) == len(sleeves):  # each has its nearest to itself: no other pairing is shorter
        near = distance_mm[np.arange(len(sleeves)), nearest] <= within_mm
        return np.where(near, nearest, partner)
    from scipy.optimize import linear_sum_assignment  # slow to import, and few patterns need it

    # What is out of reach costs more than any set of pairs within it, and is dropped afterwards.
    out_of_reach = distance_mm > within_mm
    reachable_mm = float(distance_mm[~out_of_reach].sum()) if not out_of_reach.all() else 0.0
    cost = np.where(out_of_reach, reachable_mm + 1.0, distance_mm)
    rows, columns = linear_sum_assignment(cost)
    for row, column in zip(rows, columns, strict=True):
        if not out_of_reach[row, column]:
            partner[row] = column
    return partner


def adjacent(xy: Array) -> list[tuple[int, int]]:
    """Pairs of points between which spacing is measured.

    On concentric rings: neighbours on the ring, in the order of the labels, the last with the first.
    In other patterns (a row that turns a corner, a cluster): each point with its nearest neighbours.

    Parameters
    ----------
    xy
        (n, 2) float64, mm, column frame, in any order.

    Returns
    -------
    list of (int, int)
        Indices into ``xy``; each pair once.
    """
    found = rings(xy)
    if not are_closed(xy, found):
        return _nearest_pairs(xy, range(len(xy)))
    pairs = [edge for ring in found for edge in ring_edges(xy, ring)]
    alone = [int(ring[0]) for ring in found if len(ring) == 1]
    return pairs + [edge for edge in _nearest_pairs(xy, alone) if edge not in pairs]


def _nearest_pairs(xy: Array, members: Sequence[int]) -> list[tuple[int, int]]:
    if len(xy) < 2:
        return []
    distance_mm = distances_mm(xy, xy)
    np.fill_diagonal(distance_mm, np.inf)
    pairs: list[tuple[int, int]] = []
    for index in members:
        reach_mm = _NEAREST_RATIO * float(distance_mm[index].min())
        for other in np.flatnonzero(distance_mm[index] <= reach_mm):
            edge = (min(index, int(other)), max(index, int(other)))
            if edge not in pairs:
                pairs.append(edge)
    return pairs


def inline_design(id: str, table: Mapping[str, Any]) -> ColumnDesign:  # noqa: A002 - the word of the job file
    """A column's design as a job's ``[columns.design]`` gives it, without a model.

    Centres are shifted so that their centroid is the origin of the column frame. A bar stands on the axis of
    each sleeve, its top ``embedded_length`` above the foot face (0 where that is not given).

    Parameters
    ----------
    id
        The column's id in the job.
    table
        ``centres`` [[x, y], ...], ``sleeve_diameter``, ``rebar_diameter`` and, optional, ``rebar_outer_diameter``,
        ``embedded_length``, ``exposed_length``, ``size`` [x, y]; all mm. Each of the diameters is one number, or a list
        with one for each centre. Without ``rebar_diameter`` the design has no rebars.

    Raises
    ------
    DesignError
        Where a value is missing, is no length, or contradicts another.
    """
    centres = _centres(id, table.get("centres"))
    sleeve_mm = _sizes(id, table, "sleeve_diameter", len(centres))
    if sleeve_mm is None:
        raise DesignError(Reason("job.no_sleeve_diameter", column=id))
    rebar_mm = _sizes(id, table, "rebar_diameter", len(centres))
    outer_mm = _sizes(id, table, "rebar_outer_diameter", len(centres))
    embedded_mm = _length(id, table, "embedded_length")
    _check_that_bars_enter(id, sleeve_mm, rebar_mm, outer_mm)
    if rebar_mm and outer_mm and len(set(rebar_mm)) > 1 and not _is_list(table["rebar_outer_diameter"]):
        raise DesignError(Reason("job.one_outer", column=id))
    size_mm = _size(id, table.get("size"))
    order = label_order(centres).tolist()
    points = [(number, index, centres[index]) for number, index in enumerate(order, start=1)]
    why = "the job's text"
    sleeves = [_upright(Kind.SLEEVE, number, xy, 0.0, sleeve_mm[index], why) for number, index, xy in points]
    rebars = []
    if rebar_mm is not None:
        rebars = [
            _upright(Kind.REBAR, number, xy, embedded_mm or 0.0, rebar_mm[index], why) for number, index, xy in points
        ]
    unlike = outer_mm is not None and len(set(outer_mm)) > 1
    if outer_mm is not None and unlike:
        rebars = [replace(bar, outer_diameter_mm=outer_mm[index]) for bar, index in zip(rebars, order, strict=False)]
    return ColumnDesign(
        id=id,
        sleeves=tuple(sleeves),
        rebars=tuple(rebars),
        size_mm=size_mm,
        names=(id,),
        rebar_outer_diameter_mm=None if outer_mm is None or unlike else outer_mm[0],
        embedded_length_mm=embedded_mm,
        exposed_length_mm=_length(id, table, "exposed_length"),
        section_middle_mm=_section_middle(table["centres"], size_mm),
    )


def _section_middle(written: Any, size_mm: tuple[float, float] | None) -> tuple[float, float] | None:
    """Middle of the section in the column frame: the origin of the centres as written, where that lies within it."""
    xy = np.array(written, dtype=np.float64)
    if size_mm is None or (np.abs(xy) > np.array(size_mm) / 2.0).any():
        return None
    x, y = -xy.mean(axis=0)
    return float(x), float(y)


def _check_that_bars_enter(
    column: str, sleeve_mm: Sequence[float], rebar_mm: Sequence[float] | None, outer_mm: Sequence[float] | None
) -> None:
    nothing = [0.0] * len(sleeve_mm)
    for number, sizes in enumerate(zip(sleeve_mm, rebar_mm or nothing, outer_mm or nothing, strict=True), start=1):
        inner_mm, widest_mm = sizes[0], max(sizes[1:])
        if widest_mm >= inner_mm:
            raise DesignError(
                Reason("job.too_wide", column=column, number=number, widest_mm=widest_mm, inner_mm=inner_mm)
            )


def _upright(kind: Kind, number: int, xy: Array, z: float, diameter_mm: float, why: str) -> AssemblyPoint:
    return AssemblyPoint(
        label=f"{kind.letter}{number}",
        kind=kind,
        centre=np.array([xy[0], xy[1], z]),
        axis=np.array([0.0, 0.0, 1.0]),
        diameter_mm=diameter_mm,
        why=why,
    )


def _centres(column: str, written: Any) -> Array:
    if not _is_list(written) or not written:
        raise DesignError(Reason("job.no_centres", column=column))
    for number, centre in enumerate(written, start=1):
        if not _is_list(centre) or len(centre) != 2 or not all(_is_number(value) for value in centre):
            raise DesignError(Reason("job.centre", number=number, column=column, centre=repr(centre)))
    xy = np.array(written, dtype=np.float64)
    gap_mm = distances_mm(xy, xy) + np.where(np.eye(len(xy), dtype=bool), np.inf, 0.0)
    if gap_mm.min() < _SAME_POINT_MM:
        first, second = (int(index) + 1 for index in np.unravel_index(int(gap_mm.argmin()), gap_mm.shape))
        raise DesignError(Reason("job.same_centre", first=first, second=second, column=column))
    centred: Array = xy - xy.mean(axis=0)
    return centred


def _length(column: str, table: Mapping[str, Any], key: str) -> float | None:
    value = table.get(key)
    if value is None:
        return None
    if not _is_number(value) or value <= 0:
        raise DesignError(Reason("job.length", key=key, column=column, value=repr(value)))
    return float(value)


def _sizes(column: str, table: Mapping[str, Any], key: str, count: int) -> list[float] | None:
    """One length for each centre, in the order of the centres; None where the key is absent."""
    value = table.get(key)
    if not _is_list(value):
        length_mm = _length(column, table, key)
        return None if length_mm is None else [length_mm] * count
    if len(value) != count:
        raise DesignError(Reason("job.lengths", key=key, column=column, found=len(value), count=count))
    if any(item is None for item in value):
        raise DesignError(Reason("job.empty_place", key=key, column=column))
    return [_length(column, {key: item}, key) or 0.0 for item in value]


def _size(column: str, written: Any) -> tuple[float, float] | None:
    if written is None:
        return None
    if not _is_list(written) or len(written) != 2 or not all(_is_number(side) and side > 0 for side in written):
        raise DesignError(Reason("job.size", column=column, written=repr(written)))
    return float(written[0]), float(written[1])


def _is_list(value: Any) -> TypeGuard[Sequence[Any]]:
    return isinstance(value, Sequence) and not isinstance(value, str)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def over_ribs_mm(nominal_mm: float) -> float | None:
    """Diameter over the ribs of a nominal size; None for a size that the table has not."""
    return next((over for size, over in OVER_RIBS_MM.items() if abs(size - nominal_mm) < _SAME_SIZE_MM), None)


def nominal_of_over_ribs(diameter_mm: float) -> float | None:
    """Nominal size of which a diameter is the one over the ribs; None where it is a nominal size itself or far off."""
    if over_ribs_mm(diameter_mm) is not None:
        return None
    size, over = min(OVER_RIBS_MM.items(), key=lambda item: abs(item[1] - diameter_mm))
    return size if abs(over - diameter_mm) < _LIKELY_OVER_RIBS_MM else None
