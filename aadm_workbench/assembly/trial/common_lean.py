"""A lean that all bars, or all sleeves, share: theirs, or that of what was taken for the vertical.

A floor that slopes by a degree, taken as level, makes every bar lean alike; a camera whose principal point is off makes
every sleeve lean alike. Twelve axes that agree against the vertical are evidence too, and which of the two is right the
scan does not say. So the trial is made both ways, and only what both come to is decided.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.model import Array, Reason

_FEWEST = 4
"""With fewer axes, that they agree says little."""

_SIGMAS = 5.0
"""A common lean counts where it is so many times what the scatter of the axes lets their mean be off by chance."""

_SMALLEST_RAD = math.radians(0.15)
"""Half of the usual lean of a single bar: less in common decides nothing over an embedded length."""


@dataclass(frozen=True, eq=False)
class CommonLean:
    """How far all ``bars`` and all ``sleeves`` move together over the embedded length, (2,) mm each; zero for none."""

    bars: Array
    sleeves: Array

    def __bool__(self) -> bool:
        return bool(self.bars.any() or self.sleeves.any())

    def taken_off(self, pairs: Sequence[Pair]) -> tuple[Pair, ...]:
        """The pairs with their axes against the mean of all, and not against the vertical of the scans."""
        return tuple(
            replace(pair, bar_shift=pair.bar_shift - self.bars, sleeve_shift=pair.sleeve_shift - self.sleeves)
            for pair in pairs
        )

    def in_words(self, length_mm: float) -> str:
        """``all bars lean alike by 0.8°``, with what it may mean."""
        found = [
            Reason(
                "assembly.lean_alike", name=name, lean_deg=math.degrees(math.atan2(float(np.hypot(*shift)), length_mm))
            )
            for name, shift in (("bars", self.bars), ("sleeves", self.sleeves))
            if shift.any()
        ]
        return Reason("assembly.common_lean", found=found)


def common_lean(pairs: Sequence[Pair], length_mm: float) -> CommonLean:
    """The lean that the axes share, as far as it is no chance; parameters in mm over the embedded length."""
    return CommonLean(
        _shared(np.array([pair.bar_shift for pair in pairs]), length_mm),
        _shared(np.array([pair.sleeve_shift for pair in pairs]), length_mm),
    )


def _shared(shifts: Array, length_mm: float) -> Array:
    if len(shifts) < _FEWEST:
        return np.zeros(2)
    middle = np.median(shifts, axis=0)
    # Of the median, from the median of the absolute deviations: 1.4826 makes it a standard deviation, 1.2533 is the
    # median's own.
    scatter_mm = 1.4826 * float(np.median(np.abs(shifts - middle)))
    chance_mm = 1.2533 * scatter_mm / math.sqrt(len(shifts))
    length = float(np.hypot(*middle))
    counts = length > max(_SIGMAS * chance_mm, math.tan(_SMALLEST_RAD) * length_mm)
    return np.asarray(middle) if counts else np.zeros(2)
