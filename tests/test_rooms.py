"""The rooms of the house: none too full, none too long, and no circle between files or between rooms."""

import ast
from collections import Counter
from graphlib import CycleError, TopologicalSorter
from pathlib import Path, PurePosixPath

from tests.test_architecture import PACKAGE, ROOT, imports, modules

FULLEST_ROOM = 25  # what one screen of a file list shows
NAMES_OF_BATCH = {"batch", "aadm_batch"}


def parts_of(module: Path) -> tuple[str, ...]:
    """Dotted name of a module, in parts; a package is called by its folder."""
    parts = module.relative_to(ROOT).with_suffix("").parts
    return parts[:-1] if parts[-1] == "__init__" else parts


def built() -> dict[tuple[str, ...], set[tuple[str, ...]]]:
    """Which module of the product imports which, anywhere in it."""
    ours = {parts_of(module): module for module in modules() if module.relative_to(ROOT).parts[0] in {PACKAGE, "batch"}}
    found: dict[tuple[str, ...], set[tuple[str, ...]]] = {}
    for name, module in ours.items():
        path = PurePosixPath(module.relative_to(ROOT).as_posix())
        targets = [tuple(target.split(".")) for _, target in imports(path, ast.parse(module.read_text("utf-8")))]
        targets = [("batch", *target[1:]) if target[0] in NAMES_OF_BATCH else target for target in targets]
        # a name that is no module is something in one; packages hold docstrings alone
        known = {target if target in ours else target[:-1] for target in targets}
        found[name] = {target for target in known & set(ours) if ours[target].name != "__init__.py"} - {name}
    assert sum(map(len, found.values())) > len(found), "nothing was looked at"
    return found


def circle_in(graph: dict[tuple[str, ...], set[tuple[str, ...]]]) -> list[tuple[str, ...]]:
    """A circle of a graph, or nothing."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_no_circle_of_files() -> None:
    assert circle_in(built()) == []


def test_no_circle_of_rooms() -> None:
    rooms: dict[tuple[str, ...], set[tuple[str, ...]]] = {}
    for name, targets in built().items():
        if len(name) > 2 or name[0] == "batch":  # files at the root of the package join the rooms
            here = name[:2] if name[0] == PACKAGE else name[:1]
            there = {target[:2] if target[0] == PACKAGE else target[:1] for target in targets if len(target) > 2}
            rooms.setdefault(here, set()).update(there - {here})
    assert circle_in(rooms) == []


def test_a_circle_is_noticed() -> None:
    assert circle_in({("a",): {("b",)}, ("b",): {("c",)}, ("c",): {("a",)}})
    assert circle_in({("a",): {("b",), ("c",)}, ("b",): {("c",)}}) == []


def test_no_room_is_too_full() -> None:
    full = Counter(module.parent.relative_to(ROOT).as_posix() for module in modules())
    assert {room: count for room, count in full.items() if count > FULLEST_ROOM} == {}
