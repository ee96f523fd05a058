"""How far a check has come: a bar for people, lines for logs, events for programs, nothing on request."""

import json
import sys
from pathlib import Path

import pytest

from aadm_workbench.errors import JobError
from aadm_workbench.inspection.column import ColumnOutcome
from aadm_workbench.model import ColumnReport, Verdict
from batch.runner.engine import Death
from batch.runner.record import Record
from batch.shown.progress import Events, ShownCheck


def record(name: str, verdict: Verdict) -> Record:
    """The result of a column."""
    return Record.of(ColumnOutcome(ColumnReport(name, verdict, Verdict.NOT_ASSESSED), {"total": 0.5}), "k")


def watched(*, quiet: bool = False, events: str | None = None) -> None:
    """Three columns of four are finished; one lost its process."""
    stream = Events(events)
    with ShownCheck(stream, quiet=quiet) as shown:
        shown.started(4)
        shown.column(record("[柱]-1", Verdict.NOT_MEASURED), kept=False)
        shown.column(record("C-2", Verdict.FAIL), kept=True)
        shown.lost("C-3", Death("killed by signal 9 (SIGKILL)", "its last words"), tries_left=2)
        shown.message("the worker w gets no work")
        shown.column(record("C-3", Verdict.ERROR), kept=False)
    stream.close()


def test_a_line_for_each_column(capsys: pytest.CaptureFixture[str]) -> None:
    watched()
    captured = capsys.readouterr()
    lines = captured.err.splitlines()
    assert captured.out == ""
    assert lines[0].startswith("1/4 [柱]-1: not measured (")
    assert lines[0].endswith(" left)")
    assert lines[1].startswith("2/4 C-2: fail (kept) [1 failed so far] (")
    assert lines[2:4] == [
        "C-3: the process that checked it was killed by signal 9 (SIGKILL); it is tried again later",
        "the worker w gets no work",
    ]
    assert lines[4].startswith("3/4 C-3: error [1 failed, 1 error so far] (")


def test_quiet(capsys: pytest.CaptureFixture[str]) -> None:
    watched(quiet=True)
    captured = capsys.readouterr()
    assert captured.out == captured.err == ""


def test_a_bar_where_a_person_watches(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "160")
    watched()
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "C-3: error [1 failed, 1 error so far]" in captured.err
    assert "━" in captured.err
    assert "it is tried again later" in captured.err


def test_events_in_a_file(tmp_path: Path) -> None:
    path = tmp_path / "events.jsonl"
    watched(quiet=True, events=str(path))
    events = [json.loads(line) for line in path.read_text("utf-8").splitlines()]
    assert [event["event"] for event in events] == ["started", "column", "column", "lost", "message", "column"]
    assert events[0]["columns"] == 4
    column = events[2]
    assert (column["id"], column["verdict"], column["kept"], column["seconds"]) == ("C-2", "fail", True, 0.5)
    assert (column["done"], column["columns"]) == (2, 4)
    assert column["so_far"] == {"not_measured": 1, "fail": 1}
    assert column["per_second"] > 0.0
    assert column["seconds_left"] >= 0.0
    assert events[3]["cause"] == "killed by signal 9 (SIGKILL)"
    assert events[3]["tries_left"] == 2


def test_events_on_stdout(capsys: pytest.CaptureFixture[str]) -> None:
    watched(quiet=True, events="-")
    lines = capsys.readouterr().out.splitlines()
    assert len([json.loads(line) for line in lines]) == 6


def test_events_that_nobody_reads_any_more(tmp_path: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("this system has no device that is always full")
    watched(quiet=True, events="/dev/full")


def test_events_nowhere(tmp_path: Path) -> None:
    with pytest.raises(JobError, match="events cannot be written there"):
        Events(str(tmp_path / "nowhere" / "events"))
