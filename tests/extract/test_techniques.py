"""The single techniques on data whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.extract.circle import (
    Outlines,
    PlanPoints,
    agreeing_shares,
    circles_of_radius,
    circles_through,
    in_rows,
    outlines,
    settled_centres,
    thinned_rows,
)
from aadm_workbench.extract.foot_face import find_discs, rastered
from aadm_workbench.extract.own_tops import top_planes
from aadm_workbench.extract.patches import patches_around
from aadm_workbench.extract.plane import facing, find_plane, find_planes, from_plane, in_plane
from aadm_workbench.extract.pooled.evidence import BracketLaw, RimLaw
from aadm_workbench.extract.pooled.fit import CircleEvidence, likeliest_circles
from aadm_workbench.extract.sample import thinned
from aadm_workbench.model import Camera, Plane, Scan


def rng() -> np.random.Generator:
    return np.random.default_rng(42)


def plane_points(normal: np.ndarray, offset: float, count: int, noise_mm: float) -> np.ndarray:
    local = np.column_stack([rng().uniform(-300, 300, (count, 2)), rng().normal(0, noise_mm, count)])
    return from_plane(local, Plane(normal, offset))


def test_plane_is_found_among_outliers() -> None:
    normal = np.array([0.1, -0.2, 1.0]) / np.linalg.norm([0.1, -0.2, 1.0])
    points = np.vstack([plane_points(normal, 800.0, 6000, 0.1), rng().uniform(-400, 1200, (6000, 3))])
    plane = find_plane(points, rng())
    assert plane is not None
    assert abs(plane.normal @ normal) > np.cos(2e-4)
    assert abs(plane.offset) == pytest.approx(800.0, abs=0.05)
    assert plane.residual_mm == pytest.approx(0.1, rel=0.2)


def test_bores_behind_a_face_do_not_pull_its_plane() -> None:
    """A 50 mm band would take in the walls (0.2 to 0.8 mm of bias); a 1 mm band leaves them out."""
    face = plane_points(np.array([0.0, 0.0, 1.0]), 0.0, 20000, 0.05)
    wall = np.column_stack([rng().uniform(0, 300, (4000, 2)), -rng().uniform(2.0, 60.0, 4000)])
    plane = find_plane(np.vstack([face, wall]), rng())
    assert plane is not None
    assert abs(plane.height(np.array([[150.0, 150.0, 0.0]]))[0]) < 0.02


def test_planes_come_largest_first() -> None:
    big = plane_points(np.array([0.0, 0.0, 1.0]), 500.0, 8000, 0.1)
    small = plane_points(np.array([0.0, 0.0, 1.0]), 420.0, 3000, 0.1)
    offsets = [abs(plane.offset) for plane in find_planes(np.vstack([small, big]), rng(), 2)]
    assert offsets == pytest.approx([500.0, 420.0], abs=0.2)


def test_too_few_points_make_no_plane() -> None:
    assert find_plane(np.zeros((10, 3)), rng()) is None
    assert find_plane(np.zeros((500, 3)), rng()) is None


def test_facing_turns_the_normal_to_the_viewer() -> None:
    plane = facing(Plane(np.array([0.0, 0.0, 1.0]), 900.0), np.zeros(3))
    assert plane.normal[2] == -1.0
    assert plane.offset == -900.0


def test_plane_coordinates_go_there_and_back() -> None:
    plane = Plane(np.array([0.6, 0.0, 0.8]), 12.0)
    points = rng().uniform(-9, 9, (50, 3))
    assert np.allclose(from_plane(in_plane(points, plane), plane), points)


def ring(centre: tuple[float, float], radius: float, count: int = 120) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False) + 0.01
    return np.column_stack([centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)])


def rows(*parts: np.ndarray) -> Outlines:
    owner = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return Outlines(*in_rows(np.vstack(parts), owner, len(parts)))


def plan(*parts: np.ndarray) -> PlanPoints:
    owner = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return PlanPoints(*np.vstack(parts).T, owner, len(parts))


def test_circle_with_a_sixth_of_its_points_elsewhere() -> None:
    spoilt = ring((3, -5), 18)
    spoilt[:20] += np.array([6.0, 4.0])
    centre, radius = circles_through(
        rows(spoilt, ring((0.5, 0.5), 17.5, 60)), np.array([[4.0, -4.0], [0.0, 0.0]]), 17.0
    )
    assert centre[0] == pytest.approx([3.0, -5.0], abs=0.15)
    assert centre[1] == pytest.approx([0.5, 0.5], abs=1e-3)
    assert radius == pytest.approx([18.0, 17.5], abs=0.15)


def test_an_outline_of_four_points_stays_where_it_is() -> None:
    centre, radius = circles_through(rows(ring((3, 3), 18, 4), ring((1, 0), 18)), np.zeros((2, 2)), 17.0)
    assert centre == pytest.approx(np.array([[0.0, 0.0], [1.0, 0.0]]), abs=0.02)
    assert radius[0] == 17.0


def test_half_of_an_outline_is_enough_where_the_radius_is_known() -> None:
    spoilt = ring((1, 2), 10)
    spoilt[:60] = ring((4, 5), 14)[:60]
    centre, share = circles_of_radius(rows(spoilt, ring((0, 0), 10, 30)), 10.0, 0.3)
    assert centre == pytest.approx(np.array([[1.0, 2.0], [0.0, 0.0]]), abs=0.05)
    assert share == pytest.approx([0.5, 1.0], abs=0.1)


def test_outline_takes_the_innermost_of_each_bin() -> None:
    points = plan(np.array([[2.0, 0.01], [1.0, 0.01], [0.0, 3.0]]), np.array([[-1.0, -0.1]]))
    inner = outlines(points, np.zeros((2, 2)), 4, innermost=True)
    assert inner.coverage == pytest.approx([0.5, 0.25])
    assert sorted(inner.distance(np.zeros((2, 2)))[0, inner.seen[0]]) == pytest.approx([1.0, 3.0], abs=1e-3)
    outer = outlines(points, np.zeros((2, 2)), 4, innermost=False)
    assert sorted(outer.distance(np.zeros((2, 2)))[0, outer.seen[0]]) == pytest.approx([2.0, 3.0], abs=1e-3)


def test_centres_settle_beside_their_guess_and_without_points_stay() -> None:
    face = np.vstack([ring((1.2, -0.8), 13 + 0.1 * step, 200) for step in range(20)])
    settled, _ = settled_centres(plan(face, np.zeros((0, 2))), np.zeros((2, 2)), 13.0, 120, (6.0, 17.0), innermost=True)
    assert settled == pytest.approx(np.array([[1.2, -0.8], [0.0, 0.0]]), abs=0.01)


def test_shares_count_what_is_there() -> None:
    shape = rows(ring((0, 0), 10), ring((0, 0), 12, 40))
    assert agreeing_shares(shape, np.zeros((2, 2)), 10.0) == pytest.approx([1.0, 0.0])
    assert agreeing_shares(shape, np.zeros((2, 2)), np.array([10.0, 12.0])) == pytest.approx([1.0, 1.0])


def test_rows_are_thinned_evenly_and_padded() -> None:
    owner = np.repeat([0, 2], [10, 3])
    some = thinned_rows(owner, 3, 4)
    assert some.tolist() == [0, 3, 6, 9, 10, 11, 12]
    values, seen = in_rows(np.arange(13.0)[some], owner[some], 3)
    assert seen.sum(axis=1).tolist() == [4, 0, 3]
    assert values[0].tolist() == [0.0, 3.0, 6.0, 9.0]


def test_likeliest_circles_keep_to_the_core_under_half_a_rib() -> None:
    """A rib of 0.9 mm over a third of one bar's outline neither widens its circle nor moves it."""
    ribbed = ring((0.3, -0.2), 10)
    ribbed[:40] = ring((0.3, -0.2), 10.9)[:40]
    shapes = [ribbed, *(ring((0.1 * k, 0.2), 10) for k in range(5))]
    outline = rows(*shapes)
    evidence = CircleEvidence(outline.xy, outline.seen, RimLaw(0.4, 0.5, 0.3, softness=0.08), -1.0)
    centre, radius = likeliest_circles([evidence], np.zeros((6, 2)), 10.3)
    assert radius == pytest.approx(10.0, abs=0.15)
    assert centre[0] == pytest.approx([0.3, -0.2], abs=0.15)


