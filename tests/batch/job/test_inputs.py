"""The key of a column: another one as soon as anything changes that its result follows from, and nothing else."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.inspection.job import JobColumn
from aadm_workbench.inspection.measure import CheckSettings
from aadm_workbench.inspection.tasks import ColumnTask
from aadm_workbench.model import Camera
from batch.job.file import read_job
from batch.job.inputs import content_hash, read_for_shipping, task_key, unpack
from tests.batch.conftest import WriteJob, column_text


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
    key = task_key(task, "program")
    assert task_key(replace(task), "program") == key
    assert task.design is not None
    shifted = replace(task.design.sleeves[0], centre=np.nextafter(task.design.sleeves[0].centre, 1e9))
    others = [
        replace(task, settings=replace(task.settings, method="fusion")),
        replace(task, settings=replace(task.settings, turns=True)),
        replace(task, units="m"),
        replace(task, depth_scale_mm=0.02),
        replace(task, camera=Camera(1.0, 1.0, 1.0, 1.0, 2, 2)),
        replace(task, column=replace(task.column, sleeves_up_deg=17.0)),
        replace(task, design=replace(task.design, sleeves=(shifted, *task.design.sleeves[1:]))),
        replace(task, design=None, no_design="none"),
    ]
    keys = {task_key(other, "program") for other in others} | {task_key(task, "another"), key}
    assert len(keys) == len(others) + 2
    scan = task.folder / "foot.ply"
    content = scan.read_bytes()
    status = scan.stat()
    scan.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    # Size and time say nothing about what is in a file.
    os.utime(scan, ns=(status.st_atime_ns, status.st_mtime_ns))
    changed = task_key(task, "program")
    scan.unlink()
    missing = task_key(task, "program")
    scan.write_bytes(content)
    assert len({key, changed, missing}) == 3
    assert task_key(task, "program") == key


def test_the_key_does_not_follow_the_place(task: ColumnTask, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    for name in task.column.files():
        (elsewhere / name).write_bytes((task.folder / name).read_bytes())
    assert task_key(replace(task, folder=elsewhere), "p") == task_key(task, "p")


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
