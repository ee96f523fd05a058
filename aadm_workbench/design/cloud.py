"""As-designed points of a cloud that was sampled from a model: its upright round walls, exact where its points are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from aadm_workbench.design.cloud_walls import (
    _ON_FACE_MM,
    FEWEST_ON_RING,
    OFF_WALL_MM,
    OFF_WALL_RATIO,
    PER_MM,
    THICKNESS_MM,
    Ring,
    Wall,
    _crowded,
    wall_of,
)
from aadm_workbench.design.elements import Element, Solid
from aadm_workbench.design.recognise.flat_circle import flat_circle, widest_gap
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Array, BoolArray, IntArray, Reason

_FEWEST_POINTS = 200  # a column with a ring of sleeves has thousands

_GAP_POINTS = 12.0
"""Along an outline of thousands of random points no gap is wider than so many mean distances."""

_GAP_MM = (2.0, 7.0)
"""The narrowest room between a bar and its sleeve is 5 mm on the side; 7 mm keep sleeves of common size apart."""

_CONCRETE_GAP_MM = 60.0  # between points of one body: wider than any spacing of points that still shows a bar
_RADIUS_MM = (4.0, 80.0)  # from the thinnest bar (8 mm) to beyond the widest sleeve
# less than a quarter of its circle may be missing: a plate beside a bore has more missing
_WIDEST_GAP = np.radians(75.0)
_SAME_AXIS_MM = 3.0  # from slab to slab: an axis that leans by two degrees moves as much in 100 mm
_LARGEST_SAMPLE = 1_500_000  # points: bounds the memory
_SMALLEST_COLUMN_MM = 150.0  # across: no column is thinner, and a bar or a sleeve alone is


def elements_of_cloud(points: Array, source: str) -> list[Element]:
    """The column and the bars that a cloud of a model shows.

    Parameters
    ----------
    points
        (n, 3) float64, mm, model frame, z up; on faces, in holes and on bars, with little or no noise.

    Raises
    ------
    DesignError
        Where there are too few points.
    """
    points = points[np.isfinite(points).all(axis=1)]
    if len(points) < _FEWEST_POINTS:
        raise DesignError(Reason("design.few_points", source=source, count=len(points)))
    origin = np.round(points.mean(axis=0))
    local = points[:: max(1, len(points) // _LARGEST_SAMPLE)] - origin
    slabs, gap_mm = _slabs(local)
    rings, outlines = _rings(slabs, gap_mm)
    walls = [wall for family in _families(rings) if (wall := wall_of(local, family, slabs)) is not None]
    elements = [_bar(number, wall, origin) for number, wall in enumerate(walls, start=1) if not wall.inside]
    holes = [wall for wall in walls if wall.inside]
    return [*_columns(holes, outlines, slabs, local, origin), *elements]


def _slabs(points: Array) -> tuple[list[Array], float]:
    """Points slab by slab from below, those of level faces left out; and how far outlines in them may have gaps, mm."""
    spacing_mm = _spacing(points)
    low, high = float(points[:, 2].min()), float(points[:, 2].max())
    thickness_mm = float(np.clip(PER_MM * spacing_mm**2, *THICKNESS_MM))
    upright = points[~_on_level_faces(points[:, 2], spacing_mm)]
    number = np.floor((upright[:, 2] - low) / thickness_mm).astype(np.int64)
    order = np.argsort(number, kind="stable")
    count = int((high - low) / thickness_mm) + 1
    cuts = np.searchsorted(number[order], np.arange(1, count))
    gap_mm = float(np.clip(_GAP_POINTS * spacing_mm**2 / thickness_mm, *_GAP_MM))
    return list(np.split(upright[order], cuts)), gap_mm


def _spacing(points: Array) -> float:
    """Side of the square that one point of a surface stands for, mm, from distances to near neighbours."""
    from scipy.spatial import cKDTree  # slow to import, and only clouds need it

    some = points[:: max(1, len(points) // 2000)]
    nearest = cKDTree(points).query(some, k=9)[0][:, 1:]
    # The eighth neighbour on a plane of density d stands at the root of 8 / (pi d).
    return float(np.median(nearest[:, -1]) * np.sqrt(np.pi / 8.0))


def _on_level_faces(z: Array, spacing_mm: float) -> BoolArray:
    """Which points lie on level faces: at heights that far more points have than those above and below."""
    step_mm = max(0.5, 0.25 * spacing_mm)
    cell = np.floor((z - z.min()) / step_mm).astype(np.int64)
    counts = np.bincount(cell).astype(np.float64)
    usual = float(np.median(counts[counts > 0]))
    crowded = counts > 4.0 * usual + 20.0
    crowded[1:] |= crowded[:-1].copy()
    crowded[:-1] |= crowded[1:].copy()
    level: BoolArray = crowded[cell]
    return level


def _rings(slabs: Sequence[Array], gap_mm: float) -> tuple[list[Ring], list[list[Array]]]:
    """Round outlines of all slabs, and the outlines of concrete in each."""
    rings: list[Ring] = []
    outlines: list[list[Array]] = []
    for number, slab in enumerate(slabs):
        fitted = [(part, _circle(part)) for part in _parts(slab[:, :2], gap_mm)]
        others = [part for part, circle in fitted if circle is None]
        sides = np.concatenate(others) if others else np.zeros((0, 2))
        concrete = [
            part for part in _parts(sides, _CONCRETE_GAP_MM) if np.ptp(part, axis=0).min() > _SMALLEST_COLUMN_MM
        ]
        outlines.append(concrete)
        for _, circle in fitted:
            if circle is not None:
                inside = any(_encloses(outline, circle[0]) for outline in concrete)
                rings.append(Ring(number, circle[0], circle[1], inside))
    return rings, outlines


def _parts(flat: Array, gap_mm: float) -> Iterator[Array]:
    """Outlines of a slab seen from above: points (n, 2) that hang together over gaps of that width.

    Cells of that width that touch are one outline: a cloud has far too many pairs of points to look at.
    """
    if len(flat) < FEWEST_ON_RING:
        return
    from scipy.sparse import coo_matrix  # slow to import, and only clouds need it
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    step_mm = gap_mm / 4.0
    cells = np.floor((flat - flat.min(axis=0)) / step_mm).astype(np.int64)
    width = int(cells[:, 1].max()) + 1
    taken, number = np.unique(cells[:, 0] * width + cells[:, 1], return_inverse=True)
    cells = np.column_stack([taken // width, taken % width])
    pairs = cKDTree(cells * step_mm).query_pairs(gap_mm, output_type="ndarray")
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(cells), len(cells)))
    label: IntArray = connected_components(graph, directed=False)[1].astype(np.int64)[number.reshape(-1)]
    order = np.argsort(label, kind="stable")
    for members in np.split(order, np.flatnonzero(np.diff(label[order])) + 1):
        if len(members) >= FEWEST_ON_RING:
            yield flat[members]


def _circle(flat: Array) -> tuple[Array, float] | None:
    """Centre (2,) and radius of the circle that points lie on all around; None where they do not."""
    centre, radius_mm = flat_circle(flat)
    if not _RADIUS_MM[0] <= radius_mm <= _RADIUS_MM[1]:
        return None
    spokes = flat - centre
    off_mm = np.abs(np.linalg.norm(spokes, axis=1) - radius_mm)
    reach_mm = OFF_WALL_MM + OFF_WALL_RATIO * radius_mm
    if float(np.percentile(off_mm, 90.0)) > reach_mm or widest_gap(spokes) > _WIDEST_GAP:
        return None
    return centre, radius_mm


def _encloses(outline: Array, centre: Array) -> bool:
    low, high = outline.min(axis=0), outline.max(axis=0)
    return bool((low < centre).all() and (centre < high).all())


def _families(rings: Sequence[Ring]) -> list[list[Ring]]:
    """Rings one above the other, of one wall."""
    families: list[list[Ring]] = []
    for ring in rings:
        home = next((family for family in families if _goes_on(family[-1], ring)), None)
        if home is None:
            families.append([ring])
        else:
            home.append(ring)
    return families


def _goes_on(last: Ring, ring: Ring) -> bool:
    near = float(np.linalg.norm(last.centre - ring.centre)) < _SAME_AXIS_MM
    alike = abs(last.radius_mm - ring.radius_mm) < OFF_WALL_MM + OFF_WALL_RATIO * ring.radius_mm
    return near and alike and ring.slab - last.slab <= 2


def _columns(
    holes: Sequence[Wall],
    outlines: Sequence[Sequence[Array]],
    slabs: Sequence[Array],
    points: Array,
    origin: Array,
) -> list[Element]:
    """Columns with their holes; of concrete that several slabs show, the outline of all."""
    from scipy.spatial import ConvexHull  # slow to import, and only clouds need it

    boxes: list[tuple[Array, Array, Array]] = []
    for slab, parts in zip(slabs, outlines, strict=True):
        for part in parts:
            low_mm, high_mm = float(slab[:, 2].min()), float(slab[:, 2].max())
            around = part[ConvexHull(part).vertices]
            corners = np.vstack([np.column_stack([around, np.full(len(around), z)]) for z in (low_mm, high_mm)])
            middle = part.mean(axis=0)
            home = next((k for k, box in enumerate(boxes) if _encloses(box[0], middle)), None)
            if home is None:
                boxes.append((part, corners, middle))
            else:
                known = boxes[home]
                boxes[home] = (known[0], np.vstack([known[1], corners]), known[2])
    return [
        _column(number, corners, [hole for hole in holes if _encloses(outline, hole.start[:2])], points, origin)
        for number, (outline, corners, _) in enumerate(boxes, start=1)
    ]


def _column(number: int, corners: Array, holes: Sequence[Wall], points: Array, origin: Array) -> Element:
    """A column: its outline from the face that its holes open in, or its lowest points, to its highest points."""
    foot_mm, head_mm = float(corners[:, 2].min()), float(corners[:, 2].max())
    around = _rectangle(corners[:, :2])
    if holes:
        foot_mm = float(np.median([min(hole.start[2], hole.end[2]) for hole in holes]))
        near = points[np.abs(points[:, 2] - foot_mm) < _ON_FACE_MM]
        inside = ((near[:, :2] > around.min(axis=0)) & (near[:, :2] < around.max(axis=0))).all(axis=1)
        foot_mm = _crowded(near[inside, 2], foot_mm)
    low, high = (np.column_stack([around, np.full(4, level)]) for level in (foot_mm, head_mm))
    edges = [np.array([ring[k], ring[(k + 1) % 4]]) for ring in (low, high) for k in range(4)]
    edges += [np.array([below, above]) for below, above in zip(low, high, strict=True)]
    tubes = tuple(
        Tube(hole.start, hole.end, None, (round(hole.diameter_mm, 6), round(hole.diameter_mm, 6))) for hole in holes
    )
    T = np.eye(4)
    T[:3, 3] = origin
    solid = Solid(tubes, (), tuple(edges)).moved(T)
    return Element(f"column-{number}", "", "", (solid,), np.eye(4), kind="Cloud")


def _rectangle(flat: Array) -> Array:
    """Corners (4, 2) of the smallest rectangle around points (n, 2); one of its sides lies on their outline."""
    from scipy.spatial import ConvexHull  # slow to import, and only clouds need it

    hull = flat[ConvexHull(flat).vertices]
    sides = np.roll(hull, -1, axis=0) - hull
    turns = np.mod(np.arctan2(sides[:, 1], sides[:, 0]), np.pi / 2.0)
    frames = [np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]) for turn in turns]
    areas = [float(np.prod(np.ptp(hull @ frame.T, axis=0))) for frame in frames]
    frame = frames[int(np.argmin(areas))]
    low, high = (hull @ frame.T).min(axis=0), (hull @ frame.T).max(axis=0)
    corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
    turned: Array = corners @ frame
    return turned


def _bar(number: int, wall: Wall, origin: Array) -> Element:
    tube = Tube(wall.start + origin, wall.end + origin, round(wall.diameter_mm, 6), (None, None))
    solid = Solid((tube,), (), (np.array([tube.start, tube.end]),))
    return Element(f"bar-{number}", "", "", (solid,), np.eye(4), kind="Cloud")
