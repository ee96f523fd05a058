"""Centres of mouths by the witnesses that are right for what a camera does at edges: rims, bores, lines of sight."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from aadm_workbench.extract.circle import AGREES_MM
from aadm_workbench.extract.edges.bend import bend_at_edges
from aadm_workbench.extract.edges.edge_shift import (
    ERODED_PARTS_VIEW_MM,
    PARTS_VIEW_MM,
    BentDiscs,
    Shift,
    bent_discs,
    eroded_discs,
    narrow_band_mm,
    shift_of_mouths,
    shift_of_rims,
    view_by_walls,
)
from aadm_workbench.extract.edges.learned_edges import (
    DISC_U_PITCHES,
    LEARNED_BAND_MM,
    KnownEdges,
    with_learned_discs,
    without_losses,
    without_view,
)
from aadm_workbench.extract.edges.seen_disc import SeenDiscs, SightLines, points_alone, seen_discs
from aadm_workbench.extract.foot_face import FACE_BAND_MM
from aadm_workbench.extract.mouths import Mouths
from aadm_workbench.extract.patches import Patches
from aadm_workbench.extract.pooled.evidence import BracketLaw, RimLaw, Rims, Walls, WallTerms
from aadm_workbench.extract.pooled.fit import Evidence, PooledFit, fit_pooled, settled
from aadm_workbench.extract.pooled.system import PUSH, WALL, Priors, State
from aadm_workbench.model import (
    Array,
    BoolArray,
)
from aadm_workbench.model.measured import TO_SIGMA
from aadm_workbench.model.special import median

WALL_COUNT_MIN = 20
"""Points of a bore: fewer do not tell on which side its wall shows. A choice: ±30 % moves centres by up to 0.3 u."""

_WALL_LAW = BracketLaw(0.08, 0.4)  # many points lie on ribs, which only ever stand inwards
# wide before the share of kept pixels is known; then so many pitches over that share; what cameras mostly keep (a
# choice: ±30 % moves centres by up to 0.3 u and u by 7 %)
_TAIL_PITCHES, _TAIL_TO_KEPT, _USUALLY_KEPT = 6.0, 1.5, 0.7
_FIRST_SETTLED_MM = 0.03  # the first fit only tells which share of the pixels the camera keeps, and how bores scatter
_WHOLE_WITHIN_MM = 1.5  # between the innermost points of a rim and the disc that is seen: filters move it by less
_WHOLE_PITCHES = 1.5  # more for each ring that filters drop: from one side of a rim, and not from the other
_SURELY_ERODED_PITCHES = 1.2  # of the face at mouths, on cameras that drop one ring at most or none: up to 1.1
# beyond chamfers and what cameras bend, within what a patch reaches; deeper than dirt, not as deep as a bore
_SPALL_RING_MM, _SPALL_RING_PITCHES, _SPALL_DEPTH_MM = (1.2, 4.0), 1.5, (1.0, 6.0)
# of noise, one in a thousand is beyond; of the ring's points, in which flying pixels and dirt are one in a hundred
_SPALL_NOISES, _SPALL_SHARE = 3.0, 0.05
# slivers reach a pixel into a mouth; strays, and slips of the fringe order that hit the face, are one in a hundred
# points of a rim, a tape over a tenth of a mouth has a fifth of it; bins of an outline hold a pixel each
_COVERED_PITCHES, _COVERED_SHARE, _COVERED_BESIDE = 1.5, 0.12, 2
# a quarter of a pitch that all edges are seen off moves no whole circle, and half of one by 4/pi of it
_HALF_RIM_PITCHES = 0.32
_ERODED_RADIUS_MAX = 0.5  # rings: beyond, walls that light pushes know the radius better
_BY_BORES = _ERODED_RADIUS_MAX  # rings at which the radius is that of the bores, whatever the rims show
_BROKEN_U_MM = 0.3  # of a broken rim, seen by a camera that adds to its edges
# 30 degrees of turn from the visible side each; of fewer rim points a share tells nothing
_SIDES, _SIDE_COUNT_MIN = 6, 10
# what is left of a rim's own radius once its law follows the share of kept pixels (a choice: ±30 % moves centres by
# less than 0.1 u)
_RIM_TO_WALL_PITCHES = 0.05
_BENT_PRIORS = Priors(radius=0.15, push=0.6, own_push=0.4)  # light that bounces pushes each bore's wall its own way
_FIT_SHARE = 0.8  # the fit's own covariance has neighbours share more of their errors than they do
# where no camera tells which lines of sight found nothing, faces that are flat to the edge, and those that bend there:
# on path-traced clouds their rims were off by 0.2 mm at a pitch of 0.5 mm
_UNSEEN_PITCHES = 0.08, 0.35
_FOREIGN = 0.01  # share of outline points that are flying pixels or dirt


def fit_mouths(
    mouths: Mouths, lines: SightLines | None, diameter_mm: float, pitch_mm: float, rings: int
) -> PooledFit | None:
    """Fit all mouths together, by the witnesses that are right for what the camera does at edges.

    ``rings`` are those that it drops at depth steps, as far as gaps tell.

    A mouth that is taped or broken is no disc: it is measured by what is sound of its rim, whatever the others are.
    None where the picture is out of focus.
    """
    mouths, covered = _without_tapes(mouths, diameter_mm / 2, pitch_mm)
    fit = _fit_by_edges(mouths, covered, lines, diameter_mm, pitch_mm, rings)
    half = (_HALF_RIM_PITCHES * pitch_mm) ** 2 * covered[:, None, None] * np.eye(2)
    return None if fit is None else replace(fit, covariance=fit.covariance + half)


def _fit_by_edges(
    mouths: Mouths, covered: BoolArray, lines: SightLines | None, diameter_mm: float, pitch_mm: float, rings: int
) -> PooledFit | None:
    if lines is None:
        return _fit_of_sharp(mouths, diameter_mm, pitch_mm)
    seen = _seen(lines, mouths.centre, diameter_mm, pitch_mm)
    if not rings and seen.radius - diameter_mm / 2 > _SURELY_ERODED_PITCHES * pitch_mm:
        rings = 2
    whole = np.hypot(*(seen.centre - mouths.centre).T) < _WHOLE_WITHIN_MM + _WHOLE_PITCHES * rings * pitch_mm
    whole &= ~_are_spalled(lines, mouths.centre, diameter_mm / 2, pitch_mm)
    whole &= ~covered
    if not whole.any():
        fit = _fit_of_sharp(mouths, diameter_mm, pitch_mm)
        return _shifted(fit, shift_of_rims(lines.slope, mouths.rims, fit.centre, diameter_mm / 2, pitch_mm))
    if not whole.all():
        seen = _seen(lines.of(whole), mouths.centre[whole], diameter_mm, pitch_mm)
    bend = bend_at_edges(lines.of(whole), seen.centre, seen.radius, pitch_mm, 1.0)
    if bend.blurred:
        return None
    bent = bend.bent_beside(seen.radius - diameter_mm / 2)
    if bent or rings:
        discs = (
            bent_discs(lines.of(whole), seen.centre, diameter_mm / 2, bend)
            if bent
            else eroded_discs(lines.of(whole), seen.centre, diameter_mm / 2, bend, rings)
        )
        return _fit_of_bent(mouths, discs, whole, diameter_mm, pitch_mm)
    fit = _fit_of_sharp(mouths, diameter_mm, pitch_mm)
    return _shifted(fit, shift_of_mouths(lines.slope, fit.centre, seen, whole, diameter_mm / 2, bend))


def _are_spalled(lines: SightLines, centre: Array, radius_mm: float, pitch_mm: float) -> BoolArray:
    """Where (k,) a piece of the face is broken out beside a mouth: no camera bends a face so far from its edge."""
    distance = np.hypot(lines.x - centre[:, :1], lines.y - centre[:, 1:])
    low_mm, high_mm = _SPALL_RING_MM[0] + _SPALL_RING_PITCHES * pitch_mm, _SPALL_RING_MM[1]
    ring = (distance > radius_mm + low_mm) & (distance < radius_mm + high_mm) & (lines.height > -_SPALL_DEPTH_MM[1])
    noise_mm = TO_SIGMA * float(median(np.abs(lines.height[ring]))) if ring.any() else 0.0
    broken = ring & (lines.height < -max(_SPALL_DEPTH_MM[0], _SPALL_NOISES * noise_mm))
    return np.asarray(broken.sum(axis=1) > _SPALL_SHARE * ring.sum(axis=1))


def _without_tapes(mouths: Mouths, radius_mm: float, pitch_mm: float) -> tuple[Mouths, BoolArray]:
    """The mouths without edges of what lies across them, tape or grout, and which (k,) are partly covered by that.

    Such an edge runs farther in than any camera sees a rim: no part of it is one, nor what lies next to it.
    """
    rims = mouths.rims
    across = rims.seen & (rims.distance(mouths.centre) < radius_mm - max(AGREES_MM, _COVERED_PITCHES * pitch_mm))
    covered = across.sum(axis=1) > _COVERED_SHARE * rims.seen.sum(axis=1)
    wide = across.copy()
    for shift in range(1, _COVERED_BESIDE + 1):
        wide |= np.roll(across, shift, axis=1) | np.roll(across, -shift, axis=1)
    return replace(mouths, rims=rims.only(~(wide & covered[:, None]))), np.asarray(covered)


def with_unseen_edges(fit: PooledFit, patches: Patches, radius_mm: float, pitch_mm: float) -> PooledFit:
    """The fit of a cloud, no surer than it can be where nothing tells which lines of sight found no surface."""
    bend = bend_at_edges(points_alone(patches), fit.centre, radius_mm, pitch_mm, 1.0)
    unseen_mm = _UNSEEN_PITCHES[bend.bent] * pitch_mm
    return replace(fit, covariance=fit.covariance + unseen_mm**2 * np.eye(2))


def _shifted(fit: PooledFit, shift: Shift) -> PooledFit:
    """The fit without the shift that all its centres share, as far as that is known."""
    covariance = _FIT_SHARE**2 * fit.covariance + shift.covariance
    return replace(fit, centre=fit.centre - shift.mean, covariance=covariance, radius_u_mm=shift.radius_u_mm)


def _seen(lines: SightLines, centre: Array, diameter_mm: float, pitch_mm: float) -> SeenDiscs:
    return seen_discs(lines, np.abs(lines.height) < FACE_BAND_MM, centre, diameter_mm / 2, pitch_mm, 1.0)


def _fit_of_bent(mouths: Mouths, discs: BentDiscs, whole: BoolArray, diameter_mm: float, pitch_mm: float) -> PooledFit:
    """Where the face bends at the mouths: centres by what lines of sight find, leans by the bores.

    Mouths that are not ``whole`` (k,) have their rims, which stand out by as much as the camera adds to them.
    """
    law = RimLaw(pitch_mm, _TAIL_PITCHES * pitch_mm, _FOREIGN)
    rims = Rims(mouths.rims.xy, mouths.rims.seen & ~whole[:, None], 1.0, law)
    none = Rims(rims.xy[:, :0], rims.seen[:, :0], 1.0, law)
    walls = Walls(mouths.wall_xy, mouths.wall_depth, mouths.wall_slope, mouths.wall_seen, _WALL_LAW, side=1.0)
    centre, information = mouths.centre.copy(), np.zeros((len(whole), 2, 2))
    discs = discs.moved_by(view_by_walls(walls.of(whole), discs.centre, discs.slope, diameter_mm / 2))
    centre[whole], information[whole] = discs.centre, np.linalg.inv(discs.own)
    evidence = Evidence(none, rims, walls, diameter_mm / 2, _BENT_PRIORS, (centre, information))
    state = settled(evidence, State(centre, diameter_mm / 2), _FIRST_SETTLED_MM)
    spread_mm = WallTerms(walls, state.own, state.pooled[WALL], state.pooled[PUSH]).spread_mm
    scattered = replace(walls, law=BracketLaw(max(_WALL_LAW.width_mm, spread_mm), _WALL_LAW.foreign))
    fit = fit_pooled(replace(evidence, walls=scattered), state)
    shared = np.tile(_BROKEN_U_MM**2 * np.eye(2), (len(whole), 1, 1))
    shared[whole] = discs.in_common
    radius = fit.radius
    if discs.eroded < _ERODED_RADIUS_MAX:  # what all share from the rims, what is each one's own from its bore
        radius = np.where(whole, discs.radius + radius - np.mean(radius[whole]), radius)
    outline = radius + discs.eroded * pitch_mm * whole
    covariance = fit.covariance + shared
    return replace(fit, covariance=covariance, radius=radius, outline_radius=outline, radius_u_mm=discs.radius_u_mm)


def fit_as_learned(
    fit: PooledFit, mouths: Mouths, lines: SightLines, radius_mm: float, known: KnownEdges, rings: int
) -> tuple[PooledFit, float]:
    """The fit, its centres drawn to discs of lines of sight set right by what was learned, and to the bores.

    What chamfers do along the view moves discs, and hardly the fit of rims and bores: that part is the fit's. Where
    ``rings`` were dropped there are no rims, and the fit's part is a law of other cameras: then half of it is that of
    discs in a band as narrow as noise allows, into which less of chamfers and walls reaches. And how many pixels discs
    are larger than the bores: edges of the camera that was learned are where bores begin.
    """
    lines, on = without_losses(lines, fit.centre, 1.0, known), np.abs(lines.height) < LEARNED_BAND_MM
    seen = seen_discs(lines, on, fit.centre, radius_mm, known.pitch_mm, 1.0)
    whole = np.hypot(*(seen.centre - fit.centre).T) < _WHOLE_WITHIN_MM
    if not whole.any():
        return fit, 0.0
    own = seen.covariance + (DISC_U_PITCHES * known.pitch_mm) ** 2 * np.eye(2)
    nothing = np.zeros((int(whole.sum()), 2, 2))
    discs = BentDiscs(seen.centre[whole], own[whole], nothing, lines.slope[whole], 0.0, seen.radius, 0.0, _BY_BORES)
    joint = _fit_of_bent(mouths, discs, whole, 2.0 * radius_mm, known.pitch_mm)
    like = fit.centre
    if rings:
        like = (like + _narrow_discs(lines, fit.centre, radius_mm, known.pitch_mm)) / 2.0
    joint = replace(joint, centre=without_view(joint.centre, like, lines.slope))
    off_pitches = (seen.radius - float(median(joint.radius))) / known.pitch_mm
    view_mm = ERODED_PARTS_VIEW_MM if rings else PARTS_VIEW_MM[1.0]
    return with_learned_discs(fit, joint, whole, lines.slope, known, view_mm), off_pitches


def _narrow_discs(lines: SightLines, centre: Array, radius_mm: float, pitch_mm: float) -> Array:
    """Centres (k, 2) mm of discs about ``centre`` by what finds the face alone, as far as its noise lets one tell."""
    band_mm = narrow_band_mm(bend_at_edges(lines, centre, radius_mm, pitch_mm, 1.0))
    return seen_discs(lines, np.abs(lines.height) < band_mm, centre, radius_mm, pitch_mm, 1.0).centre


def _fit_of_sharp(mouths: Mouths, diameter_mm: float, pitch_mm: float) -> PooledFit:
    """Fit all mouths together, then again with what the first fit tells of the camera.

    At depth steps a camera keeps only a share of the pixels, and not the same share on every side of a mouth: the
    law of the rims follows the share that it keeps. Rims stand on the bore's own radius: a camera that takes a
    whole ring of pixels from every depth step shifts centres along the view by about half of that ring.
    """
    law = RimLaw(pitch_mm, _TAIL_PITCHES * pitch_mm, _FOREIGN)
    rims = Rims(mouths.rims.xy, mouths.rims.seen, 1.0, law)
    beyond = Rims(rims.xy[:, :0], rims.seen[:, :0], -1.0, law)  # inside a sleeve it is dark
    walls = Walls(mouths.wall_xy, mouths.wall_depth, mouths.wall_slope, mouths.wall_seen, _WALL_LAW, side=1.0)
    evidence = Evidence(beyond, rims, walls, diameter_mm / 2, Priors(rim_to_wall=_RIM_TO_WALL_PITCHES * pitch_mm))
    state = settled(evidence, State(mouths.centre, diameter_mm / 2), _FIRST_SETTLED_MM)
    kept = replace(rims, law=replace(law, tail_mm=_tails(mouths, state, pitch_mm)))
    fit = fit_pooled(replace(evidence, rims=kept), state)
    return replace(fit, outline_radius=fit.radius)


def _turned_from_camera(mouths: Mouths) -> Array:
    """Angle (k, bins) rad, 0..pi, between each rim point and the side on which its mouth's wall shows.

    That side is away from the camera's foot point: there the face runs on into the wall, opposite it ends in a
    depth step. A mouth that shows no wall is all step: pi.
    """
    count = mouths.wall_count()[:, None]
    side = (mouths.wall_xy * mouths.wall_seen[..., None]).sum(axis=1) / np.maximum(count, 1) - mouths.centre
    away = np.arctan2(side[:, 1], side[:, 0])[:, None]
    about = mouths.rims.xy - mouths.centre[:, None]
    turn = np.abs(np.mod(np.arctan2(about[..., 1], about[..., 0]) - away + np.pi, 2 * np.pi) - np.pi)
    return np.where(count >= WALL_COUNT_MIN, turn, np.pi)


def _tails(mouths: Mouths, state: State, pitch_mm: float) -> Array:
    """Length (k, bins) mm over which the rim points of each side thin out: longer where fewer pixels are kept."""
    inset = mouths.rims.distance(state.own[:, :2]) - state.wall_radius()[:, None]
    side = np.minimum((_turned_from_camera(mouths) / np.pi * _SIDES).astype(np.int64), _SIDES - 1)
    seen = mouths.rims.seen
    count = np.bincount(side[seen], minlength=_SIDES)
    first = np.bincount(side[seen], inset[seen] < pitch_mm, minlength=_SIDES)
    kept = np.where(count >= _SIDE_COUNT_MIN, first / np.maximum(count, 1), _USUALLY_KEPT)
    # A side that keeps less than a seventh is no rim; counting noise makes of all kept a little more than one.
    return np.asarray(_TAIL_TO_KEPT * pitch_mm / np.clip(kept, 0.15, 1.2))[side]
