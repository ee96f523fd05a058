"""A scan file on its way into a document: read by the private process, taken over here."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from aadm_workbench.design.directions import up_deg
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.scan_cloud import KINDS, UNITS, make_scan
from aadm_workbench.errors import ScanError
from aadm_workbench.model import Camera
from aadm_workbench.private.answers import ReadScan


@dataclass(frozen=True)
class AskedScan:
    """A scan file as it is to be read; ``camera`` None: it has none, or needs none."""

    kind: str
    file: Path
    units: str = "mm"
    camera: Camera | str | None = None
    depth_scale_mm: float | None = None
    most_points: int = 60_000

    def work(self) -> Work:
        """What the private process is asked.

        Raises
        ------
        ScanError
            Where there is no such kind, unit or file.
        """
        for word, known in ((self.kind, KINDS), (self.units, UNITS)):
            if word not in known:
                raise ScanError.because("document.scan_kind", kinds=KINDS, units=tuple(UNITS), word=repr(word))
        if not self.file.exists():
            raise ScanError.about(self.file, "scan.no_file")
        question = {
            "about": "scan",
            "file": str(self.file.resolve()),
            "units": self.units,
            "camera": asdict(self.camera) if isinstance(self.camera, Camera) else self.camera,
            "depth_scale_mm": self.depth_scale_mm,
            "most_points": self.most_points,
        }
        return Work(("ask", "question.json", "answer.json"), {"question.json": json.dumps(question)}, "answer.json")


def asked_again(cloud: Any, most_points: int) -> AskedScan:
    """A scan of a document as it was asked for, to be read now."""
    camera = Camera(**json.loads(cloud.Camera)) if cloud.Camera else None
    return AskedScan(cloud.Kind, Path(cloud.File), cloud.Units, camera, cloud.DepthScale or None, most_points)


def unread(camera: Mapping[str, float] | None, depth_scale_mm: float | None) -> ReadScan:
    """A scan that nobody has looked into yet: the check reads it, the view shows nothing of it."""
    straight = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    return ReadScan(
        sha256="",
        count=0,
        points=[],
        R_file_scan=straight,
        camera=camera,
        depth_scale_mm=depth_scale_mm,
        notes=[],
    )


def take_scan(column: Any, asked: AskedScan, read: ReadScan, *, up: str | None = None) -> Any:
    """Give a column a scan that was read; parameters as :func:`aadm_workbench.document.api.add_scan`.

    Raises
    ------
    JobError
        Where ``up`` is no direction.
    """
    if up is not None:
        up_deg(up, column.Label)
        setattr(column, "SleevesUp" if asked.kind == KINDS[0] else "RebarsUp", up)
    return make_scan(column, asked.file.resolve(), asked.kind, asked.units, read)
