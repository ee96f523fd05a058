"""One group of a column as the rules look at it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from aadm_workbench.assembly.matching.match import Match
from aadm_workbench.assembly.place import PlacedPoint, place_points
from aadm_workbench.model import AssemblyPoint, Extraction, Kind


@dataclass(frozen=True, eq=False)
class SeenGroup:
    """The sleeves or the rebars of a column, as designed, as extracted and as matched.

    ``scale_error`` is the relative standard uncertainty (k = 1) of the camera's lengths.
    """

    kind: Kind
    design: Sequence[AssemblyPoint]
    extraction: Extraction
    match: Match
    scale_error: float = 0.0

    def placed(self) -> list[tuple[AssemblyPoint, PlacedPoint]]:
        """Each design point that was measured, with its measurement, in the first placement."""
        if not self.match:
            return []
        points = place_points(self.extraction, self.match.placements[0])
        return [(target, point) for target, point in zip(self.design, points, strict=True) if point is not None]
