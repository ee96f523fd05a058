"""Sizes of reinforcing bars: nominal, and over the ribs."""

from __future__ import annotations

OVER_RIBS_MM = {
    12.0: 14.7,
    14.0: 17.0,
    16.0: 19.2,
    18.0: 21.3,
    20.0: 23.5,
    22.0: 26.1,
    25.0: 29.4,
    28.0: 32.6,
    32.0: 37.0,
    36.0: 41.4,
    40.0: 45.7,
}
"""Diameter over the longitudinal ribs of crescent-ribbed bars by nominal diameter: d1 + 2 h1 of GB/T 1499.2-2018,
Table 3 (recalled, not verified against the printed standard)."""

_SAME_SIZE_MM = 0.05  # sizes are whole millimetres
_LIKELY_OVER_RIBS_MM = 1.2
"""Catalogues round the diameter over the ribs in their own ways (20 mm bars: 22.7 to 23.5)."""


def over_ribs_mm(nominal_mm: float) -> float | None:
    """Diameter over the ribs of a nominal size; None for a size that the table has not."""
    return next((over for size, over in OVER_RIBS_MM.items() if abs(size - nominal_mm) < _SAME_SIZE_MM), None)


def nominal_of_over_ribs(diameter_mm: float) -> float | None:
    """Nominal size of which a diameter is the one over the ribs; None where it is a nominal size itself or far off."""
    if over_ribs_mm(diameter_mm) is not None:
        return None
    size, over = min(OVER_RIBS_MM.items(), key=lambda item: abs(item[1] - diameter_mm))
    return size if abs(over - diameter_mm) < _LIKELY_OVER_RIBS_MM else None
