"""What FreeCAD and its private process say to each other, as the JSON that they write for each other."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypedDict


class Chosen(TypedDict):
    """An object of a document that somebody has pointed at: what it is called, the ids of its elements."""

    label: str
    ids: list[str]


class Shapes(TypedDict):
    """The shapes of a document: ``elements`` as :mod:`aadm_workbench.design.element_json` has them.

    ``chosen`` is empty for all of them; ``sha256`` is that of the file ``source`` as it was last saved, or empty.
    """

    elements: list[Mapping[str, Any]]
    chosen: list[Chosen]
    problems: list[str]
    source: str
    sha256: str


class FoundColumns(TypedDict):
    """Columns of a model, each as the text of :mod:`aadm_workbench.design.design_text`.

    ``bodies`` are polygons [[x, y, z], ...] mm around each column's concrete, in its column frame; none where they are
    not known, or where the document shows the body itself.
    """

    source: str
    sha256: str
    schema: str
    warnings: list[str]
    project: str
    columns: list[str]
    bodies: list[list[list[list[float]]]]


class ReadScan(TypedDict):
    """A scan for the eye: ``count`` of all its points, some of them (n, 3) mm in the file's own frame.

    ``camera`` and ``depth_scale_mm`` are those that it was read with.
    """

    sha256: str
    count: int
    points: list[list[float]]
    R_file_scan: list[list[float]]
    camera: Mapping[str, float] | None
    depth_scale_mm: float | None
    notes: list[str]


class ReadCamera(TypedDict):
    """A file of intrinsics: those of the camera, and millimetres in a step of its depth maps where it says so."""

    camera: Mapping[str, float]
    depth_scale_mm: float | None
