"""A rebar and the sleeve it enters: where they are, how much room there is, and how they lean.

What is measured of a bar is the centre of its top, and of a sleeve the centre of its mouth. With the bar's top at the
embedded length L inside the sleeve, both axes give the offset twice (design axes upright, lean = axis_xy / axis_z):

    at the mouth:  offset − L·lean of the bar        at the bar's top:  offset − L·lean of the sleeve

Before that, measured points are brought into the column frame, in the order of the design points they belong to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.matching.match import Placement
from aadm_workbench.design.recognise.pattern import over_ribs_mm
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Extraction, Reason


@dataclass(frozen=True, eq=False)
class PlacedPoint:
    """A measured point: ``point`` in the column frame, ``scan_mm`` (3,) where it is in the scan frame.

    ``from_camera`` (3,) mm is the way to it from the origin of the scan frame, in the axes of the column frame.
    """

    point: AssemblyPoint
    scan_mm: Array
    from_camera: Array
    exposed_length_mm: float | None = None


def place_points(extraction: Extraction, placement: Placement) -> tuple[PlacedPoint | None, ...]:
    """For each design point the measured one that lies there, in the column frame; None where none does.

    Axes are turned to point up along the column; covariances are turned with the points.
    """
    exposed = extraction.exposed_length_mm or (None,) * len(extraction.points)
    return tuple(
        None
        if index < 0
        else PlacedPoint(
            _placed(extraction.points[index], placement.T_design_scan),
            extraction.points[index].centre,
            placement.T_design_scan[:3, :3] @ extraction.points[index].centre,
            exposed[index],
        )
        for index in placement.matched.tolist()
    )


def in_column_frame(extraction: Extraction, placement: Placement) -> list[AssemblyPoint | None]:
    """The points alone of :func:`place_points`."""
    return [None if placed is None else placed.point for placed in place_points(extraction, placement)]


def _placed(point: AssemblyPoint, T_design_scan: Array) -> AssemblyPoint:
    placed = moved_point(point, T_design_scan)
    return replace(placed, axis=-placed.axis) if placed.axis[2] < 0.0 else placed


def moved_point(point: AssemblyPoint, T_to_from: Array) -> AssemblyPoint:
    """A point in another frame: its centre and axis moved by a (4, 4) transform, its covariances turned with them."""
    rotation = T_to_from[:3, :3]
    return replace(
        point,
        centre=rotation @ point.centre + T_to_from[:3, 3],
        axis=rotation @ point.axis,
        covariance=_turned(point.covariance, rotation),
        axis_covariance=_turned(point.axis_covariance, rotation),
    )


def _turned(covariance: Array | None, rotation: Array) -> Array | None:
    return None if covariance is None else rotation @ covariance @ rotation.T


def flat_covariance(point: AssemblyPoint) -> Array | None:
    """Covariance (2, 2), mm², of the centre in the plane of the column frame; None where it is not known."""
    if point.covariance is None or not np.isfinite(point.covariance).all():
        return None
    return point.covariance[:2, :2]


EMBEDMENT_DIAMETERS = 8.0
"""Embedded length of a bar in its diameters, where the design says nothing (JGJ 355-2015, unverified)."""

LEAN_U_RAD = 0.005
"""Standard uncertainty of a lean per axis where the extraction states none: about 0.3°, by which sleeves and bars lean
as built, so that the lean counts as unknown."""

STRAIGHT_U_RAD = 0.002
"""Standard uncertainty, per axis, of a bar's direction below the part of it that was seen: half of the 4 mm a metre by
which a bar may be bent as delivered (GB/T 1499.2-2018, 6.5, unverified), a limit taken as k = 2."""

SIZE_U_MM = 0.06
"""Standard uncertainty of a diameter of the design: ±0.1 mm, rectangular, the step in which catalogues give sizes. Ribs
are the largest and bores the smallest that the standards permit, so that the play of manufacture only adds room."""

MEASURED_SIZE_U_MM = 0.1
"""Standard uncertainty of an inner diameter from a scan, pooled over the sleeves of one size."""

_LEAST_EMBEDMENT_MM = 10.0  # a design that has its bars end lower does not say how far they go in

_SAME_SIZE_MM = 0.5  # bars come in steps of 2 mm


@dataclass(frozen=True, eq=False)
class Pair:
    """One rebar and its sleeve, both measured, in the column frame.

    Parameters
    ----------
    sleeve, rebar
        Labels.
    sleeve_xy, rebar_xy
        (2,) mm, centres.
    bar_shift, sleeve_shift
        (2,) mm: how far the axis of the bar, of the sleeve, moves in the plane over the embedded length.
    room_mm
        (inner diameter of the sleeve − diameter of the bar over its ribs) / 2; None where one is not known.
    covariance
        (2, 2) mm² of rebar minus sleeve; None where one of the two has none.
    bar_shift_covariance, sleeve_shift_covariance
        (2, 2) mm² of these shifts; None where they are exact.
    bar_bent_mm
        Part of the bar's shift covariance that is no error of its measurement, standard deviation per axis: how far the
        axis may bend below what was seen of it.
    room_u_mm
        Standard uncertainty of the room.
    seen_length_mm
        Length of the bar below its top whose side was seen, up to the embedded length; None where it is not known.
    bar_usual_mm, sleeve_usual_mm
        By how much, per axis, such shifts differ as built; 0 where the shift and its covariance hold that already.
    sleeve_u_mm, rebar_u_mm
        Standard uncertainty per axis of each of the two, of its centre and of its lean over the embedded length.
    """

    sleeve: str
    rebar: str
    sleeve_xy: Array
    rebar_xy: Array
    bar_shift: Array
    sleeve_shift: Array
    room_mm: float | None
    covariance: Array | None
    bar_shift_covariance: Array | None = None
    sleeve_shift_covariance: Array | None = None
    bar_bent_mm: float = 0.0
    room_u_mm: float = 0.0
    seen_length_mm: float | None = None
    bar_usual_mm: float = 0.0
    sleeve_usual_mm: float = 0.0
    sleeve_u_mm: float = 0.0
    rebar_u_mm: float = 0.0


def embedded_length_mm(design: ColumnDesign) -> float:
    """How far bars stand in sleeves, mm: as designed, else the design height of their tops, else 8 diameters."""
    if design.embedded_length_mm is not None:
        return design.embedded_length_mm
    heights = [float(bar.centre[2]) for bar in design.rebars]
    if heights and float(np.mean(heights)) > _LEAST_EMBEDMENT_MM:
        return float(np.mean(heights))
    return EMBEDMENT_DIAMETERS * float(np.mean([bar.diameter_mm for bar in design.rebars] or [0.0]))


def form_pairs(
    design: ColumnDesign,
    sleeves: Sequence[AssemblyPoint | None],
    rebars: Sequence[AssemblyPoint | None],
    rebar_of: Sequence[int],
    *,
    measured_diameters: bool = False,
) -> tuple[tuple[Pair, ...], tuple[str, ...]]:
    """Pairs of measured sleeves and rebars, and the labels of what is missing.

    Parameters
    ----------
    sleeves, rebars
        As measured, in the column frame, in the order of the design; None where not measured.
    rebar_of
        For each sleeve the index of the rebar that enters it.
    measured_diameters
        Take the inner diameter of a sleeve from its measurement and not from the design.
    """
    pairs: list[Pair] = []
    missing: list[str] = []
    length_mm = embedded_length_mm(design)
    for index, other in enumerate(rebar_of):
        if other >= len(design.rebars):
            missing.append(Reason("assembly.rebar_of", sleeve=design.sleeves[index].label))
            continue
        sleeve, rebar = sleeves[index], rebars[other]
        if sleeve is None:
            missing.append(design.sleeves[index].label)
        if rebar is None:
            missing.append(design.rebars[other].label)
        if sleeve is None or rebar is None:
            continue
        inner_mm = sleeve.diameter_mm if measured_diameters else design.sleeves[index].diameter_mm
        bent_mm = _bent_mm(rebar, length_mm)
        bar_shift = _shift_covariance(rebar, length_mm) + bent_mm**2 * np.eye(2)
        sleeve_shift = _shift_covariance(sleeve, length_mm)
        outer_mm = outer_diameter_mm(design, design.rebars[other])
        pairs.append(
            Pair(
                sleeve=design.sleeves[index].label,
                rebar=design.rebars[other].label,
                sleeve_xy=sleeve.centre[:2],
                rebar_xy=rebar.centre[:2],
                bar_shift=length_mm * rebar.axis[:2] / rebar.axis[2],
                sleeve_shift=length_mm * sleeve.axis[:2] / sleeve.axis[2],
                room_mm=None if outer_mm is None else (inner_mm - outer_mm) / 2.0,
                covariance=_together(flat_covariance(sleeve), flat_covariance(rebar)),
                bar_shift_covariance=bar_shift,
                sleeve_shift_covariance=sleeve_shift,
                bar_bent_mm=bent_mm,
                room_u_mm=float(np.hypot(MEASURED_SIZE_U_MM if measured_diameters else SIZE_U_MM, SIZE_U_MM)) / 2.0,
                seen_length_mm=None if rebar.seen_length_mm is None else min(rebar.seen_length_mm, length_mm),
                bar_usual_mm=_usual_mm(rebar, length_mm),
                sleeve_usual_mm=_usual_mm(sleeve, length_mm),
                sleeve_u_mm=_u_mm(flat_covariance(sleeve), sleeve_shift),
                rebar_u_mm=_u_mm(flat_covariance(rebar), bar_shift),
            )
        )
    return tuple(pairs), tuple(missing)


def outer_diameter_mm(design: ColumnDesign, bar: AssemblyPoint) -> float | None:
    """Diameter of a bar over its ribs, mm: its own, that of all bars of the design, or from the table of sizes.

    None where none of them knows it. One for all bars is not taken for a bar of another size than most of them.
    """
    if bar.outer_diameter_mm is not None:
        return bar.outer_diameter_mm
    sizes = [other.diameter_mm for other in design.rebars]
    usual_mm = max(sizes, key=sizes.count)
    if design.rebar_outer_diameter_mm is not None and abs(bar.diameter_mm - usual_mm) < _SAME_SIZE_MM:
        return design.rebar_outer_diameter_mm
    return over_ribs_mm(bar.diameter_mm)


def _bent_mm(rebar: AssemblyPoint, length_mm: float) -> float:
    """By how much, per axis, a bar may bend below its seen part; all is unseen where nobody says."""
    return STRAIGHT_U_RAD * max(length_mm - (rebar.seen_length_mm or 0.0), 0.0)


def _usual_mm(point: AssemblyPoint, length_mm: float) -> float:
    """What is usual of a shift, where its measurement does not hold it; where there is none, its covariance does."""
    return 0.0 if point.axis_believed or point.axis_covariance is None else LEAN_U_RAD * length_mm


def _u_mm(*parts: Array | None) -> float:
    return float(np.sqrt(sum(float(np.trace(part)) / 2.0 for part in parts if part is not None)))


def _shift_covariance(point: AssemblyPoint, length_mm: float) -> Array:
    """Covariance (2, 2), mm², of how far an axis moves in the plane over a length, from that of its direction."""
    if point.axis_covariance is None:
        return (LEAN_U_RAD * length_mm) ** 2 * np.eye(2)
    x, y, z = point.axis.tolist()
    by_axis = length_mm * np.array([[1.0 / z, 0.0, -x / z**2], [0.0, 1.0 / z, -y / z**2]])
    return np.asarray(by_axis @ point.axis_covariance @ by_axis.T)


def _together(first: Array | None, second: Array | None) -> Array | None:
    return None if first is None or second is None else first + second
