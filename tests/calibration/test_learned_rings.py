"""A profile knows how many rings of pixels its camera dropped; a scan in which that is another number says so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.assembly.findings.rules import profile_findings
from aadm_workbench.calibration.learn.verify import verified
from aadm_workbench.calibration.plate.plate import drawn_plate
from aadm_workbench.extract.edges.learned_edges import EDGE_LAWS, with_learned_stretch
from aadm_workbench.extract.rebars import extract_rebars
from aadm_workbench.extract.sleeves import extract_sleeves
from aadm_workbench.model import Camera, CameraProfile, Extraction, Kind, LearnedEdges, Measure, Verdict
from aadm_workbench.scan.camera_profile import profile_text, read_profile
from aadm_workbench.twin.scenes import LAB
from tests.assembly.test_findings import group, square
from tests.calibration.test_learn import captures
from tests.extract.edges.test_bars_without_rings import without_rings
from tests.scenes import lab_bars, lab_foot, lab_scan

NOTHING = Measure(0.0, 1e-5)
EXTRACT = {Kind.SLEEVE: (extract_sleeves, LAB.sleeve_diameter), Kind.REBAR: (extract_rebars, LAB.bar_diameter)}


def profile(rings: float | None) -> CameraProfile:
    edges = {kind: LearnedEdges(NOTHING, 0.0, 0.1, NOTHING, rings=rings) for kind in Kind}
    camera = Camera(2400.0, 2400.0, 960.0, 600.0, 1920, 1200)
    span = (700.0, 900.0)
    return CameraProfile("", "", "0042", "", "2026-11-20", 90, camera, span, (0.0, 5.0), NOTHING, edges, laws=EDGE_LAWS)


def told(found: Extraction, rings: float | None) -> list[str]:
    known = with_learned_stretch(found, profile(rings))
    seen = group(square(), kind=found.kind)
    findings = profile_findings([replace(seen, extraction=replace(seen.extraction, quality=known.quality))])
    return [finding.code for finding in findings]


@pytest.mark.parametrize("kind", list(Kind))
@pytest.mark.parametrize("dropped", [0, 1])
def test_another_number_of_rings_is_told_and_the_same_is_not(kind: Kind, dropped: int) -> None:
    true = lab_scan(lab_foot() if kind is Kind.SLEEVE else lab_bars())
    extract, diameter_mm = EXTRACT[kind]
    seen = replace(true, depth=without_rings(true.depth, dropped).astype(np.float32)) if dropped else true
    found = extract(seen.scan(), diameter_mm, np.random.default_rng(0))
    assert found.rings == pytest.approx(dropped, abs=0.4)
    assert told(found, float(dropped)) == []
    assert told(found, 1.0 - dropped) == ["profile_differs"]
    assert told(found, None) == []
    assert told(replace(found, rings=None), 1.0 - dropped) == []


def test_the_file_of_a_profile_keeps_its_rings(tmp_path: Path) -> None:
    (tmp_path / "with.toml").write_text(profile_text(profile(0.93), ""), encoding="utf-8")
    (tmp_path / "without.toml").write_text(profile_text(profile(None), ""), encoding="utf-8")
    assert [read_profile(tmp_path / name).edges[Kind.REBAR].rings for name in ("with.toml", "without.toml")] == [
        0.93,
        None,
    ]


def test_the_check_before_a_shift_tells_a_filter_that_was_switched_on() -> None:
    plate = drawn_plate(12, 36.0, 160.0, 20.0)
    (capture, *_) = captures(plate, np.random.default_rng(2), count=1)
    for rings, verdicts in ((0.1, [Verdict.PASS] * 2), (1.0, [Verdict.FAIL] * 2), (None, [])):
        checks = verified(replace(capture, rings=dict.fromkeys(Kind, rings)), plate, profile(0.0))
        assert [check.verdict for check in checks if check.name.startswith("rings")] == verdicts
