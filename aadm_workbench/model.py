"""The nouns of the product: what passes from one stage to the next.

Units inside are millimetres, radians and float64. A transform is named by what it maps,
``T_to_from @ point_from = point_to``, a (4, 4) matrix for column vectors.

Frames: *scan frame* (x right, y down, z forward from the camera, or the frame of the file),
*column frame* (origin on the foot face at the centroid of the design sleeve centres, z up along
the column) and *model frame* (of the IFC or FreeCAD model).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
FloatArray: TypeAlias = npt.NDArray[np.floating[Any]]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
IntArray: TypeAlias = npt.NDArray[np.int64]


class Verdict(StrEnum):
    """What a comparison with a limit came to; ``NOT_ASSESSED`` is listed and never counted."""

    PASS = "pass"
    INCONCLUSIVE = "inconclusive"
    NOT_MEASURED = "not_measured"
    FAIL = "fail"
    ERROR = "error"
    NOT_ASSESSED = "not_assessed"


_WORST_FIRST = (Verdict.ERROR, Verdict.FAIL, Verdict.NOT_MEASURED, Verdict.INCONCLUSIVE, Verdict.PASS)


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the worst of some verdicts: error, fail, not_measured, inconclusive, pass.

    ``NOT_ASSESSED`` does not count; where nothing counts, the sum is ``NOT_MEASURED``: a check
    that applied to nothing has not passed.
    """
    present = set(verdicts)
    return next((verdict for verdict in _WORST_FIRST if verdict in present), Verdict.NOT_MEASURED)


class Kind(StrEnum):
    """The two kinds of assembly point."""

    SLEEVE = "sleeve"
    REBAR = "rebar"

    @property
    def plural(self) -> str:
        return f"{self.value}s"

    @property
    def letter(self) -> str:
        return "S" if self is Kind.SLEEVE else "R"


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


