"""Check the columns of a job and write its reports.

Writes DIR/report.json and DIR/timing.json; DIR is JOB-report beside the job unless --out says otherwise. A scan that is
missing or broken costs its own column only. Each result is kept in DIR/journal.jsonl as soon as it is there: after
Ctrl-C, a crash or a power failure --resume goes on, and the report is the same as if nothing had happened.
"""

from __future__ import annotations

import argparse
import signal
import threading
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager, nullcontext, suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

from aadm_workbench.errors import AadmError, JobError

from ..job.command import add_job_arguments, pool_options, report_folder
from ..report_files import add_format_switches, chosen_formats, require_packages
from ..switches import INTERNAL, INTERRUPTED, spoken

if TYPE_CHECKING:
    from aadm_workbench.inspection.job import Job
    from aadm_workbench.model import JobReport

    from ..made_report import MadeReport
    from ..runner.journal import Journal
    from ..runner.run import JobRun
    from ..shown.progress import Events, ShownCheck
    from ..tower_plan import Tower

EXAMPLE = """\
examples:
  aadm check floor3.toml
  aadm check floor3.toml --only C-301 C-302 --out tonight --jobs 4
  aadm check floor3.toml --html --crew
  aadm check floor3.toml --resume
  aadm check shipment.toml --scheduler tcp://10.0.0.5:8786 --ship-inputs
  aadm check floor3.toml --method fusion --json > report.json"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    add_job_arguments(
        parser,
        "check",
        verb="check",
        writes="the reports",
        prints_json="report.json",
        more="[--resume] [--verify] [--events FILE] [--write-ifc] [--html] [--pdf] [--xlsx] [--csv] [--bcf] "
        "[--bcf-pairs] [--crew] [--scan-card] [--bcf-version 2.1|3.0] [--language en|zh] [--absolute-paths]",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="go on where an earlier run into the same folder ended; what has changed since is checked again",
    )
    parser.add_argument(
        "--verify",
        action="store_true",
        help="with --resume: read every file again, also those whose size and times are what they were",
    )
    parser.add_argument(
        "--events", metavar="FILE", help="write what happens as JSON lines, for programs; - is stdout, without a table"
    )
    parser.add_argument(
        "--write-ifc", action="store_true", help="also write DIR/MODEL-checked.ifc: the model with the results in it"
    )
    parser.add_argument(
        "--absolute-paths", action="store_true", help="keep absolute paths of scans and model in the report"
    )
    add_format_switches(parser, also="also write ")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Check a job; the exit code is that of its worst column."""
    job = _asked(options)
    from ..runner.folder_lock import locked
    from ..runner.journal import PREVIOUS_NAME, Journal
    from ..runner.run import RunOptions, run_job
    from ..shown.progress import Events, ShownCheck
    from ..shown.terminal import say

    folder = report_folder(options)
    with ExitStack() as held:
        events = held.enter_context(closing(Events(options.events)))
        held.enter_context(locked(folder))
        held.enter_context(_end_requests())
        journal = held.enter_context(closing(Journal(folder, resume=options.resume)))
        if journal.put_aside:
            say(f"an unfinished check lay in {folder}; its results are in {PREVIOUS_NAME} (--resume goes on with such)")
        try:
            with ShownCheck(events, quiet=options.quiet, language=spoken(options.language)) as shown:
                run_options = RunOptions(options.method, tuple(options.only), pool_options(options), options.verify)
                done = run_job(job, run_options, shown, journal, folder)
        except (AadmError, KeyboardInterrupt) as stop:
            if isinstance(stop, AadmError) and not shown.done:
                raise
            return _stopped(stop, shown, journal, events, options)
        code, made = _hand_over(done, journal.finished, job, folder, options)
        if code != INTERNAL:
            journal.finish(made.text() if made is not None else "")
        summary = done.report.summary() if made is None else made.summary
        events.send("finished", exit_code=code, report=str(folder / "report.json"), summary=summary)
        return code


def _asked(options: argparse.Namespace) -> Job:
    """The job, where all that is asked of it can be had; whoever has mistyped a key waits for nothing else."""
    from ..job.file import read_job

    job = read_job(options.job)
    if options.events == "-" and options.json:
        raise JobError.because("command.events_and_json")
    require_packages(chosen_formats(options))
    if options.write_ifc:
        from ..model_results import ifc_model_of

        ifc_model_of(job)  # before the night's work, not after it
    return job


