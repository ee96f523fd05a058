"""What is said beside the figures of one group: of its files, and of how sure it is."""

from __future__ import annotations

import numpy as np

from aadm_workbench.assembly.tolerances import rules_for
from aadm_workbench.model import Extraction, Kind, Profile, Reason, Scan

LARGEST_U_TO_LIMIT = 0.409
"""1/sqrt(-2 ln 0.05): with a larger u per axis no radial deviation is within the limit at 95 % (Rice law)."""

NO_CAMERA = Reason("assembly.no_camera")
"""Note of a scan whose viewpoint nobody knows."""


def of_the_files(views: tuple[Scan, ...]) -> tuple[str, ...]:
    """What was noticed while the scans were read."""
    return tuple(
        Reason("said.of_file", file=view.source, why=note)
        for view in views
        for note in (*view.notes, *(() if view.viewpoint is not None else (NO_CAMERA,)))
    )


def typical_u_mm(extraction: Extraction) -> float | None:
    """Median standard uncertainty, mm per axis across the vertical, of the centres; None without covariances."""
    known = [point.covariance for point in extraction.points if point.covariance is not None]
    if not known or extraction.vertical is None:
        return None
    up = extraction.vertical
    return float(np.median([np.sqrt(max(np.trace(c) - up @ c @ up, 0.0) / 2.0) for c in known]))


def unsupported(u_mm: float | None, profile: Profile, kind: Kind) -> tuple[str, ...]:
    """A note where no deviation, however small, could be accepted at 95 % with this uncertainty."""
    limits = [rule.upper for rule in rules_for(profile, f"{kind.value}_position")]
    if u_mm is None or not limits or u_mm < LARGEST_U_TO_LIMIT * min(limits):
        return ()
    return (Reason("assembly.unsupported", limit_mm=min(limits), u_mm=u_mm),)
