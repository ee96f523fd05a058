"""E57, the exchange format of laser scanners: one or more scans, each with its pose, through libE57Format."""

from __future__ import annotations

import tempfile
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from aadm_workbench.errors import needed
from aadm_workbench.model import Array, BoolArray, FloatArray, Reason
from aadm_workbench.scan.file import Cloud, Declared, ScanFile
from aadm_workbench.scan.formats.e57_outline import check_outline
from aadm_workbench.scan.joined import joined

_MM_PER_METRE = 1000.0  # the format has metres alone (ASTM E2807)
_CARTESIAN = ("cartesianX", "cartesianY", "cartesianZ")
_SPHERICAL = ("sphericalRange", "sphericalAzimuth", "sphericalElevation")
_INVALID = {_CARTESIAN: "cartesianInvalidState", _SPHERICAL: "sphericalInvalidState"}
_GRID = ("rowIndex", "columnIndex")
_MOST_PIXELS_PER_POINT = 20
"""A grid with fewer points is none that a camera took, and may be as large as its indices say."""


def _libe57() -> ModuleType:
    with needed("pye57", "an E57 file"):
        return import_module("pye57.libe57")


def read_e57(file: ScanFile, declared: Declared) -> Cloud:
    """Read all scans of an E57 file: cartesian or spherical, floating or scaled integers, in metres (ASTM E2807, 4.1).

    Points whose invalid state is not 0 are no measurement: they are left out and counted. A single scan whose points
    have a row and a column is organised.

    Raises
    ------
    ScanError
        For a file that is damaged, holds no scan, or announces more than it holds.
    MissingDependencyError
        Without the library.
    """
    check_outline(file)
    library = _libe57()
    with tempfile.TemporaryDirectory(prefix="aadm-") as folder:
        # The library reads files alone, and this one may have changed since its hash was taken.
        copy = Path(folder) / "scan.e57"
        copy.write_bytes(file.content)
        try:
            image = library.ImageFile(str(copy), "r")
            try:
                clouds = [_scan(file, library, image, number) for number in range(_scan_count(image))]
            finally:
                image.close()
        except _errors_of(library) as error:
            reason = (str(error).splitlines() or [type(error).__name__])[0][:120]
            raise file.wrong(Reason("formats.e57_unreadable", why=reason)) from error
    clouds = [cloud for cloud in clouds if cloud.points.size or cloud.dropped]
    if not clouds:
        raise file.wrong(Reason("points.no_points"))
    return joined(clouds)


def _errors_of(library: ModuleType) -> tuple[type[Exception], ...]:
    """What is raised for nodes that are missing, of another kind than they should be, or damaged."""
    return library.E57Exception, RuntimeError, AttributeError, TypeError, ValueError, IndexError, KeyError


def _scan_count(image: Any) -> int:
    root = image.root()
    return len(root["data3D"]) if root.isDefined("data3D") else 0


def _scan(file: ScanFile, library: ModuleType, image: Any, number: int) -> Cloud:
    node = image.root()["data3D"][number]
    vector = node["points"]
    prototype = library.StructureNode(vector.prototype())
    system = next((names for names in (_CARTESIAN, _SPHERICAL) if all(map(prototype.isDefined, names))), None)
    if system is None:
        raise file.wrong(Reason("formats.e57_no_coordinates", number=number + 1))
    wanted = [name for name in (*system, _INVALID[system], *_GRID) if prototype.isDefined(name)]
    values = _values(file, library, image, vector, wanted)
    points = np.column_stack([values[name] for name in system])
    if system is _SPHERICAL:
        points = _from_spherical(points)
    pose, notes = _pose(file, node)
    invalid = values.get(_INVALID[system], np.zeros(len(points))) != 0
    if all(name in values for name in _GRID):
        grid = _grid(points, values, invalid)
        if grid is not None:
            eye = np.eye(4) if pose is None else pose
            return Cloud(grid, _MM_PER_METRE, eye, unit_from=_UNIT_FROM, notes=notes)
    dropped = int(np.count_nonzero(invalid))
    return Cloud(points[~invalid], _MM_PER_METRE, pose, unit_from=_UNIT_FROM, dropped=dropped, notes=notes)


_UNIT_FROM = Reason("formats.e57_metres")

NO_ROTATION = Reason("formats.no_rotation")
"""Note of a file whose writer left the quaternion empty."""


def _values(file: ScanFile, library: ModuleType, image: Any, vector: Any, names: list[str]) -> dict[str, Array]:
    """Return the values of some fields of all points, (n,) float64 each."""
    count = vector.childCount()
    values = {name: np.empty(count) for name in names}
    if count == 0:
        return values
    buffers = library.VectorSourceDestBuffer()
    for name, column in values.items():
        buffers.append(library.SourceDestBuffer(image, name, column, count, True, True))
    reader = vector.reader(buffers)
    try:
        found = reader.read()
    finally:
        reader.close()
    if found < count:
        raise file.wrong(Reason("formats.e57_count", count=count, found=found))
    return values


def _from_spherical(points: Array) -> Array:
    """Return x, y, z of range, azimuth (from x about z) and elevation (above the xy plane), in rad."""
    distance, azimuth, elevation = points.T
    flat = distance * np.cos(elevation)
    return np.column_stack([flat * np.cos(azimuth), flat * np.sin(azimuth), distance * np.sin(elevation)])


def _pose(file: ScanFile, node: Any) -> tuple[Array | None, tuple[str, ...]]:
    """Return the pose (4, 4), metres, of a scan: a quaternion w x y z and a translation, None without one; and notes.

    Some writers leave a pose that they do not know at 0 0 0 0, which is no rotation.
    """
    if not node.isDefined("pose"):
        return None, ()
    pose = np.eye(4)
    notes: tuple[str, ...] = ()
    rotation, translation = (
        node["pose"][name] if node["pose"].isDefined(name) else None for name in ("rotation", "translation")
    )
    if rotation is not None:
        from scipy.spatial.transform import Rotation  # slow to import, and few files need it

        quaternion = np.array([float(rotation[axis].value()) for axis in "xyzw"])
        if not np.isfinite(quaternion).all():
            raise file.wrong(Reason("formats.rotation", quaternion=quaternion.tolist()))
        if quaternion.any():
            pose[:3, :3] = Rotation.from_quat(quaternion).as_matrix()
        else:
            notes = (NO_ROTATION,)
    if translation is not None:
        pose[:3, 3] = [float(translation[axis].value()) for axis in "xyz"]
    if not np.isfinite(pose).all():
        raise file.wrong(Reason("formats.translation"))
    return None if np.array_equal(pose, np.eye(4)) else pose, notes


def _grid(points: Array, values: dict[str, Array], invalid: BoolArray) -> FloatArray | None:
    """Return the points (h, w, 3) at their rows and columns, NaN elsewhere; None where these are no grid."""
    row, column = (values[name] - values[name].min(initial=np.inf) for name in _GRID)
    if not len(points):
        return None
    height, width = int(row.max()) + 1, int(column.max()) + 1
    if min(height, width) < 2 or height * width > _MOST_PIXELS_PER_POINT * len(points):
        return None
    place = (row * width + column).astype(np.int64)
    if len(np.unique(place)) < len(place):
        return None
    grid = np.full((height * width, 3), np.nan)
    grid[place[~invalid]] = points[~invalid]
    return grid.reshape(height, width, 3)
