"""A column on a rope, steadied by tag lines: how it follows the crane, and swings about where it would hang at rest.

The law is that of a damped pendulum whose point of rest the crane moves: x'' + 2 z w x' + w² (x - e) = 0, in x, y and
turn, solved exactly while the crane stands or moves evenly. A robot's arm is the same without a swing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array


@dataclass
class HangingColumn:
    """Where a column is and how fast, (3,) each: x and y in mm, turn in radians; ``rest`` is where it would hang.

    ``periods_s`` (3,) are those of its swings, ``damping`` (3,) what tag lines take of them, as shares of what would
    bring it to rest without any swing: 0 for a free rope, below 1.
    """

    place: Array
    speed: Array
    rest: Array
    periods_s: Array
    damping: Array

    def advance(self, seconds: float, crane_speed: Array | float = 0.0) -> None:
        """Let time pass while the crane moves the point of rest evenly."""
        self.place, self.speed = self._after(seconds, np.broadcast_to(crane_speed, (3,)))
        self.rest = self.rest + np.broadcast_to(crane_speed, (3,)) * seconds

    def places(self, seconds: Array) -> Array:
        """Where it will be (n, 3) after so many seconds (n,), if nobody pushes."""
        return np.array([self._after(float(after), np.zeros(3))[0] for after in seconds])

    def _after(self, seconds: float, crane_speed: Array) -> tuple[Array, Array]:
        pace = 2.0 * np.pi / self.periods_s
        lag = 2.0 * self.damping * crane_speed / pace  # how far it hangs behind a crane that moves evenly
        apart, speed = self.place - self.rest + lag, self.speed - crane_speed
        swings = pace * np.sqrt(1.0 - self.damping**2)
        left = np.exp(-self.damping * pace * seconds)
        cosine, sine = np.cos(swings * seconds), np.sin(swings * seconds)
        beside = (speed + self.damping * pace * apart) / swings
        now = left * (apart * cosine + beside * sine)
        faster = left * (beside * swings * cosine - apart * swings * sine) - self.damping * pace * now
        return now + self.rest + crane_speed * seconds - lag, faster + crane_speed
