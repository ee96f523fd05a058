"""Models of every format that as-designed points can be read from."""

from __future__ import annotations

from pathlib import Path

from aadm_workbench.design.ifc import read_ifc
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.errors import DesignError


def read_model(
    path: str | Path, *, columns: str | None = None, sleeves: str | None = None, rebars: str | None = None
) -> ModelDesign:
    """Columns, sleeves and connecting rebars of a model, by the format that its name ends in.

    Parameters
    ----------
    path
        The model: .ifc.
    columns, sleeves, rebars
        Optional selectors in the syntax of ``ifcopenshell.util.selector``.

    Raises
    ------
    DesignError
        For a format that is not supported, and for whatever the format's reader refuses.
    """
    suffix = Path(path).suffix
    if suffix.lower() == ".ifc":
        return read_ifc(path, columns=columns, sleeves=sleeves, rebars=rebars)
    called = f"models of the format {suffix}" if suffix else "models without an extension"
    raise DesignError(
        f"{path}: {called} are not supported. Supported: .ifc. Export the model as IFC, or describe the column in the "
        "job, in [columns.design]."
    )
