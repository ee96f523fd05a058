"""Lines of a text that is too long to be split: where they end, and where a number of them ends."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Reason
from aadm_workbench.scan.file import ScanFile
from aadm_workbench.scan.formats.rows import LONGEST_LINE_BYTES

_USUAL_LINE_BYTES = 64  # three numbers of up to twenty characters, with what parts them
_SMALLEST_CHUNK_BYTES, _LARGEST_CHUNK_BYTES = 2**12, 2**24  # a page of memory; what bounds the memory


def with_newlines(content: bytes) -> bytes:
    """Return a text whose lines end in LF (or CRLF), also where they ended in CR alone; bytes keep their places."""
    return content.replace(b"\r", b"\n") if b"\n" not in content else content


def line_at(file: ScanFile, content: bytes, start: int) -> tuple[str, int]:
    """Return the next line that is not blank, without its end, and where the one after it begins.

    Both empty and at the end of the content where there is none left.

    Raises
    ------
    ScanError
        For a line that is longer than any exporter writes.
    """
    while start < len(content):
        end = content.find(b"\n", start, start + LONGEST_LINE_BYTES)
        if end < 0:
            end = len(content)
        if end - start > LONGEST_LINE_BYTES:
            raise file.wrong(Reason("points.long_line", most_bytes=LONGEST_LINE_BYTES, place=start))
        line = content[start:end].decode("latin-1").strip()
        start = min(end + 1, len(content))
        if line:
            return line, start
    return "", len(content)


def end_of_lines(content: bytes, start: int, count: int) -> int:
    """Return where the line begins that follows ``count`` lines, or the end of the content where there are fewer."""
    while start < len(content):
        stop = start + min(_LARGEST_CHUNK_BYTES, max(_SMALLEST_CHUNK_BYTES, _USUAL_LINE_BYTES * count))
        found = content.count(b"\n", start, stop)
        if found >= count:
            chunk = np.frombuffer(content[start:stop], np.uint8)
            return start + int(np.flatnonzero(chunk == ord("\n"))[count - 1]) + 1 if count else start
        count -= found
        start = stop
    return len(content)