@contextmanager
def _end_requests() -> Iterator[None]:
    """Whoever ends this process in an orderly way (SIGTERM, a closed terminal) is heard like Ctrl-C."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    there = [number for name in ("SIGTERM", "SIGHUP") if (number := getattr(signal, name, None)) is not None]
    # Under nohup a closed terminal is to be ignored.
    heard = [number for number in there if signal.getsignal(number) is signal.SIG_DFL]
    before = {number: signal.signal(number, _interrupt) for number in heard}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _interrupt(number: int, frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def _stopped(
    stop: BaseException, shown: ShownCheck, journal: Journal, events: Events, options: argparse.Namespace
) -> int:
    """Say that a check ends before its end, and what is kept of it."""
    from ..shown.terminal import say
    from ..shown.told import told, words_for

    words = words_for(options, "told")
    journal.stop()
    events.send("interrupted", done=shown.done, columns=shown.total)
    say(f"aadm: {told(stop, options) or words('interrupted')}")
    say(f"aadm: {words('kept', done=shown.done, total=shown.total, journal=journal.path)}")
    return INTERRUPTED if isinstance(stop, KeyboardInterrupt) else INTERNAL


def _hand_over(
    done: JobRun, remembered: str, job: Job, folder: Path, options: argparse.Namespace
) -> tuple[int, MadeReport | None]:
    """Write and show what a check came to; the exit code, and the report where it could be written.

    ``remembered`` is what the journal knows of the report that an earlier run has written.
    """
    from aadm_workbench.own_files import write_atomically
    from aadm_workbench.report.json import encode

    from ..made_report import still_there, written
    from ..shown.terminal import say

    if options.debug:
        for name, trace in done.traces.items():
            say(f"{name}: {trace}")
    path = folder / "report.json"
    basis = f"{done.basis}{' absolute' * options.absolute_paths}" if done.basis else ""
    code, made = INTERNAL, still_there(remembered, basis, path)
    served = _Served(done, job, folder, options.absolute_paths)
    try:
        made = made or written(served.report, basis, path)
        write_atomically(folder / "timing.json", encode(done.seconds))
        code = made.exit_code if _write_reports(served, options) else INTERNAL
    except AadmError as error:
        # Everything was checked, so this is not the "nothing was checked" that other errors mean.
        _complain(error, options)
    # What could not be read of the results was said just now.
    with suppress(AadmError) if made is None else nullcontext():
        _show(served, None if made is None else path, options)
    if options.write_ifc and code != INTERNAL:
        code = _write_model(served, options) or code
    return code, made


@dataclass(eq=False)
class _Served:
    """The report of a run as it is handed over, made where it is needed; and what else is made of the same run."""

    done: JobRun
    job: Job
    folder: Path
    absolute_paths: bool
    _tower: Tower | None = None

    @cached_property
    def report(self) -> JobReport:
        from ..made_report import without_absolute_paths

        report = self.done.report
        if self.job.stack is not None:
            from ..tower_plan import Tower

            self._tower = Tower(report, self.job.model_path)
            report = self._tower.in_report()
        report.verdicts()  # once, before every text is looked at
        return report if self.absolute_paths else without_absolute_paths(report, self.job)

    @cached_property
    def written(self) -> JobReport:
        """What report.json holds."""
        from aadm_workbench.report.read import read_report

        return read_report(self.folder / "report.json")

    @property
    def tower(self) -> Tower:
        """The tower that the report was made with; of an earlier run's report the one that follows from it."""
        if self._tower is None:
            from ..tower_plan import Tower

            self._tower = Tower(self.written, self.job.model_path)
        return self._tower


def _show(served: _Served, path: Path | None, options: argparse.Namespace) -> None:
    """The report as JSON, or as a table with its ``path``, where it could be written."""
    if options.json:
        from aadm_workbench.report.json import encoded_report

        from ..shown.terminal import show_json

        show_json(encoded_report(served.report))
    elif not options.quiet and options.events != "-":
        from ..shown.verdict_table import show_verdicts

        show_verdicts(served.report, path, spoken(options.language))


def _complain(error: AadmError, options: argparse.Namespace) -> None:
    from ..shown.terminal import say
    from ..shown.told import told

    say(f"aadm: {told(error, options)}")


def _write_reports(served: _Served, options: argparse.Namespace) -> bool:
    """The other reports that were asked for, from what report.json holds; whether all were written."""
    formats = chosen_formats(options)
    if not formats:
        return True
    from ..report_files import HowReports, write_reports

    written = write_reports(served.written, formats, served.folder, HowReports.asked(options, served.tower))
    written.say(options)
    return not written.failed


def _write_model(served: _Served, options: argparse.Namespace) -> int:
    """Write the model with the results; 0 where that went well."""
    from ..model_results import ifc_model_of, write_results, written_lines
    from ..shown.terminal import say

    try:
        model, folder = ifc_model_of(served.job), served.folder
        out, setting = folder / f"{model.stem}-checked.ifc", served.tower.properties()
        written = write_results(served.written, folder, model, out, setting=setting)
    except AadmError as error:
        _complain(error, options)
        return INTERNAL
    if not options.quiet:
        say("\n".join(written_lines(written, options)))
    return 0
