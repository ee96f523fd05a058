"""What the play brings, and whether predictions hold: 200 towers of ten storeys, and a storey of simulated scans.

    python -m benchmarks.towers [--towers 200] [--storeys 10] [--seed 27] [--json FILE]
    python -m benchmarks.towers --storey DIR      (of aadm simulate tower, checked by aadm check DIR/job.toml)

Towers: every storey has sleeves and bars with errors of their own; the column is set as the trial has it, or in the
pose of its play that leads back to the grid, each time not quite there and not quite plumb. Where its top comes to, and
with it the bars of the next storey, is calculated by rotations of scipy, not by what is judged.

Storey: the columns of a simulated storey are let down by the pairs of their trials, with the errors that were drawn for
them beforehand; counted is how many tops and turns lie in their stated regions.
"""

from __future__ import annotations

import argparse
import json
import platform
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from aadm_workbench.assembly.decision import standard_uncertainty
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.best_pose import BestFit, fit_best_pose
from aadm_workbench.assembly.pose.play import Gap
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.model import Array, StackSettings, Verdict
from aadm_workbench.report.read import read_report
from aadm_workbench.stack.limits import Limits
from aadm_workbench.stack.measured import Ground, MeasuredColumn, MeasuredPair, measured_floor
from aadm_workbench.stack.tower import Tower
from aadm_workbench.twin.parts import ring
from batch.job.file import read_job

CENTRES = ring(240.0, 240.0, 4)
RADIUS_MM = float(np.sqrt((CENTRES**2).sum(axis=1).mean()))
HEIGHT_MM = 3600.0
LIMIT_MM, ROOM_MM, AXIS_MM = 3.0, 6.25, 8.0  # of a pair; sleeve 36 over a bar of 23.5; of a column's axis
BUILT_MM, POINT_U_MM, SURVEY_U_MM = (
    0.5,
    0.08,
    0.5,
)  # of single sleeves and bars; of their measurement; of control points
SETTINGS = {
    "as [stack] has it": StackSettings(height_mm=HEIGHT_MM),
    "a careful crew": StackSettings(plumb_u_mm=1.2, fit_u_mm=0.5, bars_u_mm=0.6, height_mm=HEIGHT_MM),
}
"""Scatter of what setting adds: the defaults, mostly halves of limits, and a crew that works better than its limits."""


def pairs_of(sleeves: Array, bars: Array) -> list[Pair]:
    """Measured pairs, upright, of sleeves (n, 2) and bars (n, 2) mm, each as its own fit to the design has it."""
    still = np.zeros(2)
    return [
        Pair(f"S{k}", f"R{k}", sleeve, bar, still, still, ROOM_MM, 2.0 * POINT_U_MM**2 * np.eye(2))
        for k, (sleeve, bar) in enumerate(zip(sleeves, bars, strict=True), start=1)
    ]


def fitted(points: Array) -> tuple[Array, Array, Array]:
    """Points (n, 2) as their least squares fit to the design has them, and the motion that takes them back there.

    That motion is a matrix (2, 2) and a shift (2,) mm: Kabsch, by scipy.
    """
    flat = [np.column_stack([xy - xy.mean(axis=0), np.zeros(len(xy))]) for xy in (points, CENTRES)]
    turn = Rotation.align_vectors(*flat)[0].as_matrix()[:2, :2]
    shift = points.mean(axis=0) - turn @ CENTRES.mean(axis=0)
    return (points - shift) @ turn, turn, shift


def column_of(sleeves: Array, bars: Array, fit: BestFit, ground: Array, u_mm: float) -> MeasuredColumn:
    """What a report would tell of such a column; ``ground`` (3,) dx, dy mm, yaw radians of its bars off the grid."""
    cosine, sine = np.cos(fit.yaw), np.sin(fit.yaw)
    T = np.eye(4)
    T[:2, :2], T[:2, 3] = [[cosine, -sine], [sine, cosine]], fit.shift
    offsets = bars @ T[:2, :2].T + fit.shift - sleeves
    point_u_mm = float(np.sqrt(2.0)) * POINT_U_MM
    pairs = tuple(
        MeasuredPair(f"S{k}", f"R{k}", s, o, point_u_mm, (Gap(o, LIMIT_MM, point_u_mm), Gap(o, ROOM_MM, point_u_mm)))
        for k, (s, o) in enumerate(zip(sleeves, offsets, strict=True), start=1)
    )
    covariance = np.diag(np.square([u_mm, u_mm, u_mm / RADIUS_MM]))
    return MeasuredColumn(
        "C",
        None,
        None,
        None,
        (600.0, 600.0),
        np.eye(4),
        Verdict.PASS,
        Verdict.PASS,
        "",
        pairs,
        np.linalg.inv(T),
        ground=Ground(ground, covariance),
        radius_mm=RADIUS_MM,
    )


