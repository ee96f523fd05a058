"""What the crew under the crane has to do with a column, in their words; numbers and signs come from report.json alone.

Signs: a pair's offset is rebar minus sleeve; the column moves by plus offset, a bar is bent by minus offset. Both are
done already in the report: ``correction`` is the displacement of the column, ``bend_mm`` that of the bar.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from aadm_workbench.assembly.following import blame_of
from aadm_workbench.model import (
    CameraMove,
    ColumnReport,
    Correction,
    HoistingReport,
    JobReport,
    Kind,
    PointResult,
    RepairReport,
    RepairStep,
    codes_of,
)
from aadm_workbench.report.directions import SMALLEST_MM, Compass, compass_of, grid_of
from aadm_workbench.report.hoist import Hoist, hoist_of
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.report.words.reasons import in_both_languages, recognised

Light: TypeAlias = Literal["green", "amber", "red"]

SMALLEST_TURN_DEG = 0.005
"""What is shown as 0.00 is no turn."""
_MOST_NAMED = 6  # points to be scanned again; of more, all are
_NOTICED_TILT_DEG = 0.2  # 0.6 mm at the height of 180 mm that one measures at


@dataclass(frozen=True)
class Shift:
    """A displacement in the plan, mm, column frame: of a bar by its label, or of the whole column (no label)."""

    label: str
    vector_mm: tuple[float, float]


@dataclass(frozen=True)
class Step:
    """One thing to do; ``release`` where only the engineer may set it going, ``left`` what holds once it is done."""

    text: Phrase
    release: bool = False
    left: Phrase | None = None


@dataclass(frozen=True)
class CrewAdvice:
    """The page of one column: its light, what it says beside it, the steps, and what its sketch shows."""

    light: Light
    headline: Phrase
    steps: tuple[Step, ...]
    shifts: tuple[Shift, ...]
    turn_deg: float
    hoist: Hoist
    compass: Compass


def crew_advice(report: JobReport, column: ColumnReport) -> CrewAdvice:
    """What to do with a column.

    Where a frame was taken while the column hung over its bars, the last one says where to move it; before that the
    check says whether it may be hoisted, and what has to be done first.
    """
    hoist, compass = hoist_of(column), compass_of(grid_of(report), column)
    for frame in reversed(column.hoisting_frames):
        if frame.correction is not None and column.verdict != "fail" and column.goes_on != "fail":
            return _hanging(column, frame, frame.correction, hoist, compass)
    repair = column.repair
    if hoist.state == "yes":
        steps = [*_turned(column), Step(phrase("crew.nothing_to_do"), left=_room(column))]
        return CrewAdvice("green", phrase("crew.go"), tuple(steps), (), 0.0, hoist, compass)
    failed = column.verdict == "fail"
    light: Light = "red" if failed else "amber"
    headline = phrase("crew.stop" if failed else "crew.wait")
    shifts = tuple(_bends(repair)) if failed and repair is not None else ()
    return CrewAdvice(light, headline, tuple(_first(column, repair, compass)), shifts, 0.0, hoist, compass)


def in_steps(advice: CrewAdvice) -> Phrase:
    """The steps of an advice in one line, numbered where they are several."""
    told = [_in_line(step) for step in advice.steps]
    if len(told) == 1:
        return told[0]
    return Phrase(
        " ".join(f"{number}. {text.en}" for number, text in enumerate(told, start=1)),
        " ".join(f"{number}. {text.zh}" for number, text in enumerate(told, start=1)),
    )


def _in_line(step: Step) -> Phrase:
    release, left = phrase("crew.after_release"), step.left or Phrase("", "")
    if not step.release:
        return Phrase(f"{step.text.en} {left.en}".strip(), f"{step.text.zh}{left.zh}")
    return Phrase(
        f"{step.text.en.removesuffix('.')} ({release.en}). {left.en}".strip(),
        f"{step.text.zh.removesuffix('。')}（{release.zh}）。{left.zh}",
    )


def _hanging(
    column: ColumnReport, frame: HoistingReport, move: Correction, hoist: Hoist, compass: Compass
) -> CrewAdvice:
    vector = (move.dx_mm, move.dy_mm)
    steps = [*_turn(column, move.yaw_deg), *_move(vector, compass, _beside_camera(move.camera))]
    for bend in move.repairs:
        way = compass.in_words((bend.dx_mm, bend.dy_mm))
        steps.append(Step(_with_way("crew.bend", way, rebar=bend.label), release=True))
    passed = frame.verdict == "pass"
    if frame.column_tilt_deg is not None and frame.column_tilt_deg >= _NOTICED_TILT_DEG:
        steps.insert(0, Step(phrase("crew.tilted", deg=f"{frame.column_tilt_deg:.1f}")))
    if not steps:
        steps = [Step(phrase("crew.lower"))]
    else:
        steps.append(Step(phrase("crew.then_lower" if passed else "crew.measure_again")))
    light: Light = "green" if passed else "amber"
    headline = phrase("crew.moved_go" if passed else "crew.moved_wait")
    return CrewAdvice(light, headline, tuple(steps), (Shift("", vector),), move.yaw_deg, hoist, compass)


def _turn(column: ColumnReport, yaw_deg: float) -> Iterator[Step]:
    """Counter-clockwise from above where the yaw is above zero."""
    if abs(yaw_deg) < SMALLEST_TURN_DEG:
        return
    size = column.size_mm or _extent(column)
    corner_mm = math.radians(abs(yaw_deg)) * math.hypot(*size) / 2.0
    word = "crew.turn_left" if yaw_deg > 0.0 else "crew.turn_right"
    yield Step(phrase(word, deg=f"{abs(yaw_deg):.2f}", mm=f"{corner_mm:.1f}"))


def _move(vector_mm: Sequence[float], compass: Compass, beside_camera: Phrase) -> Iterator[Step]:
    way = compass.in_words(vector_mm)
    if way.en:
        told = _with_way("crew.move", way)
        yield Step(Phrase(told.en + beside_camera.en, told.zh + beside_camera.zh))


def _beside_camera(seen: CameraMove | None) -> Phrase:
    """The same displacement for whoever stands at the camera; empty where the report does not know it."""
    if seen is None:
        return Phrase("", "")
    ways = [
        phrase(f"crew.camera_{ahead if value > 0.0 else back}", mm=f"{abs(value):.1f}")
        for value, ahead, back in ((seen.right_mm, "right", "left"), (seen.away_mm, "away", "near"))
        if abs(value) >= SMALLEST_MM
    ]
    if not ways:
        return Phrase("", "")
    told = _with_way("crew.from_camera", Phrase(", ".join(way.en for way in ways), "，".join(way.zh for way in ways)))
    return Phrase(f" {told.en}", told.zh)


def _with_way(name: str, way: Phrase, **values: object) -> Phrase:
    text = phrase(name)
    return Phrase(text.en.format(way=way.en, **values), text.zh.format(way=way.zh, **values))


def _extent(column: ColumnReport) -> tuple[float, float]:
    """Width of the pattern along x and y, mm, where the size of the cross-section is not known."""
    points = next((group.points for group in column.groups.values()), ())
    across = [[abs(point.design_mm[axis]) for point in points] for axis in (0, 1)]
    return 2.0 * max(across[0], default=0.0), 2.0 * max(across[1], default=0.0)


def _first(column: ColumnReport, repair: RepairReport | None, compass: Compass) -> Iterator[Step]:
    """What has to be done before the column may be hoisted."""
    verdict = column.verdict
    if verdict == "error":
        yield Step(phrase("crew.scan_or_copy"))
        return
    if verdict == "pass":
        yield from (Step(phrase(f"crew.scan_{part}")) for kind, part in _PARTS.items() if kind not in column.groups)
        return
    trial = column.trial_assembly
    named = {step.rebar for step in repair.steps} if repair is not None and repair.action != "disposal_plan" else set()
    if trial is not None and not {*trial.in_the_way} <= named:
        yield Step(phrase("crew.in_the_way", labels=", ".join(trial.in_the_way)))
    held = [finding.text for finding in column.findings if finding.holds_back]
    yield from (Step(in_both_languages(text)) for text in held)
    if verdict == "not_measured" and held:
        return  # what was scanned is not what was to be: its points are not looked for one by one
    yield from _unseen(column)
    if repair is not None:
        yield from _repair(column, repair, compass)
    elif verdict == "fail":
        yield from _refused(column)
    elif verdict == "inconclusive" and not held:
        told = any(_SAY_UP & codes_of(recognised(reason)) for reason in column.reasons)
        yield Step(phrase("crew.say_up")) if told else _scan_closer(column)
    elif not held and not any(_missing(column)):
        yield Step(phrase("crew.scan_closer"))


_PARTS = {Kind.SLEEVE: "foot", Kind.REBAR: "bars"}


def _refused(column: ColumnReport) -> Iterator[Step]:
    if column.goes_on == "pass":
        groups = column.groups.values()
        labels = [point.label for group in groups for point in group.points if point.verdict == "fail"]
        apart = [spacing for group in groups for spacing in group.spacing if spacing.verdict == "fail"]
        named = labels or ["–".join(spacing.between) for spacing in apart]
        if named:
            yield Step(phrase("crew.goes_on_but", labels=", ".join(named)))
            return
    yield Step(phrase("crew.call_engineer"))


def _missing(column: ColumnReport) -> Iterator[PointResult]:
    for kind in Kind:
        yield from (point for point in column.points(kind) if point.verdict == "not_measured")


_CURES = {
    "extract.plugged": "open_sleeve",
    "extract.foot_out_of_view": "into_picture",
    "extract.out_of_view": "into_picture",
    "extract.no_bar": "look_at_bar",
}
"""What the crew does about a point, by the code of the reason that it was not measured for."""
_SAY_UP = {"assembly.turns", "assembly.turns_at", "assembly.turn_decides"}


def _unseen(column: ColumnReport) -> Iterator[Step]:
    """What to do about points that were not measured, those of one cure together."""
    by_cure: dict[str, list[str]] = {}
    for point in _missing(column):
        codes = codes_of(recognised(point.reason))
        cure = next((cure for code, cure in _CURES.items() if code in codes), "scan_label_again")
        by_cure.setdefault(cure, []).append(point.label)
    for cure, labels in by_cure.items():
        yield Step(phrase(f"crew.{cure}", labels=", ".join(labels)))


def _repair(column: ColumnReport, repair: RepairReport, compass: Compass) -> Iterator[Step]:
    action = repair.action
    if action == "rescan":
        yield _scan_closer(column)
    elif action == "reposition":
        way = compass.in_words(_reposition_mm(column, repair))
        yield Step(_with_way("crew.set_down", way) if way.en else phrase("crew.call_engineer"), release=True)
    elif action == "disposal_plan" or not repair.steps:
        yield Step(phrase("crew.disposal_plan"))
    else:
        if "repair.advise.if_confirmed" in codes_of(recognised(repair.advice)):
            yield replace(_scan_closer(column), left=phrase("crew.if_confirmed"))
        yield from _pairs(column, repair, compass)
        yield Step(phrase("crew.scan_bars_again"))


def _pairs(column: ColumnReport, repair: RepairReport, compass: Compass) -> Iterator[Step]:
    """What to do with each pair, and with it what stays beyond a limit of position then: the engineer decides.

    No bend of a bar puts a sleeve in its place.
    """
    known = set()
    for step in repair.steps:
        done = _of_pair(step, compass)
        if step.rebar in repair.still_fails and step.position_after_mm is not None:
            known.add(step.rebar)
            values = {
                "rebar": step.rebar,
                "mm": f"{step.position_after_mm:.1f}",
                "limit": f"{step.position_limit_mm:g}",
            }
            done = replace(done, left=phrase("crew.still_off_by", **values))
        yield done
    rest = [label for label in repair.still_fails if label not in known]
    rejected = {step.sleeve for step in repair.steps if step.action == "reject_sleeve"}
    follows = {*blame_of(column).follows} | rejected
    sleeves = column.points(Kind.SLEEVE)
    rest += [sleeve.label for sleeve in sleeves if sleeve.verdict == "fail" and sleeve.label not in follows]
    if rest:
        yield Step(phrase("crew.still_off", labels=", ".join(rest)))


def _scan_closer(column: ColumnReport) -> Step:
    named = ", ".join(to_scan_again(column))
    return Step(phrase("crew.scan_label_again", labels=named) if named else phrase("crew.scan_closer"))


def to_scan_again(column: ColumnReport) -> tuple[str, ...]:
    """Points that are left open, or whose spacing or pair is; none where they are too many to be named."""
    if column.trial_assembly is not None and column.trial_assembly.rescan:
        return column.trial_assembly.rescan
    groups = column.groups.values()
    found = [point.label for group in groups for point in group.points if point.verdict == "inconclusive"]
    for group in groups:
        found += [label for one in group.spacing if one.verdict == "inconclusive" for label in one.between]
    found += [label for pair in column.pairs if pair.verdict == "inconclusive" for label in (pair.sleeve, pair.rebar)]
    labels = tuple(dict.fromkeys(found))
    return labels if len(labels) <= _MOST_NAMED else ()


def _of_pair(step: RepairStep, compass: Compass) -> Step:
    if step.action == "reject_sleeve":
        text = phrase("crew.reject_sleeve", sleeve=step.sleeve, mm=f"{step.sleeve_off_mm:.1f}")
        return Step(text, release=True)
    way = compass.in_words(step.bend_mm or (0.0, 0.0))
    if not way.en:
        name = "crew.upright" if step.upright else "crew.call_engineer"
        return Step(phrase(name).filled(rebar=step.rebar), release=True)
    name = "crew.bend_upright" if step.upright else "crew.bend"
    return Step(_with_way(name, way, rebar=step.rebar), release=True)


def _reposition_mm(column: ColumnReport, repair: RepairReport) -> tuple[float, float]:
    """How far from the pose of the least distance the column goes in: what moves the bars moves it the other way."""
    pose = None if column.trial_assembly is None else column.trial_assembly.minimax
    if pose is None or repair.after is None:
        return 0.0, 0.0
    least, after = pose.T_sleeves_rebars, repair.after.T_sleeves_rebars
    return float(least[0][3] - after[0][3]), float(least[1][3] - after[1][3])


def _bends(repair: RepairReport) -> Iterator[Shift]:
    if repair.action == "disposal_plan":
        return
    for step in repair.steps:
        if step.action == "bend" and step.bend_mm is not None:
            yield Shift(step.rebar, step.bend_mm)


def _turned(column: ColumnReport) -> Iterator[Step]:
    """Where the trial found the column to go on turned by its symmetry: S1 does not go on R1."""
    rebar = next((pair.rebar for pair in column.pairs if pair.sleeve == "S1"), "R1")
    if rebar != "R1":
        yield Step(phrase("crew.set_turned", rebar=rebar))


def _room(column: ColumnReport) -> Phrase | None:
    """How far the column may be off its best position, whichever way: no bar then passes its limit or touches.

    The feasible window is larger, for it lets the column give way in the other coordinates; a crew cannot do that.
    """
    rooms = [pair.limit_mm - pair.distance_mm for pair in column.pairs if pair.limit_mm is not None]
    rooms += [pair.clearance_mm for pair in column.pairs if pair.clearance_mm is not None]
    room_mm = math.floor(10.0 * min(rooms, default=0.0)) / 10.0
    return phrase("crew.lower_middle", mm=f"{room_mm:.1f}") if room_mm >= SMALLEST_MM else None
