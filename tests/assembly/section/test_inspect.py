"""The section of a foot from its edges, against corners laid out by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.assembly.findings.section import section_findings
from aadm_workbench.assembly.section import inspect_section
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.extract.section.outline import SIDES, FaceHeights, SeenEdge
from aadm_workbench.extract.section.strips import Chip
from aadm_workbench.model import Reason, Verdict
from aadm_workbench.model.reports import SectionReport

DESIGN = inline_design(
    "C-1",
    {
        "centres": [[x, y] for x in (-140.0, 0.0, 140.0) for y in (-90.0, 90.0)],
        "sleeve_diameter": 36.0,
        "rebar_diameter": 20.0,
        "size": [400.0, 300.0],
    },
)
CN = load_profile("cn")


def seen_from(corners: list[tuple[float, float]], u_mm: float = 0.05) -> dict[str, SeenEdge | Reason]:
    """Edges between corners from (−x, −y) counter-clockwise, each told at its own middle."""
    edges: dict[str, SeenEdge | Reason] = {}
    for side, a, b in zip(SIDES, corners, corners[1:] + corners[:1], strict=True):
        middle = (a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0
        out, along = {
            "-y": (-middle[1], middle[0]),
            "+x": (middle[0], middle[1]),
            "+y": (middle[1], -middle[0]),
            "-x": (-middle[0], -middle[1]),
        }[side]
        straight = {"-y": 0.0, "+x": 90.0, "+y": 180.0, "-x": -90.0}[side]
        angle = math.degrees(math.atan2(b[1] - a[1], b[0] - a[0])) - straight
        turn = math.radians((angle + 180.0) % 360.0 - 180.0)
        edges[side] = SeenEdge(side, out, along, turn, np.diag([u_mm**2, 1e-8]), 0.0, 1.0, ())
    return edges


def section(corners: list[tuple[float, float]], heights: FaceHeights | None = None) -> SectionReport:
    found = inspect_section(DESIGN, seen_from(corners), heights, CN, fit_u_mm=0.03, fit_u_turn=0.0, decision="guarded")
    assert found is not None
    return found


SQUARE = [(-200.0, -150.0), (200.0, -150.0), (200.0, 150.0), (-200.0, 150.0)]


def test_a_section_as_designed_has_nothing_to_say() -> None:
    found = section(SQUARE)
    assert [edge.measured_mm for edge in found.edges] == pytest.approx([150.0, 200.0, 150.0, 200.0])
    assert [length.deviation_mm for length in found.lengths[:2]] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert found.pattern.offset_mm == pytest.approx((0.0, 0.0), abs=1e-9)
    assert found.squareness_deg == pytest.approx(0.0, abs=1e-9)
    assert list(section_findings(found)) == []


def test_a_pattern_beside_its_section_is_named_with_its_sign() -> None:
    # Seen from the sleeves the section lies 1.8 mm towards -x and 0.6 towards +y: the pattern is off the other way.
    found = section([(x - 1.8, y + 0.6) for x, y in SQUARE])
    assert found.pattern.offset_mm == pytest.approx((1.8, -0.6))
    assert found.pattern.verdict is Verdict.PASS
    (finding,) = section_findings(found)
    assert finding.code == "pattern_off_section"
    assert "+1.8, -0.6 mm" in finding.text
    assert not finding.holds_back


def test_a_turned_section_turns_the_pattern_the_other_way_and_no_corner() -> None:
    c, s = math.cos(math.radians(0.4)), math.sin(math.radians(0.4))
    corners = [(c * x - s * y, s * x + c * y) for x, y in SQUARE]
    found = section(corners)
    assert found.pattern.turn_deg == pytest.approx(-0.4, abs=1e-6)
    assert found.squareness_deg == pytest.approx(0.0, abs=1e-6)
    by_name = {corner.name: corner.measured_mm for corner in found.corners}
    for name, corner in zip(("-x-y", "+x-y", "+x+y", "-x+y"), corners, strict=True):
        assert by_name[name] == pytest.approx(corner, abs=1e-6)


def test_a_sheared_section_is_not_square() -> None:
    shear = math.tan(math.radians(0.5))
    found = section([(x + shear * y, y) for x, y in SQUARE])
    assert abs(found.squareness_deg or 0.0) == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize(
    ("wider_mm", "verdict"), [(4.0, Verdict.PASS), (4.95, Verdict.INCONCLUSIVE), (6.5, Verdict.FAIL)]
)
def test_a_wide_section_is_judged_by_what_is_known(wider_mm: float, verdict: Verdict) -> None:
    found = section([(x + math.copysign(wider_mm / 2.0, x), y) for x, y in SQUARE])
    length = found.lengths[0]
    assert length.deviation_mm == pytest.approx(wider_mm)
    assert length.u_mm == pytest.approx(0.05 * math.sqrt(2.0), rel=1e-6)
    assert length.verdict is verdict
    assert [one.code for one in section_findings(found)] == (
        [] if verdict is Verdict.PASS else ["section_size_differs"]
    )
    assert found.verdict is Verdict.NOT_ASSESSED  # the rules are advisory: nobody has verified them


def test_what_all_edges_share_widens_the_size_and_leaves_the_place() -> None:
    edges = {
        side: replace(edge, shared_u_mm=0.3) for side, edge in seen_from(SQUARE).items() if isinstance(edge, SeenEdge)
    }
    found = inspect_section(DESIGN, edges, None, CN, fit_u_mm=0.0, fit_u_turn=0.0, decision="guarded")
    assert found is not None
    assert found.lengths[0].u_mm == pytest.approx(math.hypot(0.6, 0.05 * math.sqrt(2.0)))
    assert found.pattern.u_mm == pytest.approx((0.05 / math.sqrt(2.0),) * 2)


def test_one_edge_unseen_leaves_that_side_unmeasured_and_says_which() -> None:
    edges = seen_from(SQUARE) | {"+y": Reason("extract.section_out")}
    found = inspect_section(DESIGN, edges, None, CN, fit_u_mm=0.03, fit_u_turn=0.0, decision="guarded")
    assert found is not None
    assert found.lengths[0].verdict is Verdict.PASS
    assert found.lengths[1].verdict is Verdict.NOT_MEASURED
    assert found.lengths[1].reason == "edge +y: too little of this edge is in the picture"
    assert found.pattern.verdict is Verdict.NOT_MEASURED
    assert {corner.name for corner in found.corners} == {"-x-y", "+x-y"}


def test_a_design_that_does_not_place_its_section_has_none() -> None:
    corner = inline_design(
        "C-2",
        {
            "centres": [[x, y] for x in (60.0, 200.0, 340.0) for y in (60.0, 240.0)],
            "sleeve_diameter": 36.0,
            "size": [400.0, 300.0],
        },
    )
    assert corner.section_middle_mm is None
    assert (
        inspect_section(corner, seen_from(SQUARE), None, CN, fit_u_mm=0.03, fit_u_turn=0.0, decision="guarded") is None
    )


def test_centres_written_about_the_sections_middle_keep_their_place_in_it() -> None:
    aside = inline_design(
        "C-3",
        {
            "centres": [[x + 20.0, y - 10.0] for x in (-140.0, 140.0) for y in (-90.0, 90.0)],
            "sleeve_diameter": 36.0,
            "size": [400.0, 300.0],
        },
    )
    assert aside.section_middle_mm == pytest.approx((-20.0, 10.0))


def test_an_uneven_face_is_named() -> None:
    heights = FaceHeights(33.3, np.array([-200.0, -150.0]), np.full((9, 12), np.nan), 6.2, 0.1)
    found = section(SQUARE, heights)
    (finding,) = section_findings(found)
    assert finding.code == "face_not_flat"
    assert "6.2 mm" in finding.text


def test_a_deep_chip_is_told_with_its_place() -> None:
    edges = seen_from(SQUARE)
    edge = edges["+x"]
    assert isinstance(edge, SeenEdge)
    edges["+x"] = replace(edge, chips=(Chip(100.0, 130.0, 8.0), Chip(-20.0, -15.0, 2.0)))
    found = inspect_section(DESIGN, edges, None, CN, fit_u_mm=0.03, fit_u_turn=0.0, decision="guarded")
    (finding,) = section_findings(found)
    assert finding.code == "edge_chipped"
    assert "edge +x" in finding.text
    assert "30 mm long and 8 mm deep, at +115 mm" in finding.text
