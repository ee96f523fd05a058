"""A check by the corners method: it says that it measured no sleeve, and no column passes by it."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.hoisting.published import measure_published
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import Verdict
from tests.extract.published.test_corners import PATTERN, design_of, scan_of


@pytest.mark.parametrize("off_mm", [0.0, 6.0])
def test_sleeves_by_design_are_not_measured_good_or_bad(off_mm: float) -> None:
    design = design_of(PATTERN, [400.0, 300.0])
    built = PATTERN.copy()
    built[0, 0] += off_mm
    scans = ColumnScans(sleeves=(scan_of(built),), sleeves_up_deg=90.0)
    report = check_column(design, scans, CheckSettings(load_profile("cn"), method="corners"))
    assert report.verdict is Verdict.NOT_MEASURED
    assert report.sleeves is not None
    assert report.sleeves.verdict is Verdict.NOT_MEASURED
    assert {point.verdict for point in report.sleeves.points} == {Verdict.NOT_MEASURED}
    assert all(point.deviation_mm is None for point in report.sleeves.points)
    (finding,) = report.findings
    assert finding.code == "sleeves_by_design"
    assert report.reasons[0] == finding.text
    assert report.section is None


def test_a_hanging_column_is_not_measured_by_corners() -> None:
    design = design_of(PATTERN, [400.0, 300.0])
    rng = np.random.default_rng(0)
    found = measure_published(scan_of(PATTERN), design, "corners", near=None, rng=rng)
    assert found.report.verdict is Verdict.NOT_MEASURED
    assert "measures no hanging columns" in found.report.reasons[0]
