"""Python packages that FreeCAD does not bring: which command needs them, and how they get into FreeCAD's own folder."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import FreeCAD

from aadm_workbench import errors
from aadm_workbench.errors import MissingDependencyError

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
translate = FreeCAD.Qt.translate


@dataclass(frozen=True)
class Package:
    """A package by the name it is imported by and by the one that pip knows; ``needed_for`` is to be translated."""

    module: str
    pip_name: str
    needed_for: str


_NEEDED_FOR = {
    "numpy": QT_TRANSLATE_NOOP("AADM_Packages", "all measuring"),
    "scipy": QT_TRANSLATE_NOOP("AADM_Packages", "Check column"),
    "opencv-python-headless": QT_TRANSLATE_NOOP("AADM_Packages", "Check column, depth maps"),
    "ifcopenshell": QT_TRANSLATE_NOOP("AADM_Packages", "Sample design from an IFC file, Write results to an IFC file"),
    "rich": QT_TRANSLATE_NOOP("AADM_Packages", "the command aadm, behind Run job and Report"),
    "msgspec": QT_TRANSLATE_NOOP("AADM_Packages", "Check column"),
    "pypdfium2": QT_TRANSLATE_NOOP("AADM_Packages", "Report"),
    "jinja2": QT_TRANSLATE_NOOP("AADM_Packages", "Report: HTML"),
    "fonttools": QT_TRANSLATE_NOOP("AADM_Packages", "Report: HTML"),
    "reportlab": QT_TRANSLATE_NOOP("AADM_Packages", "Report: PDF, pages and cards"),
    "xlsxwriter": QT_TRANSLATE_NOOP("AADM_Packages", "Report: Excel workbook"),
    "python-neo-lzf": QT_TRANSLATE_NOOP("AADM_Packages", "compressed PCD files"),
    "open3d": QT_TRANSLATE_NOOP("AADM_Packages", "methods fusion, pointcloud and image"),
}
PACKAGES = tuple(Package(errors.package_called(name).module, name, needed) for name, needed in _NEEDED_FOR.items())


@contextmanager
def naming_packages() -> Iterator[None]:
    """Around work: a package that is missing is named, with the command that installs it into FreeCAD's own folder.

    Raises
    ------
    MissingDependencyError
        Instead of ModuleNotFoundError, and of one that names pip's command for a Python outside FreeCAD.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        package = next((one for one in PACKAGES if one.module == (error.name or "").split(".")[0]), None)
        if package is None:
            raise
        raise missing_package(package) from error
    except MissingDependencyError as error:
        package = package_called(error.package)
        if package is None:
            raise
        raise missing_package(package) from error


def package_called(pip_name: str) -> Package | None:
    """The package that pip knows by a name; None for one that this workbench does not know."""
    return next((one for one in PACKAGES if one.pip_name == pip_name), None)


def require(*modules: str) -> None:
    """Check that packages are there, before long work begins.

    Raises
    ------
    MissingDependencyError
        Naming the first that is missing, and the command that installs it.
    """
    for package in PACKAGES:
        if package.module in modules and find_spec(package.module) is None:
            raise missing_package(package)


def missing_package(package: Package) -> MissingDependencyError:
    """The error that names a package and the command."""
    return MissingDependencyError(
        package.pip_name, translate("AADM_Packages", package.needed_for), " ".join(install_command(package))
    )


def install_command(package: Package) -> list[str]:
    """The words of the command that installs a package into FreeCAD's own package folder."""
    return [
        python_program(),
        "-m",
        "pip",
        "install",
        "--disable-pip-version-check",
        "--upgrade",
        "--target",
        str(package_folder()),
        package.pip_name,
    ]


def package_folder() -> Path:
    """FreeCAD's own folder of Python packages, where the Addon Manager puts them, too."""
    folder = Path(FreeCAD.getUserAppDataDir()) / "AdditionalPythonPackages"
    version = tuple(int(part) for part in FreeCAD.Version()[:2])
    # 0.20 looks in the folder itself, later ones in a folder for each version of Python, too.
    return folder if version < (0, 21) else folder / f"py{sys.version_info.major}{sys.version_info.minor}"


def python_program() -> str:
    """A Python of FreeCAD's own version: sys.executable is FreeCAD itself."""
    preferred = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/AADM").GetString("PythonProgram", "")
    if preferred:
        return preferred
    exact = f"python{sys.version_info.major}.{sys.version_info.minor}"
    beside = [Path(sys.prefix) / "bin" / exact, Path(sys.prefix) / "bin" / "python3", Path(sys.prefix) / "bin/python"]
    beside += [Path(sys.prefix) / "python.exe", Path(sys.prefix) / "bin" / "python.exe"]
    found = next((str(path) for path in beside if path.is_file()), None)
    return found or shutil.which(exact) or shutil.which("python3") or shutil.which("python") or "python3"


def make_importable() -> None:
    """Let this session see what was just installed: FreeCAD looks for the folder only when it starts."""
    from importlib import invalidate_caches

    folder = package_folder()
    if folder.is_dir() and str(folder) not in sys.path:
        sys.path.append(str(folder))
    invalidate_caches()
