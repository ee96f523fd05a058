"""How a column is shown: the outline of its foot, its sleeves and bars as designed, at true size.

The module path and the class name are written into users' files: neither may change.
"""

from __future__ import annotations

import json
from typing import Any

import FreeCAD
import numpy as np

from aadm_workbench.document.column import column_design
from aadm_workbench.document.display.colours import BAR, DESIGN, GHOST
from aadm_workbench.document.display.marks import ring
from aadm_workbench.document.properties import Property
from aadm_workbench.gui import coin_shapes
from aadm_workbench.gui.view_provider import MarksView
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
_SIDES = 12  # of what is drawn round: twenty-four of them a column, thirty columns a floor


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
        Property(
            "App::PropertyBool",
            "ShowBody",
            "AADM",
            QT_TRANSLATE_NOOP("App::Property", "Show the body of the column as its model draws it"),
            True,
        ),
    )
    REDRAWN_BY = frozenset({"Design", "Body"})

    def draw(self, obj: Any, vobj: Any, root: Any) -> None:
        """Outline and circles, thin: what was measured is drawn over them."""
        if not obj.Design:
            return
        design = column_design(obj)
        if obj.Body and vobj.ShowBody:
            self._draw_body([np.array(face) for face in json.loads(obj.Body)], design, root)
        group = coin_shapes.in_front() if vobj.OnTop else root
        outline = foot_outline(design)
        rings = [ring(_on_foot(point.centre), point.diameter_mm / 2.0) for point in (*design.sleeves, *design.rebars)]
        group.addChild(coin_shapes.lines([outline], [DESIGN], 2.0))
        group.addChild(coin_shapes.lines(rings, [DESIGN] * len(rings), 1.0))
        if group is not root:
            root.addChild(group)

    def _draw_body(self, faces: list[Array], design: ColumnDesign, root: Any) -> None:
        """The concrete as a ghost; its sleeves and bars in it as tubes, as far as their lengths are known."""
        tubes = [tube(point, 1.0) for point in design.sleeves]
        bars = [tube(point, -1.0) for point in design.rebars]
        sides = [side for one in tubes for side in one]
        bar_sides = [side for one in bars for side in one]
        root.addChild(coin_shapes.areas(sides, [DESIGN] * len(sides), 0.6))
        root.addChild(coin_shapes.areas(bar_sides, [BAR] * len(bar_sides), 0.3))
        root.addChild(coin_shapes.lines([np.vstack([face, face[:1]]) for face in faces], [GHOST] * len(faces), 1.0))
        root.addChild(coin_shapes.areas(faces, [GHOST] * len(faces), 0.85))

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


def tube(point: AssemblyPoint, rises: float) -> list[Array]:
    """Sides (4, 3) mm of a sleeve or a bar, column frame, along its axis; none where its length is not known.

    A sleeve's centre is its mouth, a bar's its top: one ``rises`` from there (1), the other goes down (-1).
    """
    if point.length_mm is None:
        return []
    axis = np.asarray(point.axis) * np.sign(point.axis[2] or 1.0) * rises
    end = np.asarray(point.centre) + point.length_mm * axis
    turn = np.linspace(0.0, 2.0 * np.pi, _SIDES + 1)
    across = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(_SIDES + 1)]) * point.diameter_mm / 2.0
    low, high = np.asarray(point.centre) + across, end + across
    return list(np.stack([low[:-1], low[1:], high[1:], high[:-1]], axis=1))


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
