"""Folders that somebody else has prepared: a check writes into its own and nowhere else, and waits for nobody."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.errors import AadmError, ReportError
from aadm_workbench.report.bcf.topics import write_bcf
from aadm_workbench.report.read import read_report
from batch.main import main
from batch.report_files import FORMATS, write_reports
from batch.runner.journal import Journal
from batch.runner.packed import pack
from batch.runner.record import read_record
from batch.runner.run import _column
from tests.report.checked_floor import CASES, floor_report
from tests.report.typed import typed

from .test_pipeline import column
from .test_texts import write_job

OF_A_CHECK = (
    ".aadm-lock",
    ".aadm-workers",
    "journal.jsonl",
    "journal.previous.jsonl",
    "report.json",
    "timing.json",
    "workers.log",
)
OF_REPORTS = tuple(file for name, (file, _) in FORMATS.items() if name != "fcstd")


@pytest.fixture
def job(tmp_path: Path) -> Path:
    """A job of two columns without scans, and the folder of its reports."""
    (tmp_path / "job-report").mkdir()
    return write_job(tmp_path, "schema = 1\n" + column("C-1", sleeves="none.ply") + column("C-2", sleeves="none.ply"))


def snapshot(folder: Path) -> dict[str, bytes]:
    return {entry.name: entry.read_bytes() for entry in folder.iterdir()}


@pytest.mark.parametrize("kind", ["symbolic", "hard", "to a folder", "to nothing"])
def test_no_file_of_a_check_is_written_through_a_link(job: Path, kind: str) -> None:
    """Each file of a check, with all its reports, and with workers."""
    precious = job.parent / "precious"
    precious.mkdir()
    for name in (*OF_A_CHECK, *OF_REPORTS):
        target, link = precious / f"mine-{name}", job.parent / "job-report" / name
        if kind == "hard" and name.endswith(".bcf"):
            continue  # a file of an earlier report, which is gone on with
        if kind != "to nothing":
            target.write_bytes(b"precious")
        if kind == "hard":
            link.hardlink_to(target)
        else:
            link.symlink_to(precious if kind == "to a folder" else target)
    before = snapshot(precious)
    switches = [f"--{name.replace('_', '-')}" for name in FORMATS if name != "fcstd"]
    jobs = ["--jobs", "2"] if kind in ("symbolic", "to a folder") else []
    assert main(["check", str(job), "--quiet", *switches, *jobs]) == 12
    assert snapshot(precious) == before
    not_written = {".aadm-workers", "journal.previous.jsonl"} | (set() if jobs else {"workers.log"})
    for name in {*OF_A_CHECK, *OF_REPORTS} - not_written:
        path = job.parent / "job-report" / name
        assert path.is_file()
        assert not path.is_symlink()
        assert path.stat().st_nlink == 1


def test_a_journal_that_is_a_link_is_not_resumed(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other = job.parent / "other.jsonl"
    other.write_bytes(b'{"aadm_journal":2}\n{"began":"C-1"}\n')
    (job.parent / "job-report" / "journal.jsonl").symlink_to(other)
    assert main(["check", str(job), "--quiet", "--resume"]) == 2
    assert "journal.jsonl: results cannot be kept there: it is a link, which is not followed" in capsys.readouterr().err
    assert other.read_bytes() == b'{"aadm_journal":2}\n{"began":"C-1"}\n'


def test_a_journal_with_a_second_name_is_resumed_and_the_other_stays(job: Path) -> None:
    """Backups by hard links: what they hold must not change afterwards."""
    assert main(["check", str(job), "--quiet"]) == 12
    journal, backup = job.parent / "job-report" / "journal.jsonl", job.parent / "backup.jsonl"
    backup.hardlink_to(journal)
    kept = backup.read_bytes()
    assert main(["check", str(job), "--quiet", "--resume"]) == 12
    assert backup.read_bytes() == kept
    assert journal.read_bytes().startswith(kept)
    assert len(journal.read_bytes()) > len(kept)


@pytest.mark.parametrize("name", [".aadm-lock", "journal.jsonl"])
def test_a_pipe_is_refused_at_once(job: Path, repository: Path, name: str) -> None:
    os.mkfifo(job.parent / "job-report" / name)
    command = [sys.executable, "-m", "batch", "check", str(job), "--quiet"]
    done = subprocess.run(command, cwd=repository, timeout=60, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert f"{name}" in done.stderr
    assert "it is a pipe, not a file; remove it" in done.stderr


def test_pipes_in_place_of_other_files_hold_nothing_up(job: Path, repository: Path) -> None:
    for name in ("workers.log", "report.json", "timing.json", "report.bcf", ".aadm-workers", ".aadm-freecad-1"):
        os.mkfifo(job.parent / "job-report" / name)
    command = [sys.executable, "-m", "batch", "check", str(job), "--quiet", "--jobs", "2", "--bcf"]
    done = subprocess.run(command, cwd=repository, timeout=60, capture_output=True, check=False)
    assert done.returncode == 12
    assert json.loads((job.parent / "job-report" / "report.json").read_text("utf-8"))["columns"]


def test_what_a_killed_check_left_is_cleared(job: Path) -> None:
    folder = job.parent / "job-report"
    left = [folder / f".report.json.{'a' * 32}.part", folder / ".aadm-workers"]
    left[0].write_bytes(b"half")
    left[1].mkdir()
    (left[1] / "worker-1.log").write_bytes(b"old")
    assert main(["check", str(job), "--quiet", "--jobs", "2"]) == 12
    assert not any(path.exists() for path in left)


FIRST = b'{"aadm_journal":2}\n'


def forged(values: dict[str, Any], report: str) -> bytes:
    """A line of a journal, its checksum right: anybody can calculate it."""
    content = (json.dumps(values)[:-1] + ',"report":' + report).encode()
    return content + f',"crc32":"{zlib.crc32(content):08x}"}}\n'.encode()


SOUND = {"id": "C-1", "key": "k", "verdict": "pass", "goes_on": "pass", "seconds": {}, "where": ""}
DEEP = "[" * 200_000 + "]" * 200_000
JOURNALS: dict[str, bytes] = {
    "nested": FIRST + DEEP.encode() + b"\n",
    "began nested": FIRST + b'{"began":' + DEEP.encode() + b"}\n",
    "head nested": FIRST + forged(SOUND | {"seconds": "x"}, "{}").replace(b'"x"', DEEP.encode()),
    "id of a wrong kind": FIRST + forged(SOUND | {"id": ["C-1"]}, "{}"),
    "seconds of a wrong kind": FIRST + forged(SOUND | {"seconds": [1]}, "{}"),
    "other keys": FIRST + forged(SOUND | {"more": 1}, "{}"),
    "report that is not packed": FIRST + forged(SOUND, "{}"),
    "only zeros": bytes(100_000),
    "no line break": FIRST + b"x" * 100_000,
    "not UTF-8": FIRST + b'{"began":"\xff\xfe"}\n',
}


@pytest.mark.parametrize("name", JOURNALS)
def test_journals_of_others_are_worth_nothing_but_harm_nobody(job: Path, name: str) -> None:
    (job.parent / "job-report" / "journal.jsonl").write_bytes(JOURNALS[name])
    assert main(["check", str(job), "--quiet", "--resume"]) == 12
    report = json.loads((job.parent / "job-report" / "report.json").read_text("utf-8"))
    assert [column["verdict"] for column in report["columns"]] == ["error", "error"]


def test_a_result_that_makes_no_sense_is_said() -> None:
    """The checksum and the key are right, the report is none: who can forge that could forge a verdict."""
    for report, said in ((pack(DEEP), "ColumnReport"), (pack("{}"), "ColumnReport"), ("nothing packed", ".")):
        record = read_record(forged(SOUND, json.dumps(report)))
        assert record is not None
        with pytest.raises(ValueError, match=said):
            record.column()
        with pytest.raises(AadmError, match=r"C-1: its kept result cannot be used .+ check again without --resume"):
            _column(record)


def test_a_journal_of_too_many_lines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batch.runner.journal.MOST_LINES", 1000)
    (tmp_path / "journal.jsonl").write_bytes(FIRST + b'{"began":"C-1"}\n' * 1001)
    with pytest.raises(AadmError, match="has more than 1000 lines, which no check writes; check without --resume"):
        Journal(tmp_path, resume=True)


def archive(**entries: bytes) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as written:
        for name, held in entries.items():
            written.writestr(name, held)
    return content.getvalue()


def zeros(size: int) -> bytes:
    """An archive with one entry of so many zeros, without ever holding them."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as written:
        written.writestr("bcf.version", b'<Version VersionId="2.1"/>')
        with written.open("zeros.png", "w") as stream:
            for _ in range(size // 2**22):
                stream.write(bytes(2**22))
    return content.getvalue()


VERSION = b'<Version VersionId="2.1"/>'
BCF: dict[str, Callable[[str], bytes]] = {
    "zeros": lambda guid: zeros(2**27),
    "many entries": lambda guid: archive(**{f"e{k}": b"" for k in range(20_001)}),
    "leads out": lambda guid: archive(**{"bcf.version": VERSION, "../../evil": b"x"}),
    "deep": lambda guid: archive(**{"bcf.version": VERSION, f"{guid}/markup.bcf": b"<a>" * 50_000 + b"</a>" * 50_000}),
    "entities": lambda guid: archive(
        **{"bcf.version": b"<!DOCTYPE a [<!ENTITY x 'y'>]><Version VersionId='2.1'>&x;</Version>"}
    ),
    "many elements": lambda guid: archive(
        **{"bcf.version": VERSION, f"{guid}/markup.bcf": b"<Markup>" + b"<a/>" * 200_000 + b"</Markup>"}
    ),
    "no markup": lambda guid: archive(**{"bcf.version": VERSION, f"{guid}/markup.bcf": b"<a/>"}),
    "no archive": lambda guid: b"PK\x03\x04 nothing",
}


@pytest.fixture(scope="module")
def floor() -> dict[str, Any]:
    return floor_report(*CASES)


@pytest.mark.parametrize("name", BCF)
def test_bcf_files_that_mean_harm_are_refused_and_stay(floor: dict[str, Any], tmp_path: Path, name: str) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(floor), path)
    with zipfile.ZipFile(path) as written:
        guid = next(entry.partition("/")[0] for entry in written.namelist() if entry.endswith("markup.bcf"))
    path.write_bytes(content := BCF[name](guid))
    with pytest.raises(ReportError, match=r"start (without it|a new)"):
        write_bcf(typed(floor), path, existing=path)
    assert path.read_bytes() == content


