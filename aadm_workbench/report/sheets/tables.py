"""The tables of a report: one for each question. HTML, PDF, XLSX and CSV show the same rows.

A cell is None, a text, a verdict or a number (mm, degrees, shares of 1 as report.json has them); its heading says
which.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from aadm_workbench.report.clauses import clause_of
from aadm_workbench.report.read import Report
from aadm_workbench.report.shown_pose import shown_pose
from aadm_workbench.report.words.labels import Phrase, phrase

Cell: TypeAlias = str | float | int | None
Row: TypeAlias = tuple[Cell, ...]
CellKind: TypeAlias = Literal["text", "source", "verdict", "mm", "mm_fine", "deg", "share", "ratio", "count"]


@dataclass(frozen=True)
class Heading:
    """Name of a column of a table, unit included, and what its cells hold."""

    name: Phrase
    kind: CellKind

    def in_full(self) -> Phrase:
        """With the unit."""
        unit = _UNITS.get(self.kind, "")
        return Phrase(f"{self.name.en}{unit}", f"{self.name.zh}{unit}")


_UNITS = {"mm": ", mm", "mm_fine": ", mm", "deg": ", °"}


@dataclass(frozen=True)
class Table:
    """Rows under headings; ``name`` is a sheet's name."""

    name: Phrase
    headings: tuple[Heading, ...]
    rows: tuple[Row, ...]


def heading(word: str, kind: CellKind = "text") -> Heading:
    """A heading by the name of its word."""
    return Heading(phrase(f"ui.{word}"), kind)


def _design(axis: str) -> Heading:
    name = phrase("ui.design")
    return Heading(Phrase(f"{name.en} {axis}", f"{name.zh} {axis}"), "mm")


_LIMITED = (heading("u", "mm_fine"), heading("limit", "mm"), heading("clause"), heading("source", "source"))
_BETWEEN_LIMITS = (
    heading("u", "mm_fine"),
    heading("lower_limit", "mm"),
    heading("upper_limit", "mm"),
    heading("clause"),
    heading("source", "source"),
)
_OFFSET = (heading("offset_x", "mm"), heading("offset_y", "mm"))
POINTS = (
    heading("point"),
    _design("x"),
    _design("y"),
    *_OFFSET,
    heading("deviation", "mm"),
    *_LIMITED,
    heading("verdict", "verdict"),
    heading("diameter", "mm"),
    heading("tilt", "deg"),
    heading("exposed", "mm"),
    heading("reason"),
)
SPACING = (
    heading("between"),
    heading("design", "mm"),
    heading("measured", "mm"),
    heading("deviation", "mm"),
    *_BETWEEN_LIMITS,
    heading("verdict", "verdict"),
    heading("reason"),
)


def _by(word: str, item: str, kind: CellKind = "mm") -> Heading:
    pose, name = phrase(f"ui.{word}"), phrase(f"ui.{item}")
    return Heading(Phrase(f"{name.en} ({pose.en})", f"{name.zh}({pose.zh})"), kind)


PAIRS = (
    heading("pair"),
    *_OFFSET,
    _by("best", "distance"),
    _by("least_squares", "distance"),
    *_LIMITED,
    heading("room", "mm"),
    heading("verdict", "verdict"),
    _by("least_squares", "verdict", "verdict"),
    heading("reason"),
)
ABSOLUTE = (heading("point"), *_OFFSET, heading("deviation", "mm"), *_LIMITED, heading("verdict", "verdict"))
HOISTING = (
    heading("pair"),
    *_OFFSET,
    heading("distance", "mm"),
    *_LIMITED,
    heading("verdict", "verdict"),
    heading("seen"),
    heading("reason"),
)
RULES = (
    heading("rule"),
    heading("largest", "mm"),
    heading("verdict", "verdict"),
    heading("counted"),
    heading("clause"),
    heading("source", "source"),
    heading("reason"),
)
INPUTS = (heading("use"), heading("file"), heading("method"), heading("hash"))


def point_rows(report: Report, column: dict[str, Any], kind: str) -> Iterator[Row]:
    """Rows under :data:`POINTS` of ``sleeves`` or ``rebars``."""
    for point in (column[kind] or {}).get("points", ()):
        clause = clause_of(report, f"{kind[:-1]}_position", point["limit_mm"])
        yield (
            point["label"],
            *point["design_mm"][:2],
            *(point["offset_mm"] or (None, None)),
            point["deviation_mm"],
            point["u_mm"],
            point["limit_mm"],
            *clause,
            point["verdict"],
            point["diameter_mm"],
            point["axis_tilt_deg"],
            point.get("exposed_length_mm"),
            point["reason"],
        )


