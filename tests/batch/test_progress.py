"""How far a check has come: a bar for people, lines for logs, nothing on request."""

import sys

import pytest

from aadm_workbench.model import ColumnReport, Verdict
from batch.progress import ColumnProgress

COLUMN = ColumnReport("[柱]-1", Verdict.NOT_MEASURED, Verdict.NOT_ASSESSED)


def watched(*, quiet: bool = False) -> None:
    """One column of two is finished."""
    with ColumnProgress(quiet=quiet) as progress:
        progress.start(2)(COLUMN)


def test_a_line_for_each_column(capsys: pytest.CaptureFixture[str]) -> None:
    watched()
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ("", "1/2 [柱]-1: not measured\n")


def test_quiet(capsys: pytest.CaptureFixture[str]) -> None:
    watched(quiet=True)
    captured = capsys.readouterr()
    assert captured.out == captured.err == ""


def test_a_bar_where_a_person_watches(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "120")
    watched()
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "[柱]-1: not measured" in captured.err
    assert "━" in captured.err
