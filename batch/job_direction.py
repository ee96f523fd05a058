"""Directions in the column frame as a job writes them: ``up`` of a scan, ``near`` of a hoisting frame."""

from __future__ import annotations

from aadm_workbench.design.directions import UP_DEG

from .job_table import JobTable, is_finite_number

NEAR = {"+x+y": (1, 1), "-x+y": (-1, 1), "-x-y": (-1, -1), "+x-y": (1, -1)}


def up_deg(table: JobTable, key: str) -> float | None:
    """The column-frame direction at the top of the image, degrees from +x, counter-clockwise from above.

    Written as one of :data:`UP_DEG`, or as the number itself.
    """
    value = table.values.get(key)
    if value is None:
        return None
    if isinstance(value, str) and value in UP_DEG:
        return UP_DEG[value]
    if is_finite_number(value):
        return float(value)
    raise table.wrong(key, f'{key} must be "+x", "-x", "+y", "-y" or a number of degrees from +x, it is {value!r}')


def near_corner(table: JobTable) -> tuple[int, int] | None:
    """Signs of x and y of the corner of the bars that is nearest to the camera."""
    value = table.values.get("near")
    if value is None:
        return None
    if not isinstance(value, str) or value not in NEAR:
        listed = ", ".join(f'"{corner}"' for corner in NEAR)
        raise table.wrong("near", f"near must be one of the corners {listed}, it is {value!r}")
    return NEAR[value]
