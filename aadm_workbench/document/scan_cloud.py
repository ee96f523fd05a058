"""A scan in a FreeCAD document: its file, its hash, and a thinned cloud that is shown fast.

The check reads the file itself; the cloud is for the eye. The module path and the class name are written into users'
files: neither may change.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import FreeCAD
import numpy as np

from aadm_workbench.document.column import attach_view, show_restored
from aadm_workbench.document.places import move_to, placement_of
from aadm_workbench.document.properties import HIDDEN, READ_ONLY, Property, apply_properties
from aadm_workbench.document.schema import SCHEMA, SCHEMA_PROPERTY, bring_up_to_date
from aadm_workbench.document.stateless import Stateless
from aadm_workbench.model import Array, Kind
from aadm_workbench.private.answers import ReadScan

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
_SCAN = "AADM scan"
KINDS = ("sleeves", "rebars")
UNITS = ("mm", "m")
PROPERTIES = (
    SCHEMA_PROPERTY,
    Property(
        "App::PropertyEnumeration",
        "Kind",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "What it shows: the sleeves of the foot, or the rebars"),
        choices=KINDS,
    ),
    Property("App::PropertyFile", "File", _SCAN, QT_TRANSLATE_NOOP("App::Property", "The scan's file")),
    Property(
        "App::PropertyEnumeration",
        "Units",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "Unit of the file's lengths; it is never guessed"),
        choices=UNITS,
    ),
    Property(
        "App::PropertyString",
        "Camera",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "Intrinsics of the camera, where they are known"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyFloat",
        "DepthScale",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "Millimetres in one step of a 16-bit depth map; 0: not given"),
        0.0,
    ),
    Property(
        "App::PropertyString",
        "Sha256",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "Hash of the file as it was imported"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyInteger",
        "PointCount",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "Points of the file; the view shows fewer"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyBool",
        "Aligned",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "A check has laid it on the design; before, its place is a guess"),
        False,
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyPlacement",
        "InColumn",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "Scan frame in the column frame"),
        mode=HIDDEN,
    ),
    Property(
        "App::PropertyVectorList",
        "Points",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "Thinned points, scan frame"),
        mode=HIDDEN,
    ),
    Property(
        "App::PropertyFloatList",
        "Distances",
        _SCAN,
        QT_TRANSLATE_NOOP("App::Property", "Distance of each thinned point from the design"),
        mode=HIDDEN,
    ),
)


class ScanCloud(Stateless):
    """Proxy of a scan."""

    Type = "AADM::Scan"

    def onDocumentRestored(self, obj: Any) -> None:
        """Bring a scan of an earlier version up to date, and give it its view."""
        bring_up_to_date(obj, PROPERTIES)
        show_restored(obj, "scan_view", "ScanView")

    def execute(self, obj: Any) -> None:
        """Everything is kept; nothing is computed."""

    def follow(self, obj: Any, placement: FreeCAD.Placement) -> None:
        """Stand where the column stands."""
        move_to(obj, placement * obj.InColumn)


def make_scan(column: Any, file: Path, kind: str, units: str, read: ReadScan) -> Any:
    """Add a scan that was read to a column.

    Parameters
    ----------
    kind, units
        One of :data:`KINDS` and of :data:`UNITS`, as it was declared.
    read
        What the private process has answered.
    """
    cloud = column.Document.addObject("App::GeometryPython", "AADM_Scan")
    cloud.Proxy = ScanCloud()
    apply_properties(cloud, PROPERTIES)
    cloud.Schema = SCHEMA
    cloud.Label = f"{column.ColumnId} {kind}: {file.name}"
    cloud.Kind = kind
    cloud.File = str(file)
    cloud.Units = units
    column.Scans = [*column.Scans, cloud]
    fill_scan(cloud, column, read)
    attach_view(cloud, "scan_view", "ScanView")
    return cloud


def fill_scan(cloud: Any, column: Any, read: ReadScan) -> None:
    """Give a scan of a column what was read of its file."""
    cloud.Camera = json.dumps(read["camera"]) if read["camera"] else ""
    cloud.DepthScale = float(read["depth_scale_mm"] or 0.0)
    cloud.Sha256 = read["sha256"]
    cloud.PointCount = read["count"]
    cloud.Points = [FreeCAD.Vector(*point) for point in read["points"]]
    points = np.array(read["points"], dtype=np.float64).reshape(-1, 3)
    cloud.InColumn = placement_of(_guessed_place(points, kind_of(cloud), np.array(read["R_file_scan"])))
    cloud.Proxy.follow(cloud, column.Placement)


def kind_of(cloud: Any) -> Kind:
    """What a scan shows."""
    return Kind.SLEEVE if cloud.Kind == Kind.SLEEVE.plural else Kind.REBAR


def lay_on_design(cloud: Any, T_design_scan: Array, distances_mm: Array, placement: FreeCAD.Placement) -> None:
    """Put a scan where a check has found that it lies."""
    cloud.InColumn = placement_of(T_design_scan)
    cloud.Aligned = True
    cloud.Distances = np.asarray(distances_mm, dtype=np.float64).tolist()
    cloud.Proxy.follow(cloud, placement)


def _guessed_place(points: Array, kind: Kind, R_file_scan: Array) -> Array:
    """(4, 4) mm: the camera looks up at a foot or down on bars, their middle under the column's."""
    T_column_scan = np.diag([1.0, -1.0, -1.0, 1.0] if kind is Kind.REBAR else [-1.0, -1.0, 1.0, 1.0])
    T_column_scan[:3, :3] = T_column_scan[:3, :3] @ R_file_scan.T
    if len(points):
        T_column_scan[:3, 3] = -T_column_scan[:3, :3] @ np.median(points, axis=0)
    return T_column_scan
