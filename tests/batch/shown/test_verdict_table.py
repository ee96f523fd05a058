"""The table under a check: the worst column first, the point that decided, nothing out of line."""

import re
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from rich.cells import cell_len

from aadm_workbench.model import (
    ColumnReport,
    GroupReport,
    JobReport,
    PairResult,
    PointResult,
    Profile,
    SpacingResult,
    TrialPose,
    TrialReport,
    Verdict,
)
from batch.shown.terminal import show
from batch.shown.verdict_table import show_verdicts, summary_line, verdict_table, worst_comparison


def point(label: str, deviation_mm: float | None, verdict: Verdict, reason: str = "") -> PointResult:
    """A sleeve with a limit of 2 mm."""
    return PointResult(
        label, None, (0.0, 0.0, 0.0), None, None, None, None, None, deviation_mm, None, 2.0, verdict, reason
    )


def group(points: tuple[PointResult, ...], spacing: tuple[SpacingResult, ...] = ()) -> GroupReport:
    """Sleeves."""
    return GroupReport("a.ply", "", "refined", 12, 12, Verdict.PASS, points, spacing, None)


def pair(distance_mm: float, verdict: Verdict) -> TrialReport:
    """A trial with one pair and a limit of 3 mm."""
    only = PairResult("S7", "R7", (0.0, 0.0), distance_mm, None, 3.0, None, verdict)
    pose = TrialPose(None, distance_mm, distance_mm, 0.0, (only,))  # type: ignore[arg-type]
    return TrialReport(verdict, minimax=pose)


def job(*columns: ColumnReport) -> JobReport:
    """A report on some columns."""
    return JobReport({}, {}, {}, None, Profile("cn", "", ()), columns)


def lines(capsys: pytest.CaptureFixture[str], *columns: ColumnReport) -> list[str]:
    """The table as it is printed where nobody watches."""
    show(verdict_table(job(*columns)))
    return capsys.readouterr().out.splitlines()


PASSED = ColumnReport("C-1", Verdict.PASS, Verdict.PASS, sleeves=group((point("S3", 1.2, Verdict.PASS),)))
FAILED = ColumnReport(
    "预制柱",
    Verdict.FAIL,
    Verdict.NOT_ASSESSED,
    ("S1 is 2.10 mm off", "S2 is 2.41 mm off"),
    sleeves=group(
        (point("S1", 2.1, Verdict.FAIL, "S1 is 2.10 mm off"), point("S2", 2.41, Verdict.FAIL, "S2 is 2.41 mm off"))
    ),
)


def test_worst_first_and_in_line(capsys: pytest.CaptureFixture[str]) -> None:
    error = ColumnReport("C-9", Verdict.ERROR, Verdict.NOT_ASSESSED, ("[missing].ply: there is no such file",))
    heading, first, second, third = lines(capsys, PASSED, FAILED, error)
    assert first.split() == [
        "!",
        "error",
        "C-9",
        "not",
        "assessed",
        "[missing].ply:",
        "there",
        "is",
        "no",
        "such",
        "file",
    ]
    assert second.split(maxsplit=9) == [
        "✗", "fail", "预制柱", "S2", "2.41", "/", "2", "mm", "not", "assessed  S2 is 2.41 mm off (+1 more)"
    ]  # fmt: skip
    assert third.split() == ["✓", "pass", "C-1", "S3", "1.20", "/", "2", "mm", "✓", "pass"]
    for heading_of, text, line in [
        ("Goes on", "not assessed", second),
        ("Worst", "S2", second),
        ("Worst", "S3", third),
    ]:
        assert cell_len(line[: line.index(text)]) == heading.index(heading_of)


def test_rows_are_never_broken(capsys: pytest.CaptureFixture[str]) -> None:
    long = replace(FAILED, reasons=("x" * 500,))
    assert "x" * 500 in lines(capsys, long)[1]


