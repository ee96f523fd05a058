"""Make reports from the report.json of a check, at any later time.

Writes into the folder of report.json unless --out says otherwise; without a format, report.html. A report.bcf that is
there already is updated: its topics keep their ids, and those of columns that now pass are closed. Scan cards can also
be made from a job, before anything is scanned: aadm report floor3.toml --scan-card

The exit code is 0 when the files are written, whatever the verdicts are; 70 where one could not be: the others are.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..report_files import add_format_switches, chosen_formats, require_packages
from ..switches import ALL_PASS, INTERNAL, add_switches

if TYPE_CHECKING:
    from aadm_workbench.inspection.job import Job
    from aadm_workbench.model import JobReport
    from aadm_workbench.report.pages.scan_card import ScanCard

    from ..report_files import Written

EXAMPLE = """\
examples:
  aadm report floor3-report/report.json --html --pdf --xlsx
  aadm report floor3-report/report.json --crew --only C-302 C-307 --out for-the-crew
  aadm report floor3-report/report.json --html --pdf --language zh
  aadm report floor3.toml --scan-card"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.usage = (
        "aadm report REPORT.json [--out DIR] [--html] [--pdf] [--xlsx] [--csv] [--bcf] [--bcf-pairs]\n"
        "                   [--crew] [--scan-card] [--fcstd]\n"
        "                   [--bcf-version 2.1|3.0] [--language en|zh] [--model MODEL.ifc] [--only ID ...]\n"
        "                   [--json] [--quiet]\n"
        "       aadm report JOB.toml --scan-card [--out DIR] [--only ID ...]"
    )
    parser.add_argument("report", type=Path, metavar="REPORT.json", help="the report of a check, or a job (JOB.toml)")
    parser.add_argument("--out", type=Path, metavar="DIR", help="folder of the files (default: that of REPORT.json)")
    add_format_switches(parser)
    parser.add_argument(
        "--model", type=Path, metavar="MODEL.ifc", help="of a job with [stack]: heights and beams for the tower"
    )
    parser.add_argument("--only", nargs="+", action="extend", default=[], metavar="ID", help="these columns only")
    add_switches(parser, prints_json="which files were written")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Write the reports that were asked for."""
    if options.report.suffix.lower() == ".toml":
        _say(_cards_of_job(options), options)
        return ALL_PASS
    written = _reports(options)
    _say(written.files, options)
    written.say(options)
    return INTERNAL if written.failed else ALL_PASS


def _reports(options: argparse.Namespace) -> Written:
    from aadm_workbench.report.read import read_report

    from ..report_files import HowReports, write_reports
    from ..tower_plan import Tower

    formats = chosen_formats(options) or ("html",)
    require_packages(formats)
    report = only_columns(read_report(options.report), options.only, options.report)
    folder = _folder(options, options.report.parent)
    return write_reports(report, formats, folder, HowReports.asked(options, Tower(report, options.model)))


def _cards_of_job(options: argparse.Namespace) -> dict[str, Path]:
    """Scan cards of columns that were not scanned yet: all that a job alone can give."""
    from aadm_workbench.errors import JobError

    from ..job.file import read_job
    from ..report_files import FORMATS

    if chosen_formats(options) != ("scan_card",):
        raise JobError.because("command.report_of_job", file=options.report, job=options.report)
    require_packages(("scan_card",))
    from aadm_workbench.report.pages.scan_card_page import write_scan_cards

    job = read_job(options.report)
    path = _folder(options, options.report.parent) / FORMATS["scan_card"][0]
    write_scan_cards(job_cards(job, tuple(options.only)), path, options.language or "zh", title=job.name)
    return {"scan_card": path}


def only_columns(report: JobReport, ids: list[str], source: Path) -> JobReport:
    """A report of some of its columns alone; all of them where none is named.

    Raises
    ------
    ReportError
        Where it has no such column.
    """
    from aadm_workbench.errors import ReportError, did_you_mean

    known = [column.id for column in report.columns]
    for name in ids:
        if name not in known:
            raise ReportError.because("command.no_such_column", job=source, name=name, meant=did_you_mean(name, known))
    return replace(report, columns=tuple(column for column in report.columns if not ids or column.id in ids))


def _folder(options: argparse.Namespace, otherwise: Path) -> Path:
    from aadm_workbench.errors import ReportError

    folder: Path = options.out or otherwise
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ReportError.because("command.no_report_folder", folder=folder, why=error.strerror) from error
    return folder


def _say(files: dict[str, Path], options: argparse.Namespace) -> None:
    from ..shown.terminal import show, show_json
    from ..shown.told import words_for

    if options.json:
        from aadm_workbench.report.json import encode

        show_json(encode({"files": {name: str(path) for name, path in files.items()}}))
    elif not options.quiet:
        show(*(words_for(options, "told")("written", path=path) for path in files.values()))


def job_cards(job: Job, only: Sequence[str] = ()) -> list[ScanCard]:
    """The cards of a job's columns, in its order; of some of them, where they are named.

    Raises
    ------
    JobError
        Where the job has no such column.
    DesignError
        Where the model cannot be read, or does not hold a column.
    """
    from aadm_workbench.errors import DesignError
    from aadm_workbench.inspection.tasks import plan_job
    from aadm_workbench.report.pages.scan_card import CardDesign, design_cards

    designs = []
    plan = plan_job(job, only=only)
    for task in plan.tasks:
        if task.design is None:
            raise DesignError(task.no_design)
        column = task.column
        designs.append(CardDesign(column.id, task.design, column.sleeves_up_deg, column.rebars_up_deg))
    return design_cards(designs, job.camera, () if plan.model is None else plan.model.grid)
