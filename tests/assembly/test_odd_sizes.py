"""Bars that are not of the designed size where so few stand that the others lie nowhere: named, or left open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from scipy import ndimage

from aadm_workbench.assembly.findings.finding import SeenGroup
from aadm_workbench.assembly.findings.mistaken import NamedScan, mistaken_findings
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.extract.method import extract_sizes
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Extraction, Finding, Kind, Scan
from tests.extract.crowded_scenes import bars_among_stubs

BAR_MM, CORE_MM, CAP_MM = 32.0, 31.0, 6.0


def row(count: int) -> Array:
    """Places (k, 2) mm, in one line, as far apart each."""
    return np.column_stack([120.0 * (np.arange(count) - (count - 1) / 2.0), np.zeros(count)])


def taken(places: Array, core_mm: float, capped: int | None = None) -> Scan:
    """Bars of one core, 200 mm high, on one of them a cap that is 12 mm long and 2 mm thick at its top."""
    rng = np.random.default_rng(11)
    bars = np.column_stack([places + rng.normal(0.0, 0.3, places.shape), np.full(len(places), 900.0)])
    radii, lengths = [core_mm / 2.0] * len(bars), [np.inf] * len(bars)
    if capped is None:
        return bars_among_stubs(bars, np.array(radii), np.empty((0, 3)), rng)
    cap = bars[[capped]] - np.array([0.0, 0.0, 2.0])
    return bars_among_stubs(bars, np.array([*radii, (core_mm + CAP_MM) / 2.0]), cap, rng, np.array([*lengths, 12.0]))


def seen(places: Array, scan: Scan, without: int | None = None) -> tuple[SeenGroup, NamedScan]:
    """Bars that are designed at places (k, 2) mm, with what a scan shows of them, but for one that was not found."""
    up = np.array([0.0, 0.0, 1.0])
    rebars = tuple(
        AssemblyPoint(f"R{k}", Kind.REBAR, np.array([x, y, 0.0]), up, BAR_MM) for k, (x, y) in enumerate(places, 1)
    )

    def look(kind: Kind, diameters_mm: Sequence[float]) -> Extraction:
        return extract_sizes(scan, kind, diameters_mm, "refined", np.random.default_rng(0))

    found = look(Kind.REBAR, [BAR_MM])
    if without is not None:
        at = places[without]
        found = replace(found, points=tuple(p for p in found.points if np.hypot(*(p.centre[:2] - at)) > 20.0))
    match = match_extraction(rebars, found, up=90.0, image_up_scan=np.array([0.0, -1.0, 0.0]))
    named = NamedScan("bars", look, lambda across, along: named, 700.0)
    return SeenGroup(Kind.REBAR, rebars, found, match), named


def told(places: Array, scan: Scan, without: int | None = None) -> list[Finding]:
    group, named = seen(places, scan, without)
    design = ColumnDesign("C-1", (), tuple(group.design))
    return list(mistaken_findings(design, {Kind.REBAR: group}, {Kind.REBAR: named}))


@pytest.mark.parametrize("count", [3, 5])
@pytest.mark.parametrize("thick", [0, -1])
def test_a_bar_with_a_cap_that_was_not_found_is_named(count: int, thick: int) -> None:
    places = row(count)
    (finding,) = told(places, taken(places, CORE_MM, capped=thick), without=thick)
    # a row of bars seen from above with nothing else: which end is which is left open here
    assert finding.code == "diameter_differs"
    assert finding.about in {("R1",), (f"R{count}",)}
    assert finding.values["measured_mm"] == pytest.approx(CORE_MM + CAP_MM, abs=1.5)


def test_bars_of_another_size_that_stand_on_all_places_are_named() -> None:
    places = row(4)
    (finding,) = told(places, taken(places, 24.2))
    assert finding.about == ("rebars",)
    assert finding.values["measured_mm"] == pytest.approx(24.2, abs=0.6)


def test_bars_that_a_camera_takes_two_pixels_from_are_no_thinner_ones() -> None:
    places = row(4)
    scan = taken(places, CORE_MM)
    depth = scan.points[..., 2]
    low, high = ndimage.minimum_filter(depth, 3), ndimage.maximum_filter(depth, 3)
    lost = ndimage.binary_dilation(high - low > 5.0, np.ones((3, 3)))
    points = np.where(lost[..., None], np.float32(np.nan), scan.points)
    assert told(places, replace(scan, points=points)) == []
