"""One session in FreeCAD's window for all tests of this folder: starting it takes longer than each of them."""

import fcntl
import json
import os
import shutil
import tomllib
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import ROOT, FreeCADRunner, find_freecad
from tests.freecad_environment import with_environment
from tests.gui.model_text import MODEL

_BODIES = tuple(
    f"{name}_body.py"
    for name in (
        "bare",
        "session",
        "results",
        "capture",
        "starts",
        "floor",
        "private",
        "floor_check",
        "legible",
        "looks",
        "end",
    )
)


@pytest.fixture(scope="session")
def session(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What the scripted session found; its pictures lie in the folder ``session["folder"]``."""
    shared = tmp_path_factory.getbasetemp()
    if os.environ.get("PYTEST_XDIST_WORKER"):
        # Several test processes, one session: who comes second waits and reads what the first has found.
        shared = shared.parent
    found = shared / "freecad-session.json"
    with (shared / "freecad-session.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not found.exists():
            folder = tmp_path_factory.mktemp("session")
            content = {**_run(folder, request.getfixturevalue("x_display")), "folder": str(folder)}
            found.write_text(json.dumps(content), encoding="utf-8")
    result: dict[str, Any] = json.loads(found.read_text(encoding="utf-8"))
    return {**result, "folder": Path(result["folder"])}


def _run(folder: Path, display: str) -> dict[str, Any]:
    runner = with_environment(FreeCADRunner(find_freecad("freecad", "FreeCAD"), folder, display))
    bodies = [(Path(__file__).parent / name).read_text(encoding="utf-8") for name in _BODIES]
    given = f"MODEL = {MODEL!r}\nSAMPLES = {str(ROOT / 'samples')!r}\n"
    camera = tomllib.loads((ROOT / "samples/floor/job.toml").read_text(encoding="utf-8"))["camera"]
    given += f"CAMERA = {''.join(f'{key} = {value!r}' + chr(10) for key, value in camera.items())!r}\n"
    given += f"FREECADCMD = {str(find_freecad('freecadcmd', 'FreeCADCmd'))!r}\n"
    result = runner.run(given + "\n".join(bodies), timeout_s=1200.0)
    if os.environ.get("AADM_DOCUMENTS"):
        # For the other versions of FreeCAD, which must be able to open it.
        shutil.copy(folder / "session.FCStd", Path(os.environ["AADM_DOCUMENTS"]) / f"{result['freecad']}.FCStd")
    return result
