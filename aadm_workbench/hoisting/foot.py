"""Sleeves of a hanging foot: one rigid pose of the known pattern, then every sleeve by its own evidence.

The steps: rays that pass give the pattern a first pose; the far walls of the bores show each sleeve to some hundredths
of a millimetre, but for a push along the rays that they all share; rays near the edges of all mouths tell that push;
and all is put together, with what the pattern knows of sleeves that show little.
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.pooled.evidence import spread, tukey
from aadm_workbench.hoisting.face import FootFace
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.hoisting.mouths import NOISE_SIGMAS, SECTORS, MouthView, open_sectors, sector_of, view_mouth
from aadm_workbench.hoisting.multipath_shift import EdgeRays, Push, find_push
from aadm_workbench.hoisting.pattern_fit import (
    OWN,
    Believed,
    Evidence,
    Pattern,
    State,
    System,
    Terms,
    as_built,
    loosened,
    started,
    wall_terms,
)
from aadm_workbench.model import Array, BoolArray, IntArray

_WALL, _PUSH = range(2)  # places of the bores' radius and push among the pooled unknowns
# about the radius, from a first pose that is right within some mm down to what ribs of 1 mm leave
_BANDS_MM = (6.0, 4.0, 2.5, 1.5, 1.0, 1.0)
_LAST_ROUNDS, _LAST_TRACKED_ROUNDS = 3, 2  # with the push: what the frame before has found is nearer to begin with
_TRACKED_BANDS_MM = (3.0, 1.0)  # about the radius, of a column that moved by some mm since the last frame
_LOOSE_FROM_MM = 2.0  # in narrower bands bores are found: what then stands far from its place is not to pull the others
_WALL_FROM_MM = 1.15  # chamfers end before
_WALL_MAX = 200  # points of a bore: neighbours share their errors, more of them tell no more than so many
_WALL_FEWEST = 25  # points of a bore: as in pooled/fit.py
# neighbouring wall points share their errors: standard errors are this much larger; a choice: ±30 % moves centres by
# up to 0.9 u and u by 6 %
_WALL_CORRELATION = 1.6
_SPREAD_BELIEF = 20  # points: a spread of so few is known to a sixth
_EDGE_REACH_MM = 2.4  # about the bore as its wall appears: pushes and chamfers are smaller
# bores are nominal within this; light that bounces pushes walls by up to 0.8 mm (reference camera)
_RADIUS_SIGMA_MM, _PUSH_SIGMA_MM = 0.4, 0.7
# 0.3 degrees as cast, and half as much for the face they are told against; sleeves of a foot are alike
_LEAN_SIGMA, _OWN_RADIUS_MM = 0.008, 0.06
# floors: no push is known better, whatever the likelihood's curvature says (a choice: ±30 % moves u by 3 %)
_OWN_PUSH_MIN_MM, _PUSH_FLOOR_PITCHES = 0.02, 0.02
_FACE_HEIGHT_SHARE = 0.1  # of the face's scatter: found over frames of 600 to 1,400 mm columns, 0.72 to 1.4 m away
_FLOOR_MM = 0.02  # what the warp of a camera leaves over one mouth, however many points there are
_SHOWN_SHARE = 0.3  # of what returns about most mouths (a choice: ±30 % moves nothing on sound scans)
_SEEN_MM = 0.35  # what is known better than this has evidence of its own


@dataclass(frozen=True, eq=False)
class FootFit:
    """Sleeves (k) of a foot in the axes of its face, mm.

    ``centres`` (k, 2) with their joint ``covariance`` (2k, 2k); ``seen`` (k,) tells which have evidence of their own,
    ``shown`` (k,) about which anything returned at all;
    ``pose`` (3,) lays the pattern on them. ``push`` is that of the walls; ``wall_count`` (k,) their points, and
    ``open_share`` (k,) how much of each mouth lets rays through; ``evidence`` is what the seen ones show by themselves,
    ``state`` all that was fitted.
    """

    centres: Array
    covariance: Array
    seen: BoolArray
    shown: BoolArray
    pose: Array
    radius_mm: float
    push: Push
    wall_count: IntArray
    open_share: Array
    evidence: Evidence
    state: State


def fit_foot(
    frame: HoistingFrame,
    face: FootFace,
    pattern: Pattern,
    pose: Array,
    diameter_mm: float,
    leans: Array | None = None,
    before: FootFit | None = None,
) -> FootFit:
    """Fit the sleeves of a pattern to a frame.

    Parameters
    ----------
    pattern
        Places of the sleeves, by design or as measured before hoisting, and how far they scatter about them.
    pose
        (3,): x, y mm and turn, from the places to the face's axes, within some mm.
    leans
        (k, 2): leans of the sleeves in the face's axes where they are known; upright otherwise.
    before
        What was fitted in the frame before, of the same camera, to begin with: then the search for it is left out.
    """
    radius_mm, noise_mm = diameter_mm / 2, max(face.residual_mm, 0.01)
    state = started(pattern, pose, (radius_mm, 0.0)) if before is None else before.state
    views = [view_mouth(frame, face, centre, radius_mm) for centre in state.centres]
    believed = _believed(len(views), radius_mm, leans)
    walls: list[IntArray] = []
    bands_mm = _BANDS_MM if before is None else _TRACKED_BANDS_MM
    for band_mm in bands_mm:
        walls = [_far_wall(view, state, k, noise_mm, band_mm) for k, view in enumerate(views)]
        walls = _few(walls) if band_mm > bands_mm[-1] else walls
        state, _ = _system(views, walls, state, pattern, believed)[0].stepped(state)
        if band_mm < _LOOSE_FROM_MM:
            pattern = loosened(pattern, state)
    _, wall_mm = _system(views, walls, state, pattern, believed)
    sectors = [
        np.zeros(SECTORS, bool) if view is None else open_sectors(view, state.own[k, :2], radius_mm, noise_mm)
        for k, view in enumerate(views)
    ]
    rays = _edge_rays(views, sectors, walls, state, noise_mm, wall_mm)
    push = find_push(
        rays, float(state.pooled[_WALL]), len(views), _PUSH_SIGMA_MM, None if before is None else before.push
    )
    floor_mm = float(np.hypot(_PUSH_FLOOR_PITCHES * _typical_pitch_mm(rays), _of_face_height_mm(face, state.centres)))
    believed = _with_push(believed, push, floor_mm)
    pattern = as_built(pattern, state, np.array([len(wall) >= _WALL_FEWEST for wall in walls]))
    for _ in range(_LAST_ROUNDS if before is None else _LAST_TRACKED_ROUNDS):
        state, _ = _system(views, walls, state, pattern, believed)[0].stepped(state)
    system, _ = _own_system(views, walls, state, believed)
    alone = deepcopy(system)
    system.add_pattern(pattern, state)
    covariance = system.covariance()[0]
    counts = np.array([len(wall) for wall in walls])
    variances = np.diag(covariance)
    own_mm = np.sqrt(np.where(variances > 0.0, variances, np.inf)).reshape(-1, 2).max(axis=1)
    seen = (counts >= _WALL_FEWEST) & (own_mm < _SEEN_MM)
    return FootFit(
        centres=state.centres,
        covariance=covariance + _FLOOR_MM**2 * np.eye(len(covariance)),
        seen=seen,
        shown=_shown(views),
        pose=state.pose,
        radius_mm=float(state.pooled[_WALL]),
        push=push,
        wall_count=counts,
        open_share=np.array([float(sector.mean()) for sector in sectors]),
        evidence=alone.evidence(state, seen, _FLOOR_MM),
        state=state,
    )


def _shown(views: list[MouthView | None]) -> BoolArray:
    """About which mouths (k,) a fair share of the rays returned."""
    share = np.array([0.0 if view is None else len(view.points) / len(view.rays) for view in views])
    return np.asarray(share > _SHOWN_SHARE * max(float(np.median(share)), float(share.max()) / 4.0))


def _believed(features: int, radius_mm: float, leans: Array | None) -> Believed:
    own = np.zeros((features, OWN - 2))
    if leans is not None:
        own[:, :2] = leans
    sigma = np.tile([_LEAN_SIGMA, _LEAN_SIGMA, 1e-4, _OWN_RADIUS_MM], (features, 1))
    return Believed(np.array([radius_mm, 0.0]), np.array([_RADIUS_SIGMA_MM, 1e-4]), sigma, own)


def _of_face_height_mm(face: FootFace, centres: Array) -> float:
    """What the height of the face, known to a tenth of its scatter, does to where flat rays cross it."""
    away_mm = float(np.median(np.hypot(*(centres - face.eye[:2]).T)))
    return _FACE_HEIGHT_SHARE * face.residual_mm * away_mm / abs(float(face.eye[2]))


def _with_push(believed: Believed, push: Push, floor_mm: float) -> Believed:
    """What the rays tell of the push: of all walls, and of each sleeve's own where they differ among themselves."""
    own_sigma = push.own_sigma
    spread_mm = max(_OWN_PUSH_MIN_MM, _spread_of(push.own, own_sigma))
    share = spread_mm**2 / (spread_mm**2 + own_sigma**2)
    own, sigma = np.array(believed.own), np.array(believed.own_sigma)
    own[:, 2] = share * push.own
    sigma[:, 2] = np.sqrt(share) * own_sigma
    pooled = np.array([believed.pooled[_WALL], push.push_mm])
    pooled_sigma = np.array([believed.pooled_sigma[_WALL], np.hypot(push.sigma_mm, floor_mm)])
    return Believed(pooled, pooled_sigma, sigma, own)


