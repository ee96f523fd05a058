"""Hoisting frames in a job, and frames that arrive in a folder."""

from __future__ import annotations

import json
import os
import threading
import time
from dataclasses import replace
from pathlib import Path

import jsonschema
import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.document.hoisting_state import guidance_of, read_measurement
from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
from aadm_workbench.hoisting.swing.motion import combined
from aadm_workbench.inspection.tasks import plan_job
from aadm_workbench.model import HoistingMeasurement
from aadm_workbench.report.hoisting_fitness import seconds_of
from aadm_workbench.report.json import report_schema
from aadm_workbench.report.read import read_report
from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.camera import CAPTURE_TABLES, DEPTH_SCALE_MM
from aadm_workbench.twin.scenes import LAB
from aadm_workbench.twin.study.hoisting import design_of
from batch.job.file import read_job
from batch.main import main
from batch.watch.folder import FolderWatch, corner_of
from batch.watch.run import Watcher, WatchOptions
from tests import hoisting_scenes as scenes

_FARTHEST_MM = 65_000 * DEPTH_SCALE_MM
COLUMN = f"""\
[[columns]]
id = "L-1"
hoisting = ["hang.tiff", "cut.tiff"]
near = "-x-y"
[columns.design]
sleeve_diameter = 26.0
rebar_diameter = 18.0
embedded_length = 120.0
size = [250.0, 250.0]
centres = {LAB.centres().tolist()}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A job with one frame, and one that is cut off."""
    depth = scenes.usual().frame.depth
    write_depth_tiff(tmp_path / "hang.tiff", np.where(depth < _FARTHEST_MM, depth, np.nan), DEPTH_SCALE_MM)
    content = (tmp_path / "hang.tiff").read_bytes()
    (tmp_path / "cut.tiff").write_bytes(content[: len(content) // 2])
    (tmp_path / "job.toml").write_text(f'schema = 1\nunits = "mm"\n{CAPTURE_TABLES}\n{COLUMN}', encoding="utf-8")
    return tmp_path


def test_a_job_reports_its_hoisting_frames(folder: Path) -> None:
    assert main(["check", str(folder / "job.toml"), "--quiet"]) == 11
    report = json.loads((folder / "job-report" / "report.json").read_text(encoding="utf-8"))
    jsonschema.validate(report, report_schema())
    (column,) = report["columns"]
    hang, cut = column["hoisting"]
    true = {pair.sleeve: pair for pair in scenes.usual().pairs}
    errors = [abs(pair["distance_mm"] - true[pair["sleeve"]].distance_mm) for pair in hang["pairs"] if pair["seen"]]
    assert len(errors) >= 7
    assert np.mean(errors) < 0.15
    assert set(hang["correction"]) >= {"dx_mm", "dy_mm", "yaw_deg", "camera"}
    assert cut["verdict"] == "error"
    assert "cut.tiff" in cut["reasons"][0]
    assert column["verdict"] == "not_measured"  # hoisting never enters the column's own verdict


def test_one_picture_under_two_corners_contradicts_itself(folder: Path) -> None:
    job = (folder / "job.toml").read_text(encoding="utf-8")
    two = '[{file = "hang.tiff"}, {file = "hang.tiff", near = "+x-y"}, "cut.tiff"]'
    (folder / "job.toml").write_text(job.replace('["hang.tiff", "cut.tiff"]', two), encoding="utf-8")
    assert main(["check", str(folder / "job.toml"), "--quiet"]) == 11
    report = json.loads((folder / "job-report" / "report.json").read_text(encoding="utf-8"))
    jsonschema.validate(report, report_schema())
    first, second, cut = report["columns"][0]["hoisting"]
    assert [first["near"], second["near"], cut["near"]] == ["-x-y", "+x-y", None]
    for frame in (first, second):
        assert frame["correction"] is None
        assert frame["verdict"] in ("inconclusive", "fail")
        assert frame["findings"][0]["code"] == "hoisting_frames_contradict"
        assert "near = +x-y" in frame["reasons"][0]


def test_frames_of_two_corners_are_put_together_in_a_job_and_in_a_watch(folder: Path) -> None:
    corners = {"-x-y": (-1, -1), "+x-y": (1, -1)}
    for name, near in corners.items():
        depth = scenes.from_corner(near).frame.depth
        put(folder / name / "a.tiff", 0.0)
        write_depth_tiff(folder / name / "a.tiff", np.where(depth < _FARTHEST_MM, depth, np.nan), DEPTH_SCALE_MM)
    for name in ("hang.tiff", "cut.tiff"):
        (folder / name).unlink()
    job = (folder / "job.toml").read_text(encoding="utf-8")
    both = ", ".join(f'{{file = "{name}/a.tiff", near = "{name}"}}' for name in corners)
    (folder / "job.toml").write_text(job.replace('"hang.tiff", "cut.tiff"', both), encoding="utf-8")
    main(["check", str(folder / "job.toml"), "--quiet"])
    report = json.loads((folder / "job-report" / "report.json").read_text(encoding="utf-8"))
    jsonschema.validate(report, report_schema())
    (column,) = report["columns"]
    joint, last = column["hoisting_joint"], column["hoisting"][-1]
    assert joint["joined"] == ["-x-y/a.tiff", "+x-y/a.tiff"]
    assert sum(pair["seen"] for pair in joint["pairs"]) > sum(pair["seen"] for pair in last["pairs"])
    assert all(pair["reason"] == "" for pair in joint["pairs"] if pair["seen"])
    (again,) = read_report(folder / "job-report" / "report.json").columns
    assert [frame.name for frame in again.hoisting_frames] == [*joint["joined"], "-x-y/a.tiff + +x-y/a.tiff"]
    main(["watch", str(folder / "job.toml"), str(folder), "--column", "L-1", "--present", "--frames", "2", "--quiet"])
    state = json.loads((folder / "aadm-state.json").read_text(encoding="utf-8"))
    assert sorted(state["frame"]["joined"]) == ["+x-y/a.tiff", "-x-y/a.tiff"]
    assert sum(pair["seen"] for pair in state["frame"]["pairs"]) == sum(pair["seen"] for pair in joint["pairs"])


def test_a_job_can_measure_its_frames_as_published(folder: Path) -> None:
    main(["check", str(folder / "job.toml"), "--quiet", "--method", "fusion"])
    report = json.loads((folder / "job-report" / "report.json").read_text(encoding="utf-8"))
    hang = report["columns"][0]["hoisting"][0]
    assert hang["method"] == "fusion"
    assert [pair["sleeve"] for pair in hang["pairs"] if pair["distance_mm"] is not None] == ["S1", "S4", "S10"]


def test_watch_measures_new_frames_waits_for_unfinished_ones_and_skips_bad_ones(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    frames = folder / "frames"
    frames.mkdir()
    content = (folder / "hang.tiff").read_bytes()
    (frames / "old.tiff").write_bytes(content)

    watching, skips = threading.Event(), FolderWatch.skip_present

    def skip_present(watched: FolderWatch) -> None:
        skips(watched)
        watching.set()

    monkeypatch.setattr(FolderWatch, "skip_present", skip_present)

    def camera() -> None:
        watching.wait(60.0)
        (frames / "a.tiff").write_bytes(content)
        time.sleep(0.5)
        with (frames / "b.tiff").open("wb") as stream:
            stream.write(content[:400_000])
            stream.flush()
            time.sleep(0.8)
            stream.write(content[400_000:])
        time.sleep(0.5)
        (frames / "c.tiff").write_bytes(b"no picture")

    writer = threading.Thread(target=camera)
    writer.start()
    code = main(["watch", str(folder / "job.toml"), str(frames), "--column", "L-1", "--frames", "3", "--seconds", "60"])
    writer.join()
    said = capsys.readouterr().err
    state = json.loads((frames / "aadm-state.json").read_text(encoding="utf-8"))
    assert code == 12  # the last frame was no picture
    assert "old.tiff" not in said
    assert [line.partition(":")[0] for line in said.splitlines()] == ["L-1", "a.tiff", "b.tiff", "c.tiff"]
    assert "still for 2 frames" in said
    assert (state["frames"], state["bad_frames"], state["frame"]["verdict"]) == (3, 1, "error")
    assert not list(frames.glob(".*"))


def test_watch_says_its_last_state_as_json(folder: Path, capsysbinary: pytest.CaptureFixture[bytes]) -> None:
    options = ["--column", "L-1", "--present", "--frames", "1", "--json", "--state", str(folder / "state.json")]
    (folder / "cut.tiff").unlink()
    main(["watch", str(folder / "job.toml"), str(folder), *options])
    state = json.loads(capsysbinary.readouterr().out)
    assert state["column"] == "L-1"
    shown = read_measurement(folder / "state.json")  # by FreeCAD's hoisting window
    assert shown is not None
    assert shown.column == "L-1"
    guidance, move = guidance_of(shown, "-y"), state["frame"]["correction"]
    assert (guidance.right_mm, guidance.ahead_mm) == pytest.approx((move["dx_mm"], move["dy_mm"]))
    assert guidance.turn_deg == move["yaw_deg"]
    assert guidance.largest_mm == state["frame"]["max_mm"]
    assert guidance.margin_mm == pytest.approx(3.0 - state["frame"]["max_mm"])
    assert state["running"]["frames"] == 1
    assert (state["schema"], state["sequence"], state["valid_for_s"], state["limit_mm"]) == (2, 1, 15.0, 3.0)
    assert seconds_of(state["captured"]) == pytest.approx((folder / "hang.tiff").stat().st_mtime, abs=0.01)
    assert (seconds_of(state["measured"]) or 0.0) >= (seconds_of(state["captured"]) or 0.0)
    assert (state["ready"], state["still"], state["swing"]) == (False, False, None)
    assert state["reason"] == "seen in fewer than three frames: whether it moves is not known"
    assert state["frame"]["near"] == "-x-y"
    assert len(state["running"]["pairs"]) == 12


def moved_by(found: HoistingMeasurement, shift_mm: float) -> HoistingMeasurement:
    """The measurement of the same column, displaced along x: its correction and offsets follow."""
    assert found.report.correction is not None
    correction = replace(found.report.correction, dx_mm=found.report.correction.dx_mm - shift_mm)
    report = replace(found.report, correction=correction)
    return replace(found, report=report, offsets_mm=found.offsets_mm - [shift_mm, 0.0])


def test_a_swinging_column_is_never_ready_and_is_pushed_from_its_rest(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nine millimetres to either side, and in the frames that happen to show it in place it passes."""
    usual = measure_hoisting(
        scenes.usual().frame.scan(), design_of(LAB), near=scenes.NEAR, settings=HoistingSettings(load_profile("cn"))
    )
    (folder / "cut.tiff").unlink()
    times_s = 1.3 * np.arange(8)
    shifts = 9.0 * np.sin(2.0 * np.pi * times_s / 4.7)
    frames = iter([moved_by(usual, float(shift)) for shift in shifts])
    monkeypatch.setattr("batch.watch.run.measure_frame", lambda *_, **__: next(frames))
    clock = {"s": 0.0}
    watched = folder / "frames"
    watched.mkdir()
    job = read_job(folder / "job.toml")
    tasks = plan_job(job, only=("L-1",)).tasks
    state_file = folder / "state.json"
    options = WatchOptions(state_file, frames=1, present=True)
    watcher = Watcher(tasks[0], watched, options, lambda _: None, lambda: NOON_NS + int(clock["s"] * 1e9))
    states = []
    for number, time_s in enumerate(times_s, start=1):
        clock["s"] = float(time_s) + 0.2
        path = watched / f"{number}.tiff"
        path.write_bytes((folder / "hang.tiff").read_bytes())
        os.utime(path, ns=(0, NOON_NS + int(time_s * 1e9)))
        watcher.options = replace(options, frames=number)
        watcher.run(lambda _: None)
        states.append(json.loads(state_file.read_text(encoding="utf-8")))
    assert [state["sequence"] for state in states] == list(range(1, 9))
    assert not any(state["ready"] or state["still"] for state in states)
    assert (states[1]["move"], states[1]["moving"]) == (None, True)
    assert states[1]["reason"].startswith("moving")
    last, aim = states[-1], usual.report.correction
    assert aim is not None
    assert (last["move"]["dx_mm"], last["move"]["dy_mm"]) == pytest.approx((aim.dx_mm, aim.dy_mm), abs=0.3)
    assert last["swing"]["amplitude_mm"] == pytest.approx(9.0, abs=1.0)
    assert last["swing"]["period_s"] == pytest.approx(4.7, abs=0.3)


def test_an_hour_of_frames_leaves_no_trace_in_memory(tmp_path: Path) -> None:
    watch = FolderWatch(tmp_path)
    watch.skip_present()
    for number in range(3600):
        path = tmp_path / f"{number:04d}.tiff"
        path.write_bytes(b"x")
        watch.done(path)  # as never looked at: only its name would be kept
        path.unlink()
        if number % 500 == 0:
            assert watch.ready() == []
    assert len(watch.names_done) <= 2000


NOON_NS = 1_796_040_000 * 10**9


def put(path: Path, at_s: float) -> Path:
    """A file that was written so many seconds after noon."""
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(b"x")
    os.utime(path, ns=(0, NOON_NS + int(at_s * 1e9)))
    return path


def ready(watch: FolderWatch) -> list[tuple[str, float | None]]:
    """Names of the files that are ready, with the seconds after noon of their capture; they count as done then."""
    watch.ready()
    found = []
    for path in watch.ready():
        captured_s = watch.captured_s(path)
        found.append((watch.name_of(path), None if captured_s is None else round(captured_s - NOON_NS / 1e9, 3)))
        watch.done(path)
    return found


@pytest.mark.parametrize("present", [True, False])
def test_a_file_from_the_future_deafens_nobody(tmp_path: Path, present: bool) -> None:
    """The clock was two hours ahead when the first file came, and was set right since."""
    now_s = 0.0
    watch = FolderWatch(tmp_path, lambda: NOON_NS + int(now_s * 1e9))
    put(tmp_path / "old.tiff", 7200.0)
    if present:
        assert ready(watch) == [("old.tiff", None)]  # when it was captured nobody knows
    else:
        watch.skip_present()
    now_s = 10.0
    put(tmp_path / "a.tiff", 9.0)
    assert ready(watch) == [("a.tiff", 9.0)]
    put(tmp_path / "b.tiff", 7300.0)  # a camera whose clock is still wrong: not captured after it came
    assert ready(watch) == [("b.tiff", 10.0)]
    now_s = -3600.0  # set back once more
    put(tmp_path / "c.tiff", -3601.0)
    assert ready(watch) == [("c.tiff", -3601.0)]
    put(tmp_path / "a.tiff", -3600.0)  # written anew under a name that was done
    assert ready(watch) == [("a.tiff", -3600.0)]
    assert ready(watch) == []


def test_each_corner_may_have_a_subfolder(tmp_path: Path) -> None:
    watch = FolderWatch(tmp_path, lambda: NOON_NS)
    watch.skip_present()
    for name in ("+x-y/a.tiff", "-x-y/a.tiff", "a.tiff", "cam1/a.tiff", "-x+y/notes.md"):
        put(tmp_path / name, -1.0)
    assert sorted(name for name, _ in ready(watch)) == ["+x-y/a.tiff", "-x-y/a.tiff", "a.tiff"]
    assert corner_of(tmp_path / "+x-y" / "a.tiff") == (1, -1)
    assert corner_of(tmp_path / "a.tiff") is None


def still_frames(count: int, shift_mm: float = 0.0, seed: int = 0) -> list[HoistingMeasurement]:
    """One measurement with the noise of single frames added to it."""
    found = measure_hoisting(scenes.usual().frame.scan(), design_of(LAB), near=scenes.NEAR)
    rng = np.random.default_rng(seed)
    return [
        replace(found, offsets_mm=found.offsets_mm + rng.normal(0.0, 0.03, (12, 2)) + [shift_mm, 0.0])
        for _ in range(count)
    ]


def test_frames_are_combined_while_the_column_is_still_and_a_move_is_noticed() -> None:
    running = None
    first_u = 0.0
    for number, frame in enumerate(still_frames(500)):
        running = combined(running, frame)
        assert running.frames == number + 1
        first_u = first_u or float(np.median(running.u_mm))
    assert running is not None
    assert np.median(running.u_mm) < first_u
    assert np.abs(running.offsets_mm - still_frames(1, seed=1)[0].offsets_mm).max() < 0.15
    (moved,) = still_frames(1, shift_mm=1.0)
    running = combined(running, moved)
    assert running.frames == 1
    assert running.moved_mm == pytest.approx(1.0, abs=0.15)
