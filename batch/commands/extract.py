"""Find the sleeves or the rebars in one scan, without a design and without a verdict.

Centres are in the frame of the scan, in mm; u is their standard uncertainty per axis in the plane (k = 1).
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..job.command import SCAN_METHODS
from ..switches import ALL_PASS, UNDECIDED, add_switches, length, whole_number

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.model import Array, AssemblyPoint, Extraction, Scan

    from ..shown.told import Words

EXAMPLE = """\
examples:
  aadm extract C-301-foot.ply --kind sleeve --diameter 36 --expected 12
  aadm extract C-301-bars.tiff --kind rebar --diameter 20 --camera camera.toml --depth-scale-mm 0.02
  aadm extract captures/C-301-bars --kind rebar --diameter 20"""

_PATTERN_DIAMETERS = 5.0
"""What a pattern spans at least, in diameters of its sleeves or bars: enough to notice a wrong unit."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("scan", type=Path, metavar="SCAN", help="depth map, point cloud, or folder of a capture")
    parser.add_argument("--kind", choices=("sleeve", "rebar"), required=True, help="what the scan shows")
    parser.add_argument(
        "--diameter",
        type=length,
        required=True,
        metavar="D",
        help="mm: inner (sleeve, at its mouth) or nominal (rebar)",
    )
    parser.add_argument(
        "--camera", type=Path, metavar="FILE", help="intrinsics (TOML, JSON or text, a job's too); depth maps need them"
    )
    parser.add_argument(
        "--depth-scale-mm", type=length, metavar="S", help="step of an integer depth map (default: that of FILE)"
    )
    parser.add_argument("--units", choices=("mm", "m"), default="mm", help="unit of the scan (default: mm)")
    parser.add_argument(
        "--axes",
        choices=("camera", "opengl"),
        help="of a cloud: x right, y down, z forward, or x right, y up, z backward (default: found out)",
    )
    parser.add_argument("--expected", type=whole_number, metavar="N", help="exit with 11 where fewer are found")
    parser.add_argument("--method", choices=SCAN_METHODS, default="refined", help="how (default: refined)")
    add_switches(parser, prints_json="the points")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print the points of a scan; 11 where fewer are found than expected, or none."""
    import numpy as np

    from aadm_workbench.extract.file_axes import in_coordinates_of_the_file
    from aadm_workbench.extract.method import extract
    from aadm_workbench.model import Kind

    from ..shown.terminal import say, show, show_json
    from ..shown.told import words_for

    words = words_for(options, "told_extract")
    scan = _read(options)
    extraction = extract(scan, Kind(options.kind), options.diameter, options.method, np.random.default_rng(0))
    extraction = in_coordinates_of_the_file(extraction, scan)
    if options.json:
        show_json(_encoded(scan, extraction, options.expected))
    elif not options.quiet:
        show(_table(extraction, words), "", _summary(scan, extraction, options.expected, words))
    found = len(extraction.points)
    for note in () if options.quiet else scan.notes:
        say(f"aadm: {words.of(scan.source, words.said(note))}")
    if extraction.reason and not options.quiet:
        say(f"aadm: {words.of(scan.source, words.said(extraction.reason))}")
    return ALL_PASS if found >= (options.expected or 1) else UNDECIDED


def _read(options: argparse.Namespace) -> Scan:
    from aadm_workbench.scan.camera import read_camera, read_depth_scale_mm
    from aadm_workbench.scan.plausible import check_plausible
    from aadm_workbench.scan.read import read_scan

    camera = None if options.camera is None else read_camera(options.camera)
    step_mm = options.depth_scale_mm
    if step_mm is None and options.camera is not None:
        step_mm = read_depth_scale_mm(options.camera)
    scan = read_scan(options.scan, units=options.units, camera=camera, depth_scale_mm=step_mm, axes=options.axes)
    return check_plausible(scan, _PATTERN_DIAMETERS * options.diameter)


@dataclass(frozen=True, eq=False)
class ExtractedPoint:
    """A point as ``--json`` tells it, scan frame; ``scan_mm`` is ``centre_mm`` by the name that report.json has."""

    centre_mm: Array
    scan_mm: Array
    axis: Array
    diameter_mm: float
    u_mm: float | None
    evidence: str


def _encoded(scan: Scan, extraction: Extraction, expected: int | None) -> bytes:
    from aadm_workbench.report.json import encode

    plane = extraction.plane
    document = {
        "source": scan.source,
        "sha256": scan.sha256,
        "dropped_points": scan.dropped,
        "notes": scan.notes,
        "kind": extraction.kind.value,
        "method": extraction.method,
        "expected": expected,
        "found": len(extraction.points),
        "reason": extraction.reason,
        "plane": None
        if plane is None
        else {"normal": plane.normal, "offset_mm": plane.offset, "residual_mm": plane.residual_mm},
        "vertical": extraction.vertical,
        "vertical_from": extraction.vertical_from,
        "points": [_entry(point, extraction.vertical) for point in extraction.points],
        "quality": extraction.quality,
    }
    return encode(document)


def _entry(point: AssemblyPoint, vertical: Array | None) -> ExtractedPoint:
    u_mm = _uncertainty_mm(point, vertical)
    return ExtractedPoint(point.centre, point.centre, point.axis, point.diameter_mm, u_mm, point.why)


def _uncertainty_mm(point: AssemblyPoint, vertical: Array | None) -> float | None:
    """Root mean square, over the directions across the vertical, of the centre's standard deviation."""
    import numpy as np

    if point.covariance is None:
        return None
    along = point.axis if vertical is None else vertical
    across = float(np.trace(point.covariance) - along @ point.covariance @ along)
    return float(np.sqrt(max(across, 0.0) / 2.0))


def _table(extraction: Extraction, words: Words) -> Table:
    numbers = ("", "x", "y", "z", "diameter", "u")
    table = words.table(*numbers, "evidence", numbers=numbers)
    for number, point in enumerate(extraction.points, start=1):
        u_mm = _uncertainty_mm(point, extraction.vertical)
        table.add_row(
            str(number),
            *(f"{value:.3f}" for value in point.centre),
            f"{point.diameter_mm:.3f}",
            "" if u_mm is None else f"{u_mm:.3f}",
            words.said(point.why),
        )
    return table


def _summary(scan: Scan, extraction: Extraction, expected: int | None, words: Words) -> str:
    kind, number = words(f"told.{extraction.kind.plural}"), len(extraction.points)
    about = {"number": number, "kind": kind, "scan": scan.source, "method": extraction.method}
    return words("found", **about) if expected is None else words("found_of", expected=expected, **about)
