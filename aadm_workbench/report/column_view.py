"""What HTML and PDF show of a column alike: its facts, its sketches, its trial assembly and its notes."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from aadm_workbench.assembly.following import blame_of
from aadm_workbench.model import ColumnReport, Kind, TrialReport
from aadm_workbench.report.drawing.foot import FootSketch, foot_sketch, group_marks, pair_marks
from aadm_workbench.report.drawing.sketch import Circle, Label, Polyline, Shape, Sketch, rectangle
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.report.words.reasons import in_both_languages

DRAWN_DIAMETER_MM = {Kind.SLEEVE: 36.0, Kind.REBAR: 20.0}
"""Drawn where no diameter was measured."""


@dataclass(frozen=True)
class Titled:
    """A foot sketch with the name of its title and its caption; ``speaks`` where something in it is not a pass."""

    title: str
    caption: Phrase
    foot: FootSketch
    speaks: bool = True


def foot_sketches(column: ColumnReport, marked: Collection[str] = (), *, from_below: bool = False) -> Iterator[Titled]:
    """Sleeves, rebars and trial assembly seen from above, or from below, as far as there are such.

    ``marked`` labels are ringed.
    """
    blame = blame_of(column)
    shown = [
        (f"ui.sketch_{kind.plural}", group_marks(group, blame.follows), typical_diameter_mm(column, kind))
        for kind, group in column.groups.items()
    ]
    shown.append(("ui.sketch_pairs", pair_marks(column, blame.follows), typical_diameter_mm(column, Kind.SLEEVE)))
    for title, marks, diameter_mm in shown:
        if marks:
            foot = foot_sketch(marks, column.size_mm, diameter_mm, marked, from_below=from_below)
            because = blame.culprits if any(mark.follows for mark in marks) else ()
            speaks = any(mark.verdict not in ("pass", "not_assessed") and not mark.follows for mark in marks)
            yield Titled(title, _caption(foot, because), foot, speaks)


def typical_diameter_mm(column: ColumnReport, kind: Kind) -> float:
    """Median of the measured diameters, mm; what is drawn where none was measured."""
    found = sorted(point.diameter_mm for point in column.points(kind) if point.diameter_mm)
    return found[len(found) // 2] if found else DRAWN_DIAMETER_MM[kind]


def _caption(foot: FootSketch, because: tuple[str, ...]) -> Phrase:
    if foot.limit_mm is None:
        said = phrase("ui.arrows_no_limit", factor=foot.factor)
    else:
        said = phrase("ui.arrows", factor=foot.factor, limit=f"{foot.limit_mm:g}")
    if not because:
        return said
    follows = phrase("ui.follows_note", labels=", ".join(because))
    return Phrase(f"{said.en} {follows.en}", f"{said.zh}{follows.zh}")


def column_facts(column: ColumnReport) -> list[tuple[str, str]]:
    """What names a column, and where it stands: names of words, and values."""
    size = column.size_mm
    found = [
        ("ui.grid", column.grid),
        ("ui.storey", column.storey),
        ("ui.piece_mark", column.piece_mark),
        ("ui.size", None if size is None else f"{size[0]:g} × {size[1]:g} mm"),
        ("ui.global_id", column.global_id),
        ("ui.as_declared", declared_up(column)),
    ]
    return [(name, value) for name, value in found if value]


def declared_up(column: ColumnReport) -> str | None:
    """``up = +y`` where the names of points hang on what the job declares, for their pattern fits in several turns."""
    fits = {kind.plural: group.fit for kind, group in column.groups.items()}
    said = {name: fit.declared_up for name, fit in fits.items() if fit is not None and fit.declared_up}
    if not said:
        return None
    ups = list(dict.fromkeys(said.values()))
    return f"up = {ups[0]}" if len(ups) == 1 else ", ".join(f"{name}_up = {up}" for name, up in said.items())


def advice_notes(column: ColumnReport) -> list[Phrase]:
    """What stands behind an advice: how far bars are bent and who says so, and what their names hang on."""
    repair = column.repair
    if repair is None:
        return []
    notes = [in_both_languages(note) for note in repair.notes]
    if repair.adjustment_limit_mm:
        clause = in_both_languages(repair.clause)
        values = {"mm": f"{repair.adjustment_limit_mm:g}"}
        if repair.working_figure:
            notes.append(phrase("repair.reach_unverified", **values))
        else:
            said = phrase("repair.reach")
            notes.append(Phrase(said.en.format(clause=clause.en, **values), said.zh.format(clause=clause.zh, **values)))
    up = declared_up(column)
    if up is not None and repair.steps:
        notes.append(phrase("repair.symmetric", up=up))
    return notes


def trial_facts(trial: TrialReport) -> list[tuple[str, str]]:
    """Probability, margin, collisions and the like, as names of words and values."""
    found = []
    if trial.probability is not None:
        found.append(("ui.probability", f"{100.0 * trial.probability:.1f} %"))
    if trial.margin is not None:
        found.append(("ui.margin", f"{trial.margin:.2f}"))
    labels = (("ui.in_the_way", trial.in_the_way), ("ui.rescan", trial.rescan))
    found += [(name, ", ".join(named)) for name, named in labels if named]
    found.append(("ui.collisions", ", ".join(trial.collisions) or "0"))
    if trial.embedded_length_mm:
        found.append(("ui.embedded", f"{trial.embedded_length_mm:g} mm"))
    if trial.turn_deg or len(trial.turns) > 1:
        found.append(("ui.turn", f"{trial.turn_deg:g}°"))
    return found


def window_text(trial: TrialReport) -> str | None:
    """``dx -1.2 … +1.4 mm``, ``dy …`` and turn; None where no position meets all limits."""
    window = trial.window
    if window is None:
        return None
    parts = [("dx", window.dx_mm, "mm", 2), ("dy", window.dy_mm, "mm", 2), ("yaw", window.yaw_deg, "°", 3)]
    return ", ".join(f"{name} {low:+.{n}f} … {high:+.{n}f} {unit}" for name, (low, high), unit, n in parts)


def window_sketch(trial: TrialReport) -> Sketch | None:
    """The ranges of dx and dy as bars through the best position, and the range of the turn beside them.

    They are no rectangle: not every pair of a dx and a dy within them goes on.
    """
    window = trial.window
    if window is None:
        return None
    scale = 50.0 / max(*map(abs, (*window.dx_mm, *window.dy_mm)), 0.1)
    x, y = window.dx_mm, window.dy_mm
    middle = (130.0, 62.0)
    low = (middle[0] + x[0] * scale, middle[1] + y[0] * scale)
    high = (middle[0] + x[1] * scale, middle[1] + y[1] * scale)
    shapes: list[Shape] = [
        Polyline(((middle[0] - 62.0, middle[1]), (middle[0] + 62.0, middle[1])), "axis"),
        Polyline(((middle[0], 0.0), (middle[0], 124.0)), "axis"),
        rectangle((low[0], middle[1] - 2.5), (high[0], middle[1] + 2.5), "window"),
        rectangle((middle[0] - 2.5, low[1]), (middle[0] + 2.5, high[1]), "window"),
        Circle(middle, 2.0, "ink"),
        Label((high[0] + 3.0, middle[1] + 7.0), f"{x[1]:+.2f}", 8.0, anchor="start"),
        Label((low[0] - 3.0, middle[1] + 7.0), f"{x[0]:+.2f}", 8.0, anchor="end"),
        Label((middle[0] + 5.0, high[1] + 4.0), f"{y[1]:+.2f}", 8.0, anchor="start"),
        Label((middle[0] + 5.0, low[1] - 4.0), f"{y[0]:+.2f}", 8.0, anchor="start"),
        Label((205.0, 70.0), "dx, dy: mm", 8.0, "text-faint", "start"),
        Label((205.0, 56.0), f"yaw {window.yaw_deg[0]:+.3f}° … {window.yaw_deg[1]:+.3f}°", 8.0, anchor="start"),
    ]
    return Sketch(310.0, 124.0, tuple(shapes))


def column_notes(column: ColumnReport) -> list[str]:
    """The notes of a column, its groups and its trial, and what was found on its hoisting frames, each once."""
    notes = [note for part in column.parts for note in part.notes]
    notes += [finding.text for frame in column.hoisting for finding in frame.findings]
    return list(dict.fromkeys(notes))
