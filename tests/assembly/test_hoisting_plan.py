"""Where to put the camera: what a plan promises is what the virtual camera then shows."""

from __future__ import annotations

import json

import numpy as np
import pytest

from aadm_workbench.assembly.hoisting_plan import plan_camera
from aadm_workbench.hoisting import measure_hoisting
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.hoisting import Hang, Stand
from aadm_workbench.twin.scenes import LAB
from aadm_workbench.twin.study.hoisting import design_of
from batch.main import main
from tests import hoisting_scenes as scenes


def test_a_small_column_needs_one_frame() -> None:
    plan, views = plan_camera(design_of(LAB), PRO_M, height_mm=150.0, wanted_u_mm=0.15)
    assert len(plan.views) == 1
    assert plan.views[0].u_mm < 0.15
    assert set(plan.seen) == {f"S{k}" for k in range(1, 13)}
    assert views[-1].u_mm > views[0].u_mm  # the farther away, the less sure


def test_what_is_planned_is_seen() -> None:
    pytest.importorskip("open3d")
    pytest.importorskip("manifold3d")
    plan, _ = plan_camera(design_of(LAB), PRO_M, height_mm=150.0, wanted_u_mm=0.15)
    view = plan.views[0]
    truth = scenes.frame(LAB, Hang(150.0), Stand(view.distance_mm, view.below_tops_mm), 8)
    found = measure_hoisting(truth.frame.scan(), design_of(LAB), near=scenes.NEAR)
    seen = {pair.sleeve for pair in found.report.pairs if pair.sleeve_seen}
    assert seen == set(view.sleeves)
    assert np.median([pair.u_mm for pair in found.report.pairs if pair.seen]) < 1.5 * view.u_mm


def test_a_large_column_needs_two_frames(capsysbinary: pytest.CaptureFixture[bytes]) -> None:
    size = ["--size", "1000", "--per-side", "5", "--sleeve-diameter", "40", "--rebar-diameter", "25"]
    assert main(["plan", *size, "--height", "250", "--u", "0.15", "--json"]) == 0
    plan = json.loads(capsysbinary.readouterr().out)["plan"]
    assert len(plan["views"]) == 2
    first, second = (set(view["sleeves"]) for view in plan["views"])
    assert len(first | second) == 16
    assert first != second


def test_what_cannot_be_had_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plan", "--size", "600", "--u", "0.01"]) == 11
    assert "no place gives u = 0.01 mm" in capsys.readouterr().out
