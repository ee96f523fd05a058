"""What setting adds to where a column stands: covariances of what no scan of bars and sleeves tells."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, StackSettings

_USUAL_RADIUS_MM = 200.0
"""From the axis of a column to its bars where there are no bars to measure it on; columns are 400 to 800 mm wide."""


def of_setting(settings: StackSettings, radius_mm: float | None, height_mm: float | None) -> Array:
    """Covariance (6, 6) of a column against where it is guided to: mm², mm·rad, rad².

    Parameters
    ----------
    radius_mm
        Of its bars about its axis, root mean square: what presses on bars turns the column, too.
    height_mm
        From foot to top; None where it is not known: then the tilt is not a number.
    """
    tilt = np.nan if height_mm is None else settings.plumb_at(height_mm) / height_mm
    yaw = settings.fit_u_mm / (radius_mm or _USUAL_RADIUS_MM)
    return np.diag(np.square([settings.fit_u_mm, settings.fit_u_mm, settings.level_u_mm, tilt, tilt, yaw]))


def of_bars(settings: StackSettings, radius_mm: float | None) -> Array:
    """Covariance (6, 6) of the bars in the head of a column against the column, as a group."""
    yaw = settings.bars_u_mm / (radius_mm or _USUAL_RADIUS_MM)
    return np.diag(np.square([settings.bars_u_mm, settings.bars_u_mm, 0.0, 0.0, 0.0, yaw]))
