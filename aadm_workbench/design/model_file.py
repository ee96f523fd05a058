"""A model's file on disk: the endings it may have, that it is there, and its hash."""

from __future__ import annotations

import hashlib
from pathlib import Path
from types import MappingProxyType

from aadm_workbench.bounded import BoundsError, open_bounded
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason

LARGEST_MODEL_BYTES = 2**31
"""The largest models that people exchange have one or two gigabytes."""

KERNEL = MappingProxyType({".step": "STEP", ".stp": "STEP", ".brep": "BREP", ".brp": "BREP"})
"""Endings of files that FreeCAD's geometry kernel reads, with their schemas."""

MESHES = MappingProxyType({".stl": "STL", ".obj": "OBJ", ".ply": "PLY"})
"""Endings of files that hold meshes, with their schemas."""

_PIECE_BYTES = 2**20  # bounds the memory, not the time


def sha256_of(path: Path) -> str:
    """Hash of a model's file.

    Raises
    ------
    DesignError
        Where it is not there, is a folder, is empty or cannot be opened.
    """
    try:
        with open_bounded(path, LARGEST_MODEL_BYTES) as stream:
            found = hashlib.sha256()
            size = 0
            while piece := stream.read(_PIECE_BYTES):
                found.update(piece)
                size += len(piece)
    except FileNotFoundError as error:
        raise DesignError(Reason("design.no_file", path=path)) from error
    except BoundsError as error:
        raise DesignError(Reason("design.refused", path=path, why=error)) from error
    except (OSError, ValueError) as error:
        raise DesignError(
            Reason("design.unopened", path=path, why=getattr(error, "strerror", None) or error)
        ) from error
    if not size:
        raise DesignError(Reason("design.empty", path=path))
    return found.hexdigest()
