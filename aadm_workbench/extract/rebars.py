"""Centres of connecting rebars in a scan of their tops.

The steps: find the floor and with it the bars' vertical, find upright discs of the expected size, fit a
plane to each top (tops differ by centimetres: no common plane), and fit the outlines of all tops and the
visible sides of all bars together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.extract.bars_in_scan import ABOVE_FLOOR_MM, Standing, find_standing, standing_along, top_heights
from aadm_workbench.extract.circle import AGREES_MM, agreeing_shares
from aadm_workbench.extract.edges.bend import Bend, bend_at_edges, no_bend
from aadm_workbench.extract.edges.edge_shift import PARTS_VIEW_MM, eroded_rings, shift_of_tops
from aadm_workbench.extract.edges.learned_edges import (
    LEARNED_BAND_MM,
    KnownEdges,
    known_edges,
    with_learned_discs,
    without_losses,
)
from aadm_workbench.extract.edges.lost_rings import gaps_at_steps, rings_dropped
from aadm_workbench.extract.edges.seen_disc import SightLines, seen_discs, sight_lines_on_tops
from aadm_workbench.extract.filter_signs import COPIED, copies_depths, filter_signs
from aadm_workbench.extract.own_tops import TopPlanes, top_planes
from aadm_workbench.extract.patches import Patches, patches_around, with_places
from aadm_workbench.extract.plane import axes_on, found_points, in_plane, seen_lengths
from aadm_workbench.extract.pooled.evidence import BracketLaw, RimLaw, Rims, Walls
from aadm_workbench.extract.pooled.fit import (
    BAR_PRIORS,
    RADII_REACH_MM,
    CircleEvidence,
    Evidence,
    PooledFit,
    believed_leans,
    fit_pooled,
    likeliest_circles,
)
from aadm_workbench.extract.pooled.system import Priors, State
from aadm_workbench.extract.sample import Thinned, thinned
from aadm_workbench.extract.tops import BENT_TOP_BAND_MM, REACH_MM, Tops, burr_u_mm, tops_in, with_sides_that_lean
from aadm_workbench.model import Array, AssemblyPoint, Extraction, Kind, Plane, Reason, Scan
from aadm_workbench.model.special import median

_SAMPLE = 90_000  # every fifth row and column of 1920 × 1200
_START_DEPTH_MM = 15.0  # of a side below its top: bars that lean as usual move by 0.08 mm there
_RADIUS_MISFIT = 0.15  # relative: bars of the next size are measured, too, and then told to be of another
# of an outline that lies on its circle: burrs and breaks leave more; a choice: ±30 % moves nothing on sound scans
_SOUND_SHARE = 0.55
_OUT_OF_ROUND = 0.2  # of the radius: what is farther off its circle, lost rings or not, lies on another
_SHAPE_U_PITCHES = 0.08, 0.16  # what ribs leave of the departure from a circle: edge held from both sides, or from one
_FIT_SHARE = 0.65  # the fit's own covariance has neighbours share more of their errors than they do
# of an outline that ribs and strays put inside; what a top that is spoilt all round may be off (a choice: ±30 % moves
# u by 22 %)
_USUAL_SPOILT, _SPOILT_U_MM = 0.13, 1.5
# how rays that pass a top thin out away from it, and how many of them fly (a choice: ±30 % moves centres by up to 1.0
# u and u by 6 %)
_BEYOND_TAIL_MM, _FLYING = 1.2, 0.05
_FOREIGN = 0.3  # share of outline points that are ribs
# of an edge, pitches; where outline points thin out (±30 % moves centres by 0.3 and 1.0 u, and u by 1 and 6 %)
_SOFTNESS, _RIM_TAIL_PITCHES = 0.08, 1.2
_SIDE_LAW = BracketLaw(0.08, 0.8)  # most of a side's points lie on ribs
_INSIDE_MM, _FAR_MM = 0.3, 1.0  # what lies so far out, or in, is of no sound disc (±30 % moves u by up to 46 %)

_TURNING_PRIORS = replace(BAR_PRIORS, lean=0.1)  # before the vertical is known bars lean by degrees
# of the size looked for: cores have 0.94 to 1.03 of it, outlines a few hundredths more or less; each look finds more
_OF_SIZE, _SIZES_TRIED = (0.9, 1.06), 3
_NEAR_THE_REACH = 0.75  # of the search for radii: what the fit brings back from its edge
_NEAR_DISC_MM = 1.5  # between a disc and the fit: filters and ribs move one by less, a hidden top by more
_ASIDE_MM = 4.0  # a patch reaches 14 mm beyond its bar, and what passes a top is looked at 6 mm beyond it
_TURNS = 3  # each is seen along what the last one's bars show: a choice, not tuned since


@dataclass(frozen=True, eq=False)
class _Bars:
    """What bars show along one vertical, the fit to it, and their points in the scan frame."""

    tops: Tops
    fit: PooledFit
    points: tuple[AssemblyPoint, ...]
    complete: bool
    rings: float | None
    dropped_mm: float


def extract_rebars(
    scan: Scan,
    diameter_mm: float,
    rng: np.random.Generator,
    places: Array | None = None,
    others_mm: tuple[float, ...] = (),
) -> Extraction:
    """Centres of the tops of all bars of one diameter.

    Parameters
    ----------
    scan
        Organised or not; points in mm, scan frame.
    diameter_mm
        Nominal diameter of the bars.
    rng
        Draws the thinned sample and the plane hypotheses.
    places
        (k, 3) mm, scan frame: where else to look for a bar that the search did not find.
    others_mm
        Diameters of other bars in the same group: what is nearer to one of these is left out.
    """
    if copies_depths(scan):
        return _nothing(COPIED)
    sample, sizes_mm = thinned(scan, _SAMPLE, rng), (diameter_mm, *others_mm)
    standing = find_standing(sample, diameter_mm / 2, scan.viewpoint, rng)
    if standing is not None and standing.floor is None:
        standing = _turned_to_the_bars(scan, sample, standing, sizes_mm, rng)
    if standing is None:
        return _nothing(Reason("extract.no_upright_bar", diameter_mm=diameter_mm))
    bars = _measured(scan, sample, standing, places, sizes_mm, BAR_PRIORS, rng)
    for _ in range(_SIZES_TRIED):
        if isinstance(bars, str) or _is_of_size(bars, sizes_mm[0]):
            break
        sizes_mm = (2.0 * float(median(bars.fit.outline_radius)), *others_mm)
        bars = _measured(scan, sample, standing, places, sizes_mm, BAR_PRIORS, rng)
    if isinstance(bars, str):
        return _nothing(bars)
    return _extraction(bars, standing, diameter_mm)


def _is_of_size(bars: _Bars, diameter_mm: float) -> bool:
    low, high = _OF_SIZE
    radius_mm = float(median(bars.fit.outline_radius))
    at_the_edge = abs(radius_mm - diameter_mm / 2) > _NEAR_THE_REACH * RADII_REACH_MM
    return low < 2.0 * radius_mm / diameter_mm < high and not at_the_edge


def _turned_to_the_bars(
    scan: Scan, sample: Thinned, standing: Standing, sizes_mm: tuple[float, ...], rng: np.random.Generator
) -> Standing | None:
    """Without a floor the vertical is the bars' own: seen along a first guess, it comes from their sides."""
    for _ in range(_TURNS):
        bars = _measured(scan, sample, standing, None, sizes_mm, _TURNING_PRIORS, rng)
        if isinstance(bars, str):
            return standing
        turned = standing_along(sample, _mean_axis(bars.points), sizes_mm[0] / 2)
        if turned is None:
            return standing
        standing = turned
    return standing


