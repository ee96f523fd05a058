"""Fixtures for all tests: the repository, FreeCAD without a screen and FreeCAD in a window of a virtual screen."""

import json
import os
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.design.freecad_program import PROGRAM_VARIABLE

ROOT = Path(__file__).resolve().parents[1]

# Spares the start page, which dies where root runs FreeCAD 0.20, and the time that it and the splash screen take.
USER_CFG = """<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters><FCParamGroup Name="Root"><FCParamGroup Name="BaseApp"><FCParamGroup Name="Preferences">
<FCParamGroup Name="General"><FCText Name="AutoloadModule">PartWorkbench</FCText><FCBool Name="ShowSplasher" Value="0"/>
</FCParamGroup><FCParamGroup Name="Mod">
<FCParamGroup Name="Start"><FCBool Name="ShowOnStartup" Value="0"/></FCParamGroup>
</FCParamGroup></FCParamGroup></FCParamGroup></FCParamGroup></FCParameters>
"""

# FreeCAD ends with 0 whatever a script did, so the script itself says how it went, in a file.
WRAPPER = """\
import json, pathlib, sys, traceback
folder = pathlib.Path({folder!r})
result = {{}}
def go():
    try:
        body = compile((folder / "body.py").read_text(encoding="utf-8"), "body.py", "exec")
        exec(body, {{"result": result, "folder": folder}})
    except BaseException:
        result["traceback"] = traceback.format_exc()
    finally:
        (folder / "result.json").write_text(json.dumps(result), encoding="utf-8")
"""
WITHOUT_SCREEN = "go()\nsys.exit(0)\n"
IN_WINDOW = """\
from PySide import QtCore
import FreeCAD, FreeCADGui
def start():
    go()
    for name in list(FreeCAD.listDocuments()):
        FreeCAD.closeDocument(name)
    FreeCADGui.getMainWindow().close()
QtCore.QTimer.singleShot(0, start)
"""


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Leave out what is marked, where that was asked for."""
    if os.environ.get("AADM_SKIP_FREECAD") == "1" and item.get_closest_marker("freecad"):
        pytest.skip("it runs FreeCAD, and AADM_SKIP_FREECAD=1")


@pytest.fixture(autouse=True)
def no_freecad_without_the_mark(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """A test that lacks the mark finds no FreeCAD: so AADM_SKIP_FREECAD=1 leaves out all that need one."""
    if not request.node.get_closest_marker("freecad"):
        monkeypatch.setenv(PROGRAM_VARIABLE, "a-test-that-runs-freecad-needs-the-mark")


@pytest.fixture(scope="session")
def repository() -> Path:
    """The folder that holds package.xml."""
    return ROOT


def find_freecad(*names: str) -> Path:
    """Path of the first of some commands; without one the test fails, or is left out where that was asked for."""
    found = next((path for name in names if (path := shutil.which(name))), None)
    if found is not None:
        return Path(found)
    if os.environ.get("AADM_SKIP_FREECAD") == "1":
        pytest.skip(f"{names[0]} is not installed, and AADM_SKIP_FREECAD=1")
    pytest.fail(f"{names[0]} is not installed (apt-get install freecad xvfb); AADM_SKIP_FREECAD=1 leaves this test out")


@pytest.fixture(scope="session")
def freecadcmd() -> Path:
    """FreeCAD without a screen."""
    return find_freecad("freecadcmd", "FreeCADCmd")


@pytest.fixture(scope="session")
def x_display() -> Iterator[str]:
    """``DISPLAY`` of a virtual screen of this test process; Xvfb itself picks a free number."""
    readable, writable = os.pipe()
    options = ["-displayfd", str(writable), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"]
    process = subprocess.Popen([find_freecad("Xvfb"), *options], pass_fds=[writable], stderr=subprocess.DEVNULL)
    os.close(writable)
    with os.fdopen(readable) as numbers:
        number = numbers.readline().strip()
    assert number, "Xvfb did not start"
    yield f":{number}"
    process.terminate()
    process.wait(timeout=10)


def without_aadm(path: str) -> str:
    """A PATH without the folders that hold an ``aadm``, which the workbench would use."""
    return os.pathsep.join(entry for entry in path.split(os.pathsep) if not (Path(entry) / "aadm").exists())


@dataclass(frozen=True)
class FreeCADRunner:
    """Runs Python text in the real FreeCAD, with the addon where the Addon Manager would put it.

    The text finds a dict ``result`` to fill (JSON values) and ``folder``, an empty folder for its files.
    """

    program: Path
    folder: Path
    display: str = ""
    environments: Path | None = None
    """Folder of private environments; without one FreeCAD finds none, and no ``aadm`` either."""

    def run(self, body: str, *, python_path: str = "", timeout_s: float = 120.0) -> dict[str, Any]:
        """What the text put into ``result``; an exception inside FreeCAD fails the test."""
        home = self.folder / "home"
        (home / "Mod").mkdir(parents=True, exist_ok=True)
        (home / "user.cfg").write_text(USER_CFG, encoding="utf-8")
        if not (home / "Mod" / "AADM").exists():
            (home / "Mod" / "AADM").symlink_to(ROOT, target_is_directory=True)
        (self.folder / "result.json").unlink(missing_ok=True)
        (self.folder / "body.py").write_text(body, encoding="utf-8")
        script = self.folder / "script.py"
        ending = IN_WINDOW if self.display else WITHOUT_SCREEN
        script.write_text(WRAPPER.format(folder=str(self.folder)) + ending, encoding="utf-8")
        environment = os.environ | {
            "AADM_ENVIRONMENTS": str(self.environments or home / "no environments"),
            "DISPLAY": self.display,
            "FREECAD_USER_HOME": str(home),
            "HOME": str(home),
            "LIBGL_ALWAYS_SOFTWARE": "1",
            "PATH": without_aadm(os.environ["PATH"]),
            "PYTHONPATH": python_path,
            "QT_QPA_PLATFORM": "xcb" if self.display else "offscreen",
        }
        with (self.folder / "output.txt").open("w+", encoding="utf-8", errors="replace") as output:
            subprocess.run(
                [self.program, script],
                check=False,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                timeout=timeout_s,
            )
            output.seek(0)
            printed = output.read()
        assert (self.folder / "result.json").exists(), f"FreeCAD did not run the script:\n{printed}"
        result: dict[str, Any] = json.loads((self.folder / "result.json").read_text(encoding="utf-8"))
        assert "traceback" not in result, f"{result['traceback']}\n{printed}"
        return result | {"printed": printed}


@pytest.fixture
def freecad(freecadcmd: Path, tmp_path: Path) -> FreeCADRunner:
    """FreeCAD without a screen: ``freecad.run("import FreeCAD; result['version'] = FreeCAD.Version()")``."""
    return FreeCADRunner(freecadcmd, tmp_path)


@pytest.fixture
def freecad_window(x_display: str, tmp_path: Path) -> FreeCADRunner:
    """FreeCAD in a window of a virtual screen."""
    return FreeCADRunner(find_freecad("freecad", "FreeCAD"), tmp_path, x_display)
