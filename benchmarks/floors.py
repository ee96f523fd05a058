"""Jobs of many columns, made from the scans of the sample floor: as large as a shipment, without its disk space."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import cv2

from aadm_workbench.design.read import read_model
from aadm_workbench.inspection.job import Job
from aadm_workbench.model import Camera, ColumnDesign
from aadm_workbench.scan.write import write_depth_tiff
from batch.job.file import read_job

SAMPLE = Path(__file__).resolve().parents[1] / "samples" / "floor"
SOUND = {"C-301": "+y", "C-302": "+y", "C-303": "+y", "C-305": "-x", "C-307": "+y"}
"""Columns of the sample whose two scans can be measured, and how they lie."""

SMALL = 8
"""Small scans keep every so many-th pixel of every so many-th row."""


def write_floor(folder: Path, columns: int, *, shrink: int = 1, linked: bool = True) -> Path:
    """Write a job of some columns, each with its own two scans and its own design; returns the job file.

    Parameters
    ----------
    shrink
        Keep one pixel in so many, in both directions; 1 for the 2.3 megapixels of the sample.
    linked
        Whether equal scans share their place on the disk; without, each is a file of its own, with a number behind
        its end, so that no two columns have the same scan, and each can be changed alone.
    """
    job = read_job(SAMPLE / "job.toml")
    assert job.camera is not None
    assert job.depth_scale_mm is not None
    scans = folder / "scans"
    scans.mkdir(parents=True)
    model = read_model(SAMPLE / "floor3.ifc")
    originals = {name: _original(scans, name, shrink, job.depth_scale_mm) for name in SOUND}
    texts = [_head(job.camera, job, shrink)]
    for number in range(columns):
        name = list(SOUND)[number % len(SOUND)]
        for kind, original in originals[name].items():
            scan = scans / f"K-{number:04d}-{kind}.tiff"
            if linked:
                os.link(original, scan)
            else:
                scan.write_bytes(original.read_bytes() + number.to_bytes(4, "big"))
        texts.append(_column(number, SOUND[name], model.column(name)))
    path = folder / "job.toml"
    path.write_text("\n".join(texts), encoding="utf-8")
    return path


def _original(folder: Path, name: str, shrink: int, depth_scale_mm: float) -> dict[str, Path]:
    found = {}
    for kind in ("foot", "bars"):
        found[kind] = folder / f"original-{name}-{kind}.tiff"
        source = SAMPLE / "scans" / f"{name}-{kind}.tiff"
        if shrink == 1:
            shutil.copyfile(source, found[kind])
        else:
            depth_mm = cv2.imread(str(source), cv2.IMREAD_UNCHANGED)[::shrink, ::shrink] * depth_scale_mm
            write_depth_tiff(found[kind], depth_mm, depth_scale_mm)
    return found


def _head(camera: Camera, job: Job, shrink: int) -> str:
    return f"""schema = 1
name = "A shipment"
units = "mm"
tolerances = "cn"

[camera]
fx = {camera.fx / shrink!r}
fy = {camera.fy / shrink!r}
cx = {camera.cx / shrink!r}
cy = {camera.cy / shrink!r}
width = {-(-camera.width // shrink)}
height = {-(-camera.height // shrink)}
depth_scale_mm = {job.depth_scale_mm!r}
"""


def _column(number: int, up: str, design: ColumnDesign) -> str:
    centres = [[float(point.centre[0]), float(point.centre[1])] for point in design.sleeves]
    width_mm, depth_mm = design.size_mm or (600.0, 600.0)
    return f"""[[columns]]
id = "K-{number:04d}"
sleeves = "scans/K-{number:04d}-foot.tiff"
rebars = "scans/K-{number:04d}-bars.tiff"
up = "{up}"
[columns.design]
sleeve_diameter = {design.sleeves[0].diameter_mm!r}
rebar_diameter = {design.rebars[0].diameter_mm!r}
size = [{width_mm!r}, {depth_mm!r}]
centres = {centres!r}
"""
