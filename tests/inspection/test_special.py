"""Functions of statistics: to the last bit those of NumPy and SciPy, and without what these load for them."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.special

from aadm_workbench.model import Array, special
from benchmarks.floors import write_floor


def samples() -> list[Array]:
    """Of both precisions and of whole numbers, even and odd, with ties, infinite ones and NaN."""
    generator = np.random.default_rng(5)
    found: list[Array] = []
    for count in (1, 2, 3, 4, 7, 50, 501):
        values = generator.normal(size=count) * 10.0 ** generator.integers(-9, 9, count)
        found += [values, values.astype(np.float32), np.round(values, 1), generator.integers(-3, 3, count)]
        found += [np.where(generator.random(count) < 0.2, special_value, values) for special_value in (np.inf, np.nan)]
    return found


@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
def test_medians_and_percentiles_are_those_of_numpy() -> None:
    for values in samples():
        assert same(special.median(values), np.median(values))
        for percents in (0, 37.5, 80, 100, (1.0, 99.0), [0.1, 50.0, 99.9]):
            assert same(special.percentiles(values, percents), np.percentile(values, percents))
        assert same(special.quantiles(values, [0.02, 0.98]), np.quantile(values, [0.02, 0.98]))
        if not np.isnan(values).any():
            assert same(special.distinct(values), np.unique(values))
        assert np.isnan(values).all() or special.median_of_known(values) == np.nanmedian(values)


def test_along_an_axis() -> None:
    for shape in ((5, 3), (6, 3), (4, 2, 3)):
        values = np.random.default_rng(len(shape)).normal(size=shape).astype(np.float32)
        for axis in (0, 1, -1):
            assert same(special.median(values, axis=axis), np.median(values, axis=axis))
        assert same(special.percentiles(values, (1, 99)), np.percentile(values, (1, 99), axis=0))


def same(ours: object, theirs: object) -> bool:
    first, second = np.asarray(ours), np.asarray(theirs)
    return first.dtype == second.dtype and first.shape == second.shape and np.array_equal(first, second, equal_nan=True)


def test_functions_are_those_of_scipy(monkeypatch: pytest.MonkeyPatch) -> None:
    """By themselves, from the package where it is there already, and from it where they are not found."""
    x = np.linspace(-12.0, 40.0, 2001)
    alone = special.compiled()
    assert alone is not None
    for module in (special, alone):
        assert np.array_equal(module.expit(x), scipy.special.expit(x))
        assert np.array_equal(module.ndtr(x), scipy.special.ndtr(x))
        assert np.array_equal(module.gammainc(2.5, x[x > 0]), scipy.special.gammainc(2.5, x[x > 0]))
        assert np.array_equal(module.gammaincinv(2.5, x[:9] % 1.0), scipy.special.gammaincinv(2.5, x[:9] % 1.0))
    assert special.functions.__wrapped__() is scipy.special
    monkeypatch.delitem(sys.modules, "scipy.special")
    monkeypatch.setattr(special, "_COMPILED", "nothing_of_that_name")
    assert special.compiled() is None
    assert special.functions.__wrapped__().expit is scipy.special.expit


UNUSED = {"numpy.f2py", "numpy.ma", "numpy.testing", "rich", "scipy.linalg", "scipy.special", "scipy.stats"}


def test_a_check_loads_nothing_that_it_does_not_use(tmp_path: Path) -> None:
    """Of NumPy, SciPy and what shows tables: loading all of it took longer than measuring a column."""
    job = write_floor(tmp_path / "floor", 1)  # its design stands in the job: models have their own needs
    words = ["check", str(job), "--out", str(tmp_path / "out"), "--quiet"]
    code = f"import sys, aadm_batch.main as m\nm.main({words!r})\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=tmp_path)
    assert "aadm_workbench.extract.sleeves" in done.stdout.split()
    assert UNUSED.isdisjoint(done.stdout.split())


def test_a_workbench_knows_its_methods_before_anything_is_installed() -> None:
    """FreeCAD brings NumPy alone; the buttons that install the rest are there only where the workbench has begun."""
    code = """
import sys

class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {"cv2", "ifcopenshell", "msgspec", "open3d", "rich", "scipy"}:
            raise ModuleNotFoundError(name)

sys.meta_path.insert(0, Missing())
from aadm_workbench.extract.method import METHODS
print(*METHODS)
"""
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert "refined" in done.stdout.split()
