"""What a site does to parts, and what a job says that is not so."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Camera
from aadm_workbench.twin.blocks import rough_block, rough_heights
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.parts import Roughness
from aadm_workbench.twin.scene import TrueScan
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot
from aadm_workbench.twin.site import SITE, left_by_site
from aadm_workbench.twin.slips import Slip, seen_with, slip_of, told_camera

GRID = np.linspace(-100.0, 100.0, 201)


@pytest.mark.parametrize("roughness", [Roughness(6.0, 10.0), Roughness(8.0, 30.0, "keyed")])
def test_a_rough_face_lies_within_its_depth_and_uses_it(roughness: Roughness) -> None:
    height = rough_heights(GRID, GRID, roughness)
    assert height.min() == pytest.approx(0.0, abs=1e-9)
    assert height.max() == pytest.approx(roughness.depth)


def test_a_washed_face_has_grains_of_its_size_and_another_for_each_seed() -> None:
    first, second = (rough_heights(GRID, GRID, Roughness(6.0, 12.0, seed=seed)) for seed in (1, 2))
    apart = [np.corrcoef(first[:, :-lag].ravel(), first[:, lag:].ravel())[0, 1] for lag in (3, 12)]
    assert apart[0] > 0.6
    assert apart[1] < 0.1
    assert abs(np.corrcoef(first.ravel(), second.ravel())[0, 1]) < 0.2


def test_a_rough_block_is_closed_and_lacks_what_was_washed_off() -> None:
    block = rough_block((80.0, 60.0), 50.0, Roughness(8.0, 20.0, "keyed"))
    # Pockets half as wide as their pitch take a quarter of the face, as far as its edges cut none.
    assert 80.0 * 60.0 * 42.0 < block.volume() < 80.0 * 60.0 * 50.0
    assert block.genus() == 0


@pytest.mark.parametrize("name", SITE)
def test_a_site_changes_one_part_and_leaves_every_centre(name: str) -> None:
    rng = np.random.default_rng(3)
    foot, bars = random_foot(LAB, rng), random_bars(LAB, rng)
    left, stood = left_by_site([name], foot, bars, rng)
    assert (left == foot) != (stood == bars)
    assert [(s.x, s.y) for s in left.sleeves] == [(s.x, s.y) for s in foot.sleeves]
    assert [(b.x, b.y) for b in stood.bars] == [(b.x, b.y) for b in bars.bars]


def test_a_mirrored_picture_shows_what_the_mirrored_scene_would() -> None:
    depth = np.array([[1.0, 2.0, 3.0, 4.0]], np.float32) * 1000.0
    camera = Camera(2000.0, 2000.0, 1.2, 0.0, 4, 1)
    seen = TrueScan(depth, camera, (), np.eye(4))
    flipped = seen_with(seen, Slip(mirrored=True), np.random.default_rng(0))
    straight, turned = (one.scan().points.reshape(-1, 3) for one in (seen, flipped))
    assert turned[::-1] == pytest.approx(straight * [-1.0, 1.0, 1.0], abs=1e-3)


def test_bars_and_sleeves_of_another_size_are_all_of_one() -> None:
    rng = np.random.default_rng(5)
    foot, bars = random_foot(LAB, rng), random_bars(LAB, rng)
    wide, thick = left_by_site(["other-sleeves", "other-bars"], foot, bars, rng)
    for ratio in (
        {round(b.diameter / a.diameter, 6) for a, b in zip(foot.sleeves, wide.sleeves, strict=True)},
        {round(b.core_diameter / a.core_diameter, 6) for a, b in zip(bars.bars, thick.bars, strict=True)},
    ):
        assert ratio in ({1.2}, {round(1.0 / 1.2, 6)})


def test_slips_add_up_and_unknown_ones_are_refused_with_those_that_there_are() -> None:
    assert slip_of(["focal-half", "no-floor"]) == Slip(focal=0.5, floor=False)
    camera = told_camera(PRO_M, Slip(focal=0.5, principal_px=(80.0, -80.0)))
    assert (camera.fx, camera.cx, camera.cy) == (PRO_M.fx / 2, PRO_M.cx + 80.0, PRO_M.cy - 80.0)
    with pytest.raises(AadmError, match="focal-half"):
        slip_of(["focal"])
    with pytest.raises(AadmError, match="proud-rings"):
        left_by_site(["rain"], *(None, None), np.random.default_rng(0))  # type: ignore[arg-type]
