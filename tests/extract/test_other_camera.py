"""``refined`` on the scans of a camera that nobody tuned it for, from files in metres."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np
import pytest

from aadm_workbench.extract.method import extract
from aadm_workbench.model import Array, Extraction, Kind, Scan
from aadm_workbench.scan.camera import read_camera
from aadm_workbench.scan.read import read_scan
from aadm_workbench.scan.write import write_ply
from tests.extract import other_camera as other
from tests.extract.other_camera import Rod

SLEEVE_MM, BAR_MM, CORE_MM = 40.0, 25.0, 24.2
EDGES = ("mixed", "dropped")
CAMERA = f"""\
[camera]
fx = {other.FX}
fy = {other.FY}
cx = {other.CX}
cy = {other.CY}
width = {other.WIDTH}
height = {other.HEIGHT}
"""


def face(tilt: tuple[float, float], distance: float) -> tuple[Array, Array, Array]:
    """Normal (3,), middle (3,) and the centres (12, 3) of a ring of twelve, 150 mm apart, in metres."""
    normal = np.array([tilt[0], tilt[1], 1.0])
    normal /= np.linalg.norm(normal)
    x = np.cross([0.0, 1.0, 0.0], normal)
    x /= np.linalg.norm(x)
    y = np.cross(normal, x)
    places = np.array([(u, v) for u in range(4) for v in range(4) if u in (0, 3) or v in (0, 3)]) * 0.150 - 0.225
    middle = distance / normal[2] * np.array([0.0, 0.0, 1.0]) + 0.02 * x - 0.01 * y
    return normal, middle, middle + places[:, :1] * x + places[:, 1:] * y


def leaning(normal: Array, rng: np.random.Generator) -> Array:
    axis = normal + 0.005 * rng.standard_normal(3)
    return np.asarray(axis / np.linalg.norm(axis))


@cache
def foot(edges: str) -> tuple[np.ndarray, Array, Array]:
    """Depths in metres, true centres (12, 3) mm and normal (3,) of a foot 1.25 m away."""
    rng = np.random.default_rng(31)
    normal, middle, centres = face((0.05, -0.03), 1.25)
    off = 0.0005 * rng.standard_normal((12, 3))
    centres = centres + off - (off @ normal)[:, None] * normal
    bores = [Rod(centre, leaning(normal, rng), 0.5e-3 * SLEEVE_MM, 0.30) for centre in centres]
    ideal = other.foot_depth(normal, float(normal @ middle), bores, 0.3, middle)
    return other.returned(ideal, edges, rng), 1000.0 * centres, normal


@cache
def bars(edges: str) -> tuple[np.ndarray, Array, Array]:
    """Depths in metres, true centres (12, 3) mm of the tops, and normal (3,) of the floor under bars of 0.17 m."""
    rng = np.random.default_rng(32)
    normal, middle, centres = face((-0.04, 0.06), 1.15)
    centres = centres + 0.0005 * rng.standard_normal((12, 3)) + rng.uniform(-0.003, 0.003, (12, 1)) * normal
    stacks = [ribbed(Rod(centre, leaning(normal, rng), 0.5e-3 * CORE_MM, 0.2), rng) for centre in centres]
    ideal = other.bars_depth(normal, float(normal @ middle) + 0.17, stacks)
    return other.returned(ideal, edges, rng), 1000.0 * centres, normal


def ribbed(core: Rod, rng: np.random.Generator) -> list[Rod]:
    """A bar with rings 0.9 mm high and 2 mm long every 12 mm, the first one anywhere below its top."""
    rings = np.arange(rng.uniform(0.001, 0.012), 0.16, 0.012)
    return [core, *(Rod(core.start + s * core.axis, core.axis, core.radius + 0.0009, 0.002) for s in rings)]


def in_plane_errors(found: Extraction, centres: Array, normal: Array) -> Array:
    """Offsets (12, 3) mm across the normal of the nearest point found to each true centre."""
    points = np.array([point.centre for point in found.points]).reshape(-1, 3)
    offset = points[None] - centres[:, None]
    offset -= (offset @ normal)[..., None] * normal
    nearest = np.linalg.norm(offset, axis=-1).argmin(axis=1)
    return np.asarray(offset[np.arange(len(centres)), nearest])


def radial(errors: Array, centres: Array, normal: Array) -> Array:
    """Part (12,) mm of errors that points away from the camera's foot point."""
    spoke = centres - (centres @ normal)[:, None] * normal
    return np.asarray(np.einsum("ij,ij->i", errors, spoke) / np.linalg.norm(spoke, axis=1))


def depth_map(folder: Path, depth: np.ndarray) -> Scan:
    """A floating depth map in metres and a camera file beside it, as the product reads them."""
    (folder / "camera.toml").write_text(CAMERA, encoding="utf-8")
    assert cv2.imwrite(str(folder / "depth.tiff"), np.nan_to_num(depth))
    return read_scan(folder / "depth.tiff", units="m", camera=read_camera(folder / "camera.toml"))


