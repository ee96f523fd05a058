"""Width and height that a picture announces, read without unpacking it: a small file may announce a huge one."""

from __future__ import annotations

import struct

from aadm_workbench.scan.file import ScanFile

_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_TIFF_SIGNATURES = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
_TIFF_WIDTH, _TIFF_HEIGHT = 256, 257  # tags of TIFF 6.0
_TIFF_VALUE_FORMATS = {3: "H", 4: "I", 16: "Q"}
_MOST_TIFF_ENTRIES = 4096  # a directory has twenty; so many take no time
_JPEG_SIGNATURE, _BMP_SIGNATURE = b"\xff\xd8\xff", b"BM"
# markers that begin a frame, without those of tables (ITU-T T.81, table B.1)
_JPEG_FRAMES = {*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC}
_MOST_JPEG_SEGMENTS = 10_000  # a picture has some dozen before its frame; so many take no time


def depth_map_size(file: ScanFile) -> tuple[int, int]:
    """Return width and height of a PNG or TIFF.

    Raises
    ------
    ScanError
        Where the file is neither, or ends within its header.
    """
    if file.content.startswith((_PNG_SIGNATURE, *_TIFF_SIGNATURES)):
        return picture_size(file)
    raise file.wrong("is neither a TIFF nor a PNG; a depth map is one of the two, check its extension")


def picture_size(file: ScanFile) -> tuple[int, int]:
    """Return width and height of a PNG, TIFF, JPEG or BMP.

    Raises
    ------
    ScanError
        Where the file is none of them, or ends within its header.
    """
    content = file.content
    try:
        if content.startswith(_PNG_SIGNATURE):
            width, height = struct.unpack_from(">II", content, 16)
        elif content.startswith(_TIFF_SIGNATURES):
            width, height = _tiff_size(content)
        elif content.startswith(_JPEG_SIGNATURE):
            width, height = _jpeg_size(content)
        elif content.startswith(_BMP_SIGNATURE):
            width, height = map(abs, struct.unpack_from("<ii", content, 18))
        else:
            raise file.wrong("is no picture that is read here; save it as PNG, TIFF, JPEG or BMP")
    except (struct.error, KeyError) as error:
        raise file.wrong(f"ends or breaks off within its header ({len(content)} bytes); copy it again") from error
    return int(width), int(height)


def check_whole(file: ScanFile) -> None:
    """Check that all chunks of a PNG are in the file: OpenCV takes as much memory as their lengths announce.

    Raises
    ------
    ScanError
        Where one is longer than the file; of other pictures nothing is said.
    """
    content, position, kind = file.content, len(_PNG_SIGNATURE), b""
    while content.startswith(_PNG_SIGNATURE) and kind != b"IEND":
        # Length and kind of a chunk stand before it, its checksum behind it.
        length = int.from_bytes(content[position : position + 4], "big")
        kind = content[position + 4 : position + 8]
        position += 12 + length
        if position > len(content):
            raise file.wrong(f"ends at byte {len(content)}, before its last chunk: it is cut off; copy it again")


def _tiff_size(content: bytes) -> tuple[int, int]:
    order = "<" if content[:2] == b"II" else ">"
    is_big = content[2:4] in (b"+\0", b"\0+")
    directory = struct.unpack_from(order + ("Q" if is_big else "I"), content, 8 if is_big else 4)[0]
    if directory > len(content):
        raise struct.error("the directory lies behind the end")
    count = struct.unpack_from(order + ("Q" if is_big else "H"), content, directory)[0]
    first, step, value_at = (directory + 8, 20, 12) if is_big else (directory + 2, 12, 8)
    sizes: dict[int, int] = {}
    for entry in range(first, first + min(count, _MOST_TIFF_ENTRIES) * step, step):
        tag, kind = struct.unpack_from(order + "HH", content, entry)
        if tag in (_TIFF_WIDTH, _TIFF_HEIGHT):
            sizes[tag] = struct.unpack_from(order + _TIFF_VALUE_FORMATS[kind], content, entry + value_at)[0]
    return sizes[_TIFF_WIDTH], sizes[_TIFF_HEIGHT]


def _jpeg_size(content: bytes) -> tuple[int, int]:
    position = 2
    for _ in range(_MOST_JPEG_SEGMENTS):
        mark, kind, length = struct.unpack_from(">BBH", content, position)
        if mark != 0xFF:
            break
        if kind in _JPEG_FRAMES:
            height, width = struct.unpack_from(">HH", content, position + 5)
            return width, height
        position += 1 if kind == 0xFF else 2 + length
    raise KeyError("no frame")
