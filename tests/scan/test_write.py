"""Writers: files that are whole or not there, and arguments that are no points."""

from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import AadmError
from aadm_workbench.model import FloatArray
from aadm_workbench.scan.read import read_scan
from aadm_workbench.scan.write import write_pcd, write_ply


@pytest.mark.parametrize("write", [write_ply, write_pcd])
def test_the_same_points_give_the_same_bytes_and_nothing_else(tmp_path: Path, cloud: FloatArray, write) -> None:  # type: ignore[no-untyped-def]
    write(tmp_path / "a", cloud)
    write(tmp_path / "b", cloud)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
    assert {path.name for path in tmp_path.iterdir()} == {"a", "b"}


@pytest.mark.parametrize("write", [write_ply, write_pcd])
@pytest.mark.parametrize("shape", [(5,), (5, 4), (2, 2, 2, 3)])
def test_arrays_that_are_no_points(tmp_path: Path, write, shape: tuple[int, ...]) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(ValueError, match="neither"):
        write(tmp_path / "scan", np.ones(shape))
    assert not list(tmp_path.iterdir())


def test_points_that_do_not_shrink_are_packed_all_the_same(tmp_path: Path) -> None:
    noise = np.random.default_rng(6).integers(1, 2**62, (5000, 3)).view(np.float64)
    write_pcd(tmp_path / "scan.pcd", noise, "binary_compressed")
    np.testing.assert_array_equal(read_scan(tmp_path / "scan.pcd").points, noise)


def test_unknown_storage(tmp_path: Path, cloud: FloatArray) -> None:
    with pytest.raises(ValueError, match="mode 'zip' of a PCD file is not one of ascii, binary"):
        write_pcd(tmp_path / "scan.pcd", cloud, "zip")


def test_a_folder_that_is_not_there(tmp_path: Path, cloud: FloatArray) -> None:
    with pytest.raises(AadmError, match=r"scan\.ply: cannot be written .* check that its folder exists"):
        write_ply(tmp_path / "absent" / "scan.ply", cloud)
