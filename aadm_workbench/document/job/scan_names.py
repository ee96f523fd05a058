"""Which scans of a folder belong to which column, by their names alone; a person confirms it."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from aadm_workbench.scan.file import CLOUDS, DEPTH_MAPS, TABLES

_BARS = ("bar", "rebar", "steel", "dowel", "starter", "筋", "钢")
_SLEEVES = ("foot", "sleeve", "bottom", "socket", "套筒", "柱底", "柱脚")
_DEEPEST = 3  # folders: a day, a column, a scan
MOST_ENTRIES = 20_000
"""A shipment of two hundred columns with a dozen files a capture; what holds more is no folder of scans."""

_BEST_FIRST = (*(suffix for suffix in DEPTH_MAPS if suffix != ".png"), *CLOUDS, ".png", *TABLES)
"""Of files that differ in their ending alone one is the scan: a .png beside a .tiff is its grey picture."""

Found = tuple[tuple[Path, ...], tuple[Path, ...]]
"""Scans of the sleeves, scans of the rebars; several of one are several views."""


def guessed_kind(name: str) -> str:
    """``rebars`` or ``sleeves`` where a name says so; empty where it does not."""
    folded = _folded(name)
    if any(word in folded for word in _BARS):
        return "rebars"
    return "sleeves" if any(word in folded for word in _SLEEVES) else ""


def scans_by_name(folder: Path, columns: Mapping[str, Sequence[str]]) -> dict[str, Found]:
    """Scans of a folder and of the folders in it, for each column.

    Parameters
    ----------
    columns
        All names of each column, by its id. A name counts where it stands alone: ``C-30`` is not in ``C-301-foot``.

    Returns
    -------
    dict
        For each column its scans in the order of their names; a file that says neither sleeves nor rebars, or the name
        of several columns, is nobody's.
    """
    patterns = _patterns(columns)
    taken: dict[str, dict[str, dict[Path, Path]]] = {key: {"sleeves": {}, "rebars": {}} for key in columns}
    for path, is_capture in _candidates(folder, 0, [MOST_ENTRIES]):
        owners = _owners(path.relative_to(folder).as_posix(), patterns)
        kind = guessed_kind(path.name) or guessed_kind(path.parent.name if path.parent != folder else "")
        if len(owners) != 1 or not kind:
            continue
        same = taken[owners[0]][kind]
        stem = path if is_capture else path.with_suffix("")
        if stem not in same or _rank(path) < _rank(same[stem]):
            same[stem] = path
    return {key: (tuple(two["sleeves"].values()), tuple(two["rebars"].values())) for key, two in taken.items()}


def owners_of(name: str, columns: Mapping[str, Sequence[str]]) -> list[str]:
    """Ids of the columns that a name speaks of; ``columns`` as for :func:`scans_by_name`."""
    return _owners(name, _patterns(columns))


def _patterns(columns: Mapping[str, Sequence[str]]) -> dict[str, list[re.Pattern[str]]]:
    return {key: [_pattern(name) for name in names if name.strip()] for key, names in columns.items()}


def _owners(name: str, patterns: Mapping[str, Sequence[re.Pattern[str]]]) -> list[str]:
    said = _folded(name)
    return [key for key, known in patterns.items() if any(one.search(said) for one in known)]


def _candidates(folder: Path, depth: int, left: list[int]) -> Iterator[tuple[Path, bool]]:
    """Files of a scan's ending, and folders that are called like one scan: those are captures."""
    for path in sorted(folder.iterdir()):
        left[0] -= 1
        if left[0] < 0:
            return
        if path.name.startswith("."):
            continue
        if path.is_dir():
            if guessed_kind(path.name):
                yield path, True
            elif depth < _DEEPEST:
                yield from _candidates(path, depth + 1, left)
        elif path.suffix.lower() in _BEST_FIRST:
            yield path, False


def _rank(path: Path) -> int:
    return _BEST_FIRST.index(path.suffix.lower()) if path.suffix.lower() in _BEST_FIRST else -1


def _pattern(name: str) -> re.Pattern[str]:
    return re.compile(rf"(?<![a-z0-9]){re.escape(_folded(name))}(?![a-z0-9])")


def _folded(name: str) -> str:
    """Full-width letters and capitals make no difference, nor which dash or underscore stands between."""
    return re.sub(r"[\s_\-‐-―−]+", "-", unicodedata.normalize("NFKC", name).casefold())
