"""Which Python the private environment is made with: the first one near FreeCAD or on the PATH that will do."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

OLDEST, NEWEST = (3, 11), (3, 14)
"""The pins have wheels for these and for no other, see requirements/renew.sh."""

_ANSWER_S = 20.0  # a cold disk takes seconds; the stub of the Windows store waits for ever
_QUESTION = "import json, sys; print(json.dumps([*sys.version_info[:2], sys.maxsize > 2**32, sys.executable]))"
_NO_WINDOW = getattr(subprocess, "CREATE_NO_WINDOW", 0)  # Windows opens a black one for each process otherwise


@dataclass(frozen=True)
class Around:
    """Where FreeCAD's own interpreter lies: ``sys.prefix``, ``sys.executable`` and ``sys.version_info[:2]`` in it.

    ``own_folders`` are those that FreeCAD has put on the PATH: its own and those of its addons.
    """

    prefix: Path
    executable: Path
    version: tuple[int, int]
    own_folders: tuple[Path, ...] = ()


@dataclass(frozen=True)
class FoundPython:
    """A Python that answered; ``problem`` says why it will not do, and is empty where it will."""

    program: Path
    version: tuple[int, int] = (0, 0)
    problem: str = ""


def candidates(named: str, around: Around, path: str) -> Iterator[Path]:
    """Programs that may be a Python, each once: the one that is named alone, else near FreeCAD, then on a PATH."""
    if named:
        yield Path(named)
        return
    seen: set[Path] = set()
    for program in (*_beside(around), *_on_path(path, around)):
        if program not in seen and program.is_file():
            seen.add(program)
            yield program


def _names(version: tuple[int, int]) -> tuple[str, ...]:
    exact = f"python{version[0]}.{version[1]}"
    return exact, "python3", "python", f"{exact}.exe", "python3.exe", "python.exe"


def _beside(around: Around) -> Iterator[Path]:
    """Bundles: AppImage and macOS keep it in bin, Windows beside freecad.exe or above its bin."""
    folder = around.executable.parent
    contents = folder.parent  # of an .app, whose program lies in Contents/MacOS
    for place in (around.prefix / "bin", around.prefix, folder, folder / "bin", contents / "Resources" / "bin"):
        for name in _names(around.version):
            yield place / name


def _on_path(path: str, around: Around) -> Iterator[Path]:
    for entry in path.split(os.pathsep):
        folder = Path(entry)
        if entry and not any(folder == own or own in folder.parents for own in around.own_folders):
            for name in _names(around.version):
                yield folder / name


def examined(program: Path) -> FoundPython:
    """What a program says of itself, asked without anything that this process or its user have set for Python."""
    try:
        done = subprocess.run(
            [program, "-I", "-S", "-c", _QUESTION],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=_ANSWER_S,
            check=False,
            creationflags=_NO_WINDOW,
            env=plain_environment(os.environ),
        )
        major, minor, is_64_bit, executable = json.loads(done.stdout)
    except (OSError, ValueError, TypeError, subprocess.SubprocessError):
        return FoundPython(program, problem="it does not answer as a Python does")
    version = (int(major), int(minor))
    problem = ""
    if not OLDEST <= version <= NEWEST:
        problem = f"it is Python {major}.{minor}, needed is {OLDEST[0]}.{OLDEST[1]} to {NEWEST[0]}.{NEWEST[1]}"
    elif not is_64_bit:
        problem = "it is a Python of 32 bits, needed is one of 64"
    return FoundPython(Path(executable or program), version, problem)


def find_python(programs: Iterable[Path]) -> tuple[FoundPython | None, tuple[FoundPython, ...]]:
    """The first Python that will do, and those before it that will not."""
    refused: list[FoundPython] = []
    for program in programs:
        found = examined(program)
        if not found.problem:
            return found, tuple(refused)
        refused.append(found)
    return None, tuple(refused)


def around_this(own_folders: Iterable[Path]) -> Around:
    """Where the interpreter lies that this runs in."""
    version = (sys.version_info.major, sys.version_info.minor)
    return Around(Path(sys.prefix), Path(sys.executable or sys.argv[0]), version, tuple(own_folders))


def plain_environment(given: Iterable[tuple[str, str]] | os._Environ[str] | dict[str, str]) -> dict[str, str]:
    """Variables for a process that is not FreeCAD: without those by which FreeCAD's bundle points at its own files."""
    kept = {name: value for name, value in dict(given).items() if not name.startswith(("PYTHON", "QT_PLUGIN"))}
    bundle = kept.get("APPDIR", "")
    if bundle:
        for name in ("LD_LIBRARY_PATH", "LD_PRELOAD", "SSL_CERT_FILE", "SSL_CERT_DIR", "GSETTINGS_SCHEMA_DIR"):
            if bundle in kept.get(name, ""):
                del kept[name]
    return kept
