"""Pictures of the 3-D view, as reports use them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCADGui

from aadm_workbench.document.display.messages import tell
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.label_keeper import KEEPER
from aadm_workbench.model import Reason


def save_picture(view: Any, file: Path, size: tuple[int, int] | None = None) -> None:
    """Save a view as it is shown, white behind it, with its labels apart from each other.

    Parameters
    ----------
    size
        Width and height in pixels; those of the view by default, else cut to its shape.

    Raises
    ------
    AadmError
        Where the file cannot be written.
    """
    width, height = view.getSize() if size is None else size
    KEEPER.arrange((float(width), float(height)))
    try:
        view.saveImage(str(file), int(width), int(height), "White")
    except (OSError, RuntimeError) as error:
        raise AadmError.about(file, "bounded.unwritten", why=error) from error
    finally:
        KEEPER.arrange()
        FreeCADGui.updateGui()
    if not file.is_file():
        raise AadmError.about(file, "bounded.unwritten", why=Reason("document.no_picture"))
    tell(str(file))
