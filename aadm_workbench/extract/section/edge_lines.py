"""Straight edges of a face: by where it ends in strips across them (:mod:`.strips`).

A camera that mixes what a pixel sees finds the face beyond its edge, too: how far is told by how its heights scatter
there (:mod:`.strips`), for all edges of a face together. A camera that drops rings of pixels at steps shows that at
the mouths, whose bores are known; whether it drops them before an empty background, too, nobody can see.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.extract.section.face_samples import Area, FaceSamples, KnownMouths, lost_at_rim, taken_in
from aadm_workbench.extract.section.strips import (
    OUT_OF_PICTURE,
    Chip,
    Overshoot,
    StripLine,
    Strips,
    chips_of,
    ends_of_strips,
    line_through,
    overshoot_of,
    pooled,
)
from aadm_workbench.model import Array, Reason
from aadm_workbench.model.special import median

_FIRST_REACH_MM = 30.0  # sections are cast to within 5 mm, and patterns stand within 10 mm of their place in them
_REACH_MM, _REACH_PITCHES = 4.0, 8.0  # to both sides of an edge that is known by and by; deeper chips are followed
_CORNER_MM = 3.0  # of the neighbouring edge: nothing is asked so near to it
_MOST_ASKEW_MM = 8.0  # from end to end: sections are cast to 5 mm, and what hides a part of one runs as it likes
_MOST_OFF_MM = 8.0  # from its place by design: sections and patterns keep to 5 mm each
_SETTLED_PITCHES = 1.0  # of a step of the line: places about it are then the same
_BLIND_PITCHES = 1.0  # about an edge: places fill it where rows of pixels run across it at some angle
_OWN_SHARE = 0.06  # of the overshoot: by so much it differs from edge to edge, for what is lit along it
_LEVEL_PITCHES = 4.0  # before an edge: farther than any sharp camera's blur
_BLOCKS, _BLOCK_PLACES = 10, 20  # along an edge: what bends more often is no face that was cast
_LEVEL_PLACES = 1200  # of which each block has a hundred, and a median a tenth of the noise
_AT_END_MM = 1.5  # before the next edge: a strip there may be cut by it, and shallower chips are none
_CHIP_LOOK_MM = 30.0  # half of how deep a chip is followed: what is deeper is no chip
_ABOUT_MOUTH_MM = 2.0  # rims that are worn, or chamfered
_WIDE_MM = 5.0  # about the face: as far as edges bend that are 0.5 mm from the middle of a pixel, seen from 1.5 m
# Of places along and across; scatter along an edge is averaged away in any case, and costs as much as it is asked.
_WIDE_EVERY, _FINE_EVERY = (3, 3), (2, 1)


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


@dataclass(frozen=True, eq=False)
class Guess:
    """Where an edge is thought to be: x @ normal = offset_mm + turn · (x @ along − middle_mm)."""

    along: Array
    normal: Array
    middle_mm: float
    offset_mm: float
    turn: float


@dataclass(frozen=True, eq=False)
class FoundEdge:
    """Where the last returns of a face lie along one edge; ``guess`` is where the edge was thought to be.

    ``overshoot``: how far that is beyond the edge, by this edge alone. ``blind_mm`` is the widest gap without a place
    that was asked, ``lost_mm`` how much a mouth that ends the face towards the same side loses of it.
    """

    line: Guess
    strips: Strips
    fit: StripLine
    length_mm: float
    overshoot: Overshoot | None
    blind_mm: float
    lost_mm: float | None
    taken_mm: float


@dataclass(frozen=True, eq=False)
class _Ended:
    """A line on which a face ends, and places (n,) about it, mm: along it, beyond it, and heights of what returned."""

    line: Guess
    strips: Strips
    fit: StripLine
    along: Array
    off: Array
    height: Array


def find_edge(
    samples: FaceSamples, start: Array, end: Array, mouths: KnownMouths, band_mm: float
) -> FoundEdge | Reason:
    """Where the face ends near the line from ``start`` to ``end`` (2,) mm, the face to its left; or why none is found.

    Parameters
    ----------
    band_mm
        About the face: what returned from within counts as face.
    """
    length_mm = float(np.hypot(*(end - start)))
    along = (end - start) / length_mm
    normal = np.array([along[1], -along[0]])
    band_mm = _WIDE_MM if _looks_past(samples, (start + end) / 2.0, normal) else band_mm
    guess = Guess(along, normal, float((start + end) @ along) / 2.0, float((start + end) @ normal) / 2.0, 0.0)
    ended = _ended(samples, guess, mouths, length_mm / 2.0 - _CORNER_MM, band_mm)
    if isinstance(ended, Reason):
        return ended
    line = ended.line
    overshoot = overshoot_of(ended.off, ended.height, band_mm, samples.pitch_mm)
    if isinstance(overshoot, Reason):
        return overshoot
    why = _doubt(line, guess, samples, length_mm)
    if why:
        return why
    lost_mm = lost_at_rim(samples, mouths, normal, band_mm) if overshoot is None else None
    taken_mm = taken_in(samples, along * line.middle_mm + normal * line.offset_mm, normal, band_mm)
    blind_mm = _blind_mm(ended.along, ended.off, samples.pitch_mm)
    return FoundEdge(line, ended.strips, ended.fit, length_mm, overshoot, blind_mm, lost_mm, taken_mm)


def edge_lines(
    samples: FaceSamples, found: Mapping[str, FoundEdge | Reason], mouths: KnownMouths
) -> dict[str, EdgeLine | Reason]:
    """Edges of one face, from where its last returns lie: by what the camera does at edges, as all of them tell."""
    seen = [edge for edge in found.values() if isinstance(edge, FoundEdge)]
    mixed = pooled([edge.overshoot for edge in seen], samples.pitch_mm)
    lost = [edge.lost_mm for edge in seen if edge.lost_mm is not None]
    # Who loses whole rings at mouths loses them before an empty background, too, or none there: either is as likely.
    lost_mm = 0.0 if mixed is not None else float(median(lost)) if lost else samples.pitch_mm
    lines: dict[str, EdgeLine | Reason] = {}
    for side, edge in found.items():
        if isinstance(edge, Reason):
            lines[side] = edge
            continue
        line = _edge_line(samples, edge, mixed, lost_mm)
        chips = [
            _deepened(samples, edge.line, chip, mouths) if chip.depth_mm >= edge.strips.reach_mm else chip
            for chip in chips_of(edge.strips, edge.fit, edge.line.middle_mm)
        ]
        others = [other.line for other in seen if other is not edge]
        trimmed = (_trimmed(chip, edge.line, others) for chip in chips)
        lines[side] = replace(line, chips=tuple(chip for chip in trimmed if chip is not None))
    return lines


def _edge_line(samples: FaceSamples, found: FoundEdge, mixed: Overshoot | None, lost_mm: float) -> EdgeLine:
    """Without its chips."""
    line = found.line
    mixed = Overshoot(0.0, 0.0) if mixed is None else mixed
    covariance = found.fit.covariance.copy()
    # What is as likely anywhere in a gap has a variance of its square over 12; at both ends a line may be off by it.
    covariance += np.diag([found.blind_mm**2 / 12.0, (found.blind_mm / found.length_mm) ** 2])
    covariance[0, 0] += (_OWN_SHARE * mixed.beyond_mm) ** 2
    # Of what a look at cells makes wider, anything from nothing to all is as likely.
    shared = mixed.u_mm, lost_mm / 2.0, 2.0 * samples.wider_mm / np.sqrt(12.0)
    return EdgeLine(
        line.normal,
        line.along,
        line.offset_mm - mixed.beyond_mm + lost_mm / 2.0 - found.taken_mm - samples.wider_mm,
        line.turn,
        line.middle_mm,
        covariance,
        float(np.linalg.norm(shared)),
        found.strips.seen,
        (),
    )


def _trimmed(chip: Chip, line: Guess, others: Sequence[Guess]) -> Chip | None:
    """The part of a chip that lies within the other edges; None where none does: there the face itself has ended."""
    run = np.linspace(chip.begin_mm, chip.end_mm, 2 * int(chip.end_mm - chip.begin_mm) + 2)
    places = np.outer(run, line.along) + np.outer(line.offset_mm + line.turn * (run - line.middle_mm), line.normal)
    inside = np.ones(len(run), bool)
    for other in others:
        end = other.offset_mm + other.turn * (places @ other.along - other.middle_mm)
        inside &= places @ other.normal < end - _AT_END_MM
    if not inside.any():
        return None
    return replace(chip, begin_mm=float(run[inside][0]), end_mm=float(run[inside][-1]))


def _deepened(samples: FaceSamples, line: Guess, chip: Chip, mouths: KnownMouths) -> Chip:
    """A chip that is deeper than was looked: as deep as less than half of its middle third is face."""
    third_mm = (chip.end_mm - chip.begin_mm) / 3.0
    half_mm = third_mm / 2.0 + samples.pitch_mm
    inner = replace(
        line,
        middle_mm=(chip.begin_mm + chip.end_mm) / 2.0,
        offset_mm=line.offset_mm + line.turn * ((chip.begin_mm + chip.end_mm) / 2.0 - line.middle_mm) - _CHIP_LOOK_MM,
    )
    _, d, height = _across(samples, inner, mouths, half_mm, _CHIP_LOOK_MM, (1, 1))
    depth = np.clip(_CHIP_LOOK_MM - d, 0.0, 2.0 * _CHIP_LOOK_MM - 1.0).astype(int)  # bins of a millimetre
    asked, found = np.bincount(depth), np.bincount(depth, np.abs(height) < _WIDE_MM)
    face = np.flatnonzero(found > asked / 2.0)
    return replace(chip, depth_mm=max(chip.depth_mm, float(face[0]))) if len(face) else chip


def _ended(samples: FaceSamples, line: Guess, mouths: KnownMouths, half_mm: float, band_mm: float) -> _Ended | Reason:
    """The line on which the face ends: looked for in wide strips, then in narrow ones about what these give."""
    fine_mm = max(_REACH_MM, _REACH_PITCHES * samples.pitch_mm)
    ended: _Ended | Reason = OUT_OF_PICTURE
    for reach_mm, every in ((_FIRST_REACH_MM, _WIDE_EVERY), (fine_mm, _FINE_EVERY), (fine_mm, _FINE_EVERY)):
        s, d, height = _across(samples, line, mouths, half_mm, reach_mm, every)
        if every == _FINE_EVERY:
            d, height = _levelled(samples, line, s, d, height, band_mm)
        step = every[1] * samples.pitch_mm
        strips = ends_of_strips(s, d, np.abs(height) < band_mm, half_mm, reach_mm, (every[0] * samples.pitch_mm, step))
        if isinstance(strips, Reason):
            return strips
        fit = line_through(strips, step)
        if isinstance(fit, Reason):
            return fit
        line = replace(line, offset_mm=line.offset_mm + fit.offset, turn=line.turn + fit.turn)
        ended = _Ended(line, strips, fit, s, d - fit.offset - fit.turn * s, height)
        if every == _FINE_EVERY and abs(fit.offset) < _SETTLED_PITCHES * samples.pitch_mm:
            break
    return ended


def _doubt(line: Guess, guess: Guess, samples: FaceSamples, length_mm: float) -> Reason | None:
    """What speaks against a line being the edge of the foot; None where nothing does."""
    if abs(line.turn) * length_mm > _MOST_ASKEW_MM:
        return Reason("extract.section_askew")
    if samples.eye is None and abs(line.offset_mm - guess.offset_mm) > _MOST_OFF_MM:
        return Reason("extract.section_border")
    return None


def _looks_past(samples: FaceSamples, place: Array, normal: Array) -> bool:
    """Whether what lies beyond an edge is not the side of the block itself."""
    return samples.eye is not None and bool(samples.slope_at(place) @ normal >= 0.0)


def _across(
    samples: FaceSamples, line: Guess, mouths: KnownMouths, half_mm: float, reach_mm: float, every: tuple[int, int]
) -> tuple[Array, Array, Array]:
    """Places (n,) along a line and beyond it, mm, but for those in mouths, and the heights of what returned there."""
    middle = line.middle_mm * line.along + line.offset_mm * line.normal
    along = line.along + line.turn * line.normal
    asked = samples.ask(Area(middle, along / np.hypot(*along), half_mm, reach_mm, every))
    s = asked.xy @ line.along - line.middle_mm
    d = asked.xy @ line.normal - line.offset_mm - line.turn * s
    wanted = (np.abs(s) < half_mm) & (np.abs(d) < reach_mm)
    for centre, radius in zip(mouths.centres, mouths.radii.tolist(), strict=True):
        out, clear_mm = float(centre @ line.normal) - line.offset_mm, radius + _ABOUT_MOUTH_MM
        if abs(out) < reach_mm + clear_mm:
            beside, beyond = s - (float(centre @ line.along) - line.middle_mm), d - out + line.turn * s
            wanted &= beside * beside + beyond * beyond > clear_mm**2
    return s[wanted], d[wanted], asked.height[wanted]


def _levelled(
    samples: FaceSamples, line: Guess, s: Array, d: Array, height: Array, band_mm: float
) -> tuple[Array, Array]:
    """Places across (n,) and heights (n,), mm, of a face that bends, as if it lay in its plane along the edge.

    A line of sight meets what lies over the plane before it meets the plane.
    """
    inner = np.flatnonzero((np.abs(height) < band_mm) & (d < -_LEVEL_PITCHES * samples.pitch_mm))
    inner = inner[:: len(inner) // _LEVEL_PLACES + 1]
    if samples.eye is None or len(inner) < _BLOCK_PLACES:
        return d, height
    # Blocks of as many places each, from end to end.
    blocks = np.array_split(inner[np.argsort(s[inner], kind="stable")], min(_BLOCKS, len(inner) // _BLOCK_PLACES))
    at = [float(s[block].mean()) for block in blocks]
    level = np.interp(s, at, [float(median(height[block])) for block in blocks])
    near = height[inner] - level[inner]
    level += _rise(d[inner], near) * (d - float(median(d[inner])))
    slope = samples.slope_at(np.outer(line.middle_mm + s, line.along) + line.offset_mm * line.normal) @ line.normal
    return d - slope * level, height - level


def _rise(d: Array, height: Array) -> float:
    """How much a face rises outwards before an edge, mm per mm, by the medians of its two halves (n,) there."""
    outer = d > median(d)
    if outer.all() or not outer.any():
        return 0.0
    return float((median(height[outer]) - median(height[~outer])) / (d[outer].mean() - d[~outer].mean()))


def _blind_mm(s: Array, off: Array, pitch_mm: float) -> float:
    """The widest gap, mm, between distances from an edge at which anything was asked: that of usual parts of it.

    Rows of pixels that run along an edge all lie on one side of it or the other: how far, nobody knows, and where they
    cross it once or twice, its line hangs on where they do.
    """
    near = np.abs(off) < _BLIND_PITCHES * pitch_mm
    s, off = s[near], off[near]
    if len(s) == 0:
        return 0.0
    part = ((s - s.min()) / (np.ptp(s) + pitch_mm) * _BLOCKS).astype(int)
    order = np.lexsort((off, part))
    gaps = np.where(np.diff(part[order]) == 0, np.diff(off[order]), 0.0)
    widest = np.zeros(_BLOCKS)
    np.maximum.at(widest, part[order][1:], gaps)
    return float(np.sqrt(np.mean(widest**2)))
