"""A real watch on virtual frames, started from FreeCAD's window: what it shows, and that it ends when it is to end."""

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.camera import CAPTURE_TABLES, DEPTH_SCALE_MM
from aadm_workbench.twin.hoisting import Hang, Stand
from aadm_workbench.twin.scenes import LAB
from tests import hoisting_scenes as scenes
from tests.conftest import ROOT, FreeCADRunner, find_freecad
from tests.freecad_environment import with_environment

pytestmark = pytest.mark.freecad

FRAMES = 3
FARTHEST_MM = 65_000 * DEPTH_SCALE_MM
JOB = f"""\
schema = 1
units = "mm"
{CAPTURE_TABLES}
[[columns]]
id = "L-1"
near = "-x-y"
[columns.design]
sleeve_diameter = 26.0
rebar_diameter = 18.0
embedded_length = 120.0
size = [250.0, 250.0]
centres = {LAB.centres().tolist()}
"""
FONT = ROOT / "aadm_workbench/resources/fonts/wqy-microhei-subset.ttf"


def hung(folder: Path) -> Path:
    """A job, a folder to watch, and captures of a column that hangs 7 mm off and hardly swings."""
    (folder / "frames").mkdir(parents=True)
    (folder / "job.toml").write_text(JOB, encoding="utf-8")
    intrinsics = CAPTURE_TABLES.split("[camera]\n")[1].split("\n\n")[0]
    for number in range(FRAMES):
        hang = Hang(90.0, shift=(6.0, -4.0 + 0.05 * number))
        depth = scenes.frame(LAB, hang, Stand(850.0), 1).frame.depth
        capture = folder / "captures" / f"capture-{number}"
        capture.mkdir(parents=True)
        write_depth_tiff(capture / "depth.tiff", np.where(depth < FARTHEST_MM, depth, np.nan), DEPTH_SCALE_MM)
        (capture / "camera.toml").write_text(intrinsics, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def watched(tmp_path_factory: pytest.TempPathFactory, x_display: str) -> dict[str, Any]:
    folder = tmp_path_factory.mktemp("watch")
    runner = with_environment(FreeCADRunner(find_freecad("freecad", "FreeCAD"), folder, x_display))
    given = f"HUNG = {str(hung(folder / 'hung'))!r}\nFONT = {str(FONT)!r}\n"
    body = (Path(__file__).parent / "watch_body.py").read_text(encoding="utf-8")
    return {**runner.run(given + body, timeout_s=600.0), "folder": folder}


def test_what_is_not_named_is_asked_for(watched: dict[str, Any]) -> None:
    assert "job file" in watched["said_without_job"][0]
    assert "column" in watched["said_without_column"][0]
    assert "folder" in watched["said_without_folder"][0]
    assert "no such column" in watched["said_for_wrong_column"][0]


def test_frames_are_measured_as_they_come(watched: dict[str, Any]) -> None:
    assert watched["button_while_watching"] == "Stop watching"
    assert watched["locked"]
    assert watched["sequences"] == list(range(1, FRAMES + 1))
    assert watched["shown_column"] == "L-1"
    assert watched["guided"]
    assert "capture-2.tiff" in watched["state_said"]


def test_it_stops_when_asked_and_says_nothing_of_it(watched: dict[str, Any]) -> None:
    assert watched["ended"]
    assert watched["said_after_stop"] == []
    assert watched["button_after_stop"] == "Start watching"


def test_a_camera_that_has_no_more_ends_it(watched: dict[str, Any]) -> None:
    assert watched["ended_by_itself"]
    assert watched["said_by_camera"] == []
    assert watched["played"] == FRAMES


def test_it_ends_with_the_window(watched: dict[str, Any]) -> None:
    assert watched["ran"] == 1
    assert watched["ended_with_window"]


def test_all_of_the_screen_belongs_to_the_arrow(watched: dict[str, Any]) -> None:
    assert watched["bar_in_full_screen"] is False
    light, dark = (cv2.imread(str(watched["folder"] / f"watch-{name}.png")) for name in (str(FRAMES), "dark"))
    assert light.shape == dark.shape
    assert dark.mean() < light.mean()
