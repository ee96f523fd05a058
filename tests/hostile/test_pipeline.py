"""A night's job in which most scans mean harm: each costs its own column, and none costs more than that."""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .hostile_scans import CLOUDS, DEPTH_MAPS, OF_SOMETHING_ELSE, READABLE, Writer, png

ROOT = Path(__file__).resolve().parents[2]
LAB = ROOT / "samples" / "lab" / "scans"
MEMORY_BYTES = 3 * 2**30
"""Address space, of which the program itself takes one: no file of these may need more than a frame does."""

DESIGN = """up = "+y"
[columns.design]
sleeve_diameter = 26.0
rebar_diameter = 18.0
rebar_outer_diameter = 20.0
embedded_length = 100.0
size = [250.0, 250.0]
centres = [[-90.0, -90.0], [-30.0, -90.0], [30.0, -90.0], [90.0, -90.0], [90.0, -30.0], [90.0, 30.0], [90.0, 90.0],
 [30.0, 90.0], [-30.0, 90.0], [-90.0, 90.0], [-90.0, 30.0], [-90.0, -30.0]]
"""
CAMERA = "[camera]\nfx = 800.0\nfy = 800.0\ncx = 320.0\ncy = 240.0\nwidth = 640\nheight = 480\ndepth_scale_mm = 0.1\n"


def column(name: str, **scans: str) -> str:
    lines = [
        f"[[columns]]\nid = {json.dumps(name)}\n",
        *(f"{key} = {json.dumps(scan)}\n" for key, scan in scans.items()),
    ]
    return "".join([*lines, DESIGN])


@dataclass(frozen=True)
class Night:
    """What a job came to, and what its folder holds afterwards that it did not hold before."""

    code: int
    said: str
    columns: dict[str, Any]
    text: str
    new_files: frozenset[str]


def everything_in(folder: Path) -> frozenset[str]:
    return frozenset(str(path.relative_to(folder)) for path in folder.rglob("*"))


def checked(folder: Path, job: str, *arguments: str, method: str = "refined") -> Night:
    """Check a job in a process with little memory."""
    path = folder / "job" / "job.toml"
    path.write_text(f'schema = 1\nunits = "mm"\n{job}', encoding="utf-8")
    before = everything_in(folder)
    done = subprocess.run(
        [sys.executable, "-m", "aadm_batch", "check", str(path), "--jobs", "1", "--method", method, *arguments],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=240,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES)),
    )
    said = (done.stdout + done.stderr).decode("utf-8", errors="replace")
    report = path.parent / "job-report" / "report.json"
    assert report.exists(), said
    text = report.read_text(encoding="utf-8")
    columns = {entry["id"]: entry for entry in json.loads(text)["columns"]}
    return Night(done.returncode, said, columns, text, everything_in(folder) - before)


def write_all(folder: Path, writers: Mapping[str, Writer]) -> dict[str, str]:
    (folder / "job").mkdir()
    return {name: write(folder / "job") for name, write in writers.items()}


def test_a_night_of_hostile_clouds(tmp_path: Path) -> None:
    """All of them, as a foot and some as bars, before and after a column that is sound; in one run, to save time."""
    scans = write_all(tmp_path, CLOUDS)
    sound = {"sleeves": str(LAB / "L-1-foot.ply"), "rebars": str(LAB / "L-1-bars.pcd")}
    hostile = [column(name, sleeves=scan) for name, scan in scans.items()]
    hostile += [column(f"{name} bars", rebars=scans[name]) for name in sorted(READABLE)]
    other = {"sleeves": str(LAB / "L-2-foot.pcd"), "rebars": str(LAB / "L-2-bars.ply")}
    night = checked(tmp_path, "".join([column("first", **sound), *hostile, column("last", **other)]))
    assert night.code == 12
    sound_reports = [night.columns.pop(name) for name in ("first", "last")]
    assert [report["verdict"] for report in sound_reports] == ["pass", "pass"]
    assert len(night.columns) == len(CLOUDS) + len(READABLE)
    for name, found in night.columns.items():
        check_hostile_column(name.removesuffix(" bars"), scans[name.removesuffix(" bars")], found)
    check_that_nothing_else_happened(night)
    assert sound_reports[0]["sleeves"]["source"] == "L-1-foot.ply"


def check_hostile_column(name: str, scan: str, found: Mapping[str, Any]) -> None:
    allowed = {"error", "not_measured"} | ({"fail", "inconclusive"} if name in OF_SOMETHING_ELSE else set())
    assert found["verdict"] in allowed, (name, found["verdict"], found["reasons"])
    assert found["reasons"], name
    if found["verdict"] == "error":
        assert found["reasons"][0].startswith(scan), (name, found["reasons"])
    else:
        assert (found["sleeves"] or found["rebars"])["source"] == scan
    assert "internal error" not in found["reasons"][0], (name, found["reasons"])
    assert "not enough memory" not in found["reasons"][0], name


def check_that_nothing_else_happened(night: Night) -> None:
    """Nothing is written elsewhere, nothing is shown of the program's inside or of the disk."""
    assert {name for name in night.new_files if not name.startswith("job/job-report")} == set()
    assert "Traceback" not in night.said
    assert str(ROOT) not in night.text
    assert str(LAB) not in night.text
    assert "/pytest-" not in night.text


def test_depth_maps_that_lie(tmp_path: Path) -> None:
    scans = write_all(tmp_path, DEPTH_MAPS)
    (tmp_path / "job" / "bomb.png").write_bytes(png(60_000, 60_000))
    jobs = [column(name, sleeves=scan) for name, scan in scans.items()]
    jobs.append(column("image", sleeves="short.png", sleeves_image="bomb.png"))
    night = checked(tmp_path, CAMERA + "".join(jobs))
    assert night.code == 12
    for name, scan in scans.items():
        assert night.columns[name]["verdict"] == "error"
        assert night.columns[name]["reasons"][0].startswith(scan)
        assert "internal error" not in night.columns[name]["reasons"][0]
