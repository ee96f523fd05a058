"""LAS and LAZ, written by another program: precision, units, deleted points, headers that lie."""

import io
import struct
from pathlib import Path

import laspy
import numpy as np
import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array
from aadm_workbench.scan.formats import laz
from aadm_workbench.scan.read import read_scan

METRE = 'PROJCS["UTM",GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]],UNIT["metre",1],AXIS["X",EAST]]'
FOOT = METRE.replace('UNIT["metre",1]', 'UNIT["US survey foot",0.3048006096012192]')
NEW_TEXT = (
    'PROJCRS["UTM",BASEGEOGCRS["WGS 84",DATUM["W",ELLIPSOID["WGS 84",6378137,298.257,LENGTHUNIT["metre",1]]]],'
    'CONVERSION["c",PARAMETER["False easting",500000,LENGTHUNIT["metre",1]]],CS[Cartesian,2],AXIS["(E)",east],'
    'AXIS["(N)",north],LENGTHUNIT["foot",0.3048]]'
)


def coordinates(count: int = 5000) -> Array:
    """(n, 3) in whole thousandths, far from the origin."""
    whole = np.random.default_rng(2).integers(-3_000_000, 3_000_000, (count, 3))
    return np.asarray(whole * 0.001 + np.array([512_000.0, 4_096_000.0, 88.0]))


def content_of(points: Array, point_format: int = 3, *, packed: bool = False, text: str = "") -> bytes:
    header = laspy.LasHeader(point_format=point_format, version="1.4" if point_format > 5 or text else "1.3")
    header.scales, header.offsets = [0.001] * 3, [512_000.0, 4_096_000.0, 88.0]
    if text:
        header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(text))
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = points.T
    stream = io.BytesIO()
    cloud.write(stream, do_compress=packed)
    return stream.getvalue()


@pytest.mark.parametrize("point_format", range(11))
@pytest.mark.parametrize("packed", [False, True])
def test_all_point_formats_keep_their_precision(tmp_path: Path, point_format: int, packed: bool) -> None:
    points = coordinates()
    path = tmp_path / ("scan.laz" if packed else "scan.las")
    path.write_bytes(content_of(points, point_format, packed=packed))
    scan = read_scan(path, units="m")
    assert scan.points.dtype == np.float64
    np.testing.assert_allclose(scan.points, points * 1000.0, rtol=0, atol=1e-5)
    assert (scan.dropped, scan.viewpoint, scan.notes) == (0, None, ())


@pytest.mark.parametrize("point_format", [1, 6])
@pytest.mark.parametrize("packed", [False, True])
def test_points_that_were_deleted_are_left_out_and_counted(tmp_path: Path, point_format: int, packed: bool) -> None:
    points = coordinates()
    cloud = laspy.read(io.BytesIO(content_of(points, point_format)))
    deleted = np.arange(len(points)) % 7 == 0
    cloud.withheld = deleted
    path = tmp_path / "scan.laz"
    cloud.write(str(path), do_compress=packed)
    scan = read_scan(path, units="m")
    assert scan.dropped == deleted.sum()
    np.testing.assert_allclose(scan.points, points[~deleted] * 1000.0, rtol=0, atol=1e-5)


def test_more_points_than_are_unpacked_at_a_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(laz, "_UNPACKED_BYTES_AT_A_TIME", 34 * 700)
    points = coordinates()
    (tmp_path / "scan.laz").write_bytes(content_of(points, packed=True))
    np.testing.assert_allclose(read_scan(tmp_path / "scan.laz", units="m").points, points * 1000.0, rtol=0, atol=1e-5)


@pytest.mark.parametrize(
    ("text", "mm_per_unit"), [(METRE, 1000.0), (FOOT, 304.8006096012192), (NEW_TEXT, 304.8), ("", 1.0)]
)
def test_the_coordinate_system_gives_the_unit(tmp_path: Path, text: str, mm_per_unit: float) -> None:
    points = coordinates()
    (tmp_path / "scan.las").write_bytes(content_of(points, 6, text=text))
    scan = read_scan(tmp_path / "scan.las")
    np.testing.assert_allclose(scan.points, points * mm_per_unit, rtol=1e-12)
    assert bool(scan.notes) == bool(text)
    assert scan.declared_scale == pytest.approx(1.0 / mm_per_unit)


def test_heights_in_another_unit_and_degrees_are_refused(tmp_path: Path) -> None:
    heights = f'COMPD_CS["c",{METRE},VERT_CS["h",UNIT["foot",0.3048]]]'
    (tmp_path / "scan.las").write_bytes(content_of(coordinates(), 6, text=heights))
    with pytest.raises(ScanError, match=r"scan\.las: its heights are in foot, its plane in metre"):
        read_scan(tmp_path / "scan.las")
    degrees = 'GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]]'
    (tmp_path / "scan.las").write_bytes(content_of(coordinates(), 6, text=degrees))
    with pytest.raises(ScanError, match="degrees of longitude"):
        read_scan(tmp_path / "scan.las")


