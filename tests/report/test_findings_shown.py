"""What was found on a column, and on which ``up`` its labels hang, stands wherever people read of it."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.report.bcf.topics import write_bcf
from aadm_workbench.report.column_view import column_notes, declared_up
from aadm_workbench.report.hoist import hoist_of
from aadm_workbench.report.pages.crew import crew_advice
from aadm_workbench.report.pages.html import write_html
from aadm_workbench.report.sheets.csv import csv_content
from aadm_workbench.report.sheets.sheets import columns_table
from aadm_workbench.report.words.labels import phrase
from tests.report.typed import of_column, typed

TEXT = "the scan of the sleeves is mirrored: its points fit the pattern only as in a mirror"
FINDING = {"code": "mirrored", "about": ["sleeves"], "values": {"group": "sleeves"}, "text": TEXT, "holds_back": True}


def test_labels_that_hang_on_a_declared_up_say_so_everywhere(floor: dict[str, Any], tmp_path: Path) -> None:
    column = floor["columns"][0]
    assert declared_up(of_column(column)) == "up = +y"
    for language, words in (("en", "as declared"), ("zh", "按任务指定")):
        write_html(typed(floor), tmp_path / "report.html", language)  # type: ignore[arg-type]
        page = (tmp_path / "report.html").read_text("utf-8")
        assert words in page
        assert "up = +y" in page
    rows = list(csv.reader(io.StringIO(csv_content(typed(floor), [of_column(column)]).decode("utf-8-sig"))))
    assert any(row[3:5] == ["as_declared", "up = +y"] for row in rows)
    assert any(row[-1] == "up = +y" for row in columns_table(typed(floor)).rows)
    write_bcf(typed(floor), tmp_path / "report.bcf")
    assert (tmp_path / "report.bcf").stat().st_size > 0


def test_the_crew_page_says_it_too(floor: dict[str, Any], tmp_path: Path) -> None:
    pytest.importorskip("reportlab")
    pypdf = pytest.importorskip("pypdf")
    from aadm_workbench.report.pages.crew_page import write_crew_pages

    write_crew_pages(typed(floor), tmp_path / "crew.pdf")
    pages = ["".join(page.extract_text().split()) for page in pypdf.PdfReader(tmp_path / "crew.pdf").pages]
    declared = [column for column in floor["columns"] if declared_up(of_column(column))]
    assert sum("asdeclared:up=+y" in page for page in pages) == len(declared) > 0


def test_ups_that_differ_are_both_named_and_a_pattern_with_an_opinion_needs_none(floor: dict[str, Any]) -> None:
    column = next(c for c in floor["columns"] if c["sleeves"] and c["rebars"])
    column["rebars"]["fit"]["declared_up"] = "-x"
    assert declared_up(of_column(column)) == "sleeves_up = +y, rebars_up = -x"
    for kind in ("sleeves", "rebars"):
        column[kind]["fit"]["declared_up"] = None
    assert declared_up(of_column(column)) is None


def test_findings_have_lines_of_their_own_in_the_table(floor: dict[str, Any]) -> None:
    column = floor["columns"][0]
    column["findings"] = [FINDING]
    rows = list(csv.reader(io.StringIO(csv_content(typed(floor), [of_column(column)]).decode("utf-8-sig"))))
    line = next(row for row in rows if row[3] == "finding mirrored")
    assert (line[4], line[-3], line[-1]) == ("sleeves", "holds back", TEXT)


def test_the_crew_is_told_what_to_settle_and_not_to_scan_closer(floor: dict[str, Any]) -> None:
    column = next(c for c in floor["columns"] if c["verdict"] == "pass" and c["goes_on"] == "pass")
    column |= {"verdict": "inconclusive", "goes_on": "inconclusive", "reasons": [TEXT], "findings": [FINDING]}
    hoist = hoist_of(of_column(column))
    assert (hoist.state, hoist.cause) == ("no", phrase("cause.contradicted"))
    steps = [step.text for step in crew_advice(typed(floor), of_column(column)).steps]
    assert [step.en for step in steps] == [TEXT]
    column["findings"] = [FINDING | {"holds_back": False}]
    assert hoist_of(of_column(column)).cause == phrase("cause.undecided")


def test_what_was_found_on_a_hoisting_frame_is_among_the_notes(floor: dict[str, Any]) -> None:
    column = floor["columns"][0]
    hanging = {"source": "a.tiff", "keys": [], "mean_mm": None, "max_mm": None, "column_tilt_deg": None, "pairs": []}
    column["hoisting"] = [hanging | {"correction": None, "verdict": "not_measured", "findings": [FINDING]}]
    assert TEXT in column_notes(of_column(column))
