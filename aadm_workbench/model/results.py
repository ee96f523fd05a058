"""What was found of a column before hoisting: its points, their spacing, the trial assembly."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from aadm_workbench.model.measured import AbsolutePosition, Array, Figures, Vector2, Vector3
from aadm_workbench.model.verdicts import Source, Verdict


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing about a column that somebody should look at, as a value.

    Parameters
    ----------
    code
        What kind of thing: ``diameter_differs``, ``scale_differs``, ``mirrored``, ...
    about
        Labels of points, or ``sleeves``, ``rebars``, ``column``.
    values
        The numbers and names that ``text`` is made of; names of lengths end in ``_mm``.
    text
        One sentence, in English; :mod:`~aadm_workbench.model.sentences.finding` has it in Chinese too.
    holds_back
        Whether the column must not pass before this is settled.
    """

    code: str
    about: tuple[str, ...]
    values: Figures = field(default_factory=dict)
    text: str = ""
    holds_back: bool = False


Orientation: TypeAlias = Literal["declared", "resolved", "ambiguous"]


@dataclass(frozen=True, slots=True)
class Candidate:
    """One way in which a measured pattern lies on its design.

    ``yaw_deg`` is its turn against the first candidate, counter-clockwise from above. ``up_deg`` is the
    column-frame direction of the image's top in this candidate (what ``up`` of a job would have to say to choose
    it), None where the scan has no image direction. ``labels`` says which point of this candidate each point of the
    first one is.
    """

    yaw_deg: float
    rms_mm: float
    max_mm: float
    matched: int
    up_deg: float | None = None
    verdict: Verdict | None = None
    labels: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True, eq=False, slots=True)
class Fit:
    """How a scan was laid on its design: ``T_design_scan`` (4, 4), in-plane least squares of all matched points.

    ``orientation`` is ``declared``, ``resolved`` or ``ambiguous``; ``scale`` is the free scale of the same fit,
    a diagnostic of the camera that is never applied. ``declared_up`` is the ``up`` of the job where the pattern alone
    would leave several turns: which point is which hangs on it.
    """

    T_design_scan: Array
    rms_mm: float
    max_mm: float
    orientation: Orientation
    candidates: tuple[Candidate, ...] = ()
    scale: float | None = None
    declared_up: str | None = None


