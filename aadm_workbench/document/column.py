"""The column in a FreeCAD document: which object of the model it is, its design points, how it is checked.

The module path and the class name are written into users' files: neither may change.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import FreeCAD
import numpy as np

from aadm_workbench.design.design_text import read_design, write_design
from aadm_workbench.document.belongings import own_up, watch_belongings
from aadm_workbench.document.groups import COLUMN_TYPE, put_into_group
from aadm_workbench.document.places import global_placement, move_to, placement_of, transform_of
from aadm_workbench.document.properties import HIDDEN, READ_ONLY, Property, apply_properties
from aadm_workbench.document.schema import SCHEMA, SCHEMA_PROPERTY, bring_up_to_date
from aadm_workbench.document.stateless import Stateless
from aadm_workbench.extract.method import METHODS as RECIPES
from aadm_workbench.model import ColumnDesign

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
METHODS = tuple(RECIPES)
DECISIONS = ("guarded", "simple")

_IDENTITY = "AADM column"
_CHECK = "AADM check"
PROPERTIES = (
    SCHEMA_PROPERTY,
    Property(
        "App::PropertyString",
        "ColumnId",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "What jobs and reports call it"),
    ),
    Property(
        "App::PropertyString",
        "MadeAs",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "Name of this object when it was made: a copy has another"),
        mode=HIDDEN,
    ),
    Property(
        "App::PropertyLinkGlobal",
        "Model",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "The object of the model that this column is"),
    ),
    Property(
        "App::PropertyPlacement",
        "ModelOffset",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "Column frame in the frame of the model's object"),
        mode=HIDDEN,
    ),
    Property(
        "App::PropertyString",
        "GlobalId",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "GlobalId in IFC"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyString", "PieceMark", _IDENTITY, QT_TRANSLATE_NOOP("App::Property", "Piece mark"), mode=READ_ONLY
    ),
    Property("App::PropertyString", "Storey", _IDENTITY, QT_TRANSLATE_NOOP("App::Property", "Storey"), mode=READ_ONLY),
    Property("App::PropertyString", "Grid", _IDENTITY, QT_TRANSLATE_NOOP("App::Property", "Grid axes"), mode=READ_ONLY),
    Property(
        "App::PropertyInteger",
        "SleeveCount",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "Sleeves of the design"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyInteger",
        "RebarCount",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "Connecting rebars of the design"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyString",
        "ModelFile",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "File that the design was taken from"),
        mode=READ_ONLY,
    ),
    Property(
        "App::PropertyString",
        "ModelSha256",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "Hash of that file when it was read"),
        mode=HIDDEN,
    ),
    Property(
        "App::PropertyString",
        "ModelProject",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "GlobalId of the project in that file, where it is IFC"),
        mode=HIDDEN,
    ),
    Property(
        "App::PropertyString",
        "Body",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "Body of the column, as its model draws it: thin, in the column frame"),
        mode=HIDDEN,
    ),
    Property(
        "App::PropertyString",
        "SampledSha256",
        _IDENTITY,
        QT_TRANSLATE_NOOP("App::Property", "Hash of the design points as they were sampled"),
        mode=HIDDEN,
    ),
    Property(
        "App::PropertyString", "Design", _IDENTITY, QT_TRANSLATE_NOOP("App::Property", "Design points"), mode=HIDDEN
    ),
    Property(
        "App::PropertyString",
        "JobFile",
        _CHECK,
        QT_TRANSLATE_NOOP("App::Property", "Job file that it was last checked by, together with others"),
        mode=HIDDEN,
    ),
    Property("App::PropertyLinkList", "Scans", _CHECK, QT_TRANSLATE_NOOP("App::Property", "Its scans")),
    Property("App::PropertyLink", "Result", _CHECK, QT_TRANSLATE_NOOP("App::Property", "Its last result")),
    Property(
        "App::PropertyEnumeration",
        "Method",
        _CHECK,
        QT_TRANSLATE_NOOP("App::Property", "How centres are found in a scan"),
        choices=METHODS,
    ),
    Property(
        "App::PropertyString",
        "Tolerances",
        _CHECK,
        QT_TRANSLATE_NOOP("App::Property", "Tolerance profile: a built-in name, or the path of a .toml file"),
        "cn",
    ),
    Property(
        "App::PropertyEnumeration",
        "Decision",
        _CHECK,
        QT_TRANSLATE_NOOP("App::Property", "guarded: decide with 95 % certainty; simple: compare the value alone"),
        choices=DECISIONS,
    ),
    Property(
        "App::PropertyBool",
        "Turns",
        _CHECK,
        QT_TRANSLATE_NOOP("App::Property", "The column may be turned by its own symmetry"),
        False,
    ),
    Property(
        "App::PropertyString",
        "SleevesUp",
        _CHECK,
        QT_TRANSLATE_NOOP("App::Property", "Side of the column at the top of pictures of its sleeves: +x, -x, +y, -y"),
    ),
    Property(
        "App::PropertyString",
        "RebarsUp",
        _CHECK,
        QT_TRANSLATE_NOOP("App::Property", "Side of the column at the top of pictures of its rebars: +x, -x, +y, -y"),
    ),
)


class Column(Stateless):
    """Proxy of a column: keeps it, its scans and its result where the model's object stands."""

    Type = COLUMN_TYPE

    def onDocumentRestored(self, obj: Any) -> None:
        """Bring a column of an earlier version up to date, and give it its view."""
        if bring_up_to_date(obj, PROPERTIES):
            own_up(obj)
        watch_belongings()
        show_restored(obj, "column_view", "ColumnView")

    def execute(self, obj: Any) -> None:
        """Follow the model."""
        follow_model(obj)


