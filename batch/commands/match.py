"""Find out which column of a shipment goes on which bars.

Columns with one piece mark, or with the same design in the job, are interchangeable. Each entry of the job gives a foot
(its sleeves), a position (its rebars), or both; every foot is tried on every position, in all its symmetric turns where
the job says turns = true. The best assignment lets as many columns go on as can, makes the smallest margin as large as
possible, and then the sum of margins. A margin is what is left of the limit: 1 is perfect, below 0 it does not go on.

Writes DIR/match.json; DIR is JOB-report beside the job unless --out says otherwise.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..job.command import add_job_arguments, pool_options, report_folder
from ..switches import INTERNAL, exit_code_of

if TYPE_CHECKING:
    from ..matching.run import MatchRun

EXAMPLE = """\
examples:
  aadm match floor3.toml
  aadm match floor3.toml --only C-301 C-302 C-305 --out tonight
  aadm match floor3.toml --json > match.json"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    add_job_arguments(parser, "match", verb="measure", writes="match.json", prints_json="match.json")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Match a job; the exit code is that of its worst assignment."""
    from ..job.file import read_job

    job = read_job(options.job)
    from ..made_report import without_absolute_paths
    from ..matching.run import run_match
    from ..runner.run import RunOptions
    from ..shown.progress import StepProgress
    from ..shown.told import words_for

    folder = report_folder(options)
    words = words_for(options, "told_match")
    with StepProgress(words("told.measuring"), quiet=options.quiet, language=words.language) as progress:
        done = run_match(job, RunOptions(options.method, tuple(options.only), pool_options(options)), progress.start)
    done = replace(done, report=without_absolute_paths(done.report, job))
    return _hand_over(done, folder, options)


def _hand_over(done: MatchRun, folder: Path, options: argparse.Namespace) -> int:
    from aadm_workbench.errors import AadmError
    from aadm_workbench.own_files import write_atomically
    from aadm_workbench.report.json import encode, shipment_document

    from ..shown.match_table import match_tables
    from ..shown.terminal import say, show, show_json
    from ..shown.told import told, words_for

    if options.debug:
        for name, trace in done.traces.items():
            say(f"{name}: {trace}")
    code = exit_code_of(done.report.verdicts)
    content = encode(shipment_document(done.report))
    try:
        write_atomically(folder / "match.json", content)
    except AadmError as error:
        # Everything was matched, so this is not the "nothing was checked" that other errors mean.
        say(f"aadm: {told(error, options)}")
        code = INTERNAL
    if options.json:
        show_json(content)
    elif not options.quiet:
        words = words_for(options, "told_match")
        show(*match_tables(done.report, words), words("shown.report", file=folder / "match.json"))
    return code
