"""The errors that reach a person. Each message says what is wrong, where, and what to do about it.

What a scan cannot support (a plugged sleeve, a bar out of view) is no error: it is a value,
``Verdict.NOT_MEASURED`` with a reason (see :mod:`aadm_workbench.model`).
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import NamedTuple, Self

PRIVATE_ENVIRONMENT = "AADM_PRIVATE_ENVIRONMENT"
"""Variable that is set in a process of FreeCAD's private environment, for which pip on the PATH does nothing."""


class AadmError(Exception):
    """Base of all errors that this product raises on purpose: each with its reason."""

    @property
    def reason(self) -> str:
        """What is wrong, where, and what to do: a reason of the table of sentences, or a text."""
        return self.args[0] if self.args and isinstance(self.args[0], str) else str(self)

    @classmethod
    def because(cls, code: str, /, **values: object) -> Self:
        """The error whose reason is a sentence of the table (:class:`aadm_workbench.model.reason.Reason`)."""
        from aadm_workbench.model.reason import Reason  # not before it is needed: it loads numpy

        return cls(Reason(code, **values))

    @classmethod
    def about(cls, file: object, code: str, /, **values: object) -> Self:
        """The error whose reason is a sentence that is said of a file, or of whatever else stands before its colon."""
        from aadm_workbench.model.reason import said_of  # as above

        return cls(said_of(file, code, **values))


class JobError(AadmError):
    """The text of a job cannot be used: nothing was checked."""


class DesignError(AadmError):
    """A model does not give the as-designed points that were asked for."""


class ScanError(AadmError):
    """A scan file cannot be read, or what it holds cannot be a scan of this component."""


class CameraError(AadmError):
    """Intrinsics are missing or cannot belong to the scan."""


class CaptureError(AadmError):
    """A live camera did not give a frame that can be believed: this frame is lost, the next one may be had."""


class CameraGoneError(CaptureError):
    """A live camera does not answer any more: it must be opened again."""


class EndOfFramesError(CaptureError):
    """A camera that plays captures again has played them all."""


class ReportError(AadmError):
    """A report.json cannot be used: broken, of another schema, or not what the schema describes."""


class NoEnvironmentError(AadmError):
    """FreeCAD's private environment is not there, or is not whole; the workbench offers to install it."""


class MissingDependencyError(AadmError):
    """A package that this command needs is not installed; the message holds the command that installs it."""

    def __init__(self, package: str, needed_for: str, install: str = "") -> None:
        install = install or package_called(package).install
        from aadm_workbench.model import Reason

        is_private = os.environ.get(PRIVATE_ENVIRONMENT) and install.startswith("pip ")
        code = "command.missing.private" if is_private else "command.missing"
        super().__init__(Reason(code, needed_for=needed_for, package=package, install=install))
        self.package = package
        self.install = install


@contextmanager
def needed(package: str, needed_for: str, install: str = "") -> Iterator[None]:
    """Around the import of a package that need not be there.

    Raises
    ------
    MissingDependencyError
        Where it is not; parameters are the same.
    """
    try:
        yield
    except ImportError as error:
        raise MissingDependencyError(package, needed_for, install) from error


class Package(NamedTuple):
    """A package by the name it is imported by and by the one that pip knows; ``needed_for`` what.

    ``extra`` is the one of this project that brings it; without one the project itself does. ``others`` are names
    that it may be installed under, too.
    """

    module: str
    pip_name: str
    needed_for: str
    extra: str = ""
    others: tuple[str, ...] = ()

    @property
    def install(self) -> str:
        """The command that installs it."""
        return install_of(self.extra) if self.extra else f"pip install '{self.pip_name}'"


PACKAGES = (
    Package("numpy", "numpy", "all arithmetic"),
    Package("scipy", "scipy", "robust fits"),
    Package(
        "cv2",
        "opencv-python-headless",
        "circles, depth maps",
        others=("opencv-python", "opencv-contrib-python-headless", "opencv-contrib-python", "opencv"),
    ),
    Package("ifcopenshell", "ifcopenshell", "IFC models"),
    Package("msgspec", "msgspec", "reading and writing report.json"),
    Package("rich", "rich", "tables in the terminal"),
    Package("jinja2", "jinja2", "report.html", "reports"),
    Package("fontTools", "fonttools", "Chinese in report.html", "reports"),
    Package("reportlab", "reportlab", "report.pdf, crew pages, scan cards", "reports"),
    Package("xlsxwriter", "xlsxwriter", "report.xlsx", "reports"),
    Package("pypdfium2", "pypdfium2", "pictures in report.bcf", "reports"),
    Package("lzf", "python-neo-lzf", "compressed PCD files", "formats"),
    Package("lazrs", "lazrs", "LAZ files", "formats"),
    Package("pye57", "pye57", "E57 files", "formats"),
    Package("tifffile", "tifffile", "TIFF of half floats and of X, Y, Z", "formats"),
    Package("imagecodecs", "imagecodecs", "TIFF packed with ZSTD, LZMA or LERC", "formats"),
    Package("genicam", "genicam", "gentl:, gige: cameras", "camera"),
    Package("harvesters", "harvesters", "gentl:, gige: cameras", "camera"),
    Package("mecheye", "mecheyeapi", "mecheye: cameras", "mecheye"),
    Package("asyncua", "asyncua", "link --opcua", "link"),
    Package("pymodbus", "pymodbus", "link --modbus", "link"),
    Package("paho", "paho-mqtt", "link --mqtt", "link"),
    Package("psutil", "psutil", "check --jobs N", "batch"),
    Package("distributed", "distributed", "check --scheduler", "batch"),
    Package("open3d", "open3d", "virtual camera, methods of the literature", "twin", ("open3d-cpu",)),
    Package("manifold3d", "manifold3d", "virtual camera", "twin"),
    Package("trimesh", "trimesh", "models as meshes, virtual camera", "mesh"),
    Package("mitsuba", "mitsuba", "virtual fringe camera", "physics"),
    Package("matplotlib", "matplotlib", "plots of studies", "twin"),
)
"""All packages that any part of this project imports, and how each is installed; pyproject.toml names the same."""


def package_called(pip_name: str) -> Package:
    """The package that pip knows by a name."""
    return next(package for package in PACKAGES if package.pip_name == pip_name)


def install_of(extra: str) -> str:
    """The command that installs what one extra of this project brings."""
    return f"pip install 'aadm-workbench[{extra}]'"


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The end of a message about an unknown word: what is near to it, or all that is known."""
    from difflib import get_close_matches

    known = tuple(known)
    near = get_close_matches(word, known, n=1, cutoff=0.6)
    from aadm_workbench.model.reason import Reason  # as above

    return Reason("command.did_you_mean", near=near[0]) if near else Reason("command.known", known=", ".join(known))
