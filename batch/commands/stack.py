"""Say what columns that are set, or about to be, do to the beams on them and to the next storey.

From the reports of checks: where each column comes to stand in its play, where its top and the bars of the next storey
are then, and how that changes span and bearing length of its beams; and which pose in its play would lead the tower
back to the grid. Reports of several storeys are chained: control points tie bars to the grid, other bars are reached
through the column below. Without either, what is told is told against a column's own bars alone.

What no scan tells (plumb, level, how near to its aim a column is let down) comes from [stack] of the job that was
checked, or of --job. Beams and heights come from --model.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import UNDECIDED, add_switches, exit_code_of
from ..tower_plan import PROFILE, planned

if TYPE_CHECKING:
    from aadm_workbench.model import JobReport, StackSettings
    from aadm_workbench.stack.result import StackPlan

EXAMPLE = """\
examples:
  aadm stack floor3-report/report.json --model floor3.ifc
  aadm stack floor2-report/report.json floor3-report/report.json --model tower.ifc --html
  aadm stack floor3-report/report.json --job floor3.toml --json > stack.json
  aadm stack floor3-report/report.json --model floor3.ifc --write-ifc floor3-set.ifc"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("reports", type=Path, nargs="+", metavar="REPORT.json", help="reports of checks, any storeys")
    parser.add_argument("--model", type=Path, metavar="MODEL.ifc", help="the model: heights of columns, and beams")
    parser.add_argument("--job", type=Path, metavar="JOB.toml", help="take [stack] of this job, not of the reports")
    parser.add_argument(
        "--tolerances",
        default=PROFILE,
        metavar="PROFILE",
        help=f"limits of tops and beams: a profile's name, or a .toml file (default: {PROFILE})",
    )
    parser.add_argument("--html", action="store_true", help="write stack.html: plan, beams, a page for setting-out")
    parser.add_argument("--out", type=Path, metavar="DIR", help="folder of stack.html (default: of the first report)")
    parser.add_argument(
        "--language",
        choices=("en", "zh"),
        default="en",
        metavar="LANGUAGE",
        help="en or zh: of tables, page and errors",
    )
    parser.add_argument(
        "--write-ifc", type=Path, metavar="FILE", help="write a copy of the model with the check's results and the plan"
    )
    add_switches(parser, prints_json="the plan")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Plan the tower; the exit code is that of the worst verdict on tops and beams."""
    from aadm_workbench.assembly.tolerances import load_profile
    from aadm_workbench.report.read import read_report
    from aadm_workbench.report.words.labels import phrase

    from ..shown.stack_tables import stack_tables
    from ..shown.terminal import show, show_json

    reports = [read_report(path) for path in options.reports]
    plan = planned(reports, _settings(options.job, reports), load_profile(options.tolerances), options.model)
    written = [_page(plan, options)] if options.html else []
    if options.write_ifc is not None:
        written.append(_model(plan, reports, options))
    if options.json:
        from aadm_workbench.report.json import encode
        from aadm_workbench.stack.document import stack_document

        show_json(encode(stack_document(plan)))
    elif not options.quiet:
        done = phrase("stack.written").in_language(options.language)
        show(*stack_tables(plan, options.language), *(f"{done} {path}" for path in written))
    return _exit_code(plan)


def _settings(job: Path | None, reports: Sequence[JobReport]) -> StackSettings:
    """Of the job that was named; else of the last report that carries any."""
    from aadm_workbench.model import StackSettings

    from ..job.file import read_job
    from ..job.stack import carried_settings

    if job is not None:
        return read_job(job).stack or StackSettings()
    carried = [found for report in reports if (found := carried_settings(report.job)) is not None]
    return carried[-1] if carried else StackSettings()


def _page(plan: StackPlan, options: argparse.Namespace) -> Path:
    from aadm_workbench.stack.page import write_stack_page

    from .report import _folder

    path: Path = _folder(options, options.reports[0].parent) / "stack.html"
    write_stack_page(plan, path, options.language)
    return path


def _model(plan: StackPlan, reports: Sequence[JobReport], options: argparse.Namespace) -> Path:
    """A copy of the model that was checked, with its results and AADM_Setting."""
    from aadm_workbench.errors import ReportError
    from aadm_workbench.stack.setting import setting_properties

    from ..model_results import write_results

    if options.model is None or len(reports) != 1:
        raise ReportError.because("command.stack_write")
    folder: Path = options.reports[0].parent
    done = write_results(reports[0], folder, options.model, options.write_ifc, setting=setting_properties(plan))
    return done.out


def _exit_code(plan: StackPlan) -> int:
    from aadm_workbench.model import Verdict

    counted = [verdict for verdict in plan.verdicts if verdict is not Verdict.NOT_ASSESSED]
    return exit_code_of(counted) if counted else UNDECIDED
