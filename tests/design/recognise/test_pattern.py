"""Labels, pairs, neighbours, and designs that stand in the job's text."""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.recognise.pattern import adjacent, inline_design, label_order, pair
from aadm_workbench.design.recognise.rings import rings
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Array

SHUFFLE = np.random.default_rng(3)


def perimeter(nx: int, ny: int, width: float, depth: float) -> Array:
    """Centres of a rectangular ring in the order of their labels, written by walking around it."""
    xs, ys = np.linspace(-width / 2, width / 2, nx), np.linspace(-depth / 2, depth / 2, ny)
    south, north = [(x, ys[0]) for x in xs], [(x, ys[-1]) for x in xs[::-1]]
    east, west = [(xs[-1], y) for y in ys[1:-1]], [(xs[0], y) for y in ys[-2:0:-1]]
    return np.array([*south, *east, *north, *west])


def circle(n: int, radius: float, from_deg: float = 0.0) -> Array:
    angle = np.radians(from_deg) + np.arange(n) * 2.0 * np.pi / n
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def closed(n: int, first: int = 0) -> set[frozenset[int]]:
    return {frozenset((first + k, first + (k + 1) % n)) for k in range(n)}


def edges(xy: Array) -> set[frozenset[int]]:
    found = adjacent(xy)
    assert len({frozenset(edge) for edge in found}) == len(found), "a pair twice"
    return {frozenset(edge) for edge in found}


def test_twelve_in_a_square(ring: list[tuple[float, float]]) -> None:
    """S1 at (-x, -y), then counter-clockwise from above: four to a side."""
    xy = np.array(ring)
    mixed = SHUFFLE.permutation(12)
    assert xy[mixed][label_order(xy[mixed])].tolist() == xy.tolist()
    assert adjacent(xy) == [*pairwise(range(12)), (11, 0)]


@pytest.mark.parametrize(("nx", "ny"), [(nx, ny) for nx in range(2, 12) for ny in range(2, 12) if nx + ny <= 22])
def test_every_rectangular_ring(nx: int, ny: int) -> None:
    """4 to 40 bars, with unlike spacings on the two sides."""
    xy = perimeter(nx, ny, 160.0 * (nx - 1), 110.0 * (ny - 1))
    mixed = SHUFFLE.permutation(len(xy))
    assert xy[mixed][label_order(xy[mixed])].tolist() == xy.tolist()
    assert edges(xy) == closed(len(xy))


@pytest.mark.parametrize("n", range(3, 41))
def test_circles(n: int) -> None:
    """Counter-clockwise from the one nearest to the corner, wherever the file's order begins."""
    xy = circle(n, 300.0, from_deg=11.0)
    ordered = xy[label_order(xy)]
    assert np.linalg.norm(ordered[0] - xy.min(axis=0)) == pytest.approx(
        np.linalg.norm(xy - xy.min(axis=0), axis=1).min()
    )
    turn = np.diff(np.unwrap(np.arctan2(ordered[:, 1], ordered[:, 0])))
    assert turn == pytest.approx(2.0 * math.pi / n)
    assert edges(ordered) == closed(n)


def test_a_tie_begins_with_the_first_counter_clockwise() -> None:
    """Four on the axes: (-r, 0) and (0, -r) are equally near to the corner, whatever their order and rounding."""
    for noise in (0.0, 1e-9, -1e-9):
        xy = np.array([(200.0, 0.0), (0.0, -200.0 + noise), (0.0, 200.0), (-200.0, 0.0)])
        assert label_order(xy).tolist() == [3, 1, 0, 2]


def test_two_concentric_rings() -> None:
    """Ring by ring from outside, spacing within each ring."""
    xy = np.vstack([circle(12, 260.0, 225.0), circle(6, 150.0, 225.0)])
    assert label_order(xy).tolist() == list(range(18))
    assert edges(xy) == closed(12) | closed(6, first=12)


