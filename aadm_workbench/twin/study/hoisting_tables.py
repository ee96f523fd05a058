"""What the paper reports for alignment during hoisting: its Tables 3 to 9 and 12, errors in mm.

Source: Long et al., sections 3.3 (laboratory model) and 4.2 (field column). An error of None is a key point that left
the view. Table 7 prints 2.10 as the calculated deviation of the right key; with its actual 1.10 and its error 2.23 it
is 3.33.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

Keys = tuple[float | None, float | None, float | None]


@dataclass(frozen=True)
class PublishedCell:
    """Errors of the left, middle and right key points by the paper's own method, and their mean where it gives one."""

    keys: Keys
    mean: float | None


@dataclass(frozen=True)
class PublishedCondition:
    """One of the paper's conditions: mean error, mm, and time, s, by method."""

    mean: Mapping[str, float]
    seconds: Mapping[str, float]


def _cell(left: float, middle: float | None, right: float | None, mean: float | None) -> PublishedCell:
    return PublishedCell((left, middle, right), mean)


CELLS: Mapping[str, Mapping[float, PublishedCell]] = MappingProxyType(
    {
        "distance": MappingProxyType(
            {
                550.0: _cell(1.39, 1.18, 1.38, 1.32),
                650.0: _cell(1.58, 1.39, 1.66, 1.54),
                750.0: _cell(1.79, 1.60, 1.84, 1.74),
                850.0: _cell(2.05, 1.70, 2.01, 1.92),
                950.0: _cell(2.50, 2.18, 2.53, 2.40),
                1050.0: _cell(3.07, 2.70, 2.94, 2.90),
            }
        ),
        "height": MappingProxyType(
            {
                90.0: _cell(2.05, 1.70, 2.01, 1.92),
                120.0: _cell(2.01, 1.78, 2.01, 1.93),
                150.0: _cell(1.96, 1.74, 2.13, 1.94),
                180.0: _cell(2.10, 1.77, 2.23, 2.03),
                210.0: _cell(2.22, None, 2.22, None),
            }
        ),
        "angle": MappingProxyType(
            {
                0.0: _cell(2.10, 1.77, 2.23, 2.03),
                10.0: _cell(2.08, 1.80, 2.30, 2.06),
                20.0: _cell(2.06, 1.82, 2.31, 2.06),
                30.0: _cell(2.03, 1.89, 2.36, 2.09),
                40.0: _cell(1.99, 1.95, None, None),
            }
        ),
        "spacing": MappingProxyType(
            {
                0.0: _cell(2.03, 1.89, 2.36, 2.09),
                20.0: _cell(2.02, 1.90, 2.40, 2.11),
                40.0: _cell(1.98, 1.98, 2.50, 2.15),
                60.0: _cell(1.94, 2.08, 2.54, 2.19),
                80.0: _cell(1.86, 2.16, 2.60, 2.21),
                100.0: _cell(1.78, 2.26, 2.66, 2.23),
            }
        ),
    }
)
"""Tables 3 to 6 by study and by the value of its parameter."""

TITLES: Mapping[str, str] = MappingProxyType(
    {
        "distance": "Table 3, camera distance, mm",
        "height": "Table 4, height of the foot above the bars, mm",
        "angle": "Table 5, angle between column and bars, degrees",
        "spacing": "Table 6, planar spacing, mm",
        "conditions": "Tables 7 to 9 and 12, methods side by side",
    }
)


def _condition(fusion: float, pointcloud: float, image: float, *seconds: float) -> PublishedCondition:
    names = ("fusion", "pointcloud", "image")
    return PublishedCondition(
        MappingProxyType(dict(zip(names, (fusion, pointcloud, image), strict=True))),
        MappingProxyType(dict(zip(names, seconds, strict=True))),
    )


CONDITIONS: Mapping[str, PublishedCondition] = MappingProxyType(
    {
        "180 mm high": _condition(2.03, 2.44, 3.13, 0.585, 0.464, 0.241),
        "and turned 30 degrees": _condition(2.09, 2.70, 3.22, 0.603, 0.489, 0.323),
        "and 100 mm aside": _condition(2.23, 2.81, 3.38, 0.650, 0.522, 0.346),
        "field, 720 mm away": _condition(1.39, 2.42, 3.33, 0.622, 0.510, 0.250),
    }
)
"""Tables 7, 8, 9 and 12."""
