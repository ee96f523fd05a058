"""Units of models that do not know their own: declared, and compared with what the model then holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import MappingProxyType

from aadm_workbench.errors import DesignError
from aadm_workbench.model import Array, ColumnDesign, Reason

MM_PER_UNIT = MappingProxyType({"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4, "foot": 304.8})

SMALLEST_MM = 100.0
"""Largest extent of a model of precast parts: no column is smaller."""
LARGEST_MM = 1e6
"""Of a model: a test piece is larger, a floor smaller."""


def check_units(source: str, units: str, span_mm: Array, columns_in: Callable[[str], Sequence[ColumnDesign]]) -> None:
    """Refuse a unit by which nothing was found, where by another the model holds columns, or no model has such a size.

    Parameters
    ----------
    units
        As declared.
    span_mm
        (3,) the size of the model by the declared unit.
    columns_in
        The columns that the model holds if it is in another unit.

    Raises
    ------
    DesignError
        Naming the size that the model has by the declared unit, and the unit that fits.
    """
    sizes = " x ".join(f"{side:.4g}" for side in span_mm)
    declared = Reason("design.measures", source=source, units=units, sizes=sizes)
    for other, mm in MM_PER_UNIT.items():
        factor = mm / MM_PER_UNIT[units]
        if other == units or not SMALLEST_MM <= factor * float(span_mm.max()) <= LARGEST_MM:
            continue
        columns = columns_in(other)
        if columns:
            sleeves = columns[0].sleeves
            raise DesignError(
                Reason(
                    "design.other_unit",
                    declared=declared,
                    other=other,
                    count=len(sleeves),
                    diameter_mm=sleeves[0].diameter_mm,
                )
            )
    if not SMALLEST_MM <= float(span_mm.max()) <= LARGEST_MM:
        raise DesignError(Reason("design.no_size", declared=declared, known=MM_PER_UNIT))
