"""As-designed points of the document that is open in FreeCAD."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Any

from aadm_workbench.design.elements import Element
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.recognise.columns import Origin, Rules, recognise
from aadm_workbench.document.sample.elements import sample_elements
from aadm_workbench.errors import DesignError
from aadm_workbench.model import ColumnDesign

_SHOWN = 6  # of each: more fill a message and say no more


def sample_document(
    document: Any,
    *,
    columns: str | Sequence[Any] | None = None,
    sleeves: str | None = None,
    rebars: str | None = None,
) -> ModelDesign:
    """Columns, sleeves and connecting rebars of an open document, which stays as it is.

    Each body counts once, whatever groups, links, arrays and intermediate shapes repeat it; links and containers put
    it where it is shown. What is what follows from IFC class, then from labels (of the groups too), then from geometry.

    Parameters
    ----------
    document
        An open document of FreeCAD; no window is needed.
    columns, sleeves, rebars
        Optional rules, such as ``Label=/套筒/`` or ``IfcColumn``: see :mod:`aadm_workbench.design.recognise.selectors`.
        ``columns`` may also be objects of the document: they, or what they hold, are then taken for columns.

    Returns
    -------
    ModelDesign
        In the frame of the document, mm. Each point's ``object_name`` is the path of the object that it comes from,
        such as ``Link.0.Body``: the first part is the name of an object of the document.

    Raises
    ------
    DesignError
        Where a rule is not understood or finds nothing, or the objects have no body.
    """
    began = perf_counter()
    problems: list[str] = []
    elements = sample_elements(document, problems)
    rule = columns if isinstance(columns, str) else None
    chosen = None if columns is None or isinstance(columns, str) else _held_by(columns, elements)
    found = recognise(elements, origin_of(document, problems), Rules(rule, sleeves, rebars), chosen=chosen)
    return replace(found, seconds=perf_counter() - began)


def sample_column(column_object: Any, *, sleeves: str | None = None, rebars: str | None = None) -> ColumnDesign:
    """The as-designed points of one column that was selected in a document, with the bars of the document under it.

    Whatever its class and its name, the object is taken for a column; of a group the bodies in it are looked at.

    Raises
    ------
    DesignError
        Where nothing that it draws has grouting sleeves in its foot, with what was found instead.
    """
    called = column_object.Label
    found = sample_document(column_object.Document, columns=[column_object], sleeves=sleeves, rebars=rebars)
    if not found.columns:
        reasons = [f"{left.name}: {left.reason}" for left in found.not_taken if left.what == "sleeve"]
        said = "; ".join(dict.fromkeys(reasons[:_SHOWN]))
        raise DesignError(f"{called} has no grouting sleeves in its foot face. {said}".strip())
    if len(found.columns) > 1:
        columns = ", ".join(column.id for column in found.columns[:_SHOWN])
        raise DesignError(f"{called} holds {len(found.columns)} columns: {columns}. Select one of them.")
    return found.columns[0]


def _held_by(objects: Sequence[Any], elements: Sequence[Element]) -> list[Element]:
    """Elements that some objects are, or that stand in them."""
    names = {str(obj.Name) for obj in objects}
    held = [element for element in elements if names.intersection(element.GlobalId.split("."))]
    if not held:
        called = ", ".join(str(obj.Label) for obj in objects)
        raise DesignError(f"{called} has no body of its own: select the column, or the group that holds it.")
    return held


def origin_of(document: Any, problems: list[str]) -> Origin:
    """Where the elements of a document come from; the hash is that of its file as it was last saved."""
    path = Path(document.FileName) if document.FileName else None
    saved = path is not None and path.is_file()
    return Origin(
        source=document.FileName or document.Label,
        sha256=hashlib.sha256(path.read_bytes()).hexdigest() if saved and path else "",
        schema="FreeCAD",
        warnings=tuple(dict.fromkeys(problems)),
    )
