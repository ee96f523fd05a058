"""Turns of a column about its axis: which one fits, and what scans leave open."""

from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.matching.symmetry import symmetric_turns
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.assembly.trial.virtual import try_assembly, try_scans
from aadm_workbench.model import Array, Kind, TrialReport, Verdict
from tests.assembly.trial.test_virtual import CN, Y_UP, tried


def test_turns_find_the_one_that_fits(build: Any, square: Array) -> None:
    """Sleeves and bars displaced alike, but a quarter turn apart."""
    design = build.column(square)
    quarter = next(found for found in symmetric_turns(square) if found.angle == pytest.approx(np.pi / 2.0))
    offsets = np.zeros((12, 2))
    offsets[0], offsets[4] = [-6.0, 0.0], [0.0, 8.0]
    bars = np.zeros((12, 2))
    bars[quarter.onto] = offsets @ turn(quarter.angle).T
    sleeves, rebars = build.moved(design.sleeves, offsets), build.moved(design.rebars, bars)
    fixed = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    assert fixed.verdict is Verdict.FAIL
    assert fixed.turns == ()
    free = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0), turns=True)
    assert free.verdict is Verdict.PASS
    assert free.turn_deg == pytest.approx(90.0)
    assert free.minimax is not None
    assert free.minimax.max_mm < 1e-6
    assert free.minimax.pairs[0].rebar == f"R{quarter.onto[0] + 1}"
    assert [round(found.turn_deg) for found in free.turns] == [0, 90, -90, 180]
    straight = tried(build, design, np.zeros((12, 2)), turns=True)
    assert straight.turn_deg == 0.0, "what fits as drawn is not turned"


def test_from_scans_declared_and_ambiguous(build: Any, square: Array) -> None:
    rng = np.random.default_rng(8)
    design = build.column(square)
    flat = np.array([1.0, 1.0, 0.0])

    def scanned(kind: Kind, built: Array, declared: bool) -> Any:
        points = design.points(kind)
        lifted = built + np.array([0.0, 0.0, points[0].centre[2]])
        seen = build.see(lifted, rng)
        found = build.extraction(kind, seen, points[0].diameter_mm)
        up = Y_UP if declared else None
        return found, match_extraction(points, found, up=up, image_up_scan=seen.image_up)

    good = square + rng.normal(0.0, 0.3, square.shape) * flat
    keyed = square.copy()
    keyed[1, 0] += 9.0
    bars = keyed + rng.normal(0.0, 0.1, square.shape) * flat

    def trial(sleeves: Array, rebars: Array, declared: bool) -> TrialReport:
        return try_scans(
            design,
            scanned(Kind.SLEEVE, sleeves, True),
            scanned(Kind.REBAR, rebars, declared),
            CN,
            np.random.default_rng(0),
        )

    assert trial(good, good, True).verdict is Verdict.PASS
    passes = trial(good, square, False)
    assert passes.verdict is Verdict.PASS, "in all four turns"
    assert any("fits in 4 turns" in note for note in passes.notes)
    assert trial(keyed, bars, True).verdict is Verdict.PASS
    depends = trial(keyed, bars, False)
    assert depends.verdict is Verdict.INCONCLUSIVE
    assert any("pass in 1, fail in 3" in reason for reason in depends.reasons)
    nothing = build.extraction(Kind.REBAR, build.see(square, rng, missing=tuple(range(12))), 20.0)
    lost = try_scans(
        design,
        scanned(Kind.SLEEVE, good, True),
        (nothing, match_extraction(design.rebars, nothing)),
        CN,
        np.random.default_rng(0),
    )
    assert lost.verdict is Verdict.NOT_MEASURED
    assert lost.reasons == ("rebars: no rebar was found in the scan",)
