"""Columns measured with and without what was learned of their camera on a plate: errors, and how many regions hold.

``python -m benchmarks.calibration.learned --seed 2 --filter rings=1`` makes a camera whose scale is off by 0.05 %,
learns it from captures of a plate, and measures others with it, whose sleeves are of other metal. A scan takes seconds.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from aadm_workbench.calibration.learn.capture import captured_plate
from aadm_workbench.calibration.learn.learn import learned
from aadm_workbench.calibration.learn.profile import profile_of
from aadm_workbench.calibration.plate.plate import drawn_plate
from aadm_workbench.extract.edges.learned_edges import with_learned_stretch
from aadm_workbench.extract.plane import axes_on
from aadm_workbench.extract.rebars import extract_rebars
from aadm_workbench.extract.sleeves import extract_sleeves
from aadm_workbench.model import Array, CameraProfile, Extraction, Kind, Plane, Scan
from aadm_workbench.twin.filters import filters_of
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.pair import CAMERAS, Shoot, Taken, with_filters
from aadm_workbench.twin.plate import made_plate, plate_captures
from aadm_workbench.twin.scene import TrueScan
from aadm_workbench.twin.scenes import FIELD, random_bars, random_foot, random_pose

_SCALE = 5e-4
_HOLDS = 5.991  # chi-squared, 95 %, two degrees of freedom
_EXTRACT: dict[Kind, tuple[Callable[..., Extraction], float]] = {
    Kind.SLEEVE: (extract_sleeves, FIELD.sleeve_diameter),
    Kind.REBAR: (extract_rebars, FIELD.bar_diameter),
}


def main() -> None:
    """Print a line for each kind, without and with the profile."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--camera", choices=tuple(CAMERAS), default="ray")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--captures", type=int, default=4)
    parser.add_argument("--columns", type=int, default=3)
    parser.add_argument("--filter", action="append", default=[])
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    noise = replace(CameraNoise.drawn(rng), scale=float(rng.choice([-1.0, 1.0])) * _SCALE)
    taken = Taken(options.camera, filters_of(options.filter))
    profile = _learned(noise, taken, options.captures, rng)
    found: dict[tuple[Kind, bool], list[Array]] = {}
    for _ in range(options.columns):
        for kind, scan in _column(noise, taken, rng).items():
            for with_profile in (False, True):
                judged = _judged(scan, kind, profile if with_profile else None)
                found.setdefault((kind, with_profile), []).append(judged)
    for (kind, with_profile), parts in found.items():
        error, squared = np.concatenate(parts).T
        named = f"{kind.plural}, {'with' if with_profile else 'without'} a profile"
        print(f"{named}: median {np.median(error):.3f} mm, regions {np.mean(squared < _HOLDS):.0%}, {len(error)}")


def _learned(noise: CameraNoise, taken: Taken, count: int, rng: np.random.Generator) -> CameraProfile:
    made = made_plate(drawn_plate(12, 36.0, 160.0, 20.0), rng)
    shots = plate_captures(made, count, noise, taken, rng)
    captures = [captured_plate(shot.scan(f"plate {number}"), made.measured) for number, shot in enumerate(shots)]
    return profile_of(learned(captures, made.measured), made.measured, "", "", "", 90)


def _column(noise: CameraNoise, taken: Taken, rng: np.random.Generator) -> dict[Kind, TrueScan]:
    """A foot and its bars; light in its sleeves goes otherwise than in the plate's tubes."""
    other = CameraNoise.drawn(rng)
    own = replace(noise, wall_bias=other.wall_bias, wall_loss=other.wall_loss)
    shoot: Shoot = with_filters(CAMERAS[taken.camera](FIELD.distance, own), taken.filters)
    foot, bars = random_foot(FIELD, rng), random_bars(FIELD, rng)
    return {
        Kind.SLEEVE: shoot(foot, random_pose(FIELD, True, rng), rng),
        Kind.REBAR: shoot(bars, random_pose(FIELD, False, rng), rng),
    }


def _judged(shot: TrueScan, kind: Kind, profile: CameraProfile | None) -> Array:
    """(n, 2): error in the face, mm, and its square in units of what was stated."""
    extract, diameter_mm = _EXTRACT[kind]
    scan: Scan = replace(shot.scan(), learned=profile)
    found = with_learned_stretch(extract(scan, diameter_mm, np.random.default_rng(1)), profile)
    edges = None if profile is None else profile.edges[kind]
    scale = shot.camera.scale_error if edges is None else float(np.hypot(edges.stretch.u, edges.spread))
    true, rows = shot.points_scan(), []
    assert found.vertical is not None, found.reason
    flat = axes_on(Plane(found.vertical, 0.0))[:2]
    for point in found.points:
        nearest = true[np.linalg.norm(true - point.centre, axis=1).argmin()]
        off, out = flat @ (point.centre - nearest), flat @ nearest
        assert point.covariance is not None
        covariance = flat @ point.covariance @ flat.T + scale**2 * np.outer(out, out)
        rows.append((float(np.hypot(*off)), float(off @ np.linalg.solve(covariance, off))))
    return np.array(rows)


if __name__ == "__main__":
    main()
