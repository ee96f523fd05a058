"""How fast work goes, and how long it will take: measured over the last steps, because columns differ."""

from __future__ import annotations

from collections import deque
from time import monotonic

_STEPS = 50  # columns: a mean of so many is steady, and follows what changes in an hour


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

    def in_words(self) -> str:
        """``3.2/s, 1 min 22 s left``; empty before the first step and after the last."""
        rate, left = self.per_second(), self.seconds_left()
        if rate is None or left is None or self.done >= self.total:
            return ""
        speed = f"{rate:.1f}/s" if rate >= 1.0 else f"{1.0 / rate:.1f} s each"
        return f"{speed}, {duration(left)} left"


def duration(seconds: float) -> str:
    """``45 s``, ``1 min 22 s``, ``2 h 05 min``."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"
