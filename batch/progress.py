"""How far a check has come, on stderr: a bar where a person watches, else a line for each column."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import ExitStack

from aadm_workbench.model import ColumnReport

from .terminal import in_words, say


class ColumnProgress(ExitStack):
    """Counts columns as they are finished; ``quiet`` shows nothing."""

    def __init__(self, *, quiet: bool) -> None:
        super().__init__()
        self._quiet = quiet

    def start(self, total: int) -> Callable[[ColumnReport], None]:
        """Begin to count; what is returned is to be called with each finished column."""
        if self._quiet:
            return lambda column: None
        return self._bar(total) if sys.stderr.isatty() else _lines(total)

    def _bar(self, total: int) -> Callable[[ColumnReport], None]:
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

        bar = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            console=Console(file=sys.stderr),
            transient=True,
        )
        self.enter_context(bar)
        task = bar.add_task("checking", total=total)

        def finished(column: ColumnReport) -> None:
            bar.update(task, advance=1, description=f"{column.id}: {in_words(column.verdict)}")

        return finished


def _lines(total: int) -> Callable[[ColumnReport], None]:
    count = 0

    def finished(column: ColumnReport) -> None:
        nonlocal count
        count += 1
        say(f"{count}/{total} {column.id}: {in_words(column.verdict)}")

    return finished
