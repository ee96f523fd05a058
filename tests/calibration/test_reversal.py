"""Reversal by reports, as a job or the command has them: the same bend as by extractions, verdicts, and exit codes."""

import json
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from aadm_workbench.calibration.reversal import ColumnReversal, reversal_document, reversals_of
from aadm_workbench.model import Fit, GroupReport, JobReport, Kind, PointResult, Reason, Verdict
from batch.main import main
from tests.assembly.matching.test_reversal import DESIGN, DISTANCE_MM, lens


def report(part: np.ndarray, turn_deg: float, bend: tuple[float, float], rng: np.random.Generator) -> JobReport:
    """What a check of one capture says: a camera that looks up, turned about its axis; its pose is known by design."""
    c, s = np.cos(np.radians(turn_deg)), np.sin(np.radians(turn_deg))
    turn = np.array([[c, -s], [s, c]])
    places = np.array([one.centre[:2] for one in DESIGN])
    seen = lens((places + part) @ turn / DISTANCE_MM, *bend) * DISTANCE_MM + rng.normal(0.0, 0.02, places.shape)
    T_design_scan = np.eye(4)
    T_design_scan[:2, :2] = turn
    offset = seen @ turn.T - places
    points = tuple(
        PointResult(
            one.label,
            None,
            tuple(one.centre.tolist()),
            (*at.tolist(), DISTANCE_MM),
            (*(one.centre[:2] + off).tolist(), 0.0),
            36.0,
            0.0,
            tuple(off.tolist()),
            float(np.hypot(*off)),
            0.05,
            2.0,
            Verdict.PASS,
        )
        for one, at, off in zip(DESIGN, seen, offset, strict=True)
    )
    fit = Fit(T_design_scan, 0.0, 0.0, "declared")
    group = GroupReport("", "", "refined", len(points), len(points), Verdict.PASS, points, (), fit)
    return cast("JobReport", SimpleNamespace(columns=[SimpleNamespace(id="C-1", groups={Kind.SLEEVE: group})]))


def found(bend: tuple[float, float], turns: tuple[float, ...] = (0.0, 180.0)) -> ColumnReversal:
    rng = np.random.default_rng(11)
    part = rng.normal(0.0, 0.5, (len(DESIGN), 2))
    (one,) = reversals_of([report(part, turn, bend, rng) for turn in turns])
    return one


def test_a_lens_off_its_axis_fails_and_a_sound_one_passes() -> None:
    bent, sound = found((2e-3, -1.5e-3)), found((0.0, 0.0))
    assert (bent.verdict, sound.verdict) == (Verdict.FAIL, Verdict.PASS)
    assert bent.labels[:2] == ("S1", "S2")
    (told,) = reversal_document([bent])
    assert told["captures"] == 2
    assert cast("float", told["bend_mm"]) > 0.15
    assert set(cast("dict[str, object]", told["part_mm"])) == {one.label for one in DESIGN}


def test_one_capture_is_no_reversal() -> None:
    rng = np.random.default_rng(1)
    assert reversals_of([report(np.zeros((len(DESIGN), 2)), 0.0, (0.0, 0.0), rng)]) == []


@pytest.mark.parametrize("times", [1, 2])
def test_the_command_says_what_reports_tell(times: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One report holds nothing twice; its job beside it is the same capture, shows no bend, and is told why."""
    main(["simulate", "pair", "--setting", "lab", "--out", str(tmp_path / "pair"), "--seed", "3", "--quiet"])
    main(["check", str(tmp_path / "pair" / "job.toml"), "--out", str(tmp_path / "out"), "--quiet"])
    capsys.readouterr()
    captures = [tmp_path / "out" / "report.json", tmp_path / "pair" / "job.toml"][:times]
    code = main(["camera", "reversal", *map(str, captures)])
    printed = capsys.readouterr()
    if times == 1:
        assert code == 2
        assert "nothing was captured twice" in printed.err
    else:
        assert code == 11
        for word in ("lab-1", "sleeves", "inconclusive", "stood"):
            assert word in printed.out
        main(["camera", "reversal", *map(str, captures), "--json"])
        for group in json.loads(capsys.readouterr().out):
            assert group["reason"] == Reason("calibration.unmoved")
