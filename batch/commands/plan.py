"""Say where to put the camera for hoisting frames of a column.

Of all places on the diagonal the one is named from which all sleeves of interest are in the picture, most bars are free
of each other, and the uncertainty stays below the wanted one; two places for columns that no single picture holds.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ..job.table import NEAR
from ..switches import ALL_PASS, UNDECIDED, add_switches, length

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.hoisting.plan import CameraPlan, View
    from aadm_workbench.model import Camera, ColumnDesign

    from ..shown.told import Words

EXAMPLE = """\
examples:
  aadm plan --size 600 --sleeve-diameter 36 --rebar-diameter 20 --per-side 4 --height 180
  aadm plan floor3.toml --column C-301 --height 150 --u 0.15
  aadm plan --size 1400 --sleeve-diameter 40 --rebar-diameter 25 --per-side 6 --before
  aadm plan --size 1000 --sleeve-diameter 40 --rebar-diameter 25 --per-side 5 --camera camera.toml --json"""
_COVER_MM = 60.0  # concrete beside a grouting sleeve, and half of it: where the model does not say; a choice
_BEFORE_MM = 0.1  # what a scan from before tells of a hidden point


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("job", nargs="?", type=Path, metavar="JOB.toml", help="take the column and camera of a job")
    parser.add_argument("--column", metavar="ID", help="the column of the job")
    parser.add_argument("--size", type=length, metavar="MM", help="side of a square column, instead of a job")
    parser.add_argument("--per-side", type=int, default=4, metavar="N", help="sleeves on a side (default: 4)")
    parser.add_argument("--cover", type=length, default=_COVER_MM, metavar="MM", help="from side to sleeve centre")
    parser.add_argument("--sleeve-diameter", type=length, default=36.0, metavar="MM", help="inner (default: 36)")
    parser.add_argument("--rebar-diameter", type=length, default=20.0, metavar="MM", help="nominal (default: 20)")
    parser.add_argument(
        "--camera", type=Path, metavar="FILE", help="intrinsics (default: the job's, else a Mech-Eye PRO M)"
    )
    parser.add_argument(
        "--height", type=length, default=150.0, metavar="MM", help="of the foot above the bar tops (default: 150)"
    )
    parser.add_argument(
        "--exposed", type=length, default=120.0, metavar="MM", help="length of the bars above the floor (default: 120)"
    )
    parser.add_argument(
        "--u", type=length, default=0.2, metavar="MM", help="wanted standard uncertainty per axis (default: 0.2)"
    )
    parser.add_argument(
        "--before",
        type=length,
        nargs="?",
        const=_BEFORE_MM,
        metavar="MM",
        help=f"scans from before hoisting tell where hidden points are, with this u (without MM: {_BEFORE_MM:g})",
    )
    parser.add_argument("--room", type=length, default=3000.0, metavar="MM", help="room for the camera (default: 3000)")
    parser.add_argument("--near", choices=tuple(NEAR), default="-x-y", help="corner at which it can stand")
    parser.add_argument("--sleeves", nargs="+", metavar="S", help="sleeves of interest (default: all)")
    add_switches(parser, prints_json="the plan")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Plan; the exit code says whether all sleeves of interest are seen."""
    from aadm_workbench.errors import AadmError
    from aadm_workbench.hoisting.plan import plan_camera
    from aadm_workbench.report.json import encode

    from ..shown.terminal import show, show_json
    from ..shown.told import words_for

    design, camera = _subject(options)
    labels = [point.label for point in design.sleeves]
    unknown = [label for label in options.sleeves or () if label not in labels]
    if unknown:
        raise AadmError.because("command.no_such_sleeve", names=", ".join(unknown), first=labels[0], last=labels[-1])
    plan, views = plan_camera(
        design,
        camera,
        height_mm=options.height,
        wanted_u_mm=options.u,
        near=NEAR[options.near],
        sleeves=options.sleeves,
        exposed_mm=options.exposed,
        most_mm=options.room,
        before_mm=options.before,
    )
    if options.json:
        show_json(encode({"plan": plan, "views": views}))
    elif not options.quiet:
        show(*_shown(plan, design, words_for(options, "told_plan")))
    return UNDECIDED if plan.reason else ALL_PASS


def _subject(options: argparse.Namespace) -> tuple[ColumnDesign, Camera]:
    """The column and the camera that are planned for."""
    from aadm_workbench.errors import JobError
    from aadm_workbench.model import Reason
    from aadm_workbench.scan.camera import read_camera
    from aadm_workbench.twin.camera import PRO_M

    camera = None if options.camera is None else read_camera(options.camera)
    if options.job is None:
        if options.size is None:
            raise JobError.because("command.plan_of_what")
        return _square(options), camera or PRO_M
    from aadm_workbench.inspection.tasks import plan_job

    from ..job.file import read_job

    if options.column is None:
        raise JobError.because("command.which_column")
    job = read_job(options.job)
    (task,) = plan_job(job, only=(options.column,)).tasks
    if task.design is None or not task.design.rebars:
        raise JobError(task.no_design or Reason("command.no_bars", column=options.column))
    return task.design, camera or job.camera or PRO_M


def _square(options: argparse.Namespace) -> ColumnDesign:
    from aadm_workbench.design.recognise.pattern import inline_design
    from aadm_workbench.errors import JobError
    from aadm_workbench.twin.parts import ring

    half = options.size / 2 - options.cover
    if half <= 0 or options.per_side < 2:
        raise JobError.because("command.no_room_for_sleeves", cover_mm=options.cover, size_mm=options.size)
    table = {
        "sleeve_diameter": options.sleeve_diameter,
        "rebar_diameter": options.rebar_diameter,
        "size": [options.size, options.size],
        "centres": ring(half, half, options.per_side).tolist(),
    }
    return inline_design("column", table)


def _shown(plan: CameraPlan, design: ColumnDesign, words: Words) -> list[Table | str]:
    numbers = ("from_first", "below_tops", "sleeves", "bars", "u", "depth")
    table = words.table("frame", "corner", *numbers, numbers=numbers)
    for number, view in enumerate(plan.views, 1):
        table.add_row(str(number), view.near, *_cells(view, design, words))
    lines: list[Table | str] = [table] if plan.views else []
    if plan.reason:
        lines.append(words.said(plan.reason))
    lines.append(words("aim"))
    return lines


def _cells(view: View, design: ColumnDesign, words: Words) -> tuple[str, ...]:
    return (
        f"{view.distance_mm:.0f}",
        f"{view.below_tops_mm:.0f}",
        f"{len(view.sleeves)}/{len(design.sleeves)}",
        f"{len(view.rebars)}/{len(design.rebars)}",
        f"{view.u_mm if view.u_of_all_mm is None else view.u_of_all_mm:.2f}",
        words("range", near=view.depth_mm[0], far=view.depth_mm[1]),
    )
