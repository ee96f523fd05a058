"""What the pages say of a section of which an edge was not seen: which, and why, in both languages."""

from __future__ import annotations

from aadm_workbench.model import Reason, Verdict
from aadm_workbench.model.reports import PatternPlace, SectionEdge, SectionReport
from aadm_workbench.report.sheets.section_rows import section_line


def test_an_edge_that_was_not_measured_is_named_with_its_reason() -> None:
    edges = (
        SectionEdge("-y", 150.0, reason=Reason("extract.section_out")),
        SectionEdge("+x", 200.0, 200.5, 0.05),
        SectionEdge(
            "+y",
            150.0,
            reason="heights before this edge are disturbed over more than three pixels: the "
            "camera is out of focus there",
        ),
        SectionEdge("-x", 200.0, 199.5, 0.05),
    )
    pattern = PatternPlace(Verdict.NOT_MEASURED)
    line = section_line(SectionReport(Verdict.NOT_ASSESSED, edges, (), (), pattern))
    assert line is not None
    assert line.en.startswith(
        "not measured: edge -y: too little of this edge is in the picture; edge +y: heights before"
    )
    assert line.zh.startswith("未测得：-y 边：该边在画面内的部分太少；+y 边：该边前三个像素以上的高度均受扰动")
    assert "focus" not in line.zh
