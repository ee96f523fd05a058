"""An environment that was made: found, started, taken away."""

from __future__ import annotations

import json
import shutil
import sys
import uuid
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from aadm_workbench.private import pins
from aadm_workbench.private.holding import InUseError, hold
from aadm_workbench.private.pythons import NEWEST, OLDEST, Around, candidates, examined

_NOTE = "made.json"
_HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Environment:
    """A folder of packages and the Python that it is for."""

    folder: Path
    python: Path
    version: tuple[int, int]

    def command(self, module: str, arguments: Sequence[str] = ()) -> list[str]:
        """The words that run a module of this addon; the process ends when its standard input does."""
        return [str(self.python), *python_words(self.folder / "site", module), *arguments]


def python_words(site: Path, module: str) -> list[str]:
    """What follows the name of the Python: nothing that others have set for Python holds."""
    # Unbuffered and in UTF-8, for these two follow from no variable here.
    return ["-I", "-S", "-u", "-X", "utf8", str(_HERE / "launcher.py"), str(site), str(pins.ROOT), module]


def make_command(python: Path, wheels: str = "") -> list[str]:
    """The words that make the environment of a Python, from the network or from a folder of wheels."""
    words = [str(python), "-I", "-S", "-u", "-X", "utf8", str(_HERE / "make.py"), str(pins.ROOT)]
    return [*words, "--wheels", wheels] if wheels else words


def find_environment(named: str, around: Around, path: str) -> Environment | None:
    """The environment of today's pins for the first Python that has one; None without.

    Parameters
    ----------
    named
        A Python that the user has chosen, or empty.
    path
        A PATH.
    """
    made = [found for version in _versions() if (found := _read(version)) is not None]
    made = [found for found in made if not named or examined(Path(named)).version == found.version]
    for found in made:
        if found.python.is_file():
            return found
    # A bundle that is mounted elsewhere each time: its Python is the same, its place is another.
    for program in candidates(named, around, path) if made else ():
        answer = examined(program)
        for found in made:
            if not answer.problem and answer.version == found.version:
                return Environment(found.folder, answer.program, found.version)
    return None


def environment_folder(version: tuple[int, int]) -> Path:
    """Where the environment of today's pins for a version of Python lies, or would."""
    return pins.environments_folder() / pins.environment_name(version, pins.pins_file())


def write_note(folder: Path) -> None:
    """Write into a finished folder which Python it was made by."""
    note = {"python": sys.executable, "version": sys.version_info[:2], "pins": pins.pinned(pins.pins_file())}
    (folder / _NOTE).write_text(json.dumps(note, indent=1), encoding="utf-8")
    (folder / "in-use").touch()


def remove_folder(folder: Path) -> bool:
    """Take an environment away; False, and nothing is changed, where a process uses it."""
    try:
        if (folder / "in-use").exists():
            hold(folder / "in-use", alone=True).close()
        # Renamed first: nobody finds it half gone. Windows refuses where a file of it is open.
        aside = folder.rename(folder.with_name(f".new-{uuid.uuid4().hex}"))
    except (InUseError, PermissionError):
        return False
    shutil.rmtree(aside, ignore_errors=True)
    return True


def left_over() -> list[Path]:
    """Environments of other pins, which no version of this addon that is installed here asks for."""
    parent = pins.environments_folder()
    today = {environment_folder(version) for version in _versions()}
    return [path for path in sorted(parent.glob("py*-*")) if path.is_dir() and path not in today]


def _versions() -> list[tuple[int, int]]:
    return [(3, minor) for minor in range(OLDEST[1], NEWEST[1] + 1)]


def _read(version: tuple[int, int]) -> Environment | None:
    folder = environment_folder(version)
    try:
        note = json.loads((folder / _NOTE).read_text(encoding="utf-8"))
        return Environment(folder, Path(note["python"]), version)
    except (OSError, ValueError, KeyError, TypeError):
        return None
