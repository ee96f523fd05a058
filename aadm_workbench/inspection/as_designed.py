"""As-designed points of any model, clouds too, and by the published route: where designs and scans' files meet."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np

from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.model_file import sha256_of
from aadm_workbench.design.model_units import MM_PER_UNIT, check_units
from aadm_workbench.design.published import PublishedPoint, published_points, sampled_surfaces
from aadm_workbench.design.recognise.columns import Origin, Rules, recognise
from aadm_workbench.errors import AadmError, DesignError, ScanError
from aadm_workbench.model import Array, ColumnDesign, Reason

_SEED = 2026  # any: the same design gives the same points


def read_design(
    path: str | Path,
    *,
    columns: str | None = None,
    sleeves: str | None = None,
    rebars: str | None = None,
    units: str = "mm",
    only: Collection[str] | None = None,
) -> ModelDesign:
    """Columns, sleeves and connecting rebars of a model of any format, point clouds (.pcd) among them.

    Parameters
    ----------
    path
        The model: what :func:`aadm_workbench.design.read.read_model` reads, or .pcd.
    columns, sleeves, rebars
        Optional selectors in the syntax of ``ifcopenshell.util.selector``.
    units
        Of a mesh or a cloud: mm, cm, m, inch or foot. Other formats bring theirs.
    only
        Names of the columns that are asked for: of an IFC model, what belongs to none of them may be left out.

    Raises
    ------
    DesignError
        Where the file cannot be used, with its name.
    MissingDependencyError
        Where a program or package that the format needs is not installed.
    """
    if Path(path).suffix.lower() == ".pcd":
        return read_cloud(Path(path), Rules(columns, sleeves, rebars), units=units)
    from aadm_workbench.design.read import read_model

    return read_model(path, columns=columns, sleeves=sleeves, rebars=rebars, units=units, only=only)


@contextmanager
def unforeseen_in(model: str) -> Iterator[None]:
    """A model that breaks its reader in a way that nobody foresaw is a bad model, not the end of the night.

    Turns whatever else than an :class:`AadmError` comes out of reading a model into one that
    names it.

    Raises
    ------
    DesignError
        With the error as its cause.
    """
    try:
        yield
    except (AadmError, MemoryError):
        raise
    except Exception as error:
        said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        raise DesignError(Reason("run.not_evaluated", model=model, error=said)) from error


def read_cloud(path: Path, rules: Rules | None = None, *, units: str = "mm") -> ModelDesign:
    """Columns, sleeves and connecting rebars of a cloud that was sampled from a model (z up).

    Raises
    ------
    DesignError
        Where the file is no cloud, its size contradicts the unit, or a rule finds nothing.
    """
    from aadm_workbench.design.cloud import elements_of_cloud

    began = perf_counter()
    if units not in MM_PER_UNIT:
        raise DesignError(Reason("design.units", units=repr(units), known=MM_PER_UNIT))
    sha256 = sha256_of(path)
    points = MM_PER_UNIT[units] * _points(path)
    origin = Origin(str(path), sha256, "PCD")
    found = recognise(elements_of_cloud(points, str(path)), origin, rules)
    if not found.columns:

        def columns_in(other: str) -> tuple[ColumnDesign, ...]:
            factor = MM_PER_UNIT[other] / MM_PER_UNIT[units]
            return recognise(elements_of_cloud(factor * points, str(path)), origin).columns

        check_units(str(path), units, np.ptp(points, axis=0), columns_in)
    return replace(found, seconds=perf_counter() - began)


def published_route(design: ColumnDesign) -> list[PublishedPoint]:
    """A column's points by the published route, through a real PCD file; the same ones every time.

    Raises
    ------
    DesignError
        Where no file can be written for it.
    """
    from aadm_workbench.scan.write import write_pcd

    cloud = sampled_surfaces(design, np.random.default_rng(_SEED))
    try:
        with TemporaryDirectory(prefix="aadm-published-") as folder:
            path = Path(folder) / "model.pcd"
            write_pcd(path, cloud.astype(np.float32), mode="binary")
            return published_points(design, _points(path))
    except OSError as error:
        raise DesignError(Reason("design.cloud_unwritten", why=error)) from error


def _points(path: Path) -> Array:
    """Finite points (n, 3) float64 of a PCD file, in its own unit and frame."""
    from aadm_workbench.scan.read import read_scan

    try:
        scan = read_scan(path, axes="camera")
    except ScanError as error:
        raise DesignError(error.reason) from error
    points = scan.points.reshape(-1, 3).astype(np.float64)
    finite: Array = points[np.isfinite(points).all(axis=1)]
    return finite
