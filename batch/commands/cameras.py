"""List the cameras that are there: their address, maker, model and serial number.

CAMERA is gentl:FILE.cti, the GenTL producer that came with the camera's program; gige:// or mecheye://, all that answer
in the network, or the one whose IP is added; or replay:FOLDER, captures that are played again. Without one, the
producers that the system names (GENICAM_GENTL64_PATH) are asked.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, ERRORS, add_switches

if TYPE_CHECKING:
    from aadm_workbench.camera.frame import Device

EXAMPLE = """\
examples:
  aadm cameras gentl:/opt/vendor/producer.cti
  aadm cameras gige://
  aadm cameras --json"""
_SYSTEM_PRODUCERS = "GENICAM_GENTL64_PATH"  # GenTL 1.5: folders with producers, as vendors' installers set it


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "camera", nargs="*", metavar="CAMERA", help="where to look: gentl:FILE.cti, gige://, replay:FOLDER …"
    )
    add_switches(parser, prints_json="the cameras")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print the cameras; 12 where a producer could not be asked."""
    from aadm_workbench.errors import CameraError, CaptureError, JobError

    from ..shown.terminal import say
    from ..shown.told import told

    addresses = options.camera or _of_the_system()
    if not addresses:
        raise JobError.because("command.no_producer", variable=_SYSTEM_PRODUCERS)
    found: list[Device] = []
    failed = False
    for address in addresses:
        try:
            found += _devices(address)
        except (CameraError, CaptureError) as error:
            if options.camera:
                raise
            say(told(error, options))
            failed = True
    _print(found, options)
    return ERRORS if failed else ALL_PASS


def _devices(address: str) -> list[Device]:
    from aadm_workbench.camera.open import devices

    return devices(address)


def _of_the_system() -> list[str]:
    folders = os.environ.get(_SYSTEM_PRODUCERS, "").split(os.pathsep)
    files = [path for folder in folders if folder for path in sorted(Path(folder).glob("*.cti"))]
    return [f"gentl:{path}" for path in files]


def _print(found: Sequence[Device], options: argparse.Namespace) -> None:
    from ..shown.terminal import show
    from ..shown.told import words_for

    if options.json:
        print(json.dumps([asdict(device) for device in found], ensure_ascii=False, indent=2))
    elif not options.quiet:
        words = words_for(options, "told_cameras")
        table = words.table("camera", "maker", "model", "serial")
        for device in found:
            table.add_row(device.address, device.vendor, device.model, device.serial)
        show(table if found else words("none"))
