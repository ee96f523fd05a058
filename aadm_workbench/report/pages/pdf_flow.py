"""Blocks that follow each other down the pages of report.pdf: what goes on which page, and where it is cut.

Whatever the texts of others hold, it ends: what can be cut is cut, and what is higher than a page is made smaller.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Protocol


class Block(Protocol):
    """Something of a height, pt; ``keep`` holds it on the page of what follows, as headings are."""

    @property
    def height(self) -> float:
        """How much of a page it takes, pt."""
        ...

    @property
    def keep(self) -> bool:
        """Whether it stands on the page of what follows."""
        ...

    def split(self, room: float) -> tuple[Block, Block] | None:
        """What fits into that height, and the rest; None where it cannot be cut, or not so early."""
        ...

    def shrunk(self, height: float) -> Block:
        """The same, no higher than that."""
        ...

    def draw(self, canvas: Any, x: float, top: float) -> None:
        """Draw it with its upper left corner there."""
        ...


@dataclass(frozen=True)
class Placed:
    """A block, and how far below the head of its page it begins, pt."""

    block: Block
    below: float


Page = list[Placed]


def paginate(blocks: Iterable[Block], height: float) -> list[Page]:
    """The blocks on pages of a height, pt, from the head of the first one on."""
    rest = deque(blocks)
    pages: list[Page] = [[]]
    used = 0.0
    while rest:
        group = [rest.popleft()]
        while group[-1].keep and rest:
            group.append(rest.popleft())
        taken, back = _taken(group, height - used, height if used == 0.0 else None)
        for block in taken:
            pages[-1].append(Placed(block, used))
            used += block.height
        if back:
            rest.extendleft(reversed(back))
            pages.append([])
            used = 0.0
    return pages


def _taken(group: list[Block], room: float, page: float | None) -> tuple[list[Block], list[Block]]:
    """What of a group goes onto this page, what onto the next; ``page`` is the height of one that is still empty."""
    heads, last = group[:-1], group[-1]
    above = sum(block.height for block in heads)
    if above + last.height <= room:
        return group, []
    parts = last.split(room - above)
    if parts is not None:
        return [*heads, parts[0]], [parts[1]]
    if page is None:
        return [], group
    # Nothing will make more room: headings stand alone, and what is higher than a page is made smaller.
    if heads:
        return _taken(heads, room, page)[0], [*_taken(heads, room, page)[1], last]
    return [last.shrunk(page)], []


def height_of(page: Page) -> float:
    """How far down a page is filled, pt."""
    return max((placed.below + placed.block.height for placed in page), default=0.0)
