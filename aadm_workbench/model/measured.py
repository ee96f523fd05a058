"""What is designed and what is scanned: points, columns, cameras, scans and what was found in them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from aadm_workbench.model.camera import Camera, CameraProfile
from aadm_workbench.model.verdicts import Kind, Verdict

TO_SIGMA = 1.4826
"""A median of absolute deviations times this is the standard deviation of a normal law: 1/Φ⁻¹(3/4)."""
OF_MEDIAN = 1.2533
"""A median of n normal values scatters by this times their standard deviation over √n: √(π/2)."""


Array: TypeAlias = np.ndarray[tuple[Any, ...], np.dtype[np.float64]]
"""Not by numpy's own name for it, which is no type to those who read annotations from numpy 2.5 on."""
FloatArray: TypeAlias = npt.NDArray[np.floating[Any]]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
IntArray: TypeAlias = npt.NDArray[np.int64]
Vector2: TypeAlias = tuple[float, float]
Vector3: TypeAlias = tuple[float, float, float]
Json: TypeAlias = "dict[str, Json] | list[Json] | str | int | float | bool | None"
"""What a JSON text holds."""
Figure: TypeAlias = str | float | int | bool | None
"""What stands behind a name where a report lists whatever an extraction or a finding tells."""
Figures: TypeAlias = Mapping[str, Figure | tuple[Figure, ...]]


@dataclass(frozen=True, eq=False)
class AssemblyPoint:
    """A sleeve or a connecting rebar, reduced to what the assembly needs.

    Parameters
    ----------
    label
        ``S1``, ``R1``, ... in the column frame; empty while no label is known.
    centre
        (3,) float64, mm. Sleeve: where its axis meets the foot face. Bar: where the axis of its core meets its top.
    axis
        (3,) float64, unit vector; in the column frame it points up along the column.
    diameter_mm
        Sleeve: inner diameter at the mouth. Bar: nominal (design) or of the core outline (measured).
    covariance
        (3, 3) float64, mm², of the centre; None where it is not known.
    global_id
        GlobalId of the element in the IFC model.
    why
        Design: why this element was taken. Measured: the evidence that was used.
    length_mm
        Design only: length of the bar or of the sleeve, where the model gives it.
    object_name
        Design only: the object of a FreeCAD document, or the body of another file, that this point was taken from.
    outer_diameter_mm
        Design only: of a bar, over its ribs, where it is given for this bar.
    axis_covariance
        (3, 3) float64, without unit (mm of offset a mm of length, squared), of the unit axis, in the frame of the axis
        and singular along it; None where it is not known.
    axis_believed
        Measured only: whether the axis and its covariance hold what is usual of axes already; else they are what was
        seen alone.
    seen_length_mm
        Measured only: length along the axis over which the surface was seen that gave the axis; None where the
        extraction does not say.
    """

    label: str
    kind: Kind
    centre: Array
    axis: Array
    diameter_mm: float
    covariance: Array | None = None
    global_id: str | None = None
    why: str = ""
    length_mm: float | None = None
    object_name: str | None = None
    outer_diameter_mm: float | None = None
    axis_covariance: Array | None = None
    axis_believed: bool = False
    seen_length_mm: float | None = None


@dataclass(frozen=True, eq=False)
class ColumnDesign:
    """One column as designed: sleeves and the rebars it comes down on, in the column frame.

    ``rebars[k]`` belongs into ``sleeves[k]``. ``T_model_column`` (4, 4) places the column frame in the
    model; None for a design without a model. ``names`` holds every name that a job may call it by
    (Name, Tag, PieceMark, GlobalId). ``exposed_length_mm`` is how far the rebars stick out of the floor. ``shared_ids``
    are the labels of points, and "column", whose GlobalId another element of the model has too. ``section_middle_mm``
    is the middle of a rectangular section of ``size_mm``; None where the design does not say.
    """

    id: str
    sleeves: tuple[AssemblyPoint, ...]
    rebars: tuple[AssemblyPoint, ...]
    size_mm: tuple[float, float] | None = None
    global_id: str | None = None
    piece_mark: str | None = None
    storey: str | None = None
    grid: str | None = None
    names: tuple[str, ...] = ()
    T_model_column: Array | None = None
    rebar_outer_diameter_mm: float | None = None
    embedded_length_mm: float | None = None
    exposed_length_mm: float | None = None
    warnings: tuple[str, ...] = ()
    shared_ids: tuple[str, ...] = ()
    section_middle_mm: tuple[float, float] | None = None

    def points(self, kind: Kind) -> tuple[AssemblyPoint, ...]:
        """The points of one kind, in the order of their labels."""
        return self.sleeves if kind is Kind.SLEEVE else self.rebars


UP_DEG = {"+x": 0.0, "+y": 90.0, "-x": 180.0, "-y": -90.0}
"""Sides of a column as people write which one is at the top of a picture; degrees from +x."""

CAMERA_AXES, OPENGL_AXES, AXES_UNKNOWN = "camera", "opengl", ""
"""x right, y down, z forward; x right, y up, z backward; nobody knows."""


