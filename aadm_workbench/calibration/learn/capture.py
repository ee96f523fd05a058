"""One capture of a plate: its holes and pins found, and told which is which.

Pins and what lies in their shadow are no face. The search for holes would take their outlines for mouths, and its
pooled fits would follow them; so what is seen of the face beside the holes is laid flat first, where a pin hides it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.errors import ScanError
from aadm_workbench.extract.rebars import extract_rebars
from aadm_workbench.extract.sleeves import extract_sleeves
from aadm_workbench.model import Array, Camera, Extraction, Kind, Plane, Scan
from aadm_workbench.model.reason import said_of

_WITHIN_MM = 6.0  # of where the pins say that a hole is: a hole is found, or something else
_AROUND_HOLE = 1.4  # diameters: so far the face about a hole is left as it was seen
_OFF_FACE_MM = 3.0  # what is farther from the face is a pin, its side or its shadow
_LEAST_SEEN = 0.6  # of the holes, and of the pins: with fewer the plate is half out of view
_SEED = 1  # of plane hypotheses and thinned samples: any other moves centres by a hundredth of their u


@dataclass(frozen=True, eq=False)
class PlateCapture:
    """What one capture shows of a plate.

    Parameters
    ----------
    flat
        (n, 2) mm: centres in the plane of the face, x as the camera's, from the camera's own foot point on it.
    height_mm
        (n,) above the face.
    place
        (n,) which place of the plate each is.
    T_scan_plate
        (4, 4), by the pins.
    diameter_mm
        (n,) as measured.
    rings
        Of pixels that the camera was seen to drop at steps of holes and of pins; None where nothing tells.
    """

    source: str
    scan: Scan
    camera: Camera
    face: Plane
    flat: Array
    height_mm: Array
    place: Array
    T_scan_plate: Array
    diameter_mm: Array
    rings: Mapping[Kind, float | None] = field(default_factory=dict)

    @property
    def distance_mm(self) -> float:
        """From the camera to the face."""
        return abs(self.face.offset)

    @property
    def pitch_mm(self) -> float:
        """Distance of neighbouring lines of sight on the face, below the camera."""
        return self.distance_mm / self.camera.fx

    @property
    def tilt_deg(self) -> float:
        """Of the face against the camera's view."""
        return float(np.degrees(np.arccos(min(1.0, abs(self.face.normal[2])))))

    def window(self, height_mm: float, centre: Array, reach_mm: float) -> tuple[slice, slice]:
        """Rows and columns of the picture that hold what lies within a reach of a place (2,) over the face."""
        at = face_axes(self.face).T @ np.array([*centre, self.face.offset + height_mm])
        reach = reach_mm / (at[2] / self.camera.fx) / max(abs(float(self.face.normal[2])), 0.1) + 2.0
        u, v = self.camera.fx * at[0] / at[2] + self.camera.cx, self.camera.fy * at[1] / at[2] + self.camera.cy
        return (
            slice(max(0, int(v - reach)), max(0, int(v + reach) + 1)),
            slice(max(0, int(u - reach)), max(0, int(u + reach) + 1)),
        )


def face_axes(face: Plane) -> Array:
    """(3, 3) rows: the camera's x laid into the face, the direction across it, and the normal; right-handed."""
    first = np.array([1.0, 0.0, 0.0]) - face.normal[0] * face.normal
    first /= np.linalg.norm(first)
    return np.vstack([first, np.cross(face.normal, first), face.normal])


