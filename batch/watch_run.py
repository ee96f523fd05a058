"""The loop of ``aadm watch``: waits for frames in a folder, measures each, and keeps the state file up to date."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import monotonic, perf_counter, sleep

from aadm_workbench.assembly.hoisting_running import Running, combined
from aadm_workbench.atomic import write_atomically
from aadm_workbench.errors import AadmError, DesignError, JobError, ScanError
from aadm_workbench.hoisting import HoistingSettings, measure_hoisting
from aadm_workbench.model import ColumnDesign, HoistingMeasurement, HoistingReport, Verdict
from aadm_workbench.report.json import encode

from .column_task import check_task
from .hoisting_task import Before, before_hoisting, read_frame
from .task import ColumnTask
from .watch_folder import FolderWatch
from .watch_state import frame_line, state_document

LOOK_EVERY_S = 0.15
"""A person sees no delay, and a listing of a folder costs nothing."""
_PATIENCE_S = 3.0  # a file that is not whole by then is said to be broken


@dataclass(frozen=True)
class WatchOptions:
    """``frames`` and ``seconds``: when to stop (None: never); ``present``: begin with the frames that are there."""

    state: Path
    frames: int | None = None
    seconds: float | None = None
    present: bool = False


class Watcher:
    """Measures frames of one column as they arrive; what it keeps between them does not grow."""

    def __init__(self, task: ColumnTask, folder: Path, options: WatchOptions, say: Callable[[str], None]) -> None:
        if task.design is None:
            raise DesignError(task.no_design)
        if not folder.is_dir():
            raise JobError(f"{folder}: there is no such folder to watch")
        self.task, self.design, self.options, self.say = task, task.design, options, say
        self.frames, self.bad_frames = 0, 0
        self.verdict = Verdict.NOT_MEASURED
        self._folder = FolderWatch(folder)
        self._running: Running | None = None
        self._sleeves, self._rebars = self._before()
        self._first_tries: dict[str, float] = {}

    def run(self, wait: Callable[[float], None] = sleep) -> Verdict:
        """Measure frames until the options say enough, and return the verdict on the last one."""
        if not self.options.present:
            self._folder.skip_present()
        began = monotonic()
        while not self._enough(monotonic() - began):
            try:
                ready = self._folder.ready()
            except OSError as error:
                raise AadmError(f"{self._folder.folder}: cannot be listed any more ({error.strerror})") from error
            for path in ready:
                self._frame(path)
                if self._enough(monotonic() - began):
                    break
            wait(LOOK_EVERY_S)
        return self.verdict

    def _enough(self, seconds: float) -> bool:
        frames, limit = self.options.frames, self.options.seconds
        return (frames is not None and self.frames >= frames) or (limit is not None and seconds >= limit)

    def _before(self) -> tuple[Before, Before]:
        """Where the job's scans from before hoisting put sleeves and bars."""
        column = self.task.column
        if not column.sleeves and not column.rebars:
            return None, None
        self.say(f"{column.id}: measuring its scans from before hoisting")
        report = check_task(self.task).report
        if report.verdict is Verdict.ERROR:
            self.say(f"{column.id}: {'; '.join(report.reasons)}; its design places are used")
        return before_hoisting(report.sleeves), before_hoisting(report.rebars)

    def _frame(self, path: Path) -> None:
        began = perf_counter()
        try:
            measurement = self._measured(path, self.design)
        except (ScanError, OSError) as error:
            if self._may_be_unfinished(path):
                return
            measurement = _bad(path.name, str(error).replace(str(path), path.name))
        except (AadmError, MemoryError) as error:
            measurement = _bad(path.name, str(error) or type(error).__name__)
        except Exception as error:  # noqa: BLE001 - a crane must not wait because of one frame
            self.say(traceback.format_exc())
            measurement = _bad(path.name, f"internal error ({type(error).__name__}: {error})")
        self._first_tries.pop(path.name, None)
        self._folder.done(path)
        self._keep(measurement, perf_counter() - began)

    def _measured(self, path: Path, design: ColumnDesign) -> HoistingMeasurement:
        scan = read_frame(self.task, path, path.name)
        settings = self.task.settings
        return measure_hoisting(
            scan,
            design,
            near=self.task.column.near,
            sleeves_before=self._sleeves,
            rebars_before=self._rebars,
            settings=HoistingSettings(settings.profile, settings.decision, seed=settings.seed),
        )

    def _may_be_unfinished(self, path: Path) -> bool:
        """Whether a frame that cannot be read may still be written: for some seconds it may."""
        now = monotonic()
        first = self._first_tries.setdefault(path.name, now)
        if now - first >= _PATIENCE_S or not path.exists():
            return False
        self._folder.wait_for(path)
        return True

    def _keep(self, measurement: HoistingMeasurement, seconds: float) -> None:
        report = measurement.report
        self.frames += 1
        self.verdict = report.verdict
        running = None
        if report.verdict in (Verdict.NOT_MEASURED, Verdict.ERROR):
            self.bad_frames += 1
        else:
            running = self._running = combined(self._running, measurement)
        document = state_document(self.task.column.id, self.frames, report, running, seconds, self.bad_frames)
        write_atomically(self.options.state, encode(document))
        self.say(frame_line(report, running, seconds))


def _bad(name: str, reason: str) -> HoistingMeasurement:
    import numpy as np

    report = HoistingReport(name, (), None, None, None, Verdict.ERROR, reasons=(reason,), method="refined")
    return HoistingMeasurement(report, np.empty((0, 2)), np.empty((0, 2, 2)))
