"""Jobs and reports that mean harm: what they name never steers a terminal, leads out of a folder or shows the disk."""

from __future__ import annotations

import io
import json
import os
from dataclasses import asdict
from pathlib import Path

import pytest
from rich.table import Table

from aadm_workbench.errors import JobError, ReportError
from aadm_workbench.model import ColumnReport, Verdict
from aadm_workbench.report.json import encode
from aadm_workbench.report.read import read_report
from batch.job.file import read_job
from batch.made_report import without_absolute_paths
from batch.main import main
from batch.shown import terminal
from batch.switches import printable

from .test_pipeline import DESIGN, column

STEERING = "\x1b]0;owned\x07\x1b[2J\x9b31m\u202egnp.ylp"


def write_job(folder: Path, text: str) -> Path:
    path = folder / "job.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("schema = 1\nx = " + "[" * 100_000, "is nested deeper"),
        ("schema = 1\nx = " + "{a=" * 20_000, "is nested deeper"),
        ("schema = 1\n" + "a." * 50_000 + "b = 1\n", "unknown key|is nested deeper"),
        ("schema = 1" + "0" * 5000, "line 1: this is no TOML|Exceeds"),
        (f"schema = 1\n[camera]\nfx = 1{'0' * 400}\n", "line 3: fx must be a number|camera"),
        ('schema = 1\nname = "a\\u001b[2Jb"\n', r"line 2: name holds the control character U\+001B"),
        ('schema = 1\n[[columns]]\nid = "a\\u202eb"\n' + DESIGN, r"line 3: id holds the control character U\+202E"),
        ('schema = 1\n[[columns]]\nid = "a\\nb"\n' + DESIGN, r"line 3: id holds the control character U\+000A"),
        (
            'schema = 1\n[[columns]]\nid = "a"\nsleeves = ["b.ply", "c\\u0000.ply"]\n' + DESIGN,
            "line 4: sleeves holds the",
        ),
        (
            'schema = 1\n[capture]\noperator = "Li\\u009b31m"\n' + column("a"),
            r"line 3: operator holds the control character U\+009B",
        ),
        (f'schema = 1\n[[columns]]\nid = "{"x" * 5000}"\n' + DESIGN, "line 3: id has 5000 characters"),
        (
            'schema = 1\n[[columns]]\nid = "a"\nup = 1'
            + "0" * 400
            + '\nsleeves = "b.ply"\n'
            + DESIGN.partition("\n")[2],
            "line 4: up must",
        ),
    ],
)
def test_job_texts_that_mean_harm(tmp_path: Path, text: str, message: str) -> None:
    path = write_job(tmp_path, text)
    with pytest.raises(JobError, match=message):
        read_job(path)


