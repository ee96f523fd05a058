"""Where to put the camera: what a plan promises is what the virtual camera then shows."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from aadm_workbench.hoisting.measure import measure_hoisting
from aadm_workbench.hoisting.plan import plan_camera
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.hoisting import Hang, Stand
from aadm_workbench.twin.scenes import FIELD, LAB
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


BIG = ["--size", "1400", "--per-side", "6", "--sleeve-diameter", "40", "--rebar-diameter", "25"]


def test_with_scans_from_before_one_frame_is_enough_for_a_column_of_1400_mm(
    capsysbinary: pytest.CaptureFixture[bytes],
) -> None:
    assert main(["plan", *BIG, "--json"]) == 11
    assert "no place gives u = 0.2 mm" in json.loads(capsysbinary.readouterr().out)["plan"]["reason"]
    assert main(["plan", *BIG, "--before", "--json"]) == 0
    plan = json.loads(capsysbinary.readouterr().out)["plan"]
    (view,) = plan["views"]
    assert plan["u_mm"] == view["u_of_all_mm"] <= 0.2
    assert len(plan["seen"]) == 20
    assert main(["plan", *BIG, "--before", "0.4", "--json"]) == 11  # no frame mends what was scanned badly
    assert "scan more surely" in json.loads(capsysbinary.readouterr().out)["plan"]["reason"]


def test_what_is_promised_of_hidden_pairs_is_what_laying_scans_on_a_frame_comes_to() -> None:
    """Simulated: places known to 0.1 mm are laid on those that a frame shows by least squares, then averaged."""
    before_mm, rng = 0.1, np.random.default_rng(4)
    plan, _ = plan_camera(design_of(FIELD), PRO_M, height_mm=150.0, wanted_u_mm=0.3, before_mm=before_mm)
    (view,) = plan.views
    design = design_of(FIELD)
    errors = []
    for _ in range(400):
        parts = []
        for points, labels, u_mm in ((design.sleeves, view.sleeves, view.u_mm), (design.rebars, view.rebars, 0.075)):
            true = np.array([point.centre[:2] for point in points])
            seen = np.array([point.label in labels for point in points])
            known = true + rng.normal(0.0, before_mm, true.shape)
            shown = true[seen] + rng.normal(0.0, u_mm, (int(seen.sum()), 2))
            flat = [np.pad(part - part.mean(axis=0), ((0, 0), (0, 1))) for part in (shown, known[seen])]
            rigid = Rotation.align_vectors(*flat)[0].as_matrix()[:2, :2]
            laid = (known - known[seen].mean(axis=0)) @ rigid.T + shown.mean(axis=0)
            parts.append(laid - true)
        errors.append(parts[1] - parts[0])
    by_pair = np.sqrt((np.array(errors) ** 2).mean(axis=(0, 2)))
    assert view.u_of_all_mm is not None
    assert 0.7 * by_pair.max() < view.u_of_all_mm < 1.1 * by_pair.max()
