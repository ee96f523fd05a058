"""Each number at the head of a module says why it has its value, or where it comes from.

A comment on its line or on the line above, or a docstring under it. Whether what is said is true no test can tell; what
"±30 %" in a comment was, ``benchmarks/constants.py`` repeats.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("aadm_workbench", "batch")
SAYS_ITSELF = {"array", "eye", "ones", "zeros"}  # of noughts and ones: a direction, a matrix that does nothing


def silent_constants(text: str) -> Iterator[tuple[int, str]]:
    """Line and first name of each number, or each set of numbers, that stands without a word."""
    lines, body = text.splitlines(), ast.parse(text).body
    for place, node in enumerate(body):
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None or not holds_numbers(node.value):
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        names = [name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)]
        beside = any("#" in line for line in lines[node.lineno - 1 : node.end_lineno])
        above = lines[node.lineno - 2].startswith("#")
        if names and not (beside or above or is_docstring(body[place + 1 : place + 2])):
            yield node.lineno, names[0]


def holds_numbers(value: ast.expr) -> bool:
    """Whether a value is made of numbers and of no text."""
    found = [node.value for node in ast.walk(value) if isinstance(node, ast.Constant)]
    numbers = [number for number in found if isinstance(number, int | float | complex) and not isinstance(number, bool)]
    if any(isinstance(one, str) for one in found):
        return False
    named = value.func.attr if isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute) else ""
    return bool(numbers) and not (named in SAYS_ITSELF and {*numbers} <= {0, 1})


def is_docstring(following: list[ast.stmt]) -> bool:
    """Whether the statement after a constant is a text."""
    return any(isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) for node in following)


@pytest.mark.parametrize("folder", FOLDERS)
def test_no_number_stands_without_a_word(folder: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: {name}"
        for path in sorted((ROOT / folder).rglob("*.py"))
        for line, name in silent_constants(path.read_text(encoding="utf-8"))
    ]
    assert found == []


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("A = 1.5\n", ["A"]),
        ("A: float = 1.5\n", ["A"]),
        ("A = 1.5  # half of three\n", []),
        ("# half of three\nA = 1.5\n", []),
        ("# half of three\n\nA = 1.5\n", ["A"]),
        ('A = 1.5\n"""Half of three."""\n', []),
        ('A = 1.5\nB = "text"\n', ["A"]),
        ("A, B = 1.5, 2.5\n", ["A"]),
        ("# of both\nA = 1.5\nB = 2.5\n", ["B"]),
        ("A = (\n    1.5,  # the first\n    2.5,\n)\n", []),
        ("A = -(1.5**2)\n", ["A"]),
        ("A = np.radians(30.0)\n", ["A"]),
        ("UP = np.array([0.0, 0.0, -1.0])\n", []),
        ("A = np.array([0.0, 0.0, 2.0])\n", ["A"]),
        ('A = {"mm": 1.0}\nB = True\nC = "text"\nD = other\n', []),
        ("def f():\n    A = 1.5\n", []),
    ],
)
def test_the_count_notices_what_is_silent(text: str, names: list[str]) -> None:
    assert [name for _, name in silent_constants(text)] == names
