"""What a model gives: columns with their assembly points, what belongs to none, and what was not taken and why."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.errors import DesignError
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, GridAxis, Reason
from aadm_workbench.model.reason import listed

_GLOBAL_ID_LENGTH = 22  # 22 characters (IFC): a name that long is one
_DASHES = {ord(dash): "-" for dash in "\u2010\u2011\u2012\u2013\u2014\u2015\u2212"}
_SHOWN = 8
"""Names in a message before it stops counting them up."""


@dataclass(frozen=True, eq=False)
class NotTaken:
    """An element that was looked at and left out.

    ``what`` is "column", "sleeve" or "rebar"; ``point`` (3,) mm, model frame, is its upper end (bars) or its mouth;
    ``names`` is all that a job may call it by.
    """

    what: str
    ifc_class: str
    global_id: str
    name: str
    reason: str
    point: Array | None = None
    diameter_mm: float | None = None
    length_mm: float | None = None
    names: tuple[str, ...] = ()

    @classmethod
    def of(
        cls,
        what: str,
        element: Any,
        reason: str,
        point: Array | None = None,
        diameter_mm: float | None = None,
        length_mm: float | None = None,
        names: tuple[str, ...] = (),
    ) -> NotTaken:
        """What was left out of an element of any kind of model, under the attribute names of IFC."""
        name = element.Name.strip() if isinstance(element.Name, str) else ""
        return cls(what, str(element.is_a()), element.GlobalId, name, reason, point, diameter_mm, length_mm, names)


@dataclass(frozen=True, eq=False)
class ModelDesign:
    """The as-designed points of a model.

    Parameters
    ----------
    source
        The file as it was named.
    sha256
        Hash of the file's bytes.
    schema
        Of the model, such as IFC4.
    columns
        Columns with grouting sleeves in their foot, each in its column frame.
    loose_sleeves, loose_rebars
        Points that belong to none of these columns, in the model frame; without labels.
    warnings
        What a person should know; those about one column stand there.
    not_taken
        Elements that were looked at and left out, with the reason.
    holdings
        What the model holds, by class, in words.
    hint
        Where there is no column with sleeves: what was found instead, and how to say what is what.
    T_model_file
        (4, 4): the world coordinate system of the file, which moves its placements into the model frame.
    grid
        Straight axes of its grids.
    project
        GlobalId of the project of an IFC model.
    seconds, parse_seconds
        What finding the points took, and opening the file before; no part of any result.
    """

    source: str
    sha256: str
    schema: str
    columns: tuple[ColumnDesign, ...] = ()
    loose_sleeves: tuple[AssemblyPoint, ...] = ()
    loose_rebars: tuple[AssemblyPoint, ...] = ()
    warnings: tuple[str, ...] = ()
    not_taken: tuple[NotTaken, ...] = ()
    holdings: str = ""
    hint: str = ""
    T_model_file: Array = field(default_factory=lambda: np.eye(4))
    grid: tuple[GridAxis, ...] = ()
    project: str = ""
    seconds: float = 0.0
    parse_seconds: float = 0.0

    def column(self, key: str) -> ColumnDesign:
        """The column of that Name, Tag, PieceMark or GlobalId; the only one of a file answers to the file's name too.

        Raises
        ------
        DesignError
            Where none or more than one is called so; names those that come near, or all that share the name.
        """
        wanted = key.strip()
        found = [column for column in self.columns if wanted in column.names]
        if not found:
            folded = _folded(wanted)
            found = [column for column in self.columns if folded in map(_folded, column.names)]
        if not found and len(self.columns) == 1 and wanted == Path(self.source).stem:
            return self.columns[0]  # formats without names: a mesh, a STEP file of bare bodies
        if len(found) == 1:
            return found[0]
        if found:
            ids = listed([column.id for column in found], _SHOWN)
            raise DesignError(Reason("design.several", key=repr(key), count=len(found), source=self.source, ids=ids))
        raise DesignError(self._missing(wanted))

    def _missing(self, key: str) -> str:
        without = next(
            (left for left in self.not_taken if left.what == "column" and _folded(key) in map(_folded, left.names)),
            None,
        )
        if without is not None:
            return Reason("design.without", key=repr(key), source=self.source, why=without.reason, help=self._help())
        if not self.columns:
            return Reason("design.no_sleeves", source=self.source, help=self._help())
        names = sorted({name for column in self.columns for name in column.names if len(name) != _GLOBAL_ID_LENGTH})
        holding = [name for name in names if key.casefold() in name.casefold()]
        near = list(dict.fromkeys([*holding, *get_close_matches(key, names, n=_SHOWN, cutoff=0.5)]))
        names = near or [column.id for column in self.columns]
        shown = Reason("design.near" if near else "design.has", names=listed(names, _SHOWN))
        return Reason("design.no_column", source=self.source, key=repr(key), shown=shown)

    def _help(self) -> str:
        how = self.hint or (Reason("design.name_sleeves"))
        return Reason("design.holds", holdings=self.holdings, how=how)


def _folded(name: str) -> str:
    """A name as it is compared: full-width letters, upper case and the dashes of typographers make no difference."""
    return unicodedata.normalize("NFKC", name).translate(_DASHES).strip().casefold()
