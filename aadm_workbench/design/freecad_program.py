"""FreeCAD without a screen, wherever it is installed, as a program that does one piece of work in a time limit."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aadm_workbench.errors import DesignError, MissingDependencyError
from aadm_workbench.model import Reason

PROGRAM_VARIABLE = "AADM_FREECADCMD"
SECONDS_VARIABLE = "AADM_FREECAD_SECONDS"
LIMIT_S = 600.0
"""For one file: what takes ten minutes has hung."""

_NAMES = ("freecadcmd", "FreeCADCmd", "freecadcmd-daily", "freecadcmd-stable", "freecad.cmd")
_FOLDERS = (
    "/usr/bin",
    "/usr/local/bin",
    "/usr/lib/freecad/bin",
    "/usr/lib64/freecad/bin",
    "/snap/bin",
    "/opt/freecad/bin",
)
_PATTERNS = (
    "/opt/*[Ff]ree[Cc][Aa][Dd]*/bin/*ree*md",
    "/opt/*[Ff]ree[Cc][Aa][Dd]*/usr/bin/*ree*md",
    "/Applications/FreeCAD*.app/Contents/Resources/bin/*ree*md",
    "/Applications/FreeCAD*.app/Contents/MacOS/*ree*md",
    "~/Applications/FreeCAD*.app/Contents/Resources/bin/*ree*md",
    "~/Applications/FreeCAD*.app/Contents/MacOS/*ree*md",
)
_WINDOWS_FOLDERS = ("ProgramFiles", "ProgramW6432", "ProgramFiles(x86)", "LOCALAPPDATA")
_APPIMAGES = (
    "/opt",
    "/opt/*",
    "~",
    "~/Applications",
    "~/AppImages",
    "~/bin",
    "~/.local/bin",
    "~/Downloads",
    "~/Desktop",
)
_FLATPAK = "org.freecad.FreeCAD"
_FLATPAK_FOLDERS = ("/var/lib/flatpak/app", "~/.local/share/flatpak/app")
_OUTPUT_LINES = 4  # the last ones say what went wrong

# FreeCAD ends with 0 whatever a script did and may run it twice: the script itself says how it went, in a file. Only
# this package comes from outside, and no other of the Python that started FreeCAD, which may be of another version.
_SCRIPT = """\
import json, pathlib, sys
folder = pathlib.Path({folder!r})
answer = {{}}
try:
    if sys.version_info < (3, 11):
        version = sys.version.split()[0]
        answer["error"] = "its Python is " + version + ", at least 3.11 is needed: install FreeCAD 1.0 or newer"
    else:
        import importlib.util
        package = pathlib.Path({package!r})
        spec = importlib.util.spec_from_file_location(
            "aadm_workbench", package / "__init__.py", submodule_search_locations=[str(package)]
        )
        sys.modules["aadm_workbench"] = module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        from importlib import import_module
        answer["result"] = import_module({module!r}).answer(json.loads({question!r}))
except BaseException as error:
    import traceback
    answer["error"] = str(error) or type(error).__name__
    answer["kind"] = type(error).__name__
    answer["where"] = traceback.format_exc()
finally:
    (folder / "answer.part").write_text(json.dumps(answer), encoding="utf-8")
    (folder / "answer.part").replace(folder / "answer.json")
sys.exit(0)
"""


class CrashError(DesignError):
    """FreeCAD came down over a file, without a word on why."""


@dataclass(frozen=True)
class FreeCADProgram:
    """How FreeCAD is started: the words before its own arguments, and whether it sees no other folders than home's."""

    command: tuple[str, ...]
    confined: bool = False


def find_freecad() -> FreeCADProgram:
    """FreeCAD's command-line program: named by AADM_FREECADCMD, else the first that is installed.

    Raises
    ------
    MissingDependencyError
        Where none is found; says what to install.
    DesignError
        Where AADM_FREECADCMD names no program.
    """
    named = os.environ.get(PROGRAM_VARIABLE)
    if named:
        found = shutil.which(named)
        if found is None:
            raise DesignError(Reason("design.no_program", variable=PROGRAM_VARIABLE, named=repr(named)))
        return _program(Path(found))
    for path in _candidates():
        if path.is_file() and os.access(path, os.X_OK):
            return _program(path)
    flatpak = shutil.which("flatpak")
    if flatpak and any((Path(folder).expanduser() / _FLATPAK).is_dir() for folder in _FLATPAK_FOLDERS):
        return FreeCADProgram((flatpak, "run", "--filesystem=host", "--command=FreeCADCmd", _FLATPAK))
    raise MissingDependencyError(
        "FreeCAD",
        "reading FreeCAD documents, STEP and BREP",
        f"apt-get install freecad, or from www.freecad.org; where it is installed elsewhere, set {PROGRAM_VARIABLE} to "
        "its freecadcmd",
    )


