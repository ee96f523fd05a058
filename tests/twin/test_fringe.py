"""The fringe camera: what physics says of planes and edges comes out of it, though nobody put it in."""

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.model import Camera
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.fringe.render import divided
from aadm_workbench.twin.fringe.renderer import mitsuba_ready
from aadm_workbench.twin.fringe.rig import FringeRig, Fringes, Lenses, Sensor, rig_for
from aadm_workbench.twin.fringe.shot import depth_of, recorded, unwrapped
from aadm_workbench.twin.surface import CONCRETE, Surface, joined, one_kind

SMALL = Camera(PRO_M.fx, PRO_M.fy, 79.5, 59.5, 160, 120)
HUNDRED = Fringes((100, 99, 90), (((1, -1, 0), 1), ((1, 0, -1), 10), ((1, 0, 0), 100)))
DISTANCE_MM = 1300.0


@pytest.fixture(scope="module")
def renderer() -> None:
    try:
        mitsuba_ready()
    except MissingDependencyError as error:
        pytest.skip(str(error))


def plate(x: tuple[float, float], z: float) -> Surface:
    """A plate of concrete square to the view, in the camera frame."""
    corners = np.array([[a, b, z] for a in x for b in (-900.0, 900.0)])
    return one_kind(corners, np.array([[0, 1, 2], [1, 3, 2]]), CONCRETE)


def rays(camera: Camera) -> np.ndarray:
    u, v = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    return np.stack([(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, np.ones(u.shape)], -1)


def taken(surface: Surface, rig: FringeRig, relief: float = 0.05, seed: int = 1) -> np.ndarray:
    """Depth map (h, w) of a surface in the camera frame."""
    from aadm_workbench.twin.fringe.materials import Materials
    from aadm_workbench.twin.fringe.render import Effort
    from aadm_workbench.twin.fringe.shot import FringeCamera, fringe_image

    fringe = FringeCamera(rig, Materials(relief=relief), Effort(8, 32, 32))
    rng = np.random.default_rng(seed)
    depth, _ = fringe_image(surface, np.eye(4), fringe, rng, SMALL).drawn(rng)
    return np.asarray(depth, np.float64)


def seen_at(points: np.ndarray, rig: FringeRig) -> np.ndarray:
    """Where on the projector, 0..1 of its width, points (..., 3) lie: by a pinhole's projection matrix."""
    projector = rig.projector
    turn = np.arctan(projector.baseline / projector.axes_meet)
    to_projector = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])
    matrix = np.array([[projector.focal, 0, projector.width / 2], [0, projector.focal, 0], [0, 0, 1]])
    seen = (points - [projector.baseline, 0, 0]) @ (matrix @ to_projector).T
    return np.asarray(seen[..., 0] / seen[..., 2] / projector.width)


