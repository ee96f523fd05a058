"""Coordinates as the PFNC packs and the SFNC scales them; the expected points are packed here, byte by byte."""

from __future__ import annotations

import struct
from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.camera.coordinates import Axis, Coding, Part, measured
from aadm_workbench.camera.pinhole import camera_of
from aadm_workbench.errors import CaptureError
from aadm_workbench.model import Camera

WIDTH, HEIGHT = 3, 2
POINTS = [
    (-12.5, 4.25, 810.0),
    (0.1, 4.3, 811.5),
    (12.7, 4.2, 809.9),
    (-12.4, 9.0, 902.3),
    (1.0, 2.0, 900.0),
    (3.0, 2.0, 1.0),
]


def packed(kind: str, order: str, values: list[tuple[float, ...]]) -> np.ndarray:
    """Values as a camera sends them: pixel by pixel, or coordinate by coordinate."""
    flat = [one for point in values for one in point] if order == "" else [p[k] for k in range(3) for p in values]
    content = struct.pack(f"<{len(flat)}{kind}", *flat)
    return np.frombuffer(content, {"f": "<f4", "H": "<u2"}[kind])


def plain(points: np.ndarray) -> list[tuple[float, ...]]:
    return [tuple(row) for row in points.reshape(-1, 3).tolist()]


@pytest.mark.parametrize("order", ["", "_Planar"])
def test_floats_keep_their_bits(order: str) -> None:
    part = Part(f"Coord3D_ABC32f{order}", WIDTH, HEIGHT, packed("f", order, POINTS))
    found = measured([part], Coding()).points
    assert found.shape == (HEIGHT, WIDTH, 3)
    assert found.dtype == np.float32
    expected = [struct.unpack("<3f", struct.pack("<3f", *point)) for point in POINTS]
    assert plain(found) == expected


def test_three_parts_are_one_cloud_and_other_parts_do_no_harm() -> None:
    parts = [Part("Mono8", WIDTH, HEIGHT, np.zeros(6, np.uint8))]
    parts += [
        Part(f"Coord3D_{axis}32f", WIDTH, HEIGHT, np.array([p[k] for p in POINTS], np.float32))
        for k, axis in enumerate("ABC")
    ]
    assert plain(measured(parts[::-1], Coding()).points) == plain(np.array(POINTS, np.float32))


def test_steps_are_scaled_and_shifted_for_each_axis_in_the_unit_of_the_device() -> None:
    steps = [(1000, 2000, 3000), (0, 65535, 40500), (7, 8, 9), (1, 1, 1), (5, 5, 0), (2, 2, 65535)]
    axes = {"A": Axis(0.01, -20.0), "B": Axis(0.02, -30.0), "C": Axis(0.025, 100.0, 0.0)}
    part = Part("Coord3D_ABC16", WIDTH, HEIGHT, packed("H", "", steps))
    for unit, mm in (("Millimeter", 1.0), ("Meter", 1000.0), ("Inch", 25.4)):
        found = measured([part], Coding(unit=unit, axes=axes)).points.reshape(-1, 3)
        for (a, b, c), point in zip(steps, found.tolist(), strict=True):
            if c == 0:  # flagged as no return before it is scaled
                assert np.isnan(point).all()
            else:
                wanted = [(0.01 * a - 20.0) * mm, (0.02 * b - 30.0) * mm, (0.025 * c + 100.0) * mm]
                assert point == pytest.approx(wanted, rel=1e-6)


def test_a_point_without_one_coordinate_is_none() -> None:
    holed = [(0.0, 0.0, 0.0), (np.nan, 1.0, 800.0), (1.0, np.inf, 800.0), *POINTS[3:]]
    found = measured([Part("Coord3D_ABC32f", WIDTH, HEIGHT, packed("f", "", holed))], Coding()).points
    assert np.isnan(found[0]).all()
    assert np.isfinite(found[1]).all()


