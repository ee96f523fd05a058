"""What the parsers of TOML and of the command line say in English is said in Chinese, too, by the table."""

import argparse
import ast
import inspect
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from aadm_workbench.bounded import toml_fault
from aadm_workbench.model.reason import as_said_by, codes_of, sentences_of
from batch.main import main

CHINESE = re.compile(r"[\u4e00-\u9fff]")


def words_of(node: ast.expr) -> str | None:
    """A text of a source, whatever is put in for its places."""
    if isinstance(node, ast.JoinedStr):
        return "".join(str(part.value) if isinstance(part, ast.Constant) else "…" for part in node.values)
    return re.sub(r"%(\(\w+\))?[rs]", "…", node.value) if isinstance(node, ast.Constant) else None


def messages(module: ModuleType, maker: str, place: int) -> Iterator[str]:
    """The texts that a module of the standard library hands to one of its functions."""
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == maker:
            said = words_of(node.args[place]) if len(node.args) > place else None
            if said is not None:
                yield said


def test_every_fault_that_the_parser_of_toml_knows_is_in_the_table() -> None:
    parser: ModuleType = inspect.getmodule(tomllib.loads) or tomllib
    found = set(messages(parser, "suffixed_err", 2))
    assert len(found) > 15
    assert {said for said in found if as_said_by("bounded.toml", said).code == "bounded.toml.other"} == set()
    known = {re.sub(r"\{\w+\}", "…", told.en) for code, told in sentences_of("bounded").items() if ".toml." in code}
    own = {"… (at line …, column …)", "… (at end of document)", "…"}
    assert {said for said in known - own - found if not said.startswith("Exceeds")} == set()


@pytest.mark.parametrize(
    "text",
    [
        "a = ",
        "a",
        "a = 1 b = 2",
        "= 1",
        "[a",
        "[[a]",
        "[a]\n[a]",
        "a.b = 1\n[a.b]\nc = 1",
        "a = {b = 1}\na.c = 1",
        "a = {b = 1, b = 2}",
        "a = {b = 1",
        "a = [1, 2",
        'a = "x',
        'a = "\\q"',
        'a = "\\ud800"',
        'a = "\\u12"',
        "a = '''",
        "a = 2026-13-01",
        "a = 25:00:00",
        "a = \x01",
        'a = "\x01"',
        "# \x07",
        "a = 1\na = 2",
        "a = [1]\n[[a]]",
        "a = 0x",
        "a = 1__0",
        "一 = 1",
        f"a = {'9' * 5000}",
    ],
)
def test_a_text_that_is_no_toml(text: str) -> None:
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - its text is what is looked at
        tomllib.loads(text)
    said = toml_fault(caught.value)
    assert "bounded.toml.other" not in codes_of(said)
    chinese = said.in_language("zh")
    assert CHINESE.search(chinese)
    # What is left in Latin letters is the text's own.
    assert re.findall(r"[A-Za-z]{2,}", chinese.replace("Unicode", "")) == []


def test_what_no_table_has_is_quoted() -> None:
    said = toml_fault("A later parser says so (at line 3, column 7)")
    assert str(said) == "A later parser says so (at line 3, column 7)"
    assert said.in_language("zh") == "第 3 行第 7 列：解析器报告“A later parser says so”"
    assert str(toml_fault("Cannot declare ('stack', 'limits') twice")) == "Cannot declare stack.limits twice"


NOT_OF_USERS = re.compile(
    r"is an invalid argument|must be optional|conflict|must start with|^dest=|subparser arguments"
)
"""Texts of argparse for whoever writes a command line's parser."""
NEVER_HERE = ("can't open", 'argument "-" with mode')  # of FileType, which no command has


def test_what_argparse_says_of_a_command_line_is_in_the_table() -> None:
    said = {*messages(argparse, "_", 0), *messages(argparse, "ngettext", 0), *messages(argparse, "ngettext", 1)}
    said = {one.removesuffix("\n") for one in said if not NOT_OF_USERS.search(one) and not one.startswith(NEVER_HERE)}
    heads = {"positional arguments", "options", "show this help message and exit", "usage: "}
    inner = {".__call__() not defined", "cannot merge actions - two groups are named …", "… is not callable"}
    unknown = {one for one in said - heads - inner if as_said_by("command.usage", one).code == "command.usage.other"}
    assert unknown <= {"expected … argument"}  # which argparse says as "expected one argument"
    assert (
        as_said_by("command.usage", "argument --jobs: expected one argument").in_language("zh")
        == "参数 --jobs：需要一个值"
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["check", "--language", "zh"], "缺少参数：JOB.toml"),
        (["check", "a.toml", "--jobs", "0", "--lang=zh"], "参数 --jobs：'0' 不是大于零的整数"),
        (["check", "a.toml", "--language", "zh", "--jobs"], "参数 --jobs：需要一个值"),
        (["check", "a.toml", "--language", "zh", "--memory-limit", "5kb"], "'5kb' 不是限值；请写 2GB or 600MB"),
        (["check", "a.toml", "--language", "zh", "--method", "magic"], "没有 'magic'，可选："),
        (["check", "a.toml", "--language", "zh", "--jobs", "2", "--scheduler", "tcp://a"], "不能与参数 --jobs 同用"),
        (["report", "a.json", "--language", "zh", "--html=1"], "该选项不带值，不应写 '1'"),
        (["stack", "--language", "zh", "a.json", "--wat\x1b[2J"], "不认识的参数：--wat\\x1b[2J"),
    ],
)
def test_bad_usage_in_the_language_asked_for(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(words)
    assert stop.value.code == 2
    error = capsys.readouterr().err
    assert error.startswith("用法：aadm")
    assert said in error.splitlines()[-1]
    assert "error" not in error


def test_the_language_of_the_environment(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Commands without --language speak it, and those with one where nobody asks for another."""
    (tmp_path / "job.toml").write_text("schema = 1\na = ", encoding="utf-8")
    for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES"):
        monkeypatch.delenv(name, raising=False)
    found = {}
    for setting in ("zh_CN.UTF-8", "de_DE.UTF-8", ""):
        monkeypatch.setenv("LANG", setting)
        with pytest.raises(SystemExit):
            main(["camera", "dance"])
        assert main(["check", str(tmp_path / "job.toml")]) == 2
        assert main(["check", str(tmp_path / "job.toml"), "--language", "zh"]) == 2
        found[setting] = capsys.readouterr().err.splitlines()[-3:]
    camera, check, asked = found["zh_CN.UTF-8"]
    assert camera == "aadm camera：错误：参数 WHAT：没有 'dance'，可选：'plate', 'learn', 'verify', 'reversal'"
    assert check == asked == f"aadm: {tmp_path / 'job.toml'} 第 2 行：不是 TOML：值无效"
    assert found["de_DE.UTF-8"] == found[""]
    assert found[""][0].startswith("aadm camera: error: argument WHAT: invalid choice: 'dance'")
    assert found[""][1:] == [f"aadm: {tmp_path / 'job.toml'}, line 2: this is no TOML: Invalid value", asked]
