"""Long work beside the window: in a thread, with steps that are told, and an end that can be asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from PySide import QtCore

_RUNNING: set[Worker] = set()
_LONGEST_WAIT_MS = 30_000  # a step that has been told to end does so within one scan


class CancelledError(Exception):
    """Someone has pressed Cancel."""


class Worker(QtCore.QThread):
    """Runs one function in a thread; the function touches no document and no widget.

    Signals arrive in the thread of the window: ``stepped`` with the name of the step, then one of ``done`` with what
    the function returned, ``failed`` with its exception, ``cancelled``.
    """

    stepped = QtCore.Signal(str)
    done = QtCore.Signal(object)
    failed = QtCore.Signal(object)
    cancelled = QtCore.Signal()

    def __init__(self, work: Callable[[Callable[[str], Any]], Any]) -> None:
        super().__init__()
        self._work = work
        self._stop = False
        self.finished.connect(self._forget)

    def begin(self) -> None:
        """Start, and stay alive until the end."""
        if not _RUNNING:
            QtCore.QCoreApplication.instance().aboutToQuit.connect(end_all)
        _RUNNING.add(self)
        self.start()

    def cancel(self) -> None:
        """Ask for an end; it comes with the next step."""
        self._stop = True

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Around a step of the work."""
        if self._stop:
            raise CancelledError
        self.stepped.emit(name)
        yield
        if self._stop:
            raise CancelledError

    def run(self) -> None:
        """What the thread does."""
        try:
            found = self._work(self.stage)
        except CancelledError:
            self.cancelled.emit()
        except BaseException as error:  # noqa: BLE001 - a thread of Qt must not end in an exception
            self.failed.emit(error)
        else:
            self.done.emit(found)

    def _forget(self) -> None:
        _RUNNING.discard(self)


def end_all() -> None:
    """End what still runs, and wait for it: FreeCAD must not close under a thread."""
    for worker in list(_RUNNING):
        worker.cancel()
        worker.wait(_LONGEST_WAIT_MS)
