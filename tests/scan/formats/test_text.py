"""Tables of points: separators, headers, comments, decimal commas, and rows that are none."""

from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.model import FloatArray
from aadm_workbench.scan.read import read_scan

EXPECTED = [[1.5, -2.0, 1000.25], [4.0, 5.5, 900.0]]


def read_text(tmp_path: Path, text: str, name: str = "scan.xyz") -> FloatArray:
    path = tmp_path / name
    path.write_bytes(text.encode())
    return read_scan(path).points


@pytest.mark.parametrize(
    "text",
    [
        "1.5 -2 1000.25\n4 5.5 9e2\n",
        "1.5 -2 1000.25\n4 5.5 9e2",
        "  1.5   -2\t1000.25 255 0 0\n\n4 5.5 900 1 2 3\n\n\n",
        "1.5\t-2\t1000.25\r\n4\t5.5\t900\r\n",
        "1.5 -2 1000.25\r4 5.5 900\r",
        "1.5,-2,1000.25\n4,5.5,900\n",
        "1.5, -2, 1000.25,\n4, 5.5, 900,\n",
        "1.5;-2;1000.25\n4;5.5;900\n",
        "1,5;-2,0;1000,25;7,5\n4,0;5,5;900,0;8,5\n",
        "1,5\t-2,0\t1000,25\n4,0\t5,5\t900,0\n",
        "x y z intensity\n1.5 -2 1000.25 8\n4 5.5 900 9\n",
        "X,Y,Z\n1.5,-2,1000.25\n4,5.5,900\n",
        '"id";"Z [mm]";"X [mm]";"Y [mm]"\n1;1000.25;1.5;-2\n2;900;4;5.5\n',
        "n,z_mm,x_mm,y_mm\n1,1000.25,1.5,-2\n2,900,4,5.5\n",
        "east north up\n1.5 -2 1000.25\n4 5.5 900\n",
        "# exported\n// X Y Z\n% more\n\n1.5 -2 1000.25\n# between\n4 5.5 900 # behind\n",
        "\ufeffx y z\n1.5 -2 1000.25\n4 5.5 900\n",
        "2\n1.5 -2 1000.25 -1 0 0 0\n4 5.5 900 -1 0 0 0\n",
    ],
)
def test_the_same_two_points(tmp_path: Path, text: str) -> None:
    points = read_text(tmp_path, text)
    assert points.tolist() == EXPECTED
    assert points.dtype == np.float64


@pytest.mark.parametrize("name", ["a.txt", "a.csv", "a.asc", "a.pts", "a.XYZ"])
def test_all_extensions_of_tables(tmp_path: Path, name: str) -> None:
    assert read_text(tmp_path, "1.5 -2 1000.25\n4 5.5 900\n", name).tolist() == EXPECTED


def test_rows_that_are_not_finite_are_left_out(tmp_path: Path) -> None:
    (tmp_path / "scan.xyz").write_text("1.5 -2 1000.25\nnan nan nan\n0 0 0\n1 inf 2\n4 5.5 900\n")
    scan = read_scan(tmp_path / "scan.xyz")
    assert scan.points.tolist() == EXPECTED
    assert scan.dropped == 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 2 3\n4 5\n7 8 9\n", "line 2 should begin with 3 numbers, but reads '4 5'"),
        ("x,y,z\n1,2,3\n4,,6,7\n", "line 3 should begin with 3 numbers, but reads '4,,6,7'"),
        ("# c\nx y z\n1 2 3\n\n4 5 a\n", "line 5 should begin with 3 numbers, but reads '4 5 a'"),
        ("x y z\nmm mm mm\n1 2 3\n", "line 2 should begin with three numbers, but reads 'mm mm mm'"),
        ("n z x y\n1 2 3\n", "line 2 should begin with three numbers"),
        ("1 2\n3 4\n", "line 2 should begin with three numbers"),
        ("# only\n\n# comments\n", "holds no row of three numbers"),
        ("\n" * 5000, "holds no row of three numbers"),
        ("3\n1 2 3\n4 5 6.000000\n", "announces 3 points, 2 follow"),
        ("1\n1 2 3.000\n4 5 6\n", "announces 1 points, 2 follow"),
        ("1\n1 2 3.000\n1\n4 5 6\n", "line 3 should begin with 3 numbers, but reads '1'"),
        ("1 2 3\0\n", "is not plain text"),
    ],
)
def test_what_is_no_table_of_points(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(ScanError, match=message):
        read_text(tmp_path, text)


def test_count_beyond_all_reason_is_refused_before_anything_is_allocated(tmp_path: Path) -> None:
    with pytest.raises(ScanError, match="999999999999 points"):
        read_text(tmp_path, "999999999999\n1 2 3\n")


def test_text_of_sixteen_bits_a_character(tmp_path: Path) -> None:
    (tmp_path / "scan.csv").write_bytes("1,2,3\n".encode("utf-16"))
    with pytest.raises(ScanError, match="is not plain text; save it as text in UTF-8"):
        read_scan(tmp_path / "scan.csv")


@pytest.mark.parametrize(
    ("heading", "factor"),
    [
        ("X [mm];Y [mm];Z [mm]", 1.0),
        ("X [m];Y [m];Z [m]", 1000.0),
        ("x_m;y_m;z_m", 1000.0),
        ("x(cm);y(cm);z(cm)", 10.0),
        ("x;y;z", 1.0),
        ("x_m;y_m;z", 1.0),
    ],
)
def test_names_of_columns_may_give_the_unit(tmp_path: Path, heading: str, factor: float) -> None:
    points = read_text(tmp_path, f"{heading}\n1.5;-2;1000.25\n4;5.5;900\n")
    np.testing.assert_allclose(points, np.array(EXPECTED) * factor)


def test_a_line_without_end(tmp_path: Path) -> None:
    with pytest.raises(ScanError, match=r"scan\.xyz: has a line of over 1048576 bytes"):
        read_text(tmp_path, "1 2 3\n" + "4 " * 2_000_000)
