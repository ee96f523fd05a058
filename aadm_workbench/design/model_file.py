"""A model's file on disk: that it is there, and its hash."""

from __future__ import annotations

import hashlib
from pathlib import Path

from aadm_workbench.errors import DesignError

_PIECE_BYTES = 2**20


def sha256_of(path: Path) -> str:
    """Hash of a model's file.

    Raises
    ------
    DesignError
        Where it is not there, is a folder, is empty or cannot be opened.
    """
    if path.is_dir():
        raise DesignError(f"{path} is a folder: name the model's file.")
    try:
        with path.open("rb") as stream:
            found = hashlib.sha256()
            size = 0
            while piece := stream.read(_PIECE_BYTES):
                found.update(piece)
                size += len(piece)
    except FileNotFoundError as error:
        raise DesignError(f"{path} does not exist. Paths in a job are relative to the job file.") from error
    except OSError as error:
        raise DesignError(f"{path} cannot be opened: {error.strerror}.") from error
    if not size:
        raise DesignError(f"{path} is empty: export the model again.")
    return found.hexdigest()