def _measured(
    scan: Scan,
    sample: Thinned,
    standing: Standing,
    places: Array | None,
    sizes_mm: tuple[float, ...],
    priors: Priors,
    rng: np.random.Generator,
) -> _Bars | str:
    """The bars of the first of some diameters, seen along one vertical; the reason where none can be measured."""
    radius_mm, *others_mm = (size / 2 for size in sizes_mm)
    level = Plane(standing.vertical, standing.level_mm)
    centres = standing.centres
    if places is not None and len(places):
        centres = with_places(centres, in_plane(places, level)[:, :2], radius_mm)
    own_mm = _own_levels(scan, sample, level, centres, radius_mm)
    patches = patches_around(scan, sample, level, centres, radius_mm + REACH_MM, own_mm)
    beside = None if patches.columns else in_plane(sample.points, level)
    planes = top_planes(patches, radius_mm, rng)
    tops = tops_in(patches, centres, radius_mm, rng, tuple(others_mm), beside, planes)
    if len(tops.place) == 0:
        return Reason("extract.no_top", diameter_mm=sizes_mm[0])
    lines = _lines(patches, planes, tops)
    bend = _bend(lines, tops, radius_mm)
    pitch_mm = float(median(tops.pitch_mm))
    signs = filter_signs(patches.of(tops.kept), tops.centre, radius_mm, pitch_mm, -1.0)
    if reason := signs.reason(blurred=bend.blurred):
        return reason
    if bend.bent:
        wide = tops_in(patches, centres, radius_mm, rng, tuple(others_mm), beside, planes, BENT_TOP_BAND_MM)
        if len(wide.place):
            tops, lines = wide, _lines(patches, planes, wide)
    fit = _fit(tops, radius_mm, priors)
    leaning = with_sides_that_lean(tops, patches, planes, fit.centre, radius_mm)
    if leaning is not tops:
        tops, fit = leaning, _fit(leaning, radius_mm, priors)
    fit, rings = _shifted(fit, tops, lines, bend)
    own = patches.of(tops.kept)
    counted = rings_dropped(gaps_at_steps(own, planes.of(tops.kept).height(own), tops.centre, radius_mm, pitch_mm))
    # Where rings were dropped edges stand that much inside, however well they go with the size that was looked for.
    fit = replace(fit, radius_u_mm=max(fit.radius_u_mm, counted * pitch_mm))
    known, lost_mm = known_edges(scan.learned, Kind.REBAR, own.eye, axes_on(level)), 0.0
    if lines is not None and known is not None:
        fit, lost_mm = _drawn_to_discs(fit, lines, known), known.most_lost_mm
    points = _points(tops, fit, priors.lean, level, lost_mm)
    return _Bars(tops, fit, points, signs.complete, rings, (rings or 0.0) * bend.pitch_mm)


