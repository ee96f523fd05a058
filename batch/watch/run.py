"""The loop of ``aadm watch``: waits for frames in a folder, measures each, and keeps the state file up to date."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import monotonic, perf_counter, sleep
from typing import Protocol

import numpy as np

from aadm_workbench.assembly.tolerances import rules_for
from aadm_workbench.errors import AadmError, DesignError, JobError, ScanError
from aadm_workbench.hoisting.swing.motion import Look, Motion, Running, combined, look_at, motion_of, with_look
from aadm_workbench.inspection.column import inspect_column
from aadm_workbench.inspection.hoisting import Before, measure_frame, unread
from aadm_workbench.inspection.tasks import ColumnTask
from aadm_workbench.model import HoistingMeasurement, Scan, Verdict
from aadm_workbench.model.reason import reason_of, renamed
from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.json import encode

from ..shown.told import Words
from .corners import Corners
from .folder import FolderWatch, corner_of
from .state import Frame, frame_line, state_document

LOOK_EVERY_S = 0.15
"""A person sees no delay, and a listing of a folder costs nothing."""
_PATIENCE_S = 3.0  # a file that is not whole by then is said to be broken


class Live(Protocol):
    """A camera that writes into the folder: it is asked for a frame before each look."""

    ended: bool

    def fault(self) -> str:
        """Write the next frame if it is time; what kept it from being written, empty where nothing did."""


_ENGLISH = Words("en", "told_watch")


@dataclass(frozen=True)
class WatchOptions:
    """``frames`` and ``seconds``: when to stop (None: never); ``present``: begin with the frames that are there.

    ``near``: the corner of the camera that writes into the folder itself; None: that of the column in the job.
    ``live``: that camera, where the watch asks it; None where another program does.
    ``words``: those of what is said.
    """

    state: Path
    frames: int | None = None
    seconds: float | None = None
    present: bool = False
    near: tuple[int, int] | None = None
    live: Live | None = None
    words: Words = _ENGLISH


class Watcher:
    """Measures frames of one column as they arrive; what it keeps between them does not grow."""

    def __init__(
        self,
        task: ColumnTask,
        folder: Path,
        options: WatchOptions,
        say: Callable[[str], None],
        now_ns: Callable[[], int] = time.time_ns,
    ) -> None:
        if task.design is None:
            raise DesignError(task.no_design)
        if not folder.is_dir():
            raise JobError.because("command.no_watched_folder", folder=folder)
        self.task, self.design, self.options, self.say = task, task.design, options, say
        self.frames, self.bad_frames = 0, 0
        self.verdict = Verdict.NOT_MEASURED
        self._now_ns = now_ns
        self._folder = FolderWatch(folder, now_ns)
        self._running: Running | None = None
        self._looks: tuple[Look, ...] = ()
        self._places = np.array([bar.centre[:2] for bar in self.design.rebars])
        rules = rules_for(task.settings.profile, "sleeve_rebar_distance")
        self._limit_mm = rules[0].upper if rules else None
        self._newest: dict[tuple[int, int] | None, HoistingMeasurement] = {}
        self._before_hoisting = self._before()
        self._corners = Corners(task, self.design, self._before_hoisting)
        self._first_tries: dict[str, float] = {}

    def run(self, wait: Callable[[float], None] = sleep) -> Verdict:
        """Measure frames until the options say enough, and return the verdict on the last one."""
        if not self.options.present:
            self._folder.skip_present()
        self._tell("waiting", folder=self._folder.folder)
        began = monotonic()
        while not self._enough(monotonic() - began):
            if self._no_more_comes():
                break
            try:
                ready = self._folder.ready()
            except OSError as error:
                raise AadmError.because(
                    "command.folder_gone", folder=self._folder.folder, why=error.strerror
                ) from error
            for path in ready:
                self._frame(path)
                if self._enough(monotonic() - began):
                    break
            wait(LOOK_EVERY_S)
        return self.verdict

    def _no_more_comes(self) -> bool:
        """Ask the camera, if there is one, for a frame; one that it lost is a bad one. Whether it has no more."""
        live = self.options.live
        if live is None:
            return False
        began, fault = perf_counter(), live.fault()
        if fault:
            self._keep(_bad("camera", fault), self.options.near, self._now_ns() / 1e9, perf_counter() - began)
        return live.ended

    def _enough(self, seconds: float) -> bool:
        frames, limit = self.options.frames, self.options.seconds
        return (frames is not None and self.frames >= frames) or (limit is not None and seconds >= limit)

    def _tell(self, name: str, **values: object) -> None:
        words = self.options.words
        self.say(words.of(self.task.column.id, words(name, **values)))

    def _before(self) -> Before:
        """Where the job's scans from before hoisting put sleeves and bars."""
        column = self.task.column
        if not column.sleeves and not column.rebars:
            return Before()
        self._tell("before")
        report = inspect_column(self.task).report
        if report.verdict is Verdict.ERROR:
            self._tell("design_places", why=self.options.words.joined(report.reasons))
        return Before.of(report)

    def _frame(self, path: Path) -> None:
        began, name = perf_counter(), self._folder.name_of(path)
        try:
            scan = self.task.read(name, path=path)
            measurement = self._measured(scan, self._near(path))
        except (ScanError, OSError) as error:
            if self._may_be_unfinished(path):
                return
            measurement = _bad(name, renamed(reason_of(error), str(path), name))
        except (AadmError, MemoryError) as error:
            measurement = _bad(name, reason_of(error) or type(error).__name__)
        except Exception as error:  # noqa: BLE001 - a crane must not wait because of one frame
            self.say(traceback.format_exc())
            measurement = _bad(name, f"internal error ({type(error).__name__}: {error})")
        self._first_tries.pop(name, None)
        captured_s = self._folder.captured_s(path)
        self._folder.done(path)
        self._keep(measurement, self._near(path), captured_s, perf_counter() - began)

    def _measured(self, scan: Scan, near: tuple[int, int] | None) -> HoistingMeasurement:
        """The frame by itself; it begins where the last one of its corner ended."""
        after = self._newest.get(near)
        measurement = measure_frame(self.task, self.design, scan, near, self._before_hoisting, after)
        self._newest[near] = measurement
        return measurement

    def _near(self, path: Path) -> tuple[int, int] | None:
        """The corner that a frame was taken from: its subfolder's, else the command's, else the job's."""
        return corner_of(path) or self.options.near or self.task.column.near

    def _may_be_unfinished(self, path: Path) -> bool:
        """Whether a frame that cannot be read may still be written: for some seconds it may."""
        now = monotonic()
        first = self._first_tries.setdefault(self._folder.name_of(path), now)
        if now - first >= _PATIENCE_S or not path.exists() or path.is_dir():
            return False
        self._folder.wait_for(path)
        return True

    def _keep(
        self, measurement: HoistingMeasurement, near: tuple[int, int] | None, captured_s: float | None, seconds: float
    ) -> None:
        self.frames += 1
        running, motion = None, None
        at_s = self._now_ns() / 1e9 if captured_s is None else captured_s
        measurement = self._corners.with_newest(measurement, near, at_s)
        if measurement.report.verdict in (Verdict.NOT_MEASURED, Verdict.ERROR):
            self.bad_frames += 1
        else:
            running = self._running = combined(self._running, measurement)
            motion = self._moved(measurement, captured_s)
        self.verdict = measurement.report.verdict
        frame = Frame(
            number=self.frames,
            bad_frames=self.bad_frames,
            report=measurement.report,
            running=running,
            motion=motion,
            captured_s=captured_s,
            measured_s=self._now_ns() / 1e9,
            seconds=seconds,
            limit_mm=self._limit_mm,
        )
        document, fitness = state_document(self.task.column.id, frame)
        write_atomically(self.options.state, encode(document))
        self.say(frame_line(frame, fitness, self.options.words))

    def _moved(self, measurement: HoistingMeasurement, captured_s: float | None) -> Motion:
        """How the column moves, by the times of the frames; one without a time stands alone."""
        look = look_at(measurement, captured_s or 0.0)
        self._looks = (look,) if captured_s is None else with_look(self._looks, look)
        return motion_of(self._looks, self._places, measurement.report.correction, self._limit_mm)


def _bad(name: str, reason: str) -> HoistingMeasurement:
    return HoistingMeasurement(unread(name, reason, "refined"), np.empty((0, 2)), np.empty((0, 2, 2)))