def test_no_colour_where_nobody_watches(capsys: pytest.CaptureFixture[str]) -> None:
    assert not any("\x1b" in line for line in lines(capsys, PASSED, FAILED))


def test_colour_in_a_terminal(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    for name in ("NO_COLOR", "CI"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "60")
    printed = lines(capsys, PASSED, FAILED)
    assert any("\x1b[1;31m✗ fail" in line for line in printed)
    assert len(printed) > 4, "a long reason is folded"


def test_summary_line() -> None:
    assert summary_line(job(PASSED, FAILED)) == "2 columns: 1 pass, 1 fail"
    assert summary_line(job(replace(PASSED, verdict=Verdict.NOT_MEASURED))) == "1 column: 1 not measured"


SHORT = SpacingResult(("S1", "S2"), 160.0, 157.5, -2.5, None, (-2.0, 2.0), Verdict.FAIL)


@pytest.mark.parametrize(
    ("column", "words"),
    [
        (PASSED, ("S3", "1.20 / 2 mm")),
        (FAILED, ("S2", "2.41 / 2 mm")),
        (replace(FAILED, sleeves=group((point("S1", 2.1, Verdict.FAIL),), (SHORT,))), ("S1-S2", "-2.50 / -2 mm")),
        (replace(FAILED, trial_assembly=pair(3.9, Verdict.FAIL)), ("S7/R7", "3.90 / 3 mm")),
        # A bar may fail in a check that the job did not ask for: the column passed by the others.
        (replace(PASSED, rebars=group((point("R1", 9.0, Verdict.FAIL),))), ("S3", "1.20 / 2 mm")),
        (
            replace(
                PASSED,
                verdict=Verdict.NOT_MEASURED,
                sleeves=group((point("S3", 1.2, Verdict.PASS), point("S7", None, Verdict.NOT_MEASURED))),
            ),
            ("S7", ""),
        ),
        # A collision fails the trial while every distance is within its limit.
        (replace(PASSED, verdict=Verdict.FAIL, trial_assembly=pair(2.7, Verdict.PASS)), ("S7/R7", "2.70 / 3 mm")),
    ],
)
def test_the_comparison_that_decided(column: ColumnReport, words: tuple[str, str]) -> None:
    comparison = worst_comparison(column)
    assert comparison is not None
    assert (comparison.point, comparison.in_words()) == words


def test_nothing_was_compared() -> None:
    assert worst_comparison(ColumnReport("C-1", Verdict.ERROR, Verdict.NOT_ASSESSED)) is None


def test_everything_is_told_in_chinese(capsys: pytest.CaptureFixture[str]) -> None:
    """Headings, verdicts, reasons and counts; names and numbers stay."""
    failed = replace(FAILED, reasons=("S2 not measured: no opening: the mouth is plugged or covered",))
    report = job(PASSED, failed)
    show(verdict_table(report, "zh"), summary_line(report, "zh"))
    said = capsys.readouterr().out
    assert not re.search("[A-Za-z]{2,}", said.replace("mm", ""))
    for word in ("结论", "不合格", "合格", "未评定", "S2 未测得：没有开口", "2 根柱：1 根合格，1 根不合格"):
        assert word in said


def test_what_has_a_sign_is_shown_with_it(capsys: pytest.CaptureFixture[str]) -> None:
    spacing = SpacingResult(("S1", "S2"), 80.0, 82.5, 2.5, None, (-2.0, 2.0), Verdict.FAIL)
    column = ColumnReport("C-1", Verdict.FAIL, Verdict.PASS, ("too far",), sleeves=group((), (spacing,)))
    assert "+2.50 / 2 mm" in lines(capsys, column)[1]


def test_no_report_is_named_that_was_not_written(capsys: pytest.CaptureFixture[str]) -> None:
    report = job()
    show_verdicts(report, Path("out") / "report.json")
    assert f"Report: {Path('out') / 'report.json'}" in capsys.readouterr().out
    show_verdicts(report, None)
    assert "Report:" not in capsys.readouterr().out
