"""A rebar and the sleeve it enters: where they are, how much room there is, and how they lean.

What is measured of a bar is the centre of its top, and of a sleeve the centre of its mouth. With the bar's top at the
embedded length L inside the sleeve, both axes give the offset twice (design axes upright, lean = axis_xy / axis_z):

    at the mouth:  offset − L·lean of the bar        at the bar's top:  offset − L·lean of the sleeve
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.place import flat_covariance
from aadm_workbench.design.bar_sizes import over_ribs_mm
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign

EMBEDMENT_DIAMETERS = 8.0
"""Embedded length of a bar in its diameters, where the design says nothing (JGJ 355-2015, unverified)."""

_LEAST_EMBEDMENT_MM = 10.0


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
    """

    sleeve: str
    rebar: str
    sleeve_xy: Array
    rebar_xy: Array
    bar_shift: Array
    sleeve_shift: Array
    room_mm: float | None
    covariance: Array | None


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
            missing.append(f"the rebar of {design.sleeves[index].label}")
            continue
        sleeve, rebar = sleeves[index], rebars[other]
        if sleeve is None:
            missing.append(design.sleeves[index].label)
        if rebar is None:
            missing.append(design.rebars[other].label)
        if sleeve is None or rebar is None:
            continue
        inner_mm = sleeve.diameter_mm if measured_diameters else design.sleeves[index].diameter_mm
        outer_mm = design.rebar_outer_diameter_mm or over_ribs_mm(design.rebars[other].diameter_mm)
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
            )
        )
    return tuple(pairs), tuple(missing)


def _together(first: Array | None, second: Array | None) -> Array | None:
    return None if first is None or second is None else first + second
