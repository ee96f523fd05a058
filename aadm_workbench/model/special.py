"""Functions of statistics that every check needs: those of SciPy and NumPy, without all else that these load for them.

``import scipy.special`` brings in numpy's parser of Fortran, its test tools and its masked arrays, for arrays of other
libraries that nobody here has: a quarter of what a check of one column takes. Where the compiled functions are not
found by themselves, as in another version of SciPy, the package is imported after all. Percentiles and distinct values
of NumPy load its masked arrays, and look for much that is nowhere here: the same numbers take a third of the time.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib.machinery import PathFinder
from importlib.util import find_spec, module_from_spec
from typing import Any

import numpy as np

from aadm_workbench.model.measured import Array

_PACKAGE, _COMPILED = "scipy.special", "_special_ufuncs"
_NAMES = ("expit", "gammainc", "gammaincinv", "ndtr")


@cache
def functions() -> Any:
    """The module that holds the functions: looked for when one is called, for a workbench begins without SciPy."""
    found = sys.modules.get(_PACKAGE) or compiled()
    if found is None:
        import scipy.special

        found = scipy.special
    return found


def compiled() -> Any:
    """The compiled module that holds them, without its package; None where it is not as expected."""
    package = find_spec(_PACKAGE.partition(".")[0])
    places = package.submodule_search_locations if package is not None else None
    spec = PathFinder.find_spec(f"{_PACKAGE}.{_COMPILED}", [f"{place}/special" for place in places or ()])
    if spec is None or spec.loader is None:
        return None
    try:
        module = module_from_spec(spec)
        spec.loader.exec_module(module)
    except (ImportError, OSError, RuntimeError):
        return None
    return module if all(hasattr(module, name) for name in _NAMES) else None


def expit(values: Any) -> Any:
    """The logistic function."""
    return functions().expit(values)


def gammainc(shape: Any, values: Any) -> Any:
    """The regularised lower incomplete gamma function."""
    return functions().gammainc(shape, values)


def gammaincinv(shape: Any, shares: Any) -> Any:
    """The value at which the regularised lower incomplete gamma function has a share."""
    return functions().gammaincinv(shape, shares)


def ndtr(values: Any) -> Any:
    """The distribution function of the standard normal law."""
    return functions().ndtr(values)


def percentiles(values: Any, percents: Any) -> Any:
    """Percentiles of values (n,) or (n, m), along their first axis: to the last bit those of ``numpy.percentile``."""
    return quantiles(values, np.true_divide(percents, 100))


def quantiles(values: Any, shares: Any) -> Any:
    """Quantiles of values (n,) or (n, m), along their first axis: to the last bit those of ``numpy.quantile``."""
    last = len(values) - 1
    at = last * np.asarray(shares, dtype=np.float64)
    before = np.floor(at).astype(np.intp)
    after = np.minimum(before + 1, last)
    ordered = np.partition(values, sorted({last, *before.ravel().tolist(), *after.ravel().tolist()}), axis=0)
    if np.isnan(ordered[-1]).any():
        return np.quantile(values, shares, axis=0)
    low, high = ordered[before], ordered[after]
    # A number alone leaves single precision as it is, as NumPy has it.
    part: Any = float(at - before) if at.ndim == 0 else (at - before).reshape(at.shape + (1,) * (ordered.ndim - 1))
    rise = high - low
    return np.where(np.asarray(part) >= 0.5, high - rise * (1 - part), low + rise * part)[()]


def distinct(values: Array) -> Array:
    """Each of some numbers (n,) once, rising; none of them is NaN."""
    ordered = np.sort(values, axis=None)
    kept = np.ones(len(ordered), np.bool_)
    np.not_equal(ordered[1:], ordered[:-1], out=kept[1:])
    return np.asarray(ordered[kept])


def median_of_known(values: Array) -> float:
    """The median of those values of any shape that are numbers: to the last bit that of ``numpy.nanmedian``."""
    return float(median(values[~np.isnan(values)]))


def median(values: Any, axis: int | None = None) -> Any:
    """The median of values (n,), or along an axis: to the last bit that of ``numpy.median``."""
    values = np.ravel(values) if axis is None else np.moveaxis(np.asarray(values), axis, 0)
    count = len(values)
    if values.dtype.kind != "f":
        values = values.astype(np.float64)
    half = count // 2
    if not count:
        return np.median(values, axis=0)
    ordered = np.partition(values, (half, count - 1) if count % 2 else (half - 1, half, count - 1), axis=0)
    if np.isnan(ordered[-1]).any():
        return np.median(values, axis=0)
    return ordered[half] if count % 2 else (ordered[half - 1] + ordered[half]) / 2
