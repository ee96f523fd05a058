"""As-designed points of STEP and BREP files, through FreeCAD's geometry kernel.

Files that FreeCAD's geometry kernel reads for this product: checked, read in a process of its own, recognised.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from time import perf_counter

from aadm_workbench.design.element_json import from_json
from aadm_workbench.design.freecad_program import CrashError, ask_freecad
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.model_file import KERNEL, sha256_of
from aadm_workbench.design.recognise.columns import Origin, Rules, recognise
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason

_HEAD_BYTES = 4096  # what the format begins and ends with stands in the first, and the last, of them

_MODULE = "aadm_workbench.document.sample.export"


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


def read_with_kernel(path: Path, check: Callable[[Path], None], rules: Rules, *, schema: str) -> ModelDesign:
    """Columns, sleeves and connecting rebars of a file, which is read only after ``check`` has let it pass.

    Raises
    ------
    DesignError
        Where the file cannot be used, with its name.
    MissingDependencyError
        Where FreeCAD is not installed.
    """
    began = perf_counter()
    sha256 = sha256_of(path)
    check(path)
    question = {"path": str(path.resolve())}
    try:
        answer = ask_freecad(_MODULE, question, str(path))
    except CrashError:
        if schema != "STEP":
            raise
        # The reader of names and assemblies is the delicate one; the shapes alone are read by another.
        answer = ask_freecad(_MODULE, {**question, "names": False}, str(path))
    try:
        elements = from_json(answer["elements"])
        problems = tuple(dict.fromkeys(str(problem) for problem in answer["problems"]))
    except (LookupError, TypeError, ValueError) as error:
        raise DesignError(Reason("design.kernel", path=path, why=error)) from error
    found = recognise(elements, Origin(str(path), sha256, schema, problems), rules)
    return replace(found, seconds=perf_counter() - began)
