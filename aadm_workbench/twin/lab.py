"""The laboratory model of the paper as samples: designs inline in the job, scans as clouds in PLY and PCD."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from aadm_workbench.model import Array, FloatArray
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.write import write_pcd, write_ply
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot, random_pose
from aadm_workbench.twin.truth import listed, sample_design, true_verdicts

_SPREAD_MM = 0.3  # per axis: printed parts, well within 2 mm
_BAR_ZONE_MM = 125.0  # bars are cut out of their scan this far from the middle: the floor around is of no use


def make_lab(folder: Path, seed: int = 2026) -> Iterator[str]:
    """Write clouds, ``truth.json`` and ``job.toml`` of two laboratory columns. Yields a line for each."""
    (folder / "scans").mkdir(parents=True, exist_ok=True)
    truth = {}
    for number, (column, foot_format, bar_format) in enumerate((("L-1", "ply", "pcd"), ("L-2", "pcd", "ply"))):
        rng = np.random.default_rng([seed, number])
        foot, bars, noise = random_foot(LAB, rng, _SPREAD_MM), random_bars(LAB, rng, _SPREAD_MM), CameraNoise.drawn(rng)
        sleeves = scan_of(foot, random_pose(LAB, True, rng), noise, rng)
        rebars = scan_of(bars, random_pose(LAB, False, rng), noise, rng)
        _write(folder / "scans" / f"{column}-foot.{foot_format}", _finite(sleeves.scan().points))
        _write(folder / "scans" / f"{column}-bars.{bar_format}", _bar_zone(rebars, with_floor=number == 0))
        true = true_verdicts(sample_design(LAB), foot, bars)
        truth[column] = {
            "verdict": true.verdict.value,
            "goes_on": true.goes_on.value,
            "least_squares": true.least_squares,
            "minimax": true.minimax,
            "sleeves": listed(sleeves, foot),
            "rebars": listed(rebars, foot),
        }
        yield f"{column}: laboratory model, 250 mm foot"
    text = {"synthetic": True, "seed": seed, "columns": truth}
    write_atomically(folder / "truth.json", (json.dumps(text, indent=1) + "\n").encode())
    write_atomically(folder / "job.toml", _job_text().encode())


def _write(path: Path, points: FloatArray) -> None:
    if path.suffix == ".ply":
        write_ply(path, points)
    else:
        write_pcd(path, points, mode="binary_compressed")


def _finite(points: FloatArray) -> FloatArray:
    finite: FloatArray = points[np.isfinite(points[..., 2])]
    return finite


def _bar_zone(scan: TrueScan, *, with_floor: bool) -> FloatArray:
    points = _finite(scan.scan().points)
    column: Array = points @ scan.T_column_scan[:3, :3].T + scan.T_column_scan[:3, 3]
    kept = np.abs(column[:, :2]).max(axis=1) < _BAR_ZONE_MM
    if not with_floor:
        kept &= column[:, 2] > -60.0  # as a camera whose depth range ends above the floor
    zone: FloatArray = points[kept]
    return zone


def _job_text() -> str:
    centres = ", ".join(f"[{x:.1f}, {y:.1f}]" for x, y in LAB.centres())
    head = """# Laboratory model of the paper: synthetic clouds of a virtual camera, see ../README.md
schema = 1
name = "Laboratory model"
units = "mm"
tolerances = "cn"
"""
    return head + "".join(_column_text(*names, centres) for names in (("L-1", "ply", "pcd"), ("L-2", "pcd", "ply")))


def _column_text(column: str, foot_format: str, bar_format: str, centres: str) -> str:
    return f"""
[[columns]]
id = "{column}"
sleeves = "scans/{column}-foot.{foot_format}"
rebars = "scans/{column}-bars.{bar_format}"
up = "+y"
[columns.design]
sleeve_diameter = {LAB.sleeve_diameter}
rebar_diameter = {LAB.bar_diameter}
rebar_outer_diameter = 20.0
embedded_length = 100.0
size = [{LAB.size}, {LAB.size}]
centres = [{centres}]
"""
