"""The drawing of the house in docs/architecture.md shows what the files import, and nothing else."""

import ast
import re
from pathlib import Path, PurePosixPath

from tests.test_architecture import NOUNS, PACKAGE, imports

from .pages import DOCS, ROOT, codes

NAMES_OF_BATCH = {"batch", "aadm_batch"}


def room_of(parts: tuple[str, ...]) -> str:
    """The room of a module or of an imported name; "" for what belongs to none."""
    if parts[0] in NAMES_OF_BATCH:
        return "batch"
    room = parts[1].removesuffix(".py") if parts[0] == PACKAGE and len(parts) > 1 else ""
    return "" if room in NOUNS or room.startswith("__") else room


def imported() -> set[tuple[str, str]]:
    """Which room is imported by which, read off all files."""
    found = set()
    for folder in (PACKAGE, "batch"):
        for module in (ROOT / folder).rglob("*.py"):
            path = PurePosixPath(module.relative_to(ROOT).as_posix())
            names = {name for _, name in imports(path, ast.parse(module.read_text(encoding="utf-8")))}
            found |= {(room_of(tuple(name.split("."))), room_of(path.parts)) for name in names}
    return {(source, target) for source, target in found if source and target and source != target}


def drawn(page: Path) -> set[tuple[str, str]]:
    """The arrows of the first drawing of a page: ``a & b --> c & d`` is four."""
    (drawing,) = [code.text for code in codes(page) if code.language == "mermaid"]
    arrows = set()
    for line in drawing.splitlines():
        if "-->" in line:
            sources, targets = (re.findall(r"\w+", side) for side in line.split("-->"))
            arrows |= {(source, target) for source in sources for target in targets}
    return arrows


def test_the_house_is_drawn_as_it_is_built() -> None:
    built, shown = imported(), drawn(DOCS / "architecture.md")
    assert built - shown == set(), "imports that the drawing lacks"
    assert shown - built == set(), "arrows that no import has"
