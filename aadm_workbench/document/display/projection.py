"""Where points of the model are on the screen, by the camera of a 3-D view; float64, for models far from the origin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array


@dataclass(frozen=True, eq=False)
class ViewCamera:
    """The camera of a 3-D view.

    Parameters
    ----------
    position
        (3,) mm, model frame.
    axes
        (3, 3): right, up and backward of the screen as rows, in the model frame.
    height_mm
        What the view is high, at the focal distance for a camera in perspective.
    focal_mm
        Focal distance; infinite for parallel projection.
    size
        Width and height of the view, pixels.
    """

    position: Array
    axes: Array
    height_mm: float
    focal_mm: float
    size: tuple[float, float]


def project(points: Array, camera: ViewCamera) -> tuple[Array, Array]:
    """Points (n, 3) mm on the screen.

    Returns
    -------
    pixels
        (n, 2), from the lower left corner; NaN behind the camera.
    mm_per_pixel
        (n,) at the depth of each point.
    """
    seen = (np.atleast_2d(points) - camera.position) @ camera.axes.T
    width, height = camera.size
    # A view that is higher than wide shows its width in what is given as its height.
    shown_mm = camera.height_mm * max(1.0, height / width)
    per_pixel = np.full(len(seen), shown_mm / height)
    if np.isfinite(camera.focal_mm):
        depth = -seen[:, 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            per_pixel = np.where(depth > 0, per_pixel * depth / camera.focal_mm, np.nan)
    with np.errstate(invalid="ignore"):
        pixels = seen[:, :2] / per_pixel[:, None] + np.array([width, height]) / 2.0
    return pixels, per_pixel
