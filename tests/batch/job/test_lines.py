"""Every key and every element of an array is found on its line, however TOML is written."""

import tomllib
from typing import Any

import pytest

from batch.job.lines import KeyPath, lines_of

TEXT = '''\
schema = 1
name = "a # no comment" # a comment [with] = signs

[model]   # header
path = 'C:\\raw\\x.ifc'
"quoted key" = 1
"k\\u00e9y" = 2
columns = """
one \\""" = [not, a, key]
two"""
literal = \'\'\'
x = 1\'\'\'
dotted . inner.deep = 1979-05-27 07:32:00

[[columns]]
id = "C-1"
sleeves = [  # several views
  "a]",  'b}',
  # comment, with comma
  """c
d""",
]
design = { sleeve_diameter = 36.0, size = [1, 2], inner.key = "}" }
[columns.more]
centres = [[1, 2],
  [3,
   4]]

[[columns]]
id = "C-2"
[[columns.views]]
name = "v1"
[[columns.views]]
name = "v2"
[columns.views.pose]
x = 1
[last.table]
empty = []
'''

EXPECTED: dict[KeyPath, int] = {
    ("schema",): 1,
    ("name",): 2,
    ("model",): 4,
    ("model", "path"): 5,
    ("model", "quoted key"): 6,
    ("model", "kéy"): 7,
    ("model", "columns"): 8,
    ("model", "literal"): 11,
    ("model", "dotted", "inner", "deep"): 13,
    ("columns", 0): 15,
    ("columns", 0, "id"): 16,
    ("columns", 0, "sleeves"): 17,
    ("columns", 0, "sleeves", 0): 18,
    ("columns", 0, "sleeves", 1): 18,
    ("columns", 0, "sleeves", 2): 20,
    ("columns", 0, "design"): 23,
    ("columns", 0, "design", "size", 1): 23,
    ("columns", 0, "design", "inner", "key"): 23,
    ("columns", 0, "more"): 24,
    ("columns", 0, "more", "centres", 1): 26,
    ("columns", 0, "more", "centres", 1, 1): 27,
    ("columns", 1): 29,
    ("columns", 1, "id"): 30,
    ("columns", 1, "views", 0, "name"): 32,
    ("columns", 1, "views", 1): 33,
    ("columns", 1, "views", 1, "pose", "x"): 36,
    ("last", "table"): 37,
    ("last", "table", "empty"): 38,
}


def leaves(value: Any, at: KeyPath = ()) -> list[KeyPath]:
    """Path of everything in a parsed text."""
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [at, *(path for key, item in inside for path in leaves(item, (*at, key)))]


@pytest.mark.parametrize("path", EXPECTED, ids=str)
def test_line(path: KeyPath) -> None:
    assert lines_of(TEXT)[path] == EXPECTED[path]


def test_knows_all_that_the_parser_knows_and_no_more() -> None:
    parsed = set(leaves(tomllib.loads(TEXT))) - {()}
    arrays_of_tables_by_name = {("columns",), ("columns", 1, "views")}
    tables_named_on_the_way = {("last",)}
    assert set(lines_of(TEXT)) == parsed - tables_named_on_the_way | arrays_of_tables_by_name


def test_empty() -> None:
    assert lines_of("") == {}
    assert lines_of("# nothing\n\n") == {}
