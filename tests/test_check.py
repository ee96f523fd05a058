"""One column from its scans to its report: what only the whole way shows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.check import CheckSettings, ColumnScans, check_column
from aadm_workbench.model import ColumnDesign, Verdict
from aadm_workbench.twin.parts import BarGroup
from aadm_workbench.twin.scene import TrueScan
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot
from aadm_workbench.twin.truth import sample_design
from tests.scenes import lab_bars, lab_scan

CORNERS = (0, 3, 6, 9)


def up_to(group: BarGroup, heights_mm: list[float]) -> BarGroup:
    """The bars with their tops at some heights over the usual level, standing as designed otherwise."""
    bars = [replace(bar, top=height) for bar, height in zip(group.bars, heights_mm, strict=True)]
    return replace(group, bars=tuple(bars))


@pytest.fixture(scope="module")
def long_bars() -> TrueScan:
    """Bars whose tops stand 5 mm above the design's level, but for one that stands 14 mm above it."""
    return lab_scan(up_to(lab_bars(), [5.0] * 4 + [14.0] + [5.0] * 7))


def exposed_rule(design: ColumnDesign, truth: TrueScan) -> tuple[Verdict, str]:
    settings = CheckSettings(load_profile("cn-gb50204-2015"), checks=("rebars",))
    report = check_column(design, ColumnScans(rebars=(truth.scan(),), rebars_up_deg=90.0), settings)
    assert report.rebars is not None
    found = next(rule for rule in report.rebars.rules if rule.rule == "rebar_exposed_length")
    return found.verdict, found.reason


def test_a_bar_that_sticks_out_14_mm_too_far_fails_the_limit_of_10(long_bars: TrueScan) -> None:
    design = replace(sample_design(LAB), exposed_length_mm=LAB.exposed)
    verdict, reason = exposed_rule(design, long_bars)
    assert verdict is Verdict.FAIL
    assert reason.startswith("R5 sticks out 134.")
    assert reason.count("sticks out") == 1


def test_a_design_that_asks_for_more_finds_all_others_too_short(long_bars: TrueScan) -> None:
    verdict, reason = exposed_rule(replace(sample_design(LAB), exposed_length_mm=LAB.exposed + 8.0), long_bars)
    assert verdict is Verdict.FAIL
    assert reason.count("sticks out") == 11
    assert "R5 " not in reason


def test_without_an_exposed_length_in_the_design_nothing_is_said_of_it(long_bars: TrueScan) -> None:
    assert exposed_rule(sample_design(LAB), long_bars)[0] is Verdict.NOT_ASSESSED


def test_a_column_with_thicker_bars_at_its_corners_goes_on() -> None:
    """Sleeves of 26 and 34 mm, bars of 18 and 25: each pair with the room that is its own."""
    foot, group = (draw(LAB, np.random.default_rng(40), 0.2) for draw in (random_foot, random_bars))
    wide = tuple(replace(s, diameter=s.diameter + 8.0) if k in CORNERS else s for k, s in enumerate(foot.sleeves))
    thick = tuple(replace(b, core_diameter=24.5) if k in CORNERS else b for k, b in enumerate(group.bars))
    plain = sample_design(LAB)
    design = replace(
        plain,
        sleeves=tuple(replace(p, diameter_mm=34.0) if k in CORNERS else p for k, p in enumerate(plain.sleeves)),
        rebars=tuple(replace(p, diameter_mm=25.0) if k in CORNERS else p for k, p in enumerate(plain.rebars)),
    )
    scans = ColumnScans(
        (lab_scan(replace(foot, sleeves=wide)).scan("foot"),),
        (lab_scan(replace(group, bars=thick)).scan("bars"),),
        sleeves_up_deg=90.0,
        rebars_up_deg=90.0,
    )
    report = check_column(design, scans, CheckSettings(load_profile("cn")))
    assert report.sleeves is not None
    assert report.rebars is not None
    assert (report.sleeves.found, report.rebars.found) == (12, 12)
    # 25 mm bars leave 2.3 mm over their ribs: by value there is room for all, with each its own.
    assert report.trial_assembly is not None
    assert report.trial_assembly.margin is not None
    assert report.trial_assembly.margin > 0.2
    assert report.trial_assembly.collisions == ()
    assert report.goes_on in (Verdict.PASS, Verdict.INCONCLUSIVE)
    diameters = [point.diameter_mm for point in report.sleeves.points]
    assert diameters == pytest.approx([34.0 if k in CORNERS else 26.0 for k in range(12)], abs=0.5)