@dataclass(frozen=True, eq=False)
class ColumnDesign:
    """One column as designed: sleeves and the rebars it comes down on, in the column frame.

    ``rebars[k]`` belongs into ``sleeves[k]``. ``T_model_column`` (4, 4) places the column frame in the
    model; None for a design without a model. ``names`` holds every name that a job may call it by
    (Name, Tag, PieceMark, GlobalId).
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
    warnings: tuple[str, ...] = ()

    def points(self, kind: Kind) -> tuple[AssemblyPoint, ...]:
        """The points of one kind, in the order of their labels."""
        return self.sleeves if kind is Kind.SLEEVE else self.rebars


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
    """

    points: FloatArray
    source: str = ""
    sha256: str = ""
    camera: Camera | None = None
    viewpoint: Array | None = None
    dropped: int = 0
    image: npt.NDArray[np.uint8] | None = None

    @property
    def organised(self) -> bool:
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
    gave it. ``quality`` holds plain numbers for the report.
    """

    kind: Kind
    method: str
    points: tuple[AssemblyPoint, ...]
    plane: Plane | None
    vertical: Array | None
    vertical_from: str = ""
    exposed_length_mm: tuple[float | None, ...] = ()
    quality: dict[str, Any] = field(default_factory=dict)
    reason: str = ""


@dataclass(frozen=True)
class Rule:
    """One tolerance: what it limits, how far, and where that is written.

    ``upper``/``lower`` in mm; ``advisory`` rules are reported and not counted. ``source`` is
    ``verified`` or ``unverified``. ``kind`` says how the deviation is taken (``radial``, ``per_axis`` or
    ``signed``), ``level`` what it is taken against (``bar_in_group``, ``group_to_datum`` or ``component``).
    """

    name: str
    limits: str
    upper: float
    lower: float | None
    clause: str
    severity: str
    source: str
    advisory: bool = False
    edition: str = ""
    note: str = ""
    kind: str = "radial"
    level: str = "bar_in_group"


@dataclass(frozen=True)
class Profile:
    """A named set of rules."""

    name: str
    title: str
    rules: tuple[Rule, ...]
    adjustment_limit_mm: float | None = None

    def rule(self, name: str) -> Rule | None:
        """The rule of that name, or None where the profile has none."""
        return next((rule for rule in self.rules if rule.name == name), None)


@dataclass(frozen=True)
class Deviation:
    """A value against its limit: mm, with its standard uncertainty (per axis, k = 1) and clause."""

    value_mm: float
    u_mm: float | None
    lower_mm: float | None
    upper_mm: float
    clause: str
    verdict: Verdict


Vector2: TypeAlias = tuple[float, float]
Vector3: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Candidate:
    """One way in which a measured pattern lies on its design.

    ``yaw_deg`` is its turn against the first candidate, counter-clockwise from above. ``up_deg`` is the column-frame direction of the image's top in this candidate (what ``up`` of a job
    would have to say to choose it), None where the scan has no image direction.
    """

    yaw_deg: float
    rms_mm: float
    max_mm: float
    matched: int
    up_deg: float | None = None
    verdict: Verdict | None = None


@dataclass(frozen=True, eq=False)
class Fit:
    """How a scan was laid on its design: ``T_design_scan`` (4, 4), in-plane least squares of all matched points.

    ``orientation`` is ``declared``, ``resolved`` or ``ambiguous``; ``scale`` is the free scale of the same fit,
    a diagnostic of the camera that is never applied.
    """

    T_design_scan: Array
    rms_mm: float
    max_mm: float
    orientation: str
    candidates: tuple[Candidate, ...] = ()
    scale: float | None = None


@dataclass(frozen=True)
class PointResult:
    """One design point and what was measured of it, mm: ``offset_mm`` is measured minus design, in the column frame.

    ``u_mm`` is the standard uncertainty of the deviation per axis, with the fit's part; ``probability`` that
    the true deviation is within the limit. What was not measured is None, and ``reason`` says why.
    """

    label: str
    global_id: str | None
    design_mm: Vector3
    scan_mm: Vector3 | None
    aligned_mm: Vector3 | None
    diameter_mm: float | None
    axis_tilt_deg: float | None
    offset_mm: Vector2 | None
    deviation_mm: float | None
    u_mm: float | None
    limit_mm: float | None
    verdict: Verdict
    reason: str = ""
    probability: float | None = None
    exposed_length_mm: float | None = None


@dataclass(frozen=True)
class SpacingResult:
    """Distance in the plane between two adjacent centres, mm: ``deviation_mm`` is measured minus design, signed."""

    between: tuple[str, str]
    design_mm: float
    measured_mm: float | None
    deviation_mm: float | None
    u_mm: float | None
    limit_mm: tuple[float | None, float] | None
    verdict: Verdict
    reason: str = ""
    probability: float | None = None


@dataclass(frozen=True)
class RuleResult:
    """One rule of the profile and the worst it came to; ``counted`` is False for advisory rules."""

    rule: str
    clause: str
    source: str
    verdict: Verdict
    counted: bool
    reason: str = ""
    worst_mm: float | None = None


@dataclass(frozen=True, eq=False)
class GroupReport:
    """The sleeves or the rebars of one column: every design point, the spacing of neighbours, the fit.

    ``points`` and ``spacing`` are of the candidate that ``fit`` names; where the orientation is ambiguous,
    their verdicts and ``verdict`` hold only what all candidates agree on.
    """

    kind: Kind
    source: str
    sha256: str
    method: str
    expected: int
    found: int
    verdict: Verdict
    points: tuple[PointResult, ...]
    spacing: tuple[SpacingResult, ...]
    fit: Fit | None
    rules: tuple[RuleResult, ...] = ()
    reasons: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    quality: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class PairResult:
    """A rebar against the sleeve it enters, mm: ``offset_mm`` is rebar minus sleeve, in the column frame.

    ``clearance_mm`` is the room between the ribs and the sleeve's wall, less the larger of the offsets at the
    mouth and at the bar's top; below zero they collide. None where a diameter is not known.
    """

    sleeve: str
    rebar: str
    offset_mm: Vector2
    distance_mm: float
    u_mm: float | None
    limit_mm: float | None
    clearance_mm: float | None
    verdict: Verdict
    reason: str = ""
    probability: float | None = None


@dataclass(frozen=True, eq=False)
class TrialPose:
    """Bars brought onto sleeves in one way: ``T_sleeves_rebars`` (4, 4), both already in the column frame.

    ``sd_mm`` is the population standard deviation of the distances (divided by n).
    """

    T_sleeves_rebars: Array
    max_mm: float
    mean_mm: float
    sd_mm: float
    pairs: tuple[PairResult, ...]


@dataclass(frozen=True)
class PoseWindow:
    """How far the column can move from the minimax pose, one number at a time reaching its end, mm and degrees.

    Displacement of the column: turned by yaw about the origin of the column frame, then moved by dx, dy.
    """

    dx_mm: Vector2
    dy_mm: Vector2
    yaw_deg: Vector2


@dataclass(frozen=True)
class TurnResult:
    """The trial in one of the column's symmetric turns."""

    turn_deg: float
    max_mm: float | None
    verdict: Verdict


