"""The pages of the documentation, taken apart: headings, links, code, names of files."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from urllib.parse import unquote

from markdown_it import MarkdownIt
from markdown_it.token import Token

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
LANGUAGES = {"en": (DOCS, ROOT / "README.md"), "zh": (DOCS / "zh", ROOT / "README.zh-CN.md")}
"""Folder of the pages and README of each language."""

_PARSER = MarkdownIt("commonmark").enable("table")


@dataclass(frozen=True)
class Code:
    """A fenced block of code: its language, its text and the line it begins in."""

    language: str
    text: str
    line: int


def pages(language: str) -> list[Path]:
    """The pages of one language, its README first."""
    folder, readme = LANGUAGES[language]
    return [readme, *sorted(folder.glob("*.md"))]


def other_pages() -> list[Path]:
    """What else people read: decisions, changelog, and READMEs beside what they explain."""
    beside = ("CHANGELOG.md", "samples/README.md", "benchmarks/README.md", "tests/fringe_scans/README.md")
    return [*sorted((DOCS / "decisions").glob("*.md")), *(ROOT / name for name in beside)]


def all_pages() -> list[Path]:
    return [*pages("en"), *pages("zh"), *other_pages()]


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def tokens(path: Path) -> Iterator[Token]:
    """All tokens of a page, those inside of lines too."""
    for token in _PARSER.parse(text_of(path)):
        yield token
        yield from token.children or ()


def codes(path: Path) -> list[Code]:
    return [
        Code(token.info.strip(), token.content, (token.map or [0])[0] + 1)
        for token in tokens(path)
        if token.type == "fence"
    ]


def inline_codes(path: Path) -> list[str]:
    return [token.content for token in tokens(path) if token.type == "code_inline"]


def links(path: Path) -> list[str]:
    """Where the links and pictures of a page lead."""
    found = [token.attrGet("href") or token.attrGet("src") for token in tokens(path) if token.type in _LINKS]
    return [unquote(str(one)) for one in found]


_LINKS = {"link_open", "image"}


def anchors(path: Path) -> set[str]:
    """The anchors of a page's headings, as repositories make them."""
    found: set[str] = set()
    parsed = _PARSER.parse(text_of(path))
    for token, inside in pairwise(parsed):
        if token.type == "heading_open":
            heading = "".join(part.content for part in inside.children or ())
            anchor = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
            found.add(anchor)
    return found