def test_full_grid_is_two_rings() -> None:
    xy = np.vstack([perimeter(4, 4, 480.0, 480.0), perimeter(2, 2, 160.0, 160.0)])
    assert label_order(xy).tolist() == list(range(16))
    assert edges(xy) == closed(12) | closed(4, first=12)


def test_bar_in_the_middle_of_a_ring() -> None:
    """It has no ring of its own: its neighbours are the nearest."""
    xy = np.vstack([circle(8, 200.0, 225.0), [(0.0, 0.0)]])
    assert label_order(xy).tolist() == list(range(9))
    assert edges(xy) == closed(8) | {frozenset((k, 8)) for k in range(8)}


def test_corner_bars_set_in_are_on_the_ring() -> None:
    """Corner bars stand a bend radius further in: still one ring."""
    xy = perimeter(4, 4, 480.0, 480.0)
    corners = np.abs(xy).min(axis=1) == 240.0
    xy[corners] *= 0.95
    assert len(rings(xy)) == 1
    assert label_order(xy).tolist() == list(range(12))


def test_row_has_two_ends() -> None:
    xy = np.array([(100.0 * k, 0.0) for k in range(4)])
    assert label_order(xy[::-1]).tolist() == [3, 2, 1, 0]
    assert adjacent(xy) == [(0, 1), (1, 2), (2, 3)]


def test_angle_is_no_ring() -> None:
    """The outline of an L crosses its notch: there spacing is measured to the nearest neighbours."""
    xy = 100.0 * np.array([(x, y) for y in range(4) for x in range(4) if y < 2 or x < 2])
    found = edges(xy)
    assert all(np.linalg.norm(xy[a] - xy[b]) == 100.0 for a, b in (sorted(edge) for edge in found))
    assert len(found) == 16


@pytest.mark.parametrize("n", [0, 1, 2])
def test_few_points(n: int) -> None:
    xy = np.array([(0.0, 0.0), (100.0, 50.0)])[:n].reshape(-1, 2)
    assert label_order(xy).tolist() == list(range(n))
    assert adjacent(xy) == [(0, 1)][: max(0, n - 1)]


def test_pairs_have_the_smallest_sum() -> None:
    """A row of bars shifted by more than half of the spacing still pairs one to one."""
    sleeves = np.array([(100.0 * k, 0.0) for k in range(4)])
    assert pair(sleeves, sleeves[::-1] + np.array([3.0, 4.0])).tolist() == [3, 2, 1, 0]
    assert pair(sleeves, sleeves + np.array([60.0, 0.0])).tolist() == [0, 1, 2, 3]


def test_pairs_are_no_further_apart_than_allowed() -> None:
    sleeves = np.array([(0.0, 0.0), (100.0, 0.0), (200.0, 0.0)])
    rebars = np.array([(201.0, 0.0), (1.0, 1.0), (150.0, 0.0)])
    assert pair(sleeves, rebars, within_mm=10.0).tolist() == [1, -1, 0]
    assert pair(sleeves, rebars[:0]).tolist() == [-1, -1, -1]
    assert pair(sleeves, rebars + 500.0, within_mm=10.0).tolist() == [-1, -1, -1]


TABLE = {
    "sleeve_diameter": 36.0,
    "rebar_diameter": 20,
    "rebar_outer_diameter": 23.5,
    "embedded_length": 160.0,
    "size": [600.0, 600.0],
    "centres": [[1000.0, 1000.0], [1480.0, 1000.0], [1480.0, 1480.0], [1000.0, 1480.0]],
}


def test_inline_design() -> None:
    """Centres off the origin are shifted to it; bars stand on the sleeves' axes."""
    design = inline_design("C-302", TABLE)
    assert [point.label for point in design.sleeves] == ["S1", "S2", "S3", "S4"]
    assert [point.label for point in design.rebars] == ["R1", "R2", "R3", "R4"]
    corners = [[-240.0, -240.0], [240.0, -240.0], [240.0, 240.0], [-240.0, 240.0]]
    assert [point.centre.tolist() for point in design.sleeves] == [[*corner, 0.0] for corner in corners]
    assert [point.centre.tolist() for point in design.rebars] == [[*corner, 160.0] for corner in corners]
    assert {point.diameter_mm for point in design.rebars} == {20.0}
    assert (design.size_mm, design.rebar_outer_diameter_mm, design.embedded_length_mm) == ((600.0, 600.0), 23.5, 160.0)
    assert (design.id, design.names, design.T_model_column) == ("C-302", ("C-302",), None)


