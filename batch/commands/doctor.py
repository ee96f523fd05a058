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
    from aadm_workbench.report.words.labels import Phrase

    from ..shown.told import Words

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
    """What was found of one package; ``problem`` is empty where it can be imported, in every language."""

    package: str
    version: str | None
    needed_for: str
    core: bool
    problem: Phrase
    remedy: Phrase

    def document(self) -> dict[str, object]:
        """What ``--json`` says of it: in English."""
        return {**asdict(self), "problem": self.problem.en, "remedy": self.remedy.en}


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
        from ..shown.told import words_for

        _print(findings, freecad, words_for(options, "told_doctor"))
    return ERRORS if any(finding.core and finding.problem.en for finding in findings) else ALL_PASS


def _examined(package: Package) -> Finding:
    from aadm_workbench.report.words.labels import Phrase, phrase

    nothing = Phrase("", "")
    problem, system = nothing, nothing
    try:
        # Installed is not enough: a missing system library shows only here.
        import_module(package.module)
    except ModuleNotFoundError as error:
        missing = error.name == package.module
        problem = phrase("told_doctor.not_installed") if missing else phrase("told_doctor.not_loaded", error=error)
        system = Phrase(package.install, package.install) if missing else nothing
    except (ImportError, OSError) as error:
        problem, system = _not_loaded(error)
    found = next((known for name in (package.pip_name, *package.others) if (known := _version(name))), None)
    if package.module == "mitsuba" and not problem.en:
        problem, system = _without_llvm() or (nothing, nothing)
    return Finding(package.module, found, package.needed_for, not package.extra, problem, system)


def _not_loaded(error: ImportError | OSError) -> tuple[Phrase, Phrase]:
    """What keeps an installed package from being loaded, and what mends it: of a system library its Debian package."""
    from aadm_workbench.report.words.labels import Phrase, phrase

    missing = _SYSTEM_LIBRARY.match(str(error))
    if missing is None:
        return phrase("told_doctor.not_loaded", error=error), Phrase("", "")
    debian = _DEBIAN.get(missing[1])
    remedy = phrase("told_doctor.holds", library=missing[1])
    if debian:
        remedy = Phrase(f"apt-get install {debian}", f"apt-get install {debian}")
    return phrase("told_doctor.library", library=missing[1]), remedy


def _without_llvm() -> tuple[Phrase, Phrase] | None:
    """What is wrong with the LLVM that Mitsuba compiles with, and what mends it; None where nothing is."""
    from aadm_workbench.report.words.labels import Phrase, phrase
    from aadm_workbench.twin.fringe.renderer import INSTALL_LLVM, LEAST_LLVM, llvm_found

    found = llvm_found()
    if found >= LEAST_LLVM:
        return None
    problem = "llvm" if found else "no_llvm"
    said = phrase(f"told_doctor.{problem}", found=found, least=LEAST_LLVM)
    return said, Phrase(INSTALL_LLVM, INSTALL_LLVM)


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
        "packages": [finding.document() for finding in findings],
        "freecad": freecad,
    }
    sys.stdout.write(json.dumps(document, indent=1) + "\n")


def _print(findings: Sequence[Finding], freecad: str | None, words: Words) -> None:
    """Without rich itself where that is what is missing."""
    from aadm_workbench import __version__

    lines = [f"aadm {__version__}, Python {platform.python_version()} ({sys.executable}), {platform.platform()}"]
    found = words.of("FreeCAD", freecad) if freecad else words("no_freecad")
    missing_core = [finding.package for finding in findings if finding.core and finding.problem.en]
    conclusion = words("missing", names=words.listed(missing_core)) if missing_core else words("ready")
    if "rich" in missing_core:
        rows = [
            words.of(one.package, f"{_state(one, words) or one.version or words('installed')} {_remedy(one, words)}")
            for one in findings
        ]
        sys.stdout.write("\n".join([*lines, "", *rows, "", found, conclusion]) + "\n")
        return
    from ..shown.terminal import show

    show(*lines, "", _table(findings, words), "", found, conclusion)


def _state(finding: Finding, words: Words) -> str:
    return finding.problem.in_language(words.language)


def _remedy(finding: Finding, words: Words) -> str:
    return finding.remedy.in_language(words.language)


def _table(findings: Sequence[Finding], words: Words) -> Table:
    table = words.table("package", "version", "needed_for", "", "remedy")
    for finding in findings:
        state, needed_for = _state(finding, words) or "✓", words(f"needed_for.{finding.package}")
        table.add_row(finding.package, finding.version or "", needed_for, state, _remedy(finding, words))
    return table
