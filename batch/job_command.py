"""What the commands that measure a job have in common: their arguments, and the folder that they write into."""

from __future__ import annotations

import argparse
from pathlib import Path

from .switches import add_switches, whole_number

METHODS = ("refined", "fusion", "pointcloud", "image")


def add_job_arguments(parser: argparse.ArgumentParser, name: str, *, verb: str, writes: str, prints_json: str) -> None:
    """Declare the arguments of ``aadm NAME JOB.toml``; ``verb`` is what it does to columns, ``writes`` its output."""
    # Written out, because --only would take a job that follows it for one more id.
    parser.usage = (
        f"aadm {name} JOB.toml [--out DIR] [--only ID ...] [--jobs N] [--method METHOD] [--json] [--quiet] [--debug] "
        "[-h]"
    )
    parser.add_argument("job", type=Path, metavar="JOB.toml", help="the job file")
    parser.add_argument("--out", type=Path, metavar="DIR", help=f"folder of {writes} (default: JOB-report beside JOB)")
    parser.add_argument(
        "--only", nargs="+", action="extend", default=[], metavar="ID", help=f"{verb} these columns only"
    )
    parser.add_argument(
        "--jobs", type=whole_number, default=1, metavar="N", help=f"{verb} N columns at a time (default: 1)"
    )
    parser.add_argument(
        "--method",
        choices=METHODS,
        default="refined",
        metavar="METHOD",
        help=f"how centres are extracted: {', '.join(METHODS)} (default: refined)",
    )
    add_switches(parser, prints_json=prints_json)


def report_folder(options: argparse.Namespace) -> Path:
    """Make the folder of the results before the work, not after it: a night's results must have a place."""
    from aadm_workbench.errors import JobError

    folder: Path = options.out or options.job.with_name(f"{options.job.stem}-report")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise JobError(f"{folder}: the folder for the reports cannot be made ({error.strerror})") from error
    return folder