@pytest.mark.parametrize("fringes", [Fringes(), HUNDRED])
def test_phases_of_a_known_surface_give_its_depth_back(fringes: Fringes) -> None:
    rig = replace(rig_for(1300.0), fringes=fringes)
    camera = Camera(PRO_M.fx / 8, PRO_M.fy / 8, PRO_M.cx / 8, PRO_M.cy / 8, PRO_M.width // 8, PRO_M.height // 8)
    true = np.tile(1300.0 + 60.0 * np.sin(np.arange(camera.width) / 25.0), (camera.height, 1))
    place = seen_at(rays(camera) * true[..., None], rig)
    phases = np.stack([np.angle(np.exp(2j * np.pi * place * periods)) for periods in fringes.periods])
    depth = depth_of(unwrapped(phases.astype(np.float32), fringes), camera, rig)
    inside = (place > 0.001) & (place < 0.999)
    assert inside.mean() > 0.95
    np.testing.assert_allclose(depth[inside], true[inside], atol=0.005)


def test_what_lies_outside_of_the_working_range_is_not_returned() -> None:
    rig = rig_for(1300.0)
    for deep, inside in ((rig.nearest - 5.0, False), (rig.nearest + 5.0, True), (rig.farthest - 5.0, True)):
        place = seen_at(rays(SMALL) * deep, rig)
        depth = depth_of(place, SMALL, rig)
        assert np.isfinite(depth).all() == inside
    assert np.isnan(depth_of(seen_at(rays(SMALL) * (rig.farthest + 5.0), rig), SMALL, rig)).all()


def test_a_ladder_that_does_not_beat_is_refused() -> None:
    with pytest.raises(ValueError, match="do not beat to 2"):
        Fringes((70, 64, 59), (((1, -2, 1), 2),))


def flat_light(level: float, contrast: float, count: int = 200) -> np.ndarray:
    """Light (count, count, 7) of one place on the projector: constant, and three waves at phase 0.7 rad."""
    waves = [level * contrast * part for part in (np.cos(0.7), np.sin(0.7))] * 3
    return np.broadcast_to(np.array([level, *waves], np.float32), (count, count, 7))


def test_the_noise_of_a_phase_is_that_of_photons() -> None:
    rig = FringeRig(sensor=Sensor(exposures=(1.0,), exposed_for=0.6, ambient=0.0))
    taken = recorded(flat_light(1.0, 1.0), 1.0, rig, np.random.default_rng(1))
    # Four steps: variance of the phase is 2 / 4 of the images' over the amplitude squared, in electrons.
    mean = amplitude = 0.5 * 0.6 * 16000.0
    digit = 16000.0 / 1023.0
    expected = np.sqrt(0.5 * (mean + 8.0**2 + digit**2 / 12.0)) / amplitude
    assert taken.phases[0].std() == pytest.approx(expected, rel=0.05)
    assert taken.phases[0].mean() == pytest.approx(0.7, abs=5 * expected / 200)


def test_what_is_saturated_is_read_from_a_shorter_exposure_and_what_is_flat_is_dropped() -> None:
    rig = FringeRig()
    rng = np.random.default_rng(1)
    bright = recorded(flat_light(3.0, 1.0), 1.0, rig, rng)
    assert bright.phases[0].mean() == pytest.approx(0.7, abs=1e-3)
    assert np.isnan(recorded(flat_light(30.0, 1.0), 1.0, rig, rng).phases).all()
    assert np.isnan(recorded(flat_light(1.0, 0.01), 1.0, rig, rng).phases).all()


def test_divided_triangles_cover_the_same_with_short_edges() -> None:
    vertices = np.array([[0.0, 0.0, 0.0], [400.0, 0.0, 0.0], [0.0, 3.0, 0.0], [400.0, 90.0, 0.0]])
    triangles = np.array([[0, 1, 2], [1, 3, 2]])
    fine, small = divided(vertices, triangles, 25.0)

    def areas(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
        a, b, c = (points[corners[:, k]] for k in range(3))
        return np.asarray(np.cross(b - a, c - a)[:, 2] / 2)

    edges = fine[small[:, [1, 2, 0]]] - fine[small]
    assert np.linalg.norm(edges, axis=2).max() <= 25.0
    assert (np.sign(areas(fine, small)) == np.sign(areas(vertices, triangles)[0])).all()
    assert areas(fine, small).sum() == pytest.approx(areas(vertices, triangles).sum())


@pytest.mark.parametrize("slope", [0.0, 0.08])
def test_a_plane_is_where_it_is_and_as_noisy_as_such_a_camera(renderer: None, slope: float) -> None:
    corners = np.array([[a, b, DISTANCE_MM + slope * a] for a in (-900.0, 900.0) for b in (-900.0, 900.0)])
    plane = one_kind(corners, np.array([[0, 1, 2], [1, 3, 2]]), CONCRETE)
    true = DISTANCE_MM / (1.0 - slope * rays(SMALL)[..., 0])
    smooth = taken(plane, rig_for(DISTANCE_MM), relief=0.0) - true
    assert np.isfinite(smooth).all()
    assert abs(np.mean(smooth)) < 0.004  # four standard errors of 19,200 pixels
    assert 0.06 < np.std(smooth) < 0.13
    cast = taken(plane, rig_for(DISTANCE_MM), relief=0.05) - true
    assert np.hypot(np.std(smooth), 0.03) < np.std(cast) < np.hypot(np.std(smooth), 0.08)


def test_the_same_seed_gives_the_same_scan(renderer: None) -> None:
    first = taken(plate((-900.0, 900.0), DISTANCE_MM), rig_for(DISTANCE_MM))
    again = taken(plate((-900.0, 900.0), DISTANCE_MM), rig_for(DISTANCE_MM))
    np.testing.assert_array_equal(first, again)


@pytest.mark.parametrize(("left", "sign"), [(False, 1.0), (True, -1.0)])
def test_an_edge_curls_down_on_the_projectors_side_and_up_on_the_other(renderer: None, left: bool, sign: float) -> None:
    """A plate that ends at x = 0, the projector far to its right, nothing behind it."""
    quiet = FringeRig(
        lenses=Lenses(camera_focus=DISTANCE_MM, projector_focus=DISTANCE_MM),
        sensor=Sensor(full_well=1e8, read_noise=0.0, bits=20),
    )
    depth = taken(plate((-400.0, 0.0) if left else (0.0, 400.0), DISTANCE_MM), quiet, relief=0.0)
    # In the last pixel the lit part's middle is off the pixel's by a share of it, which z / baseline multiplies.
    pixel_mm = DISTANCE_MM / SMALL.fx
    columns = np.arange(SMALL.width)
    last = np.flatnonzero(np.isfinite(depth).mean(axis=0) > 0.95)[-1 if left else 0]
    curl = sign * (np.nanmedian(depth[:, last]) - DISTANCE_MM)
    assert 0.1 * pixel_mm * DISTANCE_MM / 270.0 < curl < 1.0 * pixel_mm * DISTANCE_MM / 270.0
    far = np.abs(columns - SMALL.cx) > 6
    seen = far & np.isfinite(depth).all(axis=0)
    assert seen.sum() > 60
    assert np.abs(np.mean(depth[:, seen]) - DISTANCE_MM) < 0.01


def test_light_of_two_depths_slips_fringes(renderer: None) -> None:
    """Mixed pixels come out neither on the near plate nor on the far one, and not between them alone."""
    scene = joined([plate((0.0, 400.0), 1200.0), plate((-700.0, 700.0), 1330.0)])
    depth = taken(scene, rig_for(DISTANCE_MM))
    on_either = (np.abs(depth - 1200.0) < 3.0) | (np.abs(depth - 1330.0) < 3.0)
    elsewhere = np.isfinite(depth) & ~on_either
    edge = np.abs(np.arange(SMALL.width) - SMALL.cx) < 4
    assert elsewhere[:, edge].any()
    # The near plate's shadow on the far one ends 55 pixels to the left of its edge.
    shadow = (np.arange(SMALL.width) > SMALL.cx - 65) & (np.arange(SMALL.width) < SMALL.cx)
    assert not elsewhere[:, ~(edge | shadow)].any()
    between = (depth > 1200.0) & (depth < 1330.0)
    assert (elsewhere & ~between).any()


def test_an_old_llvm_is_refused_with_the_command_that_mends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("mitsuba")
    monkeypatch.setattr("aadm_workbench.twin.fringe.renderer.llvm_found", lambda: 15)
    with pytest.raises(MissingDependencyError, match="apt-get install libllvm19"):
        mitsuba_ready()
