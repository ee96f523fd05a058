"""A check that ended before its end goes on, and its report is that of a check that nothing happened to."""

import json
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.errors import AadmError
from aadm_workbench.inspection import column
from aadm_workbench.inspection.tasks import ColumnTask
from batch.job import inputs
from batch.main import main
from batch.runner import record
from batch.runner.journal import Journal

from .conftest import WriteJob, column_text
from .runner.test_run import raising

NAMES = [f"C-{number}" for number in range(6)]


@pytest.fixture
def job(write_job: WriteJob, tmp_path: Path) -> Path:
    """A job of six columns with scans of their own, one of which is missing."""
    columns = [column_text(name, f"{name}.ply", "4mm.ply" if name == "C-1" else "bars.ply") for name in NAMES]
    path = write_job(*columns, clouds=(*(f"{name}.ply" for name in NAMES), "bars.ply", "4mm.ply"))
    (tmp_path / "C-4.ply").unlink()
    return path


def check(job: Path, out: str, *arguments: str) -> int:
    """Run the command."""
    return main(["check", str(job), "--out", str(job.parent / out), "--quiet", *arguments])


def content(job: Path, out: str) -> bytes:
    """The bytes of a report."""
    return (job.parent / out / "report.json").read_bytes()


def counted(
    monkeypatch: pytest.MonkeyPatch, ends_at: str | None = None, error: BaseException | None = None
) -> list[str]:
    """Columns as they are checked; at one of them something happens."""
    seen: list[str] = []
    real = record.inspect_column

    def inspect_column(task: ColumnTask) -> column.ColumnOutcome:
        if task.column.id == ends_at and error is not None:
            raise error
        seen.append(task.column.id)
        return real(task)

    monkeypatch.setattr(record, "inspect_column", inspect_column)
    return seen


