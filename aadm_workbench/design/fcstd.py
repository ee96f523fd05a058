"""As-designed points of a FreeCAD document, from outside FreeCAD."""

from __future__ import annotations

import zipfile
from pathlib import Path

from aadm_workbench.bounded import ArchiveBounds, BoundsError, opened_archive
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.recognise.columns import Rules
from aadm_workbench.design.step import read_with_kernel
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason

FCSTD_BOUNDS = ArchiveBounds("FreeCAD document", entries=200_000, entry_bytes=2**31, all_bytes=2**31)
"""Drawings of whole buildings unpack to some hundred megabytes, in a part for each shape."""

_PIECE_BYTES = 2**20  # bounds the memory, not the time
_MAIN = "Document.xml"
_ENTITY = b"<!ENTITY"


def read_fcstd(path: str | Path, rules: Rules | None = None) -> ModelDesign:
    """Columns, sleeves and connecting rebars of a .FCStd file, read by a FreeCAD without a screen.

    Raises
    ------
    DesignError
        Where the file is no complete FreeCAD document, or FreeCAD cannot read it, or a rule finds nothing.
    MissingDependencyError
        Where FreeCAD is not installed.
    """
    path = Path(path)
    return read_with_kernel(path, check_archive, rules or Rules(), schema="FreeCAD")


def check_archive(path: Path) -> None:
    """Refuse what is no FreeCAD document, is cut short, or would burst or leave its folder when it is unpacked.

    Raises
    ------
    DesignError
        Naming the file and the part of it.
    """
    try:
        with opened_archive(path, FCSTD_BOUNDS) as archive:
            parts = archive.infolist()
            if _MAIN not in {part.filename for part in parts}:
                raise DesignError(Reason("design.fcstd_zip", path=path, main=_MAIN))
            for part in parts:
                _check_part(path, archive, part)
    except BoundsError as error:
        message = Reason("design.fcstd_refused", path=path, why=error)
        raise DesignError(message) from error
    except OSError as error:
        raise DesignError(Reason("design.unopened", path=path, why=error.strerror)) from error


def _check_part(path: Path, archive: zipfile.ZipFile, part: zipfile.ZipInfo) -> None:
    """Unpack a part to nowhere: what is damaged is found here, and what its header understates."""
    passed, before = 0, b""
    with archive.open(part) as stream:
        while piece := stream.read(_PIECE_BYTES):
            passed += len(piece)
            if passed > part.file_size:
                raise DesignError(Reason("design.fcstd_part", path=path, name=part.filename))
            if part.filename.endswith(".xml") and _ENTITY in before + piece:
                raise DesignError(Reason("design.fcstd_entities", path=path, name=part.filename))
            before = piece[-len(_ENTITY) :]
