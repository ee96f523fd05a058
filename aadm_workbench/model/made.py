"""A sequence whose items are made when they are asked for and kept by nobody: long ones in little memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, Generic, TypeVar, overload

Item = TypeVar("Item")
Fact = TypeVar("Fact")


class Made(Sequence[Item], Generic[Item]):
    """So many items, each made by its place as often as it is asked for; what was found of all of them is kept."""

    def __init__(self, count: int, make: Callable[[int], Item], facts: dict[object, list[Any]] | None = None) -> None:
        self._count = count
        self._make = make
        self._facts: dict[object, list[Any]] = {} if facts is None else facts

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

    def changed(self, change: Callable[[int, Item], Item], *, keeps_facts: bool) -> Made[Item]:
        """The items, each changed by its place and itself; facts stay what they are where ``change`` leaves them."""
        facts = self._facts if keeps_facts else None
        return Made(self._count, lambda place: change(place, self._make(place)), facts)

    def each(self, fact: Callable[[Item], Fact]) -> list[Fact]:
        """Something small of each item, found once."""
        if fact not in self._facts:
            self._facts[fact] = [fact(item) for item in self]
        return self._facts[fact]


def changed(items: Sequence[Item], change: Callable[[int, Item], Item], *, keeps_facts: bool = False) -> Sequence[Item]:
    """The items, each changed by its place and itself, as :meth:`Made.changed`; or all of them at once."""
    if isinstance(items, Made):
        return items.changed(change, keeps_facts=keeps_facts)
    return tuple(change(place, item) for place, item in enumerate(items))


def each(items: Sequence[Item], fact: Callable[[Item], Fact]) -> list[Fact]:
    """Something small of each item, as :meth:`Made.each`."""
    return items.each(fact) if isinstance(items, Made) else [fact(item) for item in items]
