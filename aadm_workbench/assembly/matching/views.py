"""Several views of one foot or one group of bars, merged through the points that they share.

A foot larger than the camera's view is scanned in parts. Each view is matched to the design by itself, which of a
periodic pattern leaves several answers: six of a row of nine lie on it in four places. Which points two views share is
then told by the points themselves, for no two sleeves are built alike: see
:mod:`~aadm_workbench.assembly.matching.overlap`. The shared points lay one view on the other, in the plane across the
vertical, so that no design position enters a measured one, and a row, which leaves a turn about itself open, is laid
like any other pattern.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.matching.match import Match, Placement
from aadm_workbench.assembly.matching.overlap import Overlap, View, overlap_of
from aadm_workbench.assembly.matching.pattern_search import DISTINCT_LOG_RATIO
from aadm_workbench.assembly.pairs import moved_point
from aadm_workbench.model import AssemblyPoint, Extraction, Reason

_SHARED_MIN = 3  # a pose has three unknowns, and two points leave nothing to check it by
_APART_MM = 1.0  # two views of one point may differ by this much; beyond it the views do not belong together
_APART_SIGMAS = 4.0  # or by this much where they are known worse

Labels = tuple[int, ...]
"""For each measured point the index of its design point; those of no design point have numbers below zero."""


@dataclass(frozen=True, eq=False)
class _Labelling:
    """One way to label the points of some views, the logarithm of its likelihood, and how they scatter, mm per axis."""

    labels: Labels
    log_likelihood: float
    scatter_mm: float


@dataclass(frozen=True, eq=False)
class _Join:
    """A view laid on the others in one way: which points they share, and the labellings that say so."""

    overlap: Overlap
    ways: tuple[tuple[_Labelling, _Labelling], ...]
    log_likelihood: float


@dataclass(frozen=True, eq=False)
class _Merged:
    """What was merged so far, in the frame of the first view, and how it may be labelled."""

    extraction: Extraction
    labellings: tuple[_Labelling, ...]


def merge_views(extractions: Sequence[Extraction], matches: Sequence[Match]) -> tuple[Extraction, tuple[str, ...]]:
    """One extraction in the frame of the first view that could be matched, and notes on the others.

    Parameters
    ----------
    extractions, matches
        One of each per view, in the order of the job.

    Returns
    -------
    Extraction
        A point seen in several views is the mean of them, weighted by their covariances. Views that share fewer
        than three points with the rest, that contradict it, or of which it is open which points they share, are left
        out, and a note says so.
    """
    usable = [k for k, match in enumerate(matches) if match]
    if not usable:
        return extractions[0], ()
    notes = [
        Reason("assembly.view_left_out", view=k + 1, why=matches[k].reason)
        for k in range(len(matches))
        if k not in usable
    ]
    merged = _Merged(extractions[usable[0]], _labellings(matches[usable[0]], extractions[usable[0]], 0))
    waiting = {k: _labellings(matches[k], extractions[k], k) for k in usable[1:]}
    refused: dict[int, str] = {}
    while waiting:
        answers = {k: _best_join(merged, extractions[k], ways) for k, ways in waiting.items()}
        joins = {k: answer for k, answer in answers.items() if isinstance(answer, _Join)}
        refused = {k: answer for k, answer in answers.items() if isinstance(answer, str)}
        if not joins:
            break
        # The surest first: what it adds may settle the others.
        k = max(joins, key=lambda number: joins[number].overlap.shared)
        merged = _joined(merged, extractions[k], joins[k])
        del waiting[k]
    notes += [Reason("assembly.view_left_out", view=k + 1, why=refused[k]) for k in waiting]
    return merged.extraction, tuple(notes)


def _labellings(match: Match, extraction: Extraction, number: int) -> tuple[_Labelling, ...]:
    """The labellings that a match leaves open; strangers get numbers that no other view has."""
    return tuple(_labelling(placement, len(extraction.points), number) for placement in match.evaluated)


def _labelling(placement: Placement, count: int, number: int) -> _Labelling:
    labels = [-1 - k - 10_000 * number for k in range(count)]  # no view has as many strangers
    for design, measured in enumerate(placement.matched.tolist()):
        if measured >= 0:
            labels[measured] = design
    return _Labelling(tuple(labels), placement.log_likelihood, placement.scatter_mm)


def _best_join(merged: _Merged, view: Extraction, labellings: Sequence[_Labelling]) -> _Join | str:
    """The one way in which a view lies on the others, or why there is none."""
    joins = _joins(merged, view, labellings)
    best, *others = sorted(joins, key=lambda join: -join.log_likelihood)
    shared = best.overlap.shared
    rivals = [join for join in others if join.log_likelihood > best.log_likelihood - DISTINCT_LOG_RATIO]
    if rivals:
        return Reason("assembly.open_shared", ways=len(rivals) + 1)
    if shared < _SHARED_MIN:
        return Reason("assembly.few_shared", shared=shared, needed=_SHARED_MIN)
    if best.overlap.apart_mm > max(_APART_MM, _APART_SIGMAS * best.overlap.u_mm):
        return Reason("assembly.shared_apart", apart_mm=best.overlap.apart_mm)
    if others and not best.overlap.agrees:
        return Reason("assembly.shared_differ")
    return best


def _joins(merged: _Merged, view: Extraction, labellings: Sequence[_Labelling]) -> list[_Join]:
    """Every way in which a view can lie on the others, each with the labellings that lead to it."""
    ways: dict[tuple[tuple[int, int], ...], list[tuple[_Labelling, _Labelling]]] = {}
    for here in merged.labellings:
        place = {label: index for index, label in enumerate(here.labels) if label >= 0}
        for there in labellings:
            pairs = tuple((place[label], k) for k, label in enumerate(there.labels) if label in place)
            ways.setdefault(pairs, []).append((here, there))
    first, second = View.of(merged.extraction), View.of(view)
    # The less they scatter, the less their agreeing says.
    scatter_mm = min(one.scatter_mm for one in (*merged.labellings, *labellings))
    joins = []
    for pairs, alike in ways.items():
        overlap = overlap_of(first, second, pairs, scatter_mm)
        likeliest = max(here.log_likelihood + there.log_likelihood for here, there in alike)
        joins.append(_Join(overlap, tuple(alike), likeliest + overlap.evidence))
    return joins


def _joined(merged: _Merged, view: Extraction, join: _Join) -> _Merged:
    """The merged points with those of one more view that belong to some design point."""
    base = merged.extraction
    points, exposed = list(base.points), list(_exposed(base))
    shared = {k: place for place, k in join.overlap.pairs}
    added: list[int] = []
    strangers = {k for k, label in enumerate(join.ways[0][1].labels) if label < 0}
    for k, (point, length) in enumerate(zip(view.points, _exposed(view), strict=True)):
        moved = moved_point(point, join.overlap.T_first_second)
        if k in shared:
            place = shared[k]
            points[place] = _mean(points[place], moved)
            exposed[place] = exposed[place] if exposed[place] is not None else length
        elif k not in strangers:
            points.append(moved)
            exposed.append(length)
            added.append(k)
    likeliest = max(here.log_likelihood + there.log_likelihood for here, there in join.ways)
    labellings = tuple(
        _Labelling(
            (*here.labels, *(there.labels[k] for k in added)),
            here.log_likelihood + there.log_likelihood,
            min(here.scatter_mm, there.scatter_mm),
        )
        for here, there in join.ways
        if here.log_likelihood + there.log_likelihood > likeliest - DISTINCT_LOG_RATIO
    )
    return _Merged(replace(base, points=tuple(points), exposed_length_mm=tuple(exposed)), labellings)


def _exposed(extraction: Extraction) -> tuple[float | None, ...]:
    return extraction.exposed_length_mm or (None,) * len(extraction.points)


def _mean(first: AssemblyPoint, second: AssemblyPoint) -> AssemblyPoint:
    """Two measurements of one point: their weighted mean. Both views share the camera, so u does not shrink."""
    if first.covariance is None or second.covariance is None:
        return replace(first, centre=(first.centre + second.centre) / 2.0)
    weights = np.array([1.0 / np.trace(point.covariance) for point in (first, second) if point.covariance is not None])
    share = weights / weights.sum()
    better = first if weights[0] >= weights[1] else second
    centre = share[0] * first.centre + share[1] * second.centre
    diameter_mm = float(share @ [first.diameter_mm, second.diameter_mm])
    return replace(better, centre=centre, diameter_mm=diameter_mm)
