"""How far the work has come, on stderr: a bar where a person watches, else a line for each step.

A check is also told to programs, as JSON lines: each is an object with ``event``: ``started``, ``column``, ``lost``,
``message``, ``interrupted`` or ``finished``.
"""

from __future__ import annotations

import json
import sys
from collections import deque
from collections.abc import Callable
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from time import monotonic
from typing import IO, Any

from aadm_workbench.errors import JobError
from aadm_workbench.model import Verdict
from aadm_workbench.model.reason import Language

from ..runner.engine import Death
from ..runner.record import Record
from ..runner.run import Follower
from .terminal import in_words, say

Step = Callable[[str], None]

_STEPS = 50  # columns: a mean of so many is steady, and follows what changes in an hour

STDOUT = "-"


class StepProgress(ExitStack):
    """Counts steps as they are finished; ``quiet`` shows nothing. ``doing`` is shown until the first one is."""

    def __init__(self, doing: str, *, quiet: bool, language: Language = "en") -> None:
        super().__init__()
        self._doing = doing
        self._quiet = quiet
        self._language = language
        self._say: Step = say

    def start(self, total: int) -> Step:
        """Begin to count; what is returned is to be called after each step with what it was."""
        if self._quiet:
            return lambda step: None
        return self._bar(total) if sys.stderr.isatty() else _lines(total, self._language)

    def message(self, text: str) -> None:
        """Show a line that is no step, above a bar where there is one."""
        if not self._quiet:
            self._say(text)

    def _bar(self, total: int) -> Step:
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

        bar = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TextColumn("{task.fields[pace]}", markup=False),
            console=Console(file=sys.stderr),
            transient=True,
            refresh_per_second=4,
        )
        self.enter_context(bar)
        self._say = partial(bar.console.print, markup=False, highlight=False)
        self.callback(setattr, self, "_say", say)
        task = bar.add_task(self._doing, total=total, pace="")
        pace = Pace(total)

        def finished(step: str) -> None:
            pace.step()
            bar.update(task, advance=1, description=step, pace=pace.in_words(self._language))

        return finished


class ColumnProgress(ExitStack):
    """Counts columns as they are finished, and those that failed or ended in an error; ``quiet`` shows nothing."""

    def __init__(self, *, quiet: bool, language: Language) -> None:
        super().__init__()
        self._language = language
        self._steps = self.enter_context(StepProgress(self._word("checking"), quiet=quiet, language=language))
        self._bad = {Verdict.FAIL: 0, Verdict.ERROR: 0}

    def start(self, total: int) -> Callable[[str, str, bool], None]:
        """Begin to count; what is returned takes a column's id, its verdict, and whether it was checked before."""
        finished = self._steps.start(total)

        def step(name: str, verdict: str, kept: bool) -> None:
            word = Verdict(verdict)
            if word in self._bad:
                self._bad[word] += 1
            colon = ": " if self._language == "en" else "："
            said = f"{name}{colon}{in_words(word, self._language)}"
            finished(f"{said}{self._word('kept') if kept else ''}{self._so_far()}")

        return step

    def message(self, text: str) -> None:
        """Show a line that is no column."""
        self._steps.message(text)

    def _so_far(self) -> str:
        bad = [(word.value, number) for word, number in self._bad.items() if number]
        said = [self._word(f"{word}{'s' * (number > 1)}", number=number) for word, number in bad]
        return self._word("so_far", said=(", " if self._language == "en" else "，").join(said)) if said else ""

    def _word(self, name: str, /, **values: object) -> str:
        return _worded(name, self._language, **values)


def _worded(name: str, language: Language, /, **values: object) -> str:
    from aadm_workbench.report.words.labels import phrase

    return phrase(f"progress.{name}", **values).in_language(language)


def _lines(total: int, language: Language) -> Step:
    pace = Pace(total)

    def finished(step: str) -> None:
        pace.step()
        ahead = pace.in_words(language)
        say(f"{pace.done}/{total} {step}{f' ({ahead})' if ahead else ''}")

    return finished


class Pace:
    """Counts steps of a known number."""

    def __init__(self, total: int) -> None:
        self.total = total
        self.done = 0
        self._ends: deque[float] = deque([monotonic()], maxlen=_STEPS + 1)

    def step(self) -> None:
        """Count one more."""
        self.done += 1
        self._ends.append(monotonic())

    def per_second(self) -> float | None:
        """Steps a second over the last of them; None before the first."""
        elapsed = self._ends[-1] - self._ends[0]
        return (len(self._ends) - 1) / elapsed if self.done and elapsed > 0.0 else None

    def seconds_left(self) -> float | None:
        """How long the rest takes at this pace; None before the first."""
        rate = self.per_second()
        return None if rate is None else (self.total - self.done) / rate

    def in_words(self, language: Language = "en") -> str:
        """``3.2/s, 1 min 22 s left``; empty before the first step and after the last."""
        rate, left = self.per_second(), self.seconds_left()
        if rate is None or left is None or self.done >= self.total:
            return ""
        each = _worded("each", language, seconds=f"{1.0 / rate:.1f}")
        speed = f"{rate:.1f}/s" if rate >= 1.0 else each
        return _worded("left", language, speed=speed, duration=duration(left))


def duration(seconds: float) -> str:
    """``45 s``, ``1 min 22 s``, ``2 h 05 min``."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


class ShownCheck(ExitStack, Follower):
    """Shows how a check goes, to a person unless ``quiet``, and to a program where there are ``events``."""

    def __init__(self, events: Events, *, quiet: bool, language: Language = "en") -> None:
        super().__init__()
        self._events = events
        self._language = language
        self._progress = self.enter_context(ColumnProgress(quiet=quiet, language=language))
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
        word = "lost_tried_again" if tries_left else "lost"
        self._progress.message(_worded(word, self._language, name=name, cause=death.cause))
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
                raise JobError.because("run.no_events", target=target, why=error.strerror) from error

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
