"""Check the columns of a job and write its reports.

Writes DIR/report.json and DIR/timing.json; DIR is JOB-report beside the job unless --out says otherwise. A scan that is
missing or broken costs its own column only.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ..exit_codes import INTERNAL, exit_code_of
from ..job_command import add_job_arguments, report_folder
from ..one_thread import calculate_in_one_thread

if TYPE_CHECKING:
    from ..run import JobRun

SUMMARY = "check the columns of a job"
EXAMPLE = """\
examples:
  aadm check floor3.toml
  aadm check floor3.toml --only C-301 C-302 --out tonight --jobs 4
  aadm check floor3.toml --method fusion --json > report.json"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    add_job_arguments(parser, "check", verb="check", writes="the reports", prints_json="report.json")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Check a job; the exit code is that of its worst column."""
    calculate_in_one_thread()
    from ..job_file import read_job

    # Before the rest is imported: who has mistyped a key should not wait for it.
    job = read_job(options.job)
    from ..progress import ColumnProgress
    from ..run import RunOptions, run_job

    folder = report_folder(options)
    with ColumnProgress(quiet=options.quiet) as progress:
        done = run_job(job, RunOptions(options.method, tuple(options.only), options.jobs), progress.start)
    return _hand_over(done, folder, options)


def _hand_over(done: JobRun, folder: Path, options: argparse.Namespace) -> int:
    from aadm_workbench.atomic import write_atomically
    from aadm_workbench.errors import AadmError
    from aadm_workbench.report.json import encode, report_document, write_report

    from ..terminal import say, show, show_json
    from ..verdict_table import advice_lines, summary_line, verdict_table

    if options.debug:
        for name, trace in done.traces.items():
            say(f"{name}: {trace}")
    code = exit_code_of(column.verdict for column in done.report.columns)
    try:
        write_report(done.report, folder / "report.json")
        write_atomically(folder / "timing.json", encode(done.seconds))
    except AadmError as error:
        # Everything was checked, so this is not the "nothing was checked" that other errors mean.
        say(f"aadm: {error}")
        code = INTERNAL
    if options.json:
        show_json(encode(report_document(done.report)))
    elif not options.quiet:
        advice = list(advice_lines(done.report))
        show(verdict_table(done.report), "", *advice, *([""] if advice else []))
        show(summary_line(done.report), f"Report: {folder / 'report.json'}")
    return code
