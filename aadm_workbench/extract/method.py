"""The methods that find assembly points in a scan, behind one call."""

from __future__ import annotations

from importlib import import_module
from typing import Protocol, cast

import numpy as np

from aadm_workbench.model import Array, Extraction, Kind, Scan


class Extractor(Protocol):
    """What every method offers for one kind of point."""

    def __call__(
        self, scan: Scan, diameter_mm: float, rng: np.random.Generator, places: Array | None = None
    ) -> Extraction:
        """Find the points; see :func:`extract`."""
        ...


_PACKAGE = "aadm_workbench.extract"
METHODS: dict[str, dict[Kind, tuple[str, str]]] = {
    "refined": {
        Kind.SLEEVE: (f"{_PACKAGE}.sleeves", "extract_sleeves"),
        Kind.REBAR: (f"{_PACKAGE}.rebars", "extract_rebars"),
    },
    **{
        name: {
            Kind.SLEEVE: (f"{_PACKAGE}.published.{name}", "extract_sleeves"),
            Kind.REBAR: (f"{_PACKAGE}.published.{name}", "extract_rebars"),
        }
        for name in ("fusion", "pointcloud", "image")
    },
}
"""Name of a method, and for each kind the module and function that does it; imported only when called."""


def extract(
    scan: Scan,
    kind: Kind,
    diameter_mm: float,
    method: str,
    rng: np.random.Generator,
    places: Array | None = None,
) -> Extraction:
    """Find the sleeves or the rebars of one diameter in a scan.

    Parameters
    ----------
    diameter_mm
        Sleeves: inner, at the mouth. Rebars: nominal.
    method
        One of :data:`METHODS`.
    rng
        Every random draw comes from it.
    places
        (k, 3) mm, scan frame: where else to look; methods of the literature do not use it.

    Raises
    ------
    ValueError
        For a method that does not exist.
    MissingDependencyError
        Where the method needs a package that is not installed.
    """
    if method not in METHODS:
        raise ValueError(f"unknown method {method!r}: one of {', '.join(METHODS)}")
    module, function = METHODS[method][kind]
    extractor = cast(Extractor, getattr(import_module(module), function))
    return extractor(scan, diameter_mm, rng, places)
