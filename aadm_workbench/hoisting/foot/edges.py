"""Rays near the edges of the mouths of a foot, as :mod:`.multipath_shift` asks them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.hoisting.foot.mouths import NOISE_SIGMAS, MouthView, sector_of
from aadm_workbench.hoisting.foot.walls import WALL, WALL_FEWEST
from aadm_workbench.hoisting.pattern_fit import State
from aadm_workbench.model import Array, BoolArray, IntArray

_EDGE_REACH_MM = 2.4  # about the bore as its wall appears: pushes and chamfers are smaller


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


@dataclass(frozen=True, eq=False)
class EdgeRays:
    """Rays near the edges of mouths, in the axes of the face, mm; sorted by ``owner`` (n,).

    Parameters
    ----------
    about
        (n, 2): where a ray crosses the face, from the centre of its sleeve as its wall appears.
    direction
        (n, 2) unit: the ray in the plan. ``climb`` (n,) is its rise per mm of plan.
    beyond
        (n,): how far beyond the crossing it ended, in the plan.
    to_wall
        (n,): how far beyond the crossing it would end on the wall as it appears.
    pitch
        (n,): width of a pixel across the edge.
    face_sigma, wall_sigma
        (n,): noise of ``beyond`` on either surface.
    sampling
        (n,): log ratio of how many rays return from inside and from the face, around it.
    """

    about: Array
    direction: Array
    climb: Array
    beyond: Array
    to_wall: Array
    pitch: Array
    face_sigma: Array
    wall_sigma: Array
    sampling: Array
    owner: IntArray


def edge_rays(
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
        if view is not None and len(walls[k]) >= WALL_FEWEST:
            parts.append(_rays_of(view, sectors[k], state, k, noise_mm, wall_mm))
    if not parts:
        parts = [{name: np.empty((0, 2) if name in ("about", "direction") else 0) for name in _RAY_FIELDS}]
    joined = {name: np.concatenate([part[name] for part in parts]) for name in _RAY_FIELDS}
    joined["owner"] = joined["owner"].astype(np.int64)
    return EdgeRays(**joined)


def _rays_of(
    view: MouthView, sectors: BoolArray, state: State, k: int, noise_mm: float, wall_mm: float
) -> dict[str, Array]:
    centre, radius_mm = state.own[k, :2], float(state.pooled[WALL] + state.own[k, 5])
    about = view.crossing - centre
    distance = np.maximum(np.hypot(about[:, 0], about[:, 1]), 1e-9)
    pitch = view.radial_pitch(about / distance[:, None])
    length = np.hypot(view.slope[:, 0], view.slope[:, 1])
    direction = view.slope / length[:, None]
    climb = np.sqrt(np.maximum(1.0 - length**2, 1e-6)) / length
    # a pixel more, and a fifth: the rays on both sides of the edge, wherever their grid lies
    used = np.abs(distance - radius_mm) < _EDGE_REACH_MM + 1.2 * pitch
    used &= sectors[sector_of(about)]
    along = np.einsum("ij,ij->i", about, direction)
    to_wall = np.sqrt(np.maximum(radius_mm**2 - distance**2 + along**2, 0.0)) - along
    to_wall = to_wall * (1.0 + climb * (direction @ state.own[k, 2:4]))  # a bore that leans away ends farther
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
            # inside, clear of the edge; on the face, clear of chamfers and within what is viewed about a mouth
            (0.45 * radius_mm, 0.9 * radius_mm, behind),
            (radius_mm + 1.5, radius_mm + 6.5, stopped),  # as above
        ):
            count = (all_side & (ray_distance > low) & (ray_distance < high)).sum()
            found = (side_points & label & (distance > low) & (distance < high)).sum()
            kept.append((found + 1.0) / (count + 2.0))
        # twelve times: what differs by more is covered, and not sampled unlike
        ratios.append(float(np.clip(np.log(kept[0] / kept[1]), -2.5, 2.5)))
    return ratios[0], ratios[1]


def typical_pitch_mm(rays: EdgeRays) -> float:
    """Distance between rays across the far rims of the mouths."""
    # within 45 degrees of straight away
    away = np.einsum("ij,ij->i", rays.about, rays.direction) > 0.7 * np.hypot(rays.about[:, 0], rays.about[:, 1])
    return float(np.median(rays.pitch[away])) if away.any() else 2.0
