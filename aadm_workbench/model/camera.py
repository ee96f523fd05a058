"""A camera: its intrinsics, and what was learned about it with its settings from captures of a plate."""

from __future__ import annotations

from dataclasses import dataclass, field

from aadm_workbench.model.verdicts import Kind


@dataclass(frozen=True)
class Camera:
    """Pinhole intrinsics of an undistorted structured-light camera, in pixels.

    ``scale_error`` is the relative standard uncertainty (k = 1) of its lengths.
    """

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int
    scale_error: float = 1e-4


@dataclass(frozen=True, slots=True)
class Measure:
    """A number and its standard uncertainty (k = 1)."""

    value: float
    u: float


@dataclass(frozen=True, slots=True)
class LearnedEdges:
    """What a camera does to the centres of one kind of point, all by the camera's foot point on the face.

    Parameters
    ----------
    stretch
        Relative: centres are seen ``1 + stretch`` times as far from the foot point as they are.
    spread
        What the stretch of a single capture differs by, standard deviation.
    scatter_pitches
        What a centre is off besides, per axis, in distances of neighbouring pixels.
    size
        Relative: diameters are seen ``1 + size`` times as large.
    lost
        Slopes of sight, or of light, into the wall behind an edge, rising; for each, how far behind the edge the
        surface is seen to end, in distances of neighbouring pixels. Empty: not learned.
    share
        Of discs that are set right by ``lost``, in each centre; the rest is the fit of all witnesses.
    rings
        How many rings of pixels the camera was seen to drop at steps, as :class:`~aadm_workbench.model.Extraction` has
        it; None where nothing told.
    apart_pitches
        How far, per axis, all centres of this kind may be off together.
    """

    stretch: Measure
    spread: float
    scatter_pitches: float
    size: Measure
    lost: tuple[tuple[float, float], ...] = ()
    share: float = 0.0
    apart_pitches: float = 0.0
    rings: float | None = None


@dataclass(frozen=True)
class CameraProfile:
    """A camera's profile, as its file holds it.

    ``serial`` and ``settings`` are what it holds for, ``date`` (ISO) when it was learned and ``valid_days`` how long it
    is believed. ``distance_mm`` and ``tilt_deg`` are the ranges of the captures. ``scale`` is relative, by the steps
    from face to pins. ``sha256`` is of the file's bytes. ``projector_mm`` is where the light comes from, along the x
    and y of the picture from the camera; zero where that makes no difference to what is seen at edges. ``laws`` is the
    number of the laws of extraction that it was learned by, zero where its file does not say.
    """

    source: str
    sha256: str
    serial: str
    settings: str
    date: str
    valid_days: int
    camera: Camera
    distance_mm: tuple[float, float]
    tilt_deg: tuple[float, float]
    scale: Measure
    edges: dict[Kind, LearnedEdges] = field(default_factory=dict)
    plate_sha256: str = ""
    captures: int = 0
    projector_mm: tuple[float, float] = (0.0, 0.0)
    laws: int = 0
