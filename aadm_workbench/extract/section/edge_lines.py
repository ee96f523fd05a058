"""Straight edges of a face: by where it ends in strips across them (:mod:`.strips`).

A camera that mixes what a pixel sees finds the face beyond its edge, too, as long as a sliver of it is lit: the less of
a pixel is lit, the more its heights scatter and bend. So the edge lies between where heights are no longer those of the
face and where they end: in the middle, give or take a part of that zone. A camera that drops rings of pixels at steps
shows that at the mouths, whose bores are known; whether it drops them before an empty background, too, nobody can see.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.extract.section.face_samples import FaceSamples
from aadm_workbench.extract.section.rims import KnownMouths, lost_at_rims, taken_in
from aadm_workbench.extract.section.strips import (
    OUT_OF_PICTURE,
    Chip,
    StripLine,
    Strips,
    chips_of,
    ends_of_strips,
    line_through,
)
from aadm_workbench.model import Array, Reason

_FIRST_REACH_MM = 30.0  # sections are cast to within 5 mm, and patterns stand within 10 mm of their place in them
_REACH_MM, _REACH_PITCHES = 6.0, 8.0  # to both sides of an edge that is known by and by
_CORNER_MM = 3.0  # of the neighbouring edge: nothing is asked so near to it
_MOST_ASKEW_MM = 8.0  # from end to end: sections are cast to 5 mm, and what hides a part of one runs as it likes
_MOST_OFF_MM = 8.0  # from its place by design: sections and patterns keep to 5 mm each
_SETTLED_PITCHES = 1.0  # of a step of the line: places about it are then the same
_BLIND_PITCHES = 1.0  # about an edge: places fill it where rows of pixels run across it at some angle
_LEAST_U_PITCHES = 0.1  # of one edge: what returns at its very end hangs on what it is made of
_FEWEST_PLACES = 50  # a share, or a scatter, of fewer is no measure
_ABOUT_MOUTH_MM = 2.0  # rims that are worn, or chamfered
_WIDE_MM = 5.0  # about the face: as far as edges bend that are 0.5 mm from the middle of a pixel, seen from 1.5 m
_ZONE_PITCHES, _ZONE_STEP_PITCHES = 3.0, 0.25  # before an edge, where heights may be disturbed; of the look at them
_DISTURBED = 1.4  # of the scatter within: half a pixel that is lit scatters by 1.4 (photons) to 2 times (electronics)
_INNER_PITCHES = (4.0, 12.0)  # before an edge: farther than any sharp camera's blur


@dataclass(frozen=True, eq=False)
class EdgeLine:
    """One edge in the face's axes, mm: the line x @ normal = ``offset_mm`` + ``turn`` · (x @ along − ``middle_mm``).

    ``normal`` (2,) points out of the face, ``along`` (2,) is to its left. ``covariance`` (2, 2) is of offset and turn;
    ``shared_u_mm`` is the part of the offset's that all edges of the face share with one sign, as a radius does.
    ``seen`` is the share of the edge that was seen.
    """

    normal: Array
    along: Array
    offset_mm: float
    turn: float
    middle_mm: float
    covariance: Array
    shared_u_mm: float
    seen: float
    chips: tuple[Chip, ...]


def edge_line(samples: FaceSamples, start: Array, end: Array, mouths: KnownMouths, band_mm: float) -> EdgeLine | Reason:
    """The edge near the line from ``start`` to ``end`` (2,) mm, the face to its left; or why it is not measured.

    Parameters
    ----------
    band_mm
        About the face: what returned from within counts as face.
    """
    along = (end - start) / float(np.hypot(*(end - start)))
    normal = np.array([along[1], -along[0]])
    band_mm = _WIDE_MM if _looks_past(samples, (start + end) / 2.0, normal) else band_mm
    guess = _Guess(along, normal, float((start + end) @ along) / 2.0, float((start + end) @ normal) / 2.0, 0.0)
    found = _found_edge(samples, guess, mouths, float(np.hypot(*(end - start))) / 2.0 - _CORNER_MM, band_mm)
    if isinstance(found, Reason):
        return found
    line, why = found.line, _doubt(found.line, guess, samples, float(np.hypot(*(end - start))))
    if why:
        return why
    place = along * line.middle_mm + normal * line.offset_mm
    beyond_mm = found.zone_mm / 2.0 + taken_in(samples, place, normal, band_mm) + samples.wider_mm
    covariance = found.fit.covariance.copy()
    # Anything from nothing to all of what is not seen is as likely: the variance of that is its square over 12.
    covariance[0, 0] += (samples.pitch_mm * _LEAST_U_PITCHES) ** 2 + found.blind_mm**2 / 12.0
    spans_mm = found.zone_mm, lost_at_rims(samples, mouths, normal, band_mm), 2.0 * samples.wider_mm
    return EdgeLine(
        normal,
        along,
        line.offset_mm - beyond_mm,
        line.turn,
        line.middle_mm,
        covariance,
        float(np.linalg.norm(spans_mm) / np.sqrt(12.0)),  # as likely anywhere in these
        found.strips.seen,
        chips_of(found.strips, found.fit, line.middle_mm),
    )


@dataclass(frozen=True, eq=False)
class _FoundEdge:
    line: _Guess
    strips: Strips
    fit: StripLine
    zone_mm: float
    blind_mm: float


def _found_edge(
    samples: FaceSamples, line: _Guess, mouths: KnownMouths, half_mm: float, band_mm: float
) -> _FoundEdge | Reason:
    """The line on which the face ends: looked for in wide strips, then in narrow ones about what these give."""
    fine_mm = max(_REACH_MM, _REACH_PITCHES * samples.pitch_mm)
    found: _FoundEdge | Reason = OUT_OF_PICTURE
    for reach_mm, pitches in ((_FIRST_REACH_MM, 3.0), (fine_mm, 1.0), (fine_mm, 1.0)):
        step = pitches * samples.pitch_mm
        s, d, height = _across(samples, line, mouths, half_mm, reach_mm, step)
        strips = ends_of_strips(s, d, np.abs(height) < band_mm, half_mm, reach_mm, step)
        if isinstance(strips, Reason):
            return strips
        fit = line_through(strips, step)
        if isinstance(fit, Reason):
            return fit
        line = replace(line, offset_mm=line.offset_mm + fit.offset, turn=line.turn + fit.turn)
        off = d - fit.offset - fit.turn * s
        zone_mm = _mixed_zone(off, height, band_mm, samples.pitch_mm)
        found = _FoundEdge(line, strips, fit, zone_mm, _blind_mm(off, samples.pitch_mm))
        if pitches == 1.0 and abs(fit.offset) < _SETTLED_PITCHES * samples.pitch_mm:
            break
    return found


def _doubt(line: _Guess, guess: _Guess, samples: FaceSamples, length_mm: float) -> Reason | None:
    """What speaks against a line being the edge of the foot; None where nothing does."""
    if abs(line.turn) * length_mm > _MOST_ASKEW_MM:
        return Reason("extract.section_askew")
    if samples.eye is None and abs(line.offset_mm - guess.offset_mm) > _MOST_OFF_MM:
        return Reason("extract.section_border")
    return None


@dataclass(frozen=True, eq=False)
class _Guess:
    """Where an edge is thought to be: x @ normal = offset_mm + turn · (x @ along − middle_mm)."""

    along: Array
    normal: Array
    middle_mm: float
    offset_mm: float
    turn: float


def _looks_past(samples: FaceSamples, place: Array, normal: Array) -> bool:
    """Whether what lies beyond an edge is not the side of the block itself."""
    return samples.eye is not None and bool(samples.slope_at(place) @ normal >= 0.0)


def _across(
    samples: FaceSamples, line: _Guess, mouths: KnownMouths, half_mm: float, reach_mm: float, step: float
) -> tuple[Array, Array, Array]:
    """Places (n,) along a line and beyond it, mm, but for those in mouths, and the heights of what returned there."""
    # Half a step more than the reach: so that its end is among them.
    s, d = np.meshgrid(np.arange(-half_mm, half_mm, step), np.arange(-reach_mm - step, reach_mm + 1.5 * step, step))
    s, d = s.ravel(), d.ravel()
    asked = samples.ask(
        np.outer(line.middle_mm + s, line.along) + np.outer(line.offset_mm + line.turn * s + d, line.normal)
    )
    s = asked.xy @ line.along - line.middle_mm
    d = asked.xy @ line.normal - line.offset_mm - line.turn * s
    wanted = (np.abs(s) < half_mm) & (np.abs(d) < reach_mm)
    for centre, radius in zip(mouths.centres, mouths.radii.tolist(), strict=True):
        if abs(float(centre @ line.normal) - line.offset_mm) < reach_mm + radius + _ABOUT_MOUTH_MM:
            wanted &= np.hypot(*(asked.xy - centre).T) > radius + _ABOUT_MOUTH_MM
    return s[wanted], d[wanted], asked.height[wanted]


def _blind_mm(off: Array, pitch_mm: float) -> float:
    """The widest gap, mm, between distances from an edge at which anything was asked, next to it.

    Rows of pixels that run along an edge all lie on one side of it or the other: how far, nobody knows.
    """
    near = np.sort(off[np.abs(off) < _BLIND_PITCHES * pitch_mm])
    return float(np.diff(near).max(initial=0.0)) if len(near) else 0.0


def _mixed_zone(d: Array, height: Array, band_mm: float, pitch_mm: float) -> float:
    """How far before its last returns (d = 0) a face begins to scatter or bend, mm; 0 for one that ends as it is."""
    on = np.abs(height) < band_mm
    inner = on & (d < -_INNER_PITCHES[0] * pitch_mm) & (d > -_INNER_PITCHES[1] * pitch_mm)
    if inner.sum() < _FEWEST_PLACES or not height[inner].any():
        return 0.0  # cells of a cloud have no heights
    middle = float(np.median(height[inner]))
    usual = float(np.median(np.abs(height[inner] - middle)))
    step = _ZONE_STEP_PITCHES * pitch_mm
    begin = 0.0
    for k in range(int(_ZONE_PITCHES / _ZONE_STEP_PITCHES)):
        there = on & (d <= -k * step) & (d > -(k + 1) * step)
        if there.sum() < _FEWEST_PLACES or np.median(np.abs(height[there] - middle)) < _DISTURBED * usual:
            break
        begin = (k + 1) * step
    return begin
