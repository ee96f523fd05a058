"""What a FreeCAD that runs without a screen answers when it is asked for the elements of a file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.design.element_json import to_json
from aadm_workbench.document.sample.elements import sample_elements
from aadm_workbench.errors import DesignError


def answer(question: dict[str, Any]) -> dict[str, Any]:
    """Elements of the file ``question["path"]``, and what was left out; the file is read and never written.

    Raises
    ------
    DesignError
        Where FreeCAD's kernel cannot read it.
    """
    path = Path(question["path"])
    if path.suffix.lower() == ".fcstd":
        document = _opened(path)
    else:
        document = _imported(path, with_names=question.get("names", True))
    problems: list[str] = []
    try:
        elements = sample_elements(document, problems)
    finally:
        FreeCAD.closeDocument(document.Name)
    return {"elements": to_json(elements), "problems": problems, "freecad": ".".join(FreeCAD.Version()[:3])}


def _opened(path: Path) -> Any:
    _known_proxies()
    try:
        document = FreeCAD.openDocument(str(path), hidden=True)
    except (OSError, RuntimeError, ValueError) as error:
        raise DesignError(str(error)) from error
    if document is None:
        raise DesignError.because("document.not_held")
    return document


def _known_proxies() -> None:
    """Modules whose objects come back only where they are already imported."""
    from importlib import import_module

    for name in ("Arch", "Draft"):
        try:
            import_module(name)
        except ImportError:  # an installation without BIM: shapes and properties are there all the same
            continue


def _imported(path: Path, *, with_names: bool) -> Any:
    """A STEP or BREP file as a document; the names and assemblies of STEP come with it where that works."""
    document = FreeCAD.newDocument("Imported")
    if with_names and path.suffix.lower() in (".step", ".stp"):
        import Import

        try:
            # Merging, the default, brings FreeCAD 0.20 down where there is no window.
            Import.insert(str(path), document.Name, merge=False)
        except (OSError, RuntimeError, TypeError, ValueError) as error:
            FreeCAD.Console.PrintWarning(f"{path}: read without its names ({error})\n")
        document.recompute()
    if not any(obj.isDerivedFrom("Part::Feature") and not obj.Shape.isNull() for obj in document.Objects):
        document.addObject("Part::Feature", "Shape").Shape = _shape(path)
    return document


def _shape(path: Path) -> Any:
    import Part

    shape = Part.Shape()
    try:
        shape.read(str(path))
    except (OSError, RuntimeError, ValueError) as error:
        raise DesignError.because("document.bad_geometry", why=error) from error
    if shape.isNull():
        raise DesignError.because("document.no_geometry")
    return shape