def captured_plate(scan: Scan, plate: Plate) -> PlateCapture:
    """Find a plate in a capture.

    Raises
    ------
    ScanError
        Where it cannot be: no organised depth map with intrinsics, too few holes or pins, or no pin corner.
    """
    if scan.camera is None or not scan.organised:
        raise ScanError(said_of(scan.source, "calibration.no_grid"))
    pins = extract_rebars(scan, plate.diameter_mm(Kind.REBAR), np.random.default_rng(_SEED))
    points = {kind: tuple(one for one in plate.points() if one.kind is kind) for kind in Kind}
    if not pins.points:
        raise ScanError(said_of(scan.source, "calibration.no_pins", why=pins.reason))
    match = match_extraction(points[Kind.REBAR], pins)
    if not match or match.orientation != "resolved":
        raise ScanError(said_of(scan.source, "calibration.no_turn", found=len(pins.points)))
    T_plate_scan = match.placements[0].T_design_scan
    T_scan_plate = np.asarray(np.linalg.inv(T_plate_scan), np.float64)
    expected = plate.centres(Kind.SLEEVE) @ T_scan_plate[:3, :3].T + T_scan_plate[:3, 3]
    holes = _holes(scan, plate, expected)
    index = {kind: [k for k, one in enumerate(plate.places) if one.kind is kind] for kind in Kind}
    of_hole = _nearest(holes, expected)
    of_pin = {int(m): k for k, m in enumerate(match.placements[0].matched.tolist()) if m >= 0}
    pairs = [(holes.points[m], index[Kind.SLEEVE][k]) for m, k in of_hole.items()]
    pairs += [(pins.points[m], index[Kind.REBAR][k]) for m, k in of_pin.items()]
    if len(of_hole) < _LEAST_SEEN * len(expected) or holes.plane is None:
        raise ScanError(said_of(scan.source, "calibration.few_holes", found=len(of_hole), count=len(expected)))
    axes = face_axes(holes.plane)
    local = np.array([point.centre for point, _ in pairs]) @ axes.T
    return PlateCapture(
        scan.source,
        scan,
        scan.camera,
        holes.plane,
        local[:, :2],
        local[:, 2] - holes.plane.offset,
        np.array([place for _, place in pairs], dtype=np.int64),
        T_scan_plate,
        np.array([point.diameter_mm for point, _ in pairs]),
        {Kind.SLEEVE: holes.rings, Kind.REBAR: pins.rings},
    )


def _nearest(holes: Extraction, expected: Array) -> dict[int, int]:
    """Which found hole is which expected one."""
    found = np.array([point.centre for point in holes.points]).reshape(-1, 3)
    off = np.linalg.norm(found[:, None] - expected[None], axis=2)
    nearest = off.argmin(axis=1) if off.size else np.zeros(0, dtype=np.int64)
    return {m: int(k) for m, k in enumerate(nearest) if off[m, k] < _WITHIN_MM and off[:, k].argmin() == m}


def _holes(scan: Scan, plate: Plate, expected: Array) -> Extraction:
    """The holes, looked for again where the face beside them is laid flat."""
    rng, diameter_mm = np.random.default_rng(_SEED), plate.diameter_mm(Kind.SLEEVE)
    first = extract_sleeves(scan, diameter_mm, rng)
    if first.plane is None:
        raise ScanError(said_of(scan.source, "calibration.no_holes", why=first.reason))
    flat = _laid_flat(scan, first.plane, expected, diameter_mm, plate.size_mm)
    again = extract_sleeves(flat, diameter_mm, np.random.default_rng(_SEED))
    if again.plane is None:
        raise ScanError(said_of(scan.source, "calibration.no_holes", why=again.reason))
    return again


def _laid_flat(scan: Scan, face: Plane, holes: Array, diameter_mm: float, size_mm: float) -> Scan:
    """The scan, with the face where pins and their shadows hide it, about holes (n, 3) mm as it was seen."""
    on_face = sight_on_plane(scan, face)
    middle, axes = holes.mean(axis=0), face_axes(face)
    about = (on_face - middle) @ axes[:2].T
    hidden = np.hypot(about[..., 0], about[..., 1]) < size_mm / 2.0
    for hole in (holes - middle) @ axes[:2].T:
        hidden &= np.hypot(about[..., 0] - hole[0], about[..., 1] - hole[1]) > _AROUND_HOLE * diameter_mm
    height = face.height(scan.points.astype(np.float64))
    hidden &= ~(np.abs(height) < _OFF_FACE_MM)
    return replace(scan, points=np.where(hidden[..., None], on_face, scan.points))


def sight_on_plane(scan: Scan, plane: Plane) -> Array:
    """Where the line of sight of each pixel meets a plane, (h, w, 3) mm."""
    camera, (rows, columns) = scan.camera, scan.points.shape[:2]
    assert camera is not None
    u, v = np.meshgrid(np.arange(columns), np.arange(rows))
    sight = np.stack([(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, np.ones(u.shape)], -1)
    along: Array = sight * (plane.offset / (sight @ plane.normal))[..., None]
    return along
