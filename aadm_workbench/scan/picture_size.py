"""Width and height that a picture announces, read without unpacking it: a small file may announce a huge one."""

from __future__ import annotations

import struct

from aadm_workbench.model import Reason
from aadm_workbench.scan.file import ScanFile
from aadm_workbench.scan.formats.tiff_pages import SIGNATURES as TIFF_SIGNATURES
from aadm_workbench.scan.formats.tiff_pages import pages_of

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_JPEG_SIGNATURE, _BMP_SIGNATURE = b"\xff\xd8\xff", b"BM"
# markers that begin a frame, without those of tables (ITU-T T.81, table B.1)
_JPEG_FRAMES = {*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC}
_MOST_JPEG_SEGMENTS = 10_000  # a picture has some dozen before its frame; so many take no time


def picture_size(file: ScanFile) -> tuple[int, int]:
    """Return width and height of a PNG, TIFF, JPEG or BMP.

    Raises
    ------
    ScanError
        Where the file is none of them, or ends within its header.
    """
    content = file.content
    try:
        if content.startswith(PNG_SIGNATURE):
            width, height = struct.unpack_from(">II", content, 16)
        elif content.startswith(TIFF_SIGNATURES):
            page = pages_of(content)[0]
            width, height = page.width, page.height
        elif content.startswith(_JPEG_SIGNATURE):
            width, height = _jpeg_size(content)
        elif content.startswith(_BMP_SIGNATURE):
            width, height = map(abs, struct.unpack_from("<ii", content, 18))
        else:
            raise file.wrong(Reason("scan.picture_kind"))
    except (struct.error, KeyError, OverflowError) as error:
        raise file.wrong(Reason("scan.header_breaks", size_bytes=len(content))) from error
    return int(width), int(height)


def check_whole(file: ScanFile) -> None:
    """Check that all chunks of a PNG are in the file: OpenCV takes as much memory as their lengths announce.

    Raises
    ------
    ScanError
        Where one is longer than the file; of other pictures nothing is said.
    """
    content, position, kind = file.content, len(PNG_SIGNATURE), b""
    while content.startswith(PNG_SIGNATURE) and kind != b"IEND":
        # Length and kind of a chunk stand before it, its checksum behind it.
        length = int.from_bytes(content[position : position + 4], "big")
        kind = content[position + 4 : position + 8]
        position += 12 + length
        if position > len(content):
            raise file.wrong(Reason("scan.png_ends", size_bytes=len(content)))


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
