"""The command as a person meets it: help, exit codes, what goes to which stream."""

import argparse
import json
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from aadm_workbench import __version__
from aadm_workbench.extract import method
from aadm_workbench.inspection import column
from aadm_workbench.report.json import report_schema
from batch.job import command as job_command
from batch.main import COMMANDS, build_parser, main

from .conftest import WriteJob, column_text

ROOT = Path(__file__).resolve().parents[2]


def parsers(parser: argparse.ArgumentParser) -> Iterator[argparse.ArgumentParser]:
    """A parser and those of all its commands."""
    yield parser
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for inner in action.choices.values():
                yield from parsers(inner)


ALL_PARSERS = list(parsers(build_parser()))


@pytest.mark.parametrize("parser", ALL_PARSERS, ids=lambda parser: parser.prog)
def test_every_help_shows_an_example_that_parses(parser: argparse.ArgumentParser) -> None:
    text = parser.format_help()
    examples = [shlex.split(line)[1:] for line in text.splitlines() if line.startswith("  aadm ")]
    assert examples
    for words in examples:
        words = words[: words.index(">")] if ">" in words else words
        if not any(word.startswith("IfcColumn,") for word in words):
            assert callable(build_parser().parse_args(words).run)


def test_every_command_is_quiet_on_request_and_prints_json() -> None:
    for parser in ALL_PARSERS:
        options = {option for action in parser._actions for option in action.option_strings}
        if "--debug" in options:
            assert "--quiet" in options
            writes_alone = parser.prog.startswith(("aadm simulate ", "aadm camera plate", "aadm ask"))
            assert ("--json" in options) == (not writes_alone)


def python(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """A fresh Python that finds the package under the name it is installed by."""
    package = folder / "path" / "aadm_batch"
    package.mkdir(parents=True, exist_ok=True)
    (package / "__init__.py").write_text(f"__path__ = [{str(ROOT / 'batch')!r}]\n")
    return subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
        cwd=folder,
        env={"PYTHONPATH": f"{package.parent}:{ROOT}", "PATH": "/usr/bin:/bin", "PYTHONDONTWRITEBYTECODE": "1"},
    )


def test_as_a_module(tmp_path: Path) -> None:
    run = python("-m", "aadm_batch", "--version", folder=tmp_path)
    assert (run.returncode, run.stdout, run.stderr) == (0, f"aadm {__version__}\n", "")
    assert python("-m", "aadm_batch", "check", "nowhere.toml", folder=tmp_path).returncode == 2


def test_help_waits_for_nothing_heavy(tmp_path: Path) -> None:
    code = "import sys, aadm_batch.main as m\nm.build_parser().format_help()\nprint(*sys.modules)"
    loaded = set(python("-c", code, folder=tmp_path).stdout.split())
    assert "aadm_batch.commands.check" in loaded
    assert not loaded & {"numpy", "scipy", "cv2", "rich", "ifcopenshell", "distributed", "open3d"}