def cloud(folder: Path, depth: np.ndarray) -> Scan:
    """A cloud in metres without any word about its camera."""
    points = other.rays(slice(None), slice(None)).astype(np.float32) * depth[..., None]
    write_ply(folder / "cloud.ply", points[np.isfinite(depth)])
    return read_scan(folder / "cloud.ply", units="m")


@cache
def measured(kind: Kind, edges: str, form: str) -> tuple[Extraction, Array, Array]:
    """What ``refined`` finds, by way of a file, with the true centres and the normal."""
    depth, centres, normal = foot(edges) if kind is Kind.SLEEVE else bars(edges)
    diameter_mm = SLEEVE_MM if kind is Kind.SLEEVE else BAR_MM
    with TemporaryDirectory() as folder:
        scan = (depth_map if form == "depth map" else cloud)(Path(folder), depth)
    return extract(scan, kind, diameter_mm, "refined", np.random.default_rng(0)), centres, normal


CASES = [
    (Kind.SLEEVE, "mixed", "depth map"),
    (Kind.SLEEVE, "dropped", "depth map"),
    (Kind.SLEEVE, "mixed", "cloud"),
    (Kind.REBAR, "mixed", "depth map"),
    (Kind.REBAR, "dropped", "depth map"),
    (Kind.REBAR, "mixed", "cloud"),
]


@pytest.mark.parametrize(("kind", "edges", "form"), CASES)
def test_all_twelve_are_found_within_half_a_millimetre(kind: Kind, edges: str, form: str) -> None:
    found, centres, normal = measured(kind, edges, form)
    distance = np.linalg.norm(in_plane_errors(found, centres, normal), axis=1)
    assert len(found.points) == 12
    assert distance.mean() < 0.35, np.round(distance, 3)
    assert distance.max() < 0.5, np.round(distance, 3)


@pytest.mark.parametrize(("kind", "edges", "form"), CASES)
def test_they_are_not_all_pushed_towards_the_camera(kind: Kind, edges: str, form: str) -> None:
    found, centres, normal = measured(kind, edges, form)
    assert abs(radial(in_plane_errors(found, centres, normal), centres, normal).mean()) < 0.15


@pytest.mark.parametrize(("kind", "edges", "form"), CASES)
def test_no_error_hides_behind_its_uncertainty(kind: Kind, edges: str, form: str) -> None:
    found, centres, normal = measured(kind, edges, form)
    distance = np.linalg.norm(in_plane_errors(found, centres, normal), axis=1)
    across = np.eye(3) - np.outer(normal, normal)
    for point in found.points:
        assert point.covariance is not None
        u_mm = np.sqrt(np.trace(across @ point.covariance @ across) / 2)
        nearest = int(np.linalg.norm(across @ (centres - point.centre).T, axis=0).argmin())
        assert distance[nearest] < 4.0 * u_mm, (distance[nearest], u_mm)


def test_the_ray_caster_draws_a_bore_where_geometry_says() -> None:
    normal = np.array([0.0, 0.0, 1.0])
    bore = Rod(np.array([0.05, -0.02, 1.0]), normal, 0.02, 0.3)
    depth = other.foot_depth(normal, 1.0, [bore], 0.2, np.array([0.0, 0.0, 1.0]))
    point = other.rays(slice(None), slice(None)) * depth[..., None]
    wall = np.nan_to_num(depth) > 1.0 + 1e-9
    assert wall.sum() > 500
    assert np.allclose(np.hypot(point[wall][:, 0] - 0.05, point[wall][:, 1] + 0.02), 0.02)
    on_face = np.abs(np.nan_to_num(depth) - 1.0) < 1e-12
    assert np.hypot(point[on_face][:, 0] - 0.05, point[on_face][:, 1] + 0.02).min() >= 0.02
    assert np.abs(point[on_face][:, :2]).max() <= 0.2


def test_the_ray_caster_draws_a_bar_where_geometry_says() -> None:
    normal = np.array([0.0, 0.0, 1.0])
    rod = Rod(np.array([0.06, 0.04, 0.9]), normal, 0.012, 0.2)
    depth = other.bars_depth(normal, 1.0, [[rod]])
    point = other.rays(slice(None), slice(None)) * depth[..., None]
    from_axis = np.hypot(point[..., 0] - 0.06, point[..., 1] - 0.04)
    top = np.isclose(depth, 0.9)
    assert from_axis[top].max() <= 0.012
    assert top.sum() * (0.9 / other.FX) * (0.9 / other.FY) == pytest.approx(np.pi * 0.012**2, rel=0.02)
    side = (np.nan_to_num(depth) > 0.9 + 1e-6) & (depth < 1.0 - 1e-6)
    assert np.allclose(from_axis[side], 0.012)
    # the second eye, 180 mm above, does not see the floor that lies below the bar in the image
    assert np.isnan(depth[:, int(other.FX * 0.06 / 0.95 + other.CX)]).sum() > 20
