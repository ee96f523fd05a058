"""What a site does to parts: chips, grout, bent and rusty bars, things that stand about, walls that mislead."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.model import Array, Camera
from aadm_workbench.twin.camera import facing
from aadm_workbench.twin.meshes import bars_surface, foot_surface, object_surface
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Box, Foot, Grout, Hose, SleeveAsBuilt
from aadm_workbench.twin.raycast import rays_of
from aadm_workbench.twin.scene import scan_of
from aadm_workbench.twin.surface import BAR, DARK, OBJECT, SLEEVE_WALL, Surface

SMALL = Camera(fx=600.0, fy=600.0, cx=319.5, cy=255.5, width=640, height=512)
SILENT = CameraNoise(
    depth_at_1m=0.0, warp=0.0, random_loss=0.0, outliers=0.0, step_loss=0.0, step_fly=0.0, wall_loss=0.0
)
SLEEVE = SleeveAsBuilt(30.0, -20.0, 36.0)
STRAIGHT = BarAsBuilt(5.0, -8.0, 0.0, 20.0, rib_height=0.0)


def of_kind(surface: Surface, kind: int) -> Array:
    """Vertices (n, 3) that belong to triangles of a kind."""
    return surface.vertices[np.unique(surface.triangles[surface.kind == kind])]


def seen(part: Foot | BarGroup, noise: CameraNoise = SILENT, seed: int = 0) -> Array:
    """Points (h, w, 3) in the column frame that a camera 800 mm away returns of a part."""
    forward = np.array([0.0, 0.0, 1.0 if isinstance(part, Foot) else -1.0])
    T = facing(np.zeros(3), forward, np.array([0.0, 1.0, 0.0]), 800.0, (0.02, -0.03), 0.0)
    scan = scan_of(part, T, noise, np.random.default_rng(seed), SMALL)
    points: Array = (rays_of(SMALL) * scan.depth[..., None]) @ T[:3, :3].T + T[:3, 3]
    return points


def test_grout_is_a_dome_that_covers_the_edge_of_a_mouth() -> None:
    splash = Grout(30.0, -20.0 + 18.0 + 10.0, 15.0, 2.0)
    points = seen(Foot((250.0, 250.0), (SLEEVE,), grout=(splash,)))
    from_middle = np.hypot(points[..., 0] - splash.x, points[..., 1] - splash.y)
    dome = from_middle < 0.95 * splash.radius
    height = 2.0 * np.sqrt(1.0 - (from_middle[dome] / splash.radius) ** 2)
    assert points[dome][:, 2] == pytest.approx(-height, abs=0.03)
    assert (np.hypot(points[dome][:, 0] - 30.0, points[dome][:, 1] + 20.0) < 17.0).sum() > 5
    clear = (from_middle > 16.0) & (np.abs(points[..., :2]).max(axis=-1) < 60.0) & (points[..., 2] < 1.0)
    assert np.abs(points[clear][:, 2]).max() < 0.01


@pytest.mark.parametrize("turn", [0.0, 1.0, 2.5])
def test_a_chip_lies_in_its_direction(turn: float) -> None:
    chipped = replace(SLEEVE, chip=10.0, chip_direction=turn)
    points = seen(Foot((250.0, 250.0), (chipped,)))
    from_axis = points[..., :2] - [30.0, -20.0]
    radius = np.hypot(from_axis[..., 0], from_axis[..., 1])
    deeper = (points[..., 2] > 0.3) & (radius > 18.3) & (radius < 40.0)
    assert deeper.sum() > 20
    towards = from_axis[deeper] @ [np.cos(turn), np.sin(turn)]
    across = from_axis[deeper] @ [-np.sin(turn), np.cos(turn)]
    assert towards.min() > 10.0
    assert towards.max() == pytest.approx(18.0 + 10.0, abs=1.5)
    assert np.abs(across).max() == pytest.approx(10.0, abs=1.5)


def test_a_misleading_wall_stands_beside_its_place_and_its_mouth_does_not() -> None:
    wall = of_kind(foot_surface(Foot((250.0, 250.0), (replace(SLEEVE, wall_shift=(0.6, -0.3)),))), SLEEVE_WALL)
    for depth, centre in ((wall[:, 2] < 1e-6, (30.0, -20.0)), (wall[:, 2] > 2.0 - 1e-6, (30.6, -20.3))):
        ring = wall[depth & (wall[:, 2] < 2.5)]
        assert len(ring) > 200
        assert np.hypot(ring[:, 0] - centre[0], ring[:, 1] - centre[1]) == pytest.approx(
            np.full(len(ring), 18.0), abs=1e-3
        )


def test_each_sleeve_gets_a_bias_of_its_own_along_the_ray() -> None:
    # on the side where both the camera and the projector look along the bore
    sleeves = tuple(replace(SLEEVE, x=80.0, y=y) for y in (-70.0, 0.0, 70.0))
    foot = Foot((250.0, 250.0), sleeves)
    clear = replace(SILENT, grazing_full=0.002, grazing_none=0.001)
    biased, plain = seen(foot, replace(clear, wall_bias_own=0.8), seed=4), seen(foot, clear, seed=4)
    shift = np.linalg.norm(biased - plain, axis=-1)
    amounts = []
    for sleeve in sleeves:
        inside = (np.hypot(plain[..., 0] - sleeve.x, plain[..., 1] - sleeve.y) < 18.5) & (plain[..., 2] > 1.0)
        inside &= plain[..., 2] < 290.0
        assert inside.sum() > 40
        assert np.ptp(shift[inside]) < 0.1
        amounts.append(float(shift[inside].mean()))
    assert np.ptp(amounts) > 0.1
    assert max(amounts) < 1.0
    assert np.nanmax(shift[np.abs(plain[..., 2]) < 0.01]) < 1e-3


def test_a_bent_bar_stands_upright_on_the_floor_and_ends_off_its_line() -> None:
    bent = replace(STRAIGHT, bend=(10.0, 0.0))
    bar = of_kind(bars_surface(BarGroup((bent,), -120.0)), BAR)
    top, foot = bar[np.abs(bar[:, 2]) < 1e-6], bar[bar[:, 2] < -123.0]
    assert top[:, :2].mean(axis=0) == pytest.approx([5.0, -8.0], abs=0.1)
    assert foot[:, :2].mean(axis=0) == pytest.approx([-5.0, -8.0], abs=0.1)
    assert np.ptp(foot[:, 0]) == pytest.approx(20.0, abs=0.1)


def test_a_burr_stands_out_on_its_side() -> None:
    bar = of_kind(bars_surface(BarGroup((replace(STRAIGHT, burr=1.0, burr_direction=np.pi / 2),), -120.0)), BAR)
    top = bar[np.abs(bar[:, 2]) < 1e-6] - [5.0, -8.0, 0.0]
    assert (top[:, 1].max(), top[:, 1].min()) == pytest.approx((11.0, -10.0), abs=0.01)
    assert np.abs(top[:, 0]).max() == pytest.approx(10.0, abs=0.1)


def test_rust_returns_nothing() -> None:
    rusty = replace(STRAIGHT, rust=0.25, rust_direction=0.5)
    surface = bars_surface(BarGroup((rusty,), -120.0))
    assert (surface.kind == DARK).sum() == 24  # of the 96 triangles of the top
    around = (of_kind(surface, DARK) - [5.0, -8.0, 0.0])[:, :2] @ [np.cos(0.5), np.sin(0.5)]
    assert around.min() >= -1e-9
    points, clean = seen(BarGroup((rusty,), -120.0)), seen(BarGroup((STRAIGHT,), -120.0))
    share = (np.abs(points[..., 2]) < 0.1).sum() / (np.abs(clean[..., 2]) < 0.1).sum()
    assert share == pytest.approx(0.75, abs=0.04)


def test_things_stand_where_they_are_put() -> None:
    box = object_surface(Box((-10.0, 0.0, -50.0), (30.0, 20.0, -20.0)))
    assert (box.vertices.min(axis=0), box.vertices.max(axis=0)) == (
        pytest.approx([-10.0, 0.0, -50.0]),
        pytest.approx([30.0, 20.0, -20.0]),
    )
    hose = object_surface(Hose(((-100.0, 0.0), (0.0, 30.0), (100.0, 0.0)), -60.0, 25.0))
    assert (hose.vertices[:, 2].min(), hose.vertices[:, 2].max()) == pytest.approx((-72.5, -47.5))
    over = hose.vertices[np.abs(hose.vertices[:, 0]) < 3.0]
    assert over[:, 1].mean() == pytest.approx(30.0, abs=0.5)
    group = BarGroup((STRAIGHT,), -120.0, beside=(Box((40.0, 40.0, -120.0), (60.0, 60.0, -70.0)),))
    assert (bars_surface(group).kind == OBJECT).sum() == 12
    points = seen(group)
    on_box = (np.abs(points[..., 0] - 50.0) < 8.0) & (np.abs(points[..., 1] - 50.0) < 8.0)
    assert np.abs(points[on_box][:, 2] + 70.0).max() < 0.01


def test_a_window_of_the_image_can_keep_the_warp_of_the_whole() -> None:
    foot = Foot((250.0, 250.0), ())
    warp = replace(SILENT, warp=0.5)
    narrow, wide = seen(foot, warp), seen(foot, replace(warp, warp_period=2000.0))
    along = narrow[250, 240:400, 2], wide[250, 240:400, 2]
    assert np.ptp(along[0]) > 2.0 * np.ptp(along[1])
