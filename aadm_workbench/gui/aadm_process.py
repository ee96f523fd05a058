"""The command ``aadm`` in a process of its own, beside the window; it ends when its standard input is closed."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtCore

from aadm_workbench.document.private_process import Work, command, environment
from aadm_workbench.errors import AadmError

translate = FreeCAD.Qt.translate
_STEP = re.compile(r"^(?:aadm: )?(\d+)/(\d+) (.*)$")
_END_MS = 3_000  # it needs one second to take temporary files away; then it is ended
_RUNNING: set[Any] = set()
CANCELLED = -1
"""Instead of an exit code: the process could not be started, was ended from outside, or was cancelled."""


class AadmProcess(QtCore.QObject):
    """One process that says what it does, line by line.

    Signals: ``stepped`` with done, total and what was done; ``said`` with a line for people; ``ended`` with the exit
    code, or :data:`CANCELLED`.
    """

    stepped = QtCore.Signal(int, int, str)
    said = QtCore.Signal(str)
    ended = QtCore.Signal(int)

    def __init__(
        self, words: Sequence[str], folder: str, variables: Mapping[str, str], *, output: bool = False
    ) -> None:
        """``output``: what it says stands on its standard output, too."""
        super().__init__()
        self._process = QtCore.QProcess(self)
        self._process.setProgram(words[0])
        self._process.setArguments(list(words[1:]))
        self._process.setWorkingDirectory(folder)
        self._process.setProcessEnvironment(_variables(variables))
        if output:
            self._process.setProcessChannelMode(QtCore.QProcess.MergedChannels)
            self._process.readyReadStandardOutput.connect(self._read)
        else:
            self._process.setStandardOutputFile(QtCore.QProcess.nullDevice())
            self._process.readyReadStandardError.connect(self._read)
        self._read_all = self._process.readAllStandardOutput if output else self._process.readAllStandardError
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)
        self._rest = b""
        self._over = False
        self._cancelled = False

    def start(self) -> None:
        """Begin, and stay alive until the end."""
        if not _RUNNING:
            QtCore.QCoreApplication.instance().aboutToQuit.connect(end_all)
        _RUNNING.add(self)
        self._process.start()

    def cancel(self) -> None:
        """End it and what it has started; what it had written is whole or not there."""
        self._cancelled = True
        if self._process.state() != QtCore.QProcess.NotRunning:
            self._process.closeWriteChannel()
            QtCore.QTimer.singleShot(_END_MS, self._end_by_force)

    def _end_by_force(self) -> None:
        if self._process.state() != QtCore.QProcess.NotRunning:
            self._process.kill()

    def wait(self) -> None:
        """Wait for its end, as FreeCAD does before it closes."""
        if not self._process.waitForFinished(_END_MS):
            self._process.kill()
            self._process.waitForFinished(_END_MS)

    def _read(self) -> None:
        self._rest += bytes(self._read_all())
        *lines, self._rest = self._rest.split(b"\n")
        for line in lines:
            self._take(line.decode("utf-8", errors="replace").strip())

    def _take(self, line: str) -> None:
        step = _STEP.match(line)
        if step:
            self.stepped.emit(int(step[1]), int(step[2]), step[3])
        elif line:
            self.said.emit(line.removeprefix("aadm: "))

    def _finished(self, code: int, status: Any) -> None:
        self._read()
        self._take(self._rest.decode("utf-8", errors="replace").strip())
        self._rest = b""
        self._end(CANCELLED if self._cancelled or status == QtCore.QProcess.CrashExit else code)

    def _failed(self, error: Any) -> None:
        if error == QtCore.QProcess.FailedToStart:
            program = self._process.program()
            self.said.emit(translate("AADM", "{program} cannot be run; look at the settings").format(program=program))
            # Whoever hears of the end may let go of the process, which is still in the midst of saying this.
            QtCore.QTimer.singleShot(0, lambda: self._end(CANCELLED))

    def _end(self, code: int) -> None:
        if not self._over:
            self._over = True
            _RUNNING.discard(self)
            self.ended.emit(code)


class PrivateWork(QtCore.QObject):
    """Work of the private process, in a folder of its own that is gone afterwards.

    Signals: ``stepped`` and ``said`` as those of the process; then one of ``done`` with the answer, ``failed`` with an
    AadmError, ``cancelled``.
    """

    stepped = QtCore.Signal(int, int, str)
    said = QtCore.Signal(str)
    done = QtCore.Signal(object)
    failed = QtCore.Signal(object)
    cancelled = QtCore.Signal()

    def __init__(self, work: Work) -> None:
        """Raises NoEnvironmentError where nothing can run it."""
        super().__init__()
        words = command(work.arguments)
        self._work = work
        self._folder = tempfile.TemporaryDirectory(prefix="aadm-", ignore_cleanup_errors=True)
        self._said: list[str] = []
        self._asked_to_end = False
        self._process = AadmProcess(words, self._folder.name, environment())
        self._process.said.connect(self._said.append)
        self._process.stepped.connect(self.stepped)
        self._process.said.connect(self.said)
        self._process.ended.connect(self._ended)

    def begin(self) -> None:
        """Start it."""
        self._work.lay_out(Path(self._folder.name))
        self._process.start()

    def cancel(self) -> None:
        """Ask for an end."""
        self._asked_to_end = True
        self._process.cancel()

    def _ended(self, code: int) -> None:
        try:
            if self._asked_to_end:
                self.cancelled.emit()
                return
            try:
                answer = self._work.outcome(code, self._said, Path(self._folder.name))
            except AadmError as error:
                self.failed.emit(error)
            else:
                self.done.emit(answer)
        finally:
            self._folder.cleanup()


def end_all() -> None:
    """End what still runs, and wait for it: FreeCAD must not leave processes behind."""
    for process in list(_RUNNING):
        process.cancel()
        process.wait()


def _variables(given: Mapping[str, str]) -> QtCore.QProcessEnvironment:
    found = QtCore.QProcessEnvironment()
    for name, value in given.items():
        found.insert(name, value)
    return found
