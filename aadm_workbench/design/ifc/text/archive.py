"""The IFC model in an .ifczip, the packed form that buildingSMART defines."""

from __future__ import annotations

import zipfile
from pathlib import Path, PurePosixPath

from aadm_workbench.bounded import ArchiveBounds, BoundsError, entry_bytes, opened_archive
from aadm_workbench.design.model_file import LARGEST_MODEL_BYTES
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason

IFCZIP_BOUNDS = ArchiveBounds(
    "zip archive of a model", entries=10_000, entry_bytes=LARGEST_MODEL_BYTES, all_bytes=LARGEST_MODEL_BYTES
)
"""A model, and what some programs pack with it: pictures, documents."""

_SHOWN = 4  # names in a message


def model_in_archive(path: Path) -> bytes:
    """The bytes of the one .ifc file in an archive.

    Raises
    ------
    DesignError
        Where the archive is damaged or encrypted, holds no model or several, or would burst.
    """
    try:
        with opened_archive(path, IFCZIP_BOUNDS) as archive:
            return entry_bytes(archive, _model_of(path, archive))
    except BoundsError as error:
        message = Reason("ifc.zip_refused", path=path, why=error)
        raise DesignError(message) from error
    except OSError as error:
        raise DesignError(Reason("design.unopened", path=path, why=error.strerror)) from error


def _model_of(path: Path, archive: zipfile.ZipFile) -> zipfile.ZipInfo:
    parts = [part for part in archive.infolist() if not part.is_dir() and not part.filename.startswith("__MACOSX/")]
    models = [part for part in parts if PurePosixPath(part.filename.replace("\\", "/")).suffix.lower() == ".ifc"]
    if len(models) == 1:
        return models[0]
    shown = [part.filename for part in (models or parts)[:_SHOWN]] or Reason("ifc.zip_nothing")
    what = Reason("ifc.zip_models" if models else "ifc.zip_no_model", count=len(models))
    raise DesignError(Reason("ifc.zip_holds", path=path, what=what, shown=shown))
