"""What HTML and PDF show of a column alike: its facts, its sketches, its trial assembly and its notes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from aadm_workbench.report.drawing.foot import FootSketch, foot_sketch, group_marks, pair_marks
from aadm_workbench.report.drawing.sketch import Circle, Label, Polyline, Shape, Sketch, rectangle
from aadm_workbench.report.shown_pose import shown_pose
from aadm_workbench.report.words.labels import Phrase, phrase

BAR_DIAMETER_MM, SLEEVE_DIAMETER_MM = 20.0, 36.0
"""Drawn where no diameter was measured."""


@dataclass(frozen=True)
class Titled:
    """A foot sketch with the name of its title and its caption."""

    title: str
    caption: Phrase
    foot: FootSketch


def foot_sketches(column: dict[str, Any]) -> Iterator[Titled]:
    """Sleeves, rebars and trial assembly seen from above, those of them that there are."""
    for kind, nominal_mm in (("sleeves", SLEEVE_DIAMETER_MM), ("rebars", BAR_DIAMETER_MM)):
        group = column[kind]
        if group is not None and group["points"]:
            diameter_mm = typical_diameter_mm(group["points"]) or nominal_mm
            foot = foot_sketch(group_marks(group), column["size_mm"], diameter_mm)
            yield Titled(f"ui.sketch_{kind}", _caption(foot), foot)
    pose = shown_pose(column["trial_assembly"])
    if pose is not None:
        diameter_mm = typical_diameter_mm((column["sleeves"] or {}).get("points", [])) or SLEEVE_DIAMETER_MM
        marks = pair_marks(column, pose["pairs"])
        if marks:
            foot = foot_sketch(marks, column["size_mm"], diameter_mm)
            yield Titled("ui.sketch_pairs", _caption(foot), foot)


def typical_diameter_mm(points: list[dict[str, Any]]) -> float | None:
    """Median of the measured diameters, mm; None where none was measured."""
    found = sorted(point["diameter_mm"] for point in points if point["diameter_mm"])
    return found[len(found) // 2] if found else None


def _caption(foot: FootSketch) -> Phrase:
    if foot.limit_mm is None:
        return phrase("ui.arrows_no_limit", factor=foot.factor)
    return phrase("ui.arrows", factor=foot.factor, limit=f"{foot.limit_mm:g}")


def column_facts(column: dict[str, Any]) -> list[tuple[str, str]]:
    """What names a column, and where it stands: names of words, and values."""
    size = column["size_mm"]
    found = [
        ("ui.grid", column["grid"]),
        ("ui.storey", column["storey"]),
        ("ui.piece_mark", column["piece_mark"]),
        ("ui.size", None if size is None else f"{size[0]:g} × {size[1]:g} mm"),
        ("ui.global_id", column["global_id"]),
        ("ui.as_declared", declared_up(column)),
    ]
    return [(name, value) for name, value in found if value]


def declared_up(column: dict[str, Any]) -> str | None:
    """``up = +y`` where the names of points hang on what the job declares, for their pattern fits in several turns."""
    fits = {kind: (column[kind] or {}).get("fit") or {} for kind in ("sleeves", "rebars")}
    said = {kind: fit["declared_up"] for kind, fit in fits.items() if fit.get("declared_up")}
    if not said:
        return None
    ups = list(dict.fromkeys(said.values()))
    return f"up = {ups[0]}" if len(ups) == 1 else ", ".join(f"{kind}_up = {up}" for kind, up in said.items())


def trial_facts(trial: dict[str, Any]) -> list[tuple[str, str]]:
    """Probability, margin, collisions and the like, as names of words and values."""
    found = []
    if trial.get("probability") is not None:
        found.append(("ui.probability", f"{100.0 * trial['probability']:.1f} %"))
    if trial.get("margin") is not None:
        found.append(("ui.margin", f"{trial['margin']:.2f}"))
    found += [(f"ui.{key}", ", ".join(trial[key])) for key in ("in_the_way", "rescan") if trial.get(key)]
    found.append(("ui.collisions", ", ".join(trial["collisions"]) or "0"))
    if trial.get("embedded_length_mm"):
        found.append(("ui.embedded", f"{trial['embedded_length_mm']:g} mm"))
    if trial.get("turn_deg") or len(trial.get("turns", ())) > 1:
        found.append(("ui.turn", f"{trial.get('turn_deg', 0.0):g}°"))
    return found


def window_text(trial: dict[str, Any]) -> str | None:
    """``dx -1.2 … +1.4 mm``, ``dy …`` and turn; None where no position meets all limits."""
    window = trial.get("window")
    if window is None:
        return None
    parts = [(name, window[f"{name}_mm"], "mm", 2) for name in ("dx", "dy")] + [("yaw", window["yaw_deg"], "°", 3)]
    return ", ".join(f"{name} {low:+.{n}f} … {high:+.{n}f} {unit}" for name, (low, high), unit, n in parts)


def window_sketch(trial: dict[str, Any]) -> Sketch | None:
    """The ranges of dx and dy as bars through the best position, and the range of the turn beside them.

    They are no rectangle: not every pair of a dx and a dy within them goes on.
    """
    window = trial.get("window")
    if window is None:
        return None
    ends = [abs(value) for name in ("dx_mm", "dy_mm") for value in window[name]]
    scale = 50.0 / max(*ends, 0.1)
    x, y = window["dx_mm"], window["dy_mm"]
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
        Label((205.0, 56.0), f"yaw {window['yaw_deg'][0]:+.3f}° … {window['yaw_deg'][1]:+.3f}°", 8.0, anchor="start"),
    ]
    return Sketch(310.0, 124.0, tuple(shapes))


def column_notes(column: dict[str, Any]) -> list[str]:
    """The notes of a column, its groups and its trial, and what was found on its hoisting frames, each once."""
    parts = (column, column["sleeves"], column["rebars"], column["trial_assembly"])
    notes = [note for part in parts for note in (part or {}).get("notes", ())]
    notes += [finding["text"] for frame in column["hoisting"] for finding in frame.get("findings", ())]
    return list(dict.fromkeys(notes))
