"""A column foot and the bars that it comes down on: two scans, their truth, and a job that checks them.

The virtual cameras by name: what is done with a part and a pose until there is a scan.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from aadm_workbench.design.recognise.pattern import inline_design, label_order
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Json
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.write import write_depth_tiff, write_pcd, write_ply
from aadm_workbench.twin.camera import DEPTH_SCALE_MM, PRO_M, capture_tables
from aadm_workbench.twin.filters import NO_FILTERS, Filters, filtered
from aadm_workbench.twin.finite_pixel import FinitePixel
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Foot, PlateAsBuilt
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_bars, random_foot, random_pose
from aadm_workbench.twin.site import left_by_site
from aadm_workbench.twin.slips import NO_SLIP, Slip, seen_with, told_camera
from aadm_workbench.twin.truth import DECIMALS, section_truth, true_verdicts

Shoot: TypeAlias = Callable[[Foot | BarGroup | PlateAsBuilt, Array, np.random.Generator], TrueScan]
"""From a part, the pose T_column_scan (4, 4) and a generator to a scan with its truth."""


def _write_tiff(path: Path, scan: TrueScan) -> None:
    write_depth_tiff(path, scan.depth, DEPTH_SCALE_MM)


def _write_ply(path: Path, scan: TrueScan) -> None:
    write_ply(path, scan.scan().points)


def _write_pcd(path: Path, scan: TrueScan) -> None:
    write_pcd(path, scan.scan().points, "binary")


FORMATS: Mapping[str, Callable[[Path, TrueScan], None]] = MappingProxyType(
    {"tiff": _write_tiff, "ply": _write_ply, "pcd": _write_pcd}
)
SETTINGS: Mapping[str, Setting] = MappingProxyType({setting.name: setting for setting in (LAB, FIELD)})


@dataclass(frozen=True)
class Taken:
    """How a pair is scanned: a camera of :data:`~aadm_workbench.twin.cameras.CAMERAS` and its filters.

    ``words`` are what the command line says of it all, for the job's first line. ``site`` names what was done to foot
    and bars, ``slip`` what is wrong with the scans and with what the job says of them.
    """

    camera: str = "ray"
    filters: Filters = NO_FILTERS
    words: str = ""
    site: tuple[str, ...] = ()
    slip: Slip = NO_SLIP


@dataclass(frozen=True, eq=False)
class Pair:
    """A foot and its bars as built, each with its scan; parts are in the order of the design's labels."""

    setting: Setting
    design: ColumnDesign
    foot: Foot
    bars: BarGroup
    sleeves: TrueScan
    rebars: TrueScan


def make_pair(folder: Path, setting: Setting, seed: int, scan_format: str, taken: Taken | None = None) -> Pair:
    """Write ``foot`` and ``bars`` in a format, ``truth.json`` and ``job.toml`` into a folder that exists.

    Parameters
    ----------
    seed
        The same seed gives the same files.
    scan_format
        One of :data:`FORMATS`.
    taken
        With which camera and filters; None is the ray caster as accuracy targets refer to it.

    Raises
    ------
    MissingDependencyError
        Where the ray caster, or the renderer, is not installed.
    """
    taken = taken or Taken()
    pair = simulated_pair(setting, np.random.default_rng(seed), taken)
    write = FORMATS[scan_format]
    write(folder / f"foot.{scan_format}", pair.sleeves)
    write(folder / f"bars.{scan_format}", pair.rebars)
    write_atomically(folder / "truth.json", (json.dumps(_truth(pair, seed), indent=1) + "\n").encode())
    write_atomically(folder / "job.toml", _job_text(setting, seed, scan_format, taken).encode())
    return pair


def simulated_pair(setting: Setting, rng: np.random.Generator, taken: Taken | None = None) -> Pair:
    """A random foot and random bars of a setting, seen by one camera, the image's top towards +y."""
    order = label_order(setting.centres())
    foot, bars = random_foot(setting, rng), random_bars(setting, rng)
    foot = replace(foot, sleeves=tuple(foot.sleeves[k] for k in order))
    bars = replace(bars, bars=tuple(bars.bars[k] for k in order))
    taken = taken or Taken()
    foot, bars = left_by_site(taken.site, foot, bars, rng)
    noise = CameraNoise.drawn(rng)
    shoot = with_filters(CAMERAS[taken.camera](setting.distance, noise), taken.filters)
    sleeves = shoot(foot, random_pose(setting, True, rng), rng)
    rebars = shoot(bars, random_pose(setting, False, rng), rng)
    sleeves, rebars = seen_with(sleeves, taken.slip, rng, is_foot=True), seen_with(rebars, taken.slip, rng)
    return Pair(setting, inline_design(_column_id(setting), design_table(setting)), foot, bars, sleeves, rebars)


def _column_id(setting: Setting) -> str:
    return f"{setting.name}-1"


