"""Coin nodes for many lines, areas and points at once: one node each, so that a floor stays fluid."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from pivy import coin

from aadm_workbench.document.display.colours import Rgb
from aadm_workbench.model import Array


def lines(
    outlines: Sequence[Array], colours: Sequence[Rgb], width_px: float, *, dashed: bool = False
) -> coin.SoSeparator:
    """Open lines (n, 3) mm, each in its colour."""
    node = coin.SoSeparator()
    if not outlines:
        return node
    style = coin.SoDrawStyle()
    style.lineWidth = width_px
    if dashed:
        style.linePattern = 0xF0F0
    counts = coin.SoLineSet()
    counts.numVertices.setValues(0, len(outlines), [len(outline) for outline in outlines])
    for part in (_unlit(), style, *_coloured(colours), _coordinates(np.concatenate(outlines)), counts):
        node.addChild(part)
    return node


def areas(outlines: Sequence[Array], colours: Sequence[Rgb], transparency: float = 0.0) -> coin.SoSeparator:
    """Filled polygons (n, 3) mm, each in its colour."""
    node = coin.SoSeparator()
    if not outlines:
        return node
    shape = coin.SoShapeHints()
    shape.faceType = coin.SoShapeHints.UNKNOWN_FACE_TYPE
    shape.vertexOrdering = coin.SoShapeHints.UNKNOWN_ORDERING
    counts = coin.SoFaceSet()
    counts.numVertices.setValues(0, len(outlines), [len(outline) for outline in outlines])
    coloured = _coloured(colours, transparency)
    for part in (_unlit(), shape, *coloured, _coordinates(np.concatenate(outlines)), counts):
        node.addChild(part)
    return node


def points(places: Array, colours: Array, size_px: float) -> coin.SoSeparator:
    """Points (n, 3) mm, each in its colour (n, 3)."""
    node = coin.SoSeparator()
    if not len(places):
        return node
    style = coin.SoDrawStyle()
    style.pointSize = size_px
    material = coin.SoMaterial()
    flat = np.ascontiguousarray(colours, dtype=np.float32)
    material.diffuseColor.setValues(0, len(flat), flat)
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.PER_VERTEX
    shown = coin.SoPointSet()
    shown.numPoints = len(places)
    for part in (_unlit(), style, material, binding, _coordinates(places), shown):
        node.addChild(part)
    return node


def in_front() -> coin.SoGroup:
    """A group that is drawn over everything: marks on a foot face would hide inside the column's own concrete."""
    return coin.SoAnnotation()


def _unlit() -> coin.SoLightModel:
    """Colours mean something here: no light may change them."""
    model = coin.SoLightModel()
    model.model = coin.SoLightModel.BASE_COLOR
    return model


def _coordinates(places: Array) -> coin.SoCoordinate3:
    flat = np.ascontiguousarray(places, dtype=np.float32)
    node = coin.SoCoordinate3()
    node.point.setValues(0, len(flat), flat)
    return node


def _coloured(colours: Sequence[Rgb], transparency: float = 0.0) -> tuple[coin.SoMaterial, coin.SoMaterialBinding]:
    material = coin.SoMaterial()
    flat = np.ascontiguousarray(colours, dtype=np.float32).reshape(-1, 3)
    material.diffuseColor.setValues(0, len(flat), flat)
    material.transparency.setValues(0, len(flat), [transparency] * len(flat))
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.PER_FACE
    return material, binding
