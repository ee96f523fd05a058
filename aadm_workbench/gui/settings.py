"""What a user has set for this workbench; FreeCAD keeps it, the page in its preferences changes it."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.document.column import DECISIONS, METHODS
from aadm_workbench.document.scan_cloud import UNITS

_PLACE = "User parameter:BaseApp/Preferences/Mod/AADM"


def _kept() -> FreeCAD.ParamGet:
    return FreeCAD.ParamGet(_PLACE)


def method() -> str:
    """Method of new columns."""
    return _chosen(METHODS, "Method")


def tolerances() -> str:
    """Tolerance profile of new columns."""
    return _kept().GetString("Tolerances", "") or "cn"


def decision() -> str:
    """Decision rule of new columns."""
    return _chosen(DECISIONS, "Decision")


def scan_units() -> str:
    """Unit that scans are imported in unless the user says otherwise."""
    return _chosen(UNITS, "ScanUnits")


def camera_file() -> str:
    """File with the intrinsics of the camera."""
    return _kept().GetString("CameraFile", "")


def remember_camera_file(path: str) -> None:
    """Offer this file for the next scan, too."""
    _kept().SetString("CameraFile", path)


def camera_profile() -> str:
    """File of what was learned of the camera, which checks use; empty: they use none."""
    return _kept().GetString("CameraProfile", "")


def remember_camera_profile(path: str) -> None:
    """Use this profile from now on."""
    _kept().SetString("CameraProfile", path)


def camera_address() -> str:
    """The live camera that was used last."""
    return _kept().GetString("CameraAddress", "")


def remember_camera_address(address: str) -> None:
    """Offer this camera the next time, too."""
    _kept().SetString("CameraAddress", address)


def most_points() -> int:
    """Points of a scan that the view shows at most."""
    return max(1000, _kept().GetInt("MostPoints", 60_000))


def label_size_pt() -> int:
    """Size of labels in the 3-D view, points."""
    return min(48, max(6, _kept().GetInt("LabelSize", 10)))


def _chosen(known: tuple[str, ...], entry: str) -> str:
    """FreeCAD keeps the place of a choice in its list."""
    place = _kept().GetInt(entry, 0)
    return known[place] if 0 <= place < len(known) else known[0]
