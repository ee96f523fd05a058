"""How far off the edges of a foot are, and how often the truth lies within the 95 % that is stated.

    python -m benchmarks.section [--scenes 20] [--seed 1] [--fringe FOLDER…] [--cost N]

Scenes of the ray-casting camera, whose sections are off by up to 5 mm a side, and scans of a camera whose light is
path-traced, with their truth (``tests/fringe_scans/`` by default). ``--cost``: what the section adds to the check of a
column, in processor time, by so many pairs of checks of one scan, in turns with and without it.
"""

from __future__ import annotations

import argparse
import json
import tomllib
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import process_time

import numpy as np

from aadm_workbench.assembly.section import inspect_section
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.extract.method import extract
from aadm_workbench.extract.sample import thinned
from aadm_workbench.extract.section.outline import SIDES, section_edges
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import Array, Camera, Kind, Reason, Scan
from aadm_workbench.scan.read import read_scan
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.scene import scan_of
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_foot, random_pose
from aadm_workbench.twin.truth import sample_design

_SCANS = Path(__file__).resolve().parents[1] / "tests" / "fringe_scans"
_COVERAGE, _WITHIN_95 = 1.96, 5.991  # of a normal error, and of its square in the plane
_SAMPLE = 30_000


@dataclass
class Edges:
    """Errors, mm, and stated uncertainties of the edges that were measured; how many were not; and of corners.

    Of an edge outwards, with its standard uncertainty; of a corner (n, 2) in the plane, with its covariance.
    """

    errors: list[float] = field(default_factory=list)
    stated: list[float] = field(default_factory=list)
    unseen: int = 0
    corners: list[Array] = field(default_factory=list)
    covariances: list[Array] = field(default_factory=list)

    def add(self, scan: Scan, setting: Setting, bore_mm: float, T_scan_column: Array, true: Array) -> None:
        """The edges of one scan: ``true`` (2,) mm are the sides of its section, about the column's axis."""
        rng = np.random.default_rng(0)
        sleeves = extract(scan, Kind.SLEEVE, bore_mm, "refined", rng)
        corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) / 2.0
        sample = thinned(scan, _SAMPLE, rng)
        found = section_edges(scan, sample, sleeves, T_scan_column, corners * setting.size, [bore_mm])
        for side in SIDES:
            edge = found[side]
            if isinstance(edge, Reason):
                self.unseen += 1
                continue
            # Where it crosses its own axis, as the truth has it.
            run = np.array([1.0, edge.at_mm])
            across_mm = edge.offset_mm + np.tan(edge.turn) * edge.at_mm
            self.errors.append(float(across_mm) - float(true["xy".index(side[1])]) / 2.0)
            self.stated.append(float(np.sqrt(run @ edge.covariance @ run + edge.shared_u_mm**2)))
        report = inspect_section(
            sample_design(setting), found, None, load_profile("cn"), fit_u_mm=0.0, fit_u_turn=0.0, decision="guarded"
        )
        for corner in () if report is None else report.corners:
            place = np.sign(corner.design_mm) * true / 2.0
            self.corners.append(np.array(corner.measured_mm) - place)
            self.covariances.append(np.array(corner.cov_mm2))

    def join(self, other: Edges) -> None:
        """Those of another scan."""
        self.errors += other.errors
        self.stated += other.stated
        self.unseen += other.unseen
        self.corners += other.corners
        self.covariances += other.covariances

    def __str__(self) -> str:
        counted = f"{len(self.errors)} edges, {self.unseen} not measured"
        if not self.errors:
            return counted
        errors, stated = np.abs(self.errors), np.array(self.stated)
        inside = int((errors < _COVERAGE * stated).sum())
        far = f"mean error {errors.mean():.3f}, largest {errors.max():.3f} mm"
        told = f"{counted}: {far}, u {np.median(stated):.3f} mm, {inside} of {len(errors)} inside"
        if not self.corners:
            return told
        off = np.hypot(*np.array(self.corners).T)
        squared = [d @ np.linalg.solve(c, d) for d, c in zip(self.corners, self.covariances, strict=True)]
        within = sum(one < _WITHIN_95 for one in squared)
        return f"{told}; corners {off.mean():.3f}, largest {off.max():.3f} mm, {within} of {len(off)} inside"