@dataclass(frozen=True, eq=False)
class Scan:
    """One as-built scan.

    Parameters
    ----------
    points
        (n, 3) or, organised, (h, w, 3) floating, mm, scan frame; NaN where the camera has no return.
    source
        The file as the job names it.
    sha256
        Hash of the file's bytes; empty for a scan that never was a file.
    camera
        Intrinsics where known; then the scan frame is the camera frame.
    viewpoint
        (3,) mm, where the camera stood, in the scan frame; None where unknown.
    dropped
        Points of the file that were no measurement (not finite, or marked invalid).
    image
        (h, w) uint8, optional grey picture of the same view.
    notes
        What was noticed or decided while the file was read.
    declared_scale
        Where the file itself gives its unit and the job another: what lengths become, by multiplication, if the job's
        word is to hold. 1 where there is no such conflict.
    axes
        Those of the file: ``CAMERA_AXES``, ``OPENGL_AXES`` or ``AXES_UNKNOWN``. ``points`` and ``viewpoint`` of a file
        in OpenGL's axes are turned into a camera's; :attr:`R_file_scan` leads back.
    learned
        What was learned of its camera on a plate, where the job names a profile.
    """

    points: FloatArray
    source: str = ""
    sha256: str = ""
    camera: Camera | None = None
    viewpoint: Array | None = None
    dropped: int = 0
    image: npt.NDArray[np.uint8] | None = None
    notes: tuple[str, ...] = ()
    declared_scale: float = 1.0
    axes: str = CAMERA_AXES
    learned: CameraProfile | None = None

    @property
    def R_file_scan(self) -> Array:
        """Rotation (3, 3) from the scan frame to the file's own coordinates."""
        return np.diag([1.0, -1.0, -1.0]) if self.axes == OPENGL_AXES else np.eye(3)

    @property
    def organised(self) -> bool:
        """Whether the points keep the rows and columns of the camera's image."""
        return self.points.ndim == 3


@dataclass(frozen=True, eq=False)
class Plane:
    """All x with ``normal @ x == offset``: ``normal`` (3,) unit, ``offset`` in mm.

    The normal of a foot face points out of the concrete, towards the camera.
    ``residual_mm`` is the robust standard deviation of the points about it.
    """

    normal: Array
    offset: float
    residual_mm: float = 0.0

    def height(self, points: FloatArray) -> FloatArray:
        """Signed distance (...,) mm of points (..., 3) above the plane, along the normal."""
        return points @ self.normal.astype(points.dtype) - points.dtype.type(self.offset)


@dataclass(frozen=True, eq=False)
class Extraction:
    """The points found in one scan, in the scan frame.

    ``plane`` is the foot face (sleeves) or the robust mean level of the bar tops (rebars);
    ``vertical`` (3,) is the unit vector that is "up along the column", and ``vertical_from`` says what
    gave it. ``quality`` holds plain numbers for the report. ``complete``: about the points no pixel is lost, where
    cameras lose some: as if what was not measured had been filled in. ``rings`` is how many rings of pixels the camera
    was seen to drop at steps, of sleeves at most one; None where nothing tells. Without ``noise_seen`` the surface is
    too rough for its noise to tell whether it was smoothed.
    """

    kind: Kind
    method: str
    points: tuple[AssemblyPoint, ...]
    plane: Plane | None
    vertical: Array | None
    vertical_from: str = ""
    exposed_length_mm: tuple[float | None, ...] = ()
    quality: Figures = field(default_factory=dict)
    reason: str = ""
    complete: bool = False
    rings: float | None = None
    noise_seen: bool = True


@dataclass(frozen=True, slots=True)
class ControlPoint:
    """A point known in the building and measured in the scan of the bars, mm.

    Parameters
    ----------
    known_mm
        In the model frame where ``in_model``, else in the column frame.
    scan_mm
        In the scan frame of the bars.
    u_mm
        Standard uncertainty per axis, k = 1, of the two together; None where nobody stated it.
    """

    name: str
    known_mm: Vector3
    scan_mm: Vector3
    in_model: bool
    u_mm: float | None = None


@dataclass(frozen=True, slots=True)
class ControlResidual:
    """One control point after the fit, mm: ``residual_mm`` is measured minus known, in the column frame."""

    name: str
    column_mm: Vector3
    scan_mm: Vector3
    residual_mm: Vector3
    u_mm: float


@dataclass(frozen=True, slots=True)
class AbsolutePoint:
    """One bar against its place in the building, mm: ``offset_mm`` is measured minus design, in the column frame."""

    label: str
    offset_mm: Vector2
    deviation_mm: float
    u_mm: float | None
    limit_mm: float | None
    verdict: Verdict
    probability: float | None = None
    reason: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class AbsolutePosition:
    """The bars of a column as a group against its place in the building.

    Parameters
    ----------
    verdict
        On the group's offset; not measured, with the reason, where the control points give no pose.
    T_column_scan
        (4, 4), from the control points alone.
    vertical_from
        ``control points`` or ``scan``.
    rms_mm
        Of the residuals of the control points, in the plane.
    offset_mm, deviation_mm, u_mm
        Mean of all bars, measured minus design; its length; its standard uncertainty per axis.
    turn_deg, turn_u_deg
        Turn of the group against design, counter-clockwise from above. No rule limits it.
    points
        Each bar; their verdicts are by a rule for single bars against a datum, where the profile has one, else by
        the limit of the group, and then they do not count.
    """

    verdict: Verdict
    reason: str = ""
    control_points: tuple[ControlResidual, ...] = ()
    T_column_scan: Array | None = None
    vertical_from: str = ""
    rms_mm: float | None = None
    offset_mm: Vector2 | None = None
    deviation_mm: float | None = None
    u_mm: float | None = None
    turn_deg: float | None = None
    turn_u_deg: float | None = None
    limit_mm: float | None = None
    clause: str = ""
    probability: float | None = None
    points: tuple[AbsolutePoint, ...] = ()
