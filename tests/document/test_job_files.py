"""Job files as a panel reads and writes them, and scans found by name: no FreeCAD is needed for either."""

import tomllib
from datetime import date
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.document.job.scan_names import guessed_kind, owners_of, scans_by_name
from aadm_workbench.document.job.toml import job_toml, read_job_table
from aadm_workbench.errors import JobError
from batch.job.file import read_job
from tests.conftest import ROOT

DAY = date(2026, 5, 1)
JOBS = sorted((ROOT / "samples").glob("*/job.toml"))


SIGNS = list("ab\"'\\\t\n\x00\x7f\x1b柱 #=[]{}.\u2028")


def some_text(dice: np.random.Generator) -> str:
    """A text with signs that TOML wants escaped."""
    return "".join(dice.choice(SIGNS, size=int(dice.integers(8))))


def some_value(dice: np.random.Generator, depth: int = 0) -> object:
    """Any value that TOML knows."""
    kind = int(dice.integers(5 if depth > 2 else 8))
    if kind == 0:
        return some_text(dice)
    if kind <= 4:
        return (bool(dice.integers(2)), int(dice.integers(-(2**62), 2**62)), float(dice.normal(0.0, 1e12)), DAY)[
            kind - 1
        ]
    if kind == 5:
        return [some_value(dice, depth + 1) for _ in range(int(dice.integers(4)))]
    table = {some_text(dice): some_value(dice, depth + 1) for _ in range(3)}
    return [table, {}] if kind == 6 else table


@pytest.mark.parametrize("seed", range(20))
def test_what_is_written_is_read_back(seed: int) -> None:
    dice = np.random.default_rng(seed)
    table = {f"key {number}" if number % 2 else f"key{number}": some_value(dice) for number in range(10)}
    assert tomllib.loads(job_toml(table)) == table


@pytest.mark.parametrize("job", JOBS, ids=[job.parent.name for job in JOBS])
def test_job_written_anew_is_the_same_job(job: Path, tmp_path: Path) -> None:
    anew = tmp_path / "anew.toml"
    anew.write_text(job_toml(read_job_table(job)), encoding="utf-8")
    before, after = read_job(job), read_job(anew)
    assert [(one.id, one.sleeves, one.rebars, one.sleeves_up_deg) for one in after.columns] == [
        (one.id, one.sleeves, one.rebars, one.sleeves_up_deg) for one in before.columns
    ]
    assert (after.camera, after.model, after.units, after.capture, after.decision) == (
        before.camera,
        before.model,
        before.units,
        before.capture,
        before.decision,
    )


@pytest.mark.parametrize("text", ["", "schema = 1", "columns = 3", "[[columns]]\nsleeves = 'x'", "a = ", "\xff"])
def test_what_is_no_job_gets_a_sentence(text: str, tmp_path: Path) -> None:
    (tmp_path / "job.toml").write_bytes(text.encode("latin-1"))
    with pytest.raises(JobError, match=r"job\.toml: is no job file"):
        read_job_table(tmp_path / "job.toml")


@pytest.mark.parametrize(
    ("name", "kind"),
    [("C-1-foot.tiff", "sleeves"), ("C-1_Rebar.ply", "rebars"), ("柱1-套筒.ply", "sleeves"), ("钢筋.tif", "rebars"),
     ("C-1.ply", "")],
)  # fmt: skip
def test_kind_is_taken_from_the_name(name: str, kind: str) -> None:
    assert guessed_kind(name) == kind


def test_name_counts_where_it_stands_alone() -> None:
    names = {"a": ["C-30"], "b": ["C-301"], "c": ["Z 7"]}
    assert owners_of("c_301 foot.ply", names) == ["b"]
    assert owners_of("C-30-foot.ply", names) == ["a"]
    assert owners_of("z-7_bars.ply", names) == ["c"]
    assert owners_of("C-30 and C-301.ply", names) == ["a", "b"]


def test_scans_of_a_folder(tmp_path: Path) -> None:
    for name in (
        "C-1-foot.tiff", "C-1-foot.png", "C-1-bars-2.ply", "C-1-bars-1.ply", "C-2/foot.ply", "C-2/bars/depth.tiff",
        "C-2/bars/camera.json", "C-3.ply", "notes.txt", "C-1 and C-2 foot.ply", ".C-3-foot.ply",
    ):  # fmt: skip
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    found = scans_by_name(tmp_path, {name: [name] for name in ("C-1", "C-2", "C-3")})
    shown = {
        key: [[path.relative_to(tmp_path).as_posix() for path in files] for files in two] for key, two in found.items()
    }
    assert shown == {
        # The picture beside a depth map is none of its own; two views of bars stay two.
        "C-1": [["C-1-foot.tiff"], ["C-1-bars-1.ply", "C-1-bars-2.ply"]],
        # A folder that is called like a scan is a capture.
        "C-2": [["C-2/foot.ply"], ["C-2/bars"]],
        "C-3": [[], []],
    }