def tilted_tops() -> tuple[Scan, Plane]:
    """Two bars of 20 mm in the view of a camera 600 mm above them, one cut level, one 10 mm higher at 12 degrees."""
    camera = Camera(1200.0, 1200.0, 320.0, 240.0, 640, 480)
    columns, rows_ = np.meshgrid(np.arange(640), np.arange(480))
    ray = np.stack([(columns - 320) / 1200, (rows_ - 240) / 1200, np.ones_like(columns, float)], -1)
    depth = np.full(columns.shape, 700.0)
    for x, slope, height in ((-40.0, 0.0, 0.0), (40.0, np.tan(np.radians(12.0)), 10.0)):
        meets = (600.0 - height + slope * x) / (ray[..., 2] + slope * ray[..., 0])
        at = ray * meets[..., None]
        on = np.hypot(at[..., 0] - x, at[..., 1]) < 10.0
        depth[on] = meets[on]
    return Scan((ray * depth[..., None]).astype(np.float32), camera=camera, viewpoint=np.zeros(3)), Plane(
        np.array([0.0, 0.0, -1.0]), -600.0
    )


@pytest.mark.parametrize("form", ["depth map", "unknown camera", "cloud"])
def test_each_top_has_its_own_plane(form: str) -> None:
    scan, level = tilted_tops()
    if form == "unknown camera":
        scan = Scan(scan.points, viewpoint=scan.viewpoint)
    if form == "cloud":
        scan = Scan(scan.points.reshape(-1, 3), viewpoint=scan.viewpoint)
    places = in_plane(np.array([[-40.0, 0.0, 600.0], [40.0, 0.0, 590.0]]), level)[:, :2]
    patches = patches_around(scan, thinned(scan, 30_000, rng()), level, places, 20.0)
    planes = top_planes(patches, 10.0, rng())
    assert planes.found.all()
    assert np.degrees(np.arccos(planes.normal[:, 2])) == pytest.approx([0.0, 12.0], abs=0.05)
    assert planes.offset / planes.normal[:, 2] == pytest.approx([0.0, 10.0], abs=0.02)


