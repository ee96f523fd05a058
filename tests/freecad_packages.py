"""The Python packages that FreeCAD does not bring, for tests that need them inside it."""

import os
import sysconfig
from pathlib import Path

from tests.conftest import FreeCADRunner


def with_packages(runner: FreeCADRunner) -> FreeCADRunner:
    """A runner whose FreeCAD has the packages of this environment (or of AADM_FREECAD_PACKAGES) installed."""
    packages = Path(os.environ.get("AADM_FREECAD_PACKAGES") or sysconfig.get_path("purelib"))
    home = runner.folder / "home"
    home.mkdir(exist_ok=True)
    (home / "AdditionalPythonPackages").symlink_to(packages, target_is_directory=True)
    return runner