@dataclass(frozen=True, slots=True)
class PointResult:
    """One design point and what was measured of it, mm: ``offset_mm`` is measured minus design, in the column frame.

    ``u_mm`` is the standard uncertainty of the deviation per axis, with the fit's part; ``probability`` that
    the true deviation is within the limit. ``axis`` is a unit vector that points up along the column, in the column
    frame, ``u_axis_deg`` its standard uncertainty per axis. ``cov_mm2`` is the covariance of ``scan_mm`` in the face
    plane, turned into the column frame, before any fit and with the camera's scale error. What was not measured is
    None, and ``reason`` says why.
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
    axis: Vector3 | None = None
    u_axis_deg: float | None = None
    cov_mm2: tuple[Vector2, Vector2] | None = None


@dataclass(frozen=True, slots=True)
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


@dataclass(frozen=True, slots=True)
class RuleResult:
    """One rule of the profile and the worst it came to; ``counted`` is False for advisory rules."""

    rule: str
    clause: str
    source: Source
    verdict: Verdict
    counted: bool
    reason: str = ""
    worst_mm: float | None = None


@dataclass(frozen=True, eq=False, slots=True)
class GroupReport:
    """The sleeves or the rebars of one column: every design point, the spacing of neighbours, the fit.

    ``points`` and ``spacing`` are of the candidate that ``fit`` names; where the orientation is ambiguous,
    their verdicts and ``verdict`` hold only what all candidates agree on. ``absolute`` is where the group stands in the
    building; None without control points. ``blamed`` are those that stand off, where the fit of all lets others fail.
    """

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
    quality: Figures = field(default_factory=dict)
    absolute: AbsolutePosition | None = None
    blamed: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
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


@dataclass(frozen=True, eq=False, slots=True)
class TrialPose:
    """Bars brought onto sleeves in one way: ``T_sleeves_rebars`` (4, 4), both already in the column frame.

    ``sd_mm`` is the population standard deviation of the distances (divided by n).
    """

    T_sleeves_rebars: Array
    max_mm: float
    mean_mm: float
    sd_mm: float
    pairs: tuple[PairResult, ...]


@dataclass(frozen=True, slots=True)
class BestPair(PairResult):
    """A pair at the pose that leaves most: its verdict holds for the distance and the room together.

    Parameters
    ----------
    room_mm
        What is left between the ribs and the sleeve's wall where they come nearest over the embedded length, as
        ``clearance_mm``; None where a diameter is not known.
    u_room_mm
        Standard uncertainty of that, from centres, leans and diameters; None where that of a centre is not known.
    allowance_mm
        The room between them with both axes in one line: half of the difference of the diameters.
    margin
        1 minus the larger ratio of a gap to its limit or allowance; None where a bar is as wide as its sleeve.
    seen_length_mm
        How much of the embedded length of the bar was seen; None where the extraction does not say.
    """

    room_mm: float | None = None
    u_room_mm: float | None = None
    allowance_mm: float | None = None
    margin: float | None = None
    seen_length_mm: float | None = None


@dataclass(frozen=True, eq=False, slots=True)
class BestPose(TrialPose):
    """The pose with the largest ``margin``, of distances and of room, each over what is allowed to it."""

    pairs: tuple[BestPair, ...]
    margin: float | None = None


@dataclass(frozen=True, slots=True)
class PoseWindow:
    """How far the column can move from the best pose, one number at a time reaching its end, mm and degrees.

    Displacement of the column: turned by yaw about the origin of the column frame, then moved by dx, dy.
    """

    dx_mm: Vector2
    dy_mm: Vector2
    yaw_deg: Vector2


@dataclass(frozen=True, slots=True)
class AimedPose:
    """Where in its play the column is to be set: what the job ``asked`` for, as far as every limit is kept.

    Parameters
    ----------
    dx_mm, dy_mm, yaw_deg
        From where its bars have it by design: turned by yaw about the origin of the column frame, then moved.
    asked
        The same as the job has it.
    max_mm
        Largest distance of a bar from its sleeve there.
    from_minimax
        dx, dy mm and yaw degrees from the pose with the smallest largest distance, in the bars' frame.
    """

    dx_mm: float
    dy_mm: float
    yaw_deg: float
    asked: Vector3
    max_mm: float
    from_minimax: Vector3


@dataclass(frozen=True, slots=True)
class TurnResult:
    """The trial in one of the column's symmetric turns."""

    turn_deg: float
    max_mm: float | None
    verdict: Verdict


@dataclass(frozen=True, eq=False, slots=True)
class TrialReport:
    """The virtual trial assembly of a column: does it go on these bars.

    It asks whether a pose exists in which every pair keeps its limit of the distance and its room over the ribs.
    ``best`` is the pose that leaves most of both, and ``margin`` what it leaves (negative: no pose meets them all);
    ``probability`` that a pose exists; where a pair was not measured it is None, unless those that were have none: then
    theirs, which is the most that it can be. ``window`` is the room about the best pose where there is any.
    ``collisions`` are the sleeves whose bars have no room at the best pose, ``in_the_way`` the bars, or sleeves, that
    would have to be put right, ``rescan`` the points whose uncertainty leaves the verdict open. ``target`` is where in
    the play the job asks the column to be set.
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
    best: BestPose | None = None
    in_the_way: tuple[str, ...] = ()
    rescan: tuple[str, ...] = ()
    target: AimedPose | None = None

    @property
    def shown(self) -> TrialPose | None:
        """The pose that people are shown, on which the verdict stands: the best; minimax in older reports."""
        return self.best or self.minimax

    @property
    def poses(self) -> dict[str, TrialPose]:
        """Those that were found, by their names, the one that is shown first."""
        found = {"best": self.best, "minimax": self.minimax, "least_squares": self.least_squares}
        return {name: pose for name, pose in found.items() if pose is not None}
