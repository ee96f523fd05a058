"""Every error that reaches a person is said in both languages: none is made of a text that no table knows.

The files are read as syntax trees; what an error is made of is followed through names, branches and functions.
"""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.report.words.reasons import in_both_languages
from tests.report.words.test_sentences import ROOT, WORDS, called, modules

BASES = {"AadmError": 0, "BoundsError": 0, "UnsoundError": 0, "UnreadableGeometryError": 0, "UnsafeFileError": 1}
"""Errors whose text reaches people, themselves or within others; the place of the text among their arguments."""

NAMES_OF_COMMANDS = ("aadm ", "--", "report.")
"""So begins what needs a package and is called so in any language."""


@cache
def kinds() -> dict[str, int]:
    """All of them, and what is derived from them."""
    found = dict(BASES)
    classes = [node for tree in modules().values() for node in ast.walk(tree) if isinstance(node, ast.ClassDef)]
    for _ in range(3):  # as deep as they are derived from each other
        for one in classes:
            for base in one.bases:
                if isinstance(base, ast.Name) and base.id in found:
                    found.setdefault(one.name, found[base.id])
    return {name: place for name, place in found.items() if name != "MissingDependencyError"}


class Texts:
    """What an expression of one module comes to, as far as it is written there."""

    def __init__(self, tree: ast.Module) -> None:
        self.functions = {node.name: node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}

    def of(self, node: ast.expr | None, scope: ast.AST, depth: int = 0) -> Iterator[ast.expr]:
        """Texts that may become its value."""
        if depth > 6 or node is None:
            return
        if isinstance(node, ast.Constant | ast.JoinedStr):
            yield node
        parts: list[ast.expr | None] = []
        if isinstance(node, ast.BinOp):
            parts = [node.left, node.right]
        elif isinstance(node, ast.IfExp):
            parts = [node.body, node.orelse]
        elif isinstance(node, ast.BoolOp):
            parts = [*node.values]
        elif isinstance(node, ast.Name):
            parts = [one.value for one in ast.walk(scope) if isinstance(one, ast.Assign) and named(one) == node.id]
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and called(node) != "translate":
            parts = [node.func.value]
        elif isinstance(node, ast.Call) and called(node) in self.functions:
            scope = self.functions[called(node)]
            parts = [one.value for one in ast.walk(scope) if isinstance(one, ast.Return)]
        for part in parts:
            yield from self.of(part, scope, depth + 1)


def named(assignment: ast.Assign) -> str:
    (target, *_) = assignment.targets
    return target.id if isinstance(target, ast.Name) else ""


def holds_words(text: ast.expr) -> bool:
    parts = text.values if isinstance(text, ast.JoinedStr) else [text]
    return any(
        isinstance(one, ast.Constant) and isinstance(one.value, str) and any(map(str.isalpha, one.value))
        for one in parts
    )


def bare(tree: ast.Module) -> Iterator[int]:
    """Lines on which an error is made of a text that no table knows."""
    texts = Texts(tree)
    scopes = [tree, *texts.functions.values()]
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and called(node) in kinds():
            inmost = [one for one in scopes if any(node is inner for inner in ast.walk(one))][-1]
            given = node.args[kinds()[called(node)] :][:1]
            if any(holds_words(text) for one in given for text in texts.of(one, inmost)):
                yield node.lineno


def test_no_error_is_made_of_a_bare_text() -> None:
    assert len(kinds()) > 15
    wrong = [f"{file.relative_to(ROOT)}:{line}" for file, tree in modules().items() for line in bare(tree)]
    assert wrong == []


@pytest.mark.parametrize(
    ("code", "is_bare"),
    [
        ('raise ScanError(f"{path}: is a folder")', True),
        ('raise BoundsError("is a " + kind)', True),
        ('raise UnsafeFileError(0, "it is a link", path)', True),
        ('def f(path):\n    message = f"{path}: is a folder"\n    raise errors.ScanError(message)', True),
        ('def f(): raise JobError(said or _why())\ndef _why(): return "no" if late else "never"', True),
        ('raise AadmError("{file} is gone".format(file=file))', True),
        ('raise ScanError.about(path, "scan.is_folder")', False),
        ('raise ScanError(translate("AADM", "Choose a file."))', False),
        ('raise AadmError(f"{said} ({error})")', False),
        ('def f():\n    message = Reason("scan.is_folder")\n    raise ScanError(message)', False),
        ('def g(): message = "a key"\ndef f(message): raise ScanError(message)', False),
        ('raise ValueError("one capture tells no uncertainty")', False),
    ],
)
def test_what_is_noticed_of_errors(code: str, is_bare: bool) -> None:
    assert any(bare(ast.parse(code))) is is_bare


def test_what_a_package_is_needed_for_is_said_in_both_languages() -> None:
    """In words of the table, or by a name: a command, an option, a file, an address of a camera."""
    needs = [
        node.args[1]
        for tree in modules().values()
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and called(node) in {"MissingDependencyError", "needed"} and len(node.args) > 1
    ]
    said = [str(one.value) for one in needs if isinstance(one, ast.Constant)]
    assert len(said) > 10
    assert [text for text in said if text not in WORDS and not text.startswith(NAMES_OF_COMMANDS)] == []


def test_what_is_not_installed_is_told_with_its_command() -> None:
    error = MissingDependencyError("trimesh", "reading meshes")
    assert in_both_languages(error.reason).zh.startswith(
        "读取网格模型需要软件包 trimesh，但未安装。安装命令：pip install "
    )


def test_what_is_said_of_a_file_is_said_in_chinese(tmp_path: Path) -> None:
    from aadm_workbench.errors import AadmError
    from aadm_workbench.report.read import read_report

    (tmp_path / "report.json").write_text('{"schema": 1, "columns": [', "utf-8")
    with pytest.raises(AadmError, match="breaks off at line 1") as caught:
        read_report(tmp_path / "report.json")
    assert in_both_languages(str(caught.value)).zh.endswith(
        "report.json：在第 1 行第 27 列处中断；请重新复制或重新检查"
    )
