"""A gauge study of reports: the variances that were put in, and an honest u told from one that is half too small."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.calibration.gauge.captures import Capture, Study, studies_of
from aadm_workbench.calibration.gauge.document import gauge_document
from aadm_workbench.calibration.gauge.page import gauge_page
from aadm_workbench.calibration.gauge.study import GaugeStudy, gauge_study
from aadm_workbench.model import ColumnReport, Fit, GroupReport, JobReport, PointResult, Reason, SpacingResult, Verdict
from aadm_workbench.report.json import encode, write_report
from batch.main import main

PROFILE = load_profile("cn")
SIGMA_MM, OF_OPERATORS_MM, PARTS = 0.04, 0.03, 12


def report(offsets: np.ndarray, u_mm: float | None, operator: str = "A", orientation: str = "resolved") -> JobReport:
    """A check of one column: offsets (n, 2) mm of its sleeves; no trial, no rebars."""
    points = tuple(
        PointResult(
            f"S{number}",
            None,
            (0.0, 0.0, 0.0),
            None,
            None,
            None,
            None,
            (x, y),
            float(np.hypot(x, y)),
            u_mm,
            2.0,
            Verdict.PASS,
        )
        for number, (x, y) in enumerate(offsets.tolist(), 1)
    )
    spans = tuple(
        SpacingResult((one.label, other.label), 160.0, 160.0, one.offset_mm[0], u_mm, (-2.0, 2.0), Verdict.PASS)
        for one, other in pairwise(points)
        if one.offset_mm is not None
    )
    fit = Fit(np.eye(4), 0.1, 0.2, orientation)  # type: ignore[arg-type]
    group = GroupReport("foot.tiff", "0" * 64, "refined", len(points), len(points), Verdict.PASS, points, spans, fit)
    column = ColumnReport("C-1", Verdict.PASS, Verdict.NOT_MEASURED, sleeves=group)
    job = {"name": "j", "sha256": "0" * 64, "source": "job.toml", "decision": "guarded", "checks": "sleeves"}
    tool = {"name": "aadm", "version": "1", "method": "refined", "seed": "0"}
    return JobReport(tool, job, {"operator": operator}, None, PROFILE, (column,))


def captures(seed: int, u_mm: float | None, operators: int = 3, repeats: int = 4) -> list[Capture]:
    """Repeat captures by another formula than the study's: effects added up, mm."""
    rng = np.random.default_rng(seed)
    parts = rng.normal(0.0, 0.6, (PARTS, 2))
    found = []
    for operator in "ABCDEFGH"[:operators]:
        own = rng.normal(0.0, OF_OPERATORS_MM, (PARTS, 2)) if operators > 1 else 0.0
        for repeat in range(repeats):
            offsets = parts + own + rng.normal(0.0, SIGMA_MM, (PARTS, 2))
            found.append(Capture(f"{operator}{repeat}", operator, report(offsets, u_mm, operator)))
    return found


def studied(seed: int, u_mm: float | None, **how: int) -> GaugeStudy:
    return gauge_study(captures(seed, u_mm, **how), np.random.default_rng(0))


def test_an_honest_u_is_told_from_one_that_is_half_too_small() -> None:
    honest_mm = float(np.hypot(SIGMA_MM, OF_OPERATORS_MM))
    believed = [studied(seed, honest_mm).quantities[0].stated.verdict for seed in range(20)]
    doubted = [studied(seed, honest_mm / 2.0).quantities[0].stated.verdict for seed in range(20)]
    assert believed.count(Verdict.PASS) >= 18  # 95 % of 20, and a little less
    assert doubted.count(Verdict.FAIL) == 20


def test_ten_minutes_are_enough_to_begin() -> None:
    """Three captures by one operator."""
    honest = [studied(seed, SIGMA_MM, operators=1, repeats=3).quantities[0].stated.verdict for seed in range(20)]
    small = [studied(seed, SIGMA_MM / 2, operators=1, repeats=3).quantities[0].stated.verdict for seed in range(20)]
    assert honest.count(Verdict.PASS) >= 18
    assert small.count(Verdict.FAIL) >= 19


