"""A scan file on its way into a document: read in any thread, taken over on the main one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aadm_workbench.design.directions import up_deg
from aadm_workbench.document.packages import naming_packages
from aadm_workbench.document.scan_cloud import make_scan
from aadm_workbench.errors import ScanError
from aadm_workbench.model import Camera, Kind, Scan

_IN_NAMES_OF_BARS = ("bar", "rebar", "steel", "筋", "钢")


def guessed_kind(file: str | Path) -> str:
    """``rebars`` where a file is called so, else ``sleeves``."""
    name = Path(file).stem.lower()
    return "rebars" if any(word in name for word in _IN_NAMES_OF_BARS) else "sleeves"


@dataclass(frozen=True, eq=False)
class ReadScan:
    """A scan that was read, and how it was declared."""

    scan: Scan
    file: Path
    kind: Kind
    declared: Mapping[str, Any]


def read_for(
    kind: str,
    file: str | Path,
    *,
    units: str = "mm",
    camera: Camera | str | Path | None = None,
    depth_scale_mm: float | None = None,
) -> ReadScan:
    """Read a scan; touches no document.

    Parameters
    ----------
    kind
        ``sleeves`` or ``rebars``.
    camera
        Intrinsics, or the file that holds them.

    Raises
    ------
    AadmError
        Where it cannot be read.
    """
    with naming_packages():
        return _read(kind, Path(file), units, camera, depth_scale_mm)


def _read(
    kind: str, file: Path, units: str, camera: Camera | str | Path | None, depth_scale_mm: float | None
) -> ReadScan:
    from aadm_workbench.scan.camera import read_camera, read_depth_scale_mm
    from aadm_workbench.scan.read import read_scan

    named = {one.plural: one for one in Kind}
    if kind not in named:
        raise ScanError(f"a scan shows {' or '.join(named)}, not {kind!r}")
    known = camera if camera is None or isinstance(camera, Camera) else read_camera(Path(camera))
    if depth_scale_mm is None and isinstance(camera, str | Path):
        depth_scale_mm = read_depth_scale_mm(Path(camera))
    scan = read_scan(file, units=units, camera=known, depth_scale_mm=depth_scale_mm, source=file.name)
    declared = {"units": units, "camera": known, "depth_scale_mm": depth_scale_mm}
    return ReadScan(scan, file.resolve(), named[kind], declared)


def take_scan(column: Any, read: ReadScan, *, up: str | None = None, most_points: int = 60_000) -> Any:
    """Give a column a scan that was read; parameters as :func:`aadm_workbench.document.api.add_scan`.

    Raises
    ------
    JobError
        Where ``up`` is no direction.
    """
    if up is not None:
        up_deg(up, column.Label)
        setattr(column, "SleevesUp" if read.kind is Kind.SLEEVE else "RebarsUp", up)
    return make_scan(column, read.scan, read.file, read.kind, read.declared, most_points)
