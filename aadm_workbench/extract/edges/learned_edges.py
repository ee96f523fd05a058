"""Centres set right by what was learned of their camera: on a plate, what it does at edges and how it scales.

At an edge a camera loses pixels unless it sees the wall behind, and its light reaches it: where a surface is seen to
end goes by the lesser of both slopes. Lines of sight about an edge are moved by what was learned of it, and discs of
them are a witness besides the fit of all others. How much of each is taken was learned, too.

What is left stretches centres out from the camera's foot point on the face, and is taken off from there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from aadm_workbench.extract.edges.seen_disc import SightLines, slopes_of
from aadm_workbench.extract.pooled.fit import PooledFit
from aadm_workbench.model import Array, AssemblyPoint, BoolArray, CameraProfile, Extraction, Kind, LearnedEdges


class Discs(Protocol):
    """Centres (k, 2) mm with covariances (k, 2, 2) mm², each feature's own."""

    @property
    def centre(self) -> Array:
        """(k, 2) mm."""

    @property
    def covariance(self) -> Array:
        """(k, 2, 2) mm²."""


EDGE_LAWS = 1
"""The laws by which centres are found: one more whenever these move centres of a plate, for what a profile sets right
is what they leave. ``tests/calibration/test_laws.py`` tells when."""

LEARNED_BAND_MM = 1.5
"""About a surface: what is farther from it has not found it. Noise at three metres is less."""

OFF_RINGS = 0.5
"""Of rings that are dropped and learned: half of one. With their own profile within 0.22 on a path-traced camera, with
another's 0.88 and more."""

DISC_U_PITCHES = 0.1
"""Per axis, of discs that are set right: where a filter takes whole pixels their edges are as rough."""


@dataclass(frozen=True, eq=False)
class KnownEdges:
    """What is known of the edges of k features in a scan: what was learned, and how steep light falls, (k, 2).

    ``pitch_mm`` is the distance of neighbouring lines of sight as the profile counts it.
    """

    edges: LearnedEdges
    light: Array
    pitch_mm: float

    @property
    def most_lost_mm(self) -> float:
        """The widest that is lost behind an edge."""
        return self.pitch_mm * max(pitches for _, pitches in self.edges.lost)


def known_edges(profile: CameraProfile | None, kind: Kind, eye: Array | None, axes: Array) -> KnownEdges | None:
    """What a profile tells of features that see the camera at ``eye`` (k, 3) mm in their plane's axes (3, 3).

    None without a profile, or where it, or the scan, tells nothing of edges.
    """
    edges = None if profile is None else profile.edges.get(kind)
    if profile is None or edges is None or not edges.lost or eye is None:
        return None
    projector = axes @ np.array([*profile.projector_mm, 0.0])
    pitch_mm = float(np.median(np.abs(eye[:, 2]))) / profile.camera.fx
    return KnownEdges(edges, slopes_of(eye + projector), pitch_mm)


def without_losses(lines: SightLines, centre: Array, side: float, known: KnownEdges) -> SightLines:
    """Lines of sight about edges, each moved by what is lost where it crosses; ``side`` as for :func:`seen_discs`."""
    about_x, about_y = lines.x - centre[:, :1], lines.y - centre[:, 1:]
    distance = np.maximum(np.hypot(about_x, about_y), 1e-6)
    seen, lit = (side * (about_x * s[:, :1] + about_y * s[:, 1:]) / distance for s in (lines.slope, known.light))
    slopes, pitches = np.array(known.edges.lost).T
    nearer = side * known.pitch_mm * np.interp(np.minimum(seen, lit), slopes, pitches) / distance
    x, y = (part - (nearer * about).astype(part.dtype) for part, about in ((lines.x, about_x), (lines.y, about_y)))
    return replace(lines, x=x, y=y)


def without_view(centre: Array, like: Array, slope: Array) -> Array:
    """Centres (k, 2) mm moved along their views, by one amount per slope (k, 2), as others (k, 2) lie.

    A shift that all share is left.
    """
    apart, about = centre - like, slope - slope.mean(axis=0)
    steepness = float((about**2).sum())
    if steepness == 0.0:
        return centre
    return np.asarray(centre - float(((apart - apart.mean(axis=0)) * about).sum()) / steepness * slope)


def with_learned_discs(
    fit: PooledFit, discs: Discs, chosen: BoolArray, slope: Array, known: KnownEdges, view_mm: float
) -> PooledFit:
    """A fit whose ``chosen`` (k,) centres are drawn to those of ``discs`` of all k as far as was learned.

    Their covariances become what was learned: each one's own in the ratios that discs have, what all err by together,
    and what parts do along the view, ``view_mm`` per unit of ``slope`` (k, 2).
    """
    if not chosen.any():
        return fit
    edges = known.edges
    moved = np.where(chosen[:, None], fit.centre + edges.share * (discs.centre - fit.centre), fit.centre)
    own = np.trace(discs.covariance, axis1=1, axis2=2) / 2.0
    learned = (edges.scatter_pitches * known.pitch_mm) ** 2 * discs.covariance / float(np.median(own[chosen]))
    learned += (edges.apart_pitches * known.pitch_mm) ** 2 * np.eye(2)
    learned += view_mm**2 * slope[:, :, None] * slope[:, None, :]
    return replace(fit, centre=moved, covariance=np.where(chosen[:, None, None], learned, fit.covariance))


def with_learned_stretch(extraction: Extraction, profile: CameraProfile | None) -> Extraction:
    """The points of a scan in the camera's frame, (3,) mm, without what its camera stretches.

    Without a profile, without a vertical or without points the extraction is returned as it is.
    """
    learned = None if profile is None else profile.edges.get(extraction.kind)
    if profile is None or learned is None or extraction.vertical is None or not extraction.points:
        return extraction
    normal = np.asarray(extraction.vertical, np.float64)
    points = tuple(_set_right(one, normal, learned) for one in extraction.points)
    quality = {**extraction.quality, "learned_stretch": learned.stretch.value}
    if extraction.rings is not None and learned.rings is not None:
        quality["learned_rings_off"] = extraction.rings - learned.rings
    if profile.laws != EDGE_LAWS:
        quality["learned_by_laws"] = profile.laws
    return replace(extraction, points=points, quality=quality)


def _set_right(point: AssemblyPoint, normal: Array, learned: LearnedEdges) -> AssemblyPoint:
    along = (normal @ point.centre) * normal
    centre = along + (point.centre - along) / (1.0 + learned.stretch.value)
    return replace(point, centre=centre, diameter_mm=point.diameter_mm / (1.0 + learned.size.value))
