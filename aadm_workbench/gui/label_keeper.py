"""Keeps the labels of all results apart on the screen: looks at the camera now and then, and moves them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol

import numpy as np
from PySide import QtCore

from aadm_workbench.document.display.label_layout import Box, Wanted, place_labels
from aadm_workbench.document.display.projection import ViewCamera, project
from aadm_workbench.gui.view_camera import active_view, camera_of
from aadm_workbench.model import Array

_LOOK_EVERY_MS = 200  # labels follow the view as soon as the hand rests


class LabelHolder(Protocol):
    """What shows labels: a view of a result."""

    def label_places(self) -> Array:
        """Points (n, 3) mm, model frame, that its labels belong to; empty while it is hidden."""

    def label_sizes(self) -> list[tuple[float, float, int, float]]:
        """Width and height in pixels, rank, and the mm in a pixel beyond which each label is left out."""

    def move_label(self, index: int, offset: Array | None, foot: Array | None) -> None:
        """Put a label's lower left corner at an offset (3,) mm from its point, model frame; None hides it.

        ``foot`` (3,) mm is where a line from the point ends at the label.
        """


class LabelKeeper(QtCore.QObject):
    """Arranges the labels of everything that has told it of itself."""

    def __init__(self) -> None:
        super().__init__()
        self._holders: list[LabelHolder] = []
        self._seen: tuple[Any, ...] = ()
        self._timer = QtCore.QTimer(self)
        self._timer.setInterval(_LOOK_EVERY_MS)
        self._timer.timeout.connect(self._look)
        self.boxes: list[Box] = []

    def add(self, holder: LabelHolder) -> None:
        """Arrange the labels of one more."""
        if holder not in self._holders:
            self._holders.append(holder)
        self._seen = ()
        if not self._timer.isActive():
            self._timer.start()

    def drop(self, holder: LabelHolder) -> None:
        """Forget one; without any there is nothing to look at."""
        if holder in self._holders:
            self._holders.remove(holder)
        if not self._holders:
            self._timer.stop()

    def changed(self) -> None:
        """Labels have changed: arrange them when there is time."""
        self._seen = ()

    def _alive(self) -> list[tuple[LabelHolder, Array]]:
        """Holders with the places of their labels; those whose document was closed are forgotten."""
        found = []
        for holder in list(self._holders):
            try:
                found.append((holder, holder.label_places()))
            except ReferenceError:
                self.drop(holder)
            except RuntimeError:
                # Deleted, but an undo may bring it back.
                continue
        return found

    def _look(self) -> None:
        view = active_view()
        if view is None:
            return
        camera = camera_of(view)
        shown = tuple(len(places) for _, places in self._alive())
        signature = (*camera.position, *camera.axes.ravel(), camera.height_mm, *camera.size, *shown)
        if signature != self._seen:
            self._seen = signature
            self._arrange(camera)

    def arrange(self, size: tuple[float, float] | None = None) -> None:
        """Arrange all labels now, for the view in front, or for a picture of it of another size, pixels."""
        view = active_view()
        if view is not None:
            camera = camera_of(view)
            self._arrange(camera if size is None else replace(camera, size=size))

    def _arrange(self, camera: ViewCamera) -> None:
        owners: list[tuple[LabelHolder, int]] = []
        wanted: list[Wanted] = []
        per_pixel: list[float] = []
        for holder, places in self._alive():
            if not len(places):
                continue
            pixels, mm_per_pixel = project(places, camera)
            for index, (width, height, rank, coarsest) in enumerate(holder.label_sizes()):
                owners.append((holder, index))
                per_pixel.append(float(mm_per_pixel[index]))
                # From afar a floor shows its columns, not their points.
                at = np.nan_to_num(pixels[index], nan=-1.0) if mm_per_pixel[index] <= coarsest else (-1.0, -1.0)
                wanted.append(Wanted(float(at[0]), float(at[1]), width, height, rank))
        boxes = place_labels(wanted, camera.size)
        self.boxes = [box for box in boxes if box is not None]
        for (holder, index), label, box, scale in zip(owners, wanted, boxes, per_pixel, strict=True):
            if box is None:
                holder.move_label(index, None, None)
                continue
            corner = _across((box[0] - label.x, box[1] - label.y), scale, camera)
            nearest = (min(max(label.x, box[0]), box[2]) - label.x, min(max(label.y, box[1]), box[3]) - label.y)
            holder.move_label(index, corner, _across(nearest, scale, camera))


def _across(pixels: tuple[float, float], mm_per_pixel: float, camera: ViewCamera) -> Array:
    """A way on the screen as a way (3,) mm in the model frame."""
    way: Array = (camera.axes[0] * pixels[0] + camera.axes[1] * pixels[1]) * mm_per_pixel
    return way


KEEPER = LabelKeeper()
"""There is one screen, so there is one keeper."""
