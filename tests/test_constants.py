"""Each number at the head of a module says why it has its value, or where it comes from; so do those that measure.

A comment on its line or on the line above, or a docstring under it; inside functions, a comment there or above.
Whether what is said is true no test can tell; what
"±30 %" in a comment was, ``benchmarks/constants.py`` repeats.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("aadm_workbench", "batch")
MEASURING = ("aadm_workbench/extract", "aadm_workbench/assembly", "aadm_workbench/hoisting")
"""Where a number inside a function decides what is measured or judged."""
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


def silent_numbers(text: str) -> Iterator[tuple[int, float]]:
    """Line and value of each number inside a function that stands without a word.

    Halves, powers of ten, what keeps a division from zero, whole numbers that index, and angles of a circle say it.
    """
    lines = text.splitlines()
    plain = {0.5, 16.0, 90.0, 180.0, 255.0, 360.0}  # half, of a turn, of a byte
    for function in (node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)):
        for node in ast.walk(function):
            if not isinstance(node, ast.Constant) or type(node.value) not in {int, float}:
                continue
            value = float(node.value)
            whole = value.is_integer() and 0 <= value <= (9 if isinstance(node.value, int) else 4)
            power = value > 0 and f"{value:e}".startswith("1.000000e") and (value <= 1e-6 or value >= 1e-3)
            said = "#" in lines[node.lineno - 1] or comment_above(lines, node.lineno - 1)
            if not (whole or power or value in plain or said):
                yield node.lineno, value


def comment_above(lines: list[str], place: int) -> bool:
    """Whether a comment stands over the statement that a line, counted from 0, is a part of."""
    deep = len(lines[place]) - len(lines[place].lstrip())
    above = lines[place - 1]
    return above.lstrip().startswith("#") and len(above) - len(above.lstrip()) == deep


@pytest.mark.parametrize("folder", MEASURING)
def test_no_number_that_measures_stands_without_a_word(folder: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: {value}"
        for path in sorted((ROOT / folder).rglob("*.py"))
        for line, value in silent_numbers(path.read_text(encoding="utf-8"))
    ]
    assert found == []


@pytest.mark.parametrize(
    ("line", "values"),
    [
        ("a = 1.2 * b", [1.2]),
        ("a = 1.2 * b  # a fifth more", []),
        ("# a fifth more\n    a = 1.2 * b", []),
        ("a = 0.5 * b[5] + 2 * c + 100.0", []),
        ("a = b > 12", [12.0]),
        ("a = b / max(c, 1e-9)", []),
        ("a = f(c, 2e-9)", [2e-9]),
        ("if a:\n        # a fifth\n        b = 1\n    a = 1.2", [1.2]),
    ],
)
def test_a_silent_number_is_noticed(line: str, values: list[float]) -> None:
    assert [value for _, value in silent_numbers(f"def f():\n    {line}\n")] == values


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
