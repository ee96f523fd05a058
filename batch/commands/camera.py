"""Let a camera prove itself: draw a plate for a workshop, learn the camera from captures of it, verify it later.

`plate` draws it and writes plate.toml with its nominal places; the table of a measuring machine replaces these.
`learn` takes six to twelve captures of it, from several distances, tilted by up to 5 degrees, turned by 0, 90, 180 and
270 degrees, and writes the camera's profile, which [camera] profile of a job uses. `verify` asks one capture whether
the profile still holds, and keeps a log. `reversal` needs no plate: the same columns, captured again with the camera
turned by half a turn or moved across, in a job of its own (`up` is another one then): what goes with the camera is its
bend, what stays is the part.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, add_switches, exit_code_of, length, whole_number
from .camera_reversal import add_reversal

if TYPE_CHECKING:
    from aadm_workbench.calibration.learn.capture import PlateCapture
    from aadm_workbench.calibration.plate.plate import Plate
    from aadm_workbench.model import CameraProfile

EXAMPLE = """\
examples:
  aadm camera plate --holes 12 --diameter 36 --pitch 160 --pins 20 --out plate
  aadm camera learn plate/plate.toml plate-*.tiff --camera camera.toml --serial 0042 --out camera-0042.toml
  aadm camera verify plate/plate.toml today.tiff --profile camera-0042.toml
  aadm camera reversal upright.toml half-a-turn.toml"""

_PLATE = "draw a plate for the workshop: plate.pdf, plate.dxf, plate.step, plate.toml"
_LEARN = "learn a camera from captures of a plate"
_REVERSAL = "tell the camera's bend from the parts, by captures of the same columns from a turned or moved camera"
_VERIFY = "ask one capture of the plate whether a profile still holds; pass or fail, and a line in a log"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    kinds = parser.add_subparsers(title="what to do", metavar="WHAT", required=True)
    _, *examples = EXAMPLE.splitlines()
    for (name, said, add), example in zip(_KINDS, examples, strict=True):
        add(
            kinds.add_parser(
                name,
                help=said,
                description=f"{said}.",
                epilog=f"example:\n{example}",
                formatter_class=argparse.RawDescriptionHelpFormatter,
            )
        )


def _add_plate(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--holes", type=whole_number, default=12, metavar="N", help="in a square ring (default: 12)")
    parser.add_argument("--diameter", type=length, default=36.0, metavar="MM", help="of the holes (default: 36)")
    parser.add_argument("--pitch", type=length, default=160.0, metavar="MM", help="between holes (default: 160)")
    parser.add_argument("--pins", type=length, default=20.0, metavar="MM", help="diameter of the pins (default: 20)")
    parser.add_argument("--out", type=Path, default=Path("plate"), metavar="DIR", help="folder (default: plate)")
    parser.add_argument("--language", choices=("en", "zh"), metavar="LANGUAGE", help="en or zh: of the drawing")
    add_switches(parser, prints_json=None)
    parser.set_defaults(run=_draw)


def _add_captures(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--camera", type=Path, metavar="FILE", help="intrinsics, where captures do not carry them")
    parser.add_argument("--depth-scale", type=length, metavar="MM", help="step of integer depth maps")
    parser.add_argument(
        "--temperature", type=float, metavar="C", help="of the plate, degrees Celsius: its lengths follow"
    )
    parser.add_argument(
        "--date", default="", metavar="DATE", help="of the captures, 2026-11-20; kept, and never guessed"
    )


def _add_learn(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("plate", type=Path, metavar="PLATE.toml", help="the plate")
    parser.add_argument("captures", type=Path, nargs="+", metavar="CAPTURE", help="six to twelve, four at least")
    parser.add_argument("--out", type=Path, required=True, metavar="FILE", help="the camera's profile, .toml")
    parser.add_argument("--serial", default="", metavar="TEXT", help="of the camera, as [capture] of jobs has it")
    parser.add_argument("--settings", default="", metavar="TEXT", help="of the camera, as [capture] of jobs has them")
    parser.add_argument(
        "--valid-days", type=whole_number, default=90, metavar="N", help="how long it holds (default: 90)"
    )
    _add_captures(parser)
    add_switches(parser, prints_json="what was learned")
    parser.set_defaults(run=_learn)


def _add_verify(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("plate", type=Path, metavar="PLATE.toml", help="the plate")
    parser.add_argument("capture", type=Path, metavar="CAPTURE", help="one capture of it")
    parser.add_argument("--profile", type=Path, required=True, metavar="FILE", help="the camera's profile")
    parser.add_argument(
        "--log", type=Path, metavar="FILE", help="the log (default: PROFILE-log.csv beside the profile)"
    )
    parser.add_argument("--html", type=Path, metavar="FILE", help="write the control chart of the log")
    _add_captures(parser)
    add_switches(parser, prints_json="what was found")
    parser.set_defaults(run=_verify)


_KINDS = (
    ("plate", _PLATE, _add_plate),
    ("learn", _LEARN, _add_learn),
    ("verify", _VERIFY, _add_verify),
    ("reversal", _REVERSAL, add_reversal),
)


def _draw(options: argparse.Namespace) -> int:
    from aadm_workbench.calibration.plate.dxf import write_plate_dxf
    from aadm_workbench.calibration.plate.file import write_plate
    from aadm_workbench.calibration.plate.pdf import write_plate_pdf
    from aadm_workbench.calibration.plate.plate import drawn_plate
    from aadm_workbench.calibration.plate.step import write_plate_step
    from aadm_workbench.errors import DesignError

    from ..shown.terminal import show
    from ..shown.told import words_for

    plate = drawn_plate(options.holes, options.diameter, options.pitch, options.pins)
    try:
        options.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise DesignError.because("command.no_folder", folder=options.out, why=error.strerror) from error
    write_plate(plate, options.out / "plate.toml")
    write_plate_dxf(plate, options.out / "plate.dxf")
    write_plate_step(plate, options.out / "plate.step")
    write_plate_pdf(plate, options.out / "plate.pdf", options.language or "en")
    if not options.quiet:
        files = ", ".join(f"plate.{form}" for form in ("toml", "dxf", "step", "pdf"))
        show(words_for(options, "told_camera")("told.wrote", names=files, folder=options.out))
    return ALL_PASS


def _plate_and_captures(
    options: argparse.Namespace, files: Sequence[Path], profile: CameraProfile | None = None
) -> tuple[Plate, list[PlateCapture]]:
    """The plate, and what captures show of it: of a camera with a profile, set right by that at its edges."""
    from aadm_workbench.calibration.learn.capture import captured_plate
    from aadm_workbench.calibration.plate.file import read_plate
    from aadm_workbench.scan.camera import read_camera
    from aadm_workbench.scan.read import read_scan

    from ..shown.progress import StepProgress
    from ..shown.told import words_for

    plate = read_plate(options.plate)
    if options.temperature is not None:
        plate = plate.at(options.temperature)
    camera = None if options.camera is None else read_camera(options.camera)
    scale_mm, found = options.depth_scale, []
    words, quiet = words_for(options, "told_camera"), options.quiet or options.json
    with StepProgress(words("told.captures"), quiet=quiet, language=words.language) as progress:
        step = progress.start(len(files))
        for path in files:
            scan = read_scan(path, camera=camera, depth_scale_mm=scale_mm)
            found.append(captured_plate(replace(scan, learned=profile), plate))
            step(str(path))
    return plate, found


def _learn(options: argparse.Namespace) -> int:
    from aadm_workbench.calibration.learn.learn import learned
    from aadm_workbench.calibration.learn.profile import figures_text, learned_document, profile_of
    from aadm_workbench.own_files import write_atomically
    from aadm_workbench.report.json import encode
    from aadm_workbench.scan.camera_profile import profile_text

    from ..shown.camera_tables import learned_tables
    from ..shown.terminal import show, show_json
    from ..shown.told import words_for

    plate, captures = _plate_and_captures(options, options.captures)
    found = learned(captures, plate)
    profile = profile_of(found, plate, options.serial, options.settings, options.date, options.valid_days)
    write_atomically(options.out, profile_text(profile, figures_text(found, options.temperature)).encode())
    if options.json:
        show_json(encode(learned_document(found)))
    elif not options.quiet:
        words = words_for(options, "told_camera")
        show(*learned_tables(found, words), words("told.written", path=options.out))
    return ALL_PASS


def _verify(options: argparse.Namespace) -> int:
    from aadm_workbench.calibration.learn.verify import Checked, append_log, verified, write_control_chart
    from aadm_workbench.report.json import encode
    from aadm_workbench.scan.camera_profile import read_profile

    from ..shown.camera_tables import verified_table
    from ..shown.terminal import show, show_json
    from ..shown.told import words_for

    profile = read_profile(options.profile)
    plate, (capture,) = _plate_and_captures(options, [options.capture], profile)
    checks: tuple[Checked, ...] = verified(capture, plate, profile)
    log = options.log or options.profile.with_name(f"{options.profile.stem}-log.csv")
    append_log(log, options.date, options.capture.name, checks)
    if options.html is not None:
        write_control_chart(log, profile, options.html)
    if options.json:
        show_json(
            encode(
                [{"name": one.name, "value": one.value, "limit": one.limit, "verdict": one.verdict} for one in checks]
            )
        )
    elif not options.quiet:
        words = words_for(options, "told_camera")
        show(verified_table(checks, words), words("log", path=log))
    return exit_code_of([one.verdict for one in checks])
