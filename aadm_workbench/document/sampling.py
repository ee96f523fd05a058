"""Column objects from the model in a document, or from its IFC file; recognised by the private process."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from aadm_workbench.design.design_text import read_design
from aadm_workbench.document.column import make_column, set_design
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.job.table import sha256_of
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.report.annotate import objects_by_global_id
from aadm_workbench.document.sample.columns import sampled_shapes
from aadm_workbench.model import ColumnDesign
from aadm_workbench.private.answers import FoundColumns


def columns_work(document: Any, objects: Sequence[Any] | None = None) -> Work:
    """What the private process is asked about the shapes of a document; they are sampled here, by FreeCAD.

    Parameters
    ----------
    objects
        Only columns that are, or belong to, these objects of the model; all by default.

    Raises
    ------
    DesignError
        Where an object has no body.
    """
    return _asked(sampled_shapes(document, objects))


def file_work(path: Path) -> Work:
    """What the private process is asked about the columns of a model's file."""
    return _asked({"path": str(path.resolve())})


def take_columns(
    document: Any, answer: FoundColumns, *, objects: Sequence[Any] | None = None, file: Path | None = None
) -> list[Any]:
    """Make a column object for each column of an answer; one that is there gets its design anew.

    Parameters
    ----------
    objects
        The objects of the model that the columns are, in the answer's order; looked for by default.
    file
        The file that they were taken from; that of the document by default.
    """
    origin = (str(file.resolve()) if file is not None else document.FileName, answer["sha256"])
    models = list(objects or [None] * len(answer["columns"]))
    designs = [read_design(text, answer["source"]) for text in answer["columns"]]
    columns = [
        _taken(document, design, model, origin, answer["project"])
        for design, model in zip(designs, models, strict=True)
    ]
    by_id = dict(zip((design.id for design in designs), answer["bodies"], strict=False))
    for column, design in zip(columns, designs, strict=True):
        # Where the document shows the body itself there is nothing to add.
        faces = by_id.get(design.id, []) if column.Model is None else []
        column.Body = json.dumps(faces, separators=(",", ":")) if faces else ""
    return columns


def _asked(question: Mapping[str, Any]) -> Work:
    text = json.dumps({"about": "columns", **question})
    return Work(("ask", "question.json", "answer.json"), {"question.json": text}, "answer.json")


def _taken(document: Any, design: ColumnDesign, model: Any, origin: tuple[str, str], project: str) -> Any:
    known = {column.GlobalId or column.ColumnId: column for column in columns_in(document)}
    column = known.get(design.global_id or design.id)
    if column is None:
        column = make_column(document, design, model or _object_of(document, design))
    else:
        set_design(column, design)
    column.ModelFile, column.ModelSha256 = origin
    column.ModelProject = project
    column.SampledSha256 = sha256_of(column.Design)
    return column


def _object_of(document: Any, design: ColumnDesign) -> Any:
    """The object of the model that a design was sampled from."""
    found = objects_by_global_id(document).get(design.global_id or "")
    if found is not None:
        return found
    by_name = {obj.Name: obj for obj in document.Objects} | {obj.Label: obj for obj in document.Objects}
    return next((by_name[name] for name in (*design.names, design.id) if name in by_name), None)
