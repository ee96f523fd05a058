"""What is fuzzed: each reader of a file that somebody may send, as a function of bytes.

Whatever the bytes, a reader may raise an :class:`~aadm_workbench.errors.AadmError` and nothing else, and what it gives
holds no point that is not finite.
"""

from __future__ import annotations

import contextlib
import hashlib
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Camera
from aadm_workbench.report.read import read_report
from aadm_workbench.scan import intrinsics
from aadm_workbench.scan.depth import read_depth_map
from aadm_workbench.scan.file import Cloud, Declared, ScanFile, to_millimetres, without_return
from aadm_workbench.scan.formats.e57_outline import check_outline
from aadm_workbench.scan.formats.las import read_las
from aadm_workbench.scan.formats.npz import read_npz
from aadm_workbench.scan.formats.pcd import read_pcd
from aadm_workbench.scan.formats.ply import read_ply
from aadm_workbench.scan.formats.pts import read_pts
from aadm_workbench.scan.formats.ptx import read_ptx
from aadm_workbench.scan.formats.text import read_text
from batch.job.file import read_job

Target = Callable[[bytes], None]

CAMERA = Camera(20.0, 20.0, 4.0, 3.0, 8, 6)
DECLARED = Declared(1.0, CAMERA, 0.1)


def of_reader(reader: Callable[[ScanFile, Declared], Cloud]) -> Target:
    """The target of one format: read the bytes, and what follows for every format."""

    def target(content: bytes) -> None:
        with contextlib.suppress(AadmError):
            cloud = reader(ScanFile("scan", content, hashlib.sha256(content).hexdigest()), DECLARED)
            missing = without_return(cloud.points)
            points = to_millimetres(cloud.points.reshape(-1, 3)[~missing.ravel()], 1000.0, cloud.T_scan_file)
            if cloud.T_scan_file is None and not np.isfinite(points).all():
                raise AssertionError("a point that is not finite came through")

    return target


def outline(content: bytes) -> None:
    with contextlib.suppress(AadmError):
        check_outline(ScanFile("scan.e57", content, ""))


def camera_file(content: bytes) -> None:
    """The first byte chooses the kind of text."""
    suffix = (".json", ".toml", ".xml", ".txt")[content[0] % 4] if content else ".txt"
    with contextlib.suppress(AadmError):
        intrinsics.checked_camera(intrinsics.parse(content[1:].decode("utf-8-sig", errors="replace"), suffix))


@contextlib.contextmanager
def as_file(content: bytes) -> Iterator[Path]:
    folder = Path("/dev/shm")
    with tempfile.NamedTemporaryFile(dir=folder if folder.is_dir() else None) as stream:
        stream.write(content)
        stream.flush()
        yield Path(stream.name)


def job(content: bytes) -> None:
    with as_file(content) as path, contextlib.suppress(AadmError):
        read_job(path)


def report(content: bytes) -> None:
    with as_file(content) as path, contextlib.suppress(AadmError):
        read_report(path)


TARGETS: dict[str, Target] = {
    "ply": of_reader(read_ply),
    "pcd": of_reader(read_pcd),
    "ptx": of_reader(read_ptx),
    "pts": of_reader(read_pts),
    "text": of_reader(read_text),
    "las": of_reader(read_las),
    "npz": of_reader(read_npz),
    "depth": of_reader(read_depth_map),
    "e57": outline,
    "camera": camera_file,
    "job": job,
    "report": report,
}
