"""Choices that repeat: a random generator for things instead of numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

Thing = TypeVar("Thing")


class Dice:
    """Chooses among things; the same seed chooses the same."""

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng(seed)

    def choice(self, things: Sequence[Thing]) -> Thing:
        return things[self.below(len(things))]

    def below(self, limit: int) -> int:
        return int(self._rng.integers(max(1, limit)))

    def number(self) -> float:
        """From 0 to 1."""
        return float(self._rng.random())
