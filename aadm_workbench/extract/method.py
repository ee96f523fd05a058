"""The extraction methods by name: the default one and the baselines of the literature."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from aadm_workbench.model import Array, Extraction, Kind, Scan

Recipe: TypeAlias = Callable[..., Extraction]


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


METHODS: dict[str, Callable[[Kind], Recipe]] = {
    "refined": _refined,
    "fusion": _fusion,
    "pointcloud": _pointcloud,
    "image": _image,
}
"""What each method is called; the value imports it and gives its recipe for one kind of point."""


def extract(
    scan: Scan,
    kind: Kind,
    diameter_mm: float,
    method: str,
    rng: np.random.Generator,
    places: Array | None = None,
    others_mm: tuple[float, ...] = (),
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
    if method == "refined":
        return recipe(scan, diameter_mm, rng, places, others_mm)
    return recipe(scan, diameter_mm, rng, places)
