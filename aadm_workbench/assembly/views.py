"""Several views of one foot or one group of bars, merged through the points that they share.

A foot larger than the camera's view is scanned in parts. Each view is matched to the design by itself; the points
that two views have in common lay one view on the other, so that no design position enters a measured one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.eopa import NoFit, fit_eopa
from aadm_workbench.assembly.match import Match
from aadm_workbench.model import Array, AssemblyPoint, Extraction

_SHARED_MIN = 3
_APART_MM = 1.0  # two views of one point may differ by this much; beyond it the views do not belong together


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
        than three points with the rest, or contradict it, are left out, and a note says so.
    """
    usable = [k for k, match in enumerate(matches) if match]
    if not usable:
        return extractions[0], ()
    merged, labels = extractions[usable[0]], _labels(matches[usable[0]], extractions[usable[0]])
    notes = [f"view {k + 1} was left out: {matches[k].reason}" for k in range(len(matches)) if k not in usable]
    waiting = usable[1:]
    while waiting:
        shared = [len(set(labels) & set(_labels(matches[k], extractions[k]))) for k in waiting]
        k = waiting.pop(int(np.argmax(shared)))
        answer = _joined(merged, labels, extractions[k], _labels(matches[k], extractions[k]))
        if isinstance(answer, str):
            notes.append(f"view {k + 1} was left out: {answer}")
        else:
            merged, labels = answer
    return merged, tuple(notes)


def _labels(match: Match, extraction: Extraction) -> tuple[int, ...]:
    """For each measured point the index of its design point; those of no design point get numbers of their own."""
    labels = [-1 - k for k in range(len(extraction.points))]
    for design, measured in enumerate(match.placements[0].matched.tolist()):
        if measured >= 0:
            labels[measured] = design
    return tuple(labels)


def _joined(
    merged: Extraction, labels: tuple[int, ...], view: Extraction, view_labels: tuple[int, ...]
) -> tuple[Extraction, tuple[int, ...]] | str:
    """The merged points with those of one more view, or why it does not fit."""
    shared = [label for label in view_labels if label >= 0 and label in labels]
    if len(shared) < _SHARED_MIN:
        return f"it shares {len(shared)} points with the others, {_SHARED_MIN} are needed"
    here = np.array([merged.points[labels.index(label)].centre for label in shared])
    there = np.array([view.points[view_labels.index(label)].centre for label in shared])
    fit = fit_eopa(there, here)
    if isinstance(fit, NoFit):
        return fit.reason
    apart_mm = float(np.linalg.norm(fit.residuals, axis=1).max())
    if apart_mm > _APART_MM:
        return f"the points it shares with the others lie up to {apart_mm:.2f} mm apart"
    points, exposed, numbers = list(merged.points), list(_exposed(merged)), list(labels)
    for label, point, length in zip(view_labels, view.points, _exposed(view), strict=True):
        moved = _moved(point, fit.T)
        if label >= 0 and label in labels:
            place = labels.index(label)
            points[place] = _mean(points[place], moved)
            exposed[place] = exposed[place] if exposed[place] is not None else length
        elif label >= 0:
            points.append(moved)
            exposed.append(length)
            numbers.append(label)
    return replace(merged, points=tuple(points), exposed_length_mm=tuple(exposed)), tuple(numbers)


def _exposed(extraction: Extraction) -> tuple[float | None, ...]:
    return extraction.exposed_length_mm or (None,) * len(extraction.points)


def _moved(point: AssemblyPoint, T: Array) -> AssemblyPoint:
    rotation = T[:3, :3]
    covariance = None if point.covariance is None else rotation @ point.covariance @ rotation.T
    return replace(point, centre=rotation @ point.centre + T[:3, 3], axis=rotation @ point.axis, covariance=covariance)


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
