"""The one place where findings are made: a code, what it is about, its values, and the sentence that they fill."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from aadm_workbench.model import Finding, Reason


def make_finding(name: str, about: Sequence[str], **values: Any) -> Finding:
    """A finding that holds back, whose sentence is ``name``, a code with or without a part after a dot.

    Parameters
    ----------
    name
        The code of its sentence in :mod:`aadm_workbench.model.sentences.finding`, without the first part.
    about
        Labels of points, or ``sleeves``, ``rebars``, ``column``.
    values
        What the sentence says; numbers as they are, the sentence rounds them.
    """
    text = Reason(f"finding.{name}", about=about, **values)
    return Finding(name.partition(".")[0], tuple(about), values, text, holds_back=True)
