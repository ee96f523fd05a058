"""As-designed points of STEP and BREP files, through FreeCAD's geometry kernel."""

from __future__ import annotations

from pathlib import Path

from aadm_workbench.design.kernel import read_with_kernel
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.model_file import KERNEL
from aadm_workbench.design.recognise.columns import Rules
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason

_HEAD_BYTES = 4096  # what the format begins and ends with stands in the first, and the last, of them


def read_step(path: str | Path, rules: Rules | None = None) -> ModelDesign:
    """Columns, sleeves and connecting rebars of a STEP or BREP file, its cylinders exact.

    Raises
    ------
    DesignError
        Where the file is cut short or no such file, or a rule finds nothing.
    MissingDependencyError
        Where FreeCAD is not installed.
    """
    path = Path(path)
    return read_with_kernel(path, _check, rules or Rules(), schema=KERNEL[path.suffix.lower()])


def _check(path: Path) -> None:
    content = path.read_bytes()
    if KERNEL[path.suffix.lower()] == "BREP":
        if b"CASCADE Topology" not in content[:_HEAD_BYTES]:
            raise DesignError(Reason("design.no_brep", path=path))
        return
    if b"ISO-10303-21" not in content[:_HEAD_BYTES]:
        raise DesignError(Reason("design.no_step", path=path))
    if b"END-ISO-10303-21" not in content[-_HEAD_BYTES:]:
        raise DesignError(Reason("design.step_cut", path=path))
    if b"IFC" in content[:_HEAD_BYTES].split(b"FILE_SCHEMA", 1)[-1][:64]:
        raise DesignError(Reason("design.is_ifc", path=path))
