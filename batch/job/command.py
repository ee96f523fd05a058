"""What the commands that measure a job have in common: their arguments, and the folder that they write into."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import add_switches, memory_size, time_span, whole_number

if TYPE_CHECKING:
    from ..runner.cluster import Certificates
    from ..runner.pools import PoolOptions

METHODS = ("refined", "fusion", "pointcloud", "image", "corners")
BY_DESIGN = ("corners",)
"""These need a design: they find nothing in a scan alone, and nothing of a column that hangs."""
SCAN_METHODS = tuple(method for method in METHODS if method not in BY_DESIGN)


def add_job_arguments(
    parser: argparse.ArgumentParser, name: str, *, verb: str, writes: str, prints_json: str, more: str = ""
) -> None:
    """Declare the arguments of ``aadm NAME JOB.toml``; ``verb`` is what it does to columns, ``writes`` its output.

    ``more`` is what the command adds to its usage.
    """
    # Written out, because --only would take a job that follows it for one more id.
    parser.usage = (
        f"aadm {name} JOB.toml [--out DIR] [--only ID ...] [--method METHOD] {more + ' ' if more else ''}"
        "[--jobs N | --scheduler ADDRESS [--ship-inputs] [--tls-ca FILE --tls-cert FILE [--tls-key FILE]]] "
        "[--memory-limit SIZE] [--time-limit TIME] "
        "[--json] [--quiet] [--debug] [-h]"
    )
    parser.add_argument("job", type=Path, metavar="JOB.toml", help="the job file")
    parser.add_argument("--out", type=Path, metavar="DIR", help=f"folder of {writes} (default: JOB-report beside JOB)")
    parser.add_argument(
        "--only", nargs="+", action="extend", default=[], metavar="ID", help=f"{verb} these columns only"
    )
    _add_pool_arguments(parser, verb)
    parser.add_argument(
        "--method",
        choices=METHODS,
        default="refined",
        metavar="METHOD",
        help=f"how centres are extracted: {', '.join(METHODS)} (default: refined)",
    )
    add_switches(parser, prints_json=prints_json)


def _add_pool_arguments(parser: argparse.ArgumentParser, verb: str) -> None:
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--jobs",
        type=whole_number,
        metavar="N",
        help=f"{verb} N columns at a time, each in a process (default: as many as there are cores; a few columns are "
        "done at once, one after the other)",
    )
    where.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="use the workers of this Dask scheduler: tls://HOST:8786 or tcp://HOST:8786",
    )
    parser.add_argument(
        "--tls-ca", type=Path, metavar="FILE", help="authority that the scheduler's certificate is signed by (PEM)"
    )
    parser.add_argument(
        "--tls-cert", type=Path, metavar="FILE", help="certificate that is shown to the scheduler (PEM)"
    )
    parser.add_argument("--tls-key", type=Path, metavar="FILE", help="its key, where it is not in the same file (PEM)")
    parser.add_argument(
        "--ship-inputs", action="store_true", help="send the scans to the workers, which do not see this disk"
    )
    parser.add_argument(
        "--memory-limit",
        type=memory_size,
        metavar="SIZE",
        help="memory of one worker, such as 2GB (default: an even share)",
    )
    parser.add_argument(
        "--time-limit", type=time_span, metavar="TIME", help="time for one column, such as 90s (default: 15min)"
    )


def pool_options(options: argparse.Namespace) -> PoolOptions:
    """Where the columns of a job are to be worked on.

    Raises
    ------
    JobError
        Where certificates are named without a scheduler, or one of them without the other.
    """
    from ..runner.pools import PoolOptions

    return PoolOptions(
        options.jobs,
        options.scheduler,
        options.ship_inputs,
        options.memory_limit,
        options.time_limit,
        certificates=_certificates(options),
    )


def _certificates(options: argparse.Namespace) -> Certificates | None:
    from aadm_workbench.errors import JobError

    if options.tls_ca is None and options.tls_cert is None and options.tls_key is None:
        return None
    if options.scheduler is None:
        raise JobError.because("command.tls_without_scheduler")
    if options.tls_ca is None or options.tls_cert is None:
        raise JobError.because("command.tls_halved")
    from ..runner.cluster import Certificates

    return Certificates(options.tls_ca, options.tls_cert, options.tls_key)


def report_folder(options: argparse.Namespace) -> Path:
    """Make the folder of the results before the work, not after it: a night's results must have a place."""
    from aadm_workbench.errors import JobError

    folder: Path = options.out or options.job.with_name(f"{options.job.stem}-report")
    if options.out is None and folder.is_symlink():
        # Whoever sent the job may have sent the link along.
        raise JobError.because("command.folder_is_link", folder=folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise JobError.because("command.no_report_folder", folder=folder, why=error.strerror) from error
    return folder
