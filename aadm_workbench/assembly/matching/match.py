"""Which measured point is which design point, and how the scan lies on the design.

Works under any rigid pose, with points missing, points too many and single errors of 15 mm. The vertical is known,
so neither a mirror nor a flip is possible; the turns that a symmetric pattern leaves open are settled by the
declared ``up``, else by the pattern's own asymmetry, else they are all reported. Where a part of a periodic pattern
was seen, places beside each other fit alike in the same turn: no ``up`` settles those. What the pattern contradicts,
a declared ``up`` or a scan from the other side, is no match, with that reason.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.matching.pattern_search import (
    CONTRADICTS_LOG_RATIO,
    DISTINCT_LOG_RATIO,
    PlanarPlacement,
    log_likelihood,
    search_placements,
)
from aadm_workbench.assembly.matching.symmetry import is_its_own_mirror
from aadm_workbench.assembly.pose.eopa import EopaFit, fit_eopa_planar, plane_basis, upright_transform, wrap
from aadm_workbench.model import Array, AssemblyPoint, Extraction, IntArray, Orientation, Reason
from aadm_workbench.model.special import median

DECLARED_WITHIN_RAD = math.radians(44.0)
"""A declared direction chooses the nearest turn within this; half of the 90° between the turns of a square."""

UP_TELLS_RAD = math.radians(4.0)
"""Turns nearer to each other than this are one turn to whoever declares ``up``: nobody holds a camera better."""

FAR_FROM_DECLARED = 40.5 / 45.0
"""Of the way from a turn to the middle between it and the next one: beyond it a declared ``up`` is hardly one.

On a square ring that is more than 40° of 45°, to the degree."""

SMALLEST_SCALE_MM = 1.0
"""Deviations are taken to be at least this large when turns are compared: bars and sleeves are built to 2 mm."""


@dataclass(frozen=True, eq=False)
class Placement:
    """One way in which a scan lies on its design.

    Parameters
    ----------
    T_design_scan
        (4, 4) float64: in-plane least squares of all matched points; the mean height of the matched points is
        brought to that of their design points.
    matched
        (m,) int64, for each design point the index of the measured one, −1 for none.
    yaw
        Radians, of the turn within the plane across the vertical.
    up
        Radians from +x, column-frame direction of the image's top; None where the scan has none.
    rms_mm, max_mm
        Of the radial deviations of the matched points.
    cost_mm
        Sum of the distances of a robust fit, cut off at the gate: what placements are ordered by.
    scale
        Free scale of the fit, a diagnostic.
    log_likelihood
        What placements of one scan are compared by: see :mod:`~aadm_workbench.assembly.matching.pattern_search`.
    scatter_mm
        Per axis, of the matched points about their design places, robust; what a wrong scale adds is left out.
    """

    T_design_scan: Array
    matched: IntArray
    yaw: float
    up: float | None
    rms_mm: float
    max_mm: float
    cost_mm: float
    scale: float
    log_likelihood: float = 0.0
    scatter_mm: float = 0.0

    @property
    def found(self) -> int:
        """How many design points were found."""
        return int((self.matched >= 0).sum())


@dataclass(frozen=True, eq=False)
class Match:
    """The placements that the data allow, the chosen one first; false where there is none, with the ``reason``.

    Parameters
    ----------
    orientation
        ``declared``, ``resolved`` or ``ambiguous``; says nothing without a placement.
    extra
        The measured points that belong to no design point.
    contradiction
        Where there is no match because the pattern contradicts what was declared: ``mirrored`` or
        ``turn_contradicted``; else empty.
    contradicting
        Of a contradicted turn: the placement that fits, and that nearest to the declaration where there is one.
    declared
        Radians, the ``up`` that chose among the placements; None without one.
    open_turn
        Of a declared ``up``: how far it is off the chosen turn, as a part of the way to the middle between this turn
        and the next one; None where nothing had to be chosen.
    """

    placements: tuple[Placement, ...] = ()
    orientation: Orientation = "resolved"
    reason: str = ""
    extra: tuple[int, ...] = ()
    contradiction: str = ""
    contradicting: tuple[Placement, ...] = ()
    declared: float | None = None
    open_turn: float | None = None

    def __bool__(self) -> bool:
        return bool(self.placements)

    @property
    def evaluated(self) -> tuple[Placement, ...]:
        """The placements that a verdict must hold in: all of an ambiguous match, else the chosen one."""
        return self.placements if self.orientation == "ambiguous" else self.placements[:1]

    @property
    def is_shifted(self) -> bool:
        """Whether two of the placements that are open lie beside each other in the same turn."""
        return any(_apart(a, b) < UP_TELLS_RAD for k, a in enumerate(self.evaluated) for b in self.evaluated[:k])


def match_extraction(
    design: Sequence[AssemblyPoint],
    extraction: Extraction,
    *,
    up: Array | float | None = None,
    image_up_scan: Array | None = None,
) -> Match:
    """Match the points of one extraction to the design points of their kind; parameters as :func:`match_points`."""
    if not extraction.points:
        return Match(reason=extraction.reason or Reason("assembly.none_found", kind=extraction.kind.value))
    if extraction.vertical is None:
        return Match(reason=extraction.reason or Reason("assembly.no_vertical"))
    measured = np.array([point.centre for point in extraction.points])
    centres = np.array([point.centre for point in design])
    return match_points(measured, extraction.vertical, centres, up=up, image_up_scan=image_up_scan)


def match_points(
    measured: Array,
    vertical: Array,
    design: Array,
    *,
    up: Array | float | None = None,
    image_up_scan: Array | None = None,
) -> Match:
    """Match measured to design points and find the pose of the scan.

    Parameters
    ----------
    measured
        (n, 3) float64, mm, scan frame.
    vertical
        (3,) float64, scan frame, pointing up along the column.
    design
        (m, 3) float64, mm, column frame.
    up
        (2,) direction in the column frame, or degrees from +x counter-clockwise seen from above, that
        ``image_up_scan`` shows; None where nobody declared it.
    image_up_scan
        (3,) direction in the scan frame, for an image (0, −1, 0): its top.
    """
    needed = max(2, min(3, len(design)))
    if len(measured) < needed:
        return Match(reason=Reason("assembly.few_points", count=len(measured), needed=needed))
    basis = plane_basis(vertical)
    image_angle = _image_angle(basis, image_up_scan)
    if up is not None and image_angle is None:
        return Match(reason=Reason("assembly.up_says_nothing"))
    flat, places = (measured @ basis.T)[:, :2], np.ascontiguousarray(design[:, :2])
    fewest = max(needed, _half(len(measured), len(design)))
    planar = [found for found in search_placements(flat, places) if found.found >= fewest]
    if _fits_better_mirrored(planar, flat, places, fewest):
        return Match(reason=_mirrored(len(flat), len(design)), contradiction="mirrored")
    if not planar:
        return Match(reason=Reason("assembly.unfit", measured=len(flat), design=len(design)))
    placements = [_placement(found, measured, basis, design, image_angle) for found in planar]
    possible = [found for found in placements if found is not None]
    if not possible:
        return Match(reason=Reason("assembly.coincide"))
    answer = _oriented(possible, _plausible(possible, planar[0]), up)
    return _with_extra(answer, len(measured))


def _half(measured: int, design: int) -> int:
    """Fewer than this many matches are chance."""
    return (min(measured, design) + 1) // 2


def _image_angle(basis: Array, image_up_scan: Array | None) -> float | None:
    """Direction of the image's top in the plane of ``basis``, radians; None where it has hardly any."""
    if image_up_scan is None:
        return None
    x, y, along = basis @ np.asarray(image_up_scan, dtype=np.float64)
    flat = math.hypot(x, y)
    # Looked at within 17° of the image's own top, its direction in the plane is that of noise.
    return math.atan2(y, x) if flat > 0.3 * math.hypot(flat, along) else None


