"""Study repeat captures of the same columns: repeatability, reproducibility, and whether u is to be believed.

Each JOB.toml or REPORT.json is a capture of the same columns; a job whose columns list several scans of a part is as
many captures. Captures of one operator, as [capture] of the job names him, repeat each other; --by takes another word
of [capture], or "job": then each job is a set-up of its own. Ten sleeves and three captures are enough to begin with.

The analysis is that of AIAG's manual on measurement systems (ANOVA). The exit code is that of the worst of: %GRR
against the limit of each quantity (pass under 10, fail over 30), and stated uncertainty against scatter of captures.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import add_switches, exit_code_of

if TYPE_CHECKING:
    from aadm_workbench.calibration.gauge.captures import Capture
    from aadm_workbench.calibration.gauge.study import GaugeStudy
    from aadm_workbench.inspection.job import Job, JobColumn
    from aadm_workbench.model import JobReport

EXAMPLE = """\
examples:
  aadm gauge monday.toml tuesday.toml wednesday.toml --html
  aadm gauge morning-report/report.json noon-report/report.json evening-report/report.json
  aadm gauge three-scans-each.toml --json
  aadm gauge north.toml south.toml --by job --html --language zh"""

_BY = ("operator", "date", "camera_serial", "settings", "calibration", "job")
_SEED = 2010  # of the intervals' draws: any other moves them by a hundredth


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "captures", type=Path, nargs="+", metavar="JOB", help="jobs (.toml), or reports of checks (.json)"
    )
    parser.add_argument(
        "--by",
        choices=_BY,
        default="operator",
        metavar="WORD",
        help=f"whose captures repeat each other: {', '.join(_BY)} (default: operator)",
    )
    parser.add_argument("--html", action="store_true", help="write gauge.html: figures and plots, in both languages")
    parser.add_argument("--out", type=Path, metavar="DIR", help="folder of gauge.html (default: of the first capture)")
    parser.add_argument(
        "--language", choices=("en", "zh"), default="en", metavar="LANGUAGE", help="en or zh: of the page"
    )
    add_switches(parser, prints_json="the study")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Study captures; the exit code is that of the worst verdict."""
    import numpy as np

    from aadm_workbench.calibration.gauge.study import gauge_study
    from aadm_workbench.errors import ReportError
    from aadm_workbench.model import Reason

    from ..report_files import require_packages
    from ..shown.terminal import show, show_json

    require_packages(["html"] if options.html else [])
    captures = [capture for path in options.captures for capture in captures_in(path, options)]
    if len(captures) < 2:
        raise ReportError(Reason("gauge.no_captures", count=len(captures)))
    found = gauge_study(captures, np.random.default_rng(_SEED))
    written = [_page(found, options)] if options.html else []
    if options.json:
        from aadm_workbench.calibration.gauge.document import gauge_document
        from aadm_workbench.report.json import encode

        show_json(encode(gauge_document(found)))
    elif not options.quiet:
        from ..shown.gauge_tables import gauge_tables
        from ..shown.told import words_for

        show(*gauge_tables(found), *(words_for(options, "told")("written", path=path) for path in written))
    return exit_code_of(found.verdicts)


def captures_in(path: Path, options: argparse.Namespace) -> Iterator[Capture]:
    """The captures of a job, which is checked here, or of a report; ``by`` of the options says whose they are."""
    from aadm_workbench.calibration.gauge.captures import Capture
    from aadm_workbench.report.read import read_report

    reports = _checked(path, options) if path.suffix.lower() == ".toml" else [read_report(path)]
    for number, report in enumerate(reports, 1):
        name = path.as_posix() if len(reports) == 1 else f"{path.as_posix()} ({number})"
        operator = path.as_posix() if options.by == "job" else report.capture.get(options.by, "")
        yield Capture(name, operator or "–", report)


def _checked(path: Path, options: argparse.Namespace) -> list[JobReport]:
    """The report of each capture of a job, which is checked here."""
    from ..job.file import read_job
    from ..runner.run import RunOptions, run_job
    from ..shown.progress import Events, ShownCheck

    reports = []
    for job in captures_of(read_job(path)):
        with ShownCheck(Events(None), quiet=options.quiet or options.json, language=options.language) as shown:
            report = run_job(job, RunOptions(), shown).report
            # The columns are looked at again and again, so they are all made at once.
            reports.append(replace(report, columns=tuple(report.columns)))
    return reports


def captures_of(job: Job) -> list[Job]:
    """A job as its captures: where columns list several scans of a part, each of these is one by itself."""
    count = max(max(len(column.sleeves), len(column.rebars)) for column in job.columns)
    return [
        replace(job, columns=tuple(_column(column, number) for column in job.columns if _has(column, number)))
        for number in range(count)
    ]


def _has(column: JobColumn, number: int) -> bool:
    return number < max(len(column.sleeves), len(column.rebars))


def _column(column: JobColumn, number: int) -> JobColumn:
    """The column with its scan of that number; of a part with one scan alone that one, which repeats nothing."""
    sleeves, rebars = _one(column.sleeves, number), _one(column.rebars, number)
    return replace(column, sleeves=sleeves, rebars=rebars, hoisting=(), hoisting_near=())


def _one(files: Sequence[str], number: int) -> tuple[str, ...]:
    return tuple(files[number : number + 1])


def _page(found: GaugeStudy, options: argparse.Namespace) -> Path:
    from aadm_workbench.calibration.gauge.page import write_gauge_page

    from .report import _folder

    path: Path = _folder(options, options.captures[0].parent) / "gauge.html"
    write_gauge_page(found, path, options.language)
    return path
