"""Renders the scans of this folder again: python tests/fringe_scans/make.py NAME [FOLDER]; minutes for each.

Needs the extra ``physics``. Another machine's floating point gives other last digits, not other scans.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.fringe.materials import SLEEVE_METALS
from aadm_workbench.twin.fringe.rig import FringeRig, Lenses, Projector
from aadm_workbench.twin.fringe.shot import FringeCamera, Materials, fringe_image
from aadm_workbench.twin.meshes import bars_surface, foot_surface
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_bars, random_foot, random_pose
from benchmarks.site_scenes import built_column
from benchmarks.sites import TROUBLES

HERE = Path(__file__).parent
STEP_MM, STEPS_MAX = 0.025, 65535
SITE_STEP_MM = 0.05  # they are farther away


@dataclass(frozen=True)
class Scene:
    """A setting with what is unlike from scene to scene; lengths in mm, ``blur`` in pixels."""

    seed: int
    setting: Setting = FIELD
    distance: float = 1300.0
    focus: float = 1200.0
    metal: str = "steel"
    ribs: float = 1.2
    chamfer: float = 0.5
    blur: float | None = None


SCENES = {
    "a-field1": Scene(101),
    "a-lab1": Scene(103, LAB, 800.0, 800.0),
    "a-blurred": Scene(105, blur=1.3),
    "b-field1": Scene(201, distance=1250.0),
    "b-lab1": Scene(203, LAB, 780.0, 800.0, "zinc", ribs=0.8),
    "b-zinc": Scene(204, distance=1200.0, metal="zinc", ribs=0.0, chamfer=0.0),
}

# kinds and numbers of the benchmark of sites
SITES = {
    "a-site-plugs": ("plugs", 5400041),
    "a-site-rough": ("rough", 5400026),
    "a-site-washed": ("rough", 5400004),
    "b-site-plugs": ("plugs", 5400050),
    "b-site-taped-spalls": ("taped-spalls", 5400042),
}


def make(name: str, folder: Path) -> None:
    """Render the foot and the bars of a scene, each with displacements of up to a millimetre that both share."""
    scene = SCENES[name]
    rng = np.random.default_rng(scene.seed)
    centres = scene.setting.centres()
    places = centres + np.clip(rng.normal(0.0, 0.6, centres.shape), -1.0, 1.0)
    foot, bars = random_foot(scene.setting, rng), random_bars(scene.setting, rng)
    sleeves = (
        replace(s, x=float(x), y=float(y), rib_height=scene.ribs, chamfer=scene.chamfer)
        for s, (x, y) in zip(foot.sleeves, places, strict=True)
    )
    foot = replace(foot, sleeves=tuple(sleeves))
    tops = (
        replace(b, x=float(x), y=float(y), top=float(rng.uniform(-10.0, 10.0)))
        for b, (x, y) in zip(bars.bars, places, strict=True)
    )
    bars = replace(bars, bars=tuple(tops))
    lenses = Lenses(camera_focus=scene.focus, projector_focus=scene.focus - 50.0)
    lenses = lenses if scene.blur is None else replace(lenses, blur=scene.blur)
    rig = FringeRig(lenses=lenses, projector=Projector(axes_meet=scene.focus))
    camera = FringeCamera(rig, Materials(sleeve=SLEEVE_METALS[scene.metal]))
    poses = {}
    for what, surface in (("foot", foot_surface(foot)), ("bars", bars_surface(bars))):
        pose = random_pose(scene.setting, what == "foot", rng, 5.0, scene.distance)
        depth, _ = fringe_image(surface, pose, camera, rng).drawn(rng)
        depth[~(depth < STEPS_MAX * STEP_MM)] = np.nan  # farther than the file can hold
        write_depth_tiff(folder / f"{what}.tiff", depth, STEP_MM)
        poses[what] = np.linalg.inv(pose)
    true = {
        "sleeves_scan": _seen(poses["foot"], np.array([[s.x, s.y, 0.0] for s in foot.sleeves])),
        "bars_scan": _seen(poses["bars"], np.array([[b.x, b.y, b.top] for b in bars.bars])),
        "n_sleeves": (-poses["foot"][:3, 2]).tolist(),
        "n_bars": poses["bars"][:3, 2].tolist(),
    }
    (folder / "truth.json").write_text(json.dumps(true, indent=1))


def make_site(name: str, folder: Path) -> None:
    """Render the foot of a column of the benchmark of sites, with what a site did to it; a small part of the image."""
    kind, number = SITES[name]
    column = built_column(TROUBLES[kind].scenario, number, "fringe")
    scan, camera = column.sleeves, column.sleeves.camera
    write_depth_tiff(folder / "foot.tiff", scan.depth, SITE_STEP_MM)
    true = {
        "diameter_mm": column.setting.sleeve_diameter,
        "camera": [camera.fx, camera.fy, camera.cx, camera.cy],
        "size": [camera.width, camera.height],
        "sleeves_scan": np.round(scan.points_scan(), 4).tolist(),
        "measurable": [sleeve.taped < 1.0 for sleeve in column.foot.sleeves],
    }
    (folder / "truth.json").write_text(json.dumps(true, indent=1) + "\n")


def _seen(T_scan_column: np.ndarray, points: np.ndarray) -> list[list[float]]:
    return (points @ T_scan_column[:3, :3].T + T_scan_column[:3, 3]).tolist()


if __name__ == "__main__":
    into = Path(sys.argv[2]) if len(sys.argv) > 2 else HERE / sys.argv[1]
    into.mkdir(exist_ok=True)
    (make_site if sys.argv[1] in SITES else make)(sys.argv[1], into)