def build_tower(storeys: int, settings: StackSettings, rng: np.random.Generator, *, plays: bool) -> list[float]:
    """How far off the grid the top of each storey comes, mm; where no pose exists the tower ends."""
    limits = Limits(load_profile("cn-gbt51231-2016"), "guarded")
    tower = Tower(settings, limits, {})
    place, turn, tops = np.zeros(2), 0.0, []
    for _ in range(storeys):
        body = Rotation.from_euler("z", turn).as_matrix()[:2, :2]
        true_bars = (CENTRES + rng.normal(0.0, BUILT_MM, CENTRES.shape)) @ body.T + place
        true_sleeves = CENTRES + rng.normal(0.0, BUILT_MM, CENTRES.shape)
        seen = [points + rng.normal(0.0, POINT_U_MM, CENTRES.shape) for points in (true_sleeves, true_bars)]
        (sleeves, *_), (bars, group, shift) = fitted(seen[0]), fitted(seen[1])
        fit = fit_best_pose(pairs_of(sleeves, bars), np.full(len(CENTRES), LIMIT_MM))
        if not isinstance(fit, BestFit) or not fit.exists:
            return tops
        error = rng.normal(0.0, SURVEY_U_MM, 2)
        ground = np.array([*(shift + error), np.arctan2(group[1, 0], group[0, 0])])
        (stacked,) = tower.stacked([column_of(sleeves, bars, fit, ground, SURVEY_U_MM)])
        moved = np.array(stacked.advice.from_trial) if plays and stacked.advice is not None else np.zeros(3)
        told = told_offsets(stacked.measured, moved)
        place, turn, top = let_down(true_sleeves, true_bars, told, settings, rng)
        tops.append(float(np.hypot(*top)))
    return tops


def told_offsets(column: MeasuredColumn, moved: Array) -> Array:
    """Bar minus sleeve (n, 2) mm that the crew is told, the column displaced by dx, dy mm and yaw degrees."""
    places = np.array([pair.place for pair in column.pairs])
    bars = places + np.array([pair.offset for pair in column.pairs])
    turn = Rotation.from_euler("z", moved[2], degrees=True).as_matrix()[:2, :2]
    return (bars - moved[:2]) @ turn - places


def let_down(
    sleeves: Array, bars: Array, told: Array, settings: StackSettings, rng: np.random.Generator
) -> tuple[Array, float, Array]:
    """Where the bars of the next storey stand (2,) mm and how they are turned, and where the top is (2,) mm."""
    flat = [np.column_stack([xy - xy.mean(axis=0), np.zeros(len(xy))]) for xy in (bars, sleeves + told)]
    body = Rotation.align_vectors(*flat)[0]
    yaw = rng.normal(0.0, settings.fit_u_mm / RADIUS_MM)
    turned = Rotation.from_euler("z", yaw) * body
    shift = bars.mean(axis=0) - body.apply([*(sleeves + told).mean(axis=0), 0.0])[:2]
    shift = shift + rng.normal(0.0, settings.fit_u_mm, 2)
    top = shift + rng.normal(0.0, settings.plumb_at(HEIGHT_MM), 2)
    angle = float(turned.as_rotvec()[2]) + rng.normal(0.0, settings.bars_u_mm / RADIUS_MM)
    return top + rng.normal(0.0, settings.bars_u_mm, 2), angle, top


def towers(number: int, storeys: int, seed: int) -> list[dict[str, Any]]:
    """Both ways of setting, each with the same draws, by the scatter of the crew."""
    rows = []
    for crew, settings in SETTINGS.items():
        for way, plays in (("as the trial has it", False), ("using the play", True)):
            built = [
                build_tower(storeys, settings, np.random.default_rng([seed, k]), plays=plays) for k in range(number)
            ]
            whole = [tops for tops in built if len(tops) == storeys]
            last = np.array([tops[-1] for tops in whole])
            worst = np.array([max(tops) for tops in whole])
            rows.append(
                {
                    "crew": crew,
                    "set": way,
                    "towers": len(whole),
                    "broken_off": number - len(whole),
                    "median_mm": float(np.median(last)),
                    "beyond": float(np.mean(last > AXIS_MM)),
                    "worst_median_mm": float(np.median(worst)),
                    "any_beyond": float(np.mean(worst > AXIS_MM)),
                }
            )
    return rows


