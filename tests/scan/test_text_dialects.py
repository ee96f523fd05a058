"""Tables as programs and people save them: names over columns, rows without a number, columns that are no coordinate.

The truth is a table of three points that was written by hand; each dialect is the same table in other words.
"""

from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.model import FloatArray, Scan
from aadm_workbench.scan.read import read_scan

EXPECTED = [[1.5, -2.0, 1000.25], [4.0, 5.5, 900.0], [-7.25, 8.5, 950.125]]
ROWS = ["1.5 -2 1000.25", "4 5.5 900", "-7.25 8.5 950.125"]
INTENSITY = [17, 255, 3]


def read(tmp_path: Path, text: str | bytes, name: str = "scan.csv") -> Scan:
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_scan(path)


def table(heading: str, order: str, separator: str = ",") -> str:
    """The three points with columns in an order: x, y, z, n (count), i (intensity), u (normal), g (name)."""
    lines = [heading] if heading else []
    for number, row in enumerate(ROWS):
        x, y, z = row.split()
        fields = {"x": x, "y": y, "z": z, "n": str(number + 1), "i": str(INTENSITY[number]), "u": "0.577", "g": "P-7"}
        lines.append(separator.join(fields[column] for column in order))
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("heading", "order"),
    [
        ("点号,X坐标,Y坐标,Z坐标", "nxyz"),
        ("点名,X坐标(mm),Y坐标(mm),Z坐标(mm)", "gxyz"),
        ("序号,坐标X,坐标Y,坐标Z", "nxyz"),
        ("点号,X（mm）,Y（mm）,Z（mm）", "nxyz"),
        ("点号,X轴,Y轴,Z轴,强度", "nxyzi"),
        ("PointID,PosX,PosY,PosZ", "nxyz"),
        ("id,pos_z,pos_x,pos_y", "nzxy"),
        ("Intensity,PosX,PosY,PosZ", "ixyz"),
        ("scalar,x_coord,y_coord,z_coord", "ixyz"),
        ("Normals:0,Normals:1,Normals:2,Points:0,Points:1,Points:2", "uuuxyz"),
        ('"Points_0","Points_1","Points_2","Points_Magnitude"', "xyzi"),
        ("nx,ny,nz,x,y,z", "uuuxyz"),
        ("NormalX,NormalY,NormalZ,PointX,PointY,PointZ", "uuuxyz"),
        ("name,Position.X [mm],Position.Y [mm],Position.Z [mm]", "gxyz"),
        ("Nr.,X-Koordinate,Y-Koordinate,Z-Koordinate", "nxyz"),
        ("i,Easting,Northing,Elevation", "ixyz"),
        ("i,Northing,Easting,Elevation", "iyxz"),
        ("X,Y,Z,R,G,B", "xyziii"),
        ("//X,Y,Z,Intensity", "xyzi"),
        ("# intensity, x, y, z", "ixyz"),
        ("# written by a program, version 2.1", "xyzi"),
        ("Exported by a program", "xyzi"),
        ("", "xyzi"),
        ("", "nxyz"),
        ("", "nxyzi"),
    ],
)
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_columns_by_their_names(tmp_path: Path, heading: str, order: str, separator: str) -> None:
    scan = read(tmp_path, table(heading.replace(",", separator), order, separator))
    assert scan.points.tolist() == EXPECTED
    assert (order[0] == "n" and not heading) == any("counts its points" in note for note in scan.notes)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "gbk", "gb18030"])
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_encodings_of_names(tmp_path: Path, encoding: str, line_end: str) -> None:
    text = table("点号,X坐标(mm),Y坐标(mm),Z坐标(mm)", "nxyz").replace("\n", line_end)
    assert read(tmp_path, text.encode(encoding)).points.tolist() == EXPECTED


