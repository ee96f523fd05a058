"""Sleeve centres in the scan of a column foot.

The steps: find the foot face, find round holes of the expected size in it, take all points around each
hole, and fit bores and mouth edges of all sleeves together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from aadm_workbench.extract.circle import AGREES_MM
from aadm_workbench.extract.edges.learned_edges import (
    known_edges,
)
from aadm_workbench.extract.edges.lost_rings import gaps_at_steps, rings_dropped, tells_of_rings
from aadm_workbench.extract.edges.seen_disc import sight_lines_on_face
from aadm_workbench.extract.filter_signs import COPIED, copies_depths, filter_signs
from aadm_workbench.extract.foot_face import FootFace, faces_with_holes, level_with_rings
from aadm_workbench.extract.mouth_fits import WALL_COUNT_MIN, fit_as_learned, fit_mouths, with_unseen_edges
from aadm_workbench.extract.mouths import REACH_MM, WALL_DEPTH_MM, Mouths, mouths_in
from aadm_workbench.extract.patches import Patches, patches_around, with_places
from aadm_workbench.extract.plane import axes_on, found_points, from_plane, in_plane, seen_lengths, turned_over
from aadm_workbench.extract.pooled.fit import PooledFit
from aadm_workbench.extract.sample import Thinned, thinned
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    BoolArray,
    CameraProfile,
    Extraction,
    Kind,
    Plane,
    Reason,
    Scan,
    codes_of,
)
from aadm_workbench.model.special import median

_ENOUGH_MOUTHS = 3  # in a plane: what chance leaves in the noise of a wall is not round
_NO_MOUTHS = {"extract.no_hole", "extract.no_measured_hole", "extract.no_round_mouth"}
_SAMPLE = 90_000  # every fifth row and column of 1920 × 1200
BORE_LEAN_U = 2e-3
"""Of a lean: light that bounces in a bore pushes its wall by less or more as it goes deeper."""

_WEAR_PITCHES = 0.04  # how far rims may be worn away unnoticed; it shifts centres along the view
# evenly within three quarters of a pixel either way: edges before a plug mix otherwise than those of the other mouths,
# which tell what the camera does
_PLUG_PITCHES = 0.43
# what a camera bends edges by is told by a flat face; without one it stays in: 0.2 and 0.6 of a pixel on two
# path-traced roughened feet
_UNKNOWN_BEND_PITCHES = 0.3
_ROUGH_U_MM = 0.1  # grains at the rim of a roughened foot, each mouth by itself
# all radii of a roughened foot, whose rims lie at many depths: 18 feet of the twin had 0.36 mm of diameter (rms)
_ROUGH_RADIUS_U_MM = 0.2
# of an outline on its circle, or running on into the wall: half of a taped mouth is more; a choice: ±30 % moves
# nothing on sound scans
_SOUND_SHARE = 0.3
_AGREEING_SHARE = 0.75  # of a rim that is judged: sound ones at 2 m, a tenth of the pixels lost, have 0.8 to 1
_RADIUS_MISFIT = 0.08  # relative: a hole this much larger or smaller than nominal is no sleeve
# behind the face, deeper than its own grain and not as deep as a layer reaches; beside a mouth, its chamfer; nearly all
_BEHIND_MM, _BESIDE_MM, _IN_BORES_SHARE = (3.0, 12.0), 1.5, 0.8


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

    def measured(found: tuple[FootFace, Array, float]) -> Extraction:
        return _in_face(scan, sample, found, diameter_mm, places, others_mm)

    face, seen = _with_most_mouths(faces_with_holes(scan, sample, diameter_mm / 2, rng), measured)
    if face is not None and face.rough:
        # Where plugs close many mouths, what lies behind the face is these, and no layer: then more are round.
        smooth = faces_with_holes(scan, sample, diameter_mm / 2, rng, may_be_rough=False)
        _, as_smooth = _with_most_mouths(smooth, measured)
        if len(as_smooth.points) > len(seen.points) and _lies_in_bores(sample, as_smooth, diameter_mm / 2):
            return as_smooth
    return seen


def _with_most_mouths(
    faces: Iterable[tuple[FootFace, Array, float]], measured: Callable[[tuple[FootFace, Array, float]], Extraction]
) -> tuple[FootFace | None, Extraction]:
    """The face in which most mouths are round, and these; the first with enough of them, where there is one."""
    best: FootFace | None = None
    seen, most = Extraction(Kind.SLEEVE, "refined", (), None, None, reason=Reason("extract.no_face")), (0, 0)
    for found in faces:
        here = measured(found)
        shown = len(here.points), min(len(found[1]), _ENOUGH_MOUTHS)
        if best is None or shown > most:
            best, seen, most = found[0], here, shown
        if len(here.points) >= _ENOUGH_MOUTHS or not _may_be_a_wall(here):
            break
    return best, seen


def _may_be_a_wall(seen: Extraction) -> bool:
    """Whether a plane may be another than the foot's: what is refused for its camera's doings is not sought again."""
    return bool(seen.points) or not _NO_MOUTHS.isdisjoint(codes_of(seen.reason))


def _lies_in_bores(sample: Thinned, seen: Extraction, radius_mm: float) -> bool:
    """Whether what lies behind a face is within its mouths, where plugs are: what keys take away is beside them."""
    if seen.plane is None:
        return False
    local = in_plane(sample.points, seen.plane)
    low = local[(local[:, 2] < -_BEHIND_MM[0]) & (local[:, 2] > -_BEHIND_MM[1]), :2]
    mouths = in_plane(np.array([point.centre for point in seen.points]), seen.plane)[:, :2]
    nearest = np.min([np.hypot(*(low - mouth).T) for mouth in mouths], axis=0)
    return bool(np.mean(nearest < radius_mm + _BESIDE_MM) > _IN_BORES_SHARE)


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

    def measured(others_mm: tuple[float, ...]) -> Extraction:
        others = tuple(other / 2 for other in others_mm)
        mouths = mouths_in(patches, centres, diameter_mm / 2, pitch_mm, others, layer)
        return _measured(mouths, patches, layer, diameter_mm, pitch_mm, scan.learned)

    seen = measured(others_mm)
    if _is_of_another_size(seen, diameter_mm):
        # The circle lies on a part of a larger rim, or of a smaller one, which as a whole is round with its own radius.
        return measured((*others_mm, *(diameter_mm * (1.0 + 2.0 * off) for off in (-_RADIUS_MISFIT, _RADIUS_MISFIT))))
    return seen


def _is_of_another_size(seen: Extraction, diameter_mm: float) -> bool:
    """Whether mouths are all so far off their diameter that another size is likelier."""
    measured_mm = [point.diameter_mm for point in seen.points]
    return bool(measured_mm) and abs(float(median(measured_mm)) / diameter_mm - 1.0) > _RADIUS_MISFIT / 2.0


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
    profile: CameraProfile | None,
) -> Extraction:
    face = layer.plane
    if len(mouths.place) == 0:
        reason = Reason("extract.no_measured_hole", diameter_mm=diameter_mm)
        return Extraction(Kind.SLEEVE, "refined", (), face, -face.normal, reason=reason)
    own = patches.of(mouths.kept)
    lines = sight_lines_on_face(own) if layer.flat else None  # on what is no plane nobody knows where they end
    gaps = gaps_at_steps(own, own.height, mouths.centre, diameter_mm / 2, pitch_mm)
    rings = rings_dropped(gaps)
    fit = fit_mouths(mouths, lines, diameter_mm, pitch_mm, rings)
    if fit is not None and layer.flat and lines is None:
        fit = with_unseen_edges(fit, own, diameter_mm / 2, pitch_mm)
    known, learned = known_edges(profile, Kind.SLEEVE, own.eye, axes_on(face)), dict[str, float]()
    if fit is not None and lines is not None and known is not None:
        fit, off_pitches = fit_as_learned(fit, mouths, lines, diameter_mm / 2, known, rings)
        learned = {"learned_edges_off_pixels": off_pitches}
    if fit is not None and not layer.flat:
        u_mm = float(np.hypot(_ROUGH_U_MM, _UNKNOWN_BEND_PITCHES * pitch_mm))
        fit = replace(fit, covariance=fit.covariance + u_mm**2 * np.eye(2))
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
        Kind.SLEEVE,
        "refined",
        points,
        face,
        -face.normal,
        "foot face",
        quality=quality,
        complete=signs.complete,
        # one ring or two is told by the edges; whether any is, by what lies behind them
        rings=float(min(rings, 1)) if tells_of_rings(gaps) else None,
        noise_seen=layer.flat,
    )


def _are_round(mouths: Mouths, fit: PooledFit, pitch_mm: float) -> BoolArray:
    """Whether enough (k,) of what each outline shows lies on its circle: a gap between things is no mouth."""
    behind = mouths.rims.distance(fit.centre) - fit.outline_radius[:, None]
    # Rim points thin out over a few pixels behind the edge.
    on_circle = (behind > -AGREES_MM / 2) & (behind < max(AGREES_MM, 2.5 * pitch_mm)) & mouths.rims.seen
    seen = mouths.rims.seen.mean(axis=1)
    # Where few pixels of a wall come back, a rim that is round wherever it can be judged runs on into it all the same.
    alike = on_circle.mean(axis=1) > _AGREEING_SHARE * seen
    creased = np.where(alike, mouths.coverage - seen, 0.0)
    runs_on = np.where(mouths.wall_count() >= WALL_COUNT_MIN, 1.0 - seen, creased)
    return np.asarray(on_circle.mean(axis=1) + runs_on > _SOUND_SHARE)


def _points(mouths: Mouths, fit: PooledFit, face: Plane, pitch_mm: float) -> tuple[AssemblyPoint, ...]:
    count = len(mouths.place)
    wear_pitches = np.where(mouths.plugged, _PLUG_PITCHES, _WEAR_PITCHES)
    wear = np.eye(2) * ((wear_pitches * pitch_mm) ** 2)[:, None, None]
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