@dataclass(frozen=True, eq=False)
class TrialReport:
    """The virtual trial assembly of a column: does it go on these bars.

    ``margin`` is 1 minus the smallest largest ratio of distance to limit (negative: no pose meets the limits),
    ``probability`` that a pose exists, ``window`` the room about the minimax pose where there is any.
    """

    verdict: Verdict
    least_squares: TrialPose | None = None
    minimax: TrialPose | None = None
    collisions: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    reasons: tuple[str, ...] = ()
    rules: tuple[RuleResult, ...] = ()
    probability: float | None = None
    margin: float | None = None
    window: PoseWindow | None = None
    turn_deg: float = 0.0
    turns: tuple[TurnResult, ...] = ()
    embedded_length_mm: float | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class HoistingPair:
    """A sleeve of the hanging column over its bar, mm: ``offset_mm`` is rebar minus sleeve, in the bars' frame."""

    sleeve: str
    rebar: str
    sleeve_scan_mm: Vector3 | None
    rebar_scan_mm: Vector3 | None
    offset_mm: Vector2 | None
    distance_mm: float | None
    u_mm: float | None
    seen: bool
    reason: str = ""


@dataclass(frozen=True)
class Correction:
    """Displacement of the column: turned by yaw about the column frame's origin, then moved by dx, dy."""

    dx_mm: float
    dy_mm: float
    yaw_deg: float


@dataclass(frozen=True)
class HoistingReport:
    """One frame taken while the column hangs over its bars; it has its own verdict."""

    source: str
    keys: tuple[str, ...]
    mean_mm: float | None
    max_mm: float | None
    column_tilt_deg: float | None
    verdict: Verdict
    pairs: tuple[HoistingPair, ...] = ()
    correction: Correction | None = None
    reasons: tuple[str, ...] = ()
    sha256: str = ""
    method: str = ""
    quality: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class ColumnReport:
    """Everything that report.json holds about one column."""

    id: str
    verdict: Verdict
    goes_on: Verdict
    reasons: tuple[str, ...] = ()
    sleeves: GroupReport | None = None
    rebars: GroupReport | None = None
    trial_assembly: TrialReport | None = None
    hoisting: tuple[HoistingReport, ...] = ()
    global_id: str | None = None
    piece_mark: str | None = None
    storey: str | None = None
    grid: str | None = None
    size_mm: tuple[float, float] | None = None
    T_model_column: Array | None = None
    rules: tuple[RuleResult, ...] = ()
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class JobReport:
    """Everything that report.json holds: one job, its inputs by hash, its columns."""

    tool: dict[str, str]
    job: dict[str, str]
    capture: dict[str, str]
    model: dict[str, str] | None
    profile: Profile
    columns: tuple[ColumnReport, ...]

    def summary(self) -> dict[str, int]:
        """How many columns came to each verdict: pass, fail, inconclusive, not_measured, error."""
        counted = (Verdict.PASS, Verdict.FAIL, Verdict.INCONCLUSIVE, Verdict.NOT_MEASURED, Verdict.ERROR)
        return {verdict.value: sum(column.verdict is verdict for column in self.columns) for verdict in counted}
