"""What ``aadm watch`` says of each frame: the state file, and a line for people."""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np

from aadm_workbench.hoisting.swing.motion import Motion, Running
from aadm_workbench.model import Array, HoistingReport, Json, Verdict
from aadm_workbench.report.hoisting_fitness import VALID_FOR_S, Fitness, fitness_of, stamp_of
from aadm_workbench.report.json import encode

from ..shown.terminal import in_words
from ..shown.told import Words

SCHEMA = 2  # of aadm-state.json


@dataclass(frozen=True, eq=False)
class Frame:
    """One frame as it was measured: its number and how many before it were bad, its times in seconds since 1970.

    ``captured_s`` None: not known. ``running`` and ``motion`` are None where nothing was measured; ``limit_mm`` is
    None without a limit.
    """

    number: int
    bad_frames: int
    report: HoistingReport
    running: Running | None
    motion: Motion | None
    captured_s: float | None
    measured_s: float
    seconds: float
    limit_mm: float | None


def state_document(column: str, frame: Frame) -> tuple[dict[str, Json], Fitness]:
    """The state after a frame, as its file holds it, and its fitness as it was measured; lengths in mm.

    ``frame`` is the frame as report.json would hold it; ``running`` combines the frames since the column last moved;
    ``move`` is the correction to act upon, null where there is none.
    """
    motion, running = frame.motion, frame.running
    state = {
        "schema": SCHEMA,
        "column": column,
        "frames": frame.number,
        "bad_frames": frame.bad_frames,
        "sequence": frame.number,
        "captured": stamp_of(frame.captured_s),
        "measured": stamp_of(frame.measured_s),
        "valid_for_s": VALID_FOR_S,
        "seconds": round(frame.seconds, 3),
        "limit_mm": frame.limit_mm,
        "still": motion is not None and motion.still is True,
        "moving": motion is not None and motion.moving,
        "swing": _swing(motion),
        "largest_mm": None if motion is None else motion.largest_mm,
        "move": _move(frame.report, motion),
        "frame": frame.report,
        "running": None if running is None else _running(frame.report, running),
    }
    plain: dict[str, Json] = json.loads(encode(state))
    fitness = fitness_of(plain, frame.measured_s)
    ready: dict[str, Json] = {"ready": fitness.ready, "reason": fitness.reason, "shows_move": fitness.shows_move}
    return plain | ready | {"move": plain["move"] if fitness.shows_move else None}, fitness


def _swing(motion: Motion | None) -> dict[str, float | int | None] | None:
    if motion is None or motion.swing is None:
        return None
    swing = motion.swing
    return {"amplitude_mm": swing.amplitude_mm, "period_s": swing.period_s, "frames": swing.frames}


def _move(report: HoistingReport, motion: Motion | None) -> dict[str, float | None] | None:
    rest = None if motion is None or report.correction is None else motion.rest
    if rest is None:
        return None
    move = {"dx_mm": rest.dx_mm, "dy_mm": rest.dy_mm, "yaw_deg": rest.yaw_deg, "u_mm": rest.u_mm}
    if rest.camera is not None:
        move |= {"right_mm": rest.camera.right_mm, "away_mm": rest.camera.away_mm}
    return move


def _running(
    report: HoistingReport, running: Running
) -> dict[str, float | list[dict[str, str | float | Array]] | None]:
    pairs: list[dict[str, str | float | Array]] = [
        {
            "sleeve": pair.sleeve,
            "rebar": pair.rebar,
            "offset_mm": running.offsets_mm[k],
            "distance_mm": float(running.distances_mm[k]),
            "u_mm": float(running.u_mm[k]),
        }
        for k, pair in enumerate(report.pairs)
    ]
    return {
        "frames": running.frames,
        "moved": running.moved_mm is not None,
        "moved_mm": running.moved_mm,
        "max_mm": float(running.distances_mm.max()),
        "u_mm": float(np.median(running.u_mm)),
        "pairs": pairs,
    }


def frame_line(frame: Frame, fitness: Fitness, words: Words) -> str:
    """A line for people: verdict, largest distance, what the crane must do, and whether the column may be lowered."""
    report = frame.report
    told = words.of(report.source, in_words(report.verdict, words.language))
    if report.max_mm is None:
        return words.of(told, words.said(report.reasons[0]) if report.reasons else "")
    worst = max((pair for pair in report.pairs if pair.distance_mm is not None), key=lambda p: p.distance_mm or 0.0)
    parts = [told, words("largest", most=report.max_mm, sleeve=worst.sleeve)]
    if len(report.joined) > 1:
        parts.append(words("together", count=len(report.joined)))
    move = frame.motion.rest if frame.motion is not None and fitness.shows_move else None
    if move is not None and move.camera is not None and report.verdict is not Verdict.NOT_MEASURED:
        right_mm, away_mm = move.camera.right_mm, move.camera.away_mm
        aside = words("right" if right_mm >= 0.0 else "left", by=abs(right_mm))
        ahead = words("away" if away_mm >= 0.0 else "nearer", by=abs(away_mm))
        parts.append(words("move", aside=aside, ahead=ahead, turn=move.yaw_deg))
    running = frame.running
    if running is not None:
        still = words("still", frames=running.frames) if running.frames > 1 else words("one_frame")
        parts.append(words("moved", by=running.moved_mm) if running.moved_mm is not None else still)
    reason = words.said(fitness.reason)
    ready = words("ready_but", reason=reason) if reason else words("ready")
    parts.append(ready if fitness.ready else words("not_ready", reason=reason))
    return words("line", parts=words.joined(parts), seconds=frame.seconds)
