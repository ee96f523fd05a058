"""What a job says: which columns to check, from which scans, against which design and limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Literal

from aadm_workbench.model import Camera, CameraProfile, ColumnDesign, ControlPoint, Profile, StackSettings, Vector3

_NO_FILES = ("id", "axes")


@dataclass(frozen=True)
class JobModel:
    """The model that columns are looked up in, and selectors in IfcOpenShell's syntax; ``units``: of a mesh."""

    path: str
    columns: str | None = None
    sleeves: str | None = None
    rebars: str | None = None
    units: str = "mm"


@dataclass(frozen=True, eq=False)
class JobColumn:
    """One column of a job: its scans as the job names them, how they lie, and its design where the job gives it.

    ``..._up_deg``: column-frame direction at the top of the image, degrees from +x counter-clockwise from above.
    ``axes``: those of its clouds, None where they are to be found out. ``near``: signs of x and y of the corner of the
    bars nearest to the hoisting camera, ``hoisting_near`` the same for each of ``hoisting``. ``control_points`` are
    measured in the scan of the rebars. ``set_pose``: dx, dy mm and yaw degrees at which the crane is to set it.
    """

    id: str
    sleeves: tuple[str, ...] = ()
    rebars: tuple[str, ...] = ()
    hoisting: tuple[str, ...] = ()
    hoisting_near: tuple[tuple[int, int] | None, ...] = ()
    sleeves_image: str | None = None
    rebars_image: str | None = None
    sleeves_up_deg: float | None = None
    rebars_up_deg: float | None = None
    axes: str | None = None
    near: tuple[int, int] | None = None
    design: ColumnDesign | None = None
    control_points: tuple[ControlPoint, ...] = ()
    set_pose: Vector3 | None = None

    def files(self) -> tuple[str, ...]:
        """The files that the column is checked from, as it names them: every other text of it is one."""
        found: dict[str, None] = {}
        for item in fields(self):
            value = getattr(self, item.name)
            if item.name not in _NO_FILES:
                texts = value if isinstance(value, tuple) else (value,)
                found.update((text, None) for text in texts if isinstance(text, str))
        return tuple(found)


@dataclass(frozen=True, eq=False)
class Job:
    """A job, as its file says it; paths are relative to ``folder``.

    ``checks`` None: what each column's scans allow. ``sha256`` is of the file's bytes. ``stack`` None: the job does not
    ask for the tower. ``line_of`` says on which line a column stands. ``camera_profile`` is what was learned of the
    camera on a plate.
    """

    source: str
    folder: Path
    sha256: str
    name: str
    units: str
    profile: Profile
    decision: Literal["guarded", "simple"]
    checks: tuple[str, ...] | None
    turns: bool
    model: JobModel | None
    camera: Camera | None
    depth_scale_mm: float | None
    columns: tuple[JobColumn, ...]
    capture: dict[str, str] = field(default_factory=dict)
    stack: StackSettings | None = None
    camera_profile: CameraProfile | None = None
    line_of: Callable[[str], int] = lambda _: 1

    @property
    def model_path(self) -> Path | None:
        """Where its model lies; None where columns have designs of their own."""
        return None if self.model is None else self.folder / self.model.path
