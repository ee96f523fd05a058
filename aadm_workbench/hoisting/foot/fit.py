"""Sleeves of a hanging foot: one rigid pose of the known pattern, then every sleeve by its own evidence.

The steps: rays that pass give the pattern a first pose; the far walls of the bores show each sleeve to some hundredths
of a millimetre, but for a push along the rays that they all share; rays near the edges of all mouths tell that push;
and all is put together, with what the pattern knows of sleeves that show little.
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass

import numpy as np

from aadm_workbench.hoisting.foot.edges import edge_rays, typical_pitch_mm
from aadm_workbench.hoisting.foot.face import FootFace
from aadm_workbench.hoisting.foot.mouths import SECTORS, MouthView, open_sectors, view_mouth
from aadm_workbench.hoisting.foot.multipath_shift import Push, find_push
from aadm_workbench.hoisting.foot.walls import WALL, WALL_FEWEST, far_wall, few, own_system, system_of
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.hoisting.pattern_fit import (
    OWN,
    Believed,
    Evidence,
    Pattern,
    State,
    as_built,
    loosened,
    started,
)
from aadm_workbench.model import Array, BoolArray, IntArray

# about the radius, from a first pose that is right within some mm down to what ribs of 1 mm leave
_BANDS_MM = (6.0, 4.0, 2.5, 2.5, 1.5, 1.0, 1.0)
_AFRESH_AT = 3  # of these: by then the pose is known, and each sleeve begins at its place, not where its search has led
_LAST_ROUNDS, _LAST_TRACKED_ROUNDS = 3, 2  # with the push: what the frame before has found is nearer to begin with
_TRACKED_BANDS_MM = (3.0, 1.0)  # about the radius, of a column that moved by some mm since the last frame
_LOOSE_FROM_MM = 2.0  # in narrower bands bores are found: what then stands far from its place is not to pull the others
# bores are nominal within this; light that bounces pushes walls by up to 0.8 mm (reference camera)
_RADIUS_SIGMA_MM, _PUSH_SIGMA_MM = 0.4, 0.7
# 0.3 degrees as cast, and half as much for the face they are told against; sleeves of a foot are alike
_LEAN_SIGMA, _OWN_RADIUS_MM = 0.008, 0.06
# floors: no push is known better, whatever the likelihood's curvature says (a choice: ±30 % moves u by 3 %)
_OWN_PUSH_MIN_MM, _PUSH_FLOOR_PITCHES = 0.02, 0.02
# of the face's scatter and of what it bends by: found over frames of 600 to 1,400 mm columns, 0.72 to 1.4 m away
_FACE_HEIGHT_SHARE = 0.1
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
    walls, wall_mm = list[IntArray](), noise_mm
    bands_mm = _BANDS_MM if before is None else _TRACKED_BANDS_MM
    for number, band_mm in enumerate(bands_mm):
        if before is None and number == _AFRESH_AT:
            state = started(pattern, state.pose, state.pooled.tolist())
        walls = [far_wall(view, state, k, noise_mm, band_mm) for k, view in enumerate(views)]
        walls = few(walls) if band_mm > bands_mm[-1] else walls
        system, wall_mm = system_of(views, walls, state, pattern, believed)
        state, _ = system.stepped(state)
        if band_mm < _LOOSE_FROM_MM:
            pattern = loosened(pattern, state)
    sectors = [
        np.zeros(SECTORS, bool) if view is None else open_sectors(view, state.own[k, :2], radius_mm, noise_mm)
        for k, view in enumerate(views)
    ]
    rays = edge_rays(views, sectors, walls, state, noise_mm, wall_mm)
    push = find_push(
        rays, float(state.pooled[WALL]), len(views), _PUSH_SIGMA_MM, None if before is None else before.push
    )
    floor_mm = float(np.hypot(_PUSH_FLOOR_PITCHES * typical_pitch_mm(rays), _of_face_height_mm(face, state.centres)))
    believed = _with_push(believed, push, floor_mm)
    pattern = as_built(pattern, state, np.array([len(wall) >= WALL_FEWEST for wall in walls]))
    for _ in range(_LAST_ROUNDS if before is None else _LAST_TRACKED_ROUNDS):
        state, _ = system_of(views, walls, state, pattern, believed)[0].stepped(state)
    system, _ = own_system(views, walls, state, believed)
    alone = deepcopy(system)
    system.add_pattern(pattern, state)
    covariance = system.covariance()[0]
    counts = np.array([len(wall) for wall in walls])
    variances = np.diag(covariance)
    own_mm = np.sqrt(np.where(variances > 0.0, variances, np.inf)).reshape(-1, 2).max(axis=1)
    seen = (counts >= WALL_FEWEST) & (own_mm < _SEEN_MM)
    return FootFit(
        centres=state.centres,
        covariance=covariance + _FLOOR_MM**2 * np.eye(len(covariance)),
        seen=seen,
        shown=_shown(views),
        pose=state.pose,
        radius_mm=float(state.pooled[WALL]),
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
    # no push until the rays tell it: held at none
    sigma = np.tile([_LEAN_SIGMA, _LEAN_SIGMA, 1e-4, _OWN_RADIUS_MM], (features, 1))
    return Believed(np.array([radius_mm, 0.0]), np.array([_RADIUS_SIGMA_MM, 1e-4]), sigma, own)  # as above


def _of_face_height_mm(face: FootFace, centres: Array) -> float:
    """What the height of the face, known to a tenth of its scatter, does to where flat rays cross it."""
    away_mm = float(np.median(np.hypot(*(centres - face.eye[:2]).T)))
    height_mm = _FACE_HEIGHT_SHARE * float(np.hypot(face.residual_mm, face.bend_mm))
    return height_mm * away_mm / abs(float(face.eye[2]))


def _with_push(believed: Believed, push: Push, floor_mm: float) -> Believed:
    """What the rays tell of the push: of all walls, and of each sleeve's own where they differ among themselves."""
    own_sigma = push.own_sigma
    spread_mm = max(_OWN_PUSH_MIN_MM, _spread_of(push.own, own_sigma))
    share = spread_mm**2 / (spread_mm**2 + own_sigma**2)
    own, sigma = np.array(believed.own), np.array(believed.own_sigma)
    own[:, 2] = share * push.own
    sigma[:, 2] = np.sqrt(share) * own_sigma
    pooled = np.array([believed.pooled[WALL], push.push_mm])
    pooled_sigma = np.array([believed.pooled_sigma[WALL], np.hypot(push.sigma_mm, floor_mm)])
    return Believed(pooled, pooled_sigma, sigma, own)


def _spread_of(values: Array, sigma: Array) -> float:
    """Standard deviation among true values behind measured ones (DerSimonian and Laird's estimate)."""
    weight = sigma**-2.0
    if len(values) < 2:
        return 0.0
    mean = float(weight @ values / weight.sum())
    excess = float(weight @ (values - mean) ** 2) - (len(values) - 1)
    scale = float(weight.sum() - (weight**2).sum() / weight.sum())
    return float(np.sqrt(max(excess, 0.0) / scale)) if scale > 0.0 else 0.0
