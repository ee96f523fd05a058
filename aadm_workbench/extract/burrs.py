"""What burrs on the tops of bars may hide: an outline that is pushed out on one side stands beside its core.

Shears leave a burr b·cos⁺(θ) on one side. The circle through it is larger by b/π and stands b/2 beside the core. Ribs
are much the same on all bars of a group, so that the larger circle shows; to which side the burr is, it does not.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.circle import Outlines, circles_through
from aadm_workbench.model import Array

_FEWEST = 4  # of fewer bars nobody knows which are like the others
_SIGMA_MM = 0.064  # of outlines of one group: cores of one delivery differ by 0.05 mm in radius, ribs add 0.04 mm
_ALIKE_MM = 2.5 * _SIGMA_MM  # one sound bar in a hundred is taken for a burred one
_ALIKE_SHARE = 1.0 / 3.0  # of a group: so many sound bars tell what is usual
_ROUNDS = 3  # towards the middle of all that are alike
_MOST_MM = 0.6  # a burr of 2 mm; what is larger than that is a bar of another size, or no outline
_SHIFT = float(np.pi / 2.0 / np.sqrt(2.0))  # of a circle that is larger by 1: b/2 over b/π, per axis for any direction


def burr_u_mm(rims: Outlines, centre: Array, radius_mm: float) -> Array:
    """Standard uncertainty (k,) mm, per axis, of centres whose outlines are larger than those of most of the group.

    Parameters
    ----------
    rims
        The outlines of the tops.
    centre
        (k, 2) mm, of circles of one radius through them.
    """
    if len(centre) < _FEWEST:
        return np.zeros(len(centre))
    own_mm = circles_through(rims, centre, radius_mm)[1]
    beyond_mm = own_mm - _usual(own_mm)
    larger_mm = np.minimum(beyond_mm, _MOST_MM) + _SIGMA_MM
    return np.where(beyond_mm > _ALIKE_MM, _SHIFT * larger_mm, 0.0)


def _usual(values: Array) -> float:
    """Middle of those bars that are like each other and smallest: burrs only ever add, to a half of the group, too."""
    ordered, held = np.sort(values), max(2, round(_ALIKE_SHARE * len(values)))
    width = ordered[held - 1 :] - ordered[: len(values) - held + 1]
    first = int(np.flatnonzero(width <= max(_ALIKE_MM, width.min()))[0])
    middle = float(np.median(ordered[first : first + held]))
    for _ in range(_ROUNDS):
        middle = float(np.median(ordered[np.abs(ordered - middle) <= _ALIKE_MM]))
    return middle
