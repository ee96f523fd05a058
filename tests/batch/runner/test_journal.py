"""The journal: nothing that it took is lost, whatever is cut off, damaged or full."""

import errno
import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import AadmError
from aadm_workbench.inspection.column import ColumnOutcome
from aadm_workbench.model import ColumnReport, GroupReport, PointResult, Verdict
from batch.runner.journal import PREVIOUS_NAME, Journal
from batch.runner.packed import unpack
from batch.runner.record import Record, read_record


def record(name: str, verdict: Verdict = Verdict.PASS, key: str = "k") -> Record:
    """A result that holds some of everything."""
    report = ColumnReport(
        name,
        verdict,
        Verdict.NOT_ASSESSED,
        ('"crc32":"', "层", "}\n{"),
        T_model_column=np.eye(4) / 3.0,
        size_mm=(0.1, 600),
    )
    return Record.of(ColumnOutcome(report, {"total": 0.25}, "trace\nof it"), key)


def written(folder: Path, *names: str) -> Path:
    """A journal that holds some columns."""
    journal = Journal(folder, resume=False)
    for name in names:
        journal.began(name)
        journal.add(record(name))
    journal.close()
    return journal.path


def test_a_record_comes_back_from_its_line() -> None:
    one = record("C-1")
    line = one.line()
    assert line.count(b"\n") == 1
    assert json.loads(line)["id"] == "C-1"
    assert json.loads(unpack(json.loads(line)["report"]))["id"] == "C-1"
    again = read_record(line)
    assert again is not None
    assert (again.id, again.key, again.verdict, again.seconds, again.where) == (
        "C-1",
        "k",
        "pass",
        {"total": 0.25},
        "trace\nof it",
    )
    assert again.report == one.report
    assert again.column().size_mm == (0.1, 600)
    for place in range(len(line)):
        damaged = line[:place] + bytes([line[place] ^ 1]) + line[place + 1 :]
        assert read_record(damaged) is None
        assert read_record(line[:place]) is None


def test_numbers_are_kept_as_they_are_shown() -> None:
    """What has no place in report.json, and what moulds are judged by, stays what it is."""
    strange = np.array([[np.nan, np.inf, 1.0 / 3.0, 1.0 / 3.0]] * 4)
    place, off_mm = (1.0 / 3.0, 0.0, 0.0), 2.0 / 3.0
    sleeve = PointResult("S1", None, place, None, None, None, None, None, off_mm, None, 2.0, Verdict.PASS)
    sleeve = replace(sleeve, offset_mm=(1.0 / 3.0, -0.1), u_mm=1.0 / 7.0)
    group = GroupReport("a.ply", "", "refined", 1, 1, Verdict.PASS, (sleeve,), (), None)
    report = ColumnReport("C-1", Verdict.PASS, Verdict.PASS, sleeves=group, T_model_column=strange)
    back = Record.of(ColumnOutcome(report, {}, ""), "k").column()
    assert back.T_model_column is not None
    assert back.sleeves is not None
    (point,) = back.sleeves.points
    assert np.array_equal(back.T_model_column[0], [np.nan, np.inf, 0.333333333, 0.333333], equal_nan=True)
    assert (point.design_mm[0], point.deviation_mm) == (0.3333, 0.6667)
    assert (point.offset_mm, point.u_mm) == ((1.0 / 3.0, -0.1), 1.0 / 7.0)


def test_an_error_is_never_used_again() -> None:
    assert record("C-1", Verdict.ERROR).key == ""


def test_cut_off_anywhere(tmp_path: Path) -> None:
    path = written(tmp_path, "C-1", "C-2", "C-3")
    content = path.read_bytes()
    ends = [place + 1 for place, sign in enumerate(content) if sign == 10]
    for size in [*range(0, len(content), 37), *ends, *(end - 1 for end in ends)]:
        path.write_bytes(content[:size])
        journal = Journal(tmp_path, resume=True)
        whole = [line for line in content[:size].split(b"\n")[:-1] if line.startswith(b'{"id"')]
        assert len(journal.keys) == len(whole)
        journal.add(record("C-9"))
        assert journal.record("C-9").report == record("C-9").report
        journal.close()
        again = Journal(tmp_path, resume=True)
        assert set(again.keys) == {*journal.keys}
        again.close()


def test_damage_in_the_middle_costs_one_column(tmp_path: Path) -> None:
    path = written(tmp_path, "C-1", "C-2", "C-3")
    lines = path.read_bytes().splitlines(keepends=True)
    lines[4] = b"\x00" * (len(lines[4]) - 1) + b"\n"
    path.write_bytes(b"".join(lines))
    journal = Journal(tmp_path, resume=True)
    assert set(journal.keys) == {"C-1", "C-3"}
    assert journal.interrupted == {"C-2"}
    assert journal.record("C-3").column().id == "C-3"
    journal.close()


def test_a_file_that_is_no_journal_is_begun_anew(tmp_path: Path) -> None:
    (tmp_path / "journal.jsonl").write_bytes(b'{"aadm_journal":99}\n' + record("C-1").line())
    journal = Journal(tmp_path, resume=True)
    assert journal.keys == {}
    journal.close()


def test_an_unfinished_journal_is_put_aside(tmp_path: Path) -> None:
    content = written(tmp_path, "C-1").read_bytes()
    journal = Journal(tmp_path, resume=False)
    assert journal.put_aside
    assert (tmp_path / PREVIOUS_NAME).read_bytes() == content
    journal.add(record("C-2"))
    journal.finish("of a report")
    journal.close()
    resumed = Journal(tmp_path, resume=True)
    assert resumed.finished == "of a report"
    resumed.close()
    again = Journal(tmp_path, resume=False)
    assert not again.put_aside
    again.close()


def test_what_was_finished_is_so_no_more_once_a_column_was_begun(tmp_path: Path) -> None:
    journal = Journal(tmp_path, resume=False)
    journal.add(record("C-1"))
    journal.finish("of a report")
    journal.began("C-2")
    journal.close()
    again = Journal(tmp_path, resume=True)
    assert again.finished == ""
    again.close()


def test_a_full_disk_spoils_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    journal = Journal(tmp_path, resume=False)
    journal.add(record("C-1"))
    real = os.write

    def write(file: int, content: bytes) -> int:
        if len(content) > 100:
            return real(file, content[:100])
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "write", write)
    with pytest.raises(
        AadmError, match=r"journal\.jsonl: the results so far cannot be kept \(No space left on device\)"
    ):
        journal.add(record("C-2"))
    monkeypatch.undo()
    journal.close()
    assert set(Journal(tmp_path, resume=True).keys) == {"C-1"}


def test_a_folder_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "journal.jsonl").mkdir()
    with pytest.raises(AadmError, match="cannot be kept"):
        Journal(tmp_path, resume=False)


def test_a_check_that_was_stopped_suspects_no_column(tmp_path: Path) -> None:
    journal = Journal(tmp_path, resume=False)
    journal.began("C-1")
    journal.stop()
    journal.began("C-2")
    journal.close()
    again = Journal(tmp_path, resume=True)
    assert again.interrupted == {"C-2"}
    again.close()
