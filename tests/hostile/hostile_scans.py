"""Scans that mean harm or make no sense: each writes one file, or something that is none, and says its name."""

from __future__ import annotations

import io
import os
import struct
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np

from aadm_workbench.model import Array
from aadm_workbench.scan.write import write_ply
from tests.scan.numpy_files import write_npz

BILLION = 1_000_000_000
TRILLION = 1_000_000_000_000

Writer = Callable[[Path], str]
"""Writes into a folder; returns what a job is to call the scan."""


def ply_header(count: int, encoding: str = "binary_little_endian") -> bytes:
    axes = "".join(f"property float {axis}\n" for axis in "xyz")
    return f"ply\nformat {encoding} 1.0\nelement vertex {count}\n{axes}end_header\n".encode()


def pcd_header(count: int, storage: str) -> bytes:
    return (
        f"VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {count}\nHEIGHT 1\n"
        f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA {storage}\n"
    ).encode()


def ptx_header(columns: int, rows: int) -> bytes:
    return f"{columns}\n{rows}\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n".encode()


def las_header(count: int, *, version: int = 2, point_format: int = 1, records: int = 0) -> bytearray:
    header = bytearray(375)
    struct.pack_into("<4s20xBB", header, 0, b"LASF", 1, version)
    struct.pack_into("<HIIBHI", header, 94, 375, 375, records, point_format, 30, min(count, 2**32 - 1))
    struct.pack_into("<6d", header, 131, 0.001, 0.001, 0.001, 0.0, 0.0, 0.0)
    struct.pack_into("<Q", header, 247, count)
    return header


def e57(xml: bytes) -> bytes:
    """An E57 file with wrong checksums: what is to be refused is refused before they are looked at."""
    text = bytes(48) + xml
    pages = [text[at : at + 1020].ljust(1020, b"\0") + bytes(4) for at in range(0, len(text), 1020)]
    content = bytearray(b"".join(pages))
    struct.pack_into("<8sIIQQQQ", content, 0, b"ASTM-E57", 1, 0, len(content), 48, len(xml), 1024)
    return bytes(content)


def e57_of(count: int) -> bytes:
    axes = "".join(f'<cartesian{axis} type="Float" precision="single"/>' for axis in "XYZ")
    return e57(
        b'<?xml version="1.0"?><e57Root type="Structure"><data3D type="Vector"><vectorChild type="Structure">'
        + f'<points type="CompressedVector" fileOffset="48" recordCount="{count}">'.encode()
        + f'<prototype type="Structure">{axes}</prototype></points></vectorChild></data3D></e57Root>'.encode()
    )


def laughing_e57() -> bytes:
    entities = "".join(f'<!ENTITY e{level} "{f"&e{level - 1};" * 10}">' for level in range(1, 10))
    return e57(f'<?xml version="1.0"?><!DOCTYPE r [<!ENTITY e0 "ha">{entities}]><r>&e9;</r>'.encode())


def npy(shape: str, body: bytes = b"") -> bytes:
    text = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}}}".ljust(117) + "\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(text)) + text.encode() + body


def npz(member: bytes) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("points.npy", member)
    return stream.getvalue()


def pickled() -> bytes:
    stream = io.BytesIO()
    np.savez(stream, points=np.array([[{}, 1, 2]], dtype=object))
    return stream.getvalue()


def png(width: int, height: int, bits: int = 16) -> bytes:
    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", width, height, bits, 0, 0, 0, 0)
    body = zlib.compress(bytes(1_000_000))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def tiff(width: int, height: int) -> bytes:
    entries = [
        (256, width),
        (257, height),
        (258, 16),
        (259, 1),
        (262, 1),
        (273, 8),
        (277, 1),
        (278, height),
        (279, 100),
    ]
    rows = b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in entries)
    return b"II*\0" + struct.pack("<I", 108) + bytes(100) + struct.pack("<H", len(entries)) + rows + bytes(4)