LONG = {"latin": "x" * 4000, "words": "a bar " * 700, "chinese": "柱" * 4000, "lines": "a\n" * 2000}


@pytest.mark.parametrize("sign", LONG)
def test_texts_of_any_length_never_keep_a_report_from_being_made(
    floor: dict[str, Any], tmp_path: Path, sign: str
) -> None:
    """Every text that may be anything is four thousand signs long; ids as long as they may be."""
    report = json.loads(json.dumps(floor | {"columns": floor["columns"][1:3]}))
    for number, entry in enumerate(report["columns"]):
        entry["id"] = f"{number}{LONG[sign]}"[:1024]
        entry["storey"] = entry["grid"] = entry["piece_mark"] = LONG[sign]
        entry["reasons"] = [LONG[sign]] * 2
        for kind in ("sleeves", "rebars"):
            for point in (entry[kind] or {}).get("points", ()):
                point["reason"] = LONG[sign] if point["reason"] is not None else None
            if entry[kind]:
                entry[kind]["source"] = LONG[sign]
    report["job"]["name"] = report["model"]["source"] = LONG[sign]
    report["capture"]["operator"] = LONG[sign]
    (tmp_path / "report.json").write_text(json.dumps(report), encoding="utf-8")
    formats = [name for name in FORMATS if name != "fcstd"]
    written = write_reports(read_report(tmp_path / "report.json"), formats, tmp_path)
    assert written.failed == {}
    for path in written.files.values():
        assert path.stat().st_size


def test_an_id_that_is_too_long(tmp_path: Path, floor: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    job = write_job(tmp_path, "schema = 1\n" + column("x" * 1025, sleeves="none.ply"))
    assert main(["check", str(job), "--quiet"]) == 2
    assert "the id has 1025 characters, 1024 are the most" in capsys.readouterr().err
    job = write_job(tmp_path, "schema = 1\n" + column("x" * 1024, sleeves="none.ply"))
    assert main(["check", str(job), "--quiet"]) == 12
    report = json.loads(json.dumps(floor))
    report["columns"][0]["id"] = "x" * 1025
    (tmp_path / "report.json").write_text(json.dumps(report), encoding="utf-8")
    assert main(["report", str(tmp_path / "report.json"), "--csv"]) == 2
    assert "columns.0.id is not what a report holds" in capsys.readouterr().err