def test_a_u_for_what_does_not_scatter_is_no_fault() -> None:
    (first, *_) = studied(3, 0.3).quantities
    assert first.stated.verdict is Verdict.PASS
    assert first.stated.reason.code == "gauge.u_covers"


def test_figures_against_limits() -> None:
    (first, *_) = studied(1, 0.06).quantities
    gauge_mm = first.variances.gauge.value**0.5
    two, three = first.against
    assert (two.limit_mm, three.limit_mm) == (2.0, 3.0)
    assert two.percent.value == pytest.approx(100.0 * 6.0 * gauge_mm / 4.0)
    assert three.percent.value == pytest.approx(two.percent.value * 2.0 / 3.0)
    assert two.verdict is Verdict.PASS
    assert two.categories == int(1.41 * ((4.0 / 6.0) ** 2 - gauge_mm**2) ** 0.5 / gauge_mm)
    assert studied(1, 0.06).verdicts.count(Verdict.FAIL) == 0


def test_points_that_a_capture_lacks_are_left_out_and_named() -> None:
    taken = captures(5, 0.06)
    spoilt = taken[4].report
    group = spoilt.columns[0].sleeves
    assert group is not None
    points = (replace(group.points[0], offset_mm=None), *group.points[1:])
    columns = (replace(spoilt.columns[0], sleeves=replace(group, points=points)),)
    taken[4] = replace(taken[4], report=replace(spoilt, columns=columns))
    study = studies_of(taken)[0]
    assert isinstance(study, Study)
    assert len(study.parts) == PARTS - 1
    assert [reason.code for reason in study.left_out if isinstance(reason, Reason)] == ["gauge.not_everywhere"]
    assert "C-1 S1" in study.left_out[0]


def test_captures_that_may_be_turned_are_not_compared() -> None:
    taken = [Capture("a", "A", report(np.zeros((4, 2)), 0.1, orientation="ambiguous"))] * 3
    assert studies_of(taken) == ()
    assert gauge_study(taken, np.random.default_rng(0)).verdicts == (Verdict.NOT_MEASURED,)


def test_one_capture_of_an_operator_repeats_nothing() -> None:
    found = studies_of(captures(1, 0.05, operators=2, repeats=1))
    assert {reason.code for reason in found if isinstance(reason, Reason)} == {"gauge.one_capture"}


def test_the_document_and_the_page_hold_the_same_figures() -> None:
    found = studied(2, 0.06)
    document = json.loads(encode(gauge_document(found)))
    first = document["quantities"][0]
    assert first["quantity"] == "sleeves"
    assert first["gauge_mm"][0] == pytest.approx(found.quantities[0].variances.gauge.value ** 0.5, rel=1e-3)
    page = gauge_page(found, "zh")
    assert page == gauge_page(found, "zh")
    assert f"{first['gauge_mm'][0]:.3f}" in page
    assert str(found.quantities[0].stated.reason) in page
    assert found.quantities[0].stated.reason.in_language("zh") in page
    assert "<script" not in page


def test_names_cannot_break_out_of_the_page() -> None:
    hostile = "<img src=x onerror=alert(1)>"
    taken = [replace(one, name=hostile, operator=hostile) for one in captures(4, 0.06, operators=1)]
    page = gauge_page(gauge_study(taken, np.random.default_rng(0)))
    assert hostile not in page
    assert "&lt;img" in page


def test_the_command_studies_reports(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = []
    for number, capture in enumerate(captures(6, 0.06)):
        files.append(str(tmp_path / f"{number}.json"))
        write_report(capture.report, Path(files[-1]))
    code = main(["gauge", *files, "--json", "--html", "--out", str(tmp_path / "out")])
    document = json.loads(capsys.readouterr().out)
    assert code == 0
    assert {one["operator"] for one in document["captures"]} == {"A", "B", "C"}
    assert document["quantities"][0]["repeats"] == 4
    assert (tmp_path / "out" / "gauge.html").exists()
    assert main(["gauge", files[0]]) == 2
    assert "two captures" in capsys.readouterr().err
