"""PTX, the text of laser scanners: one or more scans, each a grid of points with the pose of its station."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Array, Reason
from aadm_workbench.scan.file import Cloud, Declared, ScanFile
from aadm_workbench.scan.formats.lines import end_of_lines, line_at, with_newlines
from aadm_workbench.scan.formats.records import check_room
from aadm_workbench.scan.formats.rows import parse_rows
from aadm_workbench.scan.joined import joined

MOST_SCANS = 1000
"""A survey has some hundred stations; more are a file that means harm."""

_NUMBERS_OF_HEADER_LINES = (1, 1, 3, 3, 3, 3, 4, 4, 4, 4)
"""Columns; rows; position of the scanner; its three axes; the transform, a row a line, for row vectors."""

_SHORTEST_ROW_BYTES = 6  # 0 0 0 and the end of the line
_INTENSITY_COLUMN = 3  # after x, y and z


@dataclass(frozen=True, eq=False)
class PtxHeader:
    """Header of one scan: its grid, the pose ``T_scan_file`` (4, 4) of its station, where its rows begin."""

    columns: int
    rows: int
    T_scan_file: Array
    start: int

    @property
    def count(self) -> int:
        """Points of the scan, no-returns included."""
        return self.columns * self.rows

    @property
    def organised(self) -> bool:
        """Whether the points form a grid; a single row or column of them is none."""
        return self.columns > 1 and self.rows > 1


def read_ptx(file: ScanFile, declared: Declared) -> Cloud:
    """Read all scans of a PTX file, the only one as a grid; rows of x, y, z and, if any, intensity and colour.

    Pixels without return are written as 0 0 0. Points are stored column by column.

    Raises
    ------
    ScanError
        Naming the line that is no header or no row of numbers, or how many rows are missing.
    """
    content = with_newlines(file.content)
    scans: list[tuple[PtxHeader, Array]] = []
    position = 3 if content.startswith(b"\xef\xbb\xbf") else 0
    while line_at(file, content, position)[0]:
        if len(scans) == MOST_SCANS:
            raise file.wrong(Reason("points.ptx_too_many", most=MOST_SCANS))
        header = _header(file, content, position)
        end = end_of_lines(content, header.start, header.count)
        if header.count:
            scans.append((header, _rows(file, header, content[header.start : end])))
        position = end
    if not scans:
        raise file.wrong(Reason("points.no_points"))
    is_grid = len(scans) == 1 and scans[0][0].organised
    clouds = [_organised(*one, declared) if is_grid else _in_rows(*one, declared) for one in scans]
    return joined(clouds)


def _header(file: ScanFile, content: bytes, position: int) -> PtxHeader:
    lines: list[list[float]] = []
    for wanted in _NUMBERS_OF_HEADER_LINES:
        start = position
        line, position = line_at(file, content, position)
        try:
            numbers = [float(word) for word in line.split()]
        except ValueError:
            numbers = []
        if len(numbers) != wanted or not np.isfinite(numbers).all():
            place = content.count(b"\n", 0, start) + 1
            raise file.wrong(
                Reason(
                    "points.ptx_line.several" if wanted > 1 else "points.ptx_line",
                    place=place,
                    number=len(lines) + 1,
                    count=wanted,
                    line=repr(line[:80]),
                )
            )
        lines.append(numbers)
    columns, rows = lines[0][0], lines[1][0]
    if min(columns, rows) < 0 or columns != round(columns) or rows != round(rows):
        raise file.wrong(Reason("points.ptx_size", columns=columns, rows=rows))
    T_scan_file = np.array(lines[6:]).T
    if not np.allclose(T_scan_file[3], [0.0, 0.0, 0.0, 1.0]) or not np.linalg.det(T_scan_file[:3, :3]):
        raise file.wrong(Reason("points.ptx_transform", position=position))
    header = PtxHeader(int(columns), int(rows), T_scan_file, position)
    if header.count:
        # The last row may do without its line end.
        check_room(file, position, header.count, _SHORTEST_ROW_BYTES, len(content) - position + 1)
    return header


def _rows(file: ScanFile, header: PtxHeader, body: bytes) -> Array:
    """Return x, y, z and, where it is there, the intensity of each point, in the order of the file."""
    first_row = body[: body.find(b"\n")].split()
    columns = range(min(max(len(first_row), 3), _INTENSITY_COLUMN + 1))
    return parse_rows(file, body, header.start, columns, count=header.count)


def _in_rows(header: PtxHeader, values: Array, declared: Declared) -> Cloud:
    # Where there is no grid, a station in the origin is what is written where it is not known.
    is_known = header.organised or not np.array_equal(header.T_scan_file, np.eye(4))
    points = np.ascontiguousarray(values[:, :3])
    return Cloud(points, declared.mm_per_unit, header.T_scan_file if is_known else None)


def _organised(header: PtxHeader, values: Array, declared: Declared) -> Cloud:
    grid = _as_grid(values[:, :3], header)
    grey = _grey(_as_grid(values[:, 3:], header)[..., 0]) if values.shape[1] > _INTENSITY_COLUMN else None
    return Cloud(grid, declared.mm_per_unit, header.T_scan_file, grey=grey)


def _as_grid(values: Array, header: PtxHeader) -> Array:
    """Return values that are stored column by column, (columns * rows, k), as (rows, columns, k)."""
    return np.ascontiguousarray(values.reshape(header.columns, header.rows, -1).transpose(1, 0, 2))


def _grey(intensity: Array) -> npt.NDArray[np.uint8] | None:
    """Return intensities, by the format from 0 to 1, as grey values; None where they are something else."""
    if not (np.isfinite(intensity).all() and intensity.min() >= 0.0 and 0.0 < intensity.max() <= 1.0):
        return None
    return np.rint(intensity * 255.0).astype(np.uint8)
