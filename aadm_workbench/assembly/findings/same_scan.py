"""One scan named for two columns, or twice for one: by the hash of the file, whatever it is called."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from aadm_workbench.assembly.findings.hold import held_back
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.model import ColumnReport, Finding, GroupReport

_NAMED = 4  # more of them make no sentence


@dataclass(frozen=True)
class _Use:
    """One file of one group of one column."""

    column: int
    group: str
    source: str
    sha256: str


def with_same_scans(columns: Sequence[ColumnReport]) -> tuple[ColumnReport, ...]:
    """The columns of a job, each with a finding where a scan of it was used elsewhere too."""
    uses = [use for number, column in enumerate(columns) for use in _uses(number, column)]
    by_hash: dict[str, list[_Use]] = {}
    for use in uses:
        by_hash.setdefault(use.sha256, []).append(use)
    twice = {key: same for key, same in by_hash.items() if len(same) > 1}
    if not twice:
        return tuple(columns)
    return tuple(held_back(column, _findings(number, columns, twice)) for number, column in enumerate(columns))


def _listed(names: Sequence[str]) -> str:
    """The first of some columns, and how many more there are."""
    more = f", … (+{len(names) - _NAMED})" if len(names) > _NAMED else ""
    return ", ".join(names[:_NAMED]) + more


def _uses(number: int, column: ColumnReport) -> Iterator[_Use]:
    for name, group in (("sleeves", column.sleeves), ("rebars", column.rebars)):
        if isinstance(group, GroupReport):
            files = zip(group.source.split(", "), group.sha256.split(", "), strict=False)
            yield from (_Use(number, name, source, sha256) for source, sha256 in files if sha256)


def _findings(number: int, columns: Sequence[ColumnReport], twice: dict[str, list[_Use]]) -> list[Finding]:
    found = []
    for same in twice.values():
        own = [use for use in same if use.column == number]
        others = list(dict.fromkeys(columns[use.column].id for use in same if use.column != number))
        if own and others:
            use = own[0]
            found.append(
                make_finding(
                    "same_scan_twice.columns",
                    [use.group],
                    group=use.group,
                    source=use.source,
                    others=_listed(others),
                )
            )
        if len(own) > 1:
            about = list(dict.fromkeys(use.group for use in own))
            found.append(make_finding("same_scan_twice.column", about, source=own[0].source))
    return found