def _candidates() -> Iterator[Path]:
    for name in _NAMES:
        found = shutil.which(name)
        if found:
            yield Path(found)
    beside = Path(sys.executable).parent
    for folder in (*(Path(folder) for folder in _FOLDERS), beside, beside / "Library" / "bin"):
        for name in _NAMES:
            yield from (folder / name, folder / f"{name}.exe")
    for pattern in _PATTERNS:
        yield from _matching(pattern)
    for variable in _WINDOWS_FOLDERS:
        root = os.environ.get(variable)
        if root:
            yield from sorted(Path(root).glob("FreeCAD*/bin/[Ff]ree[Cc][Aa][Dd][Cc]md.exe"), reverse=True)
            yield from sorted(Path(root).glob("Programs/FreeCAD*/bin/[Ff]ree[Cc][Aa][Dd][Cc]md.exe"), reverse=True)
    for folder_pattern in _APPIMAGES:
        yield from _matching(f"{folder_pattern}/*[Ff]ree[Cc][Aa][Dd]*.[Aa]pp[Ii]mage")


def _matching(pattern: str) -> Iterator[Path]:
    """Files of a pattern from the root or from home, the newest version first."""
    path = Path(pattern).expanduser()
    if path.drive or path.anchor:
        yield from sorted(Path(path.anchor).glob(str(path.relative_to(path.anchor))), reverse=True)


def _program(path: Path) -> FreeCADProgram:
    if path.suffix.lower() == ".appimage":
        return FreeCADProgram((str(path), "freecadcmd"))
    return FreeCADProgram((str(path),), confined=path.parent.as_posix() == "/snap/bin")


def ask_freecad(module: str, question: Mapping[str, Any], about: str) -> Any:
    """What a module of ``document/`` answers to a question, in a FreeCAD that is started for it.

    Parameters
    ----------
    module
        Full name of the module; its function ``answer(question)`` gives a JSON value.
    question
        JSON values.
    about
        The file that it is about, for messages.

    Raises
    ------
    CrashError
        Where FreeCAD crashes.
    DesignError
        Where it takes too long, or the module says that the file cannot be used.
    MissingDependencyError
        Where FreeCAD is not installed.
    """
    program = find_freecad()
    where = Path.home() if program.confined else None
    with tempfile.TemporaryDirectory(prefix="aadm-freecad-", dir=where, ignore_cleanup_errors=True) as name:
        folder = Path(name)
        script = folder / "sample.py"
        package = Path(__file__).resolve().parents[1]
        text = _SCRIPT.format(
            folder=str(folder), package=str(package), module=module, question=json.dumps(question, ensure_ascii=True)
        )
        script.write_text(text, encoding="utf-8")
        printed = _run([*program.command, str(script)], folder, about)
        return _answer(folder / "answer.json", about, printed)


def _run(command: Sequence[str], folder: Path, about: str) -> str:
    """Run FreeCAD; returns the end of what it printed."""
    limit_s = _limit_s()
    with (folder / "printed.txt").open("w+", encoding="utf-8", errors="replace") as printed:
        try:
            process = subprocess.Popen(
                command,
                cwd=folder,
                env=_environment(folder),
                stdin=subprocess.DEVNULL,
                stdout=printed,
                stderr=subprocess.STDOUT,
                start_new_session=os.name != "nt",
            )
        except OSError as error:
            raise DesignError(
                Reason("design.program_start", about=about, command=command[0], why=error.strerror)
            ) from error
        try:
            process.wait(timeout=limit_s)
        except subprocess.TimeoutExpired as error:
            _end(process)
            raise DesignError(
                Reason("design.program_late", about=about, limit_s=limit_s, variable=SECONDS_VARIABLE)
            ) from error
        except BaseException:
            _end(process)
            raise
        printed.seek(0)
        return " / ".join(line.strip() for line in printed.read().splitlines()[-_OUTPUT_LINES:] if line.strip())


def _limit_s() -> float:
    written = os.environ.get(SECONDS_VARIABLE)
    try:
        limit_s = float(written) if written else LIMIT_S
    except ValueError:
        limit_s = 0.0
    if not 0.0 < limit_s < 1e6:
        raise DesignError(Reason("design.program_seconds", variable=SECONDS_VARIABLE, written=repr(written)))
    return limit_s


def _environment(folder: Path) -> dict[str, str]:
    """A home of its own, so that nobody's addons and settings change what is read; and no Python of others."""
    kept = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONHOME", "DISPLAY")}
    home = folder / "home"
    home.mkdir()
    return kept | {
        "APPIMAGE_EXTRACT_AND_RUN": "1",
        "FREECAD_USER_HOME": str(home),
        "PYTHONDONTWRITEBYTECODE": "1",
        "QT_QPA_PLATFORM": "offscreen",
    }


def _end(process: subprocess.Popen[Any]) -> None:
    """End FreeCAD and what it started."""
    if os.name == "nt":
        process.kill()
    else:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _answer(path: Path, about: str, printed: str) -> Any:
    try:
        answer = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        code = "design.program_ended.words" if printed else "design.program_ended"
        raise CrashError(Reason(code, about=about, printed=printed)) from error
    if "error" in answer:
        raise DesignError(Reason("design.program_failed", about=about, why=answer["error"]))
    return answer["result"]
