"""Models of every format that as-designed points can be read from."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.model_file import KERNEL, MESHES
from aadm_workbench.design.recognise.columns import Rules
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason

_IFC = (".ifc", ".ifczip")
SUPPORTED = (".ifc", ".FCStd", *KERNEL, *MESHES, ".pcd", ".ifczip")
"""Endings of all files that hold a design; clouds are read by :mod:`aadm_workbench.inspection.as_designed`."""


def read_model(
    path: str | Path,
    *,
    columns: str | None = None,
    sleeves: str | None = None,
    rebars: str | None = None,
    units: str = "mm",
    only: Collection[str] | None = None,
) -> ModelDesign:
    """Columns, sleeves and connecting rebars of a model, by the format that its name ends in.

    Parameters
    ----------
    path
        The model: .ifc, .ifczip, .FCStd, .step, .brep, .stl, .obj, .ply; .json is what the workbench hands over.
    columns, sleeves, rebars
        Optional selectors in the syntax of ``ifcopenshell.util.selector``.
    units
        Of a mesh, which does not know its own: mm, cm, m, inch or foot. Other formats bring theirs.
    only
        Names of the columns that are asked for: of an IFC model, what belongs to none of them may be left out.

    Raises
    ------
    DesignError
        For a format that is not supported, and for whatever the format's reader refuses.
    MissingDependencyError
        Where a program or package that the format needs is not installed.
    """
    suffix = Path(path).suffix
    if suffix.lower() in _IFC:
        return read_ifc(path, columns=columns, sleeves=sleeves, rebars=rebars, only=only)
    rules = Rules(columns, sleeves, rebars)
    if suffix.lower() == ".fcstd":
        from aadm_workbench.design.fcstd import read_fcstd

        return read_fcstd(path, rules)
    if suffix.lower() in KERNEL:
        from aadm_workbench.design.step import read_step

        return read_step(path, rules)
    if suffix.lower() == ".json":
        from aadm_workbench.design.design_text import read_designs

        return read_designs(Path(path))
    if suffix.lower() in MESHES:
        from aadm_workbench.design.mesh import read_mesh

        return read_mesh(path, rules, units=units)
    called = Reason("design.of_format", suffix=suffix) if suffix else Reason("design.no_extension")
    raise DesignError(Reason("design.unsupported", path=path, called=called, supported=SUPPORTED))
