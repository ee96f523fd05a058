"""A floor of columns whose verdicts are known: scans, truth and job for the samples.

Every case is built so that its verdict does not hang on the camera's noise: what passes stays well within
its limits, what fails is well beyond.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Array, Verdict
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.camera import CAPTURE_TABLES, DEPTH_SCALE_MM, facing
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import scan_of
from aadm_workbench.twin.scenes import FIELD, Setting, random_bars, random_foot
from aadm_workbench.twin.truth import listed, sample_design, true_verdicts

_BOUND_MM = 0.8  # of centres from their places: so that no verdict of the floor hangs on the draw
_UPS = {"+x": (1.0, 0.0), "-x": (-1.0, 0.0), "+y": (0.0, 1.0), "-y": (0.0, -1.0)}


@dataclass(frozen=True)
class Case:
    """One column of the sample floor: its id, what is wrong with it, and the verdict that follows."""

    id: str
    story: str
    verdict: str
    goes_on: str
    up: str = "+y"
    with_bars: bool = True
    truncated: bool = False
    change: Callable[[Foot, BarGroup], tuple[Foot, BarGroup]] = lambda foot, bars: (foot, bars)


def sample_cases() -> tuple[Case, ...]:
    """The columns of the sample floor."""
    return (
        Case("C-301", "fits well", "pass", "pass"),
        Case("C-302", "one bar stands 4 mm off its place", "fail", "pass", change=_bar_off),
        Case("C-303", "goes on by minimax, not by least squares", "pass", "pass", change=_only_minimax),
        Case("C-304", "one sleeve is plugged", "not_measured", "not_measured", change=_plugged),
        Case("C-305", "lies turned by 90 degrees under the camera", "pass", "pass", up="-x"),
        Case("C-306", "the scan file of its bars is cut off", "error", "not_assessed", truncated=True),
        Case("C-307", "bars lean apart: it does not go on", "fail", "fail", change=_apart),
        Case("C-308", "checked in the yard, before its bars exist", "pass", "not_assessed", with_bars=False),
    )


def make_floor(folder: Path, seed: int = 2026) -> Iterator[str]:
    """Write scans, ``truth.json`` and ``job.toml`` of the sample floor into a folder that holds its model.

    Yields a line of progress for each column.
    """
    (folder / "scans").mkdir(parents=True, exist_ok=True)
    cases = sample_cases()
    truth = {}
    for number, case in enumerate(cases):
        truth[case.id] = _make_column(folder, case, np.random.default_rng([seed, number]))
        yield f"{case.id}: {case.story}"
    text = {"synthetic": True, "seed": seed, "columns": truth}
    write_atomically(folder / "truth.json", (json.dumps(text, indent=1) + "\n").encode())
    write_atomically(folder / "job.toml", job_text(cases).encode())


def _make_column(folder: Path, case: Case, rng: np.random.Generator) -> dict[str, object]:
    foot, bars = case.change(calm_foot(FIELD, rng), calm_bars(FIELD, rng))
    noise = replace(CameraNoise.drawn(rng), scale=5e-5)
    scans = {"sleeves": scan_of(foot, up_pose(case.up, True, rng), noise, rng)}
    files = {"sleeves": folder / "scans" / f"{case.id}-foot.tiff"}
    if case.with_bars:
        scans["rebars"] = scan_of(bars, up_pose(case.up, False, rng), noise, rng)
        files["rebars"] = folder / "scans" / f"{case.id}-bars.tiff"
    for name, scan in scans.items():
        write_depth_tiff(files[name], scan.depth, DEPTH_SCALE_MM)
    if case.truncated:
        content = files["rebars"].read_bytes()
        write_atomically(files["rebars"], content[: len(content) // 2])
    return {
        "story": case.story,
        **_verdicts(case, foot, bars),
        **{name: listed(scan, foot) for name, scan in scans.items()},
    }


def _verdicts(case: Case, foot: Foot, bars: BarGroup) -> dict[str, object]:
    """The verdicts that follow from the exact centres; the case must be what its story says."""
    true = true_verdicts(sample_design(FIELD), foot, bars if case.with_bars else None)
    verdict, goes_on = (Verdict.ERROR, Verdict.NOT_ASSESSED) if case.truncated else (true.verdict, true.goes_on)
    if (verdict, goes_on) != (case.verdict, case.goes_on):
        raise AadmError.because("command.twin_case", id=case.id, story=case.story, verdict=verdict, goes_on=goes_on)
    return {
        "verdict": verdict.value,
        "goes_on": goes_on.value,
        "least_squares": true.least_squares,
        "minimax": true.minimax,
    }


def up_pose(up: str, looking_up: bool, rng: np.random.Generator) -> Array:
    """T_column_scan (4, 4) of a camera that is held over bars, or under a foot, with one side at the top."""
    forward = np.array([0.0, 0.0, 1.0 if looking_up else -1.0])
    target = np.array([*rng.uniform(-12.0, 12.0, 2), 0.0])
    tilt = tuple(np.radians(rng.uniform(-3.0, 3.0, 2)))
    roll = np.radians(rng.uniform(-2.0, 2.0))
    return facing(target, forward, np.array([*_UPS[up], 0.0]), FIELD.distance, (tilt[0], tilt[1]), roll)


def calm_foot(setting: Setting, rng: np.random.Generator) -> Foot:
    """A foot whose sleeves stay within 0.8 mm of their places."""
    foot = random_foot(setting, rng, 0.35)
    calm = [
        replace(s, x=_near(s.x, p[0]), y=_near(s.y, p[1])) for s, p in zip(foot.sleeves, setting.centres(), strict=True)
    ]
    return replace(foot, sleeves=tuple(calm))


def calm_bars(setting: Setting, rng: np.random.Generator) -> BarGroup:
    """Bars that stay within 0.8 mm of their places."""
    group = random_bars(setting, rng, 0.35)
    calm = [
        replace(b, x=_near(b.x, p[0]), y=_near(b.y, p[1])) for b, p in zip(group.bars, setting.centres(), strict=True)
    ]
    return replace(group, bars=tuple(calm))


def _near(value: float, place: float) -> float:
    return float(np.clip(value, place - _BOUND_MM / np.sqrt(2), place + _BOUND_MM / np.sqrt(2)))


def _moved_bar(bars: BarGroup, number: int, dx: float, dy: float) -> BarGroup:
    place = FIELD.centres()[number - 1]
    changed = [
        replace(bar, x=place[0] + dx, y=place[1] + dy) if k == number - 1 else bar for k, bar in enumerate(bars.bars)
    ]
    return replace(bars, bars=tuple(changed))


def _bar_off(foot: Foot, bars: BarGroup) -> tuple[Foot, BarGroup]:
    return foot, _moved_bar(bars, 5, 2.9, 2.9)


def _only_minimax(foot: Foot, bars: BarGroup) -> tuple[Foot, BarGroup]:
    """S1 and R1 lie apart by 3.8 mm, each within its own 2 mm; the others hardly differ."""
    places = FIELD.centres()
    sleeves = [
        replace(s, x=p[0] + 0.25 * (s.x - p[0]), y=p[1] + 0.25 * (s.y - p[1]))
        for s, p in zip(foot.sleeves, places, strict=True)
    ]
    calm = [
        replace(b, x=p[0] + 0.25 * (b.x - p[0]), y=p[1] + 0.25 * (b.y - p[1]))
        for b, p in zip(bars.bars, places, strict=True)
    ]
    apart = 1.9 / np.sqrt(2)
    sleeves[0] = replace(sleeves[0], x=places[0, 0] - apart, y=places[0, 1] - apart)
    moved = _moved_bar(replace(bars, bars=tuple(calm)), 1, apart, apart)
    return replace(foot, sleeves=tuple(sleeves)), moved


def _plugged(foot: Foot, bars: BarGroup) -> tuple[Foot, BarGroup]:
    sleeves = [replace(s, plugged_at=0.0) if k == 6 else s for k, s in enumerate(foot.sleeves)]
    return replace(foot, sleeves=tuple(sleeves)), bars


def _apart(foot: Foot, bars: BarGroup) -> tuple[Foot, BarGroup]:
    """Opposite corners pushed apart along the diagonal: no pose brings both under 3 mm."""
    push = 4.6 / np.sqrt(2)
    return foot, _moved_bar(_moved_bar(bars, 1, -push, -push), 7, push, push)


def job_text(cases: tuple[Case, ...]) -> str:
    """The job file of the sample floor."""
    head = f"""# Sample floor: synthetic scans of a virtual camera, see ../README.md
schema = 1
name = "Sample floor 3"
units = "mm"
tolerances = "cn"
decision = "guarded"

[model]
path = "floor3.ifc"

{CAPTURE_TABLES}"""
    return head + "".join(_column_text(case) for case in cases)


def _column_text(case: Case) -> str:
    lines = ["", f"[[columns]]  # {case.story}", f'id = "{case.id}"', f'sleeves = "scans/{case.id}-foot.tiff"']
    if case.with_bars:
        lines.append(f'rebars = "scans/{case.id}-bars.tiff"')
    return "\n".join([*lines, f'up = "{case.up}"', ""])