def _fits_better_mirrored(planar: list[PlanarPlacement], flat: Array, design: Array, fewest: int) -> bool:
    """Whether the mirror image of the points explains them where they themselves do not, or far better."""
    if planar and _needs_no_mirror(planar[0], design):
        return False
    mirrored = [found for found in search_placements(flat * np.array([1.0, -1.0]), design) if found.found >= fewest]
    if not mirrored:
        return False
    if not planar:
        # A few points may lie on some design points by chance, mirrored or not.
        return max(found.found for found in mirrored) > fewest
    gain = _best_likelihood(mirrored) - _best_likelihood(planar)
    return gain > CONTRADICTS_LOG_RATIO and mirrored[0].found > fewest


def _needs_no_mirror(best: PlanarPlacement, design: Array) -> bool:
    """Whether a mirror image could fit no better: all points lie as designed, or the pattern is its own mirror."""
    return float(best.deviations_mm.max()) < SMALLEST_SCALE_MM or is_its_own_mirror(design)


def _best_likelihood(planar: list[PlanarPlacement]) -> float:
    return max(log_likelihood(found.deviations_mm) for found in planar)


def _mirrored(measured: int, design: int) -> str:
    return Reason("assembly.mirrored", measured=measured, design=design)


def _plausible(placements: list[Placement], best: PlanarPlacement) -> list[Placement]:
    """The placements that the best one does not rule out: a likelihood ratio under Laplace-distributed deviations."""
    scale_mm = max(SMALLEST_SCALE_MM, float(median(best.deviations_mm[best.matched >= 0])))
    return [found for found in placements if (found.cost_mm - best.cost_mm) / scale_mm <= DISTINCT_LOG_RATIO]