def collinear() -> Array:
    return np.linspace(-120.0, 120.0, 3000)[:, None] * np.array([[1.0, 0.3, 0.0]]) + [0.0, 0.0, 700.0]


def of_bytes(name: str, content: bytes) -> Writer:
    def write(folder: Path) -> str:
        (folder / name).write_bytes(content)
        return name

    return write


def of_points(name: str, points: Array) -> Writer:
    def write(folder: Path) -> str:
        (write_npz if name.endswith(".npz") else write_ply)(folder / name, points)
        return name

    return write


def special(name: str, make: Callable[[Path], object]) -> Writer:
    def write(folder: Path) -> str:
        make(folder / name)
        return name

    return write


RNG = np.random.default_rng(11)

CLOUDS: dict[str, Writer] = {
    # Headers that announce what no file can hold.
    "ply-trillion": of_bytes("trillion.ply", ply_header(TRILLION) + bytes(1200)),
    "ply-text-trillion": of_bytes("trillion-text.ply", ply_header(TRILLION, "ascii") + b"1 2 3\n" * 99),
    "ply-elements": of_bytes(
        "elements.ply",
        b"ply\nformat binary_little_endian 1.0\nelement pad 999999999999\nproperty list uchar int l\n"
        b"element vertex 9\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + bytes(3_000_000),
    ),
    "pcd-trillion": of_bytes("trillion.pcd", pcd_header(TRILLION, "binary") + bytes(1200)),
    "pcd-text-trillion": of_bytes("trillion-text.pcd", pcd_header(TRILLION, "ascii") + b"1 2 3\n" * 99),
    "pcd-packed": of_bytes(
        "packed.pcd", pcd_header(BILLION // 3, "binary_compressed") + struct.pack("<II", 9, 4 * BILLION) + bytes(9)
    ),
    "ptx-trillion": of_bytes("trillion.ptx", ptx_header(1_000_000, 1_000_000) + b"1 2 3 0.5\n" * 99),
    "ptx-many": of_bytes("many.ptx", (ptx_header(1, 1) + b"1 2 3\n") * 5000),
    "pts-trillion": of_bytes("trillion.pts", b"999999999999\n" + b"1 2 3 0 0 0 0\n" * 99),
    "las-trillion": of_bytes("trillion.las", bytes(las_header(TRILLION, version=4)) + bytes(3000)),
    "las-records": of_bytes("records.las", bytes(las_header(100, records=2**32 - 1)) + bytes(3000)),
    "laz-unsaid": of_bytes("unsaid.laz", bytes(las_header(100, point_format=0x81)) + bytes(3000)),
    "e57-trillion": of_bytes("trillion.e57", e57_of(TRILLION)),
    "e57-million": of_bytes("million.e57", e57_of(1_000_000)),
    "npz-trillion": of_bytes("trillion.npz", npz(npy(f"({TRILLION}, 3)"))),
    # Archives and XML that burst.
    "npz-bomb": of_bytes("bomb.npz", npz(npy("(90000000, 3)", bytes(40_000_000)))),
    "npz-objects": of_bytes("objects.npz", pickled()),
    "e57-entities": of_bytes("laughs.e57", laughing_e57()),
    "e57-outside": of_bytes(
        "outside.e57", e57(b'<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><r type="Structure">&x;</r>')
    ),
    "e57-deep": of_bytes("deep.e57", e57(b"<a>" * 100_000 + b"</a>" * 100_000)),
    # Text without end.
    "xyz-line": of_bytes("line.xyz", b"1 " * 8_000_000),
    "xyz-row": of_bytes("row.xyz", b"1 2 3\n" + b"9" * 8_000_000 + b" 1 1\n"),
    "ptx-line": of_bytes("line.ptx", b"9" * 8_000_000),
    "xyz-garbage": of_bytes("garbage.xyz", RNG.bytes(100_000)),
    "ply-garbage": of_bytes("garbage.ply", ply_header(600, "ascii") + RNG.bytes(100_000)),
    # What is no file.
    "missing": lambda folder: "missing.ply",
    "empty": of_bytes("empty.ply", b""),
    "fifo": special("fifo.ply", os.mkfifo),
    "device": special("device.ply", lambda path: path.symlink_to("/dev/zero")),
    "folder": special("folder.ply", Path.mkdir),
    "link-to-nothing": special("dangling.ply", lambda path: path.symlink_to("nowhere.ply")),
    "link-to-itself": special("loop.ply", lambda path: path.symlink_to("loop.ply")),
    "long-name": lambda folder: f"{'n' * 300}.ply",
    "elsewhere": lambda folder: "../../../../../../etc/passwd",
    "no-extension": of_bytes("noextension", b"1 2 3\n" * 999),
    # Too little, or nothing that can be measured.
    "no-points": of_bytes("none.ply", ply_header(0)),
    "one-point": of_points("one.ply", np.array([[1.0, 2.0, 700.0]])),
    "two-points": of_points("two.ply", np.array([[1.0, 2.0, 700.0], [90.0, 2.0, 700.0]])),
    "all-equal": of_points("equal.ply", np.full((3000, 3), 77.0)),
    "all-zero": of_points("zero.ply", np.zeros((3000, 3))),
    "all-nan": of_points("nan.ply", np.full((3000, 3), np.nan)),
    "all-infinite": of_points("infinite.npz", np.full((40, 50, 3), np.inf)),
    "collinear": of_points("collinear.ply", collinear()),
    "collinear-grid": of_points("collinear.npz", collinear().reshape(50, 60, 3)),
    "two-places": of_points("places.ply", np.repeat([[0.0, 0.0, 700.0], [200.0, 0.0, 700.0]], 900, axis=0)),
    "absurd": of_points("absurd.ply", np.full((3000, 3), 1e300) * RNG.uniform(-1.0, 1.0, (3000, 3))),
    "absurd-half": of_points("half.ply", np.exp(RNG.uniform(-700.0, 700.0, (3000, 3)))),
    "very-far": of_points("far.ply", RNG.uniform(-1e11, 1e11, (3000, 3))),
    "metres": of_points("metres.ply", RNG.uniform(-0.15, 0.15, (3000, 3))),
    "noise": of_points("noise.ply", RNG.uniform([-150.0, -150.0, 550.0], [150.0, 150.0, 850.0], (20_000, 3))),
    "plane": of_points("plane.ply", RNG.uniform([-150.0, -150.0, 0.0], [150.0, 150.0, 0.01], (20_000, 3))),
    "steps": of_points("steps.ply", RNG.integers(-3, 3, (20_000, 3)) * 50.0),
}

OF_SOMETHING_ELSE = {"noise", "plane", "steps"}
"""Sound files of what is no component: whatever is found in them, it must not pass."""

READABLE = OF_SOMETHING_ELSE | {"one-point", "two-points", "all-equal", "collinear", "collinear-grid", "two-places"}
"""Those whose points reach the search for sleeves and bars, or come near to it."""

DEPTH_MAPS: dict[str, Writer] = {
    "png-huge": of_bytes("huge.png", png(2**31 - 1, 2**31 - 1)),
    "png-short": of_bytes("short.png", png(640, 480)),
    "png-picture": of_bytes("picture.png", png(640, 480, bits=8)),
    "tiff-huge": of_bytes("huge.tiff", tiff(2**31, 2**31)),
    "tiff-short": of_bytes("short.tiff", tiff(640, 480)),
    "tiff-header": of_bytes("header.tiff", b"II*\0\xff\xff\xff\xff"),
    "tiff-loop": of_bytes("loop.tiff", b"II*\0\x08\0\0\0\xff\xff" + struct.pack("<HHII", 256, 3, 1, 640) * 9),
    "npz-depth": of_bytes("depth.npz", npz(npy("(480, 640)")).replace(b"points", b"depth\0")),
}
