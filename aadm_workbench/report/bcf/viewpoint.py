"""viewpoint.bcfv: a camera under the foot that looks up at the sleeves, with the components of a topic."""

from __future__ import annotations

import hashlib
import uuid
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable

import numpy as np

from aadm_workbench.model import Array, ColumnReport, Kind, PointResult
from aadm_workbench.report.bcf.findings import Finding, points_of
from aadm_workbench.report.bcf.forms import Form, xml_bytes
from aadm_workbench.report.words.labels import COLOUR

_METRES = 1e-3  # BCF has metres alone
_ASPECT_RATIO = 1.0  # a foot is about as wide as it is deep
_FIELD_OF_VIEW_DEG = 60.0  # what viewers have by themselves
_DISTANCE_IN_FOOT_SIZES = 1.3  # the foot fills two thirds of that view
_ASIDE_IN_FOOT_SIZES = 0.35  # 15 degrees: bores are seen to be bores
_SMALLEST_FOOT_MM = 200.0  # where a design tells no size: no column is smaller


def viewpoint_bytes(finding: Finding, form: Form, guid: str) -> bytes:
    """The file of a topic's viewpoint; coordinates in metres of the model."""
    root = ElementTree.Element("VisualizationInfo", Guid=guid)
    _components(root, finding, form)
    position, direction, up = _camera(finding.column)
    camera = ElementTree.SubElement(root, "PerspectiveCamera")
    for name, vector in (("CameraViewPoint", position), ("CameraDirection", direction), ("CameraUpVector", up)):
        element = ElementTree.SubElement(camera, name)
        for axis, value in zip("XYZ", vector, strict=True):
            ElementTree.SubElement(element, axis).text = repr(round(float(value), 9) + 0.0)
    ElementTree.SubElement(camera, "FieldOfView").text = repr(_FIELD_OF_VIEW_DEG)
    if form.is_3:
        ElementTree.SubElement(camera, "AspectRatio").text = repr(_ASPECT_RATIO)
    return xml_bytes(root)


def viewpoint_guid(finding: Finding, form: Form, picture: bytes) -> str:
    """The GUID of a topic's viewpoint: the same as long as viewpoint and picture are."""
    content = viewpoint_bytes(finding, form, "") + picture
    return str(uuid.uuid5(uuid.UUID(finding.guid), f"viewpoint {hashlib.sha256(content).hexdigest()}"))


def _camera(column: ColumnReport) -> tuple[Array, Array, Array]:
    """Position, direction and up (each (3,), m, model frame): under the foot, looking up, the column's y upwards."""
    T_model_column = np.eye(4) if column.T_model_column is None else column.T_model_column
    drawn = [point.design_mm for kind in Kind for point in column.points(kind)]
    size_mm = max(
        [_SMALLEST_FOOT_MM, *(column.size_mm or ()), *np.ptp(np.array(drawn or [(0.0, 0.0, 0.0)]), axis=0)[:2]]
    )
    seen_from_mm = size_mm * np.array([0.0, -_ASIDE_IN_FOOT_SIZES, -_DISTANCE_IN_FOOT_SIZES])
    rotation = T_model_column[:3, :3]
    direction = rotation @ (-seen_from_mm / np.linalg.norm(seen_from_mm))
    across = rotation[:, 1]
    up = across - float(across @ direction) * direction
    position = _METRES * (T_model_column[:3, 3] + rotation @ seen_from_mm)
    return position, direction, up / np.linalg.norm(up)


def _components(root: ElementTree.Element, finding: Finding, form: Form) -> None:
    """Select what the topic is about, show the column with its sleeves and bars alone, colour them by verdict."""
    points = [point for kind in Kind for point in finding.column.points(kind)]
    shown = _ids([finding.column, *points])
    if not shown:
        return
    blamed = [point for number in finding.numbers for point in points_of(finding.column, number)]
    components = ElementTree.SubElement(root, "Components")
    _list(ElementTree.SubElement(components, "Selection"), _ids(blamed) or _ids([finding.column]) or shown)
    visibility = ElementTree.SubElement(components, "Visibility", DefaultVisibility="false")
    _list(ElementTree.SubElement(visibility, "Exceptions"), shown)
    coloring = ElementTree.SubElement(components, "Coloring")
    for verdict, colour in COLOUR.items():
        coloured = _ids(point for point in points if point.verdict == verdict)
        if finding.verdict == verdict:
            coloured += _ids([finding.column])
        if coloured:
            element = ElementTree.SubElement(coloring, "Color", Color=_opaque(colour))
            _list(ElementTree.SubElement(element, "Components") if form.is_3 else element, coloured)


def _opaque(colour: str) -> str:
    """``#00795a`` as BCF writes it, alpha first."""
    return f"FF{colour.removeprefix('#').upper()}"


def _ids(entries: Iterable[ColumnReport | PointResult]) -> list[str]:
    return list(dict.fromkeys(entry.global_id for entry in entries if entry.global_id))


def _list(parent: ElementTree.Element, global_ids: Iterable[str]) -> None:
    for global_id in global_ids:
        ElementTree.SubElement(parent, "Component", IfcGuid=global_id)
