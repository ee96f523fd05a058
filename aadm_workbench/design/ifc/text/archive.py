"""The IFC model in an .ifczip, the packed form that buildingSMART defines."""

from __future__ import annotations

import zipfile
import zlib
from pathlib import Path, PurePosixPath

from aadm_workbench.errors import DesignError

LARGEST_BYTES = 4 * 2**30
"""What a model may unpack to; the largest models that people exchange have one or two gigabytes."""

PACKED_RATIO = 200
"""STEP text packs to a tenth, of very regular models to a fiftieth; what packs more was made to burst."""

_SMALL_BYTES = 64 * 2**20
_PIECE_BYTES = 2**20
_SHOWN = 4


def model_in_archive(path: Path) -> bytes:
    """The bytes of the one .ifc file in an archive.

    Raises
    ------
    DesignError
        Where the archive is damaged or encrypted, holds no model or several, or would burst.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            part = _model_of(path, archive)
            _check_size(path, part)
            return _content(path, archive, part)
    except zipfile.BadZipFile as error:
        raise DesignError(f"{path} is no zip archive, or is cut short or damaged ({error}). Copy it again.") from error
    except (zlib.error, EOFError, NotImplementedError, RuntimeError, OSError) as error:
        raise DesignError(f"{path} cannot be unpacked ({error}). Pack it again, or name the .ifc itself.") from error


def _model_of(path: Path, archive: zipfile.ZipFile) -> zipfile.ZipInfo:
    parts = [part for part in archive.infolist() if not part.is_dir() and not part.filename.startswith("__MACOSX/")]
    models = [part for part in parts if PurePosixPath(part.filename.replace("\\", "/")).suffix.lower() == ".ifc"]
    if len(models) == 1:
        return models[0]
    shown = ", ".join(part.filename for part in (models or parts)[:_SHOWN]) or "nothing"
    what = f"{len(models)} models" if models else "no .ifc in STEP format"
    raise DesignError(
        f"{path} holds {what} ({shown}): an .ifczip holds one. Unpack it and name the .ifc that is meant."
    )


def _check_size(path: Path, part: zipfile.ZipInfo) -> None:
    packed = path.stat().st_size
    burst = part.file_size > _SMALL_BYTES and part.file_size > PACKED_RATIO * packed
    if part.file_size > LARGEST_BYTES or burst:
        raise DesignError(
            f"{path} has {packed} bytes and would unpack to {part.file_size}: no model packs like that, it was not "
            "opened."
        )
    if part.flag_bits & 0x1:
        raise DesignError(f"{path} is encrypted: unpack it with its password and name the .ifc in it.")


def _content(path: Path, archive: zipfile.ZipFile, part: zipfile.ZipInfo) -> bytes:
    content = bytearray()
    with archive.open(part) as stream:
        while piece := stream.read(_PIECE_BYTES):
            content += piece
            if len(content) > part.file_size:
                raise DesignError(f"{path}: its part {part.filename} is longer than it says: it was not opened.")
    return bytes(content)