def test_jobs_and_reports_that_are_no_files(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    for path in (tmp_path / "pipe.toml", tmp_path, Path("/dev/zero")):
        with pytest.raises(JobError, match="the job file cannot be read"):
            read_job(path)
        with pytest.raises(ReportError, match=r"name the report\.json"):
            read_report(path)


def test_what_is_shown_cannot_steer_the_terminal(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    table = Table("Column")
    table.add_row(STEERING)
    terminal.show(STEERING, table)
    terminal.say(STEERING)
    assert main(["extract", str(tmp_path / STEERING), "--kind", "sleeve", "--diameter", "36"]) == 2
    shown = capsys.readouterr()
    for text in (shown.out, shown.err):
        assert not any(sign in text for sign in "\x1b\x07\x9b\u202e")
        # Rich leaves the bell out where it lays out a table.
        assert "\\x1b]0;owned" in text
        assert "\\x1b[2J\\x9b31m\\u202egnp.ylp" in text


def test_colour_of_the_program_itself_still_reaches_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    class Screen(io.StringIO):
        def isatty(self) -> bool:
            return True

    screen = Screen()
    monkeypatch.setattr("sys.stdout", screen)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.delenv("NO_COLOR", raising=False)
    terminal.show(terminal.verdict_text(Verdict.FAIL), "\x1b[31mnot mine")
    assert "\x1b[1;31m" in screen.getvalue()
    assert "\\x1b[31mnot mine" in screen.getvalue()


def test_plain_text_stays_as_it_is() -> None:
    text = "灌浆套筒 Ø20 – 0.5 mm²\n\tנסיון"
    assert printable(text) is text or printable(text) == text


def test_json_on_a_terminal_cannot_steer_it() -> None:
    content = encode({"name": STEERING, "名": "套筒"})
    assert json.loads(content) == {"name": STEERING, "名": "套筒"}
    assert not any(sign in content.decode() for sign in "\x1b\x07\x9b\u202e")
    assert "套筒" in content.decode()


IDS = ["../../outside", "/tmp/outside", "..", "a/b/c", "C:\\outside", "~root", "-rf", "con", "a" * 300, "*", "$(id)"]


def test_names_of_columns_never_become_paths(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "a" / "b" / "c"
    folder.mkdir(parents=True)
    path = write_job(folder, "schema = 1\n" + "".join(column(name, sleeves="none.ply") for name in IDS[:8]))
    assert main(["check", str(path), "--quiet"]) == 12
    path = write_job(folder, "schema = 1\n" + "".join(column(name, sleeves="none.ply") for name in IDS[8:]))
    assert main(["check", str(path), "--quiet", "--out", str(folder / "out")]) == 12
    outside = {entry.name for entry in tmp_path.rglob("*") if folder not in entry.parents}
    assert outside == {"a", "b", "c"}
    assert {entry.name for entry in folder.iterdir()} == {"job.toml", "job-report", "out"}
    for report_folder in (folder / "job-report", folder / "out"):
        assert all(entry.is_file() for entry in report_folder.rglob("*"))
    assert capsys.readouterr().out == ""


def test_links_in_the_folder_of_the_report_are_replaced_and_not_followed(tmp_path: Path) -> None:
    path = write_job(tmp_path, "schema = 1\n" + column("C-1", sleeves="none.ply"))
    for name in ("report.json", "timing.json"):
        (tmp_path / f"precious-{name}").write_text("precious")
    report_folder = tmp_path / "job-report"
    report_folder.mkdir()
    for name in ("report.json", "timing.json"):
        (report_folder / name).symlink_to(tmp_path / f"precious-{name}")
    assert main(["check", str(path), "--quiet"]) == 12
    for name in ("report.json", "timing.json"):
        assert (tmp_path / f"precious-{name}").read_text() == "precious"
        assert not (report_folder / name).is_symlink()


def test_a_report_folder_that_is_a_link_must_be_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "precious").mkdir()
    (tmp_path / "job-report").symlink_to(tmp_path / "precious")
    path = write_job(tmp_path, "schema = 1\n" + column("C-1", sleeves="none.ply"))
    assert main(["check", str(path), "--quiet"]) == 2
    assert "is a symbolic link; where it leads may be meant, then say so with --out" in capsys.readouterr().err
    assert list((tmp_path / "precious").iterdir()) == []
    assert main(["check", str(path), "--quiet", "--out", str(tmp_path / "job-report")]) == 12


@pytest.mark.parametrize("asked", [False, True])
def test_absolute_paths_only_where_they_are_asked_for(tmp_path: Path, asked: bool) -> None:
    secret = tmp_path / "home" / "li.wei"
    secret.mkdir(parents=True)
    (secret / "cut.ply").write_text("ply\n")
    names = [str(secret / "cut.ply"), str(secret / "none.ply"), "cut.ply", str(secret)]
    path = write_job(secret, "schema = 1\n" + "".join(column(f"C-{k}", sleeves=name) for k, name in enumerate(names)))
    options = ["--absolute-paths"] if asked else []
    assert main(["check", str(path), "--quiet", "--out", str(tmp_path / "out"), *options]) == 12
    text = (tmp_path / "out" / "report.json").read_text(encoding="utf-8")
    assert (str(secret) in text) == asked
    assert "cut.ply: " in text
    assert "none.ply: there is no such file" in text


def test_short_names_do_not_touch_other_words(tmp_path: Path) -> None:
    job = read_job(write_job(tmp_path, "schema = 1\n" + column("C-1", sleeves="/T", rebars="/")))
    reasons = ("2 mm (GB/T 51231, 10.4)", "/T: there is no such file", f"{tmp_path}/x.ply: is empty", "and/or")
    report = ColumnReport("C-1", Verdict.ERROR, Verdict.NOT_ASSESSED, reasons)
    served = without_absolute_paths(report, job)
    assert served.reasons == (reasons[0], "T: there is no such file", "x.ply: is empty", "and/or")
    assert asdict(served) | {"reasons": ()} == asdict(report) | {"reasons": ()}


def test_what_holds_no_path_is_the_same_report(tmp_path: Path) -> None:
    job = read_job(write_job(tmp_path, "schema = 1\n" + column("C-1", sleeves="a.ply")))
    report = ColumnReport("C-1", Verdict.ERROR, Verdict.NOT_ASSESSED, ("a.ply: is empty",))
    assert without_absolute_paths(report, job) is report
