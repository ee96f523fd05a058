"""Round bodies and holes, drawn in every way, give one and the same tube."""

import numpy as np
import pytest

from aadm_workbench.design.recognise.circles import circle_through
from aadm_workbench.design.recognise.paths import Straight
from aadm_workbench.design.recognise.shapes import Cut, HalfSpace, Loop, Mesh, Prism, Shape, SweptDisk, Turned, edges
from aadm_workbench.design.recognise.tubes import Tube, tubes
from aadm_workbench.model import Array

UP = np.array([0.0, 0.0, 1.0])
FAR = np.array([6.7e9, -4.1e9, 120.0])


def circle(diameter: float, z: float = 0.0, sides: int = 36) -> Array:
    angle = np.arange(sides) * 2.0 * np.pi / sides
    return np.column_stack([diameter / 2 * np.cos(angle), diameter / 2 * np.sin(angle), np.full(sides, z)])


def loop(points: Array) -> Loop:
    return Loop(points, circle_through(points))


def rod(diameter: float, low: float, high: float) -> Prism:
    return Prism(loop(circle(diameter, low)), (), (high - low) * UP)


def hollow_mesh(*, capped: bool = True, triangles: bool = True) -> Mesh:
    """Ø 36 in Ø 48, 310 long; facets as triangles or as polygons with holes."""
    n = 36
    vertices = np.vstack([circle(36.0), circle(48.0), circle(36.0, 310.0), circle(48.0, 310.0)])
    faces: list[tuple[Array, ...]] = []

    def band(first: int, second: int) -> None:
        for k in range(n):
            a, b, c, d = first * n + k, first * n + (k + 1) % n, second * n + (k + 1) % n, second * n + k
            faces.extend([(np.array([a, b, c]),), (np.array([a, c, d]),)] if triangles else [(np.array([a, b, c, d]),)])

    band(0, 2)
    band(1, 3)
    if capped and triangles:
        band(0, 1)
        band(2, 3)
    elif capped:
        ring = np.arange(n)
        faces += [(ring + n, ring), (ring + 3 * n, ring + 2 * n)]
    return Mesh(vertices, tuple(faces))


HOLLOW = {
    "hollow extrusion": Prism(loop(circle(48.0)), (loop(circle(36.0)),), 310.0 * UP),
    "extrusion drawn downwards": Prism(loop(circle(48.0, 310.0)), (loop(circle(36.0, 310.0)),), -310.0 * UP),
    "pipe": SweptDisk((Straight(np.zeros(3), 310.0 * UP),), 24.0, 18.0),
    "turned": Turned(np.zeros(3), UP, np.array([(18.0, 0.0), (24.0, 0.0), (24.0, 310.0), (18.0, 310.0)])),
    "solid minus solid": Cut(rod(48.0, 0.0, 310.0), rod(36.0, -50.0, 400.0)),
    "triangles": hollow_mesh(),
    "polygons with holes": hollow_mesh(triangles=False),
    "walls without ends": hollow_mesh(capped=False),
}


@pytest.mark.parametrize("name", HOLLOW)
@pytest.mark.parametrize("origin", [np.zeros(3), FAR], ids=["here", "6,700 km away"])
def test_one_sleeve_however_it_is_drawn(name: str, origin: Array) -> None:
    """Ø 36 in Ø 48, 310 long, leaning by 2 degrees, to a thousandth of a millimetre."""
    lean = np.radians(2.0)
    T = np.eye(4)
    T[:3, :3] = [[np.cos(lean), 0, np.sin(lean)], [0, 1, 0], [-np.sin(lean), 0, np.cos(lean)]]
    T[:3, 3] = origin
    (tube,) = [found.upwards(UP) for found in tubes(HOLLOW[name].moved(T))]
    assert tube.start - origin == pytest.approx(np.zeros(3), abs=1e-3)
    assert tube.end - origin == pytest.approx(310.0 * T[:3, 2], abs=1e-3)
    assert tube.outer_mm == pytest.approx(48.0, abs=1e-3)
    assert tube.bore_mm == pytest.approx((36.0, 36.0), abs=1e-3)


