"""What findings do to reports: same scans twice, verdicts held back, sentences in both languages."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import pytest

from aadm_workbench.assembly.findings.finding import held_back, make_finding, with_same_scans
from aadm_workbench.model import ColumnReport, GroupReport, Kind, TrialReport, Verdict
from aadm_workbench.model.sentences.finding import SENTENCES
from aadm_workbench.report.words.reasons import in_both_languages

CHINESE = re.compile(r"[\u4e00-\u9fff]")


def passing(name_of: str, foot: str = "a", bars: str = "b") -> ColumnReport:
    groups = [
        GroupReport(f"{name}.ply", name and f"{name:0<64}", "refined", 12, 12, Verdict.PASS, (), (), None)
        for kind, name in ((Kind.SLEEVE, foot), (Kind.REBAR, bars))
    ]
    trial = TrialReport(Verdict.PASS)
    return ColumnReport(name_of, Verdict.PASS, Verdict.PASS, sleeves=groups[0], rebars=groups[1], trial_assembly=trial)


def test_one_file_for_two_columns_holds_both_back_and_nobody_else() -> None:
    first, second, third = with_same_scans(
        [passing("C-1", "a", "b"), passing("C-2", "c", "b"), passing("C-3", "d", "e")]
    )
    assert (first.verdict, second.verdict, third.verdict) == ("inconclusive", "inconclusive", "pass")
    assert (first.goes_on, third.goes_on) == ("inconclusive", "pass")
    assert first.trial_assembly is not None
    assert first.trial_assembly.verdict is Verdict.INCONCLUSIVE
    assert "the same file as that of C-2" in first.reasons[0]
    assert ([finding.code for finding in second.findings], third.findings) == (["same_scan_twice"], ())


def test_one_file_for_the_foot_and_for_the_bars_of_a_column_holds_it_back() -> None:
    (report,) = with_same_scans([passing("C-1", "a", "a")])
    assert (report.verdict, report.findings[0].about) == ("inconclusive", ("sleeves", "rebars"))


def test_scans_that_never_were_a_file_are_not_compared() -> None:
    assert with_same_scans([passing("C-1", "", ""), passing("C-2", "", "")])[0].findings == ()


def test_what_was_not_scanned_is_not_measured_and_a_failure_stays_one() -> None:
    swapped = make_finding("swapped", ["sleeves", "rebars"])
    thick = make_finding("diameter_differs.others", ["rebars"], design_mm=20.0, measured_mm=24.0, seems="25 mm")
    assert held_back(passing("C-1"), [swapped]).verdict is Verdict.NOT_MEASURED
    assert held_back(passing("C-1"), [thick]).verdict is Verdict.INCONCLUSIVE
    failed = replace(passing("C-1"), verdict=Verdict.FAIL, reasons=("R5 is 4.00 mm from design",))
    held = held_back(failed, [thick])
    assert (held.verdict, held.reasons[0]) == (Verdict.FAIL, "R5 is 4.00 mm from design")
    assert thick.text in held.reasons
    told = replace(thick, holds_back=False)
    noted = held_back(passing("C-1"), [told])
    assert (noted.verdict, noted.notes, noted.findings) == (Verdict.PASS, (told.text,), (told,))


@pytest.mark.parametrize("name", [code.removeprefix("finding.") for code in SENTENCES])
def test_every_sentence_is_told_in_chinese_with_all_its_numbers(name: str) -> None:
    english, chinese = SENTENCES[f"finding.{name}"]
    places = sorted(re.findall(r"{(\w+)", english))
    assert set(places) == set(re.findall(r"{(\w+)", chinese))
    values: dict[str, Any] = {
        place: 1.25 if re.search(rf"{{{place}:[^}}]*[fg]}}", english) else f"{place} 7" for place in places
    }
    values.pop("about", None)
    finding = make_finding(name, ["S3", "S11"], **values)
    told = in_both_languages(f"before; {finding.text}; after" if english[-1] != "}" else f"before; {finding.text}")
    assert CHINESE.search(told.zh)
    assert finding.text not in told.zh
    numbers = r"\d+(?:\.\d+)?|S\d+"
    assert sorted(set(re.findall(numbers, told.zh))) == sorted(set(re.findall(numbers, finding.text)))


def test_groups_are_named_in_chinese() -> None:
    told = in_both_languages(make_finding("mirrored", ["sleeves"], group="sleeves").text).zh
    assert "套筒" in told
    assert "sleeves" not in told
