"""Hundreds of loops of camera, watch, controller and crane, with frames that are drawn and not rendered."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np

from aadm_workbench.hoisting.swing.motion import Look, look_at, motion_of, with_look
from aadm_workbench.twin.study.loops import LIMIT_MM, DrawnColumn, drawn_column

from .link.controller import Reading, act
from .watch.state import Frame, state_document


@dataclass(frozen=True)
class LoopEnd:
    """How one loop ended: ``beyond_mm`` is the true largest distance in the period after ``ready``; None without it."""

    seed: int
    ready: bool
    frames: int
    moves: int
    beyond_mm: float | None


def run_loop(seed: int, most_frames: int, *, arm: bool = False) -> LoopEnd:
    """One column, until the state says ready and the controller lets it down."""
    looks: tuple[Look, ...] = ()
    column, number = drawn_column(seed, arm=arm), 0
    while number < most_frames and not column.landed:
        number += 1
        looks = act_on_frame(column, looks, number)
    beyond_mm = column.largest_within_mm(column.period_s) if column.landed else None
    return LoopEnd(seed, column.landed, number, column.moves, beyond_mm)


def act_on_frame(column: DrawnColumn, looks: tuple[Look, ...], number: int) -> tuple[Look, ...]:
    """Measure a frame, write its state, and act on that; as the watch and the controller do."""
    measured = column.frame()
    looks = with_look(looks, look_at(measured, column.time_s))
    places = np.array([bar.centre[:2] for bar in column.design.rebars])
    motion = motion_of(looks, places, measured.report.correction, LIMIT_MM)
    frame = Frame(number, 0, measured.report, None, motion, column.time_s, column.time_s, 0.0, LIMIT_MM)
    state, fitness = state_document(column.design.id, frame)
    move = motion.rest if state["move"] is not None else None
    way = None if move is None else (move.dx_mm, move.dy_mm, move.yaw_deg)
    act(column, Reading(fitness.ready, number, way, fitness.reason, None if move is None else move.u_mm))
    return looks


def summary_of(ends: list[LoopEnd]) -> dict[str, object]:
    """How many ended ready, in how many frames, and how many of those then left their limit."""
    ready = [end for end in ends if end.ready]
    beyond = [end for end in ready if (end.beyond_mm or 0.0) > LIMIT_MM]
    frames = [end.frames for end in ready]
    return {
        "synthetic": True,
        "loops": len(ends),
        "ready": len(ready),
        "beyond_after_ready": len(beyond),
        "median_frames": float(np.median(frames)) if frames else None,
        "most_frames": max(frames, default=None),
        "ends": [asdict(end) for end in ends],
    }
