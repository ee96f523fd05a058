"""E57, written by another program: all ways to store coordinates, poses, invalid points, files that lie."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pye57 import libe57

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, FloatArray
from aadm_workbench.scan.formats.e57 import NO_ROTATION
from aadm_workbench.scan.read import read_scan

NAMESPACE = "http://www.astm.org/COMMIT/E57/2010-e57-v1.0"
SCALE_M = 1e-6


def number(image: Any, name: str, kind: str) -> Any:
    """Prototype of one field: floats of 32 and 64 bits, whole micrometres, whole numbers."""
    if "Invalid" in name or "Index" in name:
        return libe57.IntegerNode(image, 0, 0, 2 if "Invalid" in name else 4095)
    if kind == "scaled":
        return libe57.ScaledIntegerNode(image, 0, -(2**31), 2**31 - 1, SCALE_M, 0.0)
    precision = libe57.E57_SINGLE if kind == "single" else libe57.E57_DOUBLE
    return libe57.FloatNode(image, 0.0, precision, -1e9, 1e9)


def write_e57(
    path: Path, *scans: Mapping[str, Array], kind: str = "double", poses: tuple[tuple[Array, Array] | None, ...] = ()
) -> None:
    """Write scans of named fields (n,); a pose is a quaternion w x y z and a translation, m."""
    image = libe57.ImageFile(str(path), "w")
    image.extensionsAdd("", NAMESPACE)
    root = image.root()
    root.set("formatName", libe57.StringNode(image, "ASTM E57 3D Imaging Data File"))
    root.set("guid", libe57.StringNode(image, "{0}"))
    data = libe57.VectorNode(image, True)
    root.set("data3D", data)
    for number_of_scan, values in enumerate(scans):
        node = libe57.StructureNode(image)
        data.append(node)
        if number_of_scan < len(poses) and (pose := poses[number_of_scan]) is not None:
            node.set("pose", pose_node(image, *pose))
        prototype = libe57.StructureNode(image)
        buffers = libe57.VectorSourceDestBuffer()
        columns = {name: np.array(column, np.float64) for name, column in values.items()}
        for name, column in columns.items():
            prototype.set(name, number(image, name, kind))
            buffers.append(libe57.SourceDestBuffer(image, name, column, len(column), True, True))
        vector = libe57.CompressedVectorNode(image, prototype, libe57.VectorNode(image, True))
        node.set("points", vector)
        writer = vector.writer(buffers)
        writer.write(len(next(iter(columns.values()))))
        writer.close()
    image.close()


def pose_node(image: Any, quaternion: Array, translation: Array) -> Any:
    node = libe57.StructureNode(image)
    for name, keys, values in (("rotation", "wxyz", quaternion), ("translation", "xyz", translation)):
        child = libe57.StructureNode(image)
        for key, value in zip(keys, values, strict=True):
            child.set(key, libe57.FloatNode(image, float(value)))
        node.set(name, child)
    return node


def cartesian(points_m: FloatArray) -> dict[str, Array]:
    return {f"cartesian{axis}": column for axis, column in zip("XYZ", points_m.T.astype(np.float64), strict=True)}


def spherical(points_m: Array) -> dict[str, Array]:
    x, y, z = points_m.T
    distance = np.linalg.norm(points_m, axis=1)
    return {
        "sphericalRange": distance,
        "sphericalAzimuth": np.arctan2(y, x),
        "sphericalElevation": np.arcsin(z / distance),
    }


@pytest.mark.parametrize(("kind", "error_mm"), [("double", 1e-9), ("single", 1e-3), ("scaled", 0.0006)])
def test_cartesian_coordinates_are_metres(tmp_path: Path, cloud: FloatArray, kind: str, error_mm: float) -> None:
    write_e57(tmp_path / "scan.e57", cartesian(cloud.astype(np.float64) / 1000.0), kind=kind)
    scan = read_scan(tmp_path / "scan.e57")
    np.testing.assert_allclose(scan.points, cloud, rtol=0, atol=error_mm)
    assert (scan.dropped, scan.viewpoint) == (0, None)
    assert scan.notes == ("the unit of the file was taken, 1000 mm: an E57 file is in metres",)
    assert read_scan(tmp_path / "scan.e57", units="m").notes == ()


@pytest.mark.parametrize("kind", ["double", "scaled"])
def test_spherical_coordinates(tmp_path: Path, cloud: FloatArray, kind: str) -> None:
    write_e57(tmp_path / "scan.e57", spherical(cloud.astype(np.float64) / 1000.0), kind=kind)
    # Half a microradian at the furthest point, where angles are stored in whole ones.
    error_mm = 1e-9 if kind == "double" else 0.0006 + 5.1e-7 * float(np.linalg.norm(cloud, axis=1).max())
    np.testing.assert_allclose(read_scan(tmp_path / "scan.e57").points, cloud, rtol=0, atol=error_mm)


@pytest.mark.parametrize("system", [cartesian, spherical])
def test_invalid_points_are_left_out_and_counted(tmp_path: Path, cloud: FloatArray, system: Any) -> None:
    state = np.arange(len(cloud)) % 3
    name = "cartesianInvalidState" if system is cartesian else "sphericalInvalidState"
    write_e57(tmp_path / "scan.e57", system(cloud.astype(np.float64) / 1000.0) | {name: state})
    scan = read_scan(tmp_path / "scan.e57")
    np.testing.assert_allclose(scan.points, cloud[state == 0], rtol=0, atol=1e-9)
    assert scan.dropped == np.count_nonzero(state)


def test_rows_and_columns_make_a_grid(tmp_path: Path, grid: FloatArray) -> None:
    seen = np.isfinite(grid[..., 2])
    rows, columns = np.nonzero(seen)
    shuffled = np.random.default_rng(1).permutation(len(rows))
    indices = {"rowIndex": rows[shuffled] + 7, "columnIndex": columns[shuffled] + 3}
    values = cartesian(grid[seen][shuffled].astype(np.float64) / 1000.0)
    write_e57(tmp_path / "scan.e57", values | indices)
    scan = read_scan(tmp_path / "scan.e57")
    np.testing.assert_allclose(scan.points, grid, rtol=0, atol=1e-9)
    assert scan.dropped == 40
    np.testing.assert_array_equal(scan.viewpoint, [0, 0, 0])


def test_several_scans_are_joined_by_their_poses(tmp_path: Path, cloud: FloatArray) -> None:
    metres = cloud.astype(np.float64) / 1000.0
    turn = np.array([np.cos(0.3), 0.0, 0.0, np.sin(0.3)])
    poses = ((turn, np.array([512_000.0, 4_096_000.0, 8.0])), None)
    write_e57(tmp_path / "scan.e57", cartesian(metres), cartesian(metres), poses=poses)
    scan = read_scan(tmp_path / "scan.e57")
    c, s = np.cos(0.6), np.sin(0.6)
    turned = metres @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) + [512_000.0, 4_096_000.0, 8.0]
    np.testing.assert_allclose(scan.points, np.concatenate([turned, metres]) * 1000.0, rtol=0, atol=2e-6)
    assert scan.viewpoint is None
    assert "2 scans" in scan.notes[0]
    write_e57(tmp_path / "one.e57", cartesian(metres), poses=poses[:1])
    np.testing.assert_allclose(read_scan(tmp_path / "one.e57").viewpoint, [5.12e8, 4.096e9, 8000.0])


def test_fields_without_coordinates(tmp_path: Path) -> None:
    write_e57(tmp_path / "scan.e57", {"intensity": np.ones(5)})
    with pytest.raises(ScanError, match=r"scan\.e57: scan 1 has neither cartesian nor spherical"):
        read_scan(tmp_path / "scan.e57")


def test_every_cut_and_every_damaged_page_is_noticed(tmp_path: Path, cloud: FloatArray) -> None:
    write_e57(tmp_path / "whole.e57", cartesian(cloud / np.float32(1000.0)))
    content = (tmp_path / "whole.e57").read_bytes()
    for length in [1, 20, 47, 48, *range(100, len(content), 997), len(content) - 1]:
        (tmp_path / "cut.e57").write_bytes(content[:length])
        with pytest.raises(ScanError, match=r"cut\.e57: "):
            read_scan(tmp_path / "cut.e57")
    for position in range(60, len(content) - 2048, 1024):
        (tmp_path / "bad.e57").write_bytes(content[:position] + b"\xa5\x5a" + content[position + 2 :])
        with pytest.raises(ScanError, match=r"bad\.e57: cannot be read as E57 \(.*checksum"):
            read_scan(tmp_path / "bad.e57")


def test_scaled_integers_of_another_program(reference_clouds: Path) -> None:
    scan = read_scan(reference_clouds / "cry-inc_bunnyInt19.e57")
    assert scan.points.shape == (30_571, 3)
    np.testing.assert_allclose(scan.points.min(axis=0), [-94.689, 40.011, -61.873], rtol=0, atol=1e-6)
    np.testing.assert_allclose(scan.points.max(axis=0), [61.009, 187.321, 58.799], rtol=0, atol=1e-6)


@pytest.mark.parametrize("organised", [False, True])
def test_a_rotation_that_a_writer_left_empty_turns_nothing_and_is_noted(
    tmp_path: Path, cloud: FloatArray, organised: bool
) -> None:
    path, points = tmp_path / "scan.e57", cloud[:600] / 1000.0
    values = cartesian(points)
    if organised:
        values |= {"rowIndex": np.arange(600) // 30, "columnIndex": np.arange(600) % 30}
    empty, shift = np.zeros(4), np.array([0.25, -0.5, 1.0])
    write_e57(path, values, poses=((empty, shift),))
    scan = read_scan(path)
    np.testing.assert_allclose(scan.points.reshape(-1, 3), cloud[:600] + 1000.0 * shift, atol=1e-3)
    assert [note for note in scan.notes if "0 0 0 0" in note] == [NO_ROTATION]
    write_e57(path, values, values, poses=((empty, shift), (np.array([1.0, 0.0, 0.0, 0.0]), shift)))
    assert NO_ROTATION in read_scan(path).notes
