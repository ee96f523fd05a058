"""``aadm study loop``: the whole chain without hardware, from a virtual camera to a virtual crane and back."""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .switches import ALL_PASS, FAILS, UNDECIDED, add_switches, whole_number

if TYPE_CHECKING:
    from aadm_workbench.twin.crane import Crane

    from .watch.run import Watcher

_ABOUT = "hoisting: camera, aadm watch, OPC UA and crane in a loop, until the column stands on its bars"
_MOST_FRAMES = 8  # three tell that it hangs still; the rest is for a second move
_LIMIT_MM = 3.0  # GB/T 51231-2016, 10.4


def add_loop_study(kinds: Any, prepare: Callable[[argparse.Namespace], None]) -> None:
    """Declare the study; ``prepare`` refuses what cannot work before anything is rendered."""
    parser = kinds.add_parser(
        "loop",
        help=_ABOUT,
        description=f"{_ABOUT[0].upper()}{_ABOUT[1:]}. All parts are the real ones but for the camera's light and the "
        "crane's ropes, which are calculated. Frames, state and job stay in --out.",
        epilog="examples:\n  aadm study loop --out loop --seed 3\n  aadm study loop --loops 200",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="another seed, another column (default: 0)")
    parser.add_argument(
        "--frames", type=whole_number, default=_MOST_FRAMES, metavar="N", help=f"at most (default: {_MOST_FRAMES})"
    )
    parser.add_argument(
        "--loops",
        type=whole_number,
        metavar="N",
        help="N columns that swing, with frames drawn by the errors of rendered ones: counts, in minutes",
    )
    parser.add_argument("--arm", action="store_true", help="with --loops: a robot's arm in place of the crane")
    parser.add_argument("--quick", action="store_true", help="a camera of half the resolution")
    parser.add_argument("--out", type=Path, metavar="DIR", help="folder for frames, state and job")
    add_switches(parser, prints_json="how it ended")
    parser.set_defaults(run=_study, prepare=prepare)


def _study(options: argparse.Namespace) -> int:
    """Run the loop: 0 where the column stands within the limit, 10 where not, 11 where it never came down."""
    if options.loops:
        return _loops(options)
    _check_packages()
    folder, options.out = options.out, None  # no plots
    options.prepare(options)
    with tempfile.TemporaryDirectory() as scratch:
        return _loop(options, folder or Path(scratch))


def _loops(options: argparse.Namespace) -> int:
    """Run many: 0 where every column that was let down stands within the limit, 10 where not."""
    from aadm_workbench.report.json import encode

    from .shown.terminal import say, show_json
    from .study_loops import run_loop, summary_of

    seeds = range(options.seed, options.seed + options.loops)
    found = summary_of([run_loop(seed, options.frames, arm=options.arm) for seed in seeds])
    if options.json:
        show_json(encode(found))
    elif not options.quiet:
        say(
            f"{found['ready']} of {found['loops']} columns ready within {options.frames} frames (median "
            f"{found['median_frames']}); {found['beyond_after_ready']} of them beyond the limit in the period after"
        )
    return FAILS if found["beyond_after_ready"] else ALL_PASS


def _check_packages() -> None:
    from importlib.util import find_spec

    from aadm_workbench.errors import MissingDependencyError

    if find_spec("asyncua") is None:
        raise MissingDependencyError("asyncua", "aadm study loop")


def _loop(options: argparse.Namespace, folder: Path) -> int:
    from aadm_workbench.twin.camera import PRO_M
    from aadm_workbench.twin.crane import laboratory_crane
    from aadm_workbench.twin.study.methods import thinned_camera

    from .link.machines import Machines
    from .shown.terminal import say, show_json

    crane = laboratory_crane(options.seed, thinned_camera(PRO_M, 2) if options.quick else PRO_M)
    tell = (lambda line: None) if options.quiet or options.json else say
    tell(f"the column hangs {crane.largest_mm():.1f} mm off")
    watcher = _watcher(crane, folder, options.frames, tell)
    with Machines(folder / "aadm-state.json", crane, tell, crane.now_ns):
        watcher.run()
    largest_mm = crane.largest_mm()
    document = {
        "synthetic": True,
        "seed": options.seed,
        "landed": crane.landed,
        "frames": watcher.frames,
        "moves": crane.moves,
        "largest_mm": round(largest_mm, 3),
    }
    how = "stands" if crane.landed else "still hangs"
    off = f"{largest_mm:.2f} mm off, limit {_LIMIT_MM:g} mm"
    tell(f"after {watcher.frames} frames and {crane.moves} moves the column {how} ({off})")
    if options.json:
        from aadm_workbench.report.json import encode

        show_json(encode(document))
    if not crane.landed:
        return UNDECIDED
    return ALL_PASS if largest_mm <= _LIMIT_MM else FAILS


def _watcher(crane: Crane, folder: Path, frames: int, tell: Callable[[str], None]) -> Watcher:
    """``aadm watch`` on the job of the column, with the virtual camera."""
    from aadm_workbench.inspection.tasks import plan_job
    from aadm_workbench.twin.crane import COLUMN, VirtualCamera, write_job

    from .capturing.session import LiveFolder, Session
    from .job.file import read_job
    from .watch.run import Watcher, WatchOptions

    folder.mkdir(parents=True, exist_ok=True)
    (task,) = plan_job(read_job(write_job(folder, crane)), only=(COLUMN,)).tasks
    frames_folder = folder / "frames"
    frames_folder.mkdir(exist_ok=True)
    live = LiveFolder(Session("virtual", lambda _: VirtualCamera(crane)), frames_folder)
    options = WatchOptions(folder / "aadm-state.json", frames, live=live)
    return Watcher(task, frames_folder, options, tell, crane.now_ns)
