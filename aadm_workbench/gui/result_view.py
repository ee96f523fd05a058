"""How a result is shown on its column: circles at true size, arrows magnified, labels on what fails.

The module path and the class name are written into users' files: neither may change.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import FreeCAD
import FreeCADGui
import numpy as np
from pivy import coin

from aadm_workbench.document.column import column_design
from aadm_workbench.document.display.colours import of_verdict
from aadm_workbench.document.display.marks import (
    SHOWN,
    Label,
    Marks,
    arrow_outline,
    best_magnification,
    marks_of,
    pitch_of,
    ring,
)
from aadm_workbench.document.display.reported_design import design_of_report
from aadm_workbench.document.groups import owner_of
from aadm_workbench.document.places import transform_of
from aadm_workbench.document.properties import Property
from aadm_workbench.document.result import found_of
from aadm_workbench.document.words import in_words, length_text
from aadm_workbench.errors import DesignError
from aadm_workbench.gui import coin_shapes
from aadm_workbench.gui.column_view import foot_outline
from aadm_workbench.gui.label_image import LabelImage, label_image
from aadm_workbench.gui.label_keeper import KEEPER
from aadm_workbench.gui.settings import label_size_pt
from aadm_workbench.gui.view_provider import MarksView
from aadm_workbench.model import Array

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
translate = FreeCAD.Qt.translate

LABELLED = ("What fails", "All", "None")
_GOOD = frozenset({"pass", "not_assessed"})
_EMPTY = np.zeros((0, 3))  # no points
_LEAST_PITCH_PX = 25.0
"""Where neighbours are closer on the screen than this, points are not labelled."""


class ResultView(MarksView):
    """View provider of a result."""

    PROPERTIES = (
        Property(
            "App::PropertyEnumeration",
            "Shows",
            "AADM",
            QT_TRANSLATE_NOOP(
                "App::Property", "Positions against the design, or the trial assembly: minimax, or least squares"
            ),
            choices=SHOWN,
        ),
        Property(
            "App::PropertyFloat",
            "Magnification",
            "AADM",
            QT_TRANSLATE_NOOP(
                "App::Property", "Arrows are this many times as long as the deviations; 0: chosen to fit"
            ),
            0.0,
        ),
        Property(
            "App::PropertyBool", "Arrows", "AADM", QT_TRANSLATE_NOOP("App::Property", "Show deviation arrows"), True
        ),
        Property(
            "App::PropertyEnumeration",
            "Labels",
            "AADM",
            QT_TRANSLATE_NOOP("App::Property", "Which points are labelled"),
            choices=LABELLED,
        ),
        Property(
            "App::PropertyBool",
            "OnTop",
            "AADM",
            QT_TRANSLATE_NOOP("App::Property", "Draw over everything: the foot is inside the column's own concrete"),
            True,
        ),
    )
    REDRAWN_BY = frozenset({"Report"})

    def attach(self, vobj: Any) -> None:
        """Set up the scene, and have its labels kept apart from others."""
        self._labels: list[tuple[Label, LabelImage]] = []
        self._movers: list[tuple[Any, Any, Any]] = []
        self._picked: tuple[float, float] | None = None
        super().attach(vobj)
        KEEPER.add(self)

    def icon_name(self, obj: Any) -> str:
        """The icon says the verdict, by shape and by colour."""
        return f"verdict-{obj.Verdict or 'not_assessed'}"

    def doubleClicked(self, vobj: Any) -> bool:
        """Open the panel of its column's check."""
        from aadm_workbench.gui.panels.check import open_panel

        column = owner_of(vobj.Object)
        if column is not None:
            open_panel(column)
        return column is not None

    def draw(self, obj: Any, vobj: Any, root: Any) -> None:
        """Plate, circles, arrows, labels."""
        self._labels, self._movers = [], []
        found = found_of(obj)
        if not found or not all(hasattr(vobj, one.name) for one in self.PROPERTIES):
            return
        magnification = self.magnification()
        marks = marks_of(found, vobj.Shows, magnification)
        group = coin_shapes.in_front() if vobj.OnTop else root
        self._draw_plate(found, group)
        self._draw_marks(marks, vobj, found, group)
        self._draw_labels(obj, vobj, marks, magnification, group)
        if group is not root:
            root.addChild(group)
        KEEPER.changed()

    def magnification(self) -> float:
        """How many times longer arrows are than deviations: what the user has set, else what fits the pattern."""
        set_by_user = float(self.Object.ViewObject.Magnification)
        found = found_of(self.Object)
        return set_by_user if set_by_user > 0 else best_magnification(found, pitch_of(found))

    def pick(self, place_mm: tuple[float, float] | None) -> None:
        """Put a ring around a place (x, y) of the foot, or around none."""
        self._picked = place_mm
        self.redraw()

    def outline(self) -> Array:
        """Corners (5, 3) mm of the foot, column frame."""
        column = owner_of(self.Object)
        try:
            design = design_of_report(found_of(self.Object)) if column is None else column_design(column)
        except DesignError:
            design = design_of_report(found_of(self.Object))
        return foot_outline(design)

    def _draw_plate(self, found: Mapping[str, Any], group: Any) -> None:
        colour, outline = of_verdict(str(found["verdict"])), self.outline()
        group.addChild(coin_shapes.areas([outline[:4]], [colour], 0.8))
        group.addChild(coin_shapes.lines([outline], [colour], 3.0))

    def _draw_marks(self, marks: Marks, vobj: Any, found: Mapping[str, Any], group: Any) -> None:
        colours = [of_verdict(circle.verdict) for circle in marks.circles]
        rings = [ring(circle.centre, circle.radius_mm) for circle in marks.circles]
        bad = [number for number, circle in enumerate(marks.circles) if circle.verdict not in _GOOD]
        group.addChild(coin_shapes.areas([rings[one][:-1] for one in bad], [colours[one] for one in bad], 0.45))
        group.addChild(coin_shapes.lines(rings, colours, 2.5))
        if vobj.Arrows:
            width_mm = max(2.0, 0.035 * pitch_of(found))
            drawn = [(arrow_outline(arrow, width_mm), of_verdict(arrow.verdict)) for arrow in marks.arrows]
            kept = [(outline, colour) for outline, colour in drawn if len(outline)]
            group.addChild(coin_shapes.areas([outline for outline, _ in kept], [colour for _, colour in kept]))
        if self._picked is not None:
            picked = ring(np.array([*self._picked, 0.0]), 0.42 * pitch_of(found))
            group.addChild(coin_shapes.lines([picked], [(0.05, 0.05, 0.05)], 5.0))
            group.addChild(coin_shapes.lines([picked], [(1.0, 0.9, 0.2)], 2.5))

    def _draw_labels(self, obj: Any, vobj: Any, marks: Marks, magnification: float, group: Any) -> None:
        size_pt = label_size_pt()
        heads = self._headlines(obj, marks, vobj, magnification)
        self._labels = [(head, label_image(head.name, of_verdict(head.verdict), size_pt, bold=True)) for head in heads]
        chosen = [] if vobj.Labels == "None" else list(marks.labels)
        if vobj.Labels == "What fails":
            chosen = [label for label in chosen if label.verdict not in _GOOD]
        for label in chosen:
            said = length_text(label.value_mm) if label.value_mm is not None else in_words(label.verdict)
            image = label_image(f"{label.name}  {said}", of_verdict(label.verdict), size_pt)
            self._labels.append((label, image))
        for label, image in self._labels:
            group.addChild(self._label_node(label, image))

    def _headlines(self, obj: Any, marks: Marks, vobj: Any, magnification: float) -> list[Label]:
        """The verdict at one corner of the foot; at the opposite one, by how much arrows are magnified."""
        outline, name = self.outline(), str(found_of(obj).get("id", obj.Label))
        rank = -1 if obj.Verdict in _GOOD else -100_000
        found = [Label(outline[2], f"{name}: {in_words(obj.Verdict)}", None, obj.Verdict, rank)]
        if vobj.Arrows and marks.arrows:
            said = translate("AADM", "arrows ×{factor:g}").format(factor=magnification)
            found.append(Label(outline[0], said, None, "not_assessed", 100_000))
        return found

    def _label_node(self, label: Label, image: LabelImage) -> Any:
        switch, node = coin.SoSwitch(), coin.SoSeparator()
        switch.whichChild = coin.SO_SWITCH_NONE
        to_point, to_corner = coin.SoTranslation(), coin.SoTranslation()
        to_point.translation.setValue(*label.place.tolist())
        leader, held = coin.SoSeparator(), coin.SoCoordinate3()
        held.point.setValues(0, 2, [[0, 0, 0], [0, 0, 0]])
        grey, unlit = coin.SoBaseColor(), coin.SoLightModel()
        grey.rgb.setValue(0.25, 0.25, 0.25)
        unlit.model = coin.SoLightModel.BASE_COLOR
        for part in (unlit, grey, held, coin.SoLineSet()):
            leader.addChild(part)
        for part in (to_point, leader, to_corner, image.node):
            node.addChild(part)
        switch.addChild(node)
        self._movers.append((switch, to_corner, held))
        return switch

    def label_places(self) -> Array:
        """Points (n, 3) mm, model frame, of its labels; none while it is hidden or not in front."""
        active = FreeCADGui.activeDocument()
        obj = self.Object
        if active is None or active.Document.Name != obj.Document.Name or not obj.ViewObject.isVisible():
            return _EMPTY
        if not self._labels:
            return _EMPTY
        T_model_column = transform_of(obj.Placement)
        places = np.array([label.place for label, _ in self._labels])
        return places @ T_model_column[:3, :3].T + T_model_column[:3, 3]

    def label_sizes(self) -> list[tuple[float, float, int, float]]:
        """Width and height in pixels, rank, and the mm in a pixel beyond which each label is left out."""
        coarsest = pitch_of(found_of(self.Object)) / _LEAST_PITCH_PX
        limits = [np.inf, *([coarsest] * len(self._labels))]
        return [
            (float(image.width), float(image.height), label.rank, limit)
            for (label, image), limit in zip(self._labels, limits, strict=False)
        ]

    def move_label(self, index: int, offset: Array | None, foot: Array | None) -> None:
        """Put a label's lower left corner at an offset (3,) mm from its point, model frame; None hides it."""
        switch, to_corner, held = self._movers[index]
        if offset is None or foot is None:
            switch.whichChild = coin.SO_SWITCH_NONE
            return
        turned_back = transform_of(self.Object.Placement)[:3, :3].T
        to_corner.translation.setValue(*(turned_back @ offset).tolist())
        held.point.setValues(0, 2, [[0.0, 0.0, 0.0], (turned_back @ foot).tolist()])
        switch.whichChild = coin.SO_SWITCH_ALL