def test_points_that_hang_in_the_air_are_not_borne() -> None:
    scan, level = tilted_tops()
    points = scan.points.copy()
    points[240, 320] *= 650.0 / 700.0
    patches = patches_around(
        Scan(points, camera=scan.camera, viewpoint=scan.viewpoint),
        thinned(scan, 30_000, rng()),
        level,
        np.zeros((1, 2)),
        20.0,
    )
    flying = np.flatnonzero(np.abs(patches.height.ravel() + 50.0) < 1.0)
    floor = np.flatnonzero(np.abs(patches.height.ravel() + 100.0) < 0.1)
    assert len(flying) == 1
    assert not patches.borne(flying).any()
    assert patches.borne(floor).mean() > 0.99


def test_discs_and_holes_are_found_on_a_raster() -> None:
    grid = np.stack(np.meshgrid(np.arange(0, 200, 0.7), np.arange(0, 150, 0.7)), -1).reshape(-1, 2)
    hole = np.hypot(*(grid - [60, 70]).T) < 13
    centres, _ = find_discs(rastered(grid[~hole], 1.0, 40.0), 13.0, holes=True)
    assert centres == pytest.approx(np.array([[60.0, 70.0]]), abs=1.0)
    centres, _ = find_discs(rastered(grid[hole], 1.0, 40.0), 13.0, holes=False)
    assert centres == pytest.approx(np.array([[60.0, 70.0]]), abs=1.0)


@pytest.mark.parametrize("law", [RimLaw(0.5, 1.5, 0.1), BracketLaw(0.1, 0.3)])
def test_slope_is_the_derivative_of_the_cost(law: RimLaw | BracketLaw) -> None:
    at = np.linspace(-2.0, 2.0, 400)
    numeric = np.gradient(law.cost(at), at)
    assert np.corrcoef(numeric, law.slope(at))[0, 1] > 0.99


def test_lost_pixels_move_the_tail_of_a_rim_and_not_its_flank() -> None:
    """With half of the first pixels lost the likeliest edge stays within a tenth of a pixel."""
    law, edge = RimLaw(0.5, 3.0, 0.05), np.linspace(-0.6, 0.6, 121)
    whole = rng().uniform(0.0, 0.5, 400)
    lossy = np.where(rng().random(400) < 0.5, whole, whole + 0.5)
    for behind in (whole, lossy):
        best = edge[np.argmin([law.cost(behind - shift).sum() for shift in edge])]
        assert best == pytest.approx(0.0, abs=0.06)
