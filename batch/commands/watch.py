"""Measure each new frame of a hanging column as it arrives in a folder.

Writes a line for each frame, and FOLDER/aadm-state.json: the last frame, how the column swings, where to push it from
its rest, and whether it may be lowered. A camera at another corner writes into a subfolder with that corner's name.
Frames that are still being written are waited for; a bad one is reported and skipped. With --camera the frames are
taken here: each is written as a capture into FOLDER first, then measured. Ends with Ctrl-C, or after --frames or
--seconds.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..job.table import NEAR
from ..switches import add_switches, duration, exit_code_of, length, whole_number

if TYPE_CHECKING:
    from ..watch.run import Live

EXAMPLE = """\
examples:
  aadm watch floor3.toml --column C-301 frames
  aadm watch floor3.toml --column C-301 frames --present --frames 1 --json
  aadm watch floor3.toml --column C-301 frames --camera 'gentl:/opt/vendor/producer.cti#A1234' --every 1s"""
STATE_NAME = "aadm-state.json"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("job", type=Path, metavar="JOB.toml", help="the job file")
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="folder that the camera writes its frames into")
    parser.add_argument("--column", required=True, metavar="ID", help="the column that hangs")
    parser.add_argument(
        "--state", type=Path, metavar="FILE", help=f"the state file (default: {STATE_NAME} in the folder)"
    )
    parser.add_argument(
        "--near", choices=tuple(NEAR), help="corner of the bars nearest to the camera (default: the job's)"
    )
    parser.add_argument(
        "--camera", metavar="CAMERA", help="take the frames with this camera, too (as of aadm capture), into the folder"
    )
    parser.add_argument("--every", type=duration, default=0.0, metavar="TIME", help="from frame to frame: 2s, 500ms")
    parser.add_argument("--present", action="store_true", help="begin with the frames that are there already")
    parser.add_argument("--frames", type=whole_number, metavar="N", help="end after this many frames")
    parser.add_argument("--seconds", type=length, metavar="S", help="end after this time")
    add_switches(parser, prints_json="the last state")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Watch a folder; the exit code is that of the last frame."""
    from ..job.file import read_job

    job = read_job(options.job)
    from aadm_workbench.inspection.tasks import plan_job

    from ..shown.terminal import say, show_json
    from ..shown.told import words_for
    from ..watch.run import Watcher, WatchOptions

    (task,) = plan_job(job, only=(options.column,)).tasks
    state = options.state or options.folder / STATE_NAME
    quiet = options.quiet or options.json
    with _live(options) as live:
        watcher = Watcher(
            task,
            options.folder,
            WatchOptions(
                state,
                options.frames,
                options.seconds,
                options.present,
                NEAR.get(options.near),
                live,
                words_for(options, "told_watch"),
            ),
            (lambda line: None) if quiet else say,
        )
        verdict = watcher.run()
    if options.json and watcher.frames:
        show_json(state.read_bytes())
    return exit_code_of([verdict])


@contextmanager
def _live(options: argparse.Namespace) -> Iterator[Live | None]:
    """The camera that the command names, open; None where another program writes the frames."""
    if options.camera is None:
        yield None
        return
    from ..capturing.session import LiveFolder, Session

    options.folder.mkdir(parents=True, exist_ok=True)
    with Session(options.camera) as session:
        yield LiveFolder(session, options.folder, options.every)
