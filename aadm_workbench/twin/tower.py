"""A storey of columns that are set with known errors: scans, control points, job and truth.

Each column has bars that stand off the grid as a group, a foot and bars with errors of their own, and control points
around it. What setting will add (how near to its aim it is let down, how it leans, how high its foot comes) is drawn
beforehand and written into ``truth.json``: where the column comes to stand follows from that and from the pose that the
crew is told.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from aadm_workbench.model import Array
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.camera import CAPTURE_TABLES, DEPTH_SCALE_MM
from aadm_workbench.twin.pair import Pair, design_table, scan_truth, simulated_pair
from aadm_workbench.twin.scenes import FIELD

HEIGHT_MM = 3600.0
"""From foot to top."""
_GROUND_MM, _GROUND_DEG = 3.0, 0.1  # spread of bar groups about their place: half of what the axis may be off
_CONTROL_U_MM = 0.4  # of a control point, per axis: a total station on a target, and its centre in the scan
_CONTROL_REACH_MM = 420.0  # of control points from the axis: within the picture, clear of the bars
_SETTING = {"plumb_u_mm": 1.5, "fit_u_mm": 0.8, "bars_u_mm": 0.6, "level_u_mm": 1.0}
"""Spreads of what setting adds: a crew that works a little better than its limits. In the job's [stack], too."""
_DECIMALS = 5  # of lengths and degrees in the files: finer than anything they are compared with


def make_tower(folder: Path, seed: int = 2026, columns: int = 8) -> Iterator[str]:
    """Write scans, ``truth.json`` and ``job.toml`` into a folder; yields a line of progress for each column.

    Raises
    ------
    MissingDependencyError
        Where the ray caster is not installed.
    """
    (folder / "scans").mkdir(parents=True, exist_ok=True)
    truth: dict[str, object] = {}
    tables = [_head(seed, columns)]
    for number in range(1, columns + 1):
        name, rng = f"T-{number}", np.random.default_rng([seed, number])
        pair = simulated_pair(FIELD, rng)
        ground = np.array([*rng.normal(0.0, _GROUND_MM, 2), rng.normal(0.0, _GROUND_DEG)])
        for kind, scan in (("foot", pair.sleeves), ("bars", pair.rebars)):
            write_depth_tiff(folder / "scans" / f"{name}-{kind}.tiff", scan.depth, DEPTH_SCALE_MM)
        tables.append(_column_text(name, pair, ground, rng))
        truth[name] = _truth(pair, ground, rng)
        yield f"{name}: bars {np.hypot(*ground[:2]):.1f} mm off the grid, turned by {ground[2]:+.2f}°"
    text = {"synthetic": True, "seed": seed, "height_mm": HEIGHT_MM, "columns": truth}
    write_atomically(folder / "truth.json", (json.dumps(text, indent=1) + "\n").encode())
    write_atomically(folder / "job.toml", "".join(tables).encode())


def _truth(pair: Pair, ground: Array, rng: np.random.Generator) -> dict[str, object]:
    """Where things are, and what setting will add: mm and degrees, column frame."""
    radius_mm = float(np.sqrt((FIELD.centres() ** 2).sum(axis=1).mean()))
    fit_mm = _SETTING["fit_u_mm"]
    return {
        "ground": _named(ground),
        "fit": _named(np.array([*rng.normal(0.0, fit_mm, 2), math.degrees(rng.normal(0.0, fit_mm / radius_mm))])),
        "lean_mm": np.round(rng.normal(0.0, _SETTING["plumb_u_mm"], 2), _DECIMALS).tolist(),
        "level_mm": round(float(rng.normal(0.0, _SETTING["level_u_mm"])), _DECIMALS),
        "sleeves": scan_truth(pair.sleeves, pair.design.sleeves),
        "rebars": scan_truth(pair.rebars, pair.design.rebars),
    }


def _named(planar: Array) -> dict[str, float]:
    return dict(zip(("dx_mm", "dy_mm", "yaw_deg"), np.round(planar, _DECIMALS).tolist(), strict=True))


def _head(seed: int, columns: int) -> str:
    stack = "".join(f"{key} = {value}\n" for key, value in (_SETTING | {"height_mm": HEIGHT_MM}).items())
    return f"""# Synthetic scans of a virtual camera: aadm simulate tower --columns {columns} --seed {seed}
schema = 1
name = "Simulated storey"
units = "mm"
tolerances = "cn"

{CAPTURE_TABLES}
[stack]
{stack}"""


def _column_text(name: str, pair: Pair, ground: Array, rng: np.random.Generator) -> str:
    """One column of the job: its scans, its design and its control points, each known and seen with an error."""
    design = "".join(f"{key} = {value}\n" for key, value in design_table(FIELD).items())
    T_scan_column = np.linalg.inv(pair.rebars.T_column_scan)
    angle = math.radians(ground[2])
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    points = ""
    corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
    for number, corner in enumerate(corners, start=1):
        place = np.array([*(_CONTROL_REACH_MM * np.array(corner)), -FIELD.exposed])
        known = [*(turn @ place[:2] + ground[:2] + rng.normal(0.0, _CONTROL_U_MM, 2)), place[2]]
        seen = T_scan_column[:3, :3] @ place + T_scan_column[:3, 3]
        points += f"""
[[columns.control_points]]
name = "G{number}"
column = {np.round(known, _DECIMALS).tolist()}
scan = {np.round(seen, _DECIMALS).tolist()}
u_mm = {_CONTROL_U_MM}
"""
    return f"""
[[columns]]
id = "{name}"
sleeves = "scans/{name}-foot.tiff"
rebars = "scans/{name}-bars.tiff"
up = "+y"

[columns.design]
{design}{points}"""
