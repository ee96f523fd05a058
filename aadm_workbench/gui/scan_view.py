"""How a scan is shown: its thinned points, coloured by their distance from the design once a check has laid it there.

The module path and the class name are written into users' files: neither may change.
"""

from __future__ import annotations

from typing import Any

import FreeCAD
import numpy as np

from aadm_workbench.document.display.colours import FAR, of_distances
from aadm_workbench.document.properties import Property
from aadm_workbench.gui import coin_shapes
from aadm_workbench.gui.view_provider import MarksView

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class ScanView(MarksView):
    """View provider of a scan."""

    PROPERTIES = (
        Property(
            "App::PropertyEnumeration",
            "ColourBy",
            "AADM",
            QT_TRANSLATE_NOOP("App::Property", "Distance from the design, or one colour"),
            choices=("Distance", "One colour"),
        ),
        Property(
            "App::PropertyLength",
            "Reach",
            "AADM",
            QT_TRANSLATE_NOOP("App::Property", "Distance at which the colours end; points beyond are grey"),
            1.0,
        ),
        Property(
            "App::PropertyFloat",
            "PointSize",
            "AADM",
            QT_TRANSLATE_NOOP("App::Property", "Size of a point, pixels"),
            3.0,
        ),
    )
    REDRAWN_BY = frozenset({"Points", "Distances"})

    def draw(self, obj: Any, vobj: Any, root: Any) -> None:
        """One node for all points."""
        places = np.array([tuple(point) for point in obj.Points], dtype=np.float32).reshape(-1, 3)
        distances_mm = np.array(obj.Distances, dtype=np.float64)
        colours = np.tile(np.array(FAR), (len(places), 1))
        if vobj.ColourBy == "Distance" and len(distances_mm) == len(places):
            colours = of_distances(distances_mm, max(vobj.Reach.Value, 1e-3))
        root.addChild(coin_shapes.points(places, colours, vobj.PointSize))

    def icon_name(self, obj: Any) -> str:
        """Feet and bars have different icons."""
        return f"scan-{obj.Kind}"
