"""On which line of a TOML text each key and each value of an array stands; the standard parser does not tell."""

from __future__ import annotations

import re
import tomllib
from typing import TypeAlias

KeyPath: TypeAlias = tuple[str | int, ...]
"""Keys and, inside arrays, indices: ``("columns", 1, "id")``."""

_BLANK = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
_STRING = re.compile(r'"""(?s:\\.|[^\\])*?"{3,5}(?!")|\'\'\'(?s:.)*?\'{3,5}(?!\')|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\'')
_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
_SCALAR = re.compile(r"[^,\]}#\n]+")


def lines_of(text: str) -> dict[KeyPath, int]:
    """Line, from 1, of every key and every element of an array in a text that :mod:`tomllib` accepts.

    A table stands where its header, or the first key that names it, stands.
    """
    return _Scanner(text).lines


class _Scanner:
    """Walks once through a valid TOML text."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._counted_to = 0
        self._line = 1
        self.lines: dict[KeyPath, int] = {}
        self._tables_in: dict[KeyPath, int] = {}
        self._document()

    def _document(self) -> None:
        table: KeyPath = ()
        while self._skip_blank():
            if self._takes("[["):
                table = self._header("]]", opens_another=True)
            elif self._takes("["):
                table = self._header("]", opens_another=False)
            else:
                self._entry(table)

    def _header(self, end: str, opens_another: bool) -> KeyPath:
        line = self._line_here()
        keys = self._keys()
        self._takes(end)
        table: KeyPath = ()
        for key in keys[:-1]:
            table = self._newest((*table, key))
        table = (*table, keys[-1])
        self.lines.setdefault(table, line)
        if opens_another:
            self._tables_in[table] = self._tables_in.get(table, 0) + 1
        table = self._newest(table)
        self.lines.setdefault(table, line)
        return table

    def _newest(self, table: KeyPath) -> KeyPath:
        """The last table of an array of tables; any other table is itself."""
        return (*table, self._tables_in[table] - 1) if table in self._tables_in else table

    def _entry(self, table: KeyPath) -> None:
        line = self._line_here()
        for key in self._keys():
            table = (*table, key)
            self.lines.setdefault(table, line)
        self._takes("=")
        self._skip_blank()
        self._value(table)

    def _value(self, path: KeyPath) -> None:
        if self._takes("["):
            self._array(path)
        elif self._takes("{"):
            while self._skip_blank() and not self._takes("}"):
                self._entry(path)
                self._skip_blank()
                self._takes(",")
        else:
            self._matched(_STRING) or self._matched(_SCALAR)

    def _array(self, path: KeyPath) -> None:
        index = 0
        while self._skip_blank() and not self._takes("]"):
            self.lines[(*path, index)] = self._line_here()
            self._value((*path, index))
            self._skip_blank()
            self._takes(",")
            index += 1

    def _keys(self) -> list[str]:
        keys: list[str] = []
        while True:
            self._skip_blank()
            quoted = self._matched(_STRING)
            keys.append(_unquoted(quoted) if quoted else self._matched(_BARE_KEY))
            self._skip_blank()
            if not self._takes("."):
                return keys

    def _skip_blank(self) -> bool:
        """Go to the next sign that is no space and no comment; False at the end."""
        self._matched(_BLANK)
        return self._at < len(self._text)

    def _takes(self, sign: str) -> bool:
        if not self._text.startswith(sign, self._at):
            return False
        self._at += len(sign)
        return True

    def _matched(self, pattern: re.Pattern[str]) -> str:
        found = pattern.match(self._text, self._at)
        if found is None:
            return ""
        self._at = found.end()
        return found.group()

    def _line_here(self) -> int:
        self._line += self._text.count("\n", self._counted_to, self._at)
        self._counted_to = self._at
        return self._line


def _unquoted(key: str) -> str:
    return str(tomllib.loads(f"key = {key}")["key"])
