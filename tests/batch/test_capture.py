"""From the camera to the report: what is captured measures as its TIFF does, and faults cost their frame alone."""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import cv2
import genicam
import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.camera.frame import Device, Frame
from aadm_workbench.camera.gentl import GentlCamera
from aadm_workbench.errors import CameraGoneError, CaptureError, EndOfFramesError
from aadm_workbench.scan.read import read_scan
from aadm_workbench.scan.write_capture import write_capture
from aadm_workbench.twin.camera import CAPTURE_TABLES
from batch.capturing.session import LiveFolder, Session
from batch.main import main
from tests.camera.device import Acquirer, Buffer, component, node_map
from tests.camera.gige_device import ADDRESS, has_aravis, served
from tests.camera.test_gentl import CHOICES, SCAN3D
from tests.hoisting_scenes import usual

from .test_hoisting import COLUMN

VIKY = Path(genicam.__file__).parent / "viky.cti"
STEP_MM = 0.02  # as cameras send it


def camera_with(*buffers: Buffer, **features: Any) -> GentlCamera:
    nodes = node_map({**SCAN3D, **features}, {**CHOICES, "Scan3dOutputMode": ()})
    frames = [lambda _, buffer=buffer: buffer for buffer in buffers]
    return GentlCamera(Device("gentl:twin.cti#1"), Acquirer(nodes, frames), lambda: None)


def through_gige(folder: Path, name: str, values: np.ndarray, pixel_format: str, features: dict[str, Any]) -> None:
    """One frame off the network, as a capture; one whose packets the loaded machine dropped is taken again."""
    with served(folder / f"{name}-camera", values, features, pixel_format), Session(ADDRESS) as session:
        for _ in range(50):
            try:
                session.take(folder / name)
            except CaptureError as error:
                lost = error
            else:
                return
    raise AssertionError(f"no frame came whole: {lost}")


