"""Where the bars stand in the building: control points, and the absolute position that they give."""

from __future__ import annotations

from dataclasses import dataclass

from aadm_workbench.model.measured import Array, Vector2, Vector3
from aadm_workbench.model.verdicts import Verdict


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
