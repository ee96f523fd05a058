"""The camera of FreeCAD's active 3-D view: read for labels, set for a closer look."""

from __future__ import annotations

from typing import Any

import FreeCADGui
import numpy as np
from pivy import coin

from aadm_workbench.document.display.projection import ViewCamera
from aadm_workbench.model import Array


def active_view() -> Any:
    """The 3-D view in front; None where another kind of window is."""
    document = FreeCADGui.activeDocument()
    view = document.activeView() if document is not None else None
    return view if view is not None and hasattr(view, "getCameraNode") else None


def camera_of(view: Any) -> ViewCamera:
    """How a view looks at the model now."""
    node = view.getCameraNode()
    position = np.array(node.position.getValue().getValue(), dtype=np.float64)
    turned = [node.orientation.getValue().multVec(coin.SbVec3f(*axis)).getValue() for axis in np.eye(3).tolist()]
    focal_mm = float(node.focalDistance.getValue())
    if node.isOfType(coin.SoOrthographicCamera.getClassTypeId()):
        height_mm, focal_mm = float(node.height.getValue()), float("inf")
    else:
        height_mm = 2.0 * focal_mm * float(np.tan(node.heightAngle.getValue() / 2.0))
    width, height = view.getSize()
    return ViewCamera(position, np.array(turned), height_mm, focal_mm, (float(width), float(height)))


def zoom_to(view: Any, point: Array, shown_mm: float) -> None:
    """Look at a point (3,) mm from where one looks now, so near that the view is ``shown_mm`` high."""
    if hasattr(view, "stopAnimating"):
        # Since 1.0 a view turns slowly, and would go on to where it was going.
        view.stopAnimating()
    node = view.getCameraNode()
    backward = np.array(node.orientation.getValue().multVec(coin.SbVec3f(0, 0, 1)).getValue(), dtype=np.float64)
    if node.isOfType(coin.SoOrthographicCamera.getClassTypeId()):
        distance_mm = max(float(node.focalDistance.getValue()), 10.0 * shown_mm)
        node.height.setValue(shown_mm)
    else:
        distance_mm = shown_mm / 2.0 / float(np.tan(node.heightAngle.getValue() / 2.0))
    node.position.setValue(*(point + backward * distance_mm).tolist())
    node.focalDistance.setValue(distance_mm)