@pytest.fixture(scope="module")
def job(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A job whose hoisting frames are one twin frame: its TIFF, ABC32f and C16 buffers of it; both by GigE aside."""
    folder = tmp_path_factory.mktemp("captured")
    depth, camera = usual().frame.depth, usual().frame.camera
    (folder / "hang.tiff").write_bytes(cv2.imencode(".tiff", depth)[1].tobytes())
    v, u = np.mgrid[: camera.height, : camera.width]
    z = np.where(depth > 0, depth, np.float32(np.nan))
    x = z * ((u - camera.cx) / camera.fx).astype(np.float32)
    y = z * ((v - camera.cy) / camera.fy).astype(np.float32)
    points = np.stack([x, y, z], axis=-1)
    steps = np.rint((np.nan_to_num(z) - 100.0) / STEP_MM)
    steps = np.where((steps > 0) & (steps < 2**16), steps, 0).astype("<u2")
    whole = {"Scan3dOutputMode": "CalibratedABC_Grid"}
    flat = {
        "Scan3dOutputMode": "CalibratedC",
        "Scan3dFocalLength": camera.fx,
        "Scan3dAspectRatio": camera.fy / camera.fx,
        "Scan3dPrincipalPointU": camera.cx,
        "Scan3dPrincipalPointV": camera.cy,
        "Scan3dInvalidDataFlag": True,
        "Scan3dInvalidDataValue": 0.0,
        "Scan3dCoordinateScale": STEP_MM,
        "Scan3dCoordinateOffset": 100.0,
    }
    frames = ["hang.tiff"]
    for name, kind, values, features in (("abc", "ABC32f", points, whole), ("c16", "C16", steps, flat)):
        buffer = Buffer([component(f"Coord3D_{kind}", camera.width, camera.height, values)])
        with Session(name, lambda _, said=features, sent=buffer: camera_with(sent, **said)) as session:
            session.take(folder / name)
        frames.append(name)
        if has_aravis():
            of_device = {"Scan3dDistanceUnit": "Millimeter", "Scan3dCoordinateSelector": "CoordinateC"}
            through_gige(folder, f"gige-{name}", values, f"Coord3D_{kind}", {**of_device, **features})
    assert main(["capture", f"replay:{folder / 'abc'}", "--out", str(folder / "again"), "--quiet"]) == 0
    column = COLUMN.replace('["hang.tiff", "cut.tiff"]', json.dumps([*frames, "again"]))
    (folder / "job.toml").write_text(f'schema = 1\nunits = "mm"\n{CAPTURE_TABLES}\n{column}', encoding="utf-8")
    return folder / "job.toml"


def test_one_frame_measures_alike_from_its_file_and_from_the_camera(job: Path) -> None:
    folder = job.parent
    assert main(["check", str(job), "--quiet"]) == 11
    report = json.loads((folder / "job-report" / "report.json").read_text(encoding="utf-8"))
    tiff, abc, c16, again = report["columns"][0]["hoisting"]
    assert len([pair for pair in tiff["pairs"] if pair["seen"]]) >= 7
    for frame in (abc, again):
        other_file = {"source": "", "sha256": ""}
        assert {**frame, **other_file} == {**tiff, **other_file}
    for pair, other in zip(tiff["pairs"], c16["pairs"], strict=True):
        # steps of 0.02 mm are noise of 0.006 mm: what it moves stays well within what is stated of the frame
        assert other["distance_mm"] == pytest.approx(pair["distance_mm"], abs=0.4 * pair["u_mm"])
    depths = [read_scan(folder / name).points[..., 2] for name in ("abc", "c16")]
    both = np.isfinite(depths[0]) & np.isfinite(depths[1])
    assert both.mean() > 0.2
    assert np.abs(depths[0] - depths[1])[both].max() <= STEP_MM / 2 + 1e-4


@pytest.mark.skipif(not has_aravis(), reason="libaravis-0.8-0 is not installed")
@pytest.mark.parametrize(("name", "content"), [("abc", "cloud.pcd"), ("c16", "depth.tiff")])
def test_one_frame_is_the_same_behind_a_producer_and_off_the_network(job: Path, name: str, content: str) -> None:
    behind, off = (job.parent / one / content for one in (name, f"gige-{name}"))
    assert behind.read_bytes() == off.read_bytes()
    intrinsics = [(path.parent / "intrinsics.json").read_text(encoding="utf-8") for path in (behind, off)]
    assert intrinsics[0] == intrinsics[1]


def test_watch_takes_frames_writes_them_and_measures_them(job: Path, tmp_path: Path, capsys: Any) -> None:
    folder = tmp_path / "live"
    options = ["--column", "L-1", "--camera", f"replay:{job.parent / 'abc'}", "--seconds", "60"]
    code = main(["watch", str(job), str(folder), *options])
    state = json.loads((folder / "aadm-state.json").read_text(encoding="utf-8"))
    assert (state["frames"], state["bad_frames"]) == (1, 0)
    assert code in (0, 10, 11)
    (capture,) = [path for path in folder.iterdir() if path.is_dir()]
    assert state["frame"]["source"] == capture.name
    taken = json.loads((capture / "capture.json").read_text(encoding="utf-8"))["captured"]
    assert state["captured"] == taken
    assert (capture / "cloud.pcd").read_bytes() == (job.parent / "abc" / "cloud.pcd").read_bytes()
    # measured again from what was written
    main(["watch", str(job), str(folder), "--column", "L-1", "--present", "--frames", "1", "--quiet"])
    again = json.loads((folder / "aadm-state.json").read_text(encoding="utf-8"))
    assert again["frame"] == state["frame"]
    assert again["captured"] == taken
    capsys.readouterr()


def test_a_camera_that_goes_away_withdraws_ready_and_comes_back(job: Path, tmp_path: Path) -> None:
    folder = tmp_path / "live"
    folder.mkdir()
    events: list[Any] = [
        CameraGoneError("gentl:x: the camera went away (pulled)"),
        "frame",
        EndOfFramesError("no more"),
    ]
    opened: list[str] = []

    class Flaky:
        device = Device("gentl:x")

        def capture(self) -> Frame:
            event = events.pop(0)
            if isinstance(event, Exception):
                raise event
            (state,) = folder.glob("aadm-state.json")
            kept = json.loads(state.read_text(encoding="utf-8"))
            assert (kept["ready"], kept["move"], kept["bad_frames"]) == (False, None, 1)
            assert "went away" in kept["reason"]
            return Frame(
                self.device, time.time_ns() / 1e9, files={"cloud.pcd": (job.parent / "abc" / "cloud.pcd").read_bytes()}
            )

        def close(self) -> None:
            opened.append("closed")

    def opener(address: str) -> Any:
        opened.append(address)
        return Flaky()

    from aadm_workbench.inspection.tasks import plan_job
    from batch.job.file import read_job
    from batch.watch.run import Watcher, WatchOptions

    (task,) = plan_job(read_job(job), only=("L-1",)).tasks
    said: list[str] = []
    clock = iter(range(0, 10_000, 2))
    with Session("gentl:x", opener) as session:
        live = LiveFolder(session, folder, clock=lambda: float(next(clock)))
        watcher = Watcher(task, folder, WatchOptions(folder / "aadm-state.json", seconds=60, live=live), said.append)
        watcher.run(wait=lambda _: None)
    assert opened == ["gentl:x", "closed", "gentl:x", "closed"]
    assert (watcher.frames, watcher.bad_frames) == (2, 1)
    assert any("went away" in line for line in said)


def test_capture_writes_one_frame_or_several_and_never_over_another(tmp_path: Path, capsys: Any) -> None:
    camera = f"gentl:{VIKY}#1"
    assert main(["capture", camera, "--out", str(tmp_path / "a" / "one")]) == 0
    assert "400 x 400 pixels, 100% returned" in capsys.readouterr().err
    assert {path.name for path in (tmp_path / "a" / "one").iterdir()} == {"capture.json", "cloud.pcd", "texture.png"}
    assert main(["capture", camera, "--out", str(tmp_path / "a" / "one")]) == 2
    assert "holds files already" in capsys.readouterr().err
    assert main(["capture", camera, "--out", str(tmp_path / "b"), "--count", "2", "--every", "100ms", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    folders = sorted(path for path in (tmp_path / "b").iterdir())
    assert [Path(entry["folder"]) for entry in said["captures"]] == folders
    assert [entry["serial"] for entry in said["captures"]] == ["1", "1"]
    scan = read_scan(folders[0])
    assert scan.points.shape == (400, 400, 3)
    assert scan.points[17, 230, :2].tolist() == [230.0, 17.0]
    assert main(["capture", f"replay:{tmp_path / 'b'}", "--out", str(tmp_path / "c"), "--count", "3", "--quiet"]) == 12
    assert "all 2 captures were played" in capsys.readouterr().err


def test_cameras_lists_what_is_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    assert main(["cameras", f"gentl:{VIKY}", "--json"]) == 0
    assert [one["serial"] for one in json.loads(capsys.readouterr().out)] == ["0", "1", "2"]
    monkeypatch.delenv("GENICAM_GENTL64_PATH", raising=False)
    assert main(["cameras"]) == 2
    monkeypatch.setenv("GENICAM_GENTL64_PATH", f"{VIKY.parent}:{tmp_path}")
    assert main(["cameras"]) == 0
    assert "Viky" in capsys.readouterr().out
    (tmp_path / "broken.cti").write_text("no library")
    assert main(["cameras"]) == 12
    told = capsys.readouterr()
    assert "broken.cti: cannot be loaded" in told.err
    assert "Viky" in told.out
    assert main(["cameras", f"gentl:{tmp_path}/broken.cti"]) == 2


def frame_of(points: np.ndarray) -> Frame:
    return Frame(Device("gentl:x"), 1.0, points.astype(np.float32))


def test_a_full_disk_leaves_nothing_and_the_next_frame_goes_on(tmp_path: Path) -> None:
    script = (
        "import signal, sys; signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "from batch.main import main; raise SystemExit(main(sys.argv[1:]))"
    )
    root = Path(__file__).resolve().parents[2]

    def captured(count: int, largest: int) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-c", script, "capture", f"gentl:{VIKY}#0", "--out", "out", "--count", str(count)]
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (largest, largest))  # noqa: E731
        environment = {"PYTHONPATH": str(root), "PATH": "/usr/bin:/bin", "HOME": str(tmp_path)}
        return subprocess.run(
            command, cwd=tmp_path, env=environment, preexec_fn=limit, capture_output=True, text=True, check=False
        )

    done = captured(2, 1_000_000)  # a cloud of the simulator takes 1.9 MB
    assert done.returncode == 12
    assert done.stderr.count("cloud.pcd: cannot be written (File too large)") == 2
    assert ".part" not in done.stderr
    assert list((tmp_path / "out").iterdir()) == []
    assert captured(1, 3_000_000).returncode == 0
    (capture,) = (tmp_path / "out").iterdir()
    assert len(list(capture.iterdir())) == 3


def test_a_reader_never_meets_half_a_capture(tmp_path: Path) -> None:
    points = np.ones((300, 300, 3))
    seen: set[frozenset[str]] = set()
    done = threading.Event()

    def look() -> None:
        while not done.is_set():
            seen.update(
                frozenset(one.name for one in path.iterdir()) for path in tmp_path.iterdir() if path.name[0] != "."
            )

    reader = threading.Thread(target=look)
    reader.start()
    for number in range(30):
        write_capture(tmp_path / f"c{number}", frame_of(points), "2026-01-01T00:00:00Z")
    done.set()
    reader.join()
    assert seen <= {frozenset({"cloud.pcd", "capture.json"})}
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "mine.txt").write_text("mine")
    with pytest.raises(CaptureError, match="holds files already"):
        write_capture(tmp_path / "taken", frame_of(points), "")
    with pytest.raises(CaptureError, match="nowhere/c: the capture cannot be written"):
        write_capture(tmp_path / "nowhere" / "c", frame_of(points), "")


def test_what_the_camera_smooths_stands_in_the_notes_of_the_scan(tmp_path: Path) -> None:
    points = np.dstack([*np.mgrid[:60, :60].astype(float), np.full((60, 60), 500.0)])
    camera = camera_with(
        Buffer([component("Coord3D_ABC32f", 60, 60, points.astype("<f4"))]),
        Scan3dOutputMode="CalibratedABC_Grid",
        PointCloudSurfaceSmoothing="Strong",
        K1="off",
    )
    with Session("x", lambda _: camera) as session:
        session.take(tmp_path / "c")
    scan = read_scan(tmp_path / "c")
    assert [note for note in scan.notes if "PointCloudSurfaceSmoothing = Strong" in note]