def _own_levels(scan: Scan, sample: Thinned, level: Plane, centres: Array, radius_mm: float) -> Array:
    """How far over the level (k,) mm each top is looked for: as far as would show it beside its patch, or nought."""
    if scan.viewpoint is None:
        return np.zeros(len(centres))
    own_mm = np.nan_to_num(top_heights(sample.points, level.normal, centres, radius_mm) - level.offset)
    eye = in_plane(scan.viewpoint[None], level)[0]
    aside_mm = np.hypot(*(centres - eye[:2]).T) * np.abs(own_mm) / max(float(eye[2]), 1e-9)
    return np.where(aside_mm > _ASIDE_MM, own_mm, 0.0)


def _lines(patches: Patches, planes: TopPlanes, tops: Tops) -> SightLines | None:
    """The lines of sight about each kept top, crossing its plane."""
    own, cuts = patches.of(tops.kept), planes.of(tops.kept)
    return sight_lines_on_tops(own, cuts.normal, cuts.offset, cuts.height(own))


def _bend(lines: SightLines | None, tops: Tops, radius_mm: float) -> Bend:
    pitch_mm = float(median(tops.pitch_mm))
    if lines is None:
        return no_bend(pitch_mm, -1.0)
    seen = seen_discs(lines, np.abs(lines.height) < BENT_TOP_BAND_MM, tops.centre, radius_mm, pitch_mm, -1.0)
    return bend_at_edges(lines, seen.centre, seen.radius, pitch_mm, -1.0)


