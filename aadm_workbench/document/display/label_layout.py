"""Where labels go on the screen so that none covers another: the most important first, beside its point or nowhere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

Box = tuple[float, float, float, float]
"""Left, bottom, right, top, in pixels."""

_GAP_PX = 4.0  # plates of labels do not touch
# right and up: beside a point is read first, above and below last
_SIDES = ((1, 0), (1, 1), (1, -1), (-1, 0), (-1, 1), (-1, -1), (0, 1), (0, -1))
_REACHES_PX = (10.0, 30.0, 48.0)  # beside the mark, then clear of one label, then of two


@dataclass(frozen=True)
class Wanted:
    """A label: its point on the screen, its size, all in pixels; the smallest ``rank`` is placed first."""

    x: float
    y: float
    width: float
    height: float
    rank: int


def place_labels(labels: Sequence[Wanted], screen: tuple[float, float]) -> list[Box | None]:
    """A box for each label, none overlapping another or leaving the screen; None for those that find no room.

    Parameters
    ----------
    screen
        Width and height, pixels; y goes up.
    """
    boxes: list[Box | None] = [None] * len(labels)
    taken: list[Box] = []
    for index in sorted(range(len(labels)), key=lambda number: (labels[number].rank, number)):
        label = labels[index]
        if not (0 <= label.x <= screen[0] and 0 <= label.y <= screen[1]):
            continue
        box = next((one for one in _candidates(label) if _inside(one, screen) and _is_free(one, taken)), None)
        if box is not None:
            boxes[index] = box
            taken.append(box)
    return boxes


def _candidates(label: Wanted) -> list[Box]:
    found = []
    for reach in _REACHES_PX:
        for right, up in _SIDES:
            left = label.x + (reach if right > 0 else -reach - label.width if right < 0 else -label.width / 2)
            bottom = label.y + (reach if up > 0 else -reach - label.height if up < 0 else -label.height / 2)
            found.append((left, bottom, left + label.width, bottom + label.height))
    return found


def _inside(box: Box, screen: tuple[float, float]) -> bool:
    return box[0] >= 0 and box[1] >= 0 and box[2] <= screen[0] and box[3] <= screen[1]


def _is_free(box: Box, taken: Sequence[Box]) -> bool:
    return not any(overlap(box, other, _GAP_PX) for other in taken)


def overlap(one: Box, other: Box, gap: float = 0.0) -> bool:
    """Whether two boxes come closer than a gap, in pixels."""
    return one[0] < other[2] + gap and other[0] < one[2] + gap and one[1] < other[3] + gap and other[1] < one[3] + gap
