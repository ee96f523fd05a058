"""What one frame tells while the column hangs over its bars: pairs, correction, verdict."""

from __future__ import annotations

from dataclasses import dataclass, field

from aadm_workbench.model.measured import Array, Figures, Vector2, Vector3
from aadm_workbench.model.results import Finding
from aadm_workbench.model.verdicts import Verdict


@dataclass(frozen=True, slots=True)
class HoistingPair:
    """A sleeve of the hanging column over its bar, mm: ``offset_mm`` is rebar minus sleeve, in the bars' frame.

    The bar's centre is projected onto the foot face along the foot's normal; ``distance_mm`` is the length between it
    and the sleeve's centre. ``u_mm`` is the standard uncertainty of the offset per axis. ``seen`` tells whether sleeve
    and bar both have evidence of their own in the frame; ``sleeve_seen`` and ``rebar_seen`` which of them: the rest
    is inferred from the pattern, or from where it was measured before hoisting.
    """

    sleeve: str
    rebar: str
    sleeve_scan_mm: Vector3 | None
    rebar_scan_mm: Vector3 | None
    offset_mm: Vector2 | None
    distance_mm: float | None
    u_mm: float | None
    seen: bool
    reason: str = ""
    sleeve_seen: bool = False
    rebar_seen: bool = False
    limit_mm: float | None = None
    verdict: Verdict = Verdict.NOT_ASSESSED
    probability: float | None = None


@dataclass(frozen=True, slots=True)
class CameraMove:
    """The correction as somebody beside the camera sees it: to the right, away from the camera, and the same turn."""

    right_mm: float
    away_mm: float
    yaw_deg: float


@dataclass(frozen=True, slots=True)
class Bend:
    """A part of a bend: ``mm`` towards the side of the pattern on which the bars ``first`` to ``last`` stand."""

    mm: float
    first: str
    last: str


@dataclass(frozen=True, slots=True)
class Repair:
    """How far a bar is to be bent to meet its sleeve once the column has been moved, in the bars' frame, mm.

    ``towards`` says the same for whoever stands before the bars, who sees no x and y; empty where the pattern has no
    sides.
    """

    label: str
    dx_mm: float
    dy_mm: float
    towards: tuple[Bend, ...] = ()


@dataclass(frozen=True, slots=True)
class Correction:
    """Displacement of the column: turned by yaw about its own axis, then moved by dx, dy, in the bars' frame.

    The turn is counter-clockwise from above, about the origin of the column frame where the column hangs now: the
    centroid of the design sleeve centres on its foot face. Of the pairs ``over``, named by their sleeves, it leaves the
    smallest largest distance; ``left_mm`` is the largest then left of all pairs, ``margin`` 1 minus its ratio to the
    limit. Pairs that are merely inferred from a pattern do not decide where the column goes. ``u_mm`` and ``u_yaw_deg``
    are standard uncertainties of the move per axis and of the turn. ``repairs`` are left to do where no move brings a
    bar and the others to their sleeves together.
    """

    dx_mm: float
    dy_mm: float
    yaw_deg: float
    left_mm: float | None = None
    margin: float | None = None
    u_mm: float | None = None
    u_yaw_deg: float | None = None
    camera: CameraMove | None = None
    over: tuple[str, ...] = ()
    repairs: tuple[Repair, ...] = ()


@dataclass(frozen=True, slots=True)
class MovedSince:
    """A point that stands elsewhere than in its scan from before hoisting, mm, with its standard uncertainty."""

    label: str
    moved_mm: float
    u_mm: float | None


@dataclass(frozen=True, slots=True)
class HoistingReport:
    """One frame taken while the column hangs over its bars; it has its own verdict.

    ``keys`` are the paper's three key points by their sleeves, ``mean_mm`` is over them, ``max_mm`` over all pairs.
    ``vertical_from`` says what gave the bars' vertical, ``orientation`` how it was settled which sleeve is which:
    ``declared`` by the job, ``resolved`` by the pattern, or ``ambiguous``: then there is no correction. ``near`` is the
    corner that was declared. ``moved_since`` are the points that stand elsewhere than before hoisting, and
    ``rests_on_scans`` labels of those that are known from then alone. ``findings`` hold back this verdict alone.
    ``joined`` names the frames that were put together, the last of which gives the bars' frame.
    """

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
    quality: Figures = field(default_factory=dict)
    height_mm: float | None = None
    vertical_from: str = ""
    orientation: str = ""
    findings: tuple[Finding, ...] = ()
    near: str | None = None
    moved_since: tuple[MovedSince, ...] = ()
    rests_on_scans: tuple[str, ...] = ()
    joined: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """What it is called: the frame's source, or those of all that were put together."""
        return " + ".join(self.joined) or self.source


@dataclass(frozen=True, eq=False, slots=True)
class HoistingMeasurement:
    """A frame as it is reported, and in full precision for whoever goes on calculating.

    Parameters
    ----------
    offsets_mm
        (k, 2) rebar minus sleeve in the bars' frame, in the order of the design; NaN where not known.
    covariances
        (k, 2, 2) mm² of the offsets.
    T_bars_column, T_scan_bars
        (4, 4): the hanging column in the bars' frame, and the bars' frame in the scan frame; None without a fit.
    """

    report: HoistingReport
    offsets_mm: Array
    covariances: Array
    T_bars_column: Array | None = None
    T_scan_bars: Array | None = None
