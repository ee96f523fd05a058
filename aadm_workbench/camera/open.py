"""Cameras by their address: ``gentl:FILE.cti[#SERIAL]``, ``gige://IP``, ``mecheye://IP``, ``replay:FOLDER``."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType

from aadm_workbench.camera import gentl, gige, mecheye, replay
from aadm_workbench.camera.frame import Device, FrameSource
from aadm_workbench.errors import CameraError
from aadm_workbench.model.reason import said_of

_OPEN: MappingProxyType[str, Callable[[str], FrameSource]] = MappingProxyType(
    {
        gentl.SCHEME: gentl.open_camera,
        gige.SCHEME: gige.open_camera,
        mecheye.SCHEME: mecheye.open_camera,
        replay.SCHEME: replay.open_camera,
    }
)
_DEVICES: MappingProxyType[str, Callable[[str], list[Device]]] = MappingProxyType(
    {
        gentl.SCHEME: gentl.devices,
        gige.SCHEME: gige.devices,
        mecheye.SCHEME: mecheye.devices,
        replay.SCHEME: replay.devices,
    }
)
FORMS = ("gentl:FILE.cti#SERIAL", "gige://IP", "mecheye://IP", "replay:FOLDER")
"""How addresses are written."""


def open_camera(address: str) -> FrameSource:
    """Open a camera by its address.

    Raises
    ------
    CameraError
        For an address that is none, or does not say which camera is meant.
    CameraGoneError
        Where the camera does not answer.
    MissingDependencyError
        Where the protocol needs a package that is not installed.
    """
    return _OPEN[_scheme(address)](address)


def devices(address: str) -> list[Device]:
    """Return the cameras that are at an address, which need not name one of them; the same errors."""
    return _DEVICES[_scheme(address)](address)


def _scheme(address: str) -> str:
    scheme, colon, _ = address.partition(":")
    if not colon or scheme not in _OPEN:
        raise CameraError(said_of(address, "camera.no_camera", forms=FORMS))
    return scheme