def storey(folder: Path) -> dict[str, Any]:
    """How many tops and turns of a simulated storey lie in their regions of 95 %."""
    truth = json.loads((folder / "truth.json").read_text(encoding="utf-8"))
    settings = read_job(folder / "job.toml").stack or StackSettings()
    measured = measured_floor(read_report(folder / "job-report" / "report.json"))
    stacked = Tower(settings, Limits(load_profile("cn-gbt51231-2016"), "guarded"), {}).stacked(measured.columns)
    known = [one for one in stacked if one.placed is not None and one.basis == "control_points"]
    misses = np.array([miss(one, truth["columns"][one.measured.id], truth["height_mm"]) for one in known])
    return {
        "columns": len(stacked),
        "predicted": len(known),
        "tops_inside": float(np.mean(misses[:, 0] <= chi2.ppf(0.95, 2))),
        "turns_inside": float(np.mean(misses[:, 1] <= chi2.ppf(0.95, 1))),
        "top_miss_mm": float(np.sqrt(np.mean(misses[:, 2] ** 2) / 2.0)),
        "top_u_mm": float(
            np.mean(
                [
                    standard_uncertainty(one.placed.at(np.array([0, 0, truth["height_mm"]]))[1][:2, :2])
                    for one in known
                    if one.placed is not None
                ]
            )
        ),
    }


def miss(stacked: Any, true: dict[str, Any], height_mm: float) -> tuple[float, float, float]:
    """Squared distance of the true top and of the true turn, in units of their covariance, and the former in mm."""
    pairs = {pair.sleeve: pair for pair in stacked.measured.pairs}
    points = {
        kind: {p["label"]: np.array(p["column_mm"][:2]) for p in true[kind]["points"]} for kind in ("sleeves", "rebars")
    }
    ground, fit = true["ground"], true["fit"]
    turn = Rotation.from_euler("z", ground["yaw_deg"], degrees=True)
    labels = sorted(pairs)
    sleeves = np.array([points["sleeves"][label] for label in labels])
    bars = np.array([points["rebars"][pairs[label].rebar] for label in labels])
    told = np.array([pairs[label].offset for label in labels])
    flat = [np.column_stack([xy - xy.mean(axis=0), np.zeros(len(xy))]) for xy in (bars, sleeves + told)]
    body = Rotation.align_vectors(*flat)[0]
    shift = bars.mean(axis=0) - body.apply([*(sleeves + told).mean(axis=0), 0.0])[:2]
    added = np.array([ground["dx_mm"] + fit["dx_mm"], ground["dy_mm"] + fit["dy_mm"]])
    shift = turn.apply([*shift, 0.0])[:2] + added
    top = shift + np.array(true["lean_mm"])
    angle = float((turn * body).as_rotvec()[2]) + np.radians(fit["yaw_deg"])
    offset, covariance = stacked.placed.at(np.array([0.0, 0.0, height_mm]))
    off = top - offset[:2]
    turned = (angle - stacked.placed.values[5]) ** 2 / stacked.placed.covariance[5, 5]
    return float(off @ np.linalg.inv(covariance[:2, :2]) @ off), float(turned), float(np.hypot(*off))


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the machine, what was drawn, and the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--towers", type=int, default=200)
    parser.add_argument("--storeys", type=int, default=10)
    parser.add_argument("--seed", type=int, default=27)
    parser.add_argument("--storey", type=Path, metavar="DIR")
    parser.add_argument("--json", type=Path, metavar="FILE")
    options = parser.parse_args(arguments)
    print(f"{platform.processor() or platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}")
    if options.storey is not None:
        found: Any = storey(options.storey)
        print(json.dumps(found, indent=1))
    else:
        found = towers(options.towers, options.storeys, options.seed)
        print(
            f"{options.towers} towers of {options.storeys} storeys, seed {options.seed}: "
            "how far the top of the last one is off the grid"
        )
        for row in found:
            print(
                f"{row['crew']:18} {row['set']:20} median {row['median_mm']:5.2f} mm, beyond {AXIS_MM:g} mm "
                f"{100.0 * row['beyond']:5.1f} %; any storey beyond {100.0 * row['any_beyond']:5.1f} %; "
                f"{row['broken_off']} broken off"
            )
    if options.json is not None:
        options.json.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
