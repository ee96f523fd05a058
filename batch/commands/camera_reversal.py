"""`aadm camera reversal`: captures of the same columns by a turned or moved camera tell what goes with the camera."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..switches import add_switches, exit_code_of


def add_reversal(parser: argparse.ArgumentParser) -> None:
    """Declare what it takes."""
    parser.add_argument(
        "captures", type=Path, nargs="+", metavar="JOB", help="jobs (.toml), or reports of checks (.json)"
    )
    add_switches(parser, prints_json="what was found")
    parser.set_defaults(run=_run, by="job", language=None)


def _run(options: argparse.Namespace) -> int:
    """Compare captures; fails where a camera bends more than its stated uncertainty."""
    from aadm_workbench.calibration.reversal import reversal_document, reversals_of
    from aadm_workbench.errors import ReportError
    from aadm_workbench.report.json import encode

    from ..shown.camera_tables import reversal_tables
    from ..shown.terminal import show, show_json
    from ..shown.told import words_for
    from .gauge import captures_in

    reports = [capture.report for path in options.captures for capture in captures_in(path, options)]
    found = reversals_of(reports)
    if not found:
        raise ReportError.because("calibration.no_reversal", count=len(reports))
    if options.json:
        show_json(encode(reversal_document(found)))
    elif not options.quiet:
        show(*reversal_tables(found, words_for(options, "told_camera")))
    return exit_code_of([one.verdict for one in found])
