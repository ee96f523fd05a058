"""How far the work has come, on stderr: a bar where a person watches, else a line for each step."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import ExitStack

from aadm_workbench.model import ColumnReport

from .terminal import in_words, say


class StepProgress(ExitStack):
    """Counts steps as they are finished; ``quiet`` shows nothing. ``doing`` is shown until the first one is."""

    def __init__(self, doing: str, *, quiet: bool) -> None:
        super().__init__()
        self._doing = doing
        self._quiet = quiet

    def start(self, total: int) -> Callable[[str], None]:
        """Begin to count; what is returned is to be called after each step with what it was."""
        if self._quiet:
            return lambda step: None
        return self._bar(total) if sys.stderr.isatty() else _lines(total)

    def _bar(self, total: int) -> Callable[[str], None]:
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
        task = bar.add_task(self._doing, total=total)
        return lambda step: bar.update(task, advance=1, description=step)


class ColumnProgress(ExitStack):
    """Counts columns as they are finished; ``quiet`` shows nothing."""

    def __init__(self, *, quiet: bool) -> None:
        super().__init__()
        self._steps = self.enter_context(StepProgress("checking", quiet=quiet))

    def start(self, total: int) -> Callable[[ColumnReport], None]:
        """Begin to count; what is returned is to be called with each finished column."""
        finished = self._steps.start(total)
        return lambda column: finished(f"{column.id}: {in_words(column.verdict)}")


def _lines(total: int) -> Callable[[str], None]:
    count = 0

    def finished(step: str) -> None:
        nonlocal count
        count += 1
        say(f"{count}/{total} {step}")

    return finished
