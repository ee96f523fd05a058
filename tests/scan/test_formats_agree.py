"""One scan in every format: the same points, whatever the file, the offset and the unit that the file gives."""

import io
import json
from collections.abc import Callable
from pathlib import Path

import laspy
import numpy as np
import pytest

from aadm_workbench.model import Array, Camera
from aadm_workbench.scan.read import read_scan
from aadm_workbench.scan.write import write_depth_tiff, write_pcd, write_ply
from tests.scan.numpy_files import write_npz, write_xyz

from .formats.test_e57 import cartesian, write_e57
from .formats.test_ptx import block

OFFSET_MM = np.array([512_345_678.0, 4_096_000_123.0, 88_000.0])


def write_las(path: Path, points: Array) -> None:
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = [1e-4] * 3, np.floor(points.min(axis=0))
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = points.T
    stream = io.BytesIO()
    cloud.write(stream, do_compress=path.suffix == ".laz")
    path.write_bytes(stream.getvalue())


def write_pts(path: Path, points: Array) -> None:
    rows = "".join(f"{x:.17g} {y:.17g} {z:.17g} 0 1 2 3\n" for x, y, z in points.tolist())
    path.write_text(f"{len(points)}\n{rows}")


WRITERS: dict[str, Callable[[Path, Array], None]] = {
    "ply": write_ply,
    "pcd": write_pcd,
    "xyz": write_xyz,
    "npz": write_npz,
    "pts": write_pts,
    "las": write_las,
    "laz": write_las,
    "ptx": lambda path, points: path.write_text(block(points[:, None])),
    "e57": lambda path, points: write_e57(path, cartesian(points / 1000.0)),
}


@pytest.mark.parametrize("ending", WRITERS)
@pytest.mark.parametrize("offset_mm", [np.zeros(3), OFFSET_MM])
def test_same_points_in_every_format(tmp_path: Path, depth_mm: Array, ending: str, offset_mm: Array) -> None:
    v, u = np.nonzero(np.isfinite(depth_mm))
    points = np.stack([7.0 * u + 0.1, 7.0 * v + 0.2, depth_mm[v, u]], axis=-1) + offset_mm
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, points)
    scan = read_scan(path)
    assert scan.points.dtype == np.float64
    # LAS is written in whole ten-thousandths; the others lose nothing but the last bit of the largest coordinate.
    np.testing.assert_allclose(scan.points, points, rtol=0, atol=6e-5 if ending in ("las", "laz") else 2e-6)
    assert scan.dropped == 0


def test_a_folder_and_its_depth_map_are_the_same_scan(tmp_path: Path, depth_mm: Array, camera: Camera) -> None:
    names = ("fx", "fy", "cx", "cy", "width", "height")
    (tmp_path / "camera.json").write_text(json.dumps({name: getattr(camera, name) for name in names}))
    write_depth_tiff(tmp_path / "depth.tiff", depth_mm, 0.05)
    alone = read_scan(tmp_path / "depth.tiff", camera=camera, depth_scale_mm=0.05)
    np.testing.assert_array_equal(read_scan(tmp_path, depth_scale_mm=0.05).points, alone.points)


def test_a_station_that_cannot_have_seen_its_points_is_no_viewpoint(tmp_path: Path, depth_mm: Array) -> None:
    points = np.stack([*np.indices((48, 64)), np.nan_to_num(depth_mm)], axis=-1)
    (tmp_path / "near.ptx").write_text(block(points))
    (tmp_path / "map.ptx").write_text(block(points + OFFSET_MM))
    assert read_scan(tmp_path / "near.ptx").viewpoint is not None
    assert read_scan(tmp_path / "map.ptx").viewpoint is None
