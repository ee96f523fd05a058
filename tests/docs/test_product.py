"""What the product has stands in the pages, in both languages; what the pages show, the product takes."""

import argparse
import io
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Iterator
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench import errors
from aadm_workbench.assembly.tolerances import QUANTITIES
from aadm_workbench.extract.method import METHODS
from aadm_workbench.model import Verdict
from aadm_workbench.model.sentences.finding import SENTENCES
from aadm_workbench.scan.read import supported_formats
from aadm_workbench.twin.filters import NAMES as FILTERS
from batch import switches
from batch.job.file import read_job
from batch.job.table import JobTable
from batch.main import build_parser, main
from batch.report_files import FORMATS

from .pages import LANGUAGES, ROOT, all_pages, codes, inline_codes, text_of

PARSER = build_parser()
EVERY_TABLE = """\
schema = 1
model = { path = "a.ifc" }
camera = { fx = 2000.0, fy = 2000.0, cx = 960.0, cy = 600.0, width = 1920, height = 1200 }
capture = { operator = "A" }
[[columns]]
id = "A"
rebars = "a.ply"
[columns.design]
sleeve_diameter = 26.0
rebar_diameter = 18.0
centres = [[0.0, 0.0], [100.0, 0.0], [0.0, 100.0]]
[[columns.control_points]]
name = "G1"
column = [0.0, 0.0, 0.0]
scan = [0.0, 0.0, 0.0]
[[columns.control_points]]
name = "G2"
column = [900.0, 0.0, 0.0]
scan = [900.0, 0.0, 0.0]
"""
A_COLUMN = '\n[[columns]]\nid = "C-301"\nsleeves = "a.tiff"\nrebars = "b.tiff"\n'
A_MODEL = '\n[model]\npath = "floor3.ifc"\n'


def page(language: str, name: str) -> str:
    return text_of(LANGUAGES[language][0] / name)


def missing(words: Iterable[str], text: str) -> list[str]:
    """Those words that do not stand in a text in backticks, alone or with what follows them."""
    return [word for word in words if not re.search(rf"`{re.escape(word)}(?![\w-])", text)]


def commands(parser: argparse.ArgumentParser, name: str = "aadm") -> Iterator[tuple[str, argparse.ArgumentParser]]:
    """Every command with its parser, from the parser of all of them."""
    groups = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    if not groups:
        yield name, parser
    for group in groups:
        for word, inner in group.choices.items():
            yield from commands(inner, f"{name} {word}")


def chapter(text: str, heading: str) -> str:
    """What stands under a heading of the second level."""
    found = re.search(rf"^## `?{re.escape(heading)}`?$(.*?)(?=^## |\Z)", text, flags=re.MULTILINE | re.DOTALL)
    return found[1] if found else ""


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("command", [name for name, _ in commands(PARSER)])
def test_every_command_and_option(language: str, command: str) -> None:
    told = chapter(page(language, "commands.md"), command)
    assert told, f"{command} has no section"
    parser = dict(commands(PARSER))[command]
    spelled = [action.option_strings[-1] for action in parser._actions if action.option_strings]
    assert missing([one for one in spelled if one != "--help"], told) == []


def test_the_english_reference_is_what_help_says(repository: Path) -> None:
    program = "import sys; sys.path.insert(0, 'docs'); import commands; sys.stdout.write(commands.page())"
    command = [sys.executable, "-X", "utf8", "-c", program]
    written = subprocess.run(command, cwd=repository, capture_output=True, text=True, check=True, encoding="utf-8")
    assert page("en", "commands.md") == written.stdout, "run: python docs/commands.py"


