"""What has a type says which: dictionaries of anything are few, and each reader of a report takes nouns."""

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MOST_THAT_HOLD_ANYTHING = 30
"""What models, Mitsuba, TOML and FreeCAD give has no other type; what this program makes has one."""


def test_few_dictionaries_hold_anything() -> None:
    files = [path for folder in ("aadm_workbench", "batch") for path in (ROOT / folder).rglob("*.py")]
    found = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path in files
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Subscript) and ast.unparse(node) == "dict[str, Any]"
    ]
    assert 0 < len(found) <= MOST_THAT_HOLD_ANYTHING, found
