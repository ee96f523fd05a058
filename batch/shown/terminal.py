"""What the command shows: tables on stdout, messages on stderr, colour only where a person looks at it.

Every verdict is a word and a sign, so that nothing depends on colour. Where stdout is a file or a pipe each row is one
line, as long as it needs to be.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

from aadm_workbench.model import Verdict
from aadm_workbench.model.reason import Language, sentence

from ..switches import printable

if TYPE_CHECKING:  # tables and colours are loaded by who shows some: a line on stderr needs none
    from rich.console import Console, ConsoleOptions, RenderableType
    from rich.segment import Segment
    from rich.table import Table
    from rich.text import Text

STYLE = {
    Verdict.PASS: ("✓", "green"),
    Verdict.FAIL: ("✗", "bold red"),
    Verdict.INCONCLUSIVE: ("?", "yellow"),
    Verdict.NOT_MEASURED: ("-", "yellow"),
    Verdict.ERROR: ("!", "bold magenta"),
    Verdict.NOT_ASSESSED: ("", "dim"),
}
"""Sign and colour of each verdict."""

_UNBOUNDED = 100_000
"""Width in characters of what is no terminal: no line is ever broken."""


def verdict_text(verdict: Verdict, language: Language = "en") -> Text:
    """A verdict as people read it: sign, word, colour."""
    from rich.text import Text

    sign, style = STYLE[verdict]
    return Text(f"{sign} {in_words(verdict, language)}".strip(), style=style)


def in_words(verdict: Verdict, language: Language = "en") -> str:
    """``not measured``, 未测得."""
    return verdict.value.replace("_", " ") if language == "en" else sentence(f"words.{verdict.value}").zh


def new_table(*headings: str, numbers: tuple[str, ...] = (), title: str | None = None) -> Table:
    """An empty table; columns of ``numbers`` are set flush right."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    plain = not sys.stdout.isatty()
    table = Table(
        box=None if plain else SIMPLE_HEAD, title=title, title_justify="left", title_style="bold", pad_edge=False
    )
    for heading in headings:
        table.add_column(heading, justify="right" if heading in numbers else "left", no_wrap=plain)
    return table


def show(*parts: Table | Text | str) -> None:
    """Write tables and lines to stdout."""
    from rich.table import Table
    from rich.text import Text

    console = _console(sys.stdout.isatty())
    try:
        with console.capture() as capture:
            for part in parts:
                console.print(Text(part) if isinstance(part, str) else part, soft_wrap=not isinstance(part, Table))
        # What fills a row up to the width of its table is of no use to the next program.
        sys.stdout.write("".join(f"{line.rstrip()}\n" for line in capture.get().splitlines()))
        sys.stdout.flush()
    except BrokenPipeError:
        _give_up_stdout()


def show_json(content: bytes) -> None:
    """Write a JSON document to stdout, in UTF-8 whatever the terminal speaks."""
    try:
        sys.stdout.flush()
        sys.stdout.buffer.write(content)
        sys.stdout.buffer.flush()
    except BrokenPipeError:
        _give_up_stdout()


def say(message: str) -> None:
    """Write one message to stderr."""
    sys.stderr.write(f"{printable(message)}\n")
    sys.stderr.flush()


def _console(is_terminal: bool) -> Console:
    from rich.console import Console
    from rich.segment import Segment

    class PlainSpeaking(Console):
        """A console in which what is shown cannot steer the terminal: names come from the files of others."""

        def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterator[Segment]:
            """Render as any console, with control characters spelt out."""
            for segment in super().render(renderable, options):
                yield segment if segment.control else Segment(printable(segment.text), segment.style)

    return PlainSpeaking(
        file=sys.stdout, width=None if is_terminal else _UNBOUNDED, highlight=False, markup=False, emoji=False
    )


def _give_up_stdout() -> None:
    """Whoever read it has read enough (``aadm design ... | head``): what is still buffered goes nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