def design_table(setting: Setting) -> dict[str, float | list[float] | list[list[float]]]:
    """What ``[columns.design]`` of the job says."""
    return {
        "sleeve_diameter": setting.sleeve_diameter,
        "rebar_diameter": setting.bar_diameter,
        "rebar_outer_diameter": round(setting.bar_core + 2.0 * BarAsBuilt.rib_height, DECIMALS),
        "embedded_length": setting.exposed,
        "size": [setting.size, setting.size],
        "centres": setting.centres().tolist(),
    }


def _truth(pair: Pair, seed: int) -> dict[str, object]:
    true = true_verdicts(pair.design, pair.foot, pair.bars)
    column = {
        "verdict": true.verdict.value,
        "goes_on": true.goes_on.value,
        "least_squares": true.least_squares,
        "minimax": true.minimax,
        "sleeves": scan_truth(pair.sleeves, pair.design.sleeves),
        "rebars": scan_truth(pair.rebars, pair.design.rebars),
        "section": section_truth(pair.design, pair.foot),
    }
    return {"synthetic": True, "seed": seed, "setting": pair.setting.name, "columns": {pair.design.id: column}}


def scan_truth(scan: TrueScan, design: tuple[AssemblyPoint, ...]) -> dict[str, Json]:
    """True centres of one scan, mm, in the column frame that it was made in and in the scan frame."""
    points = zip(scan.points, design, scan.points_scan(), strict=True)
    return {
        "T_column_scan": np.round(scan.T_column_scan, 9).tolist(),
        "points": [
            {
                "label": point.label,
                "design_mm": np.round(target.centre, DECIMALS).tolist(),
                "column_mm": np.round(point.centre, DECIMALS).tolist(),
                "scan_mm": np.round(in_scan, DECIMALS).tolist(),
                "axis": np.round(point.axis, 9).tolist(),
                "diameter_mm": round(float(point.diameter_mm), DECIMALS),
            }
            for point, target, in_scan in points
        ],
    }


def _job_text(setting: Setting, seed: int, scan_format: str, taken: Taken) -> str:
    slip, made_with = taken.slip, taken.words
    foot, bars = ("bars", "foot") if slip.swapped else ("bars" if slip.twice else "foot", "bars")
    design = "".join(f"{key} = {value}\n" for key, value in design_table(setting).items())
    command = f"aadm simulate pair --setting {setting.name} --seed {seed}{made_with}"
    return f"""# Synthetic scans of a virtual camera: {command}
schema = 1
name = "Simulated pair, {setting.name} setting"
units = "{slip.unit}"
tolerances = "cn"

{capture_tables(told_camera(PRO_M, slip), DEPTH_SCALE_MM * slip.lengths)}
[[columns]]
id = "{_column_id(setting)}"
sleeves = "{foot}.{scan_format}"
rebars = "{bars}.{scan_format}"
up = "{"-y" if slip.up_deg else "+y"}"

[columns.design]
{design}"""


def ray_camera(noise: CameraNoise) -> Shoot:
    """The ray caster with a law of noise."""
    return lambda part, pose, rng: scan_of(part, pose, noise, rng)


def fringe_camera(distance: float) -> Shoot:
    """Fringe projection, path-traced; its lenses are set for a distance in mm.

    Raises
    ------
    MissingDependencyError
        Where Mitsuba, or the LLVM that it compiles with, is not installed.
    """
    from aadm_workbench.twin.fringe.renderer import mitsuba_ready
    from aadm_workbench.twin.fringe.rig import rig_for
    from aadm_workbench.twin.fringe.shot import FringeCamera, fringe_scan_of

    mitsuba_ready()
    fringe = FringeCamera(rig_for(distance))
    return lambda part, pose, rng: fringe_scan_of(part, pose, fringe, rng)


def with_filters(shoot: Shoot, filters: Filters) -> Shoot:
    """A camera that filters its depth maps."""

    def shot(part: Foot | BarGroup | PlateAsBuilt, pose: Array, rng: np.random.Generator) -> TrueScan:
        scan = shoot(part, pose, rng)
        return replace(scan, depth=filtered(scan.depth, filters, scan.brightness))

    return shot


def pixel_camera(noise: CameraNoise) -> Shoot:
    """The ray caster, its pixels with a size: it loses and mixes at edges what they see, and nothing by chance."""
    return ray_camera(replace(noise, pixel=FinitePixel(), step_loss=0.0, step_fly=0.0))


CAMERAS: Mapping[str, Callable[[float, CameraNoise], Shoot]] = MappingProxyType(
    {
        "ray": lambda _distance, noise: ray_camera(noise),
        "pixel": lambda _distance, noise: pixel_camera(noise),
        "fringe": lambda distance, _noise: fringe_camera(distance),
    }
)
"""Cameras from a name, by the distance in mm that they are set for and the ray caster's law of noise."""