def drilled_block(*, through: bool) -> Mesh:
    """A block 200 x 200 x 500 of polygons with one round hole in its foot, 300 deep or through."""
    n = 36
    square = np.array([(-100.0, -100, 0), (100, -100, 0), (100, 100, 0), (-100, 100, 0)])
    depth = 500.0 if through else 300.0
    vertices = np.vstack([square, square + 500.0 * UP, circle(36.0), circle(36.0, depth)])
    ring, base = np.arange(n), np.arange(4)
    mouth, bottom = ring + 8, ring + 8 + n
    walls = [(np.array([k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k]),) for k in range(4)]
    bore = [(np.array([mouth[k], mouth[(k + 1) % n], bottom[(k + 1) % n], bottom[k]]),) for k in range(n)]
    ends = [(base, mouth), (base + 4, bottom)] if through else [(base, mouth), (base + 4,), (bottom,)]
    return Mesh(vertices, (*walls, *bore, *ends))


SQUARE = Loop(np.array([(-100.0, -100, 0), (100, -100, 0), (100, 100, 0), (-100, 100, 0)]))


@pytest.mark.parametrize(
    ("shape", "depth"),
    [
        (Prism(SQUARE, (loop(circle(36.0)),), 500.0 * UP), 500.0),
        (Cut(Prism(SQUARE, (), 500.0 * UP), rod(36.0, 0.0, 300.0)), 300.0),
        (drilled_block(through=False), 300.0),
        (drilled_block(through=True), 500.0),
    ],
    ids=["hole in the profile", "drilled", "blind hole of facets", "through hole of facets"],
)
def test_a_hole_in_the_concrete(shape: Shape, depth: float) -> None:
    (hole,) = [found.upwards(UP) for found in tubes(shape)]
    assert hole.is_hole
    assert hole.bore_mm == pytest.approx((36.0, 36.0), abs=1e-6)
    assert np.concatenate([hole.start, hole.end]) == pytest.approx([0, 0, 0, 0, 0, depth], abs=1e-6)


def test_the_mouth_of_a_stepped_sleeve_is_the_lower_end() -> None:
    """Half-grouted: 36 at the mouth, 21 at the thread."""
    rz = np.array([(18.0, 0.0), (24.0, 0.0), (24.0, 211.0), (10.5, 211.0), (10.5, 160.0), (18.0, 160.0)])
    (tube,) = tubes(Turned(np.zeros(3), UP, rz))
    assert tube.upwards(UP).bore_mm == (36.0, 21.0)
    assert tube.upwards(-UP).bore_mm == (21.0, 36.0)


def test_a_solid_cylinder_has_no_bore() -> None:
    (tube,) = tubes(rod(20.0, 0.0, 560.0))
    assert (tube.outer_mm, tube.bore_mm) == (pytest.approx(20.0), (None, None))


def test_a_plane_shortens_a_tube() -> None:
    (tube,) = tubes(Cut(rod(20.0, 0.0, 560.0), HalfSpace(400.0 * UP, UP)))
    assert tube.length_mm == pytest.approx(400.0)


@pytest.mark.parametrize("sides", [4, 6])
def test_few_corners_are_no_circle(sides: int) -> None:
    assert tubes(Prism(loop(circle(36.0, sides=sides)), (), 310.0 * UP)) == []


def test_half_a_circle_is_no_circle() -> None:
    assert circle_through(circle(36.0)[:19]) is None


def test_edges_of_a_clipped_block() -> None:
    """A block cut off obliquely reaches as far as its cut face does."""
    slope = np.array([1.0, 0.0, 1.0]) / np.sqrt(2.0)
    block = Cut(Prism(SQUARE, (), 500.0 * UP), HalfSpace(np.array([0.0, 0.0, 400.0]), slope))
    corners = edges([block]).reshape(-1, 3)
    assert corners[:, 2].max() == pytest.approx(500.0)
    assert corners[corners[:, 0] > 99.0, 2].max() == pytest.approx(300.0)


def test_upwards_keeps_the_length() -> None:
    tube = Tube(np.zeros(3), 5.0 * UP, None, (1.0, 2.0))
    assert tube.upwards(-UP).length_mm == tube.length_mm == 5.0
