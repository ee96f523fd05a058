"""How much of each bar stands behind nearer ones."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array

_RAYS = 41  # over the width of a bar: shares to 2.5 %


def hidden_shares(centres: Array, eye: Array, radius_mm: float) -> Array:
    """Share (k,) of the width of each round thing (k, 2) that nearer ones of the same radius hide from an eye (2,)."""
    about = centres - eye
    distance = np.hypot(about[:, 0], about[:, 1])
    angle = np.arctan2(about[:, 1], about[:, 0])
    half = np.arcsin(np.clip(radius_mm / distance, 0.0, 1.0))
    shares = np.zeros(len(centres))
    for k in range(len(centres)):
        rays = angle[k] + half[k] * np.linspace(-1.0, 1.0, _RAYS)
        hidden = np.zeros(_RAYS, bool)
        for other in np.flatnonzero(distance < distance[k] - radius_mm):
            hidden |= np.abs(np.mod(rays - angle[other] + np.pi, 2 * np.pi) - np.pi) < half[other]
        shares[k] = hidden.mean()
    return shares