def test_inline_design_without_bars() -> None:
    table = {"sleeve_diameter": 36.0, "centres": TABLE["centres"]}
    design = inline_design("C-302", table)
    assert (len(design.sleeves), design.rebars) == (4, ())


def change(**values: Any) -> Callable[[], dict[str, Any]]:
    return lambda: TABLE | values


@pytest.mark.parametrize(
    ("table", "said"),
    [
        (change(centres=[]), "no centres"),
        (change(centres=[[0.0, 0.0], [1.0]]), r"Centre 2 .* \[1.0\]"),
        (change(centres=[[0.0, 0.0], [1.0, "2"]]), "Centre 2"),
        (change(centres=[[0.0, 0.0], [math.nan, 2.0]]), "Centre 2"),
        (change(centres=[[0.0, 0.0], [500.0, 0.0], [0.0, 0.2]]), "Centres 1 and 3 .* same point"),
        (change(sleeve_diameter=None), "no sleeve_diameter"),
        (change(sleeve_diameter=-36.0), "sleeve_diameter .* -36"),
        (change(rebar_diameter=True), "rebar_diameter"),
        (change(sleeve_diameter=23.0), "23.5 mm does not enter a sleeve of 23 mm"),
        (change(size=[600.0]), "size"),
    ],
)
def test_inline_design_that_contradicts_itself(table: Callable[[], dict[str, Any]], said: str) -> None:
    with pytest.raises(DesignError, match=said) as caught:
        inline_design("C-302", table())
    assert "C-302" in str(caught.value)


def test_inline_design_of_mixed_sizes() -> None:
    """Sizes follow the centres as they are written, whatever labels these get."""
    sizes = {"sleeve_diameter": [36.0, 40.0, 36.0, 44.0], "rebar_diameter": [20.0, 22.0, 20.0, 25.0]}
    shuffled = [2, 0, 3, 1]
    table = {key: [sizes[key][k] for k in shuffled] for key in sizes}
    table |= {"centres": [TABLE["centres"][k] for k in shuffled], "embedded_length": 160.0}  # type: ignore[index]
    design = inline_design("C-302", table)
    assert [point.diameter_mm for point in design.sleeves] == [36.0, 40.0, 36.0, 44.0]
    assert [point.diameter_mm for point in design.rebars] == [20.0, 22.0, 20.0, 25.0]
    assert design.rebar_outer_diameter_mm is None
    over_ribs = inline_design("C-302", table | {"rebar_outer_diameter": [23.0, 22.7, 28.9, 25.0]})
    assert [point.outer_diameter_mm for point in over_ribs.rebars] == [22.7, 25.0, 23.0, 28.9]


@pytest.mark.parametrize(
    ("table", "said"),
    [
        (change(sleeve_diameter=[36.0, 36.0]), "lists 2 lengths for 4 centres"),
        (change(rebar_diameter=[20.0, 20.0, 20.0, -1.0]), "rebar_diameter .* -1"),
        (change(sleeve_diameter=[36.0, 36.0, None, 36.0]), "empty place"),
        (change(sleeve_diameter=[36.0, 36.0, 22.0, 36.0]), "centre 3: a bar of 23.5 mm does not enter .* 22 mm"),
        (change(rebar_diameter=[20.0, 20.0, 18.0, 20.0]), "several sizes and one rebar_outer_diameter"),
    ],
)
def test_mixed_sizes_that_contradict_each_other(table: Callable[[], dict[str, Any]], said: str) -> None:
    with pytest.raises(DesignError, match=said):
        inline_design("C-302", table())
