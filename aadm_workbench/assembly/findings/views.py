"""What views say of their camera: several, what it bends; one, whether it is the camera that a profile is of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from aadm_workbench.assembly.findings.finding import SeenGroup, make_finding
from aadm_workbench.model import Finding

_OFF_PIXELS = 0.5
"""Of the edges of mouths: on four ray-cast cameras -0.4 to 0.1 with their own profile, 0.6 to 1.3 where a ring of
pixels was dropped that the profile did not know, or the reverse."""


def profile_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """A camera whose edges are not those of the profile that the job names."""
    for group in groups:
        off = group.extraction.quality.get("learned_edges_off_pixels")
        if isinstance(off, float) and abs(off) > _OFF_PIXELS:
            name = group.kind.plural
            yield make_finding("profile_differs", [name], group=name, off_pixels=off)


def bend_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """A camera whose bend goes with it from view to view, and is more than the stated uncertainty leaves open."""
    for group in groups:
        told = group.extraction.quality
        if "camera_bend_stated_u_mm" in told:
            yield make_finding(
                "camera_bends",
                [group.kind.plural],
                group=group.kind.plural,
                bend_mm=told["camera_bend_mm"],
                u_mm=told["camera_bend_u_mm"],
                stated_u_mm=told["camera_bend_stated_u_mm"],
            )
