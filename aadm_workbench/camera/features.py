"""The features of a GenICam device (SFNC): read where they are there and readable, set where they can be set."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from aadm_workbench.camera.coordinates import Axis, Coding
from aadm_workbench.camera.frame import Setting
from aadm_workbench.model import Camera

_READABLE = (3, 4)  # EAccessMode of GenApi: RO, RW
_WRITABLE = (2, 4)  # WO, RW

_TELLING = re.compile(
    r"exposure|gain|scan3d|smooth|filter|fill|interpol|denois|noise|median|gauss|outlier|edge|threshold|confidence|"
    r"projector|coding|laser|led|binning|decimation|resolution|pixelformat|^width$|^height$|temperature|userset|"
    r"range|lens|distort|firmware",
    re.IGNORECASE,
)
"""What may bear on where points lie, among the hundreds of features of a camera."""

_NO_SETTING = re.compile(r"^Chunk|^Event|_|Selector$|Calc$")
_STRAIGHTENED = re.compile(r"undistort|distort\w*?correct|rectif", re.IGNORECASE)


class Features:
    """A node map, by the names of its features."""

    def __init__(self, node_map: Any) -> None:
        self._nodes = node_map

    def get(self, name: str) -> Setting | None:
        """Return the value of a feature; None where it is not there, or cannot be read now."""
        from genicam.genapi import GenericException

        try:
            if not self._nodes.has_node(name):
                return None
            node = getattr(self._nodes, name)
            if node.get_access_mode() not in _READABLE or not hasattr(node, "value"):
                return None
            value = node.value
        except (GenericException, AttributeError):
            return None
        return value if isinstance(value, str | int | float | bool) else None

    def text(self, *names: str) -> str:
        """Return the first of some features that says something, as text; empty where none does."""
        return next((str(value) for name in names if (value := self.get(name)) not in (None, "")), "")

    def number(self, *names: str) -> float | None:
        """Return the first of some features that is a number."""
        values = (self.get(name) for name in names)
        return next((float(v) for v in values if isinstance(v, int | float) and not isinstance(v, bool)), None)

    def set(self, name: str, value: Setting) -> bool:
        """Set a feature; whether it then has the value."""
        from genicam.genapi import GenericException

        try:
            if not self._nodes.has_node(name):
                return False
            node = getattr(self._nodes, name)
            if node.get_access_mode() in _WRITABLE and node.value != value:
                node.value = value
            return bool(node.value == value)
        except (GenericException, AttributeError, TypeError, ValueError):
            return False

    def execute(self, name: str) -> bool:
        """Run a command; whether the device took it."""
        from genicam.genapi import GenericException

        try:
            if not self._nodes.has_node(name):
                return False
            getattr(self._nodes, name).execute()
        except (GenericException, AttributeError):
            return False
        return True

    def choices(self, name: str) -> tuple[str, ...]:
        """Return what an enumeration may be set to now."""
        from genicam.genapi import GenericException

        try:
            return tuple(getattr(self._nodes, name).symbolics) if self._nodes.has_node(name) else ()
        except (GenericException, AttributeError):
            return ()

    def settings(self) -> dict[str, Setting]:
        """Return the features that may bear on where points lie, with their values."""
        names = (name for name in sorted(dir(self._nodes)) if _TELLING.search(name) and not _NO_SETTING.search(name))
        return {name: value for name in names if (value := self.get(name)) is not None}


def coding_of(features: Features, width: int, height: int) -> Coding:
    """Return what a device says of the coordinates of its last frame: by the frame's chunks, else by its features."""
    for selector in ("ChunkComponentSelector", "ComponentSelector"):
        features.set(selector, "Range")
    return Coding(
        unit=features.text("ChunkScan3dDistanceUnit", "Scan3dDistanceUnit"),
        mode=features.text("ChunkScan3dOutputMode", "Scan3dOutputMode"),
        system=features.text("ChunkScan3dCoordinateSystem", "Scan3dCoordinateSystem"),
        reference=features.text("ChunkScan3dCoordinateSystemReference", "Scan3dCoordinateSystemReference"),
        axes={axis: _axis(features, axis) for axis in "ABC"},
        camera=_camera(features, width, height),
        distortion=tuple(_distortion(features)),
    )


def _axis(features: Features, axis: str) -> Axis:
    for prefix in ("ChunkScan3d", "Scan3d"):
        chosen = features.set(f"{prefix}CoordinateSelector", f"Coordinate{axis}")
        scale = features.number(f"{prefix}CoordinateScale") if chosen else None
        if scale is not None:
            offset = features.number(f"{prefix}CoordinateOffset")
            marked = features.get(f"{prefix}InvalidDataFlag") is True
            invalid = features.number(f"{prefix}InvalidDataValue") if marked else None
            return Axis(scale, offset or 0.0, invalid)
    return Axis()


def _camera(features: Features, width: int, height: int) -> Camera | None:
    """The intrinsics, in pixels, of the region that is sent; None where the device says none."""
    values = [
        features.number(f"ChunkScan3d{name}", f"Scan3d{name}")
        for name in ("FocalLength", "PrincipalPointU", "PrincipalPointV")
    ]
    focal, cx, cy = values
    if not focal or cx is None or cy is None or not (0.0 < cx < width and 0.0 < cy < height):
        return None
    aspect = features.number("ChunkScan3dAspectRatio", "Scan3dAspectRatio") or 1.0
    return Camera(focal, focal * aspect, cx, cy, width, height)


def _distortion(features: Features) -> Iterator[float]:
    settings = {name: value for name, value in features.settings().items() if "distort" in name.lower()}
    if any(value is True for name, value in settings.items() if _STRAIGHTENED.search(name)):
        return
    for value in settings.values():
        if isinstance(value, int | float) and not isinstance(value, bool) and value:
            yield float(value)
