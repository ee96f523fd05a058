"""An addon's folder with small packages of its own, in a place with spaces and Chinese, and a home without anything."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path

from tests.conftest import ROOT

PACKAGES = {"lazrs": "ready = True\n", "tifffile": "import lazrs\n"}
"""Names that the product knows, so that each is proved to be importable; what they hold is ours."""

QUICK_PIP = """\
import pathlib, sys, zipfile
words = dict(zip(sys.argv, sys.argv[1:]))
for wheel in pathlib.Path(words["--find-links"]).glob("*.whl"):
    print("Processing", wheel)
    zipfile.ZipFile(wheel).extractall(words["--target"])
"""
"""Does what pip does with good wheels, without the seconds that pip takes to start out of a wheel."""

ENDLESS_PIP = """\
import pathlib, sys, time
site = pathlib.Path(dict(zip(sys.argv, sys.argv[1:]))["--target"])
site.mkdir()
(site / "begun.py").touch()
print("Collecting lazrs", flush=True)
time.sleep(600)
"""
"""A pip that waits for a server that does not answer."""


@dataclass(frozen=True)
class Addon:
    """The folder of package.xml, the folder of its wheels, and where environments are made."""

    root: Path
    wheels: Path
    environments: Path

    def variables(self, **more: str) -> dict[str, str]:
        """Those of somebody whose shell points Python and Qt at other places."""
        hostile = {"PYTHONHOME": "/nowhere", "PYTHONPATH": str(self.root / "hostile"), "QT_PLUGIN_PATH": "/nowhere"}
        kept = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
        return kept | hostile | {"AADM_ENVIRONMENTS": str(self.environments)} | more

    def words(self, program: str, *arguments: str) -> list[str]:
        """The command line that runs one of the addon's own files in this Python."""
        script = self.root / "aadm_workbench" / "private" / program
        return [sys.executable, "-I", "-S", "-u", "-X", "utf8", str(script), *arguments]

    def start(self, *arguments: str, **variables: str) -> subprocess.Popen[str]:
        """Begin to make the environment."""
        return subprocess.Popen(
            self.words("make.py", str(self.root), *arguments),
            env=self.variables(**variables),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def make(self, *arguments: str, **variables: str) -> list[str]:
        """Make it, or try to; the lines that it says."""
        process = self.start(*(arguments or ("--wheels", str(self.wheels))), **variables)
        assert process.stdout is not None
        said = process.stdout.read().splitlines()
        assert process.wait(60) == (1 if said[-1].startswith("!") else 0), said
        return said

    def made(self) -> list[Path]:
        """Folders of environments, those that are half made among them."""
        found = self.environments.iterdir() if self.environments.exists() else ()
        return sorted(path for path in found if path.is_dir())


def make_addon(folder: Path, packages: dict[str, str], pip: str = "") -> Addon:
    """Lay out an addon whose pins are these packages; ``pip`` is the text of another pip than the real one."""
    root = folder / "附加 组件" / "AADM"
    (root / "aadm_workbench").mkdir(parents=True)
    for name in ("__init__.py", "errors.py"):
        shutil.copy(ROOT / "aadm_workbench" / name, root / "aadm_workbench" / name)
    shutil.copytree(ROOT / "aadm_workbench" / "private", root / "aadm_workbench" / "private")
    (root / "requirements").mkdir()
    if pip:
        with zipfile.ZipFile(root / "requirements" / "pip-0-py3-none-any.whl", "w") as wheel:
            wheel.writestr("pip/__main__.py", pip)
    else:
        shutil.copy(next((ROOT / "requirements").glob("pip-*.whl")), root / "requirements")
    pins = "".join(f"{name}==1.0\n" for name in packages)
    (root / "requirements" / "freecad.txt").write_text(pins, encoding="utf-8")
    (root / "hostile").mkdir()
    (root / "hostile" / "json.py").write_text("raise SystemExit('a json of somebody else')\n")
    wheels = folder / "轮 子"
    wheels.mkdir()
    for name, text in packages.items():
        write_wheel(wheels, name, text)
    return Addon(root, wheels, folder / "环境 environments")


def write_wheel(folder: Path, name: str, text: str) -> None:
    """A wheel of one module, as PEP 427 has it."""
    info = f"{name}-1.0.dist-info"
    with zipfile.ZipFile(folder / f"{name}-1.0-py3-none-any.whl", "w") as wheel:
        wheel.writestr(f"{name}.py", text)
        wheel.writestr(f"{info}/METADATA", f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
        wheel.writestr(
            f"{info}/WHEEL", "Wheel-Version: 1.0\nGenerator: a test\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        )
        wheel.writestr(f"{info}/RECORD", f"{name}.py,,\n{info}/METADATA,,\n{info}/WHEEL,,\n{info}/RECORD,,\n")