def spacing_rows(report: Report, column: dict[str, Any], kind: str) -> Iterator[Row]:
    """Rows under :data:`SPACING` of ``sleeves`` or ``rebars``."""
    for spacing in (column[kind] or {}).get("spacing", ()):
        lower, upper = spacing["limit_mm"] or (None, None)
        yield (
            "–".join(spacing["between"]),
            spacing["design_mm"],
            spacing["measured_mm"],
            spacing["deviation_mm"],
            spacing["u_mm"],
            lower,
            upper,
            *clause_of(report, f"{kind[:-1]}_spacing", upper),
            spacing["verdict"],
            spacing["reason"],
        )


def pair_rows(report: Report, column: dict[str, Any]) -> Iterator[Row]:
    """Rows under :data:`PAIRS`: the best pose, with least squares beside it."""
    trial = column["trial_assembly"] or {}
    squares = {(pair["sleeve"], pair["rebar"]): pair for pair in (trial.get("least_squares") or {}).get("pairs", ())}
    for pair in (shown_pose(trial) or {}).get("pairs", ()):
        other = squares.get((pair["sleeve"], pair["rebar"]), {})
        yield (
            f"{pair['sleeve']}/{pair['rebar']}",
            *pair["offset_mm"],
            pair["distance_mm"],
            other.get("distance_mm"),
            pair["u_mm"],
            pair["limit_mm"],
            *clause_of(report, "sleeve_rebar_distance", pair["limit_mm"]),
            pair["clearance_mm"],
            pair["verdict"],
            other.get("verdict"),
            pair["reason"],
        )
    for label in trial.get("missing", ()):
        yield (label, *(None,) * 9, "not_measured", None, "")


def absolute_rows(report: Report, column: dict[str, Any]) -> Iterator[Row]:
    """Rows under :data:`ABSOLUTE`: the group of bars first, then each bar."""
    absolute = (column["rebars"] or {}).get("absolute")
    if absolute is None:
        return
    for found in (absolute, *absolute["points"]):
        clause = clause_of(report, "group_position", found["limit_mm"])
        offset = found["offset_mm"] or (None, None)
        label = found.get("label", "")
        yield (label, *offset, found["deviation_mm"], found["u_mm"], found["limit_mm"], *clause, found["verdict"])


def hoisting_rows(report: Report, frame: dict[str, Any]) -> Iterator[Row]:
    """Rows under :data:`HOISTING` of one frame."""
    for pair in frame["pairs"]:
        limit_mm = pair.get("limit_mm")
        yield (
            f"{pair['sleeve']}/{pair['rebar']}",
            *(pair["offset_mm"] or (None, None)),
            pair["distance_mm"],
            pair["u_mm"],
            limit_mm,
            *clause_of(report, "sleeve_rebar_distance", limit_mm),
            pair.get("verdict"),
            "✓" if pair["seen"] else "",
            pair["reason"],
        )


def rule_rows(column: dict[str, Any]) -> Iterator[Row]:
    """Rows under :data:`RULES`: the rules of the column, of its groups and of its trial."""
    for part in (column, column["sleeves"], column["rebars"], column["trial_assembly"]):
        for rule in (part or {}).get("rules", ()):
            counted = "✓" if rule["counted"] else ""
            source = rule["source"]
            clause = rule["clause"].removesuffix(f", {source}")
            yield (rule["rule"], rule["worst_mm"], rule["verdict"], counted, clause, source, rule["reason"])


def input_rows(column: dict[str, Any]) -> Iterator[Row]:
    """Rows under :data:`INPUTS`: the scans of a column with their hashes."""
    for use in ("sleeves", "rebars"):
        group = column[use]
        if group is not None:
            yield (use, group["source"], group["method"], group["sha256"])
    for frame in column["hoisting"]:
        yield ("hoisting", frame["source"], frame.get("method", ""), frame.get("sha256", ""))


def narrowed(headings: Sequence[Heading], rows: Sequence[Row]) -> tuple[tuple[Heading, ...], list[Row]]:
    """Without the columns that are empty in every row."""
    used = [k for k in range(len(headings)) if any(row[k] not in (None, "") for row in rows)]
    return tuple(headings[k] for k in used), [tuple(row[k] for k in used) for row in rows]
