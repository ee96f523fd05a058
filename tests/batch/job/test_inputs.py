"""The key of a column: another one as soon as anything changes that its result follows from, and nothing else."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.inspection.job import JobColumn
from aadm_workbench.inspection.measure import CheckSettings
from aadm_workbench.inspection.tasks import ColumnTask
from aadm_workbench.model import Camera, CameraProfile
from aadm_workbench.model.camera import Measure
from batch.job.file import read_job
from batch.job.inputs import content_hash, looks, order_key, read_for_shipping, task_key, unpack
from tests.batch.conftest import WriteJob, column_text

PINHOLE = Camera(1.0, 1.0, 1.0, 1.0, 2, 2)


def key_of(task: ColumnTask, program: str) -> str:
    """The key of a column by a program."""
    return task_key(task, order_key(task, program))


@pytest.fixture
def task(write_job: WriteJob) -> ColumnTask:
    """A column with two scans."""
    job = read_job(write_job(column_text("C-1", "foot.ply", "bars.ply"), clouds=("foot.ply", "bars.ply")))
    (column,) = job.columns
    return ColumnTask(column, job.folder, column.design, CheckSettings(job.profile))


def test_files_of_a_column() -> None:
    column = JobColumn("C-1", ("a", "b"), ("c",), ("h",), sleeves_image="i", rebars_image="a", near=(1, 1))
    assert column.files() == ("a", "b", "c", "h", "i")


def test_the_key_follows_every_input(task: ColumnTask) -> None:
    key = key_of(task, "program")
    assert key_of(replace(task), "program") == key
    assert task.design is not None
    learned = CameraProfile(
        "c.toml", "", "1", "", "2026-01-01", 90, PINHOLE, (1.0, 2.0), (0.0, 1.0), Measure(1e-4, 1e-5)
    )
    shifted = replace(task.design.sleeves[0], centre=np.nextafter(task.design.sleeves[0].centre, 1e9))
    others = [
        replace(task, settings=replace(task.settings, method="fusion")),
        replace(task, settings=replace(task.settings, turns=True)),
        replace(task, units="m"),
        replace(task, depth_scale_mm=0.02),
        replace(task, camera=PINHOLE),
        replace(task, column=replace(task.column, sleeves_up_deg=17.0)),
        replace(task, design=replace(task.design, sleeves=(shifted, *task.design.sleeves[1:]))),
        replace(task, design=None, no_design="none"),
        replace(task, learned=learned),
        replace(task, learned=replace(learned, scale=Measure(2e-4, 1e-5)), learned_notes=("old",)),
    ]

    keys = {key_of(other, "program") for other in others} | {key_of(task, "another"), key}
    assert len(keys) == len(others) + 2
    scan = task.folder / "foot.ply"
    content = scan.read_bytes()
    status = scan.stat()
    scan.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    # Size and time say nothing about what is in a file.
    os.utime(scan, ns=(status.st_atime_ns, status.st_mtime_ns))
    changed = key_of(task, "program")
    scan.unlink()
    missing = key_of(task, "program")
    scan.write_bytes(content)
    assert len({key, changed, missing}) == 3
    assert key_of(task, "program") == key


def test_the_key_does_not_follow_the_place(task: ColumnTask, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    for name in task.column.files():
        (elsewhere / name).write_bytes((task.folder / name).read_bytes())
    assert key_of(replace(task, folder=elsewhere), "p") == key_of(task, "p")


def test_the_content_of_folders_and_of_what_is_no_file(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "depth.tiff").write_bytes(b"depth")
    assert content_hash(tmp_path / "one") == content_hash(tmp_path / "two")
    (tmp_path / "two" / "depth.tiff").rename(tmp_path / "two" / "other.tiff")
    assert content_hash(tmp_path / "one") != content_hash(tmp_path / "two")
    assert content_hash(tmp_path / "nowhere") == "no file to be read"
    assert content_hash(Path("/dev/zero")) == "no file to be read"
    assert content_hash(Path("nul\0l")) in {"no file to be read", "unreadable: "}


def test_files_that_travel(task: ColumnTask, tmp_path: Path) -> None:
    """They arrive with their content, and no name decides where they are written."""
    folder = task.folder / "capture"
    folder.mkdir()
    (folder / "depth.tiff").write_bytes(b"depth")
    column = replace(task.column, sleeves=("../outside.ply", "capture"), rebars=("bars.ply", "nowhere.ply"))
    (task.folder / ".." / "outside.ply").write_bytes(b"outside")
    there = tmp_path / "there"
    there.mkdir()
    files = read_for_shipping(replace(task, column=column))
    places = unpack(files, there)
    moved = replace(task, column=column).at(places)
    assert moved.path_of("../outside.ply").read_bytes() == b"outside"
    assert (moved.path_of("capture") / "depth.tiff").read_bytes() == b"depth"
    assert moved.path_of("bars.ply").suffix == ".ply"
    assert {path.resolve().is_relative_to(there.resolve()) for path in places.values()} == {True}
    assert "nowhere.ply" not in places


def test_looks_follow_whatever_is_done_to_a_file(task: ColumnTask) -> None:
    order, scan = order_key(task, "program"), task.folder / "foot.ply"
    first, content, status = looks(task, order), scan.read_bytes(), scan.stat()
    assert looks(task, order) == first
    assert looks(task, order_key(task, "another")).hash != first.hash
    # The same size, and the time of change set back: the system's own time tells.
    scan.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    os.utime(scan, ns=(status.st_atime_ns, status.st_mtime_ns))
    falsified = looks(task, order)
    assert scan.stat().st_mtime_ns == status.st_mtime_ns
    other = scan.with_suffix(".new")
    other.write_bytes(content)
    other.replace(scan)
    replaced = looks(task, order)
    assert len({first.hash, falsified.hash, replaced.hash}) == 3
    scan.unlink()
    assert looks(task, order).hash == ""


def test_looks_tell_nothing_of_a_file_that_was_just_changed(task: ColumnTask) -> None:
    found = looks(task, order_key(task, "program"))
    now_ns = max((task.folder / name).stat().st_ctime_ns for name in task.column.files())
    assert not found.tell_at(now_ns + 1)
    assert found.tell_at(now_ns + 3_000_000_000)


def test_looks_of_a_capture_are_those_of_its_files(task: ColumnTask) -> None:
    folder = task.folder / "capture"
    folder.mkdir()
    (folder / "depth.tiff").write_bytes(b"depth")
    task = replace(task, column=replace(task.column, sleeves=("capture",)))
    order = order_key(task, "program")
    first = looks(task, order)
    (folder / "depth.tiff").write_bytes(b"death")
    second = looks(task, order)
    (folder / "intrinsics.toml").write_bytes(b"")
    assert len({first.hash, second.hash, looks(task, order).hash}) == 3
