"""What is found in a file in OpenGL's axes is told in the file's own coordinates."""

from dataclasses import replace

import numpy as np

from aadm_workbench.extract.file_axes import in_coordinates_of_the_file
from aadm_workbench.extract.method import extract
from aadm_workbench.hoisting.frame import HoistingFrame, frame_of
from aadm_workbench.model import OPENGL_AXES, Kind
from tests.scenes import lab_bars, lab_scan


def test_points_plane_and_vertical() -> None:
    scan = lab_scan(lab_bars()).scan()
    found = extract(scan, Kind.REBAR, 18.0, "refined", np.random.default_rng(0))
    turned = in_coordinates_of_the_file(found, replace(scan, axes=OPENGL_AXES))
    assert in_coordinates_of_the_file(found, scan) is found
    assert found.plane is not None
    assert found.vertical is not None
    assert turned.plane is not None
    assert turned.vertical is not None
    assert turned.vertical.tolist() == [found.vertical[0], -found.vertical[1], -found.vertical[2]]
    for one, other in zip(found.points, turned.points, strict=True):
        x, y, z = one.centre
        assert other.centre.tolist() == [x, -y, -z]
        # Heights over the plane and Mahalanobis lengths are the same in any frame.
        assert np.isclose(
            turned.plane.normal @ other.centre - turned.plane.offset,
            found.plane.normal @ one.centre - found.plane.offset,
        )
        assert one.covariance is not None
        assert other.covariance is not None
        about = np.array([0.3, -0.2, 0.1])
        assert np.isclose(
            about @ one.covariance @ about, [0.3, 0.2, -0.1] @ other.covariance @ np.array([0.3, 0.2, -0.1])
        )


def test_a_hoisting_frame_leads_back_to_the_file() -> None:
    scan = lab_scan(lab_bars()).scan()
    frames = [frame_of(one) for one in (scan, replace(scan, axes=OPENGL_AXES))]
    assert isinstance(frames[0], HoistingFrame)
    assert isinstance(frames[1], HoistingFrame)
    place = np.array([[10.0, 20.0, 900.0]])
    x, y, z = frames[0].to_scan(place)[0]
    assert np.allclose(frames[1].to_scan(place), [x, -y, -z])
