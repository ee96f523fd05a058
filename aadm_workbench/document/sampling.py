"""Column objects from the model in a document, or from its IFC file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aadm_workbench.document.column import columns_in, make_column, set_design
from aadm_workbench.document.packages import naming_packages
from aadm_workbench.document.report.annotate import objects_by_global_id
from aadm_workbench.errors import DesignError
from aadm_workbench.model import ColumnDesign


def sample_columns(document: Any, objects: Sequence[Any] | None = None) -> list[Any]:
    """Make a column object for each column of the model in a document; one that is there gets its design anew.

    Parameters
    ----------
    objects
        Only columns that are, or belong to, these objects of the model; all by default.

    Raises
    ------
    DesignError
        Where there is none; says what was looked at.
    """
    with naming_packages():
        from aadm_workbench.document.sample.columns import sample_column, sample_document

        if objects is not None:
            # All are read before the first is made: a document is not left half done.
            designs = [(sample_column(obj), obj) for obj in objects]
        else:
            model = sample_document(document)
            if not model.columns:
                raise DesignError(_nothing_found(model))
            designs = [(design, None) for design in model.columns]
    return [_taken(document, design, obj) for design, obj in designs]


def sample_ifc(document: Any, path: Path) -> list[Any]:
    """Make a column object for each column of an IFC file, linked to the object that carries its GlobalId.

    Raises
    ------
    DesignError
        Where the file is no model, or has no columns with sleeves.
    MissingDependencyError
        Without ifcopenshell.
    """
    with naming_packages():
        from aadm_workbench.design.read import read_model

        model = read_model(path)
    if not model.columns:
        raise DesignError(_nothing_found(model))
    return [_taken(document, design) for design in model.columns]


def _taken(document: Any, design: ColumnDesign, model: Any = None) -> Any:
    known = {column.GlobalId or column.ColumnId: column for column in columns_in(document)}
    column = known.get(design.global_id or design.id)
    if column is not None:
        set_design(column, design)
        return column
    return make_column(document, design, model or _object_of(document, design))


def _object_of(document: Any, design: ColumnDesign) -> Any:
    """The object of the model that a design was sampled from."""
    found = objects_by_global_id(document).get(design.global_id or "")
    if found is not None:
        return found
    by_name = {obj.Name: obj for obj in document.Objects} | {obj.Label: obj for obj in document.Objects}
    return next((by_name[name] for name in (*design.names, design.id) if name in by_name), None)


def _nothing_found(model: Any) -> str:
    reasons = list(dict.fromkeys(f"{one.name}: {one.reason}" for one in model.not_taken))[:4]
    said = f" ({'; '.join(reasons)})" if reasons else ""
    return f"{model.source} has no column with grouting sleeves in its foot{said}"