def _typical_pitch_mm(rays: EdgeRays) -> float:
    """Distance between rays across the far rims of the mouths."""
    away = np.einsum("ij,ij->i", rays.about, rays.direction) > 0.7 * np.hypot(rays.about[:, 0], rays.about[:, 1])
    return float(np.median(rays.pitch[away])) if away.any() else 2.0


def _spread_of(values: Array, sigma: Array) -> float:
    """Standard deviation among true values behind measured ones (DerSimonian and Laird's estimate)."""
    weight = sigma**-2.0
    if len(values) < 2:
        return 0.0
    mean = float(weight @ values / weight.sum())
    excess = float(weight @ (values - mean) ** 2) - (len(values) - 1)
    scale = float(weight.sum() - (weight**2).sum() / weight.sum())
    return float(np.sqrt(max(excess, 0.0) / scale)) if scale > 0.0 else 0.0


def _few(walls: list[IntArray]) -> list[IntArray]:
    """Some points of each wall, for a search: which ones hangs on each before them, and all decide in the end."""
    return [wall[:: len(wall) // _WALL_MAX + 1] for wall in walls]


def _far_wall(view: MouthView | None, state: State, k: int, noise_mm: float, band_mm: float) -> IntArray:
    """Indices of the points on the wall that the camera looks at, through the open part of the mouth."""
    if view is None:
        return np.empty(0, np.int64)
    own = state.own[k]
    about = view.points[:, :2] - own[:2] - own[2:4] * view.points[:, 2:] - (state.pooled[_PUSH] + own[4]) * view.slope
    off = np.hypot(about[:, 0], about[:, 1]) - state.pooled[_WALL] - own[5]
    facing = np.einsum("ij,ij->i", about, view.slope) > 0
    deep = view.points[:, 2] > max(_WALL_FROM_MM, NOISE_SIGMAS * noise_mm)
    return np.flatnonzero(facing & deep & (np.abs(off) < band_mm))


def _system(
    views: list[MouthView | None], walls: list[IntArray], state: State, pattern: Pattern, believed: Believed
) -> tuple[System, float]:
    """Normal equations of walls, pattern and beliefs, and how far wall points scatter, mm."""
    system, sigma_mm = _own_system(views, walls, state, believed)
    system.add_pattern(pattern, state)
    return system, sigma_mm


def _own_system(
    views: list[MouthView | None], walls: list[IntArray], state: State, believed: Believed
) -> tuple[System, float]:
    """The same without the pattern: what each sleeve shows by itself."""
    system = System(len(views), len(state.pooled))
    sigma_mm = 0.1
    present = [(k, views[k], wall) for k, wall in enumerate(walls) if len(wall)]
    if present:
        owner = np.concatenate([np.full(len(wall), k) for k, _, wall in present]).astype(np.int64)
        points = np.concatenate([view.points[wall] for _, view, wall in present if view is not None])
        slope = np.concatenate([view.slope[wall] for _, view, wall in present if view is not None])
        residual, own, pooled = wall_terms(points[:, :2], points[:, 2], slope, owner, state, _WALL, _PUSH)
        sigma_mm = max(spread(residual), 0.03)
        own_mm = _own_spreads(residual, owner, np.array([0.0 if v is None else v.range_mm for v in views]), sigma_mm)
        share = np.minimum(1.0, _WALL_MAX / np.bincount(owner)[owner])
        weight = share * tukey(residual / own_mm) / (_WALL_CORRELATION * own_mm) ** 2
        system.add(Terms(own, pooled, weight * residual, weight, owner))
    system.add_beliefs(believed, state)
    return system, sigma_mm


def _own_spreads(residual: Array, owner: IntArray, ranges_mm: Array, pooled_mm: float) -> Array:
    """How far the wall points (n,) of each sleeve scatter, mm: those of far sleeves much more than those of near ones.

    What a sleeve's own points show is drawn towards what all show, which grows with the distance: between the
    unevenness of walls, which does not, and a camera's noise, which grows with its square.
    """
    typical_mm = float(np.median(ranges_mm[owner]))
    found = np.empty(len(residual))
    bounds = np.searchsorted(owner, np.arange(len(ranges_mm) + 1))
    for k in np.unique(owner):
        own = slice(bounds[k], bounds[k + 1])
        expected = pooled_mm * ranges_mm[k] / typical_mm
        count = min(int(bounds[k + 1] - bounds[k]), _WALL_MAX)
        variance = (count * spread(residual[own]) ** 2 + _SPREAD_BELIEF * expected**2) / (count + _SPREAD_BELIEF)
        found[own] = max(np.sqrt(variance), 0.03)
    return found


def _edge_rays(
    views: list[MouthView | None],
    sectors: list[BoolArray],
    walls: list[IntArray],
    state: State,
    noise_mm: float,
    wall_mm: float,
) -> EdgeRays:
    """Rays near the edges of all mouths whose walls are seen."""
    parts = []
    for k, view in enumerate(views):
        if view is not None and len(walls[k]) >= _WALL_FEWEST:
            parts.append(_edge_rays_of(view, sectors[k], state, k, noise_mm, wall_mm))
    if not parts:
        parts = [{name: np.empty((0, 2) if name in ("about", "direction") else 0) for name in _RAY_FIELDS}]
    joined = {name: np.concatenate([part[name] for part in parts]) for name in _RAY_FIELDS}
    joined["owner"] = joined["owner"].astype(np.int64)
    return EdgeRays(**joined)


_RAY_FIELDS = (
    "about",
    "direction",
    "climb",
    "beyond",
    "to_wall",
    "pitch",
    "face_sigma",
    "wall_sigma",
    "sampling",
    "owner",
)


def _edge_rays_of(
    view: MouthView, sectors: BoolArray, state: State, k: int, noise_mm: float, wall_mm: float
) -> dict[str, Array]:
    centre, radius_mm = state.own[k, :2], float(state.pooled[_WALL] + state.own[k, 5])
    about = view.crossing - centre
    distance = np.maximum(np.hypot(about[:, 0], about[:, 1]), 1e-9)
    pitch = view.radial_pitch(about / distance[:, None])
    length = np.hypot(view.slope[:, 0], view.slope[:, 1])
    direction = view.slope / length[:, None]
    climb = np.sqrt(np.maximum(1.0 - length**2, 1e-6)) / length
    used = np.abs(distance - radius_mm) < _EDGE_REACH_MM + 1.2 * pitch
    used &= sectors[sector_of(about)]
    along = np.einsum("ij,ij->i", about, direction)
    to_wall = np.sqrt(np.maximum(radius_mm**2 - distance**2 + along**2, 0.0)) - along
    sampling = _sampling(view, centre, radius_mm, noise_mm)
    chosen = np.flatnonzero(used)
    away = along > 0
    return {
        "about": about[chosen],
        "direction": direction[chosen],
        "climb": climb[chosen],
        "beyond": (view.points[:, 2] / climb)[chosen],
        "to_wall": to_wall[chosen],
        "pitch": pitch[chosen],
        "face_sigma": (noise_mm / climb)[chosen],
        "wall_sigma": np.full(len(chosen), wall_mm),
        "sampling": np.where(away, sampling[0], sampling[1])[chosen],
        "owner": np.full(len(chosen), k),
    }


def _sampling(view: MouthView, centre: Array, radius_mm: float, noise_mm: float) -> tuple[float, float]:
    """Log ratio of how many rays return from inside and from the face, on the far and on the near side of a mouth.

    A camera loses more of a face seen at grazing incidence than of the wall behind it; among the rays that are left
    this moves the odds, and with them the edge, unless it is taken out.
    """
    ratios = []
    ray, point = view.rays - centre, view.crossing - centre
    ray_distance, distance = np.hypot(ray[:, 0], ray[:, 1]), np.hypot(point[:, 0], point[:, 1])
    direction = view.slope.mean(axis=0) if len(view.slope) else np.array([1.0, 0.0])
    behind = view.points[:, 2] > NOISE_SIGMAS * noise_mm
    stopped = np.abs(view.points[:, 2]) < NOISE_SIGMAS * noise_mm
    for side in (1.0, -1.0):
        all_side, side_points = side * (ray @ direction) > 0, side * (point @ direction) > 0
        kept = []
        for low, high, label in (
            (0.45 * radius_mm, 0.9 * radius_mm, behind),
            (radius_mm + 1.5, radius_mm + 6.5, stopped),
        ):
            count = (all_side & (ray_distance > low) & (ray_distance < high)).sum()
            found = (side_points & label & (distance > low) & (distance < high)).sum()
            kept.append((found + 1.0) / (count + 2.0))
        ratios.append(float(np.clip(np.log(kept[0] / kept[1]), -2.5, 2.5)))
    return ratios[0], ratios[1]
