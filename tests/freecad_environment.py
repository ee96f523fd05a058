"""The private environment for tests that need packages beside FreeCAD: made by what the workbench's button runs."""

import fcntl
import os
import subprocess
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from aadm_workbench.private.environment import make_command
from aadm_workbench.private.pins import environment_name, pins_file
from aadm_workbench.private.pythons import examined, plain_environment
from tests.conftest import ROOT, FreeCADRunner

_FOLDER = ROOT / "build" / "environments"
_LIMIT_S = 900  # a slow network; the packages are 180 MB


@cache
def environments() -> Path:
    """The folder of environments, with that of today's pins in it; kept for the next run of the tests."""
    folder = Path(os.environ.get("AADM_ENVIRONMENTS") or _FOLDER)
    folder.mkdir(parents=True, exist_ok=True)
    # The Python that FreeCAD's own window would find: that of the system.
    python = examined(Path("/usr/bin/python3"))
    assert not python.problem, python.problem
    with (folder / "tests.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (folder / environment_name(python.version, pins_file())).is_dir():
            variables = plain_environment(os.environ) | {"AADM_ENVIRONMENTS": str(folder)}
            process = subprocess.Popen(
                make_command(python.program),
                env=variables,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
            )
            assert process.stdout is not None
            said = process.stdout.read()
            if process.wait(_LIMIT_S) != 0:
                pytest.fail(f"the private environment could not be installed:\n{said[-3000:]}")
    return folder


def with_environment(runner: FreeCADRunner) -> FreeCADRunner:
    """A runner whose FreeCAD finds the private environment installed."""
    return replace(runner, environments=environments())
