"""One command, one undo step."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import FreeCAD


@contextmanager
def undo_step(document: Any, name: str) -> Iterator[None]:
    """Around changes of a document: all of them are one step to undo, or none is made."""
    document.openTransaction(name)
    try:
        yield
        document.recompute()
    except BaseException:
        document.abortTransaction()
        _close(abort=True)
        raise
    document.commitTransaction()
    _close(abort=False)


def _close(*, abort: bool) -> None:
    """End the step where nothing was changed, too: FreeCAD leaves it open then, and puts what comes next into it."""
    if FreeCAD.getActiveTransaction():
        FreeCAD.closeActiveTransaction(abort)
