"""Columns with defects of one's own choice: what the check says of a bar that stands where one has put it.

``C-302: R5 +7.5,0`` puts bar R5 of that column 7.5 mm towards x off its place by design; ``C-301: S7 plugged`` closes a
mouth. All else stays within 0.8 mm of its place.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Reason
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.camera import CAPTURE_TABLES, DEPTH_SCALE_MM
from aadm_workbench.twin.floor import calm_bars, calm_foot, up_pose
from aadm_workbench.twin.hoisting import Hang, HoistingScan, Stand, hoisting_scan
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.pair import design_table, scan_truth
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import scan_of
from aadm_workbench.twin.scenes import FIELD
from aadm_workbench.twin.truth import sample_design, true_verdicts

_WRITTEN = re.compile(r"\s*(?P<column>[^:]+?)\s*:\s*(?P<kind>[SR])(?P<number>[1-9]\d*)\s+(?P<what>.+?)\s*")
_VECTOR = re.compile(r"(?P<dx>[-+]?\d+(?:\.\d+)?)\s*,\s*(?P<dy>[-+]?\d+(?:\.\d+)?)")
_FARTHEST_MM = 40.0  # half of the room between two bars: further off it is another bar's place
_FIRST = 301  # the columns are called as those of the sample floor
_STAND = Stand(distance=1000.0)  # so far away a foot of 600 mm and the bars under it fill the picture
_HANG_MM, _HANG_DEG = 4.0, 0.4  # spread of how a crane holds a column over its bars
_HEIGHT_MM = 90.0  # as in the reference scene of the hoisting studies
_RANGE_MM = 65_000 * DEPTH_SCALE_MM  # the steps that a depth map of 16 bits has


@dataclass(frozen=True)
class Defect:
    """What is wrong with one point: its displacement from design, mm, or None for a plugged mouth."""

    column: str
    kind: str
    number: int
    off_mm: tuple[float, float] | None


def defect_of(text: str) -> Defect:
    """A defect as it is written on the command line.

    Raises
    ------
    AadmError
        Where it cannot be read, or there is no such point.
    """
    found = _WRITTEN.fullmatch(text)
    if found is None:
        raise AadmError(Reason("run.defect", text=text))
    number, what = int(found["number"]), found["what"]
    most = len(FIELD.centres())
    if number > most:
        raise AadmError(Reason("run.defect_point", text=text, most=most))
    if found["kind"] == "S" and what == "plugged":
        return Defect(found["column"], "S", number, None)
    vector = _VECTOR.fullmatch(what)
    if vector is None:
        raise AadmError(Reason("run.defect", text=text))
    off_mm = float(vector["dx"]), float(vector["dy"])
    if np.hypot(*off_mm) > _FARTHEST_MM:
        raise AadmError(Reason("run.defect_far", text=text, most_mm=_FARTHEST_MM))
    return Defect(found["column"], found["kind"], number, off_mm)


def column_ids(count: int) -> list[str]:
    """As those of the sample floor: ``C-301``, ``C-302`` and so on."""
    return [f"C-{_FIRST + k}" for k in range(count)]


def make_own_floor(
    folder: Path, seed: int, count: int, defects: Sequence[Defect] = (), *, hoisting: bool = False
) -> Iterator[str]:
    """Write scans, ``truth.json`` and ``job.toml``; yields a line of progress for each column.

    Raises
    ------
    AadmError
        Where a defect names a column that is not made.
    MissingDependencyError
        Where the ray caster is not installed.
    """
    ids = column_ids(count)
    for defect in defects:
        if defect.column not in ids:
            raise AadmError(Reason("run.defect_column", column=defect.column, ids=ids))
    (folder / "scans").mkdir(parents=True, exist_ok=True)
    truth: dict[str, object] = {}
    tables = [_head()]
    for number, name in enumerate(ids):
        own = [defect for defect in defects if defect.column == name]
        truth[name], frames = _column(folder, name, own, np.random.default_rng([seed, number]), hoisting=hoisting)
        tables.append(_column_text(name, frames))
        yield f"{name}: {', '.join(map(_said, own)) or 'fits well'}"
    text = {"synthetic": True, "seed": seed, "columns": truth}
    write_atomically(folder / "truth.json", (json.dumps(text, indent=1) + "\n").encode())
    write_atomically(folder / "job.toml", "".join(tables).encode())


def _column(
    folder: Path, name: str, defects: Sequence[Defect], rng: np.random.Generator, *, hoisting: bool
) -> tuple[dict[str, object], list[str]]:
    """The scans of a column; its truth, and the names of its hoisting frames."""
    foot, bars = _with(defects, calm_foot(FIELD, rng), calm_bars(FIELD, rng))
    noise, design = CameraNoise.drawn(rng), sample_design(FIELD)
    scans = {
        "foot": scan_of(foot, up_pose("+y", True, rng), noise, rng),
        "bars": scan_of(bars, up_pose("+y", False, rng), noise, rng),
    }
    for part, scan in scans.items():
        write_depth_tiff(folder / "scans" / f"{name}-{part}.tiff", scan.depth, DEPTH_SCALE_MM)
    true = true_verdicts(design, foot, bars)
    truth: dict[str, object] = {
        "verdict": true.verdict.value,
        "goes_on": true.goes_on.value,
        "sleeves": scan_truth(scans["foot"], design.sleeves),
        "rebars": scan_truth(scans["bars"], design.rebars),
    }
    if not hoisting:
        return truth, []
    hang = Hang(_HEIGHT_MM, rng.normal(0.0, _HANG_DEG), shift=(rng.normal(0.0, _HANG_MM), rng.normal(0.0, _HANG_MM)))
    frame = hoisting_scan(foot, bars, hang, _STAND, noise, rng)
    file = f"scans/{name}-hoist-1.tiff"
    depth = frame.frame.depth
    # Like any camera it has a range: what lies beyond is no part of the picture.
    write_depth_tiff(folder / file, np.where(depth < _RANGE_MM, depth, np.nan), DEPTH_SCALE_MM)
    return truth | {"hoisting": _of_frame(frame)}, [file]


def _of_frame(frame: HoistingScan) -> list[dict[str, object]]:
    return [
        {"sleeve": pair.sleeve, "rebar": pair.rebar, "offset_mm": np.round(pair.offset_mm, 4).tolist()}
        for pair in frame.pairs
    ]


def _with(defects: Sequence[Defect], foot: Foot, bars: BarGroup) -> tuple[Foot, BarGroup]:
    """The parts with their defects; places by design are in the order of the labels."""
    places, sleeves, rods = FIELD.centres(), list(foot.sleeves), list(bars.bars)
    for defect in defects:
        k = defect.number - 1
        if defect.off_mm is None:
            sleeves[k] = replace(sleeves[k], plugged_at=0.0)
            continue
        x, y = float(places[k, 0] + defect.off_mm[0]), float(places[k, 1] + defect.off_mm[1])
        if defect.kind == "S":
            sleeves[k] = replace(sleeves[k], x=x, y=y)
        else:
            rods[k] = replace(rods[k], x=x, y=y)
    return replace(foot, sleeves=tuple(sleeves)), replace(bars, bars=tuple(rods))


def _said(defect: Defect) -> str:
    point = f"{defect.kind}{defect.number}"
    if defect.off_mm is None:
        return f"{point} is plugged"
    return f"{point} stands {defect.off_mm[0]:+g}, {defect.off_mm[1]:+g} mm off its place"


def _head() -> str:
    return f"""# Synthetic scans of a virtual camera: aadm simulate floor
schema = 1
name = "Simulated floor"
units = "mm"
tolerances = "cn"

{CAPTURE_TABLES}"""


def _column_text(name: str, frames: Sequence[str]) -> str:
    design = "".join(f"{key} = {value}\n" for key, value in design_table(FIELD).items())
    hanging = f'hoisting = {json.dumps(list(frames))}\nnear = "-x-y"\n' if frames else ""
    return f"""
[[columns]]
id = "{name}"
sleeves = "scans/{name}-foot.tiff"
rebars = "scans/{name}-bars.tiff"
up = "+y"
{hanging}
[columns.design]
{design}"""