def job_keys(monkeypatch: pytest.MonkeyPatch, folder: Path) -> dict[str, tuple[str, ...]]:
    """The keys of every table of a job, as the reader of a job that has them all asks for them."""
    known: dict[str, tuple[str, ...]] = {}
    allow = JobTable.allow

    def noted(table: JobTable, keys: Iterable[str]) -> None:
        known[table.called] = tuple(keys)
        allow(table, known[table.called])

    monkeypatch.setattr(JobTable, "allow", noted)
    path = folder / "job.toml"
    path.write_text(EVERY_TABLE, encoding="utf-8")
    read_job(path)
    return known


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_job_key(language: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    known = job_keys(monkeypatch, tmp_path)
    assert set(known) >= {"the job", "[model]", "[camera]", "[[columns]]", "[columns.design]"}
    text = page(language, "jobs.md")
    for table, keys in known.items():
        told = text if table == "the job" else re.split(rf"^#+ `{re.escape(table)}`$", text, flags=re.MULTILINE)[1]
        assert missing(keys, re.split(r"^#+ ", told, flags=re.MULTILINE)[0] if table != "the job" else told) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_error_exit_code_verdict_and_finding(language: str) -> None:
    text = page(language, "verdicts.md")
    kinds = [name for name, kind in vars(errors).items() if isinstance(kind, type) and issubclass(kind, Exception)]
    assert missing(kinds, text) == []
    codes_of_exit = {value for value in vars(switches).values() if type(value) is int and value < 256}  # one byte
    assert len(codes_of_exit) >= 7
    assert {value for value in codes_of_exit if not re.search(rf"^\| {value} \|", text, flags=re.MULTILINE)} == set()
    findings = [code.removeprefix("finding.") for code in SENTENCES]
    assert missing({name.partition(".")[0] for name in findings}, text) == []
    words = {"en": {verdict.value.replace("_", " ") for verdict in Verdict}, "zh": chinese_verdicts()}[language]
    assert {word for word in words if word not in text} == {"not assessed"} & words


def chinese_verdicts() -> set[str]:
    words = tomllib.loads((ROOT / "aadm_workbench/resources/report/words.toml").read_text(encoding="utf-8"))
    return {chinese for name, (_, chinese) in words["verdict"].items() if name != "not_assessed"}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_format_filter_method_and_report(language: str) -> None:
    assert missing(supported_formats(), page(language, "scans.md")) == []
    assert missing(FILTERS, page(language, "cameras.md")) == []
    assert [name for name in METHODS if name not in page(language, "commands.md")] == []
    told = page(language, "reports.md") + page(language, "ifc-bcf.md") + page(language, "freecad.md")
    assert [file for file, _ in FORMATS.values() if file not in told] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_kind_of_limit(language: str) -> None:
    assert missing(QUANTITIES, page(language, "jobs.md")) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_extra(language: str) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert missing(project["optional-dependencies"], page(language, "install.md")) == []


def todays_pages() -> list[Path]:
    """All pages but those that tell of other days: a changelog and records name what was."""
    return [path for path in all_pages() if path.name != "CHANGELOG.md" and path.parent.name != "decisions"]


def typed(path: Path) -> Iterator[list[str]]:
    """The words of every ``aadm`` command that a page shows, in a block or in a line."""
    shown = [line for code in codes(path) if code.language in ("sh", "bash", "") for line in code.text.splitlines()]
    for line in [*shown, *(code.replace("\n", " ") for code in inline_codes(path))]:
        if re.match(r"aadm [a-z-]", line.strip()):
            yield shlex.split(re.split(r" > | \| | &&", line.strip())[0], comments=True)[1:]


@pytest.mark.parametrize("path", todays_pages(), ids=lambda path: path.relative_to(ROOT).as_posix())
def test_commands_that_are_shown_are_taken(path: Path) -> None:
    assert [f"aadm {' '.join(words)}" for words in typed(path) if not is_a_name(words) and not is_taken(words)] == []


def is_taken(words: list[str]) -> bool:
    """Whether the command line takes these words; brackets of optional ones aside."""
    try:
        with redirect_stdout(io.StringIO()):
            PARSER.parse_args([word.strip("[]") for word in words])
    except SystemExit as end:
        return end.code == 0
    return True


def is_a_name(words: list[str]) -> bool:
    """Whether a command is only named in a sentence, ``aadm study methods``, and lacks what it must be given."""
    parser = PARSER
    for word in words:
        groups = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
        if not groups:
            return word.startswith("--") and len(words) == 2 and word in parser._option_string_actions
        if word not in groups[0].choices:
            return False
        parser = groups[0].choices[word]
    return True


def completed(text: str) -> str:
    """A part of a job, made whole."""
    whole = text if re.search(r"^schema", text, flags=re.MULTILINE) else f"schema = 1\n{text}"
    whole += "" if "[[columns]]" in text else A_COLUMN
    return whole + ("" if re.search(r"\[model\]|^model =|\[columns\.design\]", text, flags=re.MULTILINE) else A_MODEL)


def jobs_shown() -> list[Any]:
    found = [(path, code) for path in all_pages() for code in codes(path) if code.language == "toml"]
    return [pytest.param(code.text, id=f"{path.relative_to(ROOT).as_posix()}:{code.line}") for path, code in found]


@pytest.mark.parametrize("text", jobs_shown())
def test_jobs_that_are_shown_are_read(text: str, tmp_path: Path) -> None:
    path = tmp_path / "job.toml"
    path.write_text(completed(text), encoding="utf-8")
    assert read_job(path).columns


def job_of_the_readme(language: str) -> str:
    (job,) = [code.text for code in codes(LANGUAGES[language][1]) if code.language == "toml"]
    assert len([line for line in job.splitlines() if line.strip()]) <= 10
    return job


def test_the_ten_lines_of_the_readme_are_checked(tmp_path: Path) -> None:
    path = tmp_path / "job.toml"
    path.write_text(job_of_the_readme("en").replace('"samples/', f'"{ROOT.as_posix()}/samples/'), encoding="utf-8")
    with redirect_stdout(io.StringIO()):
        assert main(["check", str(path), "--quiet", "--out", str(tmp_path / "report")]) == 0


def test_the_ten_lines_are_the_same_in_chinese() -> None:
    english, chinese = (tomllib.loads(job_of_the_readme(language)) for language in LANGUAGES)
    assert {**english, "name": ""} == {**chinese, "name": ""}
