"""One capture of a plate by the ray caster: its places are found, told apart, and its edges are measured."""

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.calibration.learn.capture import PlateCapture, captured_plate
from aadm_workbench.calibration.learn.face import seen_face
from aadm_workbench.calibration.plate.plate import Plate, drawn_plate
from aadm_workbench.errors import ScanError
from aadm_workbench.model import Kind, Scan
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.pair import Taken
from aadm_workbench.twin.plate import MadePlate, made_plate, plate_captures
from aadm_workbench.twin.scene import TrueScan


@pytest.fixture(scope="module")
def plate() -> Plate:
    return drawn_plate(12, 36.0, 160.0, 20.0)


@pytest.fixture(scope="module")
def made(plate: Plate) -> MadePlate:
    return made_plate(plate, np.random.default_rng(3))


@pytest.fixture(scope="module")
def shot(made: MadePlate) -> TrueScan:
    (scan,) = plate_captures(made, 1, CameraNoise(depth_at_1m=0.07), Taken(), np.random.default_rng(4))
    return scan


@pytest.fixture(scope="module")
def capture(made: MadePlate, shot: TrueScan) -> PlateCapture:
    return captured_plate(shot.scan("plate.tiff"), made.measured)


def test_every_place_is_found_where_it_truly_is(plate: Plate, made: MadePlate, capture: PlateCapture) -> None:
    assert sorted(capture.place.tolist()) == list(range(len(plate.places)))
    true = np.array([made.places[plate.places[k].label] for k in capture.place])
    seen, known = (xy[:, 0] + 1j * xy[:, 1] for xy in (capture.flat, true))
    seen, known = seen - seen.mean(), known - known.mean()
    turn = np.angle(np.sum(seen * np.conj(known)))
    assert np.abs(seen - known * np.exp(1j * turn)).max() < 0.35  # nearest neighbours are 113 mm apart
    pins = np.array([plate.places[k].kind is Kind.REBAR for k in capture.place])
    assert capture.height_mm[pins] == pytest.approx(true[pins, 2], abs=0.1)


def test_the_face_has_the_noise_that_was_put_in(made: MadePlate, capture: PlateCapture) -> None:
    face = seen_face(capture, made.measured, capture.flat)
    assert face.noise_mm == pytest.approx(0.07 * (capture.distance_mm / 1000.0) ** 2, rel=0.15)
    assert face.form_95_mm < face.flatness_mm


def test_a_cloud_without_a_grid_is_refused(plate: Plate, shot: TrueScan) -> None:
    scan = shot.scan("cloud.ply")
    with pytest.raises(ScanError, match=r"cloud\.ply.*grid"):
        captured_plate(Scan(scan.points.reshape(-1, 3), "cloud.ply", camera=scan.camera), plate)


def test_a_plate_without_its_pins_is_refused(plate: Plate, shot: TrueScan) -> None:
    scan = shot.scan("far.tiff")
    points = np.where((scan.points[..., 2:] < 1255.0), np.nan, scan.points)
    with pytest.raises(ScanError, match=r"far\.tiff"):
        captured_plate(replace(scan, points=points), plate)
