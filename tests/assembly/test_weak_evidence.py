"""Slips that no witness tells by itself: small patterns, columns of three points, bores of which little is seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.assembly.findings.finding import SeenGroup
from aadm_workbench.assembly.findings.mistaken import fits
from aadm_workbench.assembly.findings.of_column import without_spoilt
from aadm_workbench.assembly.findings.rules import lean_findings
from aadm_workbench.assembly.findings.scale import doubted_scale_error, scale_findings
from aadm_workbench.model import ColumnReport, Kind, TrialReport, Verdict
from tests.assembly.test_findings import design_of, group

SMALL = [complex(x, y) for x in (-30.0, 30.0) for y in (-30.0, 30.0)]
BORE_MM = 26.0


def pair(scale: float, seed: int) -> tuple[SeenGroup, SeenGroup]:
    """Four sleeves and four bars within 60 mm, seen by one camera: none of the three witnesses is sure by itself."""
    rng = np.random.default_rng([31, seed])
    bores_mm = [float(scale * (BORE_MM + rng.normal(0.0, 0.08))) for _ in SMALL]
    foot = group(SMALL, design_mm=BORE_MM, measured_mm=bores_mm, scale=scale, seed=2 * seed)
    return foot, group(SMALL, kind=Kind.REBAR, design_mm=18.0, scale=scale, seed=2 * seed + 1)


@pytest.mark.parametrize("scale", [0.98, 1.02])
def test_a_wrong_focal_length_shows_in_small_patterns_and_bores_together(scale: float) -> None:
    told = [list(scale_findings(pair(scale, seed))) for seed in range(60)]
    assert sum(bool(found) for found in told) >= 57
    about_both = [one for found in told for one in found if set(one.about) == {"sleeves", "rebars"}]
    assert len(about_both) >= 50
    assert all("focal length" in one.text for one in about_both)


def test_sound_small_patterns_have_no_scale_and_no_doubt() -> None:
    pairs = [pair(1.0, seed) for seed in range(150)]
    assert not any(list(scale_findings(one)) for one in pairs)
    doubted = [doubted_scale_error(one) > 1e-3 for both in pairs for one in both]
    assert np.mean(doubted) < 0.1


def test_bores_alone_are_another_size_and_no_scale() -> None:
    foot, bars = pair(1.0, 3)
    points = tuple(replace(point, diameter_mm=25.3) for point in foot.extraction.points)
    narrow = replace(foot, extraction=replace(foot.extraction, points=points))
    assert list(scale_findings((narrow, bars))) == []


def test_what_a_scan_speaks_against_its_lengths_is_in_their_uncertainty() -> None:
    """Bars alone, two parts in a hundred too small: where no finding says so, the standard uncertainty does."""
    seen = [pair(0.98, seed)[1] for seed in range(80)]
    silent = [one for one in seen if not list(scale_findings((one,)))]
    errors = np.array([doubted_scale_error(one) for one in silent])
    assert len(silent) > 20
    assert np.mean(errors > 0.004) > 0.5


def test_the_three_points_of_another_design_are_told_and_those_of_none_are_not() -> None:
    row = [-62.0, 0.0, 66.0]
    seen = group([complex(x) for x in row], design_mm=BORE_MM, scatter_mm=0.4).extraction
    assert fits(design_of([complex(x) for x in row], Kind.SLEEVE, BORE_MM), seen)
    for factor in (0.8, 0.9, 1.1, 1.25):
        assert not fits(design_of([complex(factor * x) for x in row], Kind.SLEEVE, BORE_MM), seen)
    assert not fits(design_of([complex(x) for x in (*row, 130.0)], Kind.SLEEVE, BORE_MM), seen)


def leaning(kind: Kind, shear: tuple[float, float], seen: float, seed: int) -> SeenGroup:
    """Eight points whose axes are sheared; of bores so little is seen that a belief in upright ones has its say.

    ``seen`` is the standard deviation of a lean by what is seen of it; belief and sight are put together by Bayes.
    """
    rng = np.random.default_rng([32, seed])
    places = [80.0 * np.exp(2j * np.pi * k / 8.0) + 0.7 * k for k in range(8)]
    grown = group(places, kind=kind, seed=seed)
    belief = 0.010 if kind is Kind.SLEEVE else np.inf
    share = 1.0 / (1.0 + (seen / belief) ** 2)
    points = []
    for point in grown.extraction.points:
        sight = np.array(shear) + rng.normal(0.0, 0.005, 2) + rng.normal(0.0, seen, 2)
        axis = np.array([*(share * sight), 1.0])
        spread = np.diag([share * seen**2 + 2e-3**2] * 2 + [0.0])
        points.append(replace(point, axis=axis / np.linalg.norm(axis), axis_covariance=spread, seen_length_mm=40.0))
    extraction = replace(grown.extraction, points=tuple(points), vertical_from="floor")
    return replace(grown, extraction=extraction)


def test_bores_that_were_drawn_upright_still_tell_a_wrong_principal_point() -> None:
    shear = (-0.033, 0.033)
    degrees = []
    for seed in range(20):
        both = leaning(Kind.SLEEVE, shear, 0.02, seed), leaning(Kind.REBAR, shear, 0.01, seed + 100)
        (finding,) = lean_findings(both)
        assert (finding.code, finding.about) == ("common_lean", ("sleeves", "rebars"))
        degrees.append(finding.values["sleeves_deg"])
    assert np.mean(degrees) == pytest.approx(2.67, abs=0.3)


def test_upright_bores_of_which_little_is_seen_lean_nowhere() -> None:
    for seed in range(60):
        both = leaning(Kind.SLEEVE, (0.0, 0.0), 0.02, seed), leaning(Kind.REBAR, (0.0, 0.0), 0.01, seed + 100)
        assert list(lean_findings(both)) == []


def test_sleeves_and_bars_that_all_lean_leave_the_trial_open() -> None:
    """Each by another angle: that both do so by chance is no likelier than a camera that bores hide a part of."""
    trial = TrialReport(Verdict.FAIL, reasons=("R1 collides with S1",))
    report = ColumnReport("C-1", Verdict.FAIL, goes_on=Verdict.FAIL, reasons=trial.reasons, trial_assembly=trial)
    foot, bars = leaning(Kind.SLEEVE, (0.029, 0.0), 0.002, 1), leaning(Kind.REBAR, (0.055, 0.0), 0.002, 2)
    found = list(lean_findings((foot, bars)))
    assert [one.about for one in found] == [("sleeves",), ("rebars",)]
    assert without_spoilt(report, found, ("trial",)).goes_on is Verdict.INCONCLUSIVE
    assert without_spoilt(report, found[:1], ("trial",)).goes_on is Verdict.FAIL
