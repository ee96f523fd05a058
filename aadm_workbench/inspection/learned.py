"""A job's camera profile: whether it is that of this camera, and how reports name it."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date

from aadm_workbench.model import Camera, CameraProfile, Reason

_SAME_PIXELS = 0.5  # of intrinsics: what a file rounds to, and what temperature moves a lens by


def named_profile(profile: CameraProfile) -> dict[str, str]:
    """What the capture's entry in reports says of a profile."""
    return {"camera_profile": f"{profile.source} sha256:{profile.sha256}"}


def notes_on_profile(profile: CameraProfile, camera: Camera | None, capture: Mapping[str, str]) -> tuple[str, ...]:
    """What speaks against using a profile: another camera, other settings, too old; it is used all the same.

    Parameters
    ----------
    camera
        The intrinsics that the job itself gives, which then hold; None where it takes the profile's.
    capture
        What the job says of the capture: ``camera_serial``, ``settings``, ``date``.
    """
    notes = []
    serial, settings = capture.get("camera_serial", ""), capture.get("settings", "")
    if not serial or not profile.serial:
        notes.append(Reason("calibration.no_camera_serial"))
    elif serial != profile.serial:
        notes.append(Reason("calibration.other_camera_serial", told=serial, known=profile.serial))
    if not settings or not profile.settings:
        notes.append(Reason("calibration.no_settings"))
    elif settings != profile.settings:
        notes.append(Reason("calibration.other_settings", told=settings, known=profile.settings))
    if camera is not None and _differ(camera, profile.camera):
        notes.append(Reason("calibration.other_intrinsics"))
    return (*notes, *_age(profile, capture.get("date", "")))


def _differ(one: Camera, other: Camera) -> bool:
    if (one.width, one.height) != (other.width, other.height):
        return True
    return any(abs(getattr(one, name) - getattr(other, name)) > _SAME_PIXELS for name in ("fx", "fy", "cx", "cy"))


def _age(profile: CameraProfile, taken: str) -> tuple[str, ...]:
    try:
        days = (date.fromisoformat(taken[:10]) - date.fromisoformat(profile.date[:10])).days
    except ValueError:
        return (Reason("calibration.age_unknown"),)
    if days > profile.valid_days:
        return (Reason("calibration.too_old", days=days, valid_days=profile.valid_days),)
    return (Reason("calibration.not_yet", date=profile.date),) if days < 0 else ()
