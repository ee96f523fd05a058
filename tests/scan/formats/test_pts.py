"""PTS: blocks of points, each after its number; a table without one."""

from pathlib import Path

import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.scan.read import read_scan

POINTS = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]


def read_pts(tmp_path: Path, text: str) -> list[list[float]]:
    (tmp_path / "scan.pts").write_bytes(text.encode())
    return read_scan(tmp_path / "scan.pts").points.tolist()


@pytest.mark.parametrize(
    "text",
    [
        "3\n1 2 3 -1200 9 9 9\n4 5 6 0 9 9 9\n7 8 9 2047 9 9 9\n",
        "2\n1 2 3 -1200 9 9 9\n4 5 6 0 9 9 9\n1\n7 8 9 2047 9 9 9\n",
        "2\r\n1 2 3\r\n4 5 6\r\n1\r\n7 8 9",
        "2\r1 2 3\r4 5 6\r1\r7 8 9\r",
        "\ufeff1\n1 2 3\n1\n4 5 6\n1\n7 8 9\n",
        "1 2 3\n4 5 6\n7 8 9\n",
    ],
)
def test_the_same_three_points(tmp_path: Path, text: str) -> None:
    assert read_pts(tmp_path, text) == POINTS


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("2\n1 2 3\n4 5 6\n3\n7 8 9\n7 8 9\n", "announces 3 points"),
        ("1\n1 2 3\n1\n4 5 6\n7 8 9\n", "before line 6 a block of 1 points should have ended, but '7 8 9' follows"),
        ("1\n1 2 3\n1\n4 5 x\n", "line 4 should begin with 3 numbers"),
        ("1\n1 2 3\n999999999999\n4 5 6\n", "announces 999999999999 points"),
        ("3\n1 2 3\n4 5 6\n", "announces 3 points.*room for 2 points"),
    ],
)
def test_blocks_that_lie(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(ScanError, match=rf"scan\.pts: .*{message}"):
        read_pts(tmp_path, text)
