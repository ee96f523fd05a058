"""How a column is shown: the outline of its foot, its sleeves and bars as designed, at true size.

The module path and the class name are written into users' files: neither may change.
"""

from __future__ import annotations

from typing import Any

import FreeCAD
import numpy as np

from aadm_workbench.document.column import column_design
from aadm_workbench.document.display.colours import DESIGN
from aadm_workbench.document.display.marks import ring
from aadm_workbench.document.properties import Property
from aadm_workbench.gui import coin_shapes
from aadm_workbench.gui.view_provider import MarksView
from aadm_workbench.model import Array, ColumnDesign

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class ColumnView(MarksView):
    """View provider of a column."""

    PROPERTIES = (
        Property(
            "App::PropertyBool",
            "OnTop",
            "AADM",
            QT_TRANSLATE_NOOP("App::Property", "Draw over everything: the foot is inside the column's own concrete"),
            True,
        ),
    )
    REDRAWN_BY = frozenset({"Design"})

    def draw(self, obj: Any, vobj: Any, root: Any) -> None:
        """Outline and circles, thin: what was measured is drawn over them."""
        if not obj.Design:
            return
        design = column_design(obj)
        group = coin_shapes.in_front() if vobj.OnTop else root
        outline = foot_outline(design)
        rings = [ring(_on_foot(point.centre), point.diameter_mm / 2.0) for point in (*design.sleeves, *design.rebars)]
        group.addChild(coin_shapes.lines([outline], [DESIGN], 2.0))
        group.addChild(coin_shapes.lines(rings, [DESIGN] * len(rings), 1.0))
        if group is not root:
            root.addChild(group)

    def icon_name(self, obj: Any) -> str:
        """The icon says the verdict, by shape and by colour."""
        return f"column-{obj.Result.Verdict or 'unchecked'}" if obj.Result is not None else "column-unchecked"

    def claimChildren(self) -> list[Any]:
        """Scans and result stand below their column in the tree."""
        parts = [*self.Object.Scans, self.Object.Result]
        return [part for part in parts if part is not None]

    def onDelete(self, vobj: Any, subelements: Any) -> bool:
        """Scans and result go with their column, in the same undo step."""
        for part in self.claimChildren():
            part.Document.removeObject(part.Name)
        return True

    def doubleClicked(self, vobj: Any) -> bool:
        """Open the panel of the check."""
        from aadm_workbench.gui.panels.check import open_panel

        open_panel(vobj.Object)
        return True


def foot_outline(design: ColumnDesign) -> Array:
    """Corners (5, 3) mm of the foot, closed, column frame; a frame around the points where no size is known."""
    if design.size_mm is not None:
        half = np.array(design.size_mm) / 2.0
        low, high = -half, half
    else:
        centres = np.array([point.centre[:2] for point in (*design.sleeves, *design.rebars)]).reshape(-1, 2)
        reach_mm = max((point.diameter_mm for point in design.sleeves), default=50.0)
        low = (centres.min(axis=0) if len(centres) else np.zeros(2)) - reach_mm
        high = (centres.max(axis=0) if len(centres) else np.zeros(2)) + reach_mm
    x, y = [low[0], high[0], high[0], low[0], low[0]], [low[1], low[1], high[1], high[1], low[1]]
    return np.column_stack([x, y, np.zeros(5)])


def _on_foot(centre: Array) -> Array:
    return np.array([centre[0], centre[1], 0.0])
