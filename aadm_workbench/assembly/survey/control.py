"""The pose of a scan in the building, from control points: known there, and measured in the scan.

Three points or more that are not on one line give the whole pose; two, or points on one line, give it together with
the vertical that the scan itself shows.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.eopa import EopaFit, NoFit, fit_eopa, fit_eopa_planar, plane_basis, upright_transform
from aadm_workbench.model import Array, ControlPoint, Reason

DEFAULT_U_MM = 0.5
"""Standard uncertainty per axis of a control point of which nobody stated one: a good total station's."""

LARGEST_RESIDUAL_MM = 10.0
"""Control points that disagree by more, and by more than five of their uncertainties, contradict each other."""

VERTICAL_U_RAD = math.radians(0.1)
"""Standard uncertainty per axis of a vertical taken from the scan of the bars."""

VERTICAL_WITHIN_RAD = math.radians(5.0)
"""By control points and by the scan verticals differ by less: columns and floors stand to a fraction of a degree."""

_ON_ONE_LINE = 0.02  # of their length: points nearer to one line let a pose turn about it
_SIGMAS = 5.0  # a normal error is farther off once in two million times


@dataclass(frozen=True, eq=False)
class ControlPose:
    """Where a scan lies in the column frame.

    Parameters
    ----------
    T_column_scan
        (4, 4).
    known
        (n, 3) mm, column frame.
    residuals
        (n, 3) mm, column frame: measured minus known.
    u_mm
        (n,) standard uncertainties per axis, raised where the residuals are larger than those stated.
    pivot
        (3,) mm, centroid of the known points.
    covariance
        (6, 6), of the shift, mm, and of the rotation about the pivot, radians.
    vertical_from
        ``control points`` or ``scan``.
    """

    T_column_scan: Array
    known: Array
    residuals: Array
    u_mm: Array
    pivot: Array
    covariance: Array
    vertical_from: str

    @property
    def rms_mm(self) -> float:
        """Root of the mean of the squared residuals in the plane."""
        return float(np.sqrt((self.residuals[:, :2] ** 2).sum(axis=1).mean()))

    def covariance_at(self, point: Array) -> Array:
        """Covariance (2, 2), mm², in the plane, that the pose alone gives to a point (3,) mm of the column frame."""
        jacobian = _jacobian(point - self.pivot)[:2]
        return np.asarray(jacobian @ self.covariance @ jacobian.T)


def fit_control_points(
    points: Sequence[ControlPoint], T_model_column: Array | None, vertical_scan: Array | None
) -> ControlPose | NoFit:
    """The pose of the scan that holds the control points.

    Parameters
    ----------
    T_model_column
        (4, 4); needed for points that are known in the model frame.
    vertical_scan
        (3,) unit, scan frame, up along the column; None where the scan does not show it.

    Returns
    -------
    ControlPose, or NoFit with the reason: too few points, no vertical, or points that contradict each other.
    """
    if T_model_column is None and any(point.in_model for point in points):
        return NoFit(Reason("survey.control_no_model"))
    known = np.array([_in_column_frame(point, T_model_column) for point in points]).reshape(-1, 3)
    scan = np.array([point.scan_mm for point in points], dtype=np.float64).reshape(-1, 3)
    u_mm = np.array([DEFAULT_U_MM if point.u_mm is None else point.u_mm for point in points])
    if _spans_a_plane(known):
        pose = _whole_pose(scan, known, u_mm)
    elif vertical_scan is None:
        return NoFit(Reason("survey.control_on_line"))
    else:
        pose = _upright_pose(scan, known, u_mm, vertical_scan)
    if isinstance(pose, NoFit):
        return pose
    reason = _contradiction(points, pose, scan, vertical_scan)
    return NoFit(reason) if reason else pose


def shown_up_deg(pose: ControlPose, image_up_scan: Array) -> float | None:
    """Column-frame direction, degrees from +x, that a direction (3,) of the scan shows; None where it is upright."""
    x, y, z = pose.T_column_scan[:3, :3] @ image_up_scan
    # Within 17° of upright its direction in plan is that of noise.
    return math.degrees(math.atan2(y, x)) if math.hypot(x, y) > 0.3 * math.hypot(x, y, z) else None


def _in_column_frame(point: ControlPoint, T_model_column: Array | None) -> Array:
    known = np.array(point.known_mm, dtype=np.float64)
    if not point.in_model or T_model_column is None:
        return known
    # Subtracted before it is turned: map coordinates of 10^9 mm would leave no digits.
    return np.asarray(T_model_column[:3, :3].T @ (known - T_model_column[:3, 3]))