def test_depths_alone_come_with_the_camera_of_the_device() -> None:
    camera = Camera(1000.0, 1000.0, 1.2, 0.8, WIDTH, HEIGHT)
    part = Part("Coord3D_C16", WIDTH, HEIGHT, np.array([0, 1, 40000, 40001, 65535, 3], "<u2"))
    found = measured([part], Coding(mode="CalibratedC", camera=camera, axes={"C": Axis(0.02)}))
    assert (found.camera, found.points) == (camera, None)
    assert np.isnan(found.depth_mm[0, 0])
    assert found.depth_mm.reshape(-1)[1:].tolist() == pytest.approx([0.02, 800.0, 800.02, 1310.7, 0.06], rel=1e-6)


def test_rectified_depths_stand_on_an_even_grid() -> None:
    axes = {"A": Axis(0.5, -3.0), "B": Axis(0.25, 7.0), "C": Axis(0.1)}
    part = Part("Coord3D_C16", WIDTH, HEIGHT, np.full(6, 8000, "<u2"))
    found = measured([part], Coding(mode="RectifiedC", axes=axes)).points
    assert found[1, 2].tolist() == pytest.approx([-2.0, 7.25, 800.0])


WHOLE = Part("Coord3D_ABC32f", WIDTH, HEIGHT, packed("f", "", POINTS))
DEPTHS = Part("Coord3D_C16", WIDTH, HEIGHT, np.full(6, 8000, "<u2"))


@pytest.mark.parametrize(
    ("part", "coding", "said"),
    [
        (WHOLE, Coding(unit="Pixel"), "Scan3dDistanceUnit"),
        (WHOLE, Coding(unit=""), "not said by the camera"),
        (WHOLE, Coding(system="Spherical"), "Cartesian"),
        (WHOLE, Coding(reference="Transformed"), "Anchor"),
        (WHOLE, Coding(mode="UncalibratedC"), "no distance"),
        (DEPTHS, Coding(mode="DisparityC"), "no distance"),
        (replace(WHOLE, values=WHOLE.values[:-1]), Coding(), "not whole"),
        (replace(WHOLE, width=0), Coding(), "not whole"),
        (Part("Mono8", WIDTH, HEIGHT, np.zeros(6, np.uint8)), Coding(), "no coordinates"),
        (replace(WHOLE, values=np.zeros(18, "<f4")), Coding(), "no return"),
        (DEPTHS, Coding(mode="CalibratedC", distortion=(0.01, -0.2)), "not straightened"),
        (DEPTHS, Coding(mode="CalibratedC", camera=Camera(900.0, 900.0, 2.0, 2.0, 4, 4)), "4 x 4"),
    ],
)
def test_what_cannot_be_believed_is_named(part: Part, coding: Coding, said: str) -> None:
    with pytest.raises(CaptureError, match=said):
        measured([part], coding)


def test_the_camera_is_found_from_its_own_points_and_not_from_a_bent_or_distant_one() -> None:
    true = Camera(1234.5, 1240.25, 151.25, 97.75, 300, 200)
    v, u = np.mgrid[0:200, 0:300].astype(np.float64)
    z = 800.0 + 0.3 * u + 25.0 * np.sin(v / 9.0)
    x, y = (u - true.cx) / true.fx, (v - true.cy) / true.fy
    points = np.stack([x * z, y * z, z], axis=-1).astype(np.float32)
    points[40:60, 100:150] = np.nan
    found = camera_of(points)
    assert found is not None
    assert (found.width, found.height) == (300, 200)
    assert [found.fx, found.fy, found.cx, found.cy] == pytest.approx([1234.5, 1240.25, 151.25, 97.75], abs=2e-3)
    bent = 1.0 + 0.05 * (x**2 + y**2)
    assert camera_of(np.stack([x * bent * z, y * bent * z, z], axis=-1)) is None
    assert camera_of(np.stack([u, v, z], axis=-1)) is None
