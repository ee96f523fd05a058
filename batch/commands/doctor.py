"""Say what is installed, what is missing, and the command that installs it.

Exits with 0 where everything is there that a check needs, else with 12.
"""

from __future__ import annotations

import argparse
import platform
import re
import shutil
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, ERRORS, add_switches

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.errors import Package

EXAMPLE = """\
examples:
  aadm doctor
  aadm doctor --json"""
_SYSTEM_LIBRARY = re.compile(r"(\S+\.so[.\d]*): cannot open shared object file")
_DEBIAN = {
    "libusb-1.0.so.0": "libusb-1.0-0",
    "libGL.so.1": "libgl1",
    "libgomp.so.1": "libgomp1",
    "libX11.so.6": "libx11-6",
}
"""Packages of Debian and Ubuntu that hold what Open3D and the cameras' packages load."""
_FREECAD = ("freecadcmd", "FreeCADCmd", "freecad", "FreeCAD")


@dataclass(frozen=True)
class Finding:
    """What was found of one package; ``problem`` is empty where it can be imported."""

    package: str
    version: str | None
    needed_for: str
    core: bool
    problem: str
    remedy: str


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    add_switches(parser, prints_json="the findings")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print what is installed; 12 where something is missing that every check needs."""
    from aadm_workbench.errors import PACKAGES

    findings = [_examined(package) for package in PACKAGES]
    freecad = next((path for name in _FREECAD if (path := shutil.which(name))), None)
    if options.json:
        _print_json(findings, freecad)
    elif not options.quiet:
        _print(findings, freecad)
    return ERRORS if any(finding.core and finding.problem for finding in findings) else ALL_PASS


def _examined(package: Package) -> Finding:
    problem, system = "", ""
    try:
        # Installed is not enough: a missing system library shows only here.
        import_module(package.module)
    except ModuleNotFoundError as error:
        problem = "not installed" if error.name == package.module else f"cannot be loaded: {error}"
    except (ImportError, OSError) as error:
        problem, system = _not_loaded(error)
    found = next((known for name in (package.pip_name, *package.others) if (known := _version(name))), None)
    remedy = package.install if problem == "not installed" else system
    if package.module == "mitsuba" and not problem:
        problem, remedy = _without_llvm()
    return Finding(package.module, found, package.needed_for, not package.extra, problem, remedy)


def _not_loaded(error: ImportError | OSError) -> tuple[str, str]:
    """What keeps an installed package from being loaded, and what mends it: of a system library its Debian package."""
    missing = _SYSTEM_LIBRARY.match(str(error))
    if missing is None:
        return f"cannot be loaded: {error}", ""
    debian = _DEBIAN.get(missing[1])
    remedy = f"apt-get install {debian}" if debian else f"the system's package that holds {missing[1]}"
    return f"the system library {missing[1]} is missing", remedy


def _without_llvm() -> tuple[str, str]:
    """What is wrong with the LLVM that Mitsuba compiles with, and what mends it; both empty where nothing is."""
    from aadm_workbench.twin.fringe.renderer import INSTALL_LLVM, LEAST_LLVM, llvm_found

    found = llvm_found()
    if found >= LEAST_LLVM:
        return "", ""
    has = f"it finds LLVM {found}" if found else "it finds no LLVM"
    return f"{has} and needs {LEAST_LLVM} or newer", INSTALL_LLVM


def _version(distribution: str) -> str | None:
    try:
        return version(distribution)
    except PackageNotFoundError:
        return None


def _print_json(findings: Sequence[Finding], freecad: str | None) -> None:
    import json

    from aadm_workbench import __version__

    document = {
        "aadm": __version__,
        "python": platform.python_version(),
        "executable": sys.executable,
        "platform": platform.platform(),
        "packages": [asdict(finding) for finding in findings],
        "freecad": freecad,
    }
    sys.stdout.write(json.dumps(document, indent=1) + "\n")


def _print(findings: Sequence[Finding], freecad: str | None) -> None:
    """Without rich itself where that is what is missing."""
    from aadm_workbench import __version__

    lines = [f"aadm {__version__}, Python {platform.python_version()} ({sys.executable}), {platform.platform()}"]
    found = f"FreeCAD: {freecad}" if freecad else "FreeCAD: not found; the command does not need it, the workbench does"
    missing_core = [finding.package for finding in findings if finding.core and finding.problem]
    if "rich" in missing_core:
        rows = [f"{one.package}: {one.problem or one.version or 'installed'} {one.remedy}" for one in findings]
        sys.stdout.write("\n".join([*lines, "", *rows, "", found, _conclusion(missing_core)]) + "\n")
        return
    from ..shown.terminal import show

    show(*lines, "", _table(findings), "", found, _conclusion(missing_core))


def _conclusion(missing_core: Sequence[str]) -> str:
    return f"Missing for every check: {', '.join(missing_core)}" if missing_core else "Ready to check columns"


def _table(findings: Sequence[Finding]) -> Table:
    from ..shown.terminal import new_table

    table = new_table("Package", "Version", "Needed for", "", "Install it with")
    for finding in findings:
        state = finding.problem or "✓"
        table.add_row(finding.package, finding.version or "", finding.needed_for, state, finding.remedy)
    return table
