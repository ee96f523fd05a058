"""Who follows a check: a person at a terminal or with a log, and a program that reads events."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import IO, Any

from aadm_workbench.errors import JobError

from ..runner.engine import Death
from ..runner.record import Record
from ..runner.run import Follower
from .progress import ColumnProgress, Pace

STDOUT = "-"


class ShownCheck(ExitStack, Follower):
    """Shows how a check goes, to a person unless ``quiet``, and to a program where there are ``events``."""

    def __init__(self, events: Events, *, quiet: bool) -> None:
        super().__init__()
        self._events = events
        self._progress = self.enter_context(ColumnProgress(quiet=quiet))
        self._step: Callable[[str, str, bool], None] = lambda name, verdict, kept: None
        self._pace = Pace(0)
        self._verdicts: dict[str, int] = {}

    def started(self, total: int) -> None:
        """So many columns are to be checked."""
        self._step, self._pace = self._progress.start(total), Pace(total)
        self._events.send("started", columns=total)

    def column(self, record: Record, kept: bool) -> None:
        """A column is finished, or its kept result still holds."""
        self._pace.step()
        self._verdicts[record.verdict] = self._verdicts.get(record.verdict, 0) + 1
        self._step(record.id, record.verdict, kept)
        self._events.send(
            "column",
            id=record.id,
            verdict=record.verdict,
            goes_on=record.goes_on,
            kept=kept,
            seconds=record.seconds.get("total"),
            done=self._pace.done,
            columns=self._pace.total,
            so_far=self._verdicts,
            per_second=_rounded(self._pace.per_second()),
            seconds_left=_rounded(self._pace.seconds_left()),
        )

    def lost(self, name: str, death: Death, tries_left: int) -> None:
        """The process that checked a column died."""
        then = "it is tried again later" if tries_left else "it is given up"
        self._progress.message(f"{name}: the process that checked it was {death.cause}; {then}")
        self._events.send("lost", id=name, cause=death.cause, last_words=death.last_words, tries_left=tries_left)

    def message(self, text: str) -> None:
        """Something that a person should know."""
        self._progress.message(text)
        self._events.send("message", text=text)

    @property
    def done(self) -> int:
        """How many columns are finished."""
        return self._pace.done

    @property
    def total(self) -> int:
        """How many columns there are."""
        return self._pace.total


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 3)


class Events:
    """A stream of events, into a file or, for ``-``, to stdout; None is for nobody.

    Raises
    ------
    JobError
        Where the file cannot be opened.
    """

    def __init__(self, target: str | None) -> None:
        self._stream: IO[str] | None = None
        self._is_own = target not in (None, STDOUT)
        if target == STDOUT:
            self._stream = sys.stdout
        elif target is not None:
            try:
                self._stream = Path(target).open("a", encoding="utf-8", errors="replace", buffering=1)  # noqa: SIM115
            except OSError as error:
                raise JobError(f"{target}: events cannot be written there ({error.strerror})") from error

    def send(self, event: str, **what: Any) -> None:
        """Write one event; a reader that has gone away is no reason to stop."""
        if self._stream is None:
            return
        try:
            self._stream.write(json.dumps({"event": event, **what}, ensure_ascii=False, default=str) + "\n")
            self._stream.flush()
        except (OSError, ValueError):
            self._stream = None

    def close(self) -> None:
        """Let go of the file."""
        if self._is_own and self._stream is not None:
            with suppress(OSError):
                self._stream.close()
        self._stream = None