def _shifted(fit: PooledFit, tops: Tops, lines: SightLines | None, bend: Bend) -> tuple[PooledFit, float | None]:
    """The fit without the shift that all its centres share, as far as known, and how many rings are lost, if known."""
    if lines is None:
        return fit, None
    eroded = eroded_rings(tops.beyond, tops.rims, fit.centre, bend.pitch_mm)
    shift = shift_of_tops(lines.slope, bend, eroded)
    covariance = _FIT_SHARE**2 * fit.covariance + shift.covariance
    shifted = replace(fit, centre=fit.centre - shift.mean, covariance=covariance, radius_u_mm=shift.radius_u_mm)
    return shifted, eroded


def _drawn_to_discs(fit: PooledFit, lines: SightLines, known: KnownEdges) -> PooledFit:
    """The fit, its centres drawn to discs of lines of sight set right by what was learned of the camera."""
    lines, on = without_losses(lines, fit.centre, -1.0, known), np.abs(lines.height) < LEARNED_BAND_MM
    discs = seen_discs(lines, on, fit.centre, float(median(fit.outline_radius)), known.pitch_mm, -1.0)
    near = np.hypot(*(discs.centre - fit.centre).T) < _NEAR_DISC_MM
    return with_learned_discs(fit, discs, near, lines.slope, known, PARTS_VIEW_MM[-1.0])


def _fit(tops: Tops, radius_mm: float, priors: Priors) -> PooledFit:
    pitch_mm = float(median(tops.pitch_mm))
    beyond = Rims(tops.beyond.xy, tops.beyond.seen, 1.0, RimLaw(pitch_mm, _BEYOND_TAIL_MM, _FLYING, softness=_SOFTNESS))
    rims = Rims(
        tops.rims.xy, tops.rims.seen, -1.0, RimLaw(pitch_mm, _RIM_TAIL_PITCHES * pitch_mm, _FOREIGN, softness=_SOFTNESS)
    )
    shown = [
        CircleEvidence(beyond.xy, beyond.seen, beyond.law, beyond.side),
        CircleEvidence(rims.xy, rims.seen, rims.law, rims.side),
        CircleEvidence(tops.side_xy, tops.side_seen & (tops.side_depth < _START_DEPTH_MM), _SIDE_LAW, -1.0),
    ]
    start, radius_mm = likeliest_circles(shown, tops.centre, radius_mm)
    walls = Walls(tops.side_xy, tops.side_depth, np.zeros_like(tops.side_xy), tops.side_seen, _SIDE_LAW)
    return fit_pooled(Evidence(beyond, rims, walls, radius_mm, priors), State(start, radius_mm))


def _nothing(reason: str) -> Extraction:
    return Extraction(Kind.REBAR, "refined", (), None, None, reason=reason)


def _extraction(bars: _Bars, standing: Standing, diameter_mm: float) -> Extraction:
    tops, fit = bars.tops, bars.fit
    # where a filter drops rings, it does so on the side of the step alone: outlines are that much out of round
    within_mm = max(AGREES_MM, 2.0 * float(median(tops.pitch_mm)))
    within_mm = max(within_mm, min(within_mm + bars.dropped_mm, _OUT_OF_ROUND * diameter_mm / 2))
    agree = agreeing_shares(tops.rims, fit.centre, fit.outline_radius, within_mm)
    off = 2 * fit.outline_radius / diameter_mm - 1.0
    right = (off < _RADIUS_MISFIT) & (off > -_RADIUS_MISFIT - 2 * bars.dropped_mm / diameter_mm)
    sound = np.flatnonzero(right & (agree > _SOUND_SHARE)).tolist()
    points = tuple(bars.points[k] for k in sound if _stands_out(bars.points[k], standing.floor))
    if not points:
        return _nothing(Reason("extract.no_round_top", diameter_mm=diameter_mm))
    vertical, source = standing.vertical, "floor"
    if standing.floor is None:
        vertical, source = _mean_axis(points), "bar axes"
    exposed = tuple(_exposed(point, standing.floor) for point in points)
    tops_level = Plane(vertical, float(median([vertical @ point.centre for point in points])))
    quality = {
        "point_pitch_mm": float(median(tops.pitch_mm)),
        "plane_residual_mm": float(median(tops.residual_mm)),
        "diameter_u_mm": 2.0 * fit.radius_u_mm,
        "edge_coverage": float(np.mean(tops.rims.coverage)),
        "edge_residual_mm": fit.edge_mm,
        "wall_residual_mm": fit.wall_mm,
        "wall_points": int(fit.wall_count.sum()),
    }
    found = Extraction(Kind.REBAR, "refined", points, tops_level, vertical, source, exposed, quality)
    return replace(found, complete=bars.complete, rings=bars.rings)


