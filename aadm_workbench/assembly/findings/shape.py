"""What two designs have in common whose scans nobody can tell apart by their pattern."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from aadm_workbench.model import ColumnDesign, Kind

Shape: TypeAlias = tuple[tuple[int, ...], ...]

_STEP_MM = 1.0  # no two patterns that are built differ by less


def design_shape(design: ColumnDesign) -> Shape:
    """Sorted distances of the sleeves, and of the rebars, from their middle and from each other, in millimetres.

    The same for a pattern that is turned, moved or mirrored, and for no other that is built.
    """
    return tuple(_distances(np.array([point.centre[:2] for point in design.points(kind)])) for kind in Kind)


def _distances(places: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> tuple[int, ...]:
    if not len(places):
        return ()
    apart = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
    lengths = np.concatenate([apart[np.triu_indices(len(places), 1)], np.hypot(*(places - places.mean(axis=0)).T)])
    return (len(places), *np.sort(np.rint(lengths / _STEP_MM).astype(int)).tolist())
