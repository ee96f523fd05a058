"""Take frames with a live camera and write each as a capture folder, which jobs, extract and watch read.

CAMERA is gentl:FILE.cti#SERIAL, gige://IP, mecheye://IP, or replay:FOLDER (captures that are played again). One frame
is written to FOLDER itself, several into folders in it, called after their time. A frame that is lost is named, and the
next one goes on; nothing is left half-written. The unit, the settings in force and the time stand in capture.json.
"""

from __future__ import annotations

import argparse
import json
from datetime import UTC, datetime
from pathlib import Path
from time import monotonic, sleep
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, ERRORS, add_switches, duration, whole_number

if TYPE_CHECKING:
    from aadm_workbench.camera.frame import Frame
    from aadm_workbench.model import Json

    from ..capturing.session import Session
    from ..shown.told import Words

EXAMPLE = """\
examples:
  aadm capture 'gentl:/opt/vendor/producer.cti#A1234' --out captures/C-301-foot
  aadm capture gige://192.168.1.20 --out captures/C-301-bars
  aadm capture replay:captures --out again --count 5 --every 2s"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "camera", metavar="CAMERA", help="gentl:FILE.cti#SERIAL, gige://IP, mecheye://IP, replay:FOLDER"
    )
    parser.add_argument("--out", required=True, type=Path, metavar="FOLDER", help="folder for the capture, or captures")
    parser.add_argument("--count", type=whole_number, metavar="N", help="how many (default: 1; with --every: no end)")
    parser.add_argument("--every", type=duration, metavar="TIME", help="from frame to frame: 2s, 500ms, 1min")
    add_switches(parser, prints_json="what was written")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Take frames; 12 where one of them was lost."""
    from aadm_workbench.errors import JobError

    from ..capturing.session import Session

    single = options.count is None and options.every is None
    if single and options.out.is_dir() and any(options.out.iterdir()):
        from aadm_workbench.model.reason import Reason

        raise JobError.because("said.of_file", file=options.out, why=Reason("scan.capture_there"))
    (options.out.parent if single else options.out).mkdir(parents=True, exist_ok=True)
    with Session(options.camera) as session:
        written, lost = _take_all(session, options, single)
    if options.json:
        print(json.dumps({"captures": written, "lost": lost}, ensure_ascii=False, indent=2))
    return ERRORS if lost or not written else ALL_PASS


def _take_all(session: Session, options: argparse.Namespace, single: bool) -> tuple[list[dict[str, Json]], list[str]]:
    """Take the frames that were asked for; what was written of each, and why each of the others was lost."""
    from aadm_workbench.errors import CaptureError, EndOfFramesError

    from ..capturing.session import name_of
    from ..shown.terminal import say
    from ..shown.told import told, words_for

    written: list[dict[str, Json]] = []
    lost: list[str] = []
    count = 1 if single else options.count
    while count is None or len(written) + len(lost) < count:
        began = monotonic()
        folder = options.out if single else options.out / name_of(datetime.now(UTC))
        try:
            frame = session.take(folder)
        except EndOfFramesError as error:
            if options.count is not None:
                lost.append(str(error))
            say(told(error, options))
            break
        except CaptureError as error:
            lost.append(str(error))
            say(told(error, options))
        else:
            written.append(_entry(folder, frame))
            if not (options.quiet or options.json):
                say(_line(folder, frame, words_for(options, "told_capture")))
        if count is None or len(written) + len(lost) < count:
            sleep(max(0.0, (options.every or 0.0) - (monotonic() - began)))
    return written, lost


def _entry(folder: Path, frame: Frame) -> dict[str, Json]:
    from aadm_workbench.report.hoisting_fitness import stamp_of

    return {"folder": str(folder), **frame.record(stamp_of(frame.captured_s) or "")}


def _line(folder: Path, frame: Frame, words: Words) -> str:
    return words.of(str(folder), words.joined([_what(frame, words), *frame.notes]))


def _what(frame: Frame, words: Words) -> str:
    import numpy as np

    if frame.files:
        return words("files", number=len(frame.files))
    depth_mm = frame.depth_mm if frame.points is None else frame.points[..., 2]
    if depth_mm is None:
        return words("nothing")
    returned = depth_mm[np.isfinite(depth_mm)]
    share = returned.size / depth_mm.size
    height, width = depth_mm.shape
    return words("taken", width=width, height=height, share=share, near=returned.min(), far=returned.max())
