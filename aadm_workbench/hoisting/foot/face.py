"""The foot face of a hanging column in a frame: the plane through which rays pass into sleeves.

The side faces of the column hold ten times more points, the floor is as level as the foot, and of the foot itself a
camera that looks along it keeps few points. So planes are proposed by points that are near to each other, and of the
planes that face the camera the foot is the one with round openings: discs through which rays pass to what lies behind.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np
import numpy.typing as npt

from aadm_workbench.extract.plane import refined_plane
from aadm_workbench.hoisting.frame import HoistingFrame, LocalAxes
from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray, Plane, Reason

_SAMPLE_PIXELS = 90_000  # every fifth row and column of 1920 × 1200
# sides of the column, floor and walls have more points than a foot that is seen along (a choice: ±30 % moves nothing
# on sound scans)
_PLANES_MAX = 9
# three points near to each other mostly lie on one plane, so that few are needed (a choice: ±30 % moves centres by up
# to 0.9 u)
_HYPOTHESES = 130
_SCORED = 1_000  # to rank them by
_REFINED_ON, _MEASURED_ON = 2_500, 6_000  # noise averages out long before; what remains is the camera's warp
_FEWEST = 60  # of the sample, or of the rays about it (a choice: ±30 % moves nothing on sound scans)
# sides of a triple: so long that noise hardly turns its plane, so short that it stays on one face
_NEIGHBOURS_MM = (12.0, 160.0)
_BAND_MM, _BAND_SIGMAS = 1.2, 3.5  # as in plane.py
_TAKEN_MM = 2.5  # twice the band about a plane: what the search for the next one leaves out
_CELL_MM, _CELLS_OF_RADIUS = 1.6, 6.0  # so coarse that rays fill the cells of an opening, and six to its radius
_BEHIND_MM = 0.7  # a ray that ends less far behind the face may have ended on it: noise and worn rims
_BEHIND_SHARE = 0.04  # of the diameter
_DEEPEST = 2.5  # diameters behind the face up to which a ray through a mouth ends
# of the rays within, of those around (a choice: ±30 % moves centres by up to 0.6 u)
_OPEN_SHARE, _RING_SHARE = 0.35, 0.45
_AS_DENSE = 0.25  # half of the returns of a wall may be lost, and half again where a mouth is half hidden
_MOUTHS_MIN = 2  # one round opening may be a hole in anything
_REGION_PIXELS = 160_000  # about one ray a cell on a foot of 600 mm
_STEEPEST_COSINE = 0.62  # of the view against the normal: what is seen more squarely is no foot beside a camera
_ROUGHEST_MM = 0.8  # eight times the noise of the reference camera at 1 m
_CANDIDATES_MAX = 80  # far more than a foot has sleeves: it only bounds the time


@dataclass(frozen=True, eq=False)
class FootFace(LocalAxes):
    """The foot face with its openings: x and y lie in the face, z points into the column, the origin is on the face.

    ``mouths`` (k, 2) mm are rough centres of round openings; ``residual_mm`` is the noise of points on the face.
    ``bend`` (6,) lifts it off its plane by what :func:`level_terms` names, and ``bend_mm`` is how far its mouths
    scatter about that plane by it.
    """

    mouths: Array
    residual_mm: float
    bend: Array = field(default_factory=lambda: np.zeros(6))
    bend_mm: float = 0.0

    def level(self, place: Array) -> tuple[float, Array]:
        """Height, mm, and slopes (2,) of the face at a place (2,) mm."""
        x, y = place
        _, along_x, along_y, xx, yy, xy = self.bend
        slopes = np.array([along_x + 2.0 * xx * x + xy * y, along_y + 2.0 * yy * y + xy * x])
        return float(level_terms(place[None])[0] @ self.bend), slopes


def level_terms(places: Array) -> Array:
    """What the height of a bent face is made of at places (n, 2) mm: 1, x, y, x², y², xy."""
    x, y = places.T
    return np.column_stack([np.ones(len(places)), x, y, x**2, y**2, x * y])


@dataclass(frozen=True)
class NoFace:
    """Why no foot was found."""

    reason: str


def find_foot(frame: HoistingFrame, diameter_mm: float, rng: np.random.Generator) -> FootFace | NoFace:
    """Find the face with round openings of about ``diameter_mm``."""
    coarse, pixels, stride = _thinned(frame)
    if len(coarse) < _FEWEST:
        return NoFace(Reason("hoisting.empty"))
    left = np.ones(len(coarse), bool)
    best: FootFace | None = None
    for _ in range(_PLANES_MAX):
        plane = _local_plane(coarse, pixels, left, rng)
        if plane is None:
            break
        near = np.abs(plane.height(coarse)) < _TAKEN_MM
        if _like_a_foot(plane, coarse[near & left]):
            face = _with_mouths(frame, plane, coarse[near & left], pixels[near & left], stride, diameter_mm)
            if face is not None and (best is None or len(face.mouths) > len(best.mouths)):
                best = face
        left &= ~near
        if left.sum() < _FEWEST or (best is not None and len(best.mouths) >= 5):
            break
    if best is None:
        return NoFace(Reason("hoisting.no_foot", diameter_mm=diameter_mm))
    return best


def _like_a_foot(plane: Plane, on_plane: Array) -> bool:
    """Whether a plane faces the camera, is flat, and is seen along rather than squarely."""
    if plane.offset >= 0 or plane.residual_mm > _ROUGHEST_MM or len(on_plane) < _FEWEST // 2:
        return False
    middle = np.median(on_plane, axis=0)
    return bool(abs(plane.normal @ middle) < _STEEPEST_COSINE * np.linalg.norm(middle))


def face_axes(plane: Plane) -> Array:
    """Rotation (3, 3), frame to face: rows x, y and z, into the column; seen against z, x to y is counter-clockwise."""
    up = -plane.normal
    helper = np.eye(3)[int(np.abs(up).argmin())]
    first = np.cross(helper, up)
    first /= np.linalg.norm(first)
    return np.vstack([first, np.cross(up, first), up])


def _thinned(frame: HoistingFrame) -> tuple[Array, IntArray, int]:
    rows, columns = frame.shape
    stride = max(1, int(np.sqrt(rows * columns / _SAMPLE_PIXELS)))
    coarse = frame.points[::stride, ::stride]
    found = np.nonzero(np.isfinite(coarse[..., 2]))
    return coarse[found].astype(np.float64), np.column_stack(found).astype(np.int64), stride


def _local_plane(points: Array, pixels: IntArray, left: BoolArray, rng: np.random.Generator) -> Plane | None:
    """The plane with most points among those through three points near to each other; facing the camera."""
    index = np.flatnonzero(left)
    if len(index) < _FEWEST:
        return None
    chosen, near = points[index], pixels[index]
    seed = rng.integers(0, len(index), _HYPOTHESES)
    triples = np.column_stack([seed, _beside(near, seed, rng), _beside(near, seed, rng)])
    corner = chosen[triples]
    one, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    normals = np.cross(one, other)
    lengths = np.linalg.norm(normals, axis=1)
    reach = np.maximum(np.linalg.norm(one, axis=1), np.linalg.norm(other, axis=1))
    usable = (lengths > _NEIGHBOURS_MM[0] ** 2) & (reach < _NEIGHBOURS_MM[1])
    if not usable.any():
        return None
    normals = normals[usable] / lengths[usable, None]
    offsets = np.einsum("ij,ij->i", normals, corner[usable, 0])
    scored = chosen[rng.integers(0, len(chosen), _SCORED)] if len(chosen) > _SCORED else chosen
    heights = scored.astype(np.float32) @ normals.T.astype(np.float32)
    inliers = (np.abs(heights - offsets.astype(np.float32)) < 2.0 * _BAND_MM).sum(axis=0)
    best = int(inliers.argmax())
    if inliers[best] * len(chosen) / len(scored) < _FEWEST:
        return None
    plane = Plane(normals[best], float(offsets[best]))
    close = chosen[np.abs(plane.height(chosen)) < 3.0 * _TAKEN_MM]
    plane = refined_plane(close[:: len(close) // _REFINED_ON + 1], plane, _BAND_MM)
    return plane if plane.offset < 0 else Plane(-plane.normal, -plane.offset, plane.residual_mm)


def _beside(pixels: IntArray, seed: IntArray, rng: np.random.Generator) -> IntArray:
    """For each seed another of the points (n,), within some rows and columns of it: points come row by row."""
    # of the sample: some centimetres of a face that is seen flat, wider than high
    rows = np.searchsorted(pixels[:, 0], pixels[seed, 0] + rng.integers(-12, 13, len(seed)))
    columns = pixels[seed, 1] + rng.integers(-40, 41, len(seed))  # as above
    begin = np.clip(rows, 0, len(pixels) - 1)
    key = pixels[:, 0] * 1_000_000 + pixels[:, 1]
    place = np.searchsorted(key, pixels[begin, 0] * 1_000_000 + columns)
    return np.asarray(np.clip(place, 0, len(pixels) - 1))


def _with_mouths(
    frame: HoistingFrame, plane: Plane, on_plane: Array, pixels: IntArray, stride: int, diameter_mm: float
) -> FootFace | None:
    """The plane as a foot face, if rays pass through round openings in it."""
    axes = face_axes(plane)
    origin = plane.normal * plane.offset
    flat = (on_plane - origin) @ axes.T
    middle = np.median(flat[:, :2], axis=0)
    origin = origin + middle @ axes[:2]
    low = np.quantile(pixels, 0.01, axis=0).astype(int) * stride
    # one in a hundred at either end may belong to something else
    high = (np.quantile(pixels, 0.99, axis=0).astype(int) + 1) * stride
    # a twentieth more: mouths at the rim of the foot
    margin = np.maximum((high - low) // 20, 2 * stride)
    low, high = np.maximum(low - margin, 0), np.minimum(high + margin, frame.shape)
    step = _steps(frame, axes, origin, low, high)
    region = frame.points[low[0] : high[0] : step[0], low[1] : high[1] : step[1]]
    region = region[np.isfinite(region[..., 2])]
    plane, axes, origin = _measured_plane(plane, region, axes, origin)
    turn, shift = axes.astype(np.float32), origin.astype(np.float32)
    local = (region - shift) @ turn.T
    eye = axes @ -origin
    height = local[:, 2]
    scale = np.where(height > 0, eye[2] / (eye[2] - height), 1.0).astype(np.float32)
    crossing = eye[:2].astype(np.float32) + (local[:, :2] - eye[:2].astype(np.float32)) * scale[:, None]
    # what a camera scatters grows with the distance squared
    noise_mm = plane.residual_mm * (region[:, 2] / np.float32(np.median(on_plane[:, 2]))) ** 2
    # 4.5 standard deviations: fewer than one of 200,000 points of the face itself
    behind_mm = np.maximum(4.5 * noise_mm, max(_BEHIND_MM, _BEHIND_SHARE * diameter_mm))
    on_face = np.abs(height) < behind_mm
    through = (height > behind_mm) & (height < _DEEPEST * diameter_mm)
    mouths = _discs(crossing[through], local[on_face, :2], diameter_mm / 2)
    if len(mouths) < _MOUTHS_MIN:
        return None
    # rays that end just behind the far rim do not count as passing: what is left of a mouth lies nearer to the camera
    away = mouths - eye[:2]
    distance = np.linalg.norm(away, axis=1)[:, None]
    climb = np.abs(eye[2]) / distance
    # never more than a mouth has
    missing = np.minimum(0.5 * float(np.median(behind_mm)) / climb, 0.4 * diameter_mm)
    mouths = mouths + missing * away / distance
    return FootFace(axes, origin, mouths, plane.residual_mm)


def _measured_plane(plane: Plane, region: FloatArray, axes: Array, origin: Array) -> tuple[Plane, Array, Array]:
    """The plane by least squares on more of its points, with the axes and the origin that lie on it."""
    # the walls of the sleeves return more points than the face: none of them may come into the band
    band_mm = _BAND_SIGMAS * plane.residual_mm
    near = region[np.abs(region @ plane.normal.astype(np.float32) - np.float32(plane.offset)) < band_mm]
    if len(near) < _FEWEST:
        return plane, axes, origin
    # refined_plane looks 2.5 times as far
    plane = refined_plane(near[:: len(near) // _MEASURED_ON + 1].astype(np.float64), plane, band_mm / 2.5)
    return plane, face_axes(plane), origin - plane.normal * (float(plane.normal @ origin) - plane.offset)


def _steps(frame: HoistingFrame, axes: Array, origin: Array, low: IntArray, high: IntArray) -> tuple[int, int]:
    """Row and column steps at which neighbouring rays still cross the face about a cell apart."""
    middle = (low + high) // 2
    window = frame.rays(slice(middle[0], middle[0] + 2), slice(middle[1], middle[1] + 2)).reshape(-1, 3)
    reach = float(axes[2] @ origin) / (window @ axes[2])
    crossing = (window * reach[:, None]) @ axes[:2].T
    pitch = np.array([np.linalg.norm(crossing[2] - crossing[0]), np.linalg.norm(crossing[1] - crossing[0])])
    steps = np.maximum((_CELL_MM / np.maximum(pitch, 1e-3)).astype(int), 1)
    while np.prod((high - low) / steps) > _REGION_PIXELS:
        steps = steps + (pitch * steps <= (pitch * steps).min() + 1e-9)
    return int(min(steps[0], 8)), int(min(steps[1], 8))


def _discs(through: FloatArray, face: FloatArray, radius_mm: float) -> Array:
    """Centres (k, 2) mm of discs that rays pass through, in a face that stops them around."""
    # fewer make no disc
    if len(through) < 20 or len(face) < 20:
        return np.empty((0, 2))
    # one in five hundred may fly, and must not widen the picture
    low = np.quantile(face[::10].astype(np.float64), 0.002, axis=0) - 3 * radius_mm
    high = np.quantile(face[::10].astype(np.float64), 0.998, axis=0) + 3 * radius_mm  # as above
    # cells: bounds the time of the filters
    cell_mm = max(_CELL_MM, radius_mm / _CELLS_OF_RADIUS, float(np.sqrt(np.prod(high - low) / 400_000)))
    columns, rows = np.ceil((high - low) / cell_mm).astype(int) + 1
    passed, stopped = (_counted(xy, low, cell_mm, rows, columns) for xy in (through, face))
    # clear of the rim, which cells and chamfers blur; around, up to the next mouth at the nearest
    inside = _kernel(0.0, 0.85 * radius_mm, cell_mm)
    around = _kernel(1.15 * radius_mm, 1.7 * radius_mm, cell_mm)  # as above
    inner_passed, inner_stopped = (cv2.filter2D(image, -1, inside) for image in (passed, stopped))
    outer_stopped = cv2.filter2D(stopped, -1, around)
    open_share = inner_passed / np.maximum(inner_passed + inner_stopped, 1e-6)
    # as many rays pass through an opening as end on the face beside it; strays are far fewer
    enough = inner_passed / inside.sum() > _AS_DENSE * outer_stopped / around.sum()
    # what is typical of where the face is seen at all
    enough &= outer_stopped > _AS_DENSE * float(np.quantile(outer_stopped[outer_stopped > 0], 0.8))
    score = np.where(enough & (open_share > _OPEN_SHARE), open_share, 0.0).astype(np.float32)
    # a quarter of the radius, and a cell about: then one disc has one peak
    score = np.asarray(cv2.GaussianBlur(score, (0, 0), max(0.25 * radius_mm / cell_mm, 0.8)), np.float32)
    # no two mouths are nearer than a radius
    reach = 2 * int(np.ceil(1.1 * radius_mm / cell_mm)) + 1
    highest = cv2.dilate(score, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach)))
    # what the blur leaves of a disc a quarter of which is open
    found = np.column_stack(np.nonzero((score >= highest) & (score > 0.15)))
    found = found[np.argsort(-score[found[:, 0], found[:, 1]], kind="stable")[:_CANDIDATES_MAX]]
    kept = [place for place in found if _enclosed(passed, stopped, place, around)]
    return np.asarray(low + (np.array(kept).reshape(-1, 2)[:, ::-1] + 0.5) * cell_mm, np.float64)


def _enclosed(
    passed: npt.NDArray[np.float32], stopped: npt.NDArray[np.float32], place: IntArray, around: npt.NDArray[np.float32]
) -> bool:
    """Whether the face stops rays on three of the four sides of an opening at least."""
    half = len(around) // 2
    low = place - half
    high = place + half + 1
    if (low < 0).any() or high[0] > passed.shape[0] or high[1] > passed.shape[1]:
        return False
    ended = stopped[low[0] : high[0], low[1] : high[1]] * around
    went_on = passed[low[0] : high[0], low[1] : high[1]] * around
    shares = []
    for rows in (slice(0, half), slice(half, None)):
        for columns in (slice(0, half), slice(half, None)):
            count = float(ended[rows, columns].sum())
            shares.append(count / max(count + float(went_on[rows, columns].sum()), 1.0))
    return sorted(shares)[1] > _RING_SHARE


def _counted(xy: FloatArray, low: Array, cell_mm: float, rows: int, columns: int) -> npt.NDArray[np.float32]:
    place = np.floor((xy - low.astype(np.float32)) / np.float32(cell_mm)).astype(np.int64)
    inside = (place[:, 0] >= 0) & (place[:, 1] >= 0) & (place[:, 0] < columns) & (place[:, 1] < rows)
    flat = place[inside, 1] * columns + place[inside, 0]
    return np.bincount(flat, minlength=rows * columns).reshape(rows, columns).astype(np.float32)


def _kernel(inner_mm: float, outer_mm: float, cell_mm: float) -> npt.NDArray[np.float32]:
    half = int(np.ceil(outer_mm / cell_mm))
    offset = np.arange(-half, half + 1) * cell_mm
    distance = np.hypot(offset[:, None], offset[None, :])
    return np.asarray((distance >= inner_mm) & (distance <= outer_mm), np.float32)
