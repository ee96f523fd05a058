"""A FreeCAD document with the results of a check, written by FreeCAD itself, without a screen."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from aadm_workbench.design.fcstd import check_archive
from aadm_workbench.design.freecad_program import ask_freecad
from aadm_workbench.design.model_file import sha256_of
from aadm_workbench.errors import AadmError
from aadm_workbench.model import JobReport
from aadm_workbench.model.reason import renamed
from aadm_workbench.own_files import ASIDE_FOLDER, write_atomically
from aadm_workbench.report.json import encoded_report

_MODULE = "aadm_workbench.document.report.annotate"


def write_fcstd(report: JobReport, path: Path) -> None:
    """Write a .FCStd with the annotated columns of a report.

    Where the report's model is a .FCStd that still has the hash that was checked, the columns are shown on it; the file
    itself stays as it is.

    Raises
    ------
    MissingDependencyError
        Where FreeCAD is not installed.
    AadmError
        Where FreeCAD cannot write the document.
    """
    model = model_of(report.model, path)
    if model is not None:
        check_archive(model)
    try:
        # FreeCAD writes where nobody else can put a link; beside the file, for where else it may see is not known.
        with TemporaryDirectory(prefix=ASIDE_FOLDER, dir=path.parent.resolve()) as folder:
            made = Path(folder) / path.name
            question = {
                "report": encoded_report(report).decode(),
                "out": str(made),
                "model": None if model is None else str(model.resolve()),
            }
            problem = ask_freecad(_MODULE, question, str(path))
            if problem:
                raise AadmError(renamed(str(problem), str(made), str(path)))
            write_atomically(path, made.read_bytes())
    except OSError as error:
        raise AadmError.because("command.cannot_write", file=path, why=error.strerror) from error


def model_of(model: Mapping[str, str] | None, path: Path) -> Path | None:
    """The .FCStd that was checked, where it lies beside the report or above it and has not changed since."""
    source = "" if model is None else model["source"]
    if model is None or not source.lower().endswith(".fcstd"):
        return None
    for place in (path.parent / source, path.parent.parent / source, Path(source)):
        if place.is_file() and sha256_of(place) == model["sha256"]:
            return place
    return None
