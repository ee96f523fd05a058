"""The command ``aadm`` in a process of its own, in plain Python: FreeCAD's own cannot start further ones.

It uses the packages that FreeCAD uses, and this workbench's own files, so that nothing has to be installed twice.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtCore

from aadm_workbench.document.packages import package_folder, python_program

translate = FreeCAD.Qt.translate
_ROOT = Path(__file__).resolve().parents[2]  # the folder of package.xml
_STEP = re.compile(r"^(?:aadm: )?(\d+)/(\d+) (.*)$")


class AadmProcess(QtCore.QObject):
    """One run of ``aadm``.

    Signals: ``stepped`` with done, total and what was done; ``said`` with a line for people; ``ended`` with the exit
    code, -1 for a process that could not be started or was cancelled.
    """

    stepped = QtCore.Signal(int, int, str)
    said = QtCore.Signal(str)
    ended = QtCore.Signal(int)

    def __init__(self, arguments: Sequence[str], folder: str = "") -> None:
        super().__init__()
        self._process = QtCore.QProcess(self)
        self._process.setProgram(python_program())
        self._process.setArguments(["-m", command_module(), *arguments])
        self._process.setProcessEnvironment(_environment())
        if folder:
            self._process.setWorkingDirectory(folder)
        self._process.setStandardOutputFile(QtCore.QProcess.nullDevice())
        self._process.readyReadStandardError.connect(self._read)
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)
        self._rest = ""
        self._over = False
        self._cancelled = False

    def start(self) -> None:
        """Begin."""
        self._process.start()

    def cancel(self) -> None:
        """End it; what it had written is whole or not there."""
        self._cancelled = True
        if self._process.state() != QtCore.QProcess.NotRunning:
            self._process.kill()

    def _read(self) -> None:
        self._rest += bytes(self._process.readAllStandardError()).decode("utf-8", errors="replace")
        *lines, self._rest = self._rest.split("\n")
        for line in lines:
            self._take(line.strip())

    def _take(self, line: str) -> None:
        step = _STEP.match(line)
        if step:
            self.stepped.emit(int(step[1]), int(step[2]), step[3])
        elif line:
            self.said.emit(line.removeprefix("aadm: "))

    def _finished(self, code: int, status: Any) -> None:
        self._read()
        self._take(self._rest.strip())
        self._rest = ""
        self._end(-1 if self._cancelled or status == QtCore.QProcess.CrashExit else code)

    def _failed(self, error: Any) -> None:
        if error == QtCore.QProcess.FailedToStart:
            program = python_program()
            said = translate("AADM_Job", "{program} cannot be run: name a Python with the packages in the settings")
            self.said.emit(said.format(program=program))
            self._end(-1)

    def _end(self, code: int) -> None:
        if not self._over:
            self._over = True
            self.ended.emit(code)


def command_module() -> str:
    """What ``python -m`` calls the command: the folder beside this package, or what pip made of it."""
    return "batch" if (_ROOT / "batch" / "__main__.py").is_file() else "aadm_batch"


def _environment() -> QtCore.QProcessEnvironment:
    environment = QtCore.QProcessEnvironment.systemEnvironment()
    inherited = environment.value("PYTHONPATH", "").split(os.pathsep)
    packages = [str(package_folder()), str(package_folder().parent)]
    # What FreeCAD itself was told with -P stands on its path, too.
    added = [entry for entry in sys.path if entry.endswith("site-packages")]
    places = [str(_ROOT), *packages, *added, *inherited]
    environment.insert("PYTHONPATH", os.pathsep.join(dict.fromkeys(place for place in places if place)))
    environment.insert("PYTHONIOENCODING", "utf-8")
    environment.insert("PYTHONUNBUFFERED", "1")
    environment.remove("PYTHONHOME")
    return environment
