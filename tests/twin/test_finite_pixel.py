"""A pixel that has a size, on a plate that ends in the middle of the image, the projector to its right."""

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.model import Camera
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.finite_pixel import FinitePixel
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.surface import CONCRETE, Surface, joined, one_kind

pytest.importorskip("open3d")
from aadm_workbench.twin.scene import shot

CAMERA = Camera(PRO_M.fx, PRO_M.fy, 40.3, 99.5, 80, 200)
QUIET = CameraNoise(
    depth_at_1m=0.0,
    warp=0.0,
    random_loss=0.0,
    outliers=0.0,
    step_loss=0.0,
    step_fly=0.0,
    wall_loss=0.0,
    grazing_full=0.01,
    grazing_none=0.0,
)
PIXEL = FinitePixel(slips=0.0, ghosts=0.0)
FRONT_MM, BACK_MM = 1300.0, 1700.0
PER_PIXEL_MM = FRONT_MM**2 / 270.0 / CAMERA.fx


def plate(x: tuple[float, float], z: float) -> Surface:
    corners = np.array([[a, b, z] for a in x for b in (-900.0, 900.0)])
    return one_kind(corners, np.array([[0, 1, 2], [1, 3, 2]]), CONCRETE)


def taken(pixel: FinitePixel | None, left: bool) -> np.ndarray:
    """Depth map of a plate on one side of x = 0 with nothing behind it."""
    surface = plate((-400.0, 0.0) if left else (0.0, 400.0), FRONT_MM)
    return np.asarray(
        shot(surface, (), np.eye(4), replace(QUIET, pixel=pixel), np.random.default_rng(1), CAMERA).depth, np.float64
    )


@pytest.mark.parametrize(("left", "sign"), [(False, 1.0), (True, -1.0)])
def test_the_edge_curls_by_the_middle_of_its_lit_part(left: bool, sign: float) -> None:
    depth = taken(PIXEL, left)
    for column in (39, 40, 41):
        # The lit part of a normal distribution of places about the pixel's middle, cut at x = 0.
        places = column - CAMERA.cx + PIXEL.spread_px * np.random.default_rng(2).normal(size=200_000)
        lit = places < 0.0 if left else places > 0.0
        if lit.mean() < 0.15:
            continue
        expected = (places[lit].mean() - (column - CAMERA.cx)) * PER_PIXEL_MM
        assert sign * expected > 0.0
        assert np.nanmean(depth[:, column]) - FRONT_MM == pytest.approx(expected, abs=0.15 * PER_PIXEL_MM)
    assert np.abs(depth[:, 50:] - FRONT_MM if not left else depth[:, :30] - FRONT_MM).max() < 1e-3


def test_without_curl_and_overhang_the_depths_are_those_of_a_point() -> None:
    plain = replace(PIXEL, curl=False, overhang=False)
    np.testing.assert_allclose(taken(plain, True), taken(None, True), atol=1e-3)


def test_rays_that_just_miss_still_return_the_edge() -> None:
    missed = 41  # its middle lies 0.7 px beyond the edge of the plate on the left
    assert np.isnan(taken(None, True)[:, missed]).all()
    assert np.isfinite(taken(PIXEL, True)[:, missed]).mean() > 0.5
    assert np.isnan(taken(PIXEL, True)[:, missed + 2 :]).all()


def test_slips_are_nearer_and_where_two_depths_mix() -> None:
    surface = joined([plate((-400.0, 0.0), FRONT_MM), plate((-900.0, 900.0), BACK_MM)])
    noise = replace(QUIET, pixel=replace(PIXEL, slips=0.5))
    depth = shot(surface, (), np.eye(4), noise, np.random.default_rng(1), CAMERA).depth
    slipped = np.nanmin(np.stack([np.abs(depth - FRONT_MM), np.abs(depth - BACK_MM)]), axis=0) > 20.0
    assert slipped.any()
    assert set(np.nonzero(slipped)[1]) <= {38, 39, 40, 41, 42}
    assert (depth[slipped] < BACK_MM - 50.0 + 20.0).all()


def test_a_pixel_without_size_is_the_default() -> None:
    assert CameraNoise().pixel is None
    assert CameraNoise.drawn(np.random.default_rng(1)).pixel is None