@pytest.mark.parametrize(("unit", "factor"), [("米", 1000.0), ("m", 1000.0), ("毫米", 1.0), ("cm", 10.0)])
def test_units_in_names(tmp_path: Path, unit: str, factor: float) -> None:
    scan = read(tmp_path, table(f"点号,X坐标({unit}),Y坐标({unit}),Z坐标({unit})", "nxyz"))
    np.testing.assert_allclose(scan.points, np.array(EXPECTED) * factor)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (table("Intensity,Range,Azimuth,Elevation", "ixyz"), r"x, y and z \(Intensity, Range, Azimuth, Elevation\)"),
        (table("a,b,c,d", "ixyz"), r"which of its columns are x, y and z \(a, b, c, d\); call them x, y and z there"),
        (table("intensity,x,y", "ixy"), "does not tell which of its columns"),
        (table("x1,y1,z1,x2,y2,z2", "xyzuuu"), "does not tell which of its columns"),
        (table("", "ixyz"), r"its first column \(17, 1\.5, -2, 1000\.25, \.\.\.\) does not look like x"),
        (table("", "uxyz").replace("0.577,4", "0.6,4"), "its first column .* does not look like x"),
        ("1,50,-2,00,1000,25\n4,00,5,50,900,00\n", "commas between its columns and, it seems, in its numbers"),
    ],
)
def test_columns_that_do_not_tell_what_they_hold(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(ScanError, match=message):
        read(tmp_path, text)


def test_an_intensity_before_a_grid_of_points_is_seen_where_it_varies(tmp_path: Path, grid: FloatArray) -> None:
    """In the first row of a picture the points hardly differ in y and z."""
    flat = grid.reshape(-1, 3)[700:]
    intensity = np.random.default_rng(1).uniform(0.0, 1.0, len(flat))
    np.savetxt(tmp_path / "plain.xyz", np.column_stack([flat, intensity]), "%.4f")
    np.testing.assert_allclose(read_scan(tmp_path / "plain.xyz").points.reshape(-1, 3)[-1], flat[-1], atol=1e-3)
    np.savetxt(tmp_path / "first.xyz", np.column_stack([intensity, flat]), "%.4f")
    with pytest.raises(ScanError, match="does not look like x"):
        read_scan(tmp_path / "first.xyz")


@pytest.mark.parametrize(
    "text",
    [
        "1,5 -2,0 1000,25 9,1\n4,0 5,5 900,0 9,2\n-7,25 8,5 950,125 9,3\n",
        "1,5, -2,0, 1000,25\n4,0, 5,5, 900,0\n-7,25, 8,5, 950,125\n",
        "1,5;-2,0;1000,25\n4,0;5,5;900,0\n-7,25;8,5;950,125\n",
        '"1.5","-2","1000.25"\n"4","5.5","900"\n"-7.25","8.5","950.125"\n',
        "1.5\t-2\t1000.25\t\t7\n4\t5.5\t900\t\t7\n-7.25\t8.5\t950.125\t\t7\n",
        "X [mm]\tY [mm]\tZ [mm]\n1.5\t-2\t1000.25\n4\t5.5\t900\n-7.25\t8.5\t950.125\n",
    ],
)
def test_separators_and_decimal_commas(tmp_path: Path, text: str) -> None:
    assert read(tmp_path, text, "scan.txt").points.tolist() == EXPECTED


NONE = [
    "1.#QNAN",
    "-1.#IND",
    "1.#INF",
    "-1.#INF00",
    "1.#QO",
    "-1.#J",
    "nan",
    "-nan",
    "NaN",
    "nan(ind)",
    "-nan(ind)",
    "nan(snan)",
    "1.#SNAN",
    "Infinity",
    "-inf",
    "#N/A",
    "#NUM!",
    "N/A",
    "null",
    "--",
]


@pytest.mark.parametrize("word", NONE)
@pytest.mark.parametrize("separator", [" ", ",", ";", "\t"])
def test_rows_without_a_number_are_left_out_and_counted(tmp_path: Path, word: str, separator: str) -> None:
    rows = [word + f" {word}" * 2, ROWS[0], f"1 2 {word}", ROWS[1], f"{word} 3 4", ROWS[2], f"5 {word} 6", "0 0 0"]
    for first in (0, 1):
        scan = read(tmp_path, "\n".join(rows[first:]).replace(" ", separator) + "\n", "scan.xyz")
        assert scan.points.tolist() == EXPECTED
        assert scan.dropped == 5 - first


def test_a_comment_behind_a_row_is_none(tmp_path: Path) -> None:
    scan = read(tmp_path, "1.5 -2 1000.25 # QNAN\n4 5.5 900#IND\n1 2 1.#QNAN # lost\n-7.25 8.5 950.125\n", "scan.xyz")
    assert scan.points.tolist() == EXPECTED
    assert scan.dropped == 1


@pytest.mark.parametrize("word", ["1,#QNAN", "-1,#IND", "nan"])
def test_rows_without_a_number_and_with_decimal_commas(tmp_path: Path, word: str) -> None:
    text = f"{word} {word} {word}\n" * 3000 + "1,5 -2,0 1000,25\n4,0 5,5 900,0\n-7,25 8,5 950,125\n"
    for separator in (" ", ";", "\t"):
        scan = read(tmp_path, text.replace(" ", separator), "scan.asc")
        assert scan.points.tolist() == EXPECTED
        assert scan.dropped == 3000


def test_the_same_in_text_of_other_formats(tmp_path: Path) -> None:
    body = "1.5 -2 1000.25\n1.#QNAN 1.#QNAN 1.#QNAN\n-1.#IND 0 1\n4 5.5 900\n-7.25 8.5 950.125\n"
    pcd = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 5\nHEIGHT 1\nPOINTS 5\nDATA ascii\n"
    ply = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
    for name, text in (("a.pcd", pcd + body), ("a.ply", ply + body), ("a.pts", "5\n" + body)):
        scan = read(tmp_path, text, name)
        assert (scan.points.tolist(), scan.dropped) == (EXPECTED, 2)
    ptx = "5\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
    assert read(tmp_path, ptx + body, "a.ptx").points.tolist() == EXPECTED
