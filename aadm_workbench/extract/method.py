"""The extraction methods by name: the default one and the baselines of the literature.

Feet and groups of bars that hold more than one size: each size is found and measured by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Extraction, Kind, Scan, in_one
from aadm_workbench.model.special import median

Recipe: TypeAlias = Callable[..., Extraction]

_SAME_SIZE = 0.04  # relative: diameters this near to each other are one size; bars come in steps of a tenth
_ONE_PLACE = 0.5  # of the smaller diameter: two finds this near to each other are one thing

Find = tuple[AssemblyPoint, float | None, float]
"""A point, its exposed length where it has one, and how far it is off its nominal diameter, relatively."""


def _refined(kind: Kind) -> Recipe:
    from aadm_workbench.extract.rebars import extract_rebars
    from aadm_workbench.extract.sleeves import extract_sleeves

    return extract_sleeves if kind is Kind.SLEEVE else extract_rebars


def _fusion(kind: Kind) -> Recipe:
    from aadm_workbench.extract.published import fusion

    return fusion.extract_sleeves if kind is Kind.SLEEVE else fusion.extract_rebars


def _pointcloud(kind: Kind) -> Recipe:
    from aadm_workbench.extract.published import pointcloud

    return pointcloud.extract_sleeves if kind is Kind.SLEEVE else pointcloud.extract_rebars


def _image(kind: Kind) -> Recipe:
    from aadm_workbench.extract.published import image

    return image.extract_sleeves if kind is Kind.SLEEVE else image.extract_rebars


def _corners(kind: Kind) -> Recipe:
    from aadm_workbench.extract.published import corners

    return corners.extract_sleeves if kind is Kind.SLEEVE else _refined(kind)


METHODS: dict[str, Callable[[Kind], Recipe]] = {
    "refined": _refined,
    "fusion": _fusion,
    "pointcloud": _pointcloud,
    "image": _image,
    "corners": _corners,
}
"""What each method is called; the value imports it and gives its recipe for one kind of point."""

BY_DESIGN = ("corners",)
"""Methods that lay the sleeves of a design into a scan and measure none of them."""


@dataclass(frozen=True, eq=False)
class Known:
    """What is known of a scan beforehand; methods of :data:`BY_DESIGN` need it.

    ``up_deg``: column-frame direction at the top of the picture, degrees from +x, counter-clockwise from above.
    """

    design: ColumnDesign
    up_deg: float | None = None


def extract(
    scan: Scan,
    kind: Kind,
    diameter_mm: float,
    method: str,
    rng: np.random.Generator,
    places: Array | None = None,
    others_mm: tuple[float, ...] = (),
    known: Known | None = None,
) -> Extraction:
    """Find the sleeves, or the bars, of one diameter in a scan with the method of a name.

    Parameters
    ----------
    scan
        Points in mm, scan frame.
    kind
        What to look for.
    diameter_mm
        Nominal: of a sleeve inside at its mouth, of a bar.
    method
        One of ``METHODS``.
    rng
        All that is drawn comes from it: the same scan and seed give the same points.
    places
        (k, 3) mm, scan frame: where else to look for a point that the search did not find; ``refined`` alone does.
    others_mm
        Diameters of other points in the same scan: ``refined`` leaves out what is nearer to one of these.
    known
        Design and turn; without it methods of ``BY_DESIGN`` find no sleeves, and say so.

    Raises
    ------
    ValueError
        For a method that is not in ``METHODS``; the message lists them.
    MissingDependencyError
        Where a method of the literature needs a package that is not installed.
    """
    if method not in METHODS:
        raise ValueError(f"unknown method {method!r}; write one of: {', '.join(METHODS)}")
    recipe = METHODS[method](kind)
    if method in BY_DESIGN and kind is Kind.SLEEVE:
        return recipe(scan, None if known is None else known.design, rng, None if known is None else known.up_deg)
    if method == "refined" or method in BY_DESIGN:
        return recipe(scan, diameter_mm, rng, places, others_mm)
    return recipe(scan, diameter_mm, rng, places)


def distinct_sizes(diameters_mm: Iterable[float]) -> tuple[float, ...]:
    """The sizes among some nominal diameters, mm, the most frequent one first."""
    groups: list[list[float]] = []
    for diameter_mm in sorted(diameters_mm):
        if groups and diameter_mm <= groups[-1][0] * (1.0 + _SAME_SIZE):
            groups[-1].append(diameter_mm)
        else:
            groups.append([diameter_mm])
    groups.sort(key=len, reverse=True)
    return tuple(float(median(group)) for group in groups)


def extract_sizes(
    scan: Scan,
    kind: Kind,
    diameters_mm: Iterable[float],
    method: str,
    rng: np.random.Generator,
    places: Array | None = None,
    known: Known | None = None,
) -> Extraction:
    """Find the points of all sizes in a scan.

    Parameters
    ----------
    scan
        Points in mm, scan frame.
    diameters_mm
        Nominal diameters of the points that are expected, in any order.
    method, rng, places, known
        As :func:`~aadm_workbench.extract.method.extract` has them, errors too.

    Returns
    -------
    Extraction
        Plane, vertical and quality are those of the size that most points were found of.
    """
    sizes_mm = distinct_sizes(diameters_mm)
    if method in BY_DESIGN and kind is Kind.SLEEVE:
        return extract(scan, kind, sizes_mm[0], method, rng, known=known)
    found = [
        extract(scan, kind, size, method, rng, places, tuple(other for other in sizes_mm if other != size))
        for size in sizes_mm
    ]
    if len(found) == 1:
        return found[0]
    most = max(found, key=lambda one: len(one.points))
    if not most.points:
        return replace(most, reason=in_one(one.reason for one in found))
    finds = [find for one, size in zip(found, sizes_mm, strict=True) for find in _finds(one, size)]
    kept = _one_for_each_place(finds)
    exposed = tuple(find[1] for find in kept) if any(one.exposed_length_mm for one in found) else ()
    return replace(most, points=tuple(find[0] for find in kept), exposed_length_mm=exposed)


def _finds(found: Extraction, size_mm: float) -> list[Find]:
    exposed = found.exposed_length_mm or (None,) * len(found.points)
    return [
        (point, length_mm, abs(point.diameter_mm / size_mm - 1.0))
        for point, length_mm in zip(found.points, exposed, strict=True)
    ]


def _one_for_each_place(finds: list[Find]) -> list[Find]:
    """The finds whose diameters fit best, where two sizes claim one place."""
    kept: list[Find] = []
    for find in sorted(finds, key=lambda one: one[2]):
        claimed = any(
            np.linalg.norm(find[0].centre - other[0].centre)
            < _ONE_PLACE * min(find[0].diameter_mm, other[0].diameter_mm)
            for other in kept
        )
        if not claimed:
            kept.append(find)
    return [find for find in finds if find in kept]
