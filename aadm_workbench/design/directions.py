"""Which side of a column is at the top of a picture, as people write it: ``+x``, ``-y``, or degrees from +x."""

from __future__ import annotations

import math

from aadm_workbench.errors import JobError
from aadm_workbench.model import UP_DEG


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
    raise JobError.because("design.up", label=label, written=repr(written))
