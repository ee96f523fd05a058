"""The shapes of the document that is open in FreeCAD, as the private process is asked about them."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aadm_workbench.design.element_json import to_json
from aadm_workbench.design.elements import Element
from aadm_workbench.document.sample.elements import sample_elements
from aadm_workbench.errors import DesignError
from aadm_workbench.private.answers import Chosen, Shapes


def sampled_shapes(document: Any, objects: Sequence[Any] | None = None) -> Shapes:
    """All that a document draws, which stays as it is; plain values, mm, in the frame of the document.

    Each body counts once, whatever groups, links, arrays and intermediate shapes repeat it; links and containers put
    it where it is shown.

    Parameters
    ----------
    document
        An open document of FreeCAD; no window is needed.
    objects
        Objects of it that are columns, or hold one; whatever their class and name they are taken for columns.

    Returns
    -------
    Shapes
        A question to :func:`batch.answers.columns`. Each element's ``GlobalId`` is the path of the object that it comes
        from, such as ``Link.0.Body``: the first part is the name of an object of the document.

    Raises
    ------
    DesignError
        Where an object has no body.
    """
    problems: list[str] = []
    elements = sample_elements(document, problems)
    chosen: list[Chosen] = [{"label": obj.Label, "ids": _held_by(obj, elements)} for obj in objects or ()]
    path = Path(document.FileName) if document.FileName else None
    saved = path is not None and path.is_file()
    return {
        "elements": to_json(elements),
        "chosen": chosen,
        "problems": list(dict.fromkeys(problems)),
        "source": document.FileName or document.Label,
        # Of the file as it was last saved.
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest() if saved and path else "",
    }


def _held_by(obj: Any, elements: Sequence[Element]) -> list[str]:
    """Elements that an object is, or that stand in it."""
    held = [element.GlobalId for element in elements if obj.Name in element.GlobalId.split(".")]
    if not held:
        raise DesignError.because("document.no_body", label=obj.Label)
    return held
