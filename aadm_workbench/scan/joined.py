"""Several scans in one file, each from its own station: one cloud in the frame that they share."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.model import Array, FloatArray, Reason
from aadm_workbench.scan.file import Cloud, without_return


def joined(clouds: Sequence[Cloud]) -> Cloud:
    """Return one cloud of the scans of a file; a single scan stays as it is.

    Points without return are left out and counted. Where the scans were taken from one station the joined cloud keeps
    its pose; else no single viewpoint is true of all points, and none is given.

    Parameters
    ----------
    clouds
        At least one; all in one unit.

    Returns
    -------
    Cloud
        Of several: (n, 3) float64, in the frame that their poses lead to, or, with one pose, in the file's own.
    """
    first = clouds[0]
    if len(clouds) == 1:
        return first
    poses = [np.eye(4) if cloud.T_scan_file is None else cloud.T_scan_file for cloud in clouds]
    of_one_station = all(np.array_equal(pose, poses[0]) for pose in poses)
    kept: list[FloatArray] = []
    dropped = sum(cloud.dropped for cloud in clouds)
    for cloud, pose in zip(clouds, poses, strict=True):
        flat = cloud.points.reshape(-1, 3)
        missing = without_return(flat)
        dropped += int(np.count_nonzero(missing))
        points = flat[~missing].astype(np.float64)
        kept.append(points if of_one_station else moved(points, pose))
    return Cloud(
        np.concatenate(kept),
        first.mm_per_unit,
        first.T_scan_file if of_one_station else None,
        unit_from=first.unit_from,
        dropped=dropped,
        notes=(
            Reason("scan.joined", count=len(clouds)),
            *dict.fromkeys(note for cloud in clouds for note in cloud.notes),
        ),
    )


def moved(points: FloatArray, T_to_from: Array) -> Array:
    """Return points (..., 3), moved by a (4, 4) transform, in float64."""
    return np.asarray(points.astype(np.float64) @ T_to_from[:3, :3].T + T_to_from[:3, 3])
