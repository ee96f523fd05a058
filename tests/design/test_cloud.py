"""Clouds that were sampled from a design."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from aadm_workbench.design.cloud import elements_of_cloud
from aadm_workbench.errors import DesignError
from aadm_workbench.inspection.as_designed import read_design
from aadm_workbench.model import Array
from aadm_workbench.scan.write import write_pcd
from tests.design.drawn_mesh import bars, concrete, placed, worst_mm

SAMPLED_MM = 0.05
"""The walls are drawn with 48 facets, whose middles lie 0.04 mm inside the circle."""


@pytest.fixture(scope="module")
def points() -> Array:
    """A point for every 5 mm x 5 mm of all surfaces, at random."""
    whole = trimesh.util.concatenate([concrete(), *bars()])
    whole.apply_transform(placed())
    return np.asarray(trimesh.sample.sample_surface(whole, 350_000, seed=7)[0], dtype=np.float64)


def test_the_cloud_of_a_model_gives_its_points(tmp_path: Path, points: Array) -> None:
    write_pcd(tmp_path / "a.pcd", points.astype(np.float32), mode="binary")
    model = read_design(tmp_path / "a.pcd")
    (column,) = model.columns
    worst = worst_mm(column, placed())
    assert worst["sleeve"] < SAMPLED_MM
    assert worst["bar"] < SAMPLED_MM
    assert worst["sleeve diameter"] < 2.0 * SAMPLED_MM
    assert worst["bar diameter"] < 2.0 * SAMPLED_MM
    assert worst["sleeve height"] < SAMPLED_MM
    assert worst["bar height"] < 1.0, "a top of 314 mm2 has a dozen points"
    assert column.size_mm == pytest.approx((600.0, 600.0), abs=0.1)


def test_units_of_a_cloud_are_declared(tmp_path: Path, points: Array) -> None:
    write_pcd(tmp_path / "a.pcd", points / 1000.0, mode="binary")
    (column,) = read_design(tmp_path / "a.pcd", units="m").columns
    assert worst_mm(column, placed())["sleeve"] < SAMPLED_MM
    with pytest.raises(DesignError, match=r"a\.pcd is declared in mm, so it measures 0\.\d+ x .*in m it holds one"):
        read_design(tmp_path / "a.pcd")


def test_what_is_no_cloud_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.pcd").write_bytes(b"VERSION 0.7\nFIELDS x y z\n")
    with pytest.raises(DesignError, match=r"a\.pcd"):
        read_design(tmp_path / "a.pcd")
    with pytest.raises(DesignError, match="too few to find sleeves"):
        elements_of_cloud(np.zeros((10, 3)), "a.pcd")


def test_a_plain_block_has_no_sleeves(tmp_path: Path) -> None:
    block = trimesh.creation.box(extents=[600.0, 600.0, 3000.0])
    write_pcd(tmp_path / "a.pcd", trimesh.sample.sample_surface(block, 100_000, seed=1)[0], mode="binary")
    assert not read_design(tmp_path / "a.pcd").columns
