"""Depths that a camera's software copied over an edge: pixels that say what their neighbour says, to the last digit.

Software that fills shadows with the nearest surface, with the one from the left, or lets near surfaces grow over far
ones, repeats a depth. Noise makes each pixel another, as far as the steps of the depths allow: how often two neighbours
are equal by right is seen away from edges.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import BoolArray, FloatArray, Reason, Scan

_EVERY = 12  # rows, then columns: edges have thousands of pixels, and hundreds tell
_STEP_MM, _FLAT_MM = 5.0, 2.0  # as cameras' software tells edges; neighbours on one surface that is seen well
_NEAR_PIXELS, _INNER_PIXELS = 2, 4  # from an edge: what fattening of one pixel repeats, and what no fill reaches
_FEWEST = 60  # pairs; a share of fewer is known to worse than the least excess
_LEAST_EXCESS = 0.1  # three pixels out of ten are copies where edges grow by a single pixel
_SIGMAS = 6.0  # of a difference of two shares: none of ten million sound scans

COPIED = Reason("extract.copied")
"""Reason of what is not measured: how far an edge was moved nobody knows."""


def copies_depths(scan: Scan) -> bool:
    """Whether neighbours are equal far more often at depth steps, and at gaps, than within surfaces.

    False for clouds, whose neighbours nobody knows.
    """
    if not scan.organised:
        return False
    depth = scan.points[..., 2]
    return any(_is_copied(np.ascontiguousarray(part)) for part in (depth[::_EVERY], depth[:, ::_EVERY].T))


def _is_copied(depth: FloatArray) -> bool:
    """Whether neighbours in rows (n, m) are: software that copies from the left leaves columns as they were."""
    at_edges, of_edges, within, of_within = _equal_pairs(depth)
    if at_edges == 0 or min(of_edges, of_within) < _FEWEST:
        return False
    excess = at_edges / of_edges - within / of_within
    share = (at_edges + within) / (of_edges + of_within)
    u = float(np.sqrt(share * (1.0 - share) * (1.0 / of_edges + 1.0 / of_within)))
    return excess > max(_LEAST_EXCESS, _SIGMAS * u)


def _equal_pairs(depth: FloatArray) -> tuple[int, int, int, int]:
    """Equal pairs of neighbours in rows (n, m) and all pairs: near edges, then away from them."""
    apart = np.abs(depth[:, 1:] - depth[:, :-1])
    equal = apart == 0.0
    if not equal.any():
        return 0, 0, 0, 0
    edge = ~(apart <= _STEP_MM)
    flat, near = apart < _FLAT_MM, _within(edge, _NEAR_PIXELS)
    edges, inner = flat & near, flat & ~_within(edge, _INNER_PIXELS)
    return int((edges & equal).sum()), int(edges.sum()), int((inner & equal).sum()), int(inner.sum())


def _within(marked: BoolArray, reach: int) -> BoolArray:
    """What lies so many places or less from a mark (n, m) in its row."""
    wide = marked.copy()
    for shift in range(1, reach + 1):
        wide[:, shift:] |= marked[:, :-shift]
        wide[:, :-shift] |= marked[:, shift:]
    return wide
