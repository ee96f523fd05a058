"""As-designed points of a FreeCAD document, from outside FreeCAD."""

from __future__ import annotations

import zipfile
import zlib
from pathlib import Path

from aadm_workbench.design.kernel import read_with_kernel
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.recognise import Rules
from aadm_workbench.errors import DesignError

LARGEST_BYTES = 8 * 2**30
"""What a document may unpack to; drawings of whole buildings stay far below."""

PACKED_RATIO = 200
"""Shapes and XML pack to a tenth or a fiftieth; what packs more than this was made to burst."""

_SMALL_BYTES = 64 * 2**20  # what unpacks to less may be packed as tightly as it likes
_PIECE_BYTES = 2**20  # bounds the memory, not the time
_MAIN = "Document.xml"


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
        with zipfile.ZipFile(path) as archive:
            parts = archive.infolist()
            _check_sizes(path, parts)
            for part in parts:
                _check_name(path, part)
            if _MAIN not in {part.filename for part in parts}:
                raise DesignError(f"{path} is a zip archive without {_MAIN}: no FreeCAD document. Save it in FreeCAD.")
            for part in parts:
                _check_part(path, archive, part)
    except zipfile.BadZipFile as error:
        raise DesignError(
            f"{path} is no FreeCAD document, or is cut short or damaged ({error}). Copy it again, or save it again in "
            "FreeCAD."
        ) from error
    except (zlib.error, EOFError, NotImplementedError, RuntimeError) as error:
        raise DesignError(f"{path} cannot be unpacked ({error}). Save it again in FreeCAD.") from error


def _check_sizes(path: Path, parts: list[zipfile.ZipInfo]) -> None:
    unpacked = sum(part.file_size for part in parts)
    packed = path.stat().st_size
    if unpacked > LARGEST_BYTES or (unpacked > _SMALL_BYTES and unpacked > PACKED_RATIO * packed):
        raise DesignError(
            f"{path} has {packed} bytes and would unpack to {unpacked}: no FreeCAD document packs like that, it was "
            "not opened."
        )


def _check_name(path: Path, part: zipfile.ZipInfo) -> None:
    name = part.filename.replace("\\", "/")
    if name.startswith("/") or ":" in name or ".." in name.split("/"):
        raise DesignError(f"{path} holds a part called {part.filename!r}, which leads out of it: it was not opened.")


def _check_part(path: Path, archive: zipfile.ZipFile, part: zipfile.ZipInfo) -> None:
    """Unpack a part to nowhere: what is damaged is found here, and what its header understates."""
    if part.flag_bits & 0x1:
        raise DesignError(f"{path} is encrypted (part {part.filename}): save it in FreeCAD without a password.")
    passed = 0
    with archive.open(part) as stream:
        while piece := stream.read(_PIECE_BYTES):
            passed += len(piece)
            if passed > part.file_size:
                raise DesignError(f"{path}: its part {part.filename} is longer than it says: it was not opened.")
            if part.filename.endswith(".xml") and b"<!ENTITY" in piece:
                raise DesignError(f"{path}: its part {part.filename} defines entities, which FreeCAD never writes.")