@pytest.mark.parametrize(
    "words",
    [[], ["chek"], ["check"], ["check", "a.toml", "--jobs", "0"], ["extract", "a.ply", "--kind", "beam"]],
    ids=" ".join,
)
def test_bad_usage(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2
    assert "usage: aadm" in capsys.readouterr().err


def test_a_job_that_is_wrong_leaves_nothing_behind(write_job: WriteJob, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_job(column_text("C-1", more='upp = "-y"\n'))
    assert main(["check", str(path)]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err == f'aadm: {path}, line 6: unknown key "upp" in [[columns]]; did you mean "up"?\n'
    assert [entry.name for entry in path.parent.iterdir()] == ["job.toml"]


CASES = [
    (("C-1", "foot.ply", "bars.ply"), 0),
    (("C-1", "foot.ply", "4mm.ply"), 10),
    (("C-1",), 11),
    (("C-1", "nowhere.ply"), 12),
]


@pytest.mark.usefixtures("exact_extraction")
@pytest.mark.parametrize(("column", "code"), CASES, ids=["passes", "fails", "not measured", "error"])
def test_exit_code(write_job: WriteJob, column: tuple[str, ...], code: int) -> None:
    good = column_text("good", "foot-2.ply")
    path = write_job(good, column_text(*column), clouds=("foot.ply", "foot-2.ply", "bars.ply", "4mm.ply"))
    assert main(["check", str(path), "--quiet"]) == code


@pytest.mark.usefixtures("exact_extraction")
def test_check_writes_its_reports(write_job: WriteJob, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_job(
        column_text("C-1", "foot.ply", "bars.ply"), column_text("C-2", "foot-2.ply", "4mm.ply"), column_text("C-3"),
        clouds=("foot.ply", "foot-2.ply", "bars.ply", "4mm.ply"),
    )  # fmt: skip
    assert main(["check", str(path)]) == 10
    folder = path.parent / "job-report"
    report = read(folder / "report.json")
    jsonschema.Draft202012Validator(report_schema()).validate(report)
    assert report["job"]["name"] == "层 3"
    assert report["summary"] == {"pass": 1, "fail": 1, "inconclusive": 0, "not_measured": 1, "error": 0}
    assert set(read(folder / "timing.json")["columns"]) == {"C-1", "C-2", "C-3"}
    captured = capsys.readouterr()
    lines = captured.out.splitlines()
    assert [line.split()[:3] for line in lines[1:4]] == [
        ["✗", "fail", "C-2"],
        ["-", "not", "measured"],
        ["✓", "pass", "C-1"],
    ]
    assert lines[-2:] == ["3 columns: 1 pass, 1 fail, 1 not measured", f"Report: {folder / 'report.json'}"]
    shown = [line.partition(" (")[0] for line in captured.err.splitlines()]  # without rate and time left
    assert shown == ["1/3 C-1: pass", "2/3 C-2: fail [1 failed so far]", "3/3 C-3: not measured [1 failed so far]"]


def read(path: Path) -> Any:
    """A JSON document."""
    return json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.usefixtures("exact_extraction")
def test_json_goes_to_stdout_alone(write_job: WriteJob, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    path = write_job(column_text("柱-1", "foot.ply"), clouds=("foot.ply",))
    out = path.parent / "deep" / "er"
    assert main(["check", str(path), "--json", "--quiet", "--out", str(out)]) == 0
    captured = capfdbinary.readouterr()
    assert captured.out == (out / "report.json").read_bytes()
    assert captured.err == b""


@pytest.mark.usefixtures("exact_extraction")
def test_no_place_for_the_report(write_job: WriteJob, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_job(column_text("C-1", "foot.ply"), clouds=("foot.ply",))
    assert main(["check", str(path), "--out", str(path)]) == 2
    assert "the folder for the reports cannot be made" in capsys.readouterr().err
    (path.parent / "job-report" / "report.json").mkdir(parents=True)
    assert main(["check", str(path)]) == 70
    assert "cannot be written" in capsys.readouterr().err


def test_an_error_that_nobody_foresaw(
    write_job: WriteJob, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write_job(column_text("C-1", "foot.ply"), clouds=("foot.ply",))

    def check_column(*_: object) -> None:
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr(column, "check_column", check_column)
    assert main(["check", str(path), "--debug"]) == 12
    assert "in check_column" in capsys.readouterr().err

    def read_job(*_: object) -> None:
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr("batch.job.file.read_job", read_job)
    assert main(["check", str(path)]) == 70
    assert capsys.readouterr().err == (
        "aadm: internal error: ZeroDivisionError: by zero; repeat the command with --debug to see where it happened\n"
    )
    assert main(["check", str(path), "--debug"]) == 70
    assert "in read_job" in capsys.readouterr().err


def test_interrupted(write_job: WriteJob, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_job(column_text("C-1", "foot.ply"), clouds=("foot.ply",))

    def check_column(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(column, "check_column", check_column)
    assert main(["check", str(path), "--quiet"]) == 130
    said = capsys.readouterr().err.splitlines()
    assert said[0] == "aadm: interrupted"
    assert "0 of 1 columns are kept" in said[1]
    assert said[1].endswith("repeat the command with --resume")


def test_methods_are_those_of_the_package() -> None:
    assert set(job_command.METHODS) == set(method.METHODS)


def test_command_names() -> None:
    assert list(COMMANDS) == [
        "check",
        "match",
        "watch",
        "cameras",
        "capture",
        "link",
        "plan",
        "design",
        "extract",
        "simulate",
        "study",
        "report",
        "diff",
        "stack",
        "camera",
        "gauge",
        "writeback",
        "profiles",
        "doctor",
        "ask",
    ]
