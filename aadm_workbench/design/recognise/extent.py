"""How far a pattern of sleeves or bars reaches."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.model import AssemblyPoint


def extent_mm(points: Sequence[AssemblyPoint]) -> float:
    """Longest side of the pattern in the plane, mm, over the outsides of its sleeves or bars."""
    centres = np.array([point.centre[:2] for point in points])
    return float(np.ptp(centres, axis=0).max()) + max(point.diameter_mm for point in points)
