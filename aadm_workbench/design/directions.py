"""Which side of a column is at the top of a picture, as people write it: ``+x``, ``-y``, or degrees from +x."""

from __future__ import annotations

import math

from aadm_workbench.errors import JobError

UP_DEG = {"+x": 0.0, "+y": 90.0, "-x": 180.0, "-y": -90.0}


def up_deg(written: str, label: str) -> float | None:
    """Column-frame direction at the top of the image, degrees from +x, counter-clockwise from above.

    An empty text is None: nobody declared it.

    Raises
    ------
    JobError
        For a text that is no direction; ``label`` says whose it is.
    """
    text = written.strip()
    if not text:
        return None
    if text in UP_DEG:
        return UP_DEG[text]
    try:
        value = float(text.removesuffix("°"))
    except ValueError:
        value = math.nan
    if math.isfinite(value):
        return value
    from aadm_workbench.model import Reason

    raise JobError(Reason("design.up", label=label, written=repr(written)))