def _spans_a_plane(known: Array) -> bool:
    if len(known) < 3:
        return False
    extents = np.linalg.svd(known - known.mean(axis=0), compute_uv=False)
    return bool(extents[1] > _ON_ONE_LINE * extents[0])


def _whole_pose(scan: Array, known: Array, u_mm: Array) -> ControlPose | NoFit:
    fit = fit_eopa(scan, known, 1.0 / u_mm**2)
    if isinstance(fit, NoFit):
        return fit
    return _pose(fit.T, scan, known, u_mm, "control points")


def _upright_pose(scan: Array, known: Array, u_mm: Array, vertical_scan: Array) -> ControlPose | NoFit:
    basis = plane_basis(vertical_scan)
    flat = scan @ basis.T
    fit = fit_eopa_planar(np.ascontiguousarray(flat[:, :2]), np.ascontiguousarray(known[:, :2]), 1.0 / u_mm**2)
    if not isinstance(fit, EopaFit):
        return NoFit(Reason("survey.control_no_turn", why=fit.reason))
    rise = float((known[:, 2] - flat[:, 2]).mean())
    return _pose(upright_transform(basis, fit.yaw, fit.t, rise), scan, known, u_mm, "scan")


def _pose(T: Array, scan: Array, known: Array, u_mm: Array, vertical_from: str) -> ControlPose:
    residuals = scan @ T[:3, :3].T + T[:3, 3] - known
    freedom = max(2 * len(scan) - 3, 1)
    # Birge's ratio: stated uncertainties are raised to what the residuals show, never lowered.
    excess = math.sqrt(max(1.0, float(((residuals[:, :2] / u_mm[:, None]) ** 2).sum()) / freedom))
    raised, pivot = u_mm * excess, np.asarray(known.mean(axis=0))
    information = np.zeros((6, 6))
    for place, u in zip(known - pivot, raised, strict=True):
        jacobian = _jacobian(place)
        information += jacobian.T @ jacobian / u**2
    covariance: Array = np.zeros((6, 6))
    if vertical_from == "control points":
        covariance = np.asarray(np.linalg.inv(information), dtype=np.float64)
    else:
        plane = np.ix_([0, 1, 5], [0, 1, 5])
        covariance[plane] = np.linalg.inv(_planar_information(known - pivot, raised))
        covariance[3, 3] = covariance[4, 4] = VERTICAL_U_RAD**2
    return ControlPose(T, known, residuals, raised, pivot, covariance, vertical_from)


def _planar_information(places: Array, u_mm: Array) -> Array:
    information = np.zeros((3, 3))
    for place, u in zip(places, u_mm, strict=True):
        jacobian = _jacobian(place)[:2][:, [0, 1, 5]]
        information += jacobian.T @ jacobian / u**2
    return information


def _jacobian(place: Array) -> Array:
    """How a point (3,) mm from the pivot moves with the shift and with the rotation, (3, 6)."""
    x, y, z = place
    return np.hstack([np.eye(3), np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])])


def _contradiction(points: Sequence[ControlPoint], pose: ControlPose, scan: Array, vertical_scan: Array | None) -> str:
    """What is wrong with the control points; empty where nothing is."""
    lengths = np.linalg.norm(pose.residuals, axis=1)
    worst = int(np.argmax(lengths / np.maximum(pose.u_mm, 1e-9)))
    stated = np.array([DEFAULT_U_MM if point.u_mm is None else point.u_mm for point in points])
    if lengths[worst] > max(LARGEST_RESIDUAL_MM, _SIGMAS * float(stated[worst])):
        extents = [float(np.sqrt(((v - v.mean(axis=0)) ** 2).sum())) for v in (pose.known, scan)]
        stretch = extents[0] / max(extents[1], 1e-12)
        # A tenth longer or shorter is no slip of a point: units, or a camera's scale.
        code = "survey.control_contradict" if 0.9 < stretch < 1.1 else "survey.control_contradict.scale"
        return Reason(code, name=points[worst].name, off_mm=lengths[worst], stretch=stretch)
    if vertical_scan is not None:
        cosine = float(pose.T_column_scan[2, :3] @ vertical_scan)
        off = math.acos(min(1.0, max(-1.0, cosine)))
        if off > VERTICAL_WITHIN_RAD:
            return Reason("survey.control_lean", lean_deg=math.degrees(off))
    return ""
