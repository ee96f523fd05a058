"""Sleeve centres in the scan of a column foot.

The steps: find the foot face, find round holes of the expected size in it, take all points around each
hole, and fit bores and mouth edges of all sleeves together.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from aadm_workbench.extract.circle import AGREES_MM
from aadm_workbench.extract.copied_pixels import COPIED, copies_depths
from aadm_workbench.extract.edges.edge_shift import (
    BentDiscs,
    Shift,
    bend_at_edges,
    bent_discs,
    shift_of_mouths,
    shift_of_rims,
)
from aadm_workbench.extract.edges.learned_edges import known_edges
from aadm_workbench.extract.edges.learned_mouths import mouths_as_learned
from aadm_workbench.extract.edges.seen_disc import SeenDiscs, SightLines, seen_discs, sight_lines_on_face
from aadm_workbench.extract.filter_signs import filter_signs
from aadm_workbench.extract.foot_face import FACE_BAND_MM, FootFace, face_with_holes, level_with_rings
from aadm_workbench.extract.found_points import found_points, seen_lengths
from aadm_workbench.extract.mouths import REACH_MM, WALL_DEPTH_MM, Mouths, mouths_in
from aadm_workbench.extract.patches import Patches, patches_around, with_places
from aadm_workbench.extract.plane import axes_on, from_plane, in_plane, turned_over
from aadm_workbench.extract.pooled.evidence import BracketLaw, RimLaw, Rims, Walls, WallTerms
from aadm_workbench.extract.pooled.fit import Evidence, PooledFit, fit_pooled, settled
from aadm_workbench.extract.pooled.system import PUSH, WALL, Priors, State
from aadm_workbench.extract.sample import Thinned, thinned
from aadm_workbench.model import Array, AssemblyPoint, BoolArray, Extraction, Kind, Plane, Reason, Scan
from aadm_workbench.model.scatter import TO_SIGMA

_SAMPLE = 90_000  # every fifth row and column of 1920 × 1200
# points of a bore: fewer do not tell on which side its wall shows; a choice: ±30 % moves centres by up to 0.3 u
_WALL_COUNT_MIN = 20
_WALL_LAW = BracketLaw(0.08, 0.4)  # many points lie on ribs, which only ever stand inwards
# wide before the share of kept pixels is known; then so many pitches over that share; what cameras mostly keep (a
# choice: ±30 % moves centres by up to 0.3 u and u by 7 %)
_TAIL_PITCHES, _TAIL_TO_KEPT, _USUALLY_KEPT = 6.0, 1.5, 0.7
_FIRST_SETTLED_MM = 0.03  # the first fit only tells which share of the pixels the camera keeps, and how bores scatter
BORE_LEAN_U = 2e-3
"""Of a lean: light that bounces in a bore pushes its wall by less or more as it goes deeper."""

_WHOLE_WITHIN_MM = 1.5  # between the innermost points of a rim and the disc that is seen: filters move it by less
# beyond chamfers and what cameras bend, within what a patch reaches; deeper than dirt, not as deep as a bore
_SPALL_RING_MM, _SPALL_RING_PITCHES, _SPALL_DEPTH_MM = (1.2, 4.0), 1.5, (1.0, 6.0)
# of noise, one in a thousand is beyond; of the ring's points, in which flying pixels and dirt are one in a hundred
_SPALL_NOISES, _SPALL_SHARE = 3.0, 0.05
_ERODED_RADIUS_MAX = 0.5  # rings: beyond, walls that light pushes know the radius better
_BROKEN_U_MM = 0.3  # of a broken rim, seen by a camera that adds to its edges
# 30 degrees of turn from the visible side each; of fewer rim points a share tells nothing
_SIDES, _SIDE_COUNT_MIN = 6, 10
# what is left of a rim's own radius once its law follows the share of kept pixels (a choice: ±30 % moves centres by
# less than 0.1 u)
_RIM_TO_WALL_PITCHES = 0.05
_BENT_PRIORS = Priors(radius=0.15, push=0.6, own_push=0.4)  # light that bounces pushes each bore's wall its own way
_FIT_SHARE = 0.8  # the fit's own covariance has neighbours share more of their errors than they do
_WEAR_PITCHES = 0.04  # how far rims may be worn away unnoticed; it shifts centres along the view
_ROUGH_U_MM = 0.1  # grains at the rim of a roughened foot, each mouth by itself
# all radii of a roughened foot, whose rims lie at many depths: 18 feet of the twin had 0.36 mm of diameter (rms)
_ROUGH_RADIUS_U_MM = 0.2
_FOREIGN = 0.01  # share of outline points that are flying pixels or dirt
# of an outline on its circle, or running on into the wall: half of a taped mouth is more; a choice: ±30 % moves
# nothing on sound scans
_SOUND_SHARE = 0.3
_AGREEING_SHARE = 0.75  # of a rim that is judged: sound ones at 2 m, a tenth of the pixels lost, have 0.8 to 1
_RADIUS_MISFIT = 0.08  # relative: a hole this much larger or smaller than nominal is no sleeve


def extract_sleeves(
    scan: Scan,
    diameter_mm: float,
    rng: np.random.Generator,
    places: Array | None = None,
    others_mm: tuple[float, ...] = (),
) -> Extraction:
    """Centres of all sleeves of one diameter in the scan of a foot.

    Parameters
    ----------
    scan
        Organised or not; points in mm, scan frame.
    diameter_mm
        Nominal inner diameter at the mouth.
    rng
        Draws the thinned sample and the plane hypotheses.
    places
        (k, 3) mm, scan frame: where else to look for a sleeve that the search did not find.
    others_mm
        Diameters of other sleeves in the same foot: what is nearer to one of these is left out.

    Returns
    -------
    Extraction
        With an empty ``points`` and a ``reason`` where no face or no hole was found.
    """
    if copies_depths(scan):
        return Extraction(Kind.SLEEVE, "refined", (), None, None, reason=COPIED)
    sample = thinned(scan, _SAMPLE, rng)
    found = face_with_holes(scan, sample, diameter_mm / 2, rng)
    if found is None:
        return Extraction(Kind.SLEEVE, "refined", (), None, None, reason=Reason("extract.no_face"))
    seen = _in_face(scan, sample, found, diameter_mm, places, others_mm)
    if found[0].rough:
        # Where plugs close many mouths, what lies behind the face is these, and no layer: then more are round.
        smooth = face_with_holes(scan, sample, diameter_mm / 2, rng, may_be_rough=False)
        as_smooth = seen if smooth is None else _in_face(scan, sample, smooth, diameter_mm, places, others_mm)
        seen = max(seen, as_smooth, key=lambda one: len(one.points))
    return seen


def _in_face(
    scan: Scan,
    sample: Thinned,
    found: tuple[FootFace, Array, float],
    diameter_mm: float,
    places: Array | None,
    others_mm: tuple[float, ...],
) -> Extraction:
    """The sleeves in one face, about the holes that were found in it; the rest as for :func:`extract_sleeves`."""
    layer, centres, pitch_mm = found
    face = layer.plane
    if places is not None and len(places):
        centres = with_places(centres, in_plane(places, face)[:, :2], diameter_mm / 2)
    if len(centres) == 0:
        reason = Reason("extract.no_hole", diameter_mm=diameter_mm)
        return Extraction(Kind.SLEEVE, "refined", (), face, -face.normal, reason=reason)
    if scan.viewpoint is None:
        face, centres = _facing_away_from_walls(face, centres, sample, diameter_mm / 2)
        layer = (
            layer if face is layer.plane else replace(layer, plane=face, low_mm=-layer.high_mm, high_mm=-layer.low_mm)
        )
    patches = patches_around(scan, sample, face, centres, diameter_mm / 2 + REACH_MM)
    if not layer.rough:
        patches, ringed = level_with_rings(patches, diameter_mm / 2)
        layer = replace(layer, flat=not ringed)
    mouths = mouths_in(patches, centres, diameter_mm / 2, pitch_mm, tuple(other / 2 for other in others_mm), layer)
    return _measured(mouths, patches, layer, diameter_mm, pitch_mm, scan)


def _facing_away_from_walls(face: Plane, centres: Array, sample: Thinned, radius_mm: float) -> tuple[Plane, Array]:
    """Without a viewpoint the side of the normal comes from the walls: they lie behind the face."""
    local = in_plane(sample.points, face)
    apart = local[:, None, :2] - centres[None]
    local = local[(np.einsum("nki,nki->nk", apart, apart) < (radius_mm + REACH_MM) ** 2).any(axis=1)]
    before = int((local[:, 2] > WALL_DEPTH_MM[0]).sum())
    behind = int((local[:, 2] < -WALL_DEPTH_MM[0]).sum())
    if behind >= before:
        return face, centres
    over = turned_over(face)
    lifted = from_plane(np.column_stack([centres, np.zeros(len(centres))]), face)
    return over, in_plane(lifted, over)[:, :2]


def _measured(
    mouths: Mouths,
    patches: Patches,
    layer: FootFace,
    diameter_mm: float,
    pitch_mm: float,
    scan: Scan,
) -> Extraction:
    face = layer.plane
    if len(mouths.place) == 0:
        reason = Reason("extract.no_measured_hole", diameter_mm=diameter_mm)
        return Extraction(Kind.SLEEVE, "refined", (), face, -face.normal, reason=reason)
    own = patches.of(mouths.kept)
    lines = sight_lines_on_face(own) if layer.flat else None  # on what is no plane nobody knows where they end
    fit = _fit(mouths, lines, diameter_mm, pitch_mm)
    known, learned = known_edges(scan.learned, Kind.SLEEVE, own.eye, axes_on(face)), dict[str, float]()
    if fit is not None and lines is not None and known is not None:
        fit, learned = mouths_as_learned(fit, mouths, lines, diameter_mm / 2, known, _fit_of_bent)
    if fit is not None and not layer.flat:
        fit = replace(fit, covariance=fit.covariance + _ROUGH_U_MM**2 * np.eye(2))
    if fit is not None and layer.rough:
        fit = replace(fit, radius_u_mm=float(np.hypot(fit.radius_u_mm, _ROUGH_RADIUS_U_MM)))
    signs = filter_signs(own, mouths.centre, diameter_mm / 2, pitch_mm, 1.0, flat=layer.flat)
    if fit is None or signs.reason(blurred=False):
        return Extraction(Kind.SLEEVE, "refined", (), face, -face.normal, reason=signs.reason(blurred=fit is None))
    sound = (np.abs(fit.radius / (diameter_mm / 2) - 1.0) < _RADIUS_MISFIT) & _are_round(mouths, fit, pitch_mm)
    points = tuple(point for point, kept in zip(_points(mouths, fit, face, pitch_mm), sound, strict=True) if kept)
    if not points:
        reason = Reason("extract.no_round_mouth", diameter_mm=diameter_mm)
        return Extraction(Kind.SLEEVE, "refined", (), face, -face.normal, reason=reason)
    quality = {
        "point_pitch_mm": pitch_mm,
        "plane_residual_mm": face.residual_mm,
        "diameter_u_mm": 2.0 * fit.radius_u_mm,
        "edge_coverage": float(mouths.coverage.mean()),
        "edge_residual_mm": fit.edge_mm,
        "wall_residual_mm": fit.wall_mm,
        "wall_points": int(fit.wall_count.sum()),
        **learned,
    }
    return Extraction(
        Kind.SLEEVE, "refined", points, face, -face.normal, "foot face", quality=quality, complete=signs.complete
    )


def _fit(mouths: Mouths, lines: SightLines | None, diameter_mm: float, pitch_mm: float) -> PooledFit | None:
    """Fit all mouths together, by the witnesses that are right for what the camera does at edges.

    A mouth that is taped or broken is no disc: it is measured by what is sound of its rim, whatever the others are.
    None where the picture is out of focus.
    """
    if lines is None:
        return _fit_of_sharp(mouths, diameter_mm, pitch_mm)
    seen = _seen(lines, mouths.centre, diameter_mm, pitch_mm)
    whole = np.hypot(*(seen.centre - mouths.centre).T) < _WHOLE_WITHIN_MM
    whole &= ~_are_spalled(lines, mouths.centre, diameter_mm / 2, pitch_mm)
    if not whole.any():
        fit = _fit_of_sharp(mouths, diameter_mm, pitch_mm)
        return _shifted(fit, shift_of_rims(lines.slope, mouths.rims, fit.centre, diameter_mm / 2, pitch_mm))
    if not whole.all():
        seen = _seen(lines.of(whole), mouths.centre[whole], diameter_mm, pitch_mm)
    bend = bend_at_edges(lines.of(whole), seen.centre, seen.radius, pitch_mm, 1.0)
    if bend.blurred:
        return None
    if bend.bent:
        discs = bent_discs(lines.of(whole), seen.centre, diameter_mm / 2, bend)
        return _fit_of_bent(mouths, discs, whole, diameter_mm, pitch_mm)
    fit = _fit_of_sharp(mouths, diameter_mm, pitch_mm)
    return _shifted(fit, shift_of_mouths(lines.slope, fit.centre, seen, whole, diameter_mm / 2, bend))


def _are_spalled(lines: SightLines, centre: Array, radius_mm: float, pitch_mm: float) -> BoolArray:
    """Where (k,) a piece of the face is broken out beside a mouth: no camera bends a face so far from its edge."""
    distance = np.hypot(lines.x - centre[:, :1], lines.y - centre[:, 1:])
    low_mm, high_mm = _SPALL_RING_MM[0] + _SPALL_RING_PITCHES * pitch_mm, _SPALL_RING_MM[1]
    ring = (distance > radius_mm + low_mm) & (distance < radius_mm + high_mm) & (lines.height > -_SPALL_DEPTH_MM[1])
    noise_mm = TO_SIGMA * float(np.median(np.abs(lines.height[ring]))) if ring.any() else 0.0
    broken = ring & (lines.height < -max(_SPALL_DEPTH_MM[0], _SPALL_NOISES * noise_mm))
    return np.asarray(broken.sum(axis=1) > _SPALL_SHARE * ring.sum(axis=1))


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
    centre[whole], information[whole] = discs.centre, np.linalg.inv(discs.own)
    evidence = Evidence(none, rims, walls, diameter_mm / 2, _BENT_PRIORS, (centre, information))
    state = settled(evidence, State(centre, diameter_mm / 2), _FIRST_SETTLED_MM)
    spread_mm = WallTerms(walls, state.own, state.pooled[WALL], state.pooled[PUSH]).spread_mm
    scattered = replace(walls, law=BracketLaw(max(_WALL_LAW.width_mm, spread_mm), _WALL_LAW.foreign))
    fit = fit_pooled(replace(evidence, walls=scattered), state)
    shared = np.tile(_BROKEN_U_MM**2 * np.eye(2), (len(whole), 1, 1))
    shared[whole] = discs.shared
    radius = fit.radius
    if discs.eroded < _ERODED_RADIUS_MAX:  # what all share from the rims, what is each one's own from its bore
        radius = np.where(whole, discs.radius + radius - np.mean(radius[whole]), radius)
    return replace(fit, covariance=fit.covariance + shared, radius=radius, radius_u_mm=discs.radius_u_mm)


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
    return fit_pooled(replace(evidence, rims=kept), state)


def _are_round(mouths: Mouths, fit: PooledFit, pitch_mm: float) -> BoolArray:
    """Whether enough (k,) of what each outline shows lies on its circle: a gap between things is no mouth."""
    behind = mouths.rims.distance(fit.centre) - fit.radius[:, None]
    # Rim points thin out over a few pixels behind the edge.
    on_circle = (behind > -AGREES_MM / 2) & (behind < max(AGREES_MM, 2.5 * pitch_mm)) & mouths.rims.seen
    seen = mouths.rims.seen.mean(axis=1)
    # Where few pixels of a wall come back, a rim that is round wherever it can be judged runs on into it all the same.
    alike = on_circle.mean(axis=1) > _AGREEING_SHARE * seen
    creased = np.where(alike, mouths.coverage - seen, 0.0)
    runs_on = np.where(mouths.wall_count() >= _WALL_COUNT_MIN, 1.0 - seen, creased)
    return np.asarray(on_circle.mean(axis=1) + runs_on > _SOUND_SHARE)


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
    return np.where(count >= _WALL_COUNT_MIN, turn, np.pi)


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


def _points(mouths: Mouths, fit: PooledFit, face: Plane, pitch_mm: float) -> tuple[AssemblyPoint, ...]:
    count = len(mouths.place)
    wear = np.eye(2) * (_WEAR_PITCHES * pitch_mm) ** 2
    return found_points(
        Kind.SLEEVE,
        face,
        np.column_stack([mouths.place + fit.centre, np.zeros(count)]),
        # depth runs against the normal: an axis that gains `lean` per mm of depth points into the column
        np.column_stack([fit.lean, -np.ones(count)]),
        fit.covariance + wear,
        np.full(count, face.residual_mm),
        2 * fit.radius,
        [
            Reason("extract.walls_and_edges", walls=walls, edges=edges, pitch_mm=pitch_mm)
            for walls, edges in zip(fit.wall_count.tolist(), fit.edge_count.tolist(), strict=True)
        ],
        fit.lean_covariance + BORE_LEAN_U**2 * np.eye(2),
        seen_lengths(mouths.wall_depth, mouths.wall_seen),
    )
