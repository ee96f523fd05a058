"""A study as files: one row a feature, one row a spacing, one row a scan."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from aadm_workbench.own_files import write_atomically
from aadm_workbench.twin.study.methods import Measurement, MethodStudy

_FEATURES = (
    "setting",
    "scene",
    "method",
    "kind",
    "label",
    "found",
    "error_x_mm",
    "error_y_mm",
    "error_mm",
    "radial_mm",
    "along_mm",
    "u_mm",
    "covered",
    "diameter_error_mm",
)
_SPACINGS = ("setting", "scene", "method", "kind", "from", "to", "error_mm")
_SCANS = ("setting", "scene", "method", "kind", "expected", "found", "false", "seconds", "bare_calls_s", "reason")
_DECIMALS = 4  # 0.1 µm, and 0.1 ms

Cell = str | int | float | bool | None


def write_tables(study: MethodStudy, folder: Path) -> tuple[Path, ...]:
    """Write ``features.csv``, ``spacings.csv`` and ``scans.csv`` into a folder that exists.

    What was not found leaves its cells empty. Lengths are in mm, times in seconds.

    Raises
    ------
    AadmError
        Where a file cannot be written.
    """
    tables: dict[str, tuple[Sequence[str], Iterable[Sequence[Cell]]]] = {
        "features.csv": (_FEATURES, (row for m in study.measurements for row in _feature_rows(m))),
        "spacings.csv": (_SPACINGS, (row for m in study.measurements for row in _spacing_rows(m))),
        "scans.csv": (_SCANS, _scan_rows(study)),
    }
    for name, (heading, rows) in tables.items():
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(heading)
        writer.writerows([_written(cell) for cell in row] for row in rows)
        write_atomically(folder / name, text.getvalue().encode())
    return tuple(folder / name for name in tables)


def _feature_rows(m: Measurement) -> Iterable[Sequence[Cell]]:
    for feature in m.comparison.features:
        x, y = feature.error_mm or (None, None)
        yield (
            *_scan_of(m),
            feature.label,
            feature.error_mm is not None,
            x,
            y,
            feature.distance_mm,
            feature.radial_mm,
            feature.along_mm,
            feature.u_mm,
            feature.covered,
            feature.diameter_error_mm,
        )


def _spacing_rows(m: Measurement) -> Iterable[Sequence[Cell]]:
    for spacing in m.comparison.spacings:
        yield (*_scan_of(m), *spacing.between, spacing.error_mm)


def _scan_rows(study: MethodStudy) -> Iterable[Sequence[Cell]]:
    bare = {(b.setting, b.scene, b.kind): b.seconds for b in study.bare}
    for m in study.measurements:
        features = m.comparison.features
        found = sum(feature.error_mm is not None for feature in features)
        alone = bare.get((m.setting, m.scene, m.kind))
        yield (*_scan_of(m), len(features), found, m.comparison.false, m.seconds, alone, m.reason)


def _scan_of(m: Measurement) -> tuple[str, int, str, str]:
    return m.setting, m.scene + 1, m.method, m.kind.value


def _written(cell: Cell) -> str:
    if cell is None:
        return ""
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    return f"{cell:.{_DECIMALS}f}" if isinstance(cell, float) else str(cell)
