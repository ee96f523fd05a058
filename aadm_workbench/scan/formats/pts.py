"""PTS, the text of laser scanners: blocks of rows, each after a line with their number."""

from __future__ import annotations

import re

import numpy as np

from aadm_workbench.model import Reason
from aadm_workbench.scan.file import Cloud, Declared, ScanFile
from aadm_workbench.scan.formats.lines import end_of_lines, line_at, with_newlines
from aadm_workbench.scan.formats.records import check_room
from aadm_workbench.scan.formats.rows import parse_rows
from aadm_workbench.scan.formats.text import read_text

MOST_BLOCKS = 1000
"""A survey has some hundred stations; more are a file that means harm."""

_COUNT = re.compile("[0-9]{1,12}")
_SHORTEST_ROW_BYTES = 6  # 0 0 0 and the end of the line


def read_pts(file: ScanFile, declared: Declared) -> Cloud:
    """Read x, y and z of all blocks of a PTS file; one without a number of points is read as a table.

    Raises
    ------
    ScanError
        Naming the line that is no row of numbers, or how many rows are missing.
    """
    content = with_newlines(file.content)
    starts = _blocks(file, content)
    if len(starts) < 2:
        return read_text(file, declared)
    blocks = []
    for start, count in starts:
        check_room(file, start, count, _SHORTEST_ROW_BYTES, len(content) - start + 1)
        body = content[start : end_of_lines(content, start, count)]
        blocks.append(parse_rows(file, body, start, (0, 1, 2), count=count))
    note = Reason("points.pts_blocks", count=len(blocks))
    return Cloud(np.concatenate(blocks), declared.mm_per_unit, notes=(note,))


def _blocks(file: ScanFile, content: bytes) -> list[tuple[int, int]]:
    """Return where the rows of each block begin and how many there should be; what is no block ends the search."""
    starts: list[tuple[int, int]] = []
    position = 3 if content.startswith(b"\xef\xbb\xbf") else 0
    while True:
        line, position = line_at(file, content, position)
        if not _COUNT.fullmatch(line):
            if not line or len(starts) < 2:
                return starts
            place = content.count(b"\n", 0, position) + 1
            raise file.wrong(Reason("points.pts_block_end", place=place, count=starts[-1][1], line=repr(line[:80])))
        if len(starts) == MOST_BLOCKS:
            raise file.wrong(Reason("points.pts_too_many", most=MOST_BLOCKS))
        starts.append((position, int(line)))
        position = end_of_lines(content, position, int(line))