def ray_cast(setting: Setting, scenes: int, seed: int) -> Edges:
    """Edges in scenes of the ray-casting camera."""
    edges = Edges()
    for number in range(scenes):
        rng = np.random.default_rng([seed, number])
        foot = random_foot(setting, rng)
        design = np.array(foot.size)
        true = design + rng.uniform(-5.0, 5.0, 2)
        foot = replace(foot, size=(float(true[0]), float(true[1])))
        shot = scan_of(foot, random_pose(setting, True, rng), CameraNoise.drawn(rng), rng)
        to_scan = np.asarray(np.linalg.inv(shot.T_column_scan), np.float64)
        edges.add(shot.scan(), setting, setting.sleeve_diameter, to_scan, true)
    return edges


def path_traced(folder: Path) -> Edges:
    """Edges in one scan whose truth lies beside it."""
    truth = json.loads((folder / "truth.json").read_text(encoding="utf-8"))
    camera = tomllib.loads((folder / "job.toml").read_text(encoding="utf-8"))["camera"]
    step_mm = camera.pop("depth_scale_mm")
    scan = read_scan(folder / "foot.tiff", camera=Camera(**camera), depth_scale_mm=step_mm)
    rotation, eye = np.array(truth["R_foot"]), np.array(truth["eye_foot"])
    places, xy = np.array(truth["sleeves_scan"]), np.array(truth["sleeves"])
    # Of the two conventions that truths are written in, the one that brings the sleeves to their places.
    rotation = min(rotation, rotation.T, key=lambda R: float(np.abs((places @ R.T + eye)[:, :2] - xy).max()))
    T_column_scan = np.eye(4)
    T_column_scan[:3, :3], T_column_scan[:3, 3] = rotation, eye
    setting = {"field": FIELD, "lab": LAB}[truth["kind"]]
    edges = Edges()
    edges.add(scan, setting, truth["D"], np.asarray(np.linalg.inv(T_column_scan), np.float64), np.full(2, setting.size))
    return edges


def cost_ms(setting: Setting, pairs: int, seed: int) -> tuple[float, float]:
    """Processor time of a check of sleeves, and what the section adds to it, ms; medians over pairs."""
    rng = np.random.default_rng(seed)
    foot = random_foot(setting, rng)
    shot = scan_of(foot, random_pose(setting, True, rng), CameraNoise.drawn(rng), rng)
    scans = ColumnScans(sleeves=(shot.scan(),), sleeves_up_deg=90.0)
    settings = CheckSettings(load_profile("cn"))
    design = sample_design(setting)
    designs = replace(design, size_mm=None), design  # without its size a design has no section to look for
    taken: list[list[float]] = []
    for _ in range(pairs + 1):
        spans = []
        for one in designs:
            began = process_time()
            check_column(one, scans, settings)
            spans.append(process_time() - began)
        taken.append(spans)
    without, whole = np.array(taken[1:]).T * 1000.0  # the first pair loads what is loaded once
    return float(np.median(without)), float(np.median(whole - without))


def main() -> None:
    """Run everything and print it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--fringe", type=Path, nargs="*", default=sorted(_SCANS.glob("[ab]-*")))
    parser.add_argument("--cost", type=int, metavar="N")
    options = parser.parse_args()
    if options.cost:
        for name, setting in (("lab", LAB), ("field", FIELD)):
            without, more = cost_ms(setting, options.cost, options.seed)
            print(f"{name}: a check of sleeves takes {without:.0f} ms, the section adds {more:.1f} ms", flush=True)
        return
    for name, setting in (("lab", LAB), ("field", FIELD)):
        print(f"ray-cast, {name}: {ray_cast(setting, options.scenes, options.seed)}", flush=True)
    together = Edges()
    for folder in options.fringe:
        edges = path_traced(folder)
        together.join(edges)
        print(f"path-traced, {folder.name}: {edges}", flush=True)
    if together.errors:
        print(f"path-traced, together: {together}")


if __name__ == "__main__":
    main()