def make_column(document: Any, design: ColumnDesign, model: Any = None) -> Any:
    """Create a column in a document, in its true place.

    Parameters
    ----------
    design
        In the column frame; ``T_model_column`` places it in the document.
    model
        The object of the model that it is, if it is in the document.
    """
    watch_belongings()
    column = document.addObject("App::GeometryPython", "AADM_Column")
    column.Proxy = Column()
    apply_properties(column, PROPERTIES)
    column.MadeAs = column.Name
    column.Schema = SCHEMA
    column.ColumnId = design.id
    column.Label = f"AADM {design.id}"
    column.Model = model
    put_into_group(column)
    set_design(column, design)
    attach_view(column, "column_view", "ColumnView")
    return column


def set_design(column: Any, design: ColumnDesign) -> None:
    """Give a column another design; what was measured against the old one no longer counts and must be redone."""
    column.Design = write_design(design)
    column.GlobalId = design.global_id or ""
    column.PieceMark = design.piece_mark or ""
    column.Storey = design.storey or ""
    column.Grid = design.grid or ""
    column.SleeveCount, column.RebarCount = len(design.sleeves), len(design.rebars)
    T_model_column = np.eye(4) if design.T_model_column is None else design.T_model_column
    column.Placement = placement_of(T_model_column)
    if column.Model is not None:
        column.ModelOffset = global_placement(column.Model).inverse() * column.Placement


def column_design(column: Any) -> ColumnDesign:
    """The design of a column object, placed where it stands now.

    Raises
    ------
    DesignError
        Where it holds none.
    """
    return replace(read_design(column.Design, column.Label), T_model_column=transform_of(column.Placement))


def follow_model(column: Any) -> None:
    """Move a column, its scans and its result to where the model's object stands now."""
    if column.Model is not None:
        move_to(column, global_placement(column.Model) * column.ModelOffset)
    for part in (*column.Scans, column.Result):
        if part is not None and hasattr(part.Proxy, "follow"):
            part.Proxy.follow(part, column.Placement)


def attach_view(obj: Any, module: str, name: str) -> None:
    """Give an object its view provider, where there is a window."""
    if not FreeCAD.GuiUp or getattr(obj, "ViewObject", None) is None:
        return
    from importlib import import_module

    getattr(import_module(f"aadm_workbench.gui.{module}"), name)(obj.ViewObject)


def show_restored(obj: Any, module: str, name: str) -> None:
    """Show an object that was saved without a window: it has no view provider, and FreeCAD opens it hidden."""
    if FreeCAD.GuiUp and getattr(obj, "ViewObject", None) is not None and obj.ViewObject.Proxy is None:
        attach_view(obj, module, name)
        obj.ViewObject.Visibility = True
