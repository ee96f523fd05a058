"""Before a shift: does one capture of the plate still show the camera that was learned? With a log and its chart."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from aadm_workbench.calibration.learn.capture import PlateCapture
from aadm_workbench.calibration.learn.stretch import one_capture
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.errors import ReportError
from aadm_workbench.extract.edges.learned_edges import OFF_RINGS
from aadm_workbench.model import CameraProfile, Kind, Verdict
from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.drawing.sketch import Circle, Label, Polyline, Shape, Sketch
from aadm_workbench.report.pages.svg import svg_of, svg_styles
from aadm_workbench.scan.file import load

_SIGMAS = 3.0
"""Limits of a control chart: Shewhart's."""

_SCATTER_TIMES = 1.6
"""Of what was learned: fourteen pins' coordinates scatter so much more than usual once in a thousand captures."""

_HEAD = ("date", "capture", "name", "value", "limit", "verdict")
_WIDTH, _HEIGHT, _LEFT = 700.0, 200.0, 60.0  # of the chart in its own units, and of its scale


@dataclass(frozen=True, slots=True)
class Checked:
    """One figure of a capture, from what was learned: it must not be off by more than ``limit``."""

    name: str
    value: float
    limit: float

    @property
    def verdict(self) -> Verdict:
        """Within the limit, or not."""
        return Verdict.PASS if abs(self.value) <= self.limit else Verdict.FAIL


def verified(capture: PlateCapture, plate: Plate, profile: CameraProfile) -> tuple[Checked, ...]:
    """The stretch of holes and pins against the profile, how far their centres scatter, and what is lost at steps.

    The capture is one whose scan had the profile: what it loses at edges is then taken off, as it was when learned.
    """
    found, checks = one_capture(capture, plate), []
    for kind in Kind:
        edges = profile.edges[kind]
        name = f"stretch of {kind.plural}"
        limit = _SIGMAS * math.hypot(edges.spread, edges.stretch.u)
        checks.append(Checked(name, found.mean[kind] - edges.stretch.value, limit))
        usual_mm = edges.scatter_pitches * capture.pitch_mm
        checks.append(Checked(f"scatter of {kind.plural}, mm", found.scatter_mm[kind], _SCATTER_TIMES * usual_mm))
        seen = capture.rings.get(kind)
        if seen is not None and edges.rings is not None:
            checks.append(Checked(f"rings of pixels lost at {kind.plural}", seen - edges.rings, OFF_RINGS))
    return tuple(checks)


def append_log(log: Path, date: str, capture: str, checks: Sequence[Checked]) -> None:
    """Add the figures of a capture to a log, which is made where it is not there."""
    before = load(log, str(log)).content.decode("utf-8-sig") if log.exists() else ",".join(_HEAD) + "\n"
    if not before.startswith(",".join(_HEAD)):
        raise ReportError.about(log, "calibration.no_log")
    rows = io.StringIO()
    writer = csv.writer(rows, lineterminator="\n")
    for one in checks:
        writer.writerow([date, capture, one.name, f"{one.value:.9g}", f"{one.limit:.9g}", one.verdict.value])
    write_atomically(log, (before + rows.getvalue()).encode())


def write_control_chart(log: Path, profile: CameraProfile, path: Path) -> None:
    """Write the chart of a log: each figure over its limit, capture by capture."""
    rows = list(csv.DictReader(io.StringIO(load(log, str(log)).content.decode("utf-8-sig"))))
    names = list(dict.fromkeys(row["name"] for row in rows))
    parts = [f"<h1>{escape(profile.serial or log.stem)}</h1>"]
    for name in names:
        mine = [row for row in rows if row["name"] == name]
        parts += [f"<h2>{escape(name)}</h2>", svg_of(_chart(mine), label=name)]
    style = f"body{{font-family:sans-serif;margin:2em}}svg{{max-width:60em}}\n{svg_styles()}"
    head = f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{escape(log.name)}</title>'
    write_atomically(path, f"{head}<style>{style}</style></head><body>{''.join(parts)}</body></html>\n".encode())


def _chart(rows: Sequence[dict[str, str]]) -> Sketch:
    values = [(float(row["value"]), float(row["limit"]), row["verdict"], row["date"]) for row in rows]
    most = 1.2 * max(max(abs(value), limit) for value, limit, *_ in values)
    scale, middle = _HEIGHT / 2.2 / most, _HEIGHT / 2.0
    step = (_WIDTH - _LEFT) / (len(values) + 1)
    limit = values[-1][1]
    shapes: list[Shape] = [Polyline(((_LEFT, middle), (_WIDTH, middle)), "guide")]
    for sign in (-1.0, 1.0):
        y = middle + sign * limit * scale
        shapes += [
            Polyline(((_LEFT, y), (_WIDTH, y)), "limit"),
            Label((_LEFT - 4.0, y), f"{sign * limit:.2g}", 9.0, anchor="end"),
        ]
    places = [(_LEFT + (k + 1) * step, middle + value * scale) for k, (value, *_) in enumerate(values)]
    shapes.append(Polyline(tuple(places), "axis"))
    for at, (_, _, verdict, date) in zip(places, values, strict=True):
        shapes.append(Circle(at, 4.0, verdict))
        shapes.append(Label((at[0], 8.0), date[5:], 8.0, "text-faint"))
    return Sketch(_WIDTH, _HEIGHT, tuple(shapes))
