"""Hough circles in an image, with the published threshold of 30 votes wherever that many can be had."""

from __future__ import annotations

import cv2
import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Array

VOTES = 30  # as published (2.1.1)
VOTES_OF_OUTLINE = 1 / 28  # see votes_needed
VOTES_MIN = 10  # see votes_needed
CANNY_HIGH = 100.0  # of 255: an edge of black and white passes, smoothed or not
RADIUS_MISFIT = 0.15  # relative: three pixels at a radius of twenty
APART = 1.0  # of the diameter: sleeves and bars do not overlap
SMOOTHING_PIXELS = 5  # the least that smooths: edges of a binary image have eight directions


def votes_needed(radius_pixels: float) -> int:
    """30 votes as published, or fewer for a circle that is too small in the image to gather them.

    The gradients of a coarse edge scatter, and the votes with them: on images at the pitch of a scan's own points one
    cell of the accumulator gathers 14 to 25 wherever a circle of 10 to 60 pixels really is, and up to 8 elsewhere. So
    30 are asked from 134 pixels on, a 28th of the outline's pixels below, and never less than 10.
    """
    outline_pixels = 2.0 * np.pi * radius_pixels
    return int(np.clip(round(VOTES_OF_OUTLINE * outline_pixels), VOTES_MIN, VOTES))


def hough_circles(image: npt.NDArray[np.uint8], radius_pixels: tuple[float, float], votes: int) -> tuple[Array, Array]:
    """Circles whose radius lies in a range: centres (n, 2) as (column, row), pixel centres being whole, and radii (n,).

    Circles with most votes come first. The image is smoothed as OpenCV advises: the edges of an unsmoothed
    binary image have eight directions only.
    """
    smooth = cv2.GaussianBlur(image, (SMOOTHING_PIXELS, SMOOTHING_PIXELS), 0)
    low, high = radius_pixels
    circles = cv2.HoughCircles(
        smooth,
        cv2.HOUGH_GRADIENT,
        dp=1.0,
        minDist=max(2.0, APART * (low + high)),
        param1=CANNY_HIGH,
        param2=votes,
        minRadius=max(1, int(low)),
        maxRadius=int(np.ceil(high)),
    )
    if circles is None or circles.size == 0:
        return np.empty((0, 2)), np.empty(0)
    found = circles.reshape(-1, circles.shape[-1]).astype(np.float64)
    return found[:, :2], found[:, 2]
