"""Work that needs packages: done by ``aadm`` in a process of its own, for FreeCAD itself gets nothing installed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.design.freecad_program import PROGRAM_VARIABLE
from aadm_workbench.errors import AadmError, NoEnvironmentError
from aadm_workbench.private.environment import Environment, find_environment
from aadm_workbench.private.own_program import program_on_path
from aadm_workbench.private.pythons import Around, around_this, plain_environment

translate = FreeCAD.Qt.translate
_SETTINGS = "User parameter:BaseApp/Preferences/Mod/AADM"
_LAST_WORDS = 3  # lines; what went wrong stands at the end


@dataclass(frozen=True)
class Work:
    """One run of ``aadm`` in a folder of its own.

    ``files`` are written there before, by name; ``answer`` is the JSON file that the command leaves there, empty where
    it leaves none. With the exit codes ``codes`` there is one.
    """

    arguments: Sequence[str]
    files: Mapping[str, str] = field(default_factory=dict)
    answer: str = ""
    codes: frozenset[int] = frozenset({0})

    def lay_out(self, folder: Path) -> None:
        """Write what the command reads."""
        for name, text in self.files.items():
            (folder / name).write_text(text, encoding="utf-8")

    def outcome(self, code: int, said: Sequence[str], folder: Path) -> Any:
        """What the command has answered.

        Raises
        ------
        AadmError
            What it said instead.
        """
        if code not in self.codes:
            raise AadmError("\n".join(said[-_LAST_WORDS:]) or _ended_silently(code))
        if not self.answer:
            return None
        try:
            return json.loads((folder / self.answer).read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise NoEnvironmentError(f"{_ended_silently(code)} ({error})") from error


def run(work: Work) -> Any:
    """Do work and wait for it; raises what :meth:`Work.outcome` raises, and NoEnvironmentError where nothing can."""
    words = command(work.arguments)
    with tempfile.TemporaryDirectory(prefix="aadm-") as name:
        folder = Path(name)
        work.lay_out(folder)
        process = subprocess.Popen(
            words,
            cwd=folder,
            env=environment(),
            stdin=subprocess.PIPE,  # the process ends when this is closed: with FreeCAD, too
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        assert process.stdin is not None
        assert process.stderr is not None
        said = process.stderr.read().decode("utf-8", errors="replace").splitlines()
        code = process.wait()
        process.stdin.close()
        process.stderr.close()
        return work.outcome(code, [line.removeprefix("aadm: ") for line in said], folder)


def command(arguments: Sequence[str]) -> list[str]:
    """The words that run ``aadm`` with some arguments.

    Raises
    ------
    NoEnvironmentError
        Where there is neither a program that the user has named, nor the private environment, nor one on the PATH.
    """
    program = _setting("AadmProgram")
    if program:
        return [program, *arguments]
    made = made_environment()
    if made is not None:
        return made.command("batch", arguments)
    found = program_on_path(around(), os.environ.get("PATH", ""))
    if found is None:
        raise NoEnvironmentError(
            translate(
                "AADM",
                "This needs packages that FreeCAD does not bring. AADM installs them into a folder of their own, once; "
                "FreeCAD itself is not changed.",
            )
        )
    return [str(found), *arguments]


def made_environment() -> Environment | None:
    """The private environment; None where it has not been installed."""
    return find_environment(named_python(), around(), os.environ.get("PATH", ""))


def named_python() -> str:
    """The Python that the user has named for it; empty without."""
    return _setting("PythonProgram")


def around() -> Around:
    """Where this FreeCAD lies, with the folders that it has put on the PATH."""
    return around_this([Path(FreeCAD.getHomePath()), Path(FreeCAD.getUserAppDataDir())])


def environment() -> dict[str, str]:
    """Variables of the process: FreeCAD's own paths are none of its business, but where FreeCAD is, is."""
    found = plain_environment(os.environ)
    folders = (Path(FreeCAD.getHomePath()) / "bin", Path(sys.executable).parent)
    names = ("freecadcmd", "FreeCADCmd", "freecadcmd.exe", "FreeCADCmd.exe")
    program = next((folder / name for folder in folders for name in names if (folder / name).is_file()), None)
    if program is not None:
        found.setdefault(PROGRAM_VARIABLE, str(program))
    # For an aadm of the user's own, whose command line is not ours.
    return found | {"PYTHONIOENCODING": "utf-8", "PYTHONUNBUFFERED": "1"}


def _setting(name: str) -> str:
    return str(FreeCAD.ParamGet(_SETTINGS).GetString(name, "")).strip()


def _ended_silently(code: int) -> str:
    said = translate("AADM", "The process that checks ended with {code} and said nothing; repair its environment")
    return said.format(code=code)