def _points(tops: Tops, fit: PooledFit, lean_prior: float, level: Plane, lost_mm: float) -> tuple[AssemblyPoint, ...]:
    over = np.einsum("ki,ki->k", tops.normal[:, :2], fit.centre)
    height = (tops.offset - over) / tops.normal[:, 2]
    shape = _shape_u_mm(tops, fit, lost_mm)[:, None, None] ** 2 * np.eye(2)
    lean, lean_covariance = believed_leans(fit, lean_prior)
    return found_points(
        Kind.REBAR,
        level,
        np.column_stack([tops.place + fit.centre, height]),
        np.column_stack([-lean, np.ones(len(height))]),
        fit.covariance + shape,
        tops.residual_mm,
        2 * fit.outline_radius,
        [
            Reason("extract.edges_and_sides", edges=edges, sides=sides)
            for edges, sides in zip(fit.edge_count.tolist(), fit.wall_count.tolist(), strict=True)
        ],
        lean_covariance,
        seen_lengths(tops.side_depth, tops.side_seen),
    )


def _shape_u_mm(tops: Tops, fit: PooledFit, lost_mm: float) -> Array:
    """What each top's departure from a disc may hide (k,): ribs, and more where a burr or a broken piece spoils it.

    What a camera is known to lose, up to ``lost_mm`` behind edges, spoils nothing.
    """
    count = np.maximum(tops.rims.seen.sum(axis=1), 1)
    behind = np.where(tops.rims.seen, fit.outline_radius[:, None] - tops.rims.distance(fit.centre), 0.0)
    spoilt = np.maximum((behind < -_INSIDE_MM).sum(axis=1) / count - _USUAL_SPOILT, 0.0)
    spoilt += 0.5 * (behind > _FAR_MM + lost_mm).sum(axis=1) / count + 0.5 * (1.0 - tops.rims.coverage)
    held = tops.beyond.seen.sum(axis=1) > 0.5 * count
    ribs = np.where(held, *_SHAPE_U_PITCHES) * tops.pitch_mm
    burrs = burr_u_mm(tops.rims, fit.centre, float(median(fit.outline_radius)))
    return np.asarray(np.hypot(np.hypot(ribs, burrs), _SPOILT_U_MM * spoilt))


def _mean_axis(points: tuple[AssemblyPoint, ...]) -> Array:
    """Robust mean of the bar axes: their median, made a unit vector."""
    middle = median([point.axis for point in points], axis=0)
    return np.asarray(middle / np.linalg.norm(middle))


def _stands_out(point: AssemblyPoint, floor: Plane | None) -> bool:
    """Whether a top is no part of the floor: shadows and stirrups leave round pieces of it."""
    return floor is None or float(floor.height(point.centre)) > ABOVE_FLOOR_MM


def _exposed(point: AssemblyPoint, floor: Plane | None) -> float | None:
    """Length of the bar from the floor to its top along its own axis."""
    if floor is None:
        return None
    return float(floor.height(point.centre) / max(float(point.axis @ floor.normal), 0.5))