def with_bytes(content: bytes, at: int, value: bytes) -> bytes:
    return content[:at] + value + content[at + len(value) :]


@pytest.mark.parametrize(
    ("at", "value", "message"),
    [
        (0, b"LASX", "does not begin with"),
        (25, b"\x09", r"is LAS version 1\.9"),
        (96, struct.pack("<I", 10**9), "should begin at byte 1000000000"),
        (100, struct.pack("<I", 10**6), "announces 1000000 variable length records"),
        (100, struct.pack("<I", 7), "runs into its points"),
        (104, b"\x0b", "of format 11"),
        (105, struct.pack("<H", 5), "have 5 bytes"),
        (107, struct.pack("<I", 0), "announces 0 points"),
        (107, struct.pack("<I", 30_000_000), "announces 30000000 points"),
        (107, struct.pack("<I", 2**32 - 1), "announces 4294967295 points"),
        (131, struct.pack("<d", 0.0), "scales not 0"),
        (155, struct.pack("<d", float("nan")), "must be finite"),
    ],
)
def test_headers_that_lie(tmp_path: Path, at: int, value: bytes, message: str) -> None:
    (tmp_path / "scan.las").write_bytes(with_bytes(content_of(coordinates()), at, value))
    with pytest.raises(ScanError, match=rf"scan\.las: .*{message}"):
        read_scan(tmp_path / "scan.las")


def test_a_count_of_sixty_four_bits(tmp_path: Path) -> None:
    (tmp_path / "scan.las").write_bytes(with_bytes(content_of(coordinates(), 6), 247, struct.pack("<Q", 10**12)))
    with pytest.raises(ScanError, match="announces 1000000000000 points"):
        read_scan(tmp_path / "scan.las")


@pytest.mark.parametrize("packed", [False, True])
def test_every_cut_is_noticed(tmp_path: Path, packed: bool) -> None:
    content = content_of(coordinates(500), packed=packed)
    for length in [*range(1, 400, 11), *range(400, len(content) - 1, 307), len(content) - 1]:
        (tmp_path / "cut.laz").write_bytes(content[:length])
        with pytest.raises(ScanError, match=r"cut\.laz: "):
            read_scan(tmp_path / "cut.laz")


def test_a_table_of_chunks_that_would_fill_the_memory(tmp_path: Path) -> None:
    content = content_of(coordinates(), packed=True)
    start = struct.unpack_from("<I", content, 96)[0]
    table = struct.unpack_from("<q", content, start)[0]
    (tmp_path / "scan.laz").write_bytes(with_bytes(content, table + 4, b"\xff\xff\xff\x7f"))
    with pytest.raises(ScanError, match="announces 2147483647 chunks"):
        read_scan(tmp_path / "scan.laz")
    (tmp_path / "scan.laz").write_bytes(with_bytes(content, start, struct.pack("<q", 10**15)))
    with pytest.raises(ScanError, match="table of chunks should stand at byte 1000000000000000"):
        read_scan(tmp_path / "scan.laz")


def test_a_file_of_another_program(reference_clouds: Path) -> None:
    scan = read_scan(reference_clouds / "PDAL_test1_4.las")
    feet = np.array([1694510.3869, 1816497.9663, 5598.3596])
    np.testing.assert_allclose(scan.points[0], feet * 1200.0 / 3937.0 * 1000.0, atol=0.02)
    assert scan.points.shape == (1000, 3)
    assert "US survey foot" in scan.notes[0]


def point_wise(content: bytes) -> bytes:
    """A packed file of one chunk as the first LAZ programs wrote it: the same stream without chunks and their table."""
    start, records_at = struct.unpack_from("<I", content, 96)[0], struct.unpack_from("<H", content, 94)[0]
    changed = bytearray(content[:start])
    while changed[records_at + 2 : records_at + 18].rstrip(b"\0") != b"laszip encoded":
        records_at += 54 + struct.unpack_from("<H", changed, records_at + 20)[0]
    struct.pack_into("<H", changed, records_at + 54, 1)
    table = struct.unpack_from("<q", content, start)[0]
    return bytes(changed) + content[start + 8 : table]


@pytest.mark.parametrize("point_format", [0, 1, 3])
def test_packed_points_of_the_first_kind(tmp_path: Path, point_format: int) -> None:
    points = coordinates()
    content = point_wise(content_of(points, point_format, packed=True))
    (tmp_path / "scan.laz").write_bytes(content)
    np.testing.assert_allclose(read_scan(tmp_path / "scan.laz", units="m").points, points * 1000.0, rtol=0, atol=1e-5)
    (tmp_path / "scan.laz").write_bytes(content[: len(content) // 2])
    with pytest.raises(ScanError, match=r"scan\.laz: its points .* do not unpack"):
        read_scan(tmp_path / "scan.laz", units="m")
