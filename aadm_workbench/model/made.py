"""A sequence whose items are made when they are asked for and kept by nobody: long ones in little memory."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Generic, TypeVar, overload

Item = TypeVar("Item")
Fact = TypeVar("Fact")


class Made(Sequence[Item], Generic[Item]):
    """So many items, each made by its place as often as it is asked for; what was found of all of them is kept."""

    def __init__(self, count: int, make: Callable[[int], Item]) -> None:
        self._count = count
        self._make = make
        self._facts: dict[Callable[[Item], Any], list[Any]] = {}

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[Item]:
        return map(self._make, range(self._count))

    @overload
    def __getitem__(self, place: int) -> Item: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[Item]: ...
    def __getitem__(self, place: int | slice) -> Item | Sequence[Item]:
        if isinstance(place, slice):
            return tuple(map(self._make, range(self._count)[place]))
        return self._make(range(self._count)[place])

    def changed(self, change: Callable[[int, Item], Item], at: Iterable[int] = ()) -> Made[Item]:
        """The items, each changed by its place and itself; what was found of them stays, but for the places ``at``."""
        items: Made[Item] = Made(self._count, lambda place: change(place, self._make(place)))
        items._facts = {fact: list(found) for fact, found in self._facts.items()}
        for place in at if items._facts else ():
            item = items[place]
            for fact, found in items._facts.items():
                found[place] = fact(item)
        return items

    def each(self, fact: Callable[[Item], Fact]) -> list[Fact]:
        """Something small of each item, found once."""
        self.learn(fact)
        return self._facts[fact]

    def learn(self, *facts: Callable[[Item], Any]) -> None:
        """Find several small things of each item, where they are not known: the items are made once for all of them."""
        missing: dict[Callable[[Item], Any], list[Any]] = {fact: [] for fact in facts if fact not in self._facts}
        if missing:
            for item in self:
                for fact, found in missing.items():
                    found.append(fact(item))
            self._facts |= missing


def changed(items: Sequence[Item], change: Callable[[int, Item], Item], at: Iterable[int] = ()) -> Sequence[Item]:
    """The items, each changed by its place and itself, as :meth:`Made.changed`; or all of them at once."""
    if isinstance(items, Made):
        return items.changed(change, at)
    return tuple(change(place, item) for place, item in enumerate(items))


def learn(items: Sequence[Item], *facts: Callable[[Item], Any]) -> None:
    """Find several small things of each item, as :meth:`Made.learn`; nothing of items that are at hand."""
    if isinstance(items, Made):
        items.learn(*facts)


def each(items: Sequence[Item], fact: Callable[[Item], Fact]) -> list[Fact]:
    """Something small of each item, as :meth:`Made.each`."""
    return items.each(fact) if isinstance(items, Made) else [fact(item) for item in items]
