"""What ``aadm watch`` says of each frame: the state file, and a line for people."""

from __future__ import annotations

from typing import Any

import numpy as np

from aadm_workbench.assembly.hoisting_running import Running
from aadm_workbench.model import HoistingReport, Verdict

from .terminal import in_words


def state_document(
    column: str, number: int, report: HoistingReport, running: Running | None, seconds: float, bad_frames: int
) -> dict[str, Any]:
    """The state after a frame, as its file holds it; lengths in mm.

    ``frame`` is the frame as report.json would hold it; ``running`` combines the frames since the column last moved.
    """
    return {
        "schema": 1,
        "column": column,
        "frames": number,
        "bad_frames": bad_frames,
        "seconds": round(seconds, 3),
        "frame": report,
        "running": None if running is None else _running(report, running),
    }


def _running(report: HoistingReport, running: Running) -> dict[str, Any]:
    u_mm = running.u_mm
    pairs = [
        {
            "sleeve": pair.sleeve,
            "rebar": pair.rebar,
            "offset_mm": running.offsets_mm[k].tolist(),
            "distance_mm": float(running.distances_mm[k]),
            "u_mm": float(u_mm[k]),
        }
        for k, pair in enumerate(report.pairs)
    ]
    return {
        "frames": running.frames,
        "moved": running.moved_mm is not None,
        "moved_mm": running.moved_mm,
        "max_mm": float(running.distances_mm.max()),
        "u_mm": float(np.median(u_mm)),
        "pairs": pairs,
    }


def frame_line(report: HoistingReport, running: Running | None, seconds: float) -> str:
    """A line for people: verdict, largest distance, what the crane must do, and whether the column is still."""
    name = report.source
    if report.max_mm is None:
        reason = report.reasons[0] if report.reasons else ""
        return f"{name}: {in_words(report.verdict)}: {reason}"
    worst = max((pair for pair in report.pairs if pair.distance_mm is not None), key=lambda p: p.distance_mm or 0.0)
    words = [f"{name}: {in_words(report.verdict)}", f"largest {report.max_mm:.2f} mm at {worst.sleeve}"]
    move = report.correction
    if move is not None and move.camera is not None and report.verdict is not Verdict.NOT_MEASURED:
        words.append(
            f"move {_way(move.camera.right_mm, 'right', 'left')}, {_way(move.camera.away_mm, 'away', 'nearer')}, turn "
            f"{move.yaw_deg:+.2f} deg"
        )
    if running is not None:
        still = f"still for {running.frames} frames" if running.frames > 1 else "one frame"
        words.append(f"moved by {running.moved_mm:.1f} mm" if running.moved_mm is not None else still)
    return f"{'; '.join(words)} ({seconds:.2f} s)"


def _way(value_mm: float, ahead: str, back: str) -> str:
    return f"{abs(value_mm):.1f} mm {ahead if value_mm >= 0.0 else back}"
