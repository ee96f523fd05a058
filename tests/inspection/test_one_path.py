"""One path from files to report: short, light, and the same for the command, its workers and the watch."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.report.json import encode
from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.camera import CAPTURE_TABLES, DEPTH_SCALE_MM
from batch.main import main

MOST_FRAMES = 6  # main, run, run_job, fill_order, inspect_column, check_column
MOST_MODULES = 131  # packages among them, 23 of one line; one stands for 190 modules of SciPy and NumPy that it spares

_FARTHEST_MM = 65_000 * DEPTH_SCALE_MM  # of the picture's sixteen bits

WITNESS = """
import json, sys

own = ("aadm_workbench", "aadm_batch")
frames = []

def watch(frame, event, argument):
    if event == "call" and frame.f_code.co_name == "check_column":
        sys.setprofile(None)
        while frame is not None:
            if str(frame.f_globals["__name__"]).partition(".")[0] in own:
                frames.append(frame.f_code.co_name)
            frame = frame.f_back

from aadm_batch.main import main
sys.setprofile(watch)
code = main(sys.argv[1:])
print(json.dumps([code, frames[::-1], [name for name in sys.modules if name.partition(".")[0] in own]]))
"""


def test_few_frames_and_modules_lead_to_a_column(repository: Path, tmp_path: Path) -> None:
    job = str(repository / "samples" / "lab" / "job.toml")
    words = ["check", job, "--only", "L-1", "--out", str(tmp_path)]
    done = subprocess.run(
        [sys.executable, "-c", WITNESS, *words], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    code, frames, modules = json.loads(done.stdout.splitlines()[-1])
    assert code == 0
    assert frames[0] == "main"
    assert frames[-1] == "check_column"
    assert len(frames) <= MOST_FRAMES, frames
    assert len(modules) <= MOST_MODULES, sorted(modules)


HEAD = """\
schema = 1
units = "mm"
capture = { operator = "A", date = 2026-05-04 }
[[columns]]
id = "A"
sleeves = "nowhere.ply"
[columns.design]
sleeve_diameter = 26.0
rebar_diameter = 18.0
centres = [[0.0, 0.0], [100.0, 0.0], [0.0, 100.0]]
"""
"""A column whose scan is missing, and what a job may say of its capture."""


def lab_columns(repository: Path) -> str:
    """The columns of the laboratory's sample, their scans where they lie."""
    lab = repository / "samples" / "lab"
    text = (lab / "job.toml").read_text("utf-8")
    return text[text.index("[[columns]]") :].replace('"scans/', f'"{(lab / "scans").as_posix()}/')


def checked(job: Path, out: str, *words: str) -> bytes:
    """The bytes of a report."""
    main(["check", str(job), "--quiet", "--out", str(job.parent / out), *words])
    return (job.parent / out / "report.json").read_bytes()


def test_this_process_and_two_workers_come_to_the_same_bytes(repository: Path, tmp_path: Path) -> None:
    pytest.importorskip("psutil")
    job = tmp_path / "job.toml"
    job.write_text(f"{HEAD}\n{lab_columns(repository)}", "utf-8")
    here, there = checked(job, "here"), checked(job, "there", "--jobs", "2")
    assert there == here
    # The pool was there: what its workers said is kept beside the report.
    assert "is ready" in (tmp_path / "there" / "workers.log").read_text("utf-8")
    assert not (tmp_path / "here" / "workers.log").exists()
    report = json.loads(here)
    assert report["summary"] == {"pass": 2, "fail": 0, "inconclusive": 0, "not_measured": 0, "error": 1}
    assert {"name", "version", "numpy", "scipy"} <= report["tool"].keys()
    assert report["capture"] == {"operator": "A", "date": "2026-05-04"}


def test_a_watch_measures_a_frame_as_a_check_does(repository: Path, tmp_path: Path) -> None:
    """With what the scans before hoisting have told, by the job's profile, its decision and its corner."""
    pytest.importorskip("open3d")
    from tests import hoisting_scenes as scenes

    depth = scenes.usual().frame.depth
    write_depth_tiff(tmp_path / "hang.tiff", np.where(depth < _FARTHEST_MM, depth, np.nan), DEPTH_SCALE_MM)
    column = lab_columns(repository).partition("[[columns]]")[2].partition("[[columns]]")[0]
    hung = column.replace('up = "+y"', 'up = "+y"\nhoisting = "hang.tiff"\nnear = "-x-y"')
    job = tmp_path / "job.toml"
    job.write_text(f'schema = 1\nunits = "mm"\n{CAPTURE_TABLES}\n[[columns]]\n{hung}', "utf-8")
    (column_report,) = json.loads(checked(job, "check"))["columns"]
    (frame,) = column_report["hoisting"]
    assert column_report["sleeves"]["verdict"] == "pass"
    assert frame["moved_since"], "nothing was known from before hoisting"  # they are two different columns
    main(["watch", str(job), str(tmp_path), "--column", "L-1", "--present", "--frames", "1", "--quiet"])
    state = json.loads((tmp_path / "aadm-state.json").read_text("utf-8"))
    assert encode(state["frame"]) == encode(frame)