@pytest.mark.usefixtures("exact_extraction")
def test_interrupted_and_resumed(
    job: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert check(job, "calm") == 12
    with monkeypatch.context() as patch:
        counted(patch, "C-3", KeyboardInterrupt())
        assert check(job, "out") == 130
    said = capsys.readouterr().err.splitlines()
    assert said[-2] == "aadm: interrupted"
    assert said[-1].startswith("aadm: 3 of 6 columns are kept in ")
    assert said[-1].endswith("journal.jsonl; repeat the command with --resume")
    assert not (job.parent / "out" / "report.json").exists()
    with monkeypatch.context() as patch:
        seen = counted(patch)
        assert check(job, "out", "--resume", "--events", str(job.parent / "events")) == 12
    assert seen == ["C-3", "C-4", "C-5"]
    assert content(job, "out") == content(job, "calm")
    events = [json.loads(line) for line in (job.parent / "events").read_text("utf-8").splitlines()]
    assert [event["kept"] for event in events if event["event"] == "column"] == [True] * 3 + [False] * 3
    assert events[-1]["event"] == "finished"
    assert events[-1]["exit_code"] == 12
    times = json.loads((job.parent / "out" / "timing.json").read_text("utf-8"))
    assert list(times["columns"]) == NAMES


@pytest.mark.usefixtures("exact_extraction")
def test_what_has_changed_is_checked_again(job: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    check(job, "out")
    (tmp_path / "C-2.ply").write_bytes((tmp_path / "C-3.ply").read_bytes() + b"\n")
    (tmp_path / "C-4.ply").write_bytes((tmp_path / "C-3.ply").read_bytes())
    (tmp_path / "C-5.ply").unlink()
    # A column more, and another profile for none of them.
    job.write_text(job.read_text("utf-8") + column_text("C-6", "C-3.ply"), "utf-8")
    seen = counted(monkeypatch)
    check(job, "out", "--resume")
    assert seen == ["C-2", "C-4", "C-5", "C-6"]
    check(job, "anew")
    assert content(job, "out") == content(job, "anew")
    seen.clear()
    job.write_text(job.read_text("utf-8").replace('units = "mm"', 'units = "mm"\nturns = true'), "utf-8")
    check(job, "out", "--resume")
    assert seen == [*NAMES, "C-6"]


@pytest.mark.usefixtures("exact_extraction")
def test_another_version_checks_everything_again(job: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    check(job, "out")
    monkeypatch.setattr("batch.runner.run.program_key", lambda: "another")
    seen = counted(monkeypatch)
    check(job, "out", "--resume")
    assert seen == NAMES


@pytest.mark.usefixtures("exact_extraction")
def test_a_disk_that_is_full_ends_it(
    job: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    check(job, "calm")
    with monkeypatch.context() as patch:
        real = Journal.add

        def add(journal: Journal, record: Any) -> None:
            if record.id == "C-2":
                raise AadmError("journal.jsonl: the results so far cannot be kept (No space left on device)")
            real(journal, record)

        patch.setattr(Journal, "add", add)
        assert check(job, "out") == 70
    assert "No space left on device" in capsys.readouterr().err
    assert check(job, "out", "--resume") == 12
    assert content(job, "out") == content(job, "calm")


@pytest.mark.usefixtures("exact_extraction")
def test_bad_usage_checks_nothing(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert check(job, "out", "--events", "-", "--json") == 2
    assert "both want stdout" in capsys.readouterr().err
    assert check(job, "out", "--events", str(job / "nowhere")) == 2
    for words in (["--jobs", "2", "--scheduler", "tcp://h:1"], ["--time-limit", "5"], ["--memory-limit", "1MB"]):
        with pytest.raises(SystemExit, match="2"):
            check(job, "out", *words)


def test_what_killed_the_check_itself_is_given_up_by_the_next(job: Path, repository: Path) -> None:
    """A native crash in a job of a few columns takes the check with it; the next one takes no such risk."""
    pytest.importorskip("distributed")
    script = f"""
import os, sys
from batch.runner import record
from batch.main import main
real = record.inspect_column
def inspect_column(task):
    if task.column.id == "C-1":
        os.kill(os.getpid(), 9)
    return real(task)
record.inspect_column = inspect_column
main(["check", {str(job)!r}, "--out", {str(job.parent / "out")!r}, "--only", "C-0", "C-1", "C-4", "--quiet"])
"""
    killed = subprocess.run([sys.executable, "-c", script], cwd=repository, check=False)
    assert killed.returncode == -9
    assert Journal(job.parent / "out", resume=True).interrupted == {"C-1"}
    only = ["--only", "C-0", "C-1", "C-4"]
    assert check(job, "out", "--resume", *only) == check(job, "calm", *only)
    assert content(job, "out") == content(job, "calm")
    log = (job.parent / "out" / "workers.log").read_text("utf-8")
    assert " is ready" in log


def test_an_unforeseen_error_is_never_kept(job: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(column, "check_column", raising(ValueError("singular")))
    check(job, "out")
    seen = counted(monkeypatch)
    check(job, "out", "--resume")
    assert seen == NAMES


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_it_cleanly(job: Path, repository: Path, number: signal.Signals) -> None:
    """With workers of its own, while they work: nothing is left behind, and the rest is done later."""
    pytest.importorskip("distributed")
    only = ["--only", "C-0", "C-1", "C-2"]
    check(job, "calm", *only)
    words = ["check", str(job), "--out", str(job.parent / "out"), "--jobs", "2", *only]
    command = [sys.executable, "-m", "batch", *words]
    process = subprocess.Popen(command, cwd=repository, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    first = process.stderr.readline()
    assert first.startswith("1/3 ")
    children = [int(pid) for pid in _children(process.pid)]
    process.send_signal(number)
    _, said = process.communicate(timeout=120)
    if process.returncode == 130:
        assert "interrupted" in said
        assert "repeat the command with --resume" in said
    else:
        # It was over before the signal came.
        assert process.returncode in (10, 11)
    assert not any(Path(f"/proc/{pid}").exists() for pid in children)
    assert sorted(path.name for path in (job.parent / "out").iterdir() if path.name.startswith(".aadm-w")) == []
    check(job, "out", "--resume", *only)
    assert content(job, "out") == content(job, "calm")


def _children(pid: int) -> list[str]:
    path = Path(f"/proc/{pid}/task/{pid}/children")
    return path.read_text().split() if path.exists() else []


def test_a_read_only_folder(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    if not hasattr(os, "geteuid") or os.geteuid() == 0:
        pytest.skip("root may write everywhere")
    (job.parent / "out").mkdir(mode=0o500)
    assert check(job, "out") == 2
    assert "nothing can be written there" in capsys.readouterr().err


def untouched(monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Files that are read to be compared; what was written a moment ago counts as old."""
    monkeypatch.setattr(inputs, "_TICK_NS", 0)
    seen: list[Path] = []
    real = inputs.content_hash

    def content_hash(path: Path) -> str:
        seen.append(path)
        return real(path)

    monkeypatch.setattr(inputs, "content_hash", content_hash)
    return seen


@pytest.mark.usefixtures("exact_extraction")
def test_files_that_look_as_they_did_are_not_read(job: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    only = ["--only", "C-0", "C-2", "C-3"]
    seen = untouched(monkeypatch)
    code = check(job, "out", *only)
    report, before = content(job, "out"), (tmp_path / "out" / "report.json").stat()
    seen.clear()
    checked = counted(monkeypatch)
    assert check(job, "out", "--resume", *only) == code
    assert (seen, checked) == ([], [])
    # Nothing has changed, so the report stands as it was written.
    assert (tmp_path / "out" / "report.json").stat().st_mtime_ns == before.st_mtime_ns
    check(job, "out", "--resume", "--verify", *only)
    assert {path.name for path in seen} >= {"C-0.ply", "C-2.ply", "C-3.ply"}
    assert (checked, content(job, "out")) == ([], report)


@pytest.mark.usefixtures("exact_extraction")
def test_a_file_that_was_falsified_is_noticed(job: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Of the same size, and the time of its last change set back."""
    untouched(monkeypatch)
    check(job, "out")
    scan = tmp_path / "C-2.ply"
    status, content_before = scan.stat(), scan.read_bytes()
    scan.write_bytes(content_before[:-4] + bytes([content_before[-4] ^ 1]) + content_before[-3:])
    os.utime(scan, ns=(status.st_atime_ns, status.st_mtime_ns))
    checked = counted(monkeypatch)
    check(job, "out", "--resume")
    assert "C-2" in checked
    checked.clear()
    # Below the file system even the system's own time can be set back: then --verify tells.
    as_before = Journal(tmp_path / "out", resume=True).seen("C-2")
    scan.write_bytes(content_before)
    real = inputs.looks
    blind = lambda task, order: replace(real(task, order), hash=as_before)  # noqa: E731
    monkeypatch.setattr(
        "batch.runner.run.looks", lambda task, order: (blind if task.column.id == "C-2" else real)(task, order)
    )
    check(job, "out", "--resume")
    assert "C-2" not in checked
    check(job, "out", "--resume", "--verify")
    assert "C-2" in checked


@pytest.mark.usefixtures("exact_extraction")
def test_a_file_that_changes_while_it_is_read_is_read_again(
    job: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    untouched(monkeypatch)
    real = record.inspect_column

    def inspect_column(task: ColumnTask) -> column.ColumnOutcome:
        found = real(task)
        if task.column.id == "C-2":
            (tmp_path / "C-2.ply").write_bytes((tmp_path / "C-3.ply").read_bytes() + b"\n")
        return found

    with monkeypatch.context() as patch:
        patch.setattr(record, "inspect_column", inspect_column)
        check(job, "out")
    checked = counted(monkeypatch)
    check(job, "out", "--resume")
    assert "C-2" in checked
    assert "C-3" not in checked


@pytest.mark.usefixtures("exact_extraction")
@pytest.mark.parametrize("harm", ["changed", "missing", "other limits", "other columns"])
def test_a_report_that_no_longer_holds_is_written_again(
    job: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, harm: str
) -> None:
    only = ["--only", "C-0", "C-2"]
    untouched(monkeypatch)
    check(job, "out", *only)
    report = tmp_path / "out" / "report.json"
    if harm == "changed":
        report.write_bytes(report.read_bytes().replace(b'"pass"', b'"fail"'))
    elif harm == "missing":
        report.unlink()
    elif harm == "other limits":
        job.write_text(job.read_text("utf-8") + "\n[capture]\noperator = 'Li'\n", "utf-8")
    else:
        only = ["--only", "C-2", "C-3"]
    check(job, "out", "--resume", *only)
    check(job, "anew", *only)
    assert content(job, "out") == content(job, "anew")
