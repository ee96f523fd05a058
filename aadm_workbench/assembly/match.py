"""Which measured point is which design point, and how the scan lies on the design.

Works under any rigid pose, with points missing, points too many and single errors of 15 mm. The vertical is known,
so neither a mirror nor a flip is possible; the turns that a symmetric pattern leaves open are settled by the
declared ``up``, else by the pattern's own asymmetry, else they are all reported.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.eopa import EopaFit, fit_eopa_planar
from aadm_workbench.assembly.placements import PlanarPlacement, search_placements
from aadm_workbench.assembly.upright import plane_basis, upright_transform, wrap
from aadm_workbench.model import Array, AssemblyPoint, Extraction, IntArray

DECLARED_WITHIN_RAD = math.radians(44.0)
"""A declared direction chooses the nearest turn within this; half of the 90° between the turns of a square."""

DISTINCT_LOG_RATIO = 7.0
"""Another turn is ruled out where the deviations make it a thousand times (e⁷) less likely than the best one."""

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
        What placements are compared by: sum of the distances of a robust fit, cut off at the gate.
    scale
        Free scale of the fit, a diagnostic.
    """

    T_design_scan: Array
    matched: IntArray
    yaw: float
    up: float | None
    rms_mm: float
    max_mm: float
    cost_mm: float
    scale: float

    @property
    def found(self) -> int:
        """How many design points were found."""
        return int((self.matched >= 0).sum())


@dataclass(frozen=True, eq=False)
class Match:
    """The placements that the data allow, the chosen one first; false where there is none, with the ``reason``.

    ``orientation`` is ``declared``, ``resolved`` or ``ambiguous``; ``extra`` holds the measured points that
    belong to no design point.
    """

    placements: tuple[Placement, ...] = ()
    orientation: str = ""
    reason: str = ""
    extra: tuple[int, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.placements)

    @property
    def evaluated(self) -> tuple[Placement, ...]:
        """The placements that a verdict must hold in: all of an ambiguous match, else the chosen one."""
        return self.placements if self.orientation == "ambiguous" else self.placements[:1]


def match_extraction(
    design: Sequence[AssemblyPoint],
    extraction: Extraction,
    *,
    up: Array | float | None = None,
    image_up_scan: Array | None = None,
) -> Match:
    """Match the points of one extraction to the design points of their kind; parameters as :func:`match_points`."""
    if not extraction.points:
        return Match(reason=extraction.reason or f"no {extraction.kind.value} was found in the scan")
    if extraction.vertical is None:
        return Match(reason=extraction.reason or "the scan does not show which way is up")
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
        return Match(reason=f"only {len(measured)} points were found, {needed} are needed to lay them on the design")
    basis = plane_basis(vertical)
    image_angle = _image_angle(basis, image_up_scan)
    if up is not None and image_angle is None:
        return Match(reason="up was declared, but the scan has no direction across the vertical that it could describe")
    flat = (measured @ basis.T)[:, :2]
    planar = search_placements(flat, np.ascontiguousarray(design[:, :2]))
    planar = [found for found in planar if (found.matched >= 0).sum() >= max(needed, _half(len(measured), len(design)))]
    if not planar:
        return Match(reason=_why_none(flat, design))
    plausible = _plausible(planar, flat, design)
    placements = [_placement(found, measured, basis, design, image_angle) for found in plausible]
    return _orient([found for found in placements if found is not None], up, len(measured))


def _half(measured: int, design: int) -> int:
    """Fewer than this many matches are chance."""
    return (min(measured, design) + 1) // 2


def _image_angle(basis: Array, image_up_scan: Array | None) -> float | None:
    """Direction of the image's top in the plane of ``basis``, radians; None where it has hardly any."""
    if image_up_scan is None:
        return None
    x, y, along = basis @ np.asarray(image_up_scan, dtype=np.float64)
    flat = math.hypot(x, y)
    return math.atan2(y, x) if flat > 0.3 * math.hypot(flat, along) else None


def _why_none(flat: Array, design: Array) -> str:
    reason = f"the {len(flat)} points found do not fit the pattern of the {len(design)} design points"
    mirrored = search_placements(flat * np.array([1.0, -1.0]), np.ascontiguousarray(design[:, :2]))
    if mirrored and (mirrored[0].matched >= 0).sum() > _half(len(flat), len(design)):
        return f"{reason}, but their mirror image does: the scan was taken from the other side than supposed"
    return reason


def _plausible(planar: list[PlanarPlacement], flat: Array, design: Array) -> list[PlanarPlacement]:
    """The placements that the best one does not rule out: a likelihood ratio under Laplace-distributed deviations."""
    best = planar[0]
    used = best.matched >= 0
    cosine, sine = math.cos(best.yaw), math.sin(best.yaw)
    placed = flat[best.matched[used]] @ np.array([[cosine, sine], [-sine, cosine]]) + best.shift
    scale_mm = max(SMALLEST_SCALE_MM, float(np.median(np.hypot(*(placed - design[used, :2]).T))))
    return [found for found in planar if (found.cost_mm - best.cost_mm) / scale_mm <= DISTINCT_LOG_RATIO]


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
    return Placement(transform, found.matched, fit.yaw, up, fit.rms_mm, max_mm, found.cost_mm, fit.scale)


def _orient(placements: list[Placement], up: Array | float | None, measured: int) -> Match:
    if not placements:
        return Match(reason="the points that were found coincide")
    if up is None:
        orientation = "resolved" if len(placements) == 1 else "ambiguous"
        return _with_extra(Match(tuple(placements), orientation), measured)
    declared = math.radians(up) if isinstance(up, int | float) else math.atan2(float(up[1]), float(up[0]))
    off = [abs(wrap((found.up or 0.0) - declared)) for found in placements]
    nearest = int(np.argmin(np.round(off, 9)))
    if off[nearest] > DECLARED_WITHIN_RAD:
        turned = math.degrees(off[nearest])
        said = round(math.degrees(declared)) % 360
        actual = round(math.degrees(placements[nearest].up or 0.0)) % 360
        return Match(
            reason=f"the pattern contradicts the declared up of {said}°: it fits only with "
            f"{actual}° at the top of the image, {turned:.0f}° away"
        )
    chosen = placements.pop(nearest)
    return _with_extra(Match((chosen, *placements), "declared"), measured)


def _with_extra(match: Match, measured: int) -> Match:
    matched = set(match.placements[0].matched.tolist())
    return replace(match, extra=tuple(index for index in range(measured) if index not in matched))
