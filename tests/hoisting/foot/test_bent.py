"""A foot that is bowed and twisted: its sleeves are where they are, and a plane one is left as it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.hoisting.foot.bent import bent_face
from aadm_workbench.hoisting.foot.face import FootFace
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.hoisting.measure import measure_hoisting
from aadm_workbench.model import Array
from aadm_workbench.twin.hoisting import Hang, Stand, hoisting_scan
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import Cast
from aadm_workbench.twin.scenes import FIELD, random_bars, random_foot
from aadm_workbench.twin.study.hoisting import design_of
from tests import hoisting_scenes as scenes

EYE_MM, RADIUS_MM = np.array([-1500.0, 0.0, -260.0]), 18.0
MOUTHS = np.array([[240.0 * x, 240.0 * y] for x in (-1, -0.33, 0.33, 1) for y in (-1, -0.33, 0.33, 1)])
LENS = (1200.0, 1200.0, 640.0, 400.0)


def seen(bow_per_mm: float, noise_mm: float) -> tuple[HoistingFrame, FootFace]:
    """A face z = bow·(x² + y²) seen from below as polar rays meet it, and the plane that a search found for it."""
    rng = np.random.default_rng(3)
    ahead = np.array([1500.0, 0.0, 260.0]) / np.hypot(1500.0, 260.0)
    right = np.array([0.0, -1.0, 0.0])
    axes = np.vstack([right, np.cross(ahead, right), ahead])
    u, v = np.meshgrid((np.arange(1280) - LENS[2]) / LENS[0], (np.arange(800) - LENS[3]) / LENS[1])
    rays = np.stack([u, v, np.ones_like(u)], axis=-1) @ axes
    a = bow_per_mm * (rays[..., 0] ** 2 + rays[..., 1] ** 2)
    b = 2.0 * bow_per_mm * (rays[..., :2] @ EYE_MM[:2]) - rays[..., 2]
    c = bow_per_mm * float(EYE_MM[:2] @ EYE_MM[:2]) - EYE_MM[2]
    with np.errstate(all="ignore"):
        reach = -c / b if bow_per_mm == 0.0 else 2.0 * c / (-b + np.sqrt(b * b - 4.0 * a * c))
        points = EYE_MM + rays * reach[..., None]
        points[..., 2] += rng.normal(0.0, noise_mm, reach.shape)
        outside = ~((reach > 0) & (np.abs(points[..., :2]) < 300.0).all(axis=-1))
    points[outside] = np.nan
    in_frame = (points - EYE_MM) @ axes.T
    face = FootFace(axes.T, axes @ -EYE_MM, MOUTHS, 0.1)
    return HoistingFrame(in_frame.astype(np.float32), LENS, np.eye(4)), face


def heights(face: FootFace, places: Array) -> Array:
    """Heights (n,) of a bent face over the plane z = 0 of the scene, whose axes are those of ``seen``."""
    back = seen(0.0, 0.1)[1]
    levels = np.array([face.level(place)[0] for place in places])
    return np.asarray(back.local(face.to_frame(np.column_stack([places, levels])))[:, 2])


def test_how_a_face_bows_is_found_in_what_is_seen_of_it() -> None:
    bow = 2.0 / 300.0**2
    found = bent_face(*seen(bow, 0.1), RADIUS_MM)
    np.testing.assert_allclose(heights(found, MOUTHS), bow * (MOUTHS**2).sum(axis=1), atol=0.03)
    slopes = np.array([found.level(place)[1] for place in MOUTHS])
    np.testing.assert_allclose(slopes - slopes.mean(axis=0), 2.0 * bow * MOUTHS, atol=5e-4)


def test_a_plane_face_stays_plane() -> None:
    found = bent_face(*seen(0.0, 0.1), RADIUS_MM)
    assert found.bend_mm < 0.002
    np.testing.assert_allclose(heights(found, MOUTHS), 0.0, atol=0.005)


def test_sleeves_of_a_bent_foot_are_measured_as_those_of_a_plane_one() -> None:
    rng = np.random.default_rng([556, 1])
    foot = replace(random_foot(FIELD, rng), cast=Cast(bow=2.2, warp=-1.6))
    hang, noise = Hang(140.0, 0.5, shift=(1.0, -1.5), tilt=0.2), CameraNoise.drawn(rng)
    truth = hoisting_scan(foot, random_bars(FIELD, rng), hang, Stand(720.0), noise, rng)
    found = measure_hoisting(truth.frame.scan(), design_of(FIELD), near=scenes.NEAR)
    assert float(found.report.quality["face_bend_mm"]) == pytest.approx(0.5, abs=0.25)
    assert found.report.column_tilt_deg == pytest.approx(truth.tilt_deg, abs=0.06)
    off = scenes.offset_errors(found, truth)
    known = np.array([pair.seen for pair in found.report.pairs])
    assert known.sum() >= 8
    assert np.hypot(*off[known].T).mean() < 0.25  # 0.6 where its face is taken for a plane
    squared = np.einsum("ki,kij,kj->k", off, np.linalg.inv(found.covariances), off)
    assert (squared < 18.4).all()  # one of ten thousand is farther
