"""Feet that were cast off their design: the mesh that cameras see is that of the words and of the truth file."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.model import Array
from aadm_workbench.twin.meshes import foot_surface
from aadm_workbench.twin.parts import Break, Cast, Foot, SleeveAsBuilt
from aadm_workbench.twin.scene import truth_of
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot
from aadm_workbench.twin.site import left_by_site
from aadm_workbench.twin.truth import sample_design, section_truth

PLAIN = Foot((250.0, 200.0), ())


def face_of(foot: Foot) -> Array:
    """Vertices (n, 3) of the lower side of a foot without sleeves."""
    vertices = foot_surface(foot).vertices
    return np.asarray(vertices[vertices[:, 2] < 6.0])


def volume_of(foot: Foot) -> float:
    """By the divergence theorem."""
    surface = foot_surface(foot)
    a, b, c = np.moveaxis(surface.vertices[surface.triangles], 1, 0)
    return float(np.einsum("nk,nk->n", a, np.cross(b, c)).sum() / 6.0)


def test_a_section_is_shifted_turned_and_sheared_as_it_says() -> None:
    cast = Cast(offset=(3.0, -1.5), turn=np.radians(0.4), shear=np.radians(0.5))
    foot = replace(PLAIN, cast=cast)
    vertices = face_of(foot)
    corners = foot.corners()
    for corner in corners:
        assert np.hypot(*(vertices[:, :2] - corner).T).min() < 1e-4
    along, up = corners[1] - corners[0], corners[3] - corners[0]
    assert np.degrees(np.arctan2(along[1], along[0])) == pytest.approx(0.4)
    assert np.degrees(np.arctan2(up[1], up[0])) == pytest.approx(90.0 + 0.4 - 0.5)
    assert corners.mean(axis=0) == pytest.approx((3.0, -1.5))


def test_a_face_bows_and_warps_by_so_much() -> None:
    bowed, warped = (face_of(replace(PLAIN, cast=cast))[:, 2] for cast in (Cast(bow=3.0), Cast(warp=4.0)))
    assert (bowed.min(), bowed.max()) == pytest.approx((0.0, 3.0), abs=1e-3)
    assert (warped.min(), warped.max()) == pytest.approx((-2.0, 2.0), abs=1e-3)
    foot = replace(random_foot(LAB, np.random.default_rng(1)), cast=Cast(bow=-3.0))
    told = section_truth(sample_design(LAB), foot)
    assert told["flatness_mm"] == pytest.approx(3.0, abs=1e-3)


@pytest.mark.parametrize(
    ("piece", "missing"),
    [
        (Break("+x+y", 0.0, 0.0, 20.0), 4.0 / 3.0 * np.pi * 20.0**3 / 8.0),
        (Break("-y", 30.0, 60.0, 10.0), 4.0 / 3.0 * np.pi * 30.0 * 10.0**2 / 4.0),
        (Break("+x", -20.0, 24.0, 8.0), 4.0 / 3.0 * np.pi * 12.0 * 8.0**2 / 4.0),
    ],
)
def test_a_broken_piece_is_missing_where_it_was(piece: Break, missing: float) -> None:
    broken = replace(PLAIN, cast=Cast(breaks=(piece,)))
    assert volume_of(PLAIN) - volume_of(broken) == pytest.approx(missing, rel=0.03)
    gone = face_of(broken)
    new = gone[(gone[:, 2] < 1e-4) & (np.abs(gone[:, 0]) < 124.9) & (np.abs(gone[:, 1]) < 99.9)]
    middle = {"+x+y": (125.0, 100.0), "-y": (30.0, -100.0), "+x": (125.0, -20.0)}[piece.side]
    assert np.abs(new[:, :2] - middle).max() < max(piece.length / 2.0, piece.depth) + 1e-3


def test_mouths_lie_in_the_face_where_it_is() -> None:
    sleeve = SleeveAsBuilt(60.0, -40.0, 26.0, chamfer=0.5)
    foot = Foot((250.0, 200.0), (sleeve,), cast=Cast(bow=4.0))
    (point,) = truth_of(foot)
    assert point.centre == pytest.approx((60.0, -40.0, 4.0 * (1.0 - (0.48**2 + 0.4**2) / 2.0)))


def test_the_truth_tells_the_pattern_in_the_section_with_its_sign() -> None:
    rng = np.random.default_rng(3)
    foot, bars = random_foot(LAB, rng, spread=0.0), random_bars(LAB, rng)
    # The section lies 2 mm towards +x about the sleeves: they sit 2 mm towards -x in it, and turned the other way.
    told = section_truth(sample_design(LAB), replace(foot, cast=Cast(offset=(2.0, 0.0), turn=np.radians(0.3))))
    assert told["pattern_offset_mm"] == pytest.approx([-2.0, 0.0])
    assert told["pattern_turn_deg"] == pytest.approx(-0.3)
    site = ("off-size", "askew", "pattern-beside", "bowed", "warped", "broken-corners", "broken-edges")
    left, _ = left_by_site(site, foot, bars, rng)
    assert left.size != foot.size
    assert {len(one.side) for one in left.cast.breaks} == {2, 4}
    assert all(5.0 <= one.depth <= 40.0 for one in left.cast.breaks)
    assert 1.0 <= np.hypot(*left.cast.offset) <= 4.0
    assert min(map(abs, (left.cast.shear, left.cast.bow, left.cast.warp))) > 0.0
