"""How long the stages of the work took; the only clock of an inspection."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from time import perf_counter

_DECIMALS = 4  # 0.1 ms


class Stopwatch:
    """Seconds spent in each stage, summed over all times it was entered."""

    def __init__(self) -> None:
        self._seconds: dict[str, float] = {}

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Count what happens inside towards a stage."""
        began = perf_counter()
        try:
            yield
        finally:
            self._seconds[name] = self._seconds.get(name, 0.0) + perf_counter() - began

    def seconds(self) -> dict[str, float]:
        """Seconds by stage, in the order in which the stages were first left."""
        return {name: round(value, _DECIMALS) for name, value in self._seconds.items()}
