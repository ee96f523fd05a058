"""What contradicts design, declaration or camera: found where it is, never where all is sound; places are complex."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.findings.diameters import sizes_in_words
from aadm_workbench.assembly.findings.finding import SeenGroup
from aadm_workbench.assembly.findings.rules import findings_of
from aadm_workbench.assembly.findings.scale import student_quantile
from aadm_workbench.assembly.matching.match import Match, match_extraction
from aadm_workbench.extract.filter_signs import SMOOTHED
from aadm_workbench.inspection.tasks import design_shape
from aadm_workbench.model import (
    AssemblyPoint,
    ColumnDesign,
    Extraction,
    Finding,
    Kind,
)

UP = np.array([0.0, 0.0, 1.0])


def square(half: float = 240.0) -> list[complex]:
    third = half / 1.5
    side = [complex(-half + third * k, -half) for k in range(3)]
    return [place * 1j**corner for corner in range(4) for place in side]


def keyed(shift: complex, half: float = 240.0) -> list[complex]:
    """A square ring of which one point is moved: it has an opinion on how it is turned."""
    places = square(half)
    places[1] += shift
    return [place - sum(places) / len(places) for place in places]


def design_of(places: list[complex], kind: Kind, diameter_mm: float) -> list[AssemblyPoint]:
    height = 160.0 if kind is Kind.REBAR else 0.0
    return [
        AssemblyPoint(f"{kind.letter}{k}", kind, np.array([z.real, z.imag, height]), UP, diameter_mm)
        for k, z in enumerate(places, 1)
    ]


def group(
    places: list[complex],
    *,
    kind: Kind = Kind.SLEEVE,
    design_mm: float = 36.0,
    measured_mm: float | list[float] | None = None,
    scatter_mm: float = 0.5,
    u_mm: float = 0.05,
    scale: float = 1.0,
    held_deg: float = 0.0,
    up_deg: float | None = 90.0,
    mirrored: bool = False,
    exposed_mm: list[float] | None = None,
    seed: int = 1,
) -> SeenGroup:
    """A group as it would come from a scan: +y at the top of the image, the camera held off by some degrees."""
    rng = np.random.default_rng(seed)
    noise = rng.normal(0.0, np.hypot(scatter_mm, u_mm), (len(places), 2))
    built = (np.array(places) + noise[:, 0] + 1j * noise[:, 1]) * scale
    built = built.conjugate() if mirrored else built
    turned = built * np.exp(1j * np.radians(37.0)) + 511.0 - 84.0j
    image_up = np.exp(1j * np.radians(37.0 + 90.0 + held_deg))
    usual = design_mm * (0.965 if kind is Kind.REBAR else 1.0)
    diameters = np.broadcast_to(usual if measured_mm is None else measured_mm, len(places))
    points = tuple(
        AssemblyPoint("", kind, np.array([z.real, z.imag, 12.0]), UP, float(d), np.eye(3) * u_mm**2)
        for z, d in zip(turned, diameters, strict=True)
    )
    quality = {"point_pitch_mm": 0.5}
    extraction = Extraction(kind, "refined", points, None, UP, "", tuple(exposed_mm or ()), quality)
    design = design_of(places, kind, design_mm)
    up_scan = np.array([image_up.real, image_up.imag, 0.0])
    return SeenGroup(kind, design, extraction, match_extraction(design, extraction, up=up_deg, image_up_scan=up_scan))


def column(places: list[complex] | None = None, **more: Any) -> ColumnDesign:
    places = places or square()
    sleeves, rebars = design_of(places, Kind.SLEEVE, 36.0), design_of(places, Kind.REBAR, 20.0)
    return ColumnDesign(more.pop("id", "C-1"), tuple(sleeves), tuple(rebars), **more)


def found_in(*groups: SeenGroup, **design: Any) -> list[Finding]:
    return list(findings_of(column(**design), groups))


def codes(findings: list[Finding]) -> list[str]:
    return [finding.code for finding in findings]


@pytest.mark.parametrize(
    ("design_mm", "core_mm", "seems"),
    [
        (20, 21.3, "22 mm"),
        (20, 21.7, "22 mm"),
        (20, 22.9, "none"),
        (20, 17.3, "18 mm"),
        (16, 13.4, "14 mm"),
        (25, 27.1, "28 mm"),
        (32, 27.2, "28 mm"),
        (40, 34.8, "36 mm"),
        (12, 13.4, "14 mm"),
    ],
)
def test_bars_of_another_size_are_told_with_the_size_that_they_have(
    design_mm: float, core_mm: float, seems: str
) -> None:
    seen = group(square(), kind=Kind.REBAR, design_mm=design_mm, measured_mm=core_mm)
    (finding,) = found_in(seen)
    assert (finding.code, finding.about, finding.holds_back) == ("diameter_differs", ("rebars",), True)
    assert finding.values["measured_mm"] == pytest.approx(core_mm)
    assert finding.values["seems"] == seems


@pytest.mark.parametrize("design_mm", [12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40])
@pytest.mark.parametrize("part", [0.945, 0.965, 1.0, 1.025])
def test_cores_that_the_standards_allow_are_no_finding(design_mm: float, part: float) -> None:
    assert found_in(group(square(), kind=Kind.REBAR, design_mm=design_mm, measured_mm=part * design_mm)) == []


@pytest.mark.parametrize(("design_mm", "off_mm"), [(36.0, 0.7), (36.0, -1.3), (26.0, 0.6), (50.0, -0.8), (66.0, 0.9)])
def test_sleeves_of_another_bore_are_told(design_mm: float, off_mm: float) -> None:
    (finding,) = found_in(group(square(), design_mm=design_mm, measured_mm=design_mm + off_mm))
    assert (finding.code, finding.about) == ("diameter_differs", ("sleeves",))
    assert f"{design_mm + off_mm:.1f} mm" in finding.text
    assert found_in(group(square(), design_mm=design_mm, measured_mm=design_mm + off_mm / 4.0)) == []


def test_the_worse_a_diameter_is_known_the_more_it_may_be_off() -> None:
    assert codes(found_in(group(square(), measured_mm=36.9, u_mm=0.05))) == ["diameter_differs"]
    assert found_in(group(square(), measured_mm=36.9, u_mm=0.2)) == []


def test_a_method_that_states_no_uncertainty_contradicts_no_diameter() -> None:
    seen = group(square(), measured_mm=38.0)
    points = tuple(replace(point, covariance=None) for point in seen.extraction.points)
    assert found_in(replace(seen, extraction=replace(seen.extraction, points=points))) == []


def test_only_the_bars_with_caps_are_named() -> None:
    measured = [19.3] * 12
    measured[2] = measured[7] = 22.9
    (finding,) = found_in(group(square(), kind=Kind.REBAR, design_mm=20.0, measured_mm=measured))
    assert finding.about == ("R3", "R8")


@pytest.mark.parametrize("scale", [1.02, 0.98, 1.006, 0.9945])
def test_a_pattern_that_is_too_large_or_too_small_is_told(scale: float) -> None:
    (finding,) = found_in(group(square(), scale=scale))
    assert (finding.code, finding.about) == ("scale_differs", ("sleeves",))
    assert finding.values["scale"] == pytest.approx(scale, abs=0.0015)


def test_two_patterns_that_differ_in_scale_are_told() -> None:
    foot = group(square(), scale=1.0025, scatter_mm=0.2)
    bars = group(square(), kind=Kind.REBAR, design_mm=20.0, scale=0.9975, scatter_mm=0.2, seed=2)
    found = found_in(foot, bars)
    assert ("sleeves", "rebars") in [finding.about for finding in found]


def test_the_quantile_of_student_is_that_of_scipy() -> None:
    stats = pytest.importorskip("scipy.stats")
    for freedom in (8.0, 12.0, 24.0, 80.0):
        assert student_quantile(freedom) == pytest.approx(stats.t.isf(5e-5, freedom), rel=0.02)


@pytest.mark.parametrize("exposed_mm", [4.0, 60.0, 115.0, 190.0])
@pytest.mark.parametrize("design_exposed_mm", [None, 150.0])
def test_a_bar_that_is_cut_off_or_too_long_is_named(exposed_mm: float, design_exposed_mm: float | None) -> None:
    rng = np.random.default_rng(4)
    lengths = [150.0 + float(rng.uniform(-3.0, 3.0)) for _ in range(12)]
    lengths[4] = exposed_mm
    bars = group(square(), kind=Kind.REBAR, design_mm=20.0, exposed_mm=lengths)
    (finding,) = found_in(bars, exposed_length_mm=design_exposed_mm)
    assert (finding.code, finding.about) == ("exposed_length_differs", ("R5",))
    assert finding.values["measured_mm"] == exposed_mm
    assert finding.values["expected_mm"] == pytest.approx(150.0, abs=2.0)


@pytest.mark.parametrize(
    ("lengths", "embedded_mm", "named"),
    [
        ([150.0, 149.0, 95.0], 150.0, [("R3",)]),
        ([152.0, 149.0, 230.0], 150.0, []),  # longer than it goes in by right: nobody says by how much
        ([150.0, 149.0, 95.0], None, []),
    ],
)
def test_few_bars_are_at_least_as_long_as_they_go_in(
    lengths: list[float], embedded_mm: float | None, named: list[tuple[str]]
) -> None:
    row = [complex(x) for x in (-90.0, 0.0, 100.0)]
    bars = group(row, kind=Kind.REBAR, design_mm=20.0, exposed_mm=lengths)
    findings = found_in(bars, places=row, embedded_length_mm=embedded_mm)
    assert [finding.about for finding in findings] == named


def test_tops_that_differ_by_centimetres_by_right_are_no_finding() -> None:
    for seed in range(50):
        lengths = np.random.default_rng(seed).uniform(110.0, 190.0, 12).tolist()
        assert found_in(group(square(), kind=Kind.REBAR, design_mm=20.0, exposed_mm=lengths)) == []


@pytest.mark.parametrize("shift", [4.0, 4.0j, -6.0, 3.0 + 3.0j])
@pytest.mark.parametrize("wrong_deg", [0.0, 180.0, 270.0])
def test_an_up_that_an_asymmetric_pattern_contradicts_is_no_match(shift: complex, wrong_deg: float) -> None:
    places = keyed(shift)
    right = group(places, scatter_mm=0.2)
    assert right.match.orientation == "declared"
    assert found_in(right) == []
    wrong = group(places, scatter_mm=0.2, up_deg=wrong_deg)
    assert not wrong.match
    (finding,) = found_in(wrong)
    assert (finding.code, finding.holds_back) == ("turn_contradicted", True)
    assert finding.values["declared_deg"] == wrong_deg
    assert finding.values["fitting_deg"] == 90.0


def test_an_up_is_not_contradicted_by_what_building_errors_explain() -> None:
    for seed in range(10):
        for shift in (0.0, 1.0, 2.0j, 4.0):
            seen = group(keyed(shift), scatter_mm=1.0, seed=seed)
            assert seen.match.orientation == "declared"
            assert "turn_contradicted" not in codes(found_in(seen))


@pytest.mark.parametrize("held_deg", [41.0, 42.5, -43.0, 43.5])
def test_an_up_nearly_half_way_to_the_next_turn_holds_back(held_deg: float) -> None:
    seen = group(square(), held_deg=held_deg)
    assert seen.match.orientation == "declared"
    (finding,) = found_in(seen)
    assert (finding.code, finding.holds_back) == ("turn_doubtful", True)
    assert finding.values["off_deg"] == pytest.approx(abs(held_deg), abs=0.5)


@pytest.mark.parametrize("held_deg", [0.0, -30.0, 39.0])
def test_an_up_that_is_meant_for_one_turn_is_no_finding(held_deg: float) -> None:
    assert found_in(group(square(), held_deg=held_deg)) == []


def test_on_a_round_ring_of_twelve_fourteen_degrees_are_half_way() -> None:
    ring = [240.0 * np.exp(2j * np.pi * k / 12.0) for k in range(12)]
    assert codes(found_in(group(ring, held_deg=14.2, scatter_mm=0.1))) == ["turn_doubtful"]
    assert found_in(group(ring, held_deg=9.0, scatter_mm=0.1)) == []


@pytest.mark.parametrize("shift", [4.0, -5.0, 9.0, 25.0])
@pytest.mark.parametrize("up_deg", [None, 90.0])
def test_a_mirrored_scan_says_so(shift: float, up_deg: float | None) -> None:
    seen = group(keyed(shift), mirrored=True, up_deg=up_deg, scatter_mm=0.3)
    assert not seen.match
    (finding,) = found_in(seen)
    assert (finding.code, finding.about) == ("mirrored", ("sleeves",))


def test_sound_groups_of_any_size_and_scatter_have_no_finding() -> None:
    """Sixty scans with building errors, single points far off, cameras held askew, in their own scale error."""
    for seed in range(60):
        rng = np.random.default_rng([9, seed])
        places = keyed(complex(*rng.uniform(-6.0, 6.0, 2)), rng.uniform(90.0, 350.0))
        if rng.random() < 0.3:
            places = [place.real + 1j * place.imag * rng.uniform(0.5, 0.9) for place in places]
        seen = group(
            places,
            scatter_mm=float(rng.choice([0.1, 0.4, 0.8])),
            u_mm=float(rng.choice([0.03, 0.1, 0.3])),
            measured_mm=36.0 + float(rng.uniform(-0.25, 0.25)),
            scale=1.0 + float(rng.normal(0.0, 1e-4)),
            held_deg=float(rng.normal(0.0, 4.0)),
            seed=seed,
        )
        assert found_in(replace(seen, scale_error=1e-4)) == [], seed


@pytest.mark.parametrize("noise_seen", [True, False])
def test_where_one_scan_was_smoothed_so_was_one_that_is_too_rough_to_show_it(noise_seen: bool) -> None:
    sleeves, bars = group(square()), group(square(), kind=Kind.REBAR, design_mm=20.0)
    sleeves = replace(sleeves, extraction=replace(sleeves.extraction, noise_seen=noise_seen))
    bars = replace(bars, extraction=replace(bars.extraction, points=(), reason=SMOOTHED), match=Match(reason=SMOOTHED))
    about = {name for finding in found_in(sleeves, bars) if finding.code == "smoothed" for name in finding.about}
    assert about == ({"rebars"} if noise_seen else {"rebars", "sleeves"})


def test_sizes_are_told_apart_by_their_cores() -> None:
    assert sizes_in_words([21.3]) == "22 mm"
    assert sizes_in_words([19.3, 24.2]) == "20/25 mm"


def test_turned_and_moved_designs_have_one_shape_and_others_have_another() -> None:
    first, turned = column(), column([place * 1j + 0.0 for place in square()])
    assert design_shape(first) == design_shape(turned)
    assert design_shape(first) != design_shape(column(square(250.0)))
    assert design_shape(first) != design_shape(column(keyed(12.0)))
