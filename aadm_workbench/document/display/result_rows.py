"""The rows of the result table: every number that was compared with a limit, the worst first."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from aadm_workbench.model import WORST_FIRST, Kind, Verdict
from aadm_workbench.report.shown_pose import shown_pose

POSITION = "position"
SPACING = "spacing"
ABSOLUTE = "position in the building"
DISTANCE = "distance in the trial"

_ORDER = (*WORST_FIRST, Verdict.NOT_ASSESSED)


@dataclass(frozen=True)
class Row:
    """One comparison: ``place_mm`` (x, y) is its place on the foot, column frame; ``share`` of its limit, 1: at it."""

    name: str
    what: str
    value_mm: float | None
    signed: bool
    u_mm: float | None
    limit_mm: float | None
    share: float
    verdict: str
    clause: str
    reason: str
    place_mm: tuple[float, float] | None


def result_rows(found: Mapping[str, Any], trial: str = "minimax") -> list[Row]:
    """All rows of a column's entry in report.json, the worst first.

    Parameters
    ----------
    trial
        Distances of pairs are taken from the best pose (``minimax``) or ``least_squares``.
    """
    rows = [row for kind in Kind for row in _group_rows(found, kind)] + list(_pair_rows(found, trial))
    return sorted(rows, key=lambda row: (_ORDER.index(row.verdict) if row.verdict in _ORDER else 0, -row.share))


def only_what_fails(rows: Sequence[Row]) -> list[Row]:
    """Rows that are no pass, nor without a rule."""
    return [row for row in rows if row.verdict not in {"pass", "not_assessed"}]


def _group_rows(found: Mapping[str, Any], kind: Kind) -> Iterator[Row]:
    group = found.get(kind.plural) or {}
    clauses = {rule["rule"]: rule["clause"] for rule in group.get("rules") or ()}
    places = {point["label"]: _place(point) for point in group.get("points") or ()}
    for point in group.get("points") or ():
        yield _row(
            point["label"],
            POSITION,
            point.get("deviation_mm"),
            point,
            _clause(clauses, f"{kind.value}_position"),
            places[point["label"]],
        )
    for gap in group.get("spacing") or ():
        ends = [places.get(name) for name in gap["between"]]
        known = [place for place in ends if place is not None]
        middle = (sum(x for x, _ in known) / len(known), sum(y for _, y in known) / len(known)) if known else None
        name, clause = "–".join(gap["between"]), _clause(clauses, f"{kind.value}_spacing")
        yield _row(name, SPACING, gap.get("deviation_mm"), gap, clause, middle, signed=True)
    for point in (group.get("absolute") or {}).get("points") or ():
        place = places.get(point["label"])
        yield _row(point["label"], ABSOLUTE, point.get("deviation_mm"), point, "", place)


def _pair_rows(found: Mapping[str, Any], trial: str) -> Iterator[Row]:
    report = found.get("trial_assembly") or {}
    clauses = {rule["rule"]: rule["clause"] for rule in report.get("rules") or ()}
    places = {point["label"]: _place(point) for point in (found.get("sleeves") or {}).get("points") or ()}
    pose = report.get(trial) if trial == "least_squares" else shown_pose(report)
    for pair in (pose or {}).get("pairs") or ():
        name = f"{pair['sleeve']}–{pair['rebar']}"
        clause = _clause(clauses, "sleeve_rebar_distance")
        yield _row(name, DISTANCE, pair.get("distance_mm"), pair, clause, places.get(pair["sleeve"]))


def _row(
    name: str,
    what: str,
    value_mm: float | None,
    entry: Mapping[str, Any],
    clause: str,
    place_mm: tuple[float, float] | None,
    *,
    signed: bool = False,
) -> Row:
    written = entry.get("limit_mm")
    limit_mm = _limit(written, value_mm)
    share = 0.0 if value_mm is None or not limit_mm else abs(value_mm) / limit_mm
    reason, verdict = entry.get("reason") or "", str(entry["verdict"])
    return Row(name, what, value_mm, signed, entry.get("u_mm"), limit_mm, share, verdict, clause, reason, place_mm)


def _limit(written: Any, value_mm: float | None) -> float | None:
    """The limit on the side on which a value lies; report.json has one number, or a lower and an upper one."""
    if not isinstance(written, list):
        return written
    lower, upper = written
    return abs(lower) if value_mm is not None and value_mm < 0 and lower is not None else upper


def _clause(clauses: Mapping[str, str], rule: str) -> str:
    exact = clauses.get(rule)
    return exact or next((clause for name, clause in clauses.items() if name.startswith(rule)), "")


def _place(point: Mapping[str, Any]) -> tuple[float, float]:
    x, y = (point.get("aligned_mm") or point["design_mm"])[:2]
    return float(x), float(y)
