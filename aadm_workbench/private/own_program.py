"""An ``aadm`` that somebody has installed by themselves: used where it is of this addon's version."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

from aadm_workbench import __version__
from aadm_workbench.private.pythons import Around, plain_environment

_ANSWER_S = 20.0  # a cold disk takes seconds


def program_on_path(around: Around, path: str) -> Path | None:
    """The ``aadm`` of a PATH, FreeCAD's own folders left out; None where there is none of this version."""
    entries = [entry for entry in path.split(os.pathsep) if entry and Path(entry) not in around.own_folders]
    found = shutil.which("aadm", path=os.pathsep.join(entries)) if entries else None
    return Path(found) if found and version_of(Path(found)) == __version__ else None


def version_of(program: Path) -> str:
    """The version that a program says it has; empty where it is no ``aadm``."""
    try:
        done = subprocess.run(
            [program, "--version"],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=_ANSWER_S,
            check=False,
            env=plain_environment(os.environ),
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
    except (OSError, ValueError, subprocess.SubprocessError):
        return ""
    name, _, version = done.stdout.strip().partition(" ")
    return version if name == "aadm" and done.returncode == 0 else ""
