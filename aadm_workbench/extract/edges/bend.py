"""What a camera does to a surface at its edges, read from the scan: does the surface bend there, and which way.

A camera that projects fringes mixes, in a pixel that an edge crosses, the phase of what is lit in it. The last pixels
of a surface carry the phase of their inner part: the surface bends by (distance/base line) times the part of a pixel
that is missing, up on one side of the base line and down on the other, and pixels that see only a sliver of it still
return it. A camera whose pixels sample one ray each, or that drops what is mixed, has surfaces that are flat to the
end. The two need other witnesses: where surfaces bend, the outermost points stand beyond the edge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.edges.seen_disc import SightLines
from aadm_workbench.model import Array, BoolArray, FloatArray, Reason

_MOUTHS, _TOPS = 1.0, -1.0  # the side on which the surface lies: outside of the disc, or within

# Where a bend is looked for. In distances of pixels behind the edge, unless a name says mm.
_BENT_PITCHES = (0.3, 1.5)  # pixels that an edge with a blur of half a pixel reaches
_INNER_PITCHES = (4.0, 9.0)  # farther than any sharp camera's blur
_BLUR_PITCHES = {_MOUTHS: (2.5, 3.5), _TOPS: (1.5, 2.5)}  # three pixels of blur reach there, one does not
_BEND_MAX_MM, _INNER_MAX_MM = 3.0, 1.5  # what is farther off is another surface
_VISIBLE_SIDE = 0.3  # cosine: beyond it the surface runs on into a wall, whose points are no bend
_FEWEST = 60  # points: a mean of fewer is noise

# From where on it counts.
_BENT_FROM = {_MOUTHS: 0.18, _TOPS: 0.07}  # of the pitch: chamfered mouths off centre bend by 0.13, cut bars do not
_BENT_SIGMAS = {_MOUTHS: 8.0, _TOPS: 4.0}  # chamfers of a few mouths do not cancel as noise does
_SLIVER_PITCHES, _SLIVER_SIGMAS = 0.25, 4.0  # path-traced mouths: 0.2 to 0.6 before their edge; ray-cast: none
_ROUGH_EDGES, _ROUGH_SIGMAS = 2.5, 2.0  # heights at edges that scatter so much more than within are mixed ones
_BLUR_SHARE, _BLUR_ROUGH = 0.12, 1.5  # of the bend at the edge; of the scatter within
_BLUR_SIGMAS = 2.0  # 95 %: pixels that mixed what an edge separates scatter so far in, too, and towards nowhere
_BLUR_FROM = {_MOUTHS: 0.0, _TOPS: 0.95}  # of the pitch: small tops are flat nowhere near their edges

BLURRED = Reason("extract.blurred")
"""Reason of what is not measured: what a blurred edge does to a centre nobody knows."""


@dataclass(frozen=True, eq=False)
class Bend:
    """How far a surface bends up at its edges, and towards where: ``towards`` (2,) mm.

    ``u_mm`` is its standard uncertainty, ``inner_mm`` the scatter of heights within, ``ratio`` that at edges over it;
    ``pitch_mm`` the distance of neighbouring lines of sight. ``reach_mm`` is how far it still bends where the edges of
    a camera in focus are flat again, ``reach_u_mm`` the standard uncertainty of that. ``apart_u_mm``: the uncertainty
    with that of telling it from chamfers, which few discs that are seen along one direction hardly do.
    """

    towards: Array
    u_mm: float
    inner_mm: float
    ratio: float
    pitch_mm: float
    side: float
    reach_mm: float
    apart_u_mm: float = 0.0
    reach_u_mm: float = 0.0

    @property
    def height_mm(self) -> float:
        """How far the surface bends up on the side towards which it does."""
        return float(np.hypot(*self.towards))

    @property
    def bent(self) -> bool:
        """Whether the camera mixes what an edge separates."""
        sigmas = _ROUGH_SIGMAS if self.side < 0 and self.ratio > _ROUGH_EDGES else _BENT_SIGMAS[self.side]
        return self.height_mm > max(_BENT_FROM[self.side] * self.pitch_mm, sigmas * self.u_mm)

    def bent_beside(self, behind_mm: float) -> bool:
        """Whether it does, where half of the lines of sight find the surface so far behind its nominal edge.

        Before it they do only on cameras that return slivers: with that, few mouths tell.
        """
        sliver = behind_mm < -_SLIVER_PITCHES * self.pitch_mm
        high = self.height_mm > max(_BENT_FROM[self.side] * self.pitch_mm, _SLIVER_SIGMAS * self.u_mm)
        return self.bent or (sliver and high)

    @property
    def blurred(self) -> bool:
        """Whether the bend goes on for more pixels than that of a camera in focus."""
        high = self.height_mm > _BLUR_FROM[self.side] * self.pitch_mm
        sure = self.height_mm > _BENT_SIGMAS[self.side] * self.apart_u_mm
        goes_on = self.reach_mm > _BLUR_SHARE * self.height_mm + _BLUR_SIGMAS * self.reach_u_mm
        return self.bent and high and sure and goes_on


def no_bend(pitch_mm: float, side: float) -> Bend:
    """What is taken where too little is seen to tell."""
    return Bend(np.zeros(2), 0.0, 0.0, 1.0, pitch_mm, side, 0.0)


def bend_at_edges(lines: SightLines, centre: Array, radius_mm: float, pitch_mm: float, side: float) -> Bend:
    """How the surface bends towards the edges of its discs, seen lines of sight given as for :func:`seen_discs`."""
    about_x, about_y = lines.x - centre[:, :1], lines.y - centre[:, 1:]
    distance = np.maximum(np.sqrt(about_x * about_x + about_y * about_y), 1e-6)
    behind = side * (distance - radius_mm) / pitch_mm
    flat = np.abs(lines.height) < _BEND_MAX_MM
    slope_length = np.maximum(np.hypot(*lines.slope.T), 1e-9)[:, None]
    away = side * (about_x * lines.slope[:, :1] + about_y * lines.slope[:, 1:]) / (distance * slope_length)
    off_wall = flat & (away < _VISIBLE_SIDE)
    at_edge, reached = (
        off_wall & (behind > low) & (behind < high) for low, high in (_BENT_PITCHES, _BLUR_PITCHES[side])
    )
    inner = flat & (behind > _INNER_PITCHES[0]) & (behind < _INNER_PITCHES[1]) & (np.abs(lines.height) < _INNER_MAX_MM)
    if at_edge.sum() < _FEWEST or inner.sum() < _FEWEST:
        return no_bend(pitch_mm, side)
    inner_mm = max(_rms(lines.height[inner]), 1e-3)
    # A chamfer bends the surface, too, and the discs are off along each one's own line of sight: that turns from disc
    # to disc, what the camera does has one direction.
    terms = [np.ones(distance.shape), away * slope_length, away, about_x / distance, about_y / distance]
    (towards, dilution), edge_mm = _common_bend(lines.height, terms, at_edge), _rms(lines.height[at_edge])
    reach_mm = reach_u_mm = 0.0
    if reached.sum() >= _FEWEST and (reached_mm := _rms(lines.height[reached])) > _BLUR_ROUGH * inner_mm:
        reach, reach_dilution = _common_bend(lines.height, terms, reached)
        reach_mm, reach_u_mm = float(np.hypot(*reach)), reached_mm * reach_dilution
    u_mm = edge_mm / float(np.sqrt(0.5 * at_edge.sum()))
    apart_u_mm = edge_mm * dilution
    ratio = edge_mm / inner_mm
    return Bend(side * towards, u_mm, inner_mm, ratio, pitch_mm, side, reach_mm, apart_u_mm, reach_u_mm)


def _rms(heights: FloatArray) -> float:
    return float(np.sqrt(np.mean(heights.astype(np.float64) ** 2)))


def _common_bend(height: FloatArray, terms: Sequence[Array], chosen: BoolArray) -> tuple[Array, float]:
    """The part of the heights that rises towards one direction (2,), the same about all discs; mm.

    And by how much the scatter of one height is multiplied in it, where it is least known.
    """
    design = np.column_stack([term[chosen] for term in terms])
    values = np.linalg.lstsq(design, height[chosen].astype(np.float64), rcond=None)[0]
    dilution = float(np.sqrt(np.linalg.eigvalsh(np.linalg.pinv(design.T @ design)[-2:, -2:])[-1]))
    return np.asarray(values[-2:]), dilution