def _placement(
    found: PlanarPlacement, measured: Array, basis: Array, design: Array, image_angle: float | None
) -> Placement | None:
    used = found.matched >= 0
    points = measured[found.matched[used]] @ basis.T
    fit = fit_eopa_planar(np.ascontiguousarray(points[:, :2]), np.ascontiguousarray(design[used, :2]))
    if not isinstance(fit, EopaFit):
        return None
    rise = float(design[used, 2].mean() - points[:, 2].mean())
    up = None if image_angle is None else wrap(fit.yaw + image_angle)
    max_mm = float(np.hypot(*fit.residuals.T).max())
    transform = upright_transform(basis, fit.yaw, fit.t, rise)
    return Placement(
        T_design_scan=transform,
        matched=found.matched,
        yaw=fit.yaw,
        up=up,
        rms_mm=fit.rms_mm,
        max_mm=max_mm,
        cost_mm=found.cost_mm,
        scale=fit.scale,
        log_likelihood=log_likelihood(found.deviations_mm),
        scatter_mm=_scatter_mm(fit, np.ascontiguousarray(design[used, :2])),
    )


def _scatter_mm(fit: EopaFit, places: Array) -> float:
    """Per axis, from the median of what a fit leaves when its scale is free."""
    about = places - places.mean(axis=0)
    # target − aligned = residual, so scaled by s: target − s·aligned = residual − (s − 1)·aligned.
    left = fit.residuals - (fit.scale - 1.0) * (about - fit.residuals)
    freedom = max(2 * len(places) - 4, 1)
    median_mm = float(median(np.hypot(*left.T)))
    return median_mm / math.sqrt(2.0 * math.log(2.0)) * math.sqrt(2 * len(places) / freedom)


def _oriented(possible: list[Placement], plausible: list[Placement], up: Array | float | None) -> Match:
    """The match that the data and a declared ``up`` leave, of the placements that are ``possible`` at all."""
    if not plausible:
        return Match(reason=Reason("assembly.coincide"))
    if up is None:
        return Match(tuple(plausible), "resolved" if len(plausible) == 1 else "ambiguous")
    declared = math.radians(up) if isinstance(up, int | float) else math.atan2(float(up[1]), float(up[0]))
    # Rounded, so that turns which are equal but for the last digits keep their order on every machine.
    ordered = sorted(plausible, key=lambda found: round(_off(found, declared), 9))
    nearest = _off(ordered[0], declared)
    if nearest > DECLARED_WITHIN_RAD:
        return _contradicted(declared, ordered[0], None)
    alike = [found for found in ordered if _apart(found, ordered[0]) < UP_TELLS_RAD]
    best = max(possible, key=lambda found: found.log_likelihood)
    chosen = max(found.log_likelihood for found in alike)
    if _off(best, declared) > DECLARED_WITHIN_RAD and best.log_likelihood - chosen > CONTRADICTS_LOG_RATIO:
        return _contradicted(declared, best, max(alike, key=lambda found: found.log_likelihood))
    if len(alike) > 1:
        in_place = sorted(alike, key=lambda found: round(found.cost_mm, 6))  # as above
        return Match(tuple(in_place), "ambiguous", declared=declared)
    others = [found for found in plausible if found is not alike[0]]
    return Match((alike[0], *others), "declared", declared=declared, open_turn=_open_turn(alike[0], others, declared))


def _off(found: Placement, declared: float) -> float:
    """How far the image's top is from the declared direction, radians."""
    return abs(wrap((found.up or 0.0) - declared))


def _apart(one: Placement, other: Placement) -> float:
    """Between the turns of two placements, radians."""
    return abs(wrap(one.yaw - other.yaw))


def _open_turn(chosen: Placement, others: list[Placement], declared: float) -> float | None:
    if not others:
        return None
    between = min(_apart(found, chosen) for found in others)
    # Whoever declares one of four sides means the nearest one, whatever the pattern would allow.
    return _off(chosen, declared) / min(0.5 * between, math.radians(45.0))


def _contradicted(declared: float, fitting: Placement, as_declared: Placement | None) -> Match:
    said, actual = (round(math.degrees(angle or 0.0)) % 360 for angle in (declared, fitting.up))
    turned = math.degrees(_off(fitting, declared))
    if as_declared is None:
        rivals: tuple[Placement, ...] = (fitting,)
        reason = Reason("assembly.up_contradicted", said=said, actual=actual, turned=turned)
    else:
        fits = {"fitting_mm": fitting.rms_mm, "declared_mm": as_declared.rms_mm}
        reason = Reason("assembly.up_contradicted.worse", said=said, actual=actual, **fits)
        rivals = (fitting, as_declared)
    return Match(reason=reason, contradiction="turn_contradicted", contradicting=rivals, declared=declared)


def _with_extra(match: Match, measured: int) -> Match:
    if not match:
        return match
    matched = set(match.placements[0].matched.tolist())
    return replace(match, extra=tuple(index for index in range(measured) if index not in matched))
