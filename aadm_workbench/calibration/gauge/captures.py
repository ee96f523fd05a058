"""What repeat captures of the same columns measured, brought into the order of a gauge study.

A capture is one report on columns. Captures of one operator, or of one set-up or day, repeat each other. Points that
some capture lacks are left out, and said so: the analysis wants every part as often as every other.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from aadm_workbench.model import Array, ColumnReport, JobReport, Kind, Reason

QUANTITIES = ("sleeves", "rebars", "spacing", "pairs")
"""What is studied: centres after the fit to design, per axis; distances of neighbours; bars against sleeves, per axis,
where the trial of least squares has them."""

Part = tuple[str, str]
"""A column's id, and the label of a point, or of two."""


@dataclass(frozen=True, slots=True)
class Capture:
    """One capture: its name for people, who or what took it, and what it measured."""

    name: str
    operator: str
    report: JobReport


@dataclass(frozen=True, slots=True)
class Measured:
    """One part in one capture: ``values`` mm along one axis or two, and the stated standard uncertainty, mm."""

    values: tuple[float, ...]
    u_mm: float | None
    limit_mm: float | None


@dataclass(frozen=True, eq=False)
class Study:
    """The captures of one quantity, balanced.

    Parameters
    ----------
    values
        (axes, parts, operators, repeats) mm.
    u_mm
        (parts, operators, repeats) mm, as stated; NaN where nothing was.
    parts, operators
        Their names, in the order of the array.
    limit_mm
        What the quantity is judged against: a radius, or half of a range; None where nothing limits it.
    left_out
        Why points or captures are missing here.
    """

    quantity: str
    values: Array
    u_mm: Array
    parts: tuple[Part, ...]
    operators: tuple[str, ...]
    limit_mm: float | None
    left_out: tuple[str, ...] = field(default=())


def studies_of(captures: Sequence[Capture]) -> tuple[Study | Reason, ...]:
    """The study of each quantity that was measured, or why there can be none of it."""
    found = []
    for quantity in QUANTITIES:
        measured = [dict(_measured(capture.report, quantity)) for capture in captures]
        if any(measured):
            found.append(_balanced(quantity, captures, measured))
    return tuple(found)


def _balanced(
    quantity: str, captures: Sequence[Capture], measured: Sequence[Mapping[Part, Measured]]
) -> Study | Reason:
    groups: dict[str, list[Mapping[Part, Measured]]] = {}
    for capture, values in zip(captures, measured, strict=True):
        if values:
            groups.setdefault(capture.operator, []).append(values)
    repeats = min(map(len, groups.values()))
    if repeats < 2:
        return Reason("gauge.one_capture", quantity=quantity, operators=[one for one in groups if len(groups[one]) < 2])
    spare = sum(len(group) - repeats for group in groups.values())
    kept = [group[:repeats] for group in groups.values()]
    everywhere = [part for part in kept[0][0] if all(part in one for group in kept for one in group)]
    seen = {part for group in kept for one in group for part in one}
    left_out = [Reason("gauge.spare", count=spare)] if spare else []
    if missing := sorted(seen - {*everywhere}):
        names = [f"{column} {label}" for column, label in missing]
        left_out.append(Reason("gauge.not_everywhere", parts=names[:_SHOWN], count=len(names)))
    if len(everywhere) < 2:
        return Reason("gauge.few_parts", quantity=quantity)
    cells = [[[one[part] for one in group] for group in kept] for part in everywhere]
    lengths = np.array([[[one.values for one in group] for group in part] for part in cells])
    stated = [[[np.nan if one.u_mm is None else one.u_mm for one in group] for group in part] for part in cells]
    limits = [one.limit_mm for part in cells for group in part for one in group if one.limit_mm is not None]
    return Study(
        quantity,
        np.moveaxis(lengths, -1, 0),
        np.array(stated, dtype=np.float64),
        tuple(everywhere),
        tuple(groups),
        min(limits, default=None),
        tuple(left_out),
    )


_SHOWN = 12  # names of points that were left out: what a line holds


def _measured(report: JobReport, quantity: str) -> Iterator[tuple[Part, Measured]]:
    """Each part that a capture measured, where it is certain which part it is."""
    for column in report.columns:
        for label, measured in _of_column(column, quantity):
            yield (column.id, label), measured


def _of_column(column: ColumnReport, quantity: str) -> Iterator[tuple[str, Measured]]:
    certain = {kind: group for kind, group in column.groups.items() if group.fit and not _is_ambiguous(group.fit)}
    if quantity == "spacing":
        for group in certain.values():
            for span in group.spacing:
                if span.deviation_mm is not None:
                    limit = None if span.limit_mm is None else span.limit_mm[1]
                    yield " – ".join(span.between), Measured((span.deviation_mm,), span.u_mm, limit)
    elif quantity == "pairs":
        trial = column.trial_assembly
        if trial is not None and trial.least_squares is not None and len(certain) == len(Kind):
            for pair in trial.least_squares.pairs:
                yield f"{pair.rebar} – {pair.sleeve}", Measured(pair.offset_mm, pair.u_mm, pair.limit_mm)
    else:
        kind = Kind.SLEEVE if quantity == "sleeves" else Kind.REBAR
        for point in certain[kind].points if kind in certain else ():
            if point.offset_mm is not None:
                yield point.label, Measured(point.offset_mm, point.u_mm, point.limit_mm)


def _is_ambiguous(fit: object) -> bool:
    """Which point is which is not known: captures could be turned against each other."""
    return getattr(fit, "orientation", "") == "ambiguous"
